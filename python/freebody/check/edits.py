"""Edits of an equation that a slip of the pen would need, to be tried one by one."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import combinations, product
from typing import TypeVar

from freebody.symbolic.dimensions import LENGTH, MASS, NUMBER_ONLY, Dimension
from freebody.symbolic.tree import (
    Add,
    Column,
    Cross,
    Dot,
    Fn,
    Matrix,
    Mul,
    Negative,
    Node,
    Num,
    Pow,
    Quotient,
    Sym,
    children,
    exchange,
    is_zero,
    substitute,
    walk,
)

from .language.dimensions import dimension
from .language.spelling import spell
from .language.statements import Equation
from .vocabulary import Vocabulary

N = TypeVar("N", bound=Node)
_LARGER = {
    "symbol": 0.05,
    "rates": 0.05,
    "extra factor": 0.1,
    "missing factor": 0.1,
    "extra term": 0.1,
    "missing term": 0.2,
    "convention": 0.1,
    "exchange": 0.1,
    "squares": 0.2,
    "share": 0.3,
    "components": 0.3,
    "other term": 1.3,
}
"""By how much edits of a kind are larger than 1; those within ``correction.EQUAL`` are equally small."""
_HALF = 0.05
"""By how much it is less likely that a mass is half of what it is than that it is there twice."""
_MOST_CALLS = 6
"""Sines and cosines of an angle, of which two are exchanged."""
FIGURES = (1.0, 2.0, 3.0, 4.0, 6.0, 12.0)
"""Whole numbers that are mistaken for each other."""
_ONE = Num(1.0, "1")
_SWAPS = {"sin": ("cos",), "cos": ("sin",), "tan": ("sin", "cos")}
_OTHER = {"sin": "cos", "cos": "sin"}
_UNSIGNED = (LENGTH, MASS, Dimension(2, 1))
"""Dimensions of lengths, masses and moments of inertia, which have no sense."""
_OF_BODIES = ((1.0, 12.0), (1.0, 4.0), (1.0, 3.0), (2.0, 5.0), (1.0, 2.0), (2.0, 3.0), (3.0, 2.0), (1.0, 1.0))
"""Numbers of moments of inertia and of kinetic energies."""


@dataclass(frozen=True)
class Edit:
    """``old`` (None: nothing was there) becomes ``new`` (None: nothing is left) in an equation that is then ``after``."""

    kind: str
    old: Node | None
    new: Node | None
    after: Equation
    extra: float = 0.0
    words: str = ""
    shown: Equation | None = None  # how the equation is printed, if not as it is evaluated

    @classmethod
    def at(cls, equation: Equation, kind: str, old: Node, new: Node, extra: float = 0.0) -> Edit:
        """The edit of one part of an equation."""
        return cls(kind, old, new, exchange(equation, old, new), extra)

    @property
    def size(self) -> float:
        """How large it is, smaller first."""
        return 1.0 + _LARGER.get(self.kind, 0.0) + self.extra


def edits(equation: Equation, vocabulary: Vocabulary) -> Iterator[Edit]:
    """Single edits that need no number to be found."""
    for node, addend in _parts(equation):
        yield from (Edit.at(equation, kind, node, new) for kind, new in _changes(node, vocabulary))
        if addend:
            yield Edit.at(equation, "sign", node, node.of if isinstance(node, Negative) else Negative(node, span=node.span))
            yield Edit("extra term", node, None, exchange(equation, node, Num(0.0, "0")))


def forgotten_factors(equation: Equation, vocabulary: Vocabulary) -> Iterator[Edit]:
    """Single edits by which a term gets a factor."""
    for factors, size in ((vocabulary.single_factors, 0.0), (vocabulary.double_factors, 0.2)):
        for node in (node for node, addend in _parts(equation) if addend):
            yield from (Edit.at(equation, "missing factor", node, Mul((node, f), span=node.span), size) for f in factors)


def other_figures(equation: Equation) -> Iterator[Edit]:
    """Figures that are mistaken for each other, and a term doubled or halved: first steps of two."""
    two = Num(2.0, "2")
    for node, addend in _parts(equation):
        if isinstance(node, Num) and node.value in FIGURES:
            others = (Num(value, f"{value:g}", span=node.span) for value in FIGURES if value != node.value)
            yield from (Edit.at(equation, "factor", node, other) for other in others)
        elif addend and not any(isinstance(n, Num) for n in walk(node)):
            yield Edit.at(equation, "factor", node, Mul((two, node), span=node.span))
            yield Edit.at(equation, "factor", node, Quotient(node, two, span=node.span))


def _parts(equation: Equation) -> list[tuple[Node, bool]]:
    """Every part once, and whether it is added to something; sides first, then their terms, and so on inwards."""
    sums = [node for node in walk(equation) if isinstance(node, Equation | Add | Column | Matrix)]
    addends = {id(part) for node in sums for part in children(node) if isinstance(node, Add) or not isinstance(part, Add)}
    parts: dict[int, Node] = {}
    level = list(children(equation))
    while level:
        parts |= {id(node): node for node in level if not is_zero(node)}
        level = [part for node in level for part in children(node)]
    return [(node, key in addends) for key, node in parts.items()]


def _changes(node: Node, vocabulary: Vocabulary) -> Iterator[tuple[str, Node]]:
    at = {"span": node.span}
    match node:
        case Sym(name=name, dots=dots):
            yield from (("symbol", Sym(other.name, other.dots, **at)) for other in vocabulary.alike(node))
            if Sym(name) in vocabulary.coordinates:
                yield from (("derivative", Sym(name, n, **at)) for n in range(3) if n != dots)
            if node in vocabulary.vectors:
                yield "sign", Negative(node, **at)
                yield from (("symbol", Negative(other, **at)) for other in vocabulary.alike(node))
        case Fn(name=function, args=(argument,)):
            yield from (("function", Fn(other, (argument,), **at)) for other in _SWAPS.get(function, ()))
            if function in _OTHER:
                yield from (
                    ("function", Add((_ONE, Negative(Fn(each, (argument,)))), **at)) for each in (function, _OTHER[function])
                )
            yield from (("angle", Fn(function, (angle,), **at)) for angle in _angles(argument, vocabulary))
        case Pow(base=base, exponent=Num(value=n)):
            yield from (("power", Pow(base, Num(m, f"{m:g}"), **at)) for m in (n - 1, n + 1) if m > 1)
            yield "power", base
            yield from _rates(base, n, vocabulary)
        case Mul(factors=(Sym(dots=1) as a, Sym(dots=1) as b)):
            yield from (("rates", Pow(x, Num(2.0, "2"), **at)) for x in (a, b))
        case Mul(factors=factors):
            kept = [factors[:i] + factors[i + 1 :] for i in range(len(factors))]
            yield from (("extra factor", Mul(rest, **at) if len(rest) > 1 else rest[0]) for rest in kept)
            yield from (("brackets", new) for new in _below(factors, node.span))
            yield from (("symbol", new) for new in _own_motions(factors, vocabulary, node.span))
        case Quotient(top=top, bottom=bottom):
            yield "extra factor", top
            yield "missing factor", Mul((top, bottom), **at)
            if isinstance(bottom, Add):
                yield "inverses", Add(tuple(_over(top, term) for term in bottom.terms), **at)
        case Add(terms=terms):
            yield from _of_sums(terms, node.span)
            yield from (("angle", new) for new in _along_another(node, vocabulary))
        case Num(value=math.pi):
            yield "power", Pow(node, Num(2.0, "2"), **at)
        case Cross(left=left, right=right):
            yield "sign", Cross(right, left, **at)
            yield "function", Dot(left, right, **at)
        case Dot(left=left, right=right):
            yield "function", Cross(left, right, **at)
    if _is_rate(node, vocabulary):
        yield "power", Pow(node, Num(2.0, "2"), **at)


def _below(factors: tuple[Node, ...], span: tuple[int, int]) -> Iterator[Node]:
    """What stands behind a fraction taken into its denominator: 3g/2l for 3g/(2 l)."""
    for i, factor in enumerate(factors[:-1]):
        if isinstance(factor, Quotient):
            for end in range(i + 2, len(factors) + 1):
                fraction = Quotient(factor.top, Mul((factor.bottom, *factors[i + 1 : end])), span=span)
                rest = (*factors[:i], fraction, *factors[end:])
                yield Mul(rest, span=span) if len(rest) > 1 else fraction


def _own_motions(factors: tuple[Node, ...], vocabulary: Vocabulary, span: tuple[int, int]) -> Iterator[Node]:
    """Masses that were taken to move as one: M v² + m ẏ² for (M + m) v²."""
    totals = [f for f in factors if isinstance(f, Add) and all(n in vocabulary.parameters for n in f.terms)]
    motions = [(f, f.base if isinstance(f, Pow) else f) for f in factors]
    for (factor, motion), total in product(motions, totals):
        moves = isinstance(motion, Sym) and motion not in vocabulary.parameters
        for other in vocabulary.motions_like(motion) if moves else ():
            moved = replace(factor, base=other) if isinstance(factor, Pow) else other
            for alone in total.terms:
                parts = ((mass, moved if mass is alone else factor) for mass in total.terms)
                each = (tuple(m if f is total else x if f is factor else f for f in factors) for m, x in parts)
                yield Add(tuple(map(Mul, each)), span=span)


def _of_sums(terms: tuple[Node, ...], span: tuple[int, int]) -> Iterator[tuple[str, Node]]:
    """The square of a sum for the sum of squares, and one fraction for those of each: what is not linear, taken term by term."""
    match terms:
        case (Num(value=1.0), Negative(of=Fn(name="sin" | "cos" as name, args=args))):  # how far it is below another place
            yield from (("function", Fn(other, args, span=span)) for other in (_OTHER[name], name))
    calls = {n: Fn(_OTHER[n.name], n.args) for n in walk(Add(terms)) if isinstance(n, Fn) and n.name in _OTHER}
    if len(calls) > 1 and len({n.name for n in calls}) == 1:  # how far it moves along the other direction
        turned = _exchanged(Add(terms, span=span), calls)
        yield from (("function", new) for new in (turned, Negative(turned, span=span)))
    if len(terms) > 2:
        for one, other in combinations(terms, 2):
            if _are_components(one, other):
                yield "sign", Add(tuple(Negative(t) if t is one or t is other else t for t in terms), span=span)
    two = Num(2.0, "2")
    if all(isinstance(term, Pow) and term.exponent == two for term in terms):
        yield "power", Pow(Add(tuple(term.base for term in terms if isinstance(term, Pow))), two, span=span)
    if all(isinstance(term, Quotient) for term in terms):
        tops, bottoms = zip(*((term.top, term.bottom) for term in terms if isinstance(term, Quotient)), strict=True)
        if all(top == tops[0] for top in tops):
            yield "inverses", Quotient(tops[0], Add(bottoms), span=span)


def _along_another(whole: Add, vocabulary: Vocabulary) -> Iterator[Node]:
    """A sum of what lies along a direction, resolved along another: every sine and cosine of one angle, of that."""
    calls = dict.fromkeys(n for n in walk(whole) if isinstance(n, Fn) and n.name in _OTHER)
    for args in dict.fromkeys(n.args for n in calls):
        own = [n for n in calls if n.args == args]
        if len(own) > 1:
            for angle in (angle for angle in vocabulary.angles if (angle,) != args):
                yield _exchanged(whole, {n: Fn(n.name, (angle,)) for n in own})


def _are_components(one: Node, other: Node) -> bool:
    """Whether two terms have the cosine and the sine of an angle, as what lies along a direction has them."""
    calls = ({n for n in walk(term) if isinstance(n, Fn) and n.name in _OTHER} for term in (one, other))
    (first, *more), (second, *others) = (tuple(found) or (None,) for found in calls)
    return bool(first and second) and not more and not others and Fn(_OTHER[first.name], first.args) == second


def _over(top: Node, bottom: Node) -> Node:
    return Negative(Quotient(top, bottom.of)) if isinstance(bottom, Negative) else Quotient(top, bottom)


def _is_rate(node: Node, vocabulary: Vocabulary) -> bool:
    """Whether it is the rate of a coordinate, or some of them added."""
    match node:
        case Sym(name=name, dots=1):
            return Sym(name) in vocabulary.coordinates
        case Add(terms=terms):
            return all(_is_rate(term, vocabulary) for term in terms)
        case Negative(of=of):
            return _is_rate(of, vocabulary)
    return False


def _rates(base: Node, n: float, vocabulary: Vocabulary) -> Iterator[tuple[str, Node]]:
    """A rate squared that should be a product of two, or an acceleration."""
    if n == 2 and isinstance(base, Sym) and base.dots == 1:
        speeds = [n for n in vocabulary.motions_like(base) if n.dots < 2]
        yield from (("rates", Mul((base, other), span=base.span)) for other in speeds)
        two = Num(2.0, "2")
        for other in speeds:
            yield from (("symbol", Pow(Add((base, o)), two, span=base.span)) for o in (other, Negative(other)))
        yield "derivative", Sym(base.name, 2, span=base.span)


def _angles(argument: Node, vocabulary: Vocabulary) -> Iterator[Node]:
    """Other angles: each symbol, sums and differences of two, twice and half of what is there."""
    known = vocabulary.angles
    yield from (angle for angle in known if angle != argument)
    for i, a in enumerate(known):
        for b in known[i + 1 :]:
            yield from (Add((a, b)), Add((a, Negative(b))))
            if not isinstance(argument, Sym):
                yield Add((b, Negative(a)))
    if not isinstance(argument, Num):  # pairs of poles, waves round a circle
        counts = (n for n, its in vocabulary.parameters.items() if its == NUMBER_ONLY and n not in vocabulary.angular)
        yield from (Mul((count, argument)) for count in counts if count not in argument.symbols)
    if isinstance(argument, Add):
        yield from (Add((*argument.terms, a)) for b in known for a in (b, Negative(b)))
    yield Mul((Num(2.0, "2"), argument))
    yield Quotient(argument, Num(2.0, "2"))


def with_unit_vectors(equation: Equation, units: tuple[Sym, ...]) -> Iterator[Edit]:
    """A number beside vectors that lacks its direction, or a vector that should be a component."""
    for node, _ in _parts(equation):
        for unit in units:
            for new in (Mul((node, unit), span=node.span), Dot(node, unit, span=node.span)):
                yield Edit.at(equation, "unit vector", node, new)


def depth(node: Node) -> int:
    """How many parts a tree has."""
    return sum(1 for _ in walk(node))


# -- of the whole equation at once: what a symbol measures, and in which sense


def conventions(equation: Equation, vocabulary: Vocabulary) -> Iterator[Edit]:
    """Symbols of the other sense, and two symbols exchanged.

    A symbol that stands once is left to the edits of its place.
    """
    yield from _products(equation)
    yield from _functions(equation)
    yield from _powers(equation, vocabulary)
    yield from _energies(equation, vocabulary)
    yield from _inertias(equation)
    yield from _sizes(equation, vocabulary)
    found = [n for n in walk(equation) if isinstance(n, Sym)]
    often = [name for name in dict.fromkeys(n.name for n in found) if sum(n.name == name for n in found) > 1]
    for name in often:
        plain = Sym(name)
        if plain not in vocabulary.vectors and vocabulary.parameters.get(plain) not in _UNSIGNED:
            yield _convention(equation, {n: Negative(n) for n in _with_rates(name)}, f"`{name}` taken in the other sense")
    moving = [n for n in dict.fromkeys(found) if n.dots and Sym(n.name) in vocabulary.coordinates]
    for a, b in (
        (a, b) for a, b in combinations(moving, 2) if a.dots == b.dots and vocabulary.dimension(a) == vocabulary.dimension(b)
    ):
        yield _convention(equation, {a: Sym(b.name, b.dots), b: Sym(a.name, a.dots)}, f"`{a.key}` and `{b.key}` exchanged")
    pairs = [(n, o.name) for n in often for o in vocabulary.alike(Sym(n)) if n < o.name and o.name in often]
    given = [n for n in dict.fromkeys(found) if n in vocabulary.parameters]
    pairs += [(a.name, b.name) for a, b in combinations(given, 2)]
    for one, two in pairs:
        swapped = dict(zip(_with_rates(one) + _with_rates(two), _with_rates(two) + _with_rates(one), strict=True))
        yield _convention(equation, swapped, f"`{one}` and `{two}` exchanged")


def _convention(equation: Equation, changes: Mapping[Sym, Node], words: str) -> Edit:
    return Edit("convention", None, None, substitute(equation, changes), words=words)


def _everywhere(equation: Equation, changes: Mapping[Node, Node], words: str) -> Edit:
    """The edit of all parts that are one of some."""
    return Edit("convention", None, None, _exchanged(equation, changes), words=words)


def _exchanged(tree: N, changes: Mapping[Node, Node]) -> N:
    for part in [n for n in walk(tree) if n in changes]:
        tree = exchange(tree, part, changes[part])
    return tree


def _with_rates(name: str) -> list[Sym]:
    return [Sym(name, dots) for dots in range(3)]


def _products(equation: Equation) -> Iterator[Edit]:
    """Every cross product a scalar product, and the other way round."""
    for kind, other, words in ((Cross, Dot, "`·` for every `×`"), (Dot, Cross, "`×` for every `·`")):
        after = equation
        while (old := next((n for n in walk(after) if isinstance(n, kind)), None)) is not None:
            after = exchange(after, old, other(old.left, old.right, span=old.span))
        if after is not equation:
            yield Edit("convention", None, None, after, words=words)


def _functions(equation: Equation) -> Iterator[Edit]:
    """Sine and cosine of an angle exchanged wherever they stand, where they do more than once, or those of two terms."""
    calls = [n for n in walk(equation) if isinstance(n, Fn) and n.name in _OTHER]
    for angle in dict.fromkeys(n.args for n in calls):
        found = [n for n in calls if n.args == angle]
        if len(found) > 1:
            changes = {n: Fn(_OTHER[n.name], angle) for n in found}
            yield _everywhere(equation, changes, f"`sin` and `cos` of `{spell(angle[0])}` exchanged")
        for one, two in combinations(found, 2) if 2 < len(found) <= _MOST_CALLS else ():
            if one.name != two.name:
                after = exchange(exchange(equation, one, changes[one]), two, changes[two])
                yield Edit("convention", None, None, after, words=f"`{spell(one)}` and `{spell(two)}` exchanged")


def _powers(equation: Equation, vocabulary: Vocabulary) -> Iterator[Edit]:
    """Every square of a length the length itself, as where a momentum is written like an energy, and the other way round in a sum."""
    lengths = {n for n, its in vocabulary.parameters.items() if its == LENGTH}
    squares = {n: n.base for n in walk(equation) if isinstance(n, Pow) and n.base in lengths and n.exponent == Num(2.0)}
    if len(squares) > 1:
        yield _everywhere(equation, squares, "lengths that are squared, each by itself")
    for whole in (n for n in walk(equation) if isinstance(n, Add)):
        said = {n: Pow(n, Num(2.0, "2")) for n in walk(whole) if n in lengths}
        if len(said) > 1 and not any(isinstance(n, Pow) and n.base in said for n in walk(whole)):
            yield Edit.at(equation, "power", whole, _exchanged(whole, said))


def _energies(equation: Equation, vocabulary: Vocabulary) -> Iterator[Edit]:
    """½ of each kinetic energy, or twice."""
    squared = lambda n: any(isinstance(p, Pow) and p.exponent == Num(2.0) and _is_speed(p.base, vocabulary) for p in walk(n))
    sides = ((side.terms if isinstance(side, Add) else (side,)) for side in (equation.left, equation.right))
    found = [term for side in sides for term in side if squared(term)]
    if len(found) > 1:
        for words, change in (("½ of", lambda n: Quotient(n, Num(2.0, "2"))), ("twice", lambda n: Mul((Num(2.0, "2"), n)))):
            yield _everywhere(equation, {term: change(term) for term in found}, f"{words} each kinetic energy")


def _is_speed(node: Node, vocabulary: Vocabulary) -> bool:
    its = dimension(node, vocabulary.dimensions)
    return its is not None and its.mass == 0 and its.time == -1


def _inertias(equation: Equation) -> Iterator[Edit]:
    """A number that stands more than once, each time another: that of an inertia, or ½."""
    found = [n for n in walk(equation) if _is_number(n)]
    for one in dict.fromkeys(n for n in found if found.count(n) > 1):
        for above, below in _OF_BODIES:
            other: Node = Quotient(Num(above, f"{above:g}"), Num(below, f"{below:g}")) if below != 1 else Num(above, f"{above:g}")
            if other != one:
                yield _everywhere(equation, {one: other}, f"`{spell(one)}` should be `{spell(other)}` each time")


def _is_number(node: Node) -> bool:
    """Whether it is a fraction of two figures."""
    return isinstance(node, Quotient) and isinstance(node.top, Num) and isinstance(node.bottom, Num)


def _sizes(equation: Equation, vocabulary: Vocabulary) -> Iterator[Edit]:
    """A quantity of the model that stands more than once, each time half or twice, as radius and diameter, or one of two alike, or another
    length."""
    known = vocabulary.parameters
    found = [n for n in walk(equation) if isinstance(n, Sym) and known.get(n) not in (None, NUMBER_ONLY) and n.name != "g"]
    for one in dict.fromkeys(n for n in found if found.count(n) > 1):
        others = vocabulary.alike(one) if known[one] == LENGTH else []
        for other in (Mul((Num(2.0, "2"), one)), Quotient(one, Num(2.0, "2")), *others):
            edit = _everywhere(equation, {one: other}, f"`{spell(one)}` should be `{spell(other)}` each time")
            yield replace(edit, extra=_HALF * (isinstance(other, Quotient) and known[one] != LENGTH))
