"""Edits of an equation that a slip of the pen would need, to be tried one by one."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, product
from typing import TypeVar

from freebody.symbolic.dimensions import LENGTH, NUMBER_ONLY
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
    walk,
)

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
"""By how much edits of a kind are larger than 1; those within ``search.EQUAL`` are equally small."""
FIGURES = (1.0, 2.0, 3.0, 4.0, 6.0, 12.0)
"""Whole numbers that are mistaken for each other."""
_ONE = Num(1.0, "1")
_SWAPS = {"sin": ("cos",), "cos": ("sin",), "tan": ("sin", "cos"), "asin": ("acos",), "acos": ("asin",)}
OTHER = {"sin": "cos", "cos": "sin"}


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
            if function in OTHER:
                yield from (
                    ("function", Add((_ONE, Negative(Fn(each, (argument,)))), **at)) for each in (function, OTHER[function])
                )
            kind = "factor" if function == "sqrt" else "angle"
            yield from ((kind, Fn(function, (angle,), **at)) for angle in _angles(argument, vocabulary))
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
    totals = [f for f in factors if isinstance(f, Add) and f.symbols <= {*vocabulary.parameters}]
    motions = [(f, f.base if isinstance(f, Pow) else f) for f in factors]
    yield from _own_arms(factors, totals, vocabulary, span)
    for (factor, motion), total in product(motions, totals):
        moves = isinstance(motion, Sym) and motion not in vocabulary.parameters
        for other in vocabulary.motions_like(motion) if moves else ():
            moved = replace(factor, base=other) if isinstance(factor, Pow) else other
            for alone in total.terms:
                parts = ((mass, moved if mass is alone else factor) for mass in total.terms)
                each = (tuple(m if f is total else x if f is factor else f for f in factors) for m, x in parts)
                yield Add(tuple(map(Mul, each)), span=span)


def _own_arms(factors: tuple[Node, ...], totals: Sequence[Add], vocabulary: Vocabulary, span: tuple[int, int]) -> Iterator[Node]:
    """Inertias that were taken to turn as one, as on a rope that does not stretch: J θ̈ + m r ÿ for (J + m r²) θ̈."""
    lengths = {n for n, its in vocabulary.parameters.items() if its == LENGTH}
    turning = [f for f in factors if isinstance(f, Sym) and Sym(f.name) in vocabulary.coordinates and f.dots == 2]
    linear = [Sym(n.name, 2) for n, its in vocabulary.coordinates.items() if its == LENGTH]
    for total, motion, other in product(totals, turning, linear):
        for term in total.terms:
            arm = next((n for n in walk(term) if isinstance(n, Pow) and n.base in lengths and n.exponent == Num(2.0, "2")), None)
            if arm is not None:
                own = Mul((exchange(term, arm, arm.base), other))
                yield Add(tuple(own if t is term else Mul((t, motion)) for t in total.terms), span=span)


def _of_sums(terms: tuple[Node, ...], span: tuple[int, int]) -> Iterator[tuple[str, Node]]:
    """The square of a sum for the sum of squares, and one fraction for those of each: what is not linear, taken term by term."""
    match terms:
        case (Num(value=1.0), Negative(of=Fn(name="sin" | "cos" as name, args=args))):  # how far it is below another place
            yield from (("function", Fn(other, args, span=span)) for other in (OTHER[name], name))
    calls = {n: Fn(OTHER[n.name], n.args) for n in walk(Add(terms)) if isinstance(n, Fn) and n.name in OTHER}
    if len(calls) > 1 and len({n.name for n in calls}) == 1:  # how far it moves along the other direction
        turned = exchanged(Add(terms, span=span), calls)
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
    calls = dict.fromkeys(n for n in walk(whole) if isinstance(n, Fn) and n.name in OTHER)
    for args in dict.fromkeys(n.args for n in calls):
        own = [n for n in calls if n.args == args]
        if len(own) > 1:
            for angle in (angle for angle in vocabulary.angles if (angle,) != args):
                yield exchanged(whole, {n: Fn(n.name, (angle,)) for n in own})


def _are_components(one: Node, other: Node) -> bool:
    """Whether two terms have the cosine and the sine of an angle, as what lies along a direction has them."""
    calls = ({n for n in walk(term) if isinstance(n, Fn) and n.name in OTHER} for term in (one, other))
    (first, *more), (second, *others) = (tuple(found) or (None,) for found in calls)
    return bool(first and second) and not more and not others and Fn(OTHER[first.name], first.args) == second


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


def exchanged(tree: N, changes: Mapping[Node, Node]) -> N:
    """A tree with others for all parts that are one of some."""
    for part in [n for n in walk(tree) if n in changes]:
        tree = exchange(tree, part, changes[part])
    return tree
