"""What a person wrote, as a tree. Every node knows its place in the text (``span``), which does not count in comparisons."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, fields
from dataclasses import replace as _with
from functools import cache
from typing import TypeVar

from .errors import Span


@dataclass(frozen=True)
class Node:
    """A piece of a statement; ``span`` is its start and end in the text, in characters."""

    span: Span = field(default=(0, 0), compare=False, kw_only=True)


@dataclass(frozen=True)
class Number(Node):
    """A number, with the digits as written."""

    value: float
    text: str = field(default="", compare=False)


@dataclass(frozen=True)
class Unit(Node):
    """A unit behind a number or a bracket, as a factor: its size in SI."""

    size: float
    text: str


@dataclass(frozen=True)
class Letter(Node):
    """A letter with its number of time derivatives. The name is the declared one, or as written where it is not known."""

    name: str
    dots: int = 0

    @property
    def key(self) -> str:
        """How values are named: ``theta``, ``thetadot``, ``thetaddot``."""
        return self.name + ("d" * (self.dots - 1) + "dot" if self.dots else "")


@dataclass(frozen=True)
class Sum(Node):
    """Terms added; what is taken away is a ``Negative``."""

    terms: tuple[Node, ...]


@dataclass(frozen=True)
class Product(Node):
    """Factors multiplied, from left to right."""

    factors: tuple[Node, ...]


@dataclass(frozen=True)
class Quotient(Node):
    """Top over bottom."""

    top: Node
    bottom: Node


@dataclass(frozen=True)
class Power(Node):
    """A power."""

    base: Node
    exponent: Node


@dataclass(frozen=True)
class Negative(Node):
    """The opposite."""

    of: Node


@dataclass(frozen=True)
class Call(Node):
    """A function of numbers: sin, cos, tan, sqrt, …"""

    function: str
    arguments: tuple[Node, ...]


@dataclass(frozen=True)
class Cross(Node):
    """The sign ×: the cross product of vectors; between numbers, times."""

    left: Node
    right: Node


@dataclass(frozen=True)
class Dot(Node):
    """The sign ·: the scalar product of vectors; otherwise, times."""

    left: Node
    right: Node


@dataclass(frozen=True)
class Column(Node):
    """A column of numbers, written (a, b)."""

    items: tuple[Node, ...]


@dataclass(frozen=True)
class Matrix(Node):
    """Rows of numbers, written [a, b; c, d]."""

    rows: tuple[tuple[Node, ...], ...]


@dataclass(frozen=True)
class Partial(Node):
    """∂L/∂θ̇: how a name that a line gives changes with one letter; written out once all lines are read."""

    of: Letter
    by: Letter


@dataclass(frozen=True)
class Rate(Node):
    """The derivative by time of what has partial derivatives in it; written out with them."""

    of: Node


@dataclass(frozen=True)
class Equation(Node):
    """Two sides that are said to be equal, or as ``relation`` says: ``=``, ``<=``, ``>=``, ``<``, ``>``."""

    left: Node
    right: Node
    relation: str = "="


@dataclass(frozen=True)
class Assignment(Node):
    """A line that gives a name to an expression, for the lines around it."""

    name: Letter
    expression: Node


@dataclass(frozen=True)
class Program(Node):
    """All lines of a statement, in order, and its text."""

    lines: tuple[Assignment | Equation, ...]
    text: str = field(default="", compare=False)

    @property
    def assignments(self) -> tuple[Assignment, ...]:
        """The lines that give names."""
        return tuple(line for line in self.lines if isinstance(line, Assignment))

    @property
    def equations(self) -> tuple[Equation, ...]:
        """The lines that state something."""
        return tuple(line for line in self.lines if isinstance(line, Equation))


@dataclass(frozen=True)
class Term:
    """An additive term of an equation: Σ sign × node over all terms is 0. ``side`` is ``left`` or ``right``, where it stands."""

    sign: int
    node: Node
    side: str


N = TypeVar("N", bound=Node)


@cache
def _names(kind: type[Node]) -> tuple[str, ...]:
    """The fields in which nodes can stand."""
    return tuple(f.name for f in fields(kind) if f.name not in ("span", "text"))


def children(node: Node) -> tuple[Node, ...]:
    """The nodes directly inside, in the order of the text."""
    return tuple(_nodes([getattr(node, name) for name in _names(type(node))]))


def _nodes(values: object) -> Iterator[Node]:
    if isinstance(values, Node):
        yield values
    elif isinstance(values, tuple | list):
        for value in values:
            yield from _nodes(value)


def walk(node: Node) -> Iterator[Node]:
    """The node and all that is inside, outer ones first."""
    yield node
    for child in children(node):
        yield from walk(child)


def letters(node: Node) -> list[Letter]:
    """The letters in it, each once, in the order of the text."""
    return list(dict.fromkeys(n for n in walk(node) if isinstance(n, Letter)))


def replace(node: N, old: Node, new: Node) -> N:
    """The same with ``new`` in the place of ``old``: that very node, not others that read alike."""
    if node is old:
        return new  # type: ignore[return-value]
    changed = {}
    for name in _names(type(node)):
        value = getattr(node, name)
        after = _replaced(value, old, new)
        if after is not value:
            changed[name] = after
    return _with(node, **changed) if changed else node


def _replaced(value: object, old: Node, new: Node) -> object:
    if isinstance(value, Node):
        return replace(value, old, new)
    if isinstance(value, tuple):
        after = tuple(_replaced(v, old, new) for v in value)
        return after if any(x is not y for x, y in zip(after, value, strict=True)) else value
    return value


def without_ones(node: N) -> N:
    """The same without factors 1 and denominators 1."""
    while (found := next((n for n in walk(node) if _has_one(n)), None)) is not None:
        left = [f for f in found.factors if f != _ONE] or [_ONE] if isinstance(found, Product) else [found.top]
        node = replace(node, found, left[0] if len(left) == 1 else Product(tuple(left), span=found.span))
    return node


_ONE = Number(1.0, "1")


def _has_one(node: Node) -> bool:
    return (isinstance(node, Product) and _ONE in node.factors) or (isinstance(node, Quotient) and node.bottom == _ONE)


def substitute(node: N, expressions: dict[Letter, Node]) -> N:
    """The same with an expression for each of these letters."""
    found = [n for n in walk(node) if isinstance(n, Letter) and n in expressions]
    for letter in found:
        node = replace(node, letter, expressions[letter])
    return node


def inlined(program: Program) -> tuple[Equation, ...]:
    """The equations with the assigned names written out, in whichever order the lines stand."""
    given = {line.name: line.expression for line in program.assignments}
    for _ in given:
        given = {name: substitute(expression, given) for name, expression in given.items()}
    return tuple(substitute(line, given) for line in program.equations)


def terms(equation: Equation, expand: bool = False) -> list[Term]:
    """The writer's own additive terms, both sides, signed so that their sum is 0.

    Goes through outer sums and signs; brackets are multiplied out only with ``expand``.
    """
    left = [Term(sign, node, "left") for sign, node in addends(equation.left, expand)]
    return left + [Term(-sign, node, "right") for sign, node in addends(equation.right, expand)]


def addends(node: Node, expand: bool = False) -> list[tuple[int, Node]]:
    """The signed terms of a side, zeros left out."""
    match node:
        case Number(value=0):
            return []
        case Sum(terms=inside):
            return [found for term in inside for found in addends(term, expand)]
        case Negative(of=of):
            return [(-sign, term) for sign, term in addends(of, expand)]
        case Quotient(top=top, bottom=bottom) if expand:
            return [(sign, Quotient(term, bottom, span=term.span)) for sign, term in addends(top, expand)]
        case Cross(left=a, right=b) | Dot(left=a, right=b) if expand:
            return [(s * r, type(node)(x, y, span=node.span)) for s, x in addends(a, expand) for r, y in addends(b, expand)]
        case Product(factors=factors) if expand:
            out: list[tuple[int, tuple[Node, ...]]] = [(1, ())]
            for factor in factors:
                out = [(s * r, (*done, term)) for s, done in out for r, term in addends(factor, expand)]
            return [(sign, Product(done, span=node.span)) for sign, done in out]
    return [(1, node)]
