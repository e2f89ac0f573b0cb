"""Time derivatives of expressions of the model language, as expressions."""

from __future__ import annotations

from freebody.model import syntax
from freebody.model.errors import ModelProblem
from freebody.symbolic.tree import Add, Fn, Mul, Negative, Node, Quotient, walk

_NEXT = {"rate": "accel", "vx": "ax", "vy": "ay", "omega": "alpha"}
_MOVING = {*_NEXT, "speed", "accel", "ax", "ay", "alpha"}


def derivative(text: str, dots: int) -> str:
    """The text differentiated so many times by time: ``rate(…)`` and ``accel(…)`` of a configuration; what holds rates
    already, once, by the rules of sums and products. Raises ``ModelProblem`` where the model language has no such quantity."""
    if not dots:
        return text
    expression = syntax.parse(text)
    if not _moves(expression.tree):
        return _of_configuration(text, dots)
    if dots > 1:
        raise ModelProblem(f"`{text}` holds rates; the derivative of its accelerations is not known to the model")
    return _Rules(expression).of(expression.tree)


def _of_configuration(text: str, dots: int) -> str:
    if dots > 2:
        raise ModelProblem(f"a derivative of order {dots} is not known to the model", "at most accelerations are")
    return f"{('rate', 'accel')[dots - 1]}({text})"


def _moves(tree: Node) -> bool:
    """Whether a rate or acceleration is read in a tree."""
    return any(isinstance(node, Fn) and node.name in _MOVING for node in walk(tree))


class _Rules:
    def __init__(self, expression: syntax.Expression) -> None:
        self.expression = expression

    def show(self, tree: Node) -> str:
        return f"({self.expression.show(tree)})"

    def of(self, tree: Node) -> str:
        """The derivative of a tree, in brackets."""
        match tree:
            case _ if not _moves(tree):
                return f"rate{self.show(tree)}"
            case Negative(inner):
                return f"(-{self.of(inner)})"
            case Fn(name, (argument,)) if name in _NEXT:
                return f"{_NEXT[name]}{self.show(argument)}"
            case Add(terms):
                return f"({' + '.join(map(self.of, terms))})"
            case Mul((left, right)):
                return f"({self.of(left)}*{self.show(right)} + {self.show(left)}*{self.of(right)})"
            case Quotient(top, bottom):
                return f"({self.of(top)}/{self.show(bottom)} - {self.show(top)}*{self.of(bottom)}/{self.show(bottom)}^2)"
        raise ModelProblem(
            f"the derivative of `{self.show(tree)[1:-1]}` is not known", "declare a letter for it, or write it out"
        )
