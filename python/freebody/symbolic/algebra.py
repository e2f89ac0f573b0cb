"""Identities of sums and products: common factors, quotients, sin² + cos² = 1; and whether two expressions are equal."""

from __future__ import annotations

import itertools
import math
import random
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import (
    MINUS_ONE,
    ONE,
    PI,
    ZERO,
    Add,
    Fn,
    Mul,
    Num,
    Pow,
    Sym,
    Tree,
    add,
    is_negative,
    is_zero,
    mul,
    negative,
    number,
    power,
    rebuilt,
    symbols,
)

Powers = dict[Tree, Fraction]
Term = tuple[Fraction | float, Powers]
_ROUND_OFF = 1e-14
"""Part of a measured number by which it may be off a whole one."""
_MULTIPLES = 1000
"""How many times the least of measured numbers others are that are told as its multiples."""
_SAMPLES = 4
_AGREEMENT = 1e-8  # relative difference of two forms that are equal
_CIRCLES = ({("sin", 2), ("cos", -2)}, {("sin", -2), ("cos", 2)})


def factored(tree: Tree) -> Tree:
    """A sum with what all terms have in common in front: −l θ̇₁² − 2 l θ̇₁ θ̇₂ − l θ̇₂² is −l (θ̇₁ + θ̇₂)². The value stays the same."""
    if not isinstance(tree, Add):
        return tree
    terms = [_split(term) for term in tree.terms]
    common, size = _common(terms), _size(terms)
    rest = [(_whole(c / size), {f: e - common.get(f, 0) for f, e in p.items() if e != common.get(f, 0)}) for c, p in terms]
    inner = _square(rest) or add(*map(_joined, rest))
    return mul(number(size), *(power(f, e) for f, e in common.items()), inner)


def spread(tree: Tree) -> Tree:
    """A sum of products without brackets, like terms together; what round-off leaves of measured numbers is 0."""
    terms: dict[frozenset[tuple[Tree, Fraction]], list[Fraction | float]] = {}
    for term in _products(tree):
        size, powers = _split(term)
        terms.setdefault(frozenset(powers.items()), []).append(size)
    sums = {powers: (sum(sizes), max(map(abs, sizes))) for powers, sizes in terms.items()}
    kept = {
        p: total for p, (total, most) in sums.items() if (abs(total) > _ROUND_OFF * most if isinstance(total, float) else total)
    }
    return add(*(_joined((_whole(size), dict(powers))) for powers, size in kept.items()))


def difference(tree: Tree, other: Tree) -> Tree:
    """tree − other, squares of sums multiplied out as well; 0 where they are the same in another order."""

    def out(part: Tree) -> Tree | None:
        square = isinstance(part, Pow) and part.exponent == 2 and isinstance(part.base, Add)
        return mul(part.base, part.base) if square else None

    return spread(rebuilt(add(tree, negative(other)), out))


def with_zero(tree: Tree, symbol: Sym) -> Tree:
    """The expression, without brackets, where a symbol is 0."""

    def put(part: Tree) -> Tree | None:
        match part:
            case Sym() if part == symbol:
                return ZERO
            case Fn("sin" | "cos" as name, (angle,)) if symbol in symbols(angle):
                inner = with_zero(angle, symbol)
                if is_zero(inner):
                    return ZERO if name == "sin" else ONE
                turned = is_negative(inner)
                made = Fn(name, (negative(inner) if turned else inner,))
                return negative(made) if turned and name == "sin" else made
            case Pow(base, exponent) if symbol in symbols(base):
                inner = with_zero(base, symbol)
                even = exponent.denominator == 1 and exponent % 2 == 0
                return inner if is_zero(inner) else power(negative(inner) if even and is_negative(inner) else inner, exponent)
        return None

    return spread(rebuilt(tree, put)) if symbol in symbols(tree) else tree


def _products(tree: Tree) -> list[Tree]:
    if isinstance(tree, Add):
        return [product for term in tree.terms for product in _products(term)]
    if isinstance(tree, Mul):
        return [mul(*factors) for factors in itertools.product(*map(_products, tree.factors))]
    return [tree]


def grouped(tree: Tree) -> Tree:
    """A sum with brackets in its brackets multiplied out, what differs in one factor standing together: (M + m) l² + I."""
    if _depth(tree) < 2:
        return factored(tree)
    flat, made = spread(tree), list[Tree]()
    left = [_split(term) for term in (flat.terms if isinstance(flat, Add) else (flat,))]
    while left:
        (size, powers), *left = left
        shared = [{f: e for f, e in powers.items() if f != own} for own, exponent in powers.items() if exponent == 1]
        alike = {i: [term for term in left if _but_one(term[1], rest)] for i, rest in enumerate(shared) if rest}
        best = max(alike, key=lambda i: len(alike[i]), default=None)
        rest = shared[best] if best is not None and alike[best] else {}
        same = [(size, powers), *(alike[best] if best is not None and rest else [])]
        left = [term for term in left if term not in same]
        parts = (_joined((size, {f: e for f, e in own.items() if f not in rest})) for size, own in same)
        made.append(mul(factored(add(*parts)), _joined((Fraction(1), rest))))
    return add(*made)


def _depth(tree: Tree) -> int:
    """How many sums are in each other, as factors."""
    if isinstance(tree, Mul):
        return max(map(_depth, tree.factors))
    return 1 + max(map(_depth, tree.terms)) if isinstance(tree, Add) else 0


def _but_one(powers: Powers, shared: Powers) -> bool:
    """Whether these are the shared ones and one more factor."""
    return len(powers) == len(shared) + 1 and [e for f, e in powers.items() if shared.get(f) != e] == [1]


def less(tree: Tree, part: Tree) -> Tree:
    """tree − part, where a term like the part becomes smaller, with the brackets that the tree has; else multiplied out."""
    if isinstance(tree, Add):
        place = next((i for i, term in enumerate(tree.terms) if _split(term)[1] == _split(part)[1]), None)
        if place is not None:
            own = spread(add(tree.terms[place], negative(part)))
            return add(*(own if i == place else term for i, term in enumerate(tree.terms)))
    elif isinstance(tree, Mul) and any(isinstance(f, Add) for f in tree.factors):
        inner = next(f for f in tree.factors if isinstance(f, Add))
        others = mul(*(f for f in tree.factors if f is not inner))
        powers = _split(part)[1]
        if all(powers.get(f, 0) >= e for f, e in _split(others)[1].items()):
            return mul(others, factored(less(inner, quotient(part, others))))
    return spread(add(tree, negative(part)))


def opposite(tree: Tree) -> Tree:
    """−tree, without a minus sign in front where a difference takes it: of P (r − R) it is P (R − r)."""
    made = negative(tree)
    factors = made.factors if isinstance(made, Mul) and is_negative(made) else ()
    difference = next((f for f in factors if isinstance(f, Add) and any(map(is_negative, f.terms))), None)
    if difference is None:
        return made
    return negative(mul(*(negative(f) if f is difference else f for f in factors)))


def signed(tree: Tree, constants: Mapping[Sym, float]) -> Tree:
    """The tree with the signs that a person gives the sums in its products: one of ``constants`` alone is positive, in any other the
    fewest terms are negative; of r (r − R) that is −r (R − r)."""

    def put(part: Tree) -> Tree | None:
        if not isinstance(part, Mul):
            return None
        made = [factor if isinstance(factor, Num | Sym) else signed(factor, constants) for factor in part.factors]
        minuses = [_minuses(factor, constants) for factor in made]
        turned = [i for i, count in enumerate(minuses) if count > 0]
        even = [i for i, count in enumerate(minuses) if count == 0]
        turned += even[:1] if is_negative(part) != len(turned) % 2 else []
        for i in turned:
            made[i] = _opposite_factor(made[i])
        return mul(*made, *[MINUS_ONE] * (len(turned) % 2)) if made != list(part.factors) else part

    return rebuilt(tree, put)


def _minuses(factor: Tree, constants: Mapping[Sym, float]) -> int:
    """Of a factor that is a sum, or an odd power of one: how many of its terms are negative beyond those that are not; of one of
    constants 1 or −1, as its value is; −1 for any other factor."""
    odd = isinstance(factor, Pow) and factor.exponent.denominator == 1 and factor.exponent % 2
    inner = factor.base if isinstance(factor, Pow) and odd else factor
    if not isinstance(inner, Add) or not (count := sum(map(is_negative, inner.terms))):
        return -1
    if all(term.symbols <= constants.keys() for term in inner.terms):
        with np.errstate(all="ignore"):
            return 1 if evaluate(inner, constants) < 0 else -1
    return 2 * count - len(inner.terms)


def _opposite_factor(factor: Tree) -> Tree:
    return power(negative(factor.base), factor.exponent) if isinstance(factor, Pow) else negative(factor)


def common_factors(trees: Sequence[Tree], wanted: Callable[[Tree], bool]) -> Tree:
    """The factors ``wanted`` of all terms of all trees that are not 0, with the number that is common besides: of x cos(π/9) and
    3 cos(π/9), where numbers are wanted, cos(π/9)."""
    found = [tree for tree in trees if not is_zero(tree)]
    terms = [_split(term) for tree in found for term in (tree.terms if isinstance(tree, Add) else (tree,))]
    shared = [power(f, e) for f, e in _common(terms).items() if wanted(f)] if terms else []
    return mul(number(abs(_size(terms))), *shared) if terms else ONE


def common_number(trees: Sequence[Tree]) -> Tree:
    """What is without symbols, but not a mere number, and a factor of all, with the number that is common besides; 1 where there is
    nothing of the kind."""
    found = common_factors(trees, lambda factor: symbols(factor) <= {Sym(PI)})
    return ONE if isinstance(found, Num) else found


def pythagorean(tree: Tree) -> Tree:
    """A sum in which sin²α and cos²α with the same factors have become one: a sin²α + b + a cos²α is a + b."""
    if not isinstance(tree, Add):
        return tree
    terms = [_split(term) for term in tree.terms]
    while pair := next(filter(_is_circle, itertools.combinations(filter(_has_square, terms), 2)), None):
        (size, powers), (_, rest) = pair
        both = {f: least for f, e in powers.items() if f in rest and (least := min(e, rest[f]))}
        terms = [term for term in terms if term not in pair] + [(size, both)]
    return add(*map(_joined, terms))


def _has_square(term: Term) -> bool:
    """Whether sin² or cos² of an angle is in it."""
    return any(exponent >= 2 and isinstance(factor, Fn) for factor, exponent in term[1].items())


def without_circles(tree: Tree) -> Tree:
    """The expression with ``pythagorean`` applied to every sum in it, but those that functions are of."""

    def put(part: Tree) -> Tree | None:
        if isinstance(part, Add):
            return pythagorean(add(*map(without_circles, part.terms)))
        return part if isinstance(part, Fn) else None

    return rebuilt(tree, put)


def quotient(above: Tree, below: Tree) -> Tree:
    """``above / below`` without the factors that both have: (m g l)/(m l²) is g/l. It holds where these factors are not 0."""
    if is_zero(above):
        return above
    (size, top), (divisor, bottom) = _split(factored(above)), _split(factored(below))
    powers = dict(top)
    for factor, exponent in bottom.items():
        powers[factor] = powers.get(factor, Fraction(0)) - exponent
    return _joined((_whole(size / divisor), {factor: exponent for factor, exponent in powers.items() if exponent}))


def divided(tree: Tree, factor: Tree) -> Tree:
    """``tree / factor``, term by term."""
    return add(*(quotient(term, factor) for term in (tree.terms if isinstance(tree, Add) else (tree,))))


def equal(first: Tree, second: Tree, tables: Mapping[str, Callable[..., Any]] | None = None) -> bool:
    """Whether two expressions agree at random values of their symbols; places where one has no value are passed over."""
    draw, occurring, compared = random.Random(7), sorted(symbols(first, second), key=str), 0
    for _ in range(4 * _SAMPLES):
        values = {symbol: draw.uniform(0.3, 1.9) for symbol in occurring}
        try:
            with np.errstate(all="ignore"):
                a, b = (complex(evaluate(tree, values, tables)) for tree in (first, second))
        except (ZeroDivisionError, OverflowError):
            continue
        if a == a and b == b:
            if abs(a - b) > _AGREEMENT * max(1.0, abs(a), abs(b)):
                return False
            compared += 1
        if compared == _SAMPLES:
            break
    return compared > 0


def _whole(size: Fraction | float) -> Fraction | float:
    """A measured number that is whole but for round-off as that number."""
    near = isinstance(size, float) and size != 0 and abs(size - round(size)) < _ROUND_OFF * abs(size)
    return Fraction(round(size)) if near else size


def _is_circle(pair: tuple[Term, Term]) -> bool:
    """Whether two terms differ in nothing but sin² of an angle in one and cos² in the other."""
    (size, powers), (other, rest) = pair
    apart = {f: powers.get(f, 0) - rest.get(f, 0) for f in powers | rest if powers.get(f, 0) != rest.get(f, 0)}
    angles = {f.args for f in apart if isinstance(f, Fn)}
    return size == other and len(angles) == 1 and {(getattr(f, "name", ""), e) for f, e in apart.items()} in _CIRCLES


def _split(term: Tree) -> Term:
    size: Fraction | float = Fraction(1)
    powers: Powers = {}
    for factor in term.factors if isinstance(term, Mul) else (term,):
        if isinstance(factor, Num):
            size *= factor.value
        else:
            base, exponent = (factor.base, factor.exponent) if isinstance(factor, Pow) else (factor, 1)
            powers[base] = powers.get(base, Fraction(0)) + exponent
    return size, powers


def _common(terms: Sequence[Term]) -> Powers:
    first, *others = (powers for _, powers in terms)
    shared = {f: min([e, *(p.get(f, Fraction(0)) for p in others)]) for f, e in first.items() if e > 0}
    return {factor: exponent for factor, exponent in shared.items() if exponent > 0}


def _size(terms: Sequence[Term]) -> Fraction | float:
    """The number in front: the largest that leaves whole numbers, negative where all terms are."""
    sizes = [size for size, _ in terms]
    sign = -1 if all(size < 0 for size in sizes) else 1
    if any(isinstance(size, float) for size in sizes):
        least, most = min(map(abs, sizes)), max(map(abs, sizes))
        multiples = (
            least > 0 and most < _MULTIPLES * least and all(isinstance(_whole(float(size / least)), Fraction) for size in sizes)
        )
        return sign * _whole(least) if multiples else Fraction(sign)
    above = math.gcd(*(abs(size.numerator) for size in sizes))
    below = {size.denominator for size in sizes}
    return sign * Fraction(above, below.pop() if len(below) == 1 else 1)


def _square(terms: Sequence[Term]) -> Tree | None:
    """(Σ k x)² if that is what the terms are."""
    cross = {frozenset(p): c for c, p in terms if len(p) == 2 and set(p.values()) == {1}}
    roots = {next(iter(p)): k for c, p in terms if len(p) == 1 and set(p.values()) == {2} and (k := _root(c))}
    first, n = next(iter(roots), None), len(roots)
    roots = {x: -k if cross.get(frozenset((first, x)), 0) < 0 else k for x, k in roots.items()}
    products = {frozenset((x, y)): 2 * k * l for (x, k), (y, l) in itertools.combinations(roots.items(), 2)}
    is_square = n > 1 and len(terms) == n * (n + 1) // 2 and cross == products
    return power(add(*(mul(number(k), x) for x, k in roots.items())), 2) if is_square else None


def _root(value: Fraction | float) -> Fraction | None:
    """The square root of a fraction, where that is one."""
    if isinstance(value, float) or value <= 0:
        return None
    root = Fraction(math.isqrt(value.numerator), math.isqrt(value.denominator))
    return root if root**2 == value else None


def _joined(term: Term) -> Tree:
    size, powers = term
    return mul(number(size), *(power(factor, exponent) for factor, exponent in powers.items()))
