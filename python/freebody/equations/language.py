"""Expressions of the model language as trees, and parameters that a model defines by others: h = w tan α/3."""

from __future__ import annotations

from collections.abc import Collection

from freebody.core import CompiledModel
from freebody.model import syntax
from freebody.symbolic.decimals import exact
from freebody.symbolic.tree import PI, Fn, Num, Sym, Tree, add, canonical, over, power, symbols
from freebody.symbolic.tree import replace as replaced

_SAME = ("sin", "cos", "exp", "ln", "atan2", "abs", "sign")


class NoForm(ValueError):
    """An expression that has no symbolic form, as a least of two."""


def read_text(text: str) -> Tree:
    """``m*g*sin(theta) - c*rate(theta)`` as a tree; numbers with a unit are in SI. Raises ``NoForm``, ``ModelProblem``."""
    written = syntax.parse(text).tree
    try:
        return canonical(written, lambda leaf: exact(float(leaf.value)) if isinstance(leaf, Num) else Sym(leaf.name), _function)
    except ValueError:
        raise NoForm("the expression has no symbolic form") from None


def _function(name: str, arguments: tuple[Tree, ...]) -> Tree:
    match name, arguments:
        case "sqrt", (inner,):
            return power(inner, "1/2")
        case "hypot", sides:
            return power(add(*(power(side, 2) for side in sides)), "1/2")
        case "tan", (angle,):
            return over(Fn("sin", (angle,)), Fn("cos", (angle,)))
        case "rate" | "accel", (Sym(coordinate),):
            return Sym(coordinate, 1 if name == "rate" else 2)
    if name in _SAME:
        return Fn(name, arguments)
    raise NoForm(name)


def definitions(source: CompiledModel, free: Collection[str]) -> dict[str, Tree]:
    """Every parameter that is defined by others, by those that are not or are ``free``; one without a symbolic form, as a least
    of two, stays a symbol."""
    found: dict[str, Tree] = {}
    for parameter in source.spec["parameters"]:
        name, value = parameter["name"], parameter["value"]
        if name in free or not isinstance(value, str):
            continue
        try:
            tree = replaced(read_text(value), {Sym(x): known for x, known in found.items()})
        except NoForm:
            continue
        if symbols(tree) - {Sym(PI)}:
            found[name] = tree
    return found
