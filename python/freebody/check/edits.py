"""Single edits of an equation: those that a slip of the pen would need, to be tried one by one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain

from freebody.symbolic.evaluate import is_zero
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
    walk,
)

from .language.statements import Equation
from .vocabulary import Vocabulary

SIZES = {
    "sign": 1.0,
    "function": 1.0,
    "letter": 1.0,
    "angle": 1.0,
    "derivative": 1.0,
    "factor": 1.0,
    "power": 1.0,
    "rates": 1.0,
    "brackets": 1.0,
    "unit vector": 1.0,
    "extra factor": 1.1,
    "missing factor": 1.1,
    "extra term": 1.1,
    "missing term": 1.2,
    "convention": 1.1,
    "other term": 2.0,
}
"""How large each kind of edit is; those within ``mend.EQUAL`` are equally small."""

_FIGURES = (1.0, 2.0, 3.0, 4.0, 6.0, 12.0)
_SWAPS = {"sin": ("cos",), "cos": ("sin",), "tan": ("sin", "cos")}


@dataclass(frozen=True)
class Edit:
    """``old`` (None: nothing was there) becomes ``new`` (None: nothing is left) in an equation that is then ``after``."""

    kind: str
    old: Node | None
    new: Node | None
    after: Equation
    extra: float = 0.0
    words: str = ""

    @property
    def size(self) -> float:
        """How large it is, smaller first."""
        return SIZES[self.kind] + self.extra


def edits(equation: Equation, vocabulary: Vocabulary) -> Iterator[Edit]:
    """All single edits that need no number to be found."""
    for node, addend in _parts(equation):
        for kind, new in _changes(node, vocabulary):
            yield Edit(kind, node, new, exchange(equation, node, new))
        if addend:
            opposite = node.of if isinstance(node, Negative) else Negative(node, span=node.span)
            yield Edit("sign", node, opposite, exchange(equation, node, opposite))
            yield from _fewer(equation, node)
            yield from _more(equation, node, vocabulary)


def other_figures(equation: Equation) -> Iterator[Edit]:
    """Figures that are mistaken for each other, and a term doubled or halved: first steps of two."""
    for node, addend in _parts(equation):
        if isinstance(node, Num) and node.value in _FIGURES:
            for value in _FIGURES:
                if value != node.value:
                    new = Num(value, f"{value:g}", span=node.span)
                    yield Edit("factor", node, new, exchange(equation, node, new))
        elif addend and not any(isinstance(n, Num) for n in walk(node)):
            for new in (Mul((Num(2.0, "2"), node), span=node.span), Quotient(node, Num(2.0, "2"), span=node.span)):
                yield Edit("factor", node, new, exchange(equation, node, new))


def _parts(equation: Equation) -> Iterator[tuple[Node, bool]]:
    """Every part once, and whether it is added to something."""
    addends = {id(side) for side in (equation.left, equation.right) if not isinstance(side, Add)}
    for node in walk(equation):
        if isinstance(node, Add):
            addends |= {id(term) for term in node.terms}
        if isinstance(node, Column):
            addends |= {id(item) for item in node.items if not isinstance(item, Add)}
        if isinstance(node, Matrix):
            addends |= {id(item) for row in node.rows for item in row if not isinstance(item, Add)}
    seen: set[int] = set()
    for node in walk(equation):
        if node is not equation and id(node) not in seen and not is_zero(node):
            seen.add(id(node))
            yield node, id(node) in addends


def _changes(node: Node, vocabulary: Vocabulary) -> Iterator[tuple[str, Node]]:
    at = {"span": node.span}
    match node:
        case Sym(name=name, dots=dots):
            yield from (("letter", Sym(other.name, other.dots, **at)) for other in vocabulary.alike(node))
            if Sym(name) in vocabulary.coordinates:
                yield from (("derivative", Sym(name, n, **at)) for n in range(3) if n != dots)
            if node in vocabulary.vectors:
                yield "sign", Negative(node, **at)
                yield from (("letter", Negative(other, **at)) for other in vocabulary.alike(node))
        case Fn(name=function, args=(argument,)):
            yield from (("function", Fn(other, (argument,), **at)) for other in _SWAPS.get(function, ()))
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
        case Quotient(top=top, bottom=bottom):
            yield "extra factor", top
            yield "missing factor", Mul((top, bottom), **at)
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
        same = vocabulary.dimension(base)
        speeds = [n for n in vocabulary.others if same is not None and vocabulary.dimension(n) == same]
        yield from (("rates", Mul((base, other), span=base.span)) for other in (*vocabulary.alike(base), *speeds))
        yield "derivative", Sym(base.name, 2, span=base.span)


def _angles(argument: Node, vocabulary: Vocabulary) -> Iterator[Node]:
    """Other angles: each letter, sums and differences of two, twice and half of what is there."""
    known = vocabulary.angles
    yield from (angle for angle in known if angle != argument)
    for i, a in enumerate(known):
        for b in known[i + 1 :]:
            yield from (Add((a, b)), Add((a, Negative(b))))
            if not isinstance(argument, Sym):
                yield Add((b, Negative(a)))
    if isinstance(argument, Add):
        yield from (Add((*argument.terms, a)) for b in known for a in (b, Negative(b)))
    yield Mul((Num(2.0, "2"), argument))
    yield Quotient(argument, Num(2.0, "2"))


def _fewer(equation: Equation, node: Node) -> Iterator[Edit]:
    """Without a term."""
    yield Edit("extra term", node, None, exchange(equation, node, Num(0.0, "0")))


def _more(equation: Equation, node: Node, vocabulary: Vocabulary) -> Iterator[Edit]:
    """A term with a factor more."""
    for extra, more in chain(((n, 0.0) for n in vocabulary.single_factors), ((n, 0.2) for n in vocabulary.double_factors)):
        new = Mul((node, extra), span=node.span)
        yield Edit("missing factor", node, new, exchange(equation, node, new), more)


def with_unit_vectors(equation: Equation, units: tuple[Sym, ...]) -> Iterator[Edit]:
    """A number beside vectors that lacks its direction, or a vector that should be a component."""
    for node, _ in _parts(equation):
        for unit in units:
            for new in (Mul((node, unit), span=node.span), Dot(node, unit, span=node.span)):
                yield Edit("unit vector", node, new, exchange(equation, node, new))


def depth(node: Node) -> int:
    """How many parts a tree has."""
    return 1 + sum(depth(child) for child in children(node))
