"""Expressions of the model language as trees."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from freebody.model import syntax
from freebody.symbolic.decimals import exact
from freebody.symbolic.tree import Fn, Num, Sym, Tree, add, minus, mul, negative, over, power

_SAME = ("sin", "cos", "exp", "ln", "atan2", "abs", "sign")
_DOTS = {"rate": 1, "accel": 2}


class NoForm(ValueError):
    """An expression that has no symbolic form, as a least of two."""


def read_text(text: str) -> Tree:
    """``m*g*sin(theta) - c*rate(theta)`` as a tree; numbers with a unit are in SI. Raises ``NoForm``, ``ModelProblem``."""
    return _tree(syntax.parse(text).tree)


def _tree(of: Mapping[str, Any]) -> Tree:
    match of:
        case {"number": value}:
            return exact(float(value))
        case {"name": name}:
            return Sym(name)
        case {"negate": inner}:
            return negative(_tree(inner))
        case {"call": ["sqrt", [inner]]}:
            return power(_tree(inner), "1/2")
        case {"call": ["hypot", sides]}:
            return power(add(*(power(_tree(side), 2) for side in sides)), "1/2")
        case {"call": ["tan", [angle]]}:
            return over(Fn("sin", (_tree(angle),)), Fn("cos", (_tree(angle),)))
        case {"call": [name, [{"name": letter}]]} if name in _DOTS:
            return Sym(letter, _DOTS[name])
        case {"call": [name, arguments]} if name in _SAME:
            return Fn(name, tuple(map(_tree, arguments)))
        case {"chain": [first, rest]}:
            total = _tree(first)
            for operator, part in rest:
                total = _joined(operator, total, _tree(part))
            return total
    raise NoForm("the expression has no symbolic form")


def _joined(operator: str, left: Tree, right: Tree) -> Tree:
    if operator == "^" and isinstance(right, Num):
        return power(left, right.value)
    if operator not in _OPERATORS:
        raise NoForm("the expression has no symbolic form")
    return _OPERATORS[operator](left, right)


_OPERATORS: Mapping[str, Callable[[Tree, Tree], Tree]] = {"+": add, "-": minus, "*": mul, "/": over}
