"""Time derivatives of expressions of the model language, as expressions."""

from __future__ import annotations

from freebody.model import syntax
from freebody.model.errors import ModelProblem

_NEXT = {"rate": "accel", "vx": "ax", "vy": "ay", "omega": "alpha"}
_MOVING = {*_NEXT, "speed", "accel", "ax", "ay", "alpha"}


def derivative(text: str, dots: int) -> str:
    """The text differentiated so many times by time: ``rate(…)`` and ``accel(…)`` of a configuration; what holds rates
    already, once, by the rules of sums and products. Raises ``ModelProblem`` where the model language has no such quantity."""
    if not dots:
        return text
    tree = syntax.parse(text).tree
    if not _moves(tree):
        return _of_configuration(text, dots)
    if dots > 1:
        raise ModelProblem(f"`{text}` holds rates; the derivative of its accelerations is not known to the model")
    return _Rules(text).of(tree)


def _of_configuration(text: str, dots: int) -> str:
    if dots > 2:
        raise ModelProblem(f"a derivative of order {dots} is not known to the model", "at most accelerations are")
    return f"{('rate', 'accel')[dots - 1]}({text})"


def _moves(tree: syntax.Tree) -> bool:
    """Whether a rate or acceleration is read in a tree."""
    match tree:
        case {"call": [name, arguments]}:
            return name in _MOVING or any(_moves(a) for a in arguments)
        case {"negate": inner}:
            return _moves(inner)
        case {"chain": [first, rest]}:
            return _moves(first) or any(_moves(part) for _, part in rest)
    return False


class _Rules:
    def __init__(self, text: str) -> None:
        self.bytes = text.encode()

    def show(self, tree: syntax.Tree) -> str:
        start, end = tree["span"]
        return f"({self.bytes[start:end].decode()})"

    def of(self, tree: syntax.Tree) -> str:
        """The derivative of a tree, in brackets."""
        match tree:
            case _ if not _moves(tree):
                return f"rate{self.show(tree)}"
            case {"negate": inner}:
                return f"(-{self.of(inner)})"
            case {"call": [name, [argument]]} if name in _NEXT:
                return f"{_NEXT[name]}{self.show(argument)}"
            case {"chain": [first, [(sign, _), *_] as rest]} if sign in "+-":
                return f"({self.of(first)}" + "".join(f" {op} {self.of(part)}" for op, part in rest) + ")"
            case {"chain": [first, [(sign, _), *_] as rest]} if sign in "*/":
                return self.product([("*", first), *rest])
        raise ModelProblem(f"the derivative of `{self.show(tree)[1:-1]}` is not known", "declare a symbol for it, or write it out")

    def product(self, parts: list[tuple[str, syntax.Tree]]) -> str:
        """Of each factor in turn; of one that divides, −ẋ/x²."""
        terms = []
        for i, (sign, part) in enumerate(parts):
            others = "".join(f" {op} {self.show(other)}" for j, (op, other) in enumerate(parts) if j != i)
            own = self.of(part) if sign == "*" else f"(-{self.of(part)}/{self.show(part)}^2)"
            terms.append(own + others)
        return "(" + " + ".join(terms) + ")"
