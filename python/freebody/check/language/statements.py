"""What a person states: equations between expressions, and lines that give names."""

from __future__ import annotations

from dataclasses import dataclass, field

from freebody.symbolic.tree import Mul, N, Node, Num, Quotient, Sym, addends, exchange, substitute, walk


@dataclass(frozen=True)
class Partial(Node):
    """∂L/∂θ̇: how a name that a line gives changes with one letter; written out once all lines are read."""

    of: Sym
    by: Sym


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

    name: Sym
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


def letters(node: Node) -> list[Sym]:
    """The letters in it, each once, in the order of the text."""
    return list(dict.fromkeys(n for n in walk(node) if isinstance(n, Sym)))


def without_ones(node: N) -> N:
    """The same without factors 1 and denominators 1."""
    while (found := next((n for n in walk(node) if _has_one(n)), None)) is not None:
        left = [f for f in found.factors if f != _ONE] or [_ONE] if isinstance(found, Mul) else [found.top]
        node = exchange(node, found, left[0] if len(left) == 1 else Mul(tuple(left), span=found.span))
    return node


_ONE = Num(1.0, "1")


def _has_one(node: Node) -> bool:
    return (isinstance(node, Mul) and _ONE in node.factors) or (isinstance(node, Quotient) and node.bottom == _ONE)


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
