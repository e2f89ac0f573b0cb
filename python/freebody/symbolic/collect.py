"""Sums as a person writes them: common factors in front, squares of sums as such, unknowns with one factor each."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from fractions import Fraction

from freebody.symbolic.tree import ONE, PI, Add, Fn, Mul, Num, Pow, Sym, Tree, add, is_zero, mul, number, power, symbols

Powers = dict[Tree, Fraction]
Term = tuple[Fraction | float, Powers]
_ROUND_OFF = 1e-14
"""Part of a measured number by which it may be off a whole one."""
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


def common_number(trees: Sequence[Tree]) -> Tree:
    """What is without letters, but not a mere number, and a factor of all: cos(π/9) of x cos(π/9) and 3 cos(π/9), with the number that
    is common besides; 1 where there is nothing of the kind."""
    terms = [_split(term) for tree in trees for term in (tree.terms if isinstance(tree, Add) else (tree,))]
    shared = {f: e for f, e in _common(terms).items() if all(x == Sym(PI) for x in symbols(f))} if terms else {}
    return mul(number(abs(_size(terms))), *(power(f, e) for f, e in shared.items())) if shared else ONE


def collected(tree: Tree, unknowns: Sequence[Sym]) -> Tree:
    """A sum that is linear in some letters, with one factor for each of them; as it is if it is not linear."""
    parts = _linear(tree, set(unknowns)) if isinstance(tree, Add) else None
    if parts is None:
        return tree
    coefficients, rest = parts
    made = [mul(factored(add(*coefficients[x])), x) for x in unknowns if x in coefficients]
    return add(*made, *rest)


def pythagorean(tree: Tree) -> Tree:
    """A sum in which sin²α and cos²α with the same factors have become one: a sin²α + b + a cos²α is a + b."""
    if not isinstance(tree, Add):
        return tree
    terms = [_split(term) for term in tree.terms]
    while pair := next(filter(_is_circle, itertools.combinations(terms, 2)), None):
        terms = [term for term in terms if term not in pair] + [_radius(*pair)]
    return add(*map(_joined, terms))


def without_circles(tree: Tree) -> Tree:
    """The expression with ``pythagorean`` applied to every sum in it."""
    match tree:
        case Add(terms):
            return pythagorean(add(*map(without_circles, terms)))
        case Mul(factors):
            return mul(*map(without_circles, factors))
        case Pow(base, exponent):
            return power(without_circles(base), exponent)
    return tree


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


def _radius(first: Term, second: Term) -> Term:
    """The sum of two such terms."""
    (size, powers), rest = first, second[1]
    return size, {f: min(e, rest[f]) for f, e in powers.items() if f in rest and min(e, rest[f])}


def _linear(tree: Add, unknowns: set[Sym]) -> tuple[Mapping[Sym, list[Tree]], list[Tree]] | None:
    coefficients: dict[Sym, list[Tree]] = {}
    rest: list[Tree] = []
    for term in tree.terms:
        held = symbols(term) & unknowns
        factors = list(term.factors) if isinstance(term, Mul) else [term]
        if not held:
            rest.append(term)
        elif len(held) == 1 and (x := next(iter(held))) in factors:
            factors.remove(x)
            if x in symbols(*factors):
                return None
            coefficients.setdefault(x, []).append(mul(*factors))
        else:
            return None
    return coefficients, rest


def _split(term: Tree) -> Term:
    size: Fraction | float = Fraction(1)
    powers: Powers = {}
    for factor in term.factors if isinstance(term, Mul) else (term,):
        if isinstance(factor, Num):
            size *= factor.value
        elif isinstance(factor, Pow):
            powers[factor.base] = powers.get(factor.base, Fraction(0)) + factor.exponent
        else:
            powers[factor] = powers.get(factor, Fraction(0)) + 1
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
        least = min(map(abs, sizes))
        multiples = least > 0 and all(isinstance(_whole(float(size / least)), Fraction) for size in sizes)
        return sign * _whole(least) if multiples else Fraction(sign)
    above = math.gcd(*(abs(size.numerator) for size in sizes))
    below = {size.denominator for size in sizes}
    return sign * Fraction(above, below.pop() if len(below) == 1 else 1)


def _square(terms: Sequence[Term]) -> Tree | None:
    """(Σ k x)² if that is what the terms are."""
    roots = [(c, next(iter(p))) for c, p in terms if len(p) == 1 and set(p.values()) == {2}]
    n = len(roots)
    if n < 2 or len(terms) != n * (n + 1) // 2 or any(_root(size) is None for size, _ in roots):
        return None
    cross = {frozenset(p): c for c, p in terms if len(p) == 2 and set(p.values()) == {1}}
    first = roots[0]
    sized = [(_signed(first, root, cross), root[1]) for root in roots]
    wanted = {frozenset((a, b)): 2 * p * q for i, (p, a) in enumerate(sized) for q, b in sized[:i]}
    return power(add(*(mul(number(c), x) for c, x in sized)), 2) if cross == wanted else None


def _signed(first: tuple, root: tuple, cross: Mapping[frozenset, Fraction | float]) -> Fraction:
    size = _root(root[0]) or Fraction(0)
    return -size if root is not first and cross.get(frozenset((first[1], root[1])), 0) < 0 else size


def _root(value: Fraction | float) -> Fraction | None:
    if not isinstance(value, Fraction) or value <= 0:
        return None
    above, below = math.isqrt(value.numerator), math.isqrt(value.denominator)
    exact = above * above == value.numerator and below * below == value.denominator
    return Fraction(above, below) if exact else None


def _joined(term: Term) -> Tree:
    size, powers = term
    return mul(number(size), *(power(factor, exponent) for factor, exponent in powers.items()))
