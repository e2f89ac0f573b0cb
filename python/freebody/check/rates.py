"""Time derivatives of expressions of the model language, as expressions."""

from __future__ import annotations

from freebody.model import syntax
from freebody.model.errors import ModelProblem
from freebody.symbolic import differentiate
from freebody.symbolic.errors import StatementError
from freebody.symbolic.tree import Fn, Node, Num, Sym, children, exchange, walk

from .language.spelling import spell

_RATES = ("rate({})", "accel({})", "rate(accel({}))")
_NEXT = {"rate": "accel", "vx": "ax", "vy": "ay", "omega": "alpha"}
_MOVING = {*_NEXT, "speed", "curvature", "accel", "ax", "ay", "alpha"}


def derivative(text: str, dots: int) -> str:
    """The text differentiated so many times by time: ``rate(…)``, ``accel(…)`` and the rate of that of a configuration; what holds rates
    already, once, by the rules of the calculus. Raises ``ModelProblem`` where the model language has no such quantity."""
    if not dots:
        return text
    expression = syntax.parse(text)
    if not _moves(expression.tree):
        if dots > len(_RATES):
            raise ModelProblem(f"a derivative of order {dots} is not known to the model", "at most rates of accelerations are")
        return _RATES[dots - 1].format(text)
    if dots > 1:
        raise ModelProblem(f"`{text}` holds rates; the derivative of its accelerations is not known to the model")
    tree, rates = _in_readings(expression)
    try:
        return spell(differentiate.derivative(tree, rates.__getitem__))
    except StatementError as error:
        what = f"the derivative of `{expression.show(Node(span=error.span))}` is not known"
        raise ModelProblem(what, "declare a symbol for it, or write it out") from None


def _moves(tree: Node) -> bool:
    """Whether a rate or acceleration is read in a tree."""
    return any((isinstance(node, Fn) and node.name in _MOVING) or _is_slip(node) for node in walk(tree))


def _is_slip(node: Node) -> bool:
    """Whether it is with which speed a contact slips."""
    return isinstance(node, Sym) and node.name.endswith(".slip")


def _in_readings(expression: syntax.Expression) -> tuple[Node, dict[Sym, Node]]:
    """The tree with one symbol for each part that the model can differentiate, and what the derivatives of these are."""
    tree, rates, waiting = expression.tree, {}, [expression.tree]
    while waiting:
        node = waiting.pop()
        if isinstance(node, Fn) and node.name in _NEXT:
            text = f"({expression.show(node.args[0])})"
            reading, rate = Sym(node.name + text), Sym(_NEXT[node.name] + text)
        elif _is_slip(node) or (not _moves(node) and not isinstance(node, Num)):
            text = f"({expression.show(node)})"
            reading, rate = Sym(text), Sym("rate" + text)
        elif isinstance(node, Fn) and node.name == "speed":  # v² = v · v, so v̇ = v · a/v
            point = expression.show(node.args[0])
            reading = Sym(f"speed({point})")
            rate = Sym(f"((vx({point})*ax({point}) + vy({point})*ay({point}))/speed({point}))")
        else:
            waiting += children(node)
            continue
        tree, rates[reading] = exchange(tree, node, reading), rate
    return tree, rates
