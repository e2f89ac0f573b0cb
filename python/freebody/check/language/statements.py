"""What a person states: equations between expressions, and lines that give names."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from freebody.symbolic.tree import (
    Add,
    Column,
    Dot,
    Matrix,
    Mul,
    N,
    Negative,
    Node,
    Num,
    Quotient,
    Sym,
    addends,
    exchange,
    is_zero,
    substitute,
    walk,
)


@dataclass(frozen=True)
class Partial(Node):
    """∂L/∂θ̇: how a name that a line gives changes with one symbol; written out once all lines are read."""

    of: Sym
    by: Sym


@dataclass(frozen=True)
class Rate(Node):
    """The derivative by time of what has partial derivatives in it; written out with them."""

    of: Node


@dataclass(frozen=True)
class Integral(Node):
    """∫ of d(by) from lower to upper."""

    of: Node
    by: Sym
    lower: Node
    upper: Node


@dataclass(frozen=True)
class Directed(Node):
    """What an arrow behind it says to point which way: ``2.5 m/s ↑``."""

    of: Node
    arrow: str


@dataclass(frozen=True)
class Equation(Node):
    """Two sides that are said to be equal, or as ``relation`` says: ``=``, ``<=``, ``>=``, ``<``, ``>``."""

    left: Node
    right: Node
    relation: str = "="


@dataclass(frozen=True)
class Assignment(Node):
    """A line that gives a name to an expression, for the lines around it."""

    name: Sym
    expression: Node


@dataclass(frozen=True)
class Program(Node):
    """All lines of a statement, in order, and its text; ``units``: read so that units behind numbers go before symbols;
    ``tight``: so that what stands directly behind a factor below a stroke is below it; ``apart``: so that letters side by side are no index."""

    lines: tuple[Assignment | Equation, ...]
    text: str = field(default="", compare=False)
    units: bool = field(default=False, compare=False)
    tight: bool = field(default=False, compare=False)
    apart: bool = field(default=False, compare=False)

    @property
    def assignments(self) -> tuple[Assignment, ...]:
        """The lines that give names."""
        return tuple(line for line in self.lines if isinstance(line, Assignment))

    @property
    def equations(self) -> tuple[Equation, ...]:
        """The lines that state something."""
        return tuple(line for line in self.lines if isinstance(line, Equation))


def symbols_in(node: Node) -> list[Sym]:
    """The symbols in it, each once, in the order of the text."""
    return list(dict.fromkeys(n for n in walk(node) if isinstance(n, Sym)))


def without_ones(node: N) -> N:
    """The same without factors 1 and denominators 1."""
    one = Num(1.0, "1")
    has_one = lambda n: (isinstance(n, Mul) and one in n.factors) or (isinstance(n, Quotient) and n.bottom == one)
    while (found := next(filter(has_one, walk(node)), None)) is not None:
        left = [f for f in found.factors if f != one] or [one] if isinstance(found, Mul) else [found.top]
        node = exchange(node, found, left[0] if len(left) == 1 else Mul(tuple(left), span=found.span))
    return node


def inlined(program: Program) -> tuple[Equation, ...]:
    """The equations with the assigned names written out, in whichever order the lines stand."""
    given = written_out(program.assignments)
    return tuple(substitute(line, given) for line in program.equations)


def written_out(assignments: Iterable[Assignment]) -> dict[Sym, Node]:
    """What lines give names to, with the names of the other lines written out."""
    given = {line.name: line.expression for line in assignments}
    for _ in given:
        given = {name: substitute(expression, given) for name, expression in given.items()}
    return given


def terms(equation: Equation, expand: bool = False) -> list[Node]:
    """The writer's own additive terms, both sides, without their signs; brackets are multiplied out only with ``expand``."""
    return [node for side in (equation.left, equation.right) for _, node in addends(side, expand)]


# -- columns


def rows(equation: Equation) -> list[Equation]:
    """One equation a row, made of the same parts; the equation itself where its sides are no columns."""
    left, right = _entries(equation.left), _entries(equation.right)
    count = len(left or right or ())
    if not count:
        return [equation]
    left = left or ([equation.left] * count if is_zero(equation.left) else [])
    right = right or ([equation.right] * count if is_zero(equation.right) else [])
    if len(left) != count or len(right) != count:
        return [equation]
    return [Equation(a, b, span=equation.span) for a, b in zip(left, right, strict=True)]


def _entries(node: Node) -> list[Node] | None:
    """The entries of a column, or None."""
    match node:
        case Column(items=items):
            return list(items)
        case Matrix(rows=lines) if all(len(line) == 1 for line in lines):
            return [line[0] for line in lines]
        case Negative(of=of):
            return [Negative(item) for item in inside] if (inside := _entries(of)) else None
        case Add(terms=terms):
            columns = [_entries(term) for term in terms if not is_zero(term)]
            alike = None not in columns and len(set(map(len, columns))) == 1  # type: ignore[arg-type]
            return [Add(parts) for parts in zip(*columns, strict=True)] if alike else None  # type: ignore[arg-type]
        case Quotient(top=top, bottom=bottom):
            return [Quotient(item, bottom) for item in inside] if (inside := _entries(top)) else None
        case Mul(factors=factors):
            return _products(factors)
        case Dot(left=left, right=right):
            return _products((left, right))
    return None


def _products(factors: tuple[Node, ...]) -> list[Node] | None:
    """A product whose last column or matrix is multiplied from the left."""
    out: list[Node] | None = None
    flat = [inner for factor in factors for inner in (factor.factors if isinstance(factor, Mul) else (factor,))]
    for factor in reversed(flat):
        if isinstance(factor, Matrix) and out is not None:
            if any(len(line) != len(out) for line in factor.rows):
                return None
            out = [_row(line, out) for line in factor.rows]
        elif (column := _entries(factor)) is not None:
            if out is not None:
                return None
            out = column
        elif out is None or any(isinstance(n, Matrix | Column) for n in walk(factor)):
            return None
        else:
            out = [_times(factor, item) for item in out]
    return out


def _row(line: tuple[Node, ...], column: list[Node]) -> Node:
    terms = [_times(a, b) for a, b in zip(line, column, strict=True) if not is_zero(a) and not is_zero(b)]
    return Add(tuple(terms)) if len(terms) > 1 else terms[0] if terms else Num(0.0, "0")


def _times(a: Node, b: Node) -> Node:
    return b if a == Num(1.0) else Mul((a, b))
