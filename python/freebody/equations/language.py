"""Expressions of the model language as trees, and parameters that a model defines by others: h = w tan α/3."""

from __future__ import annotations

from collections.abc import Collection

from freebody.core import CompiledModel
from freebody.model import syntax
from freebody.symbolic.decimals import exact
from freebody.symbolic.tree import (
    PI,
    Add,
    Fn,
    Mul,
    Negative,
    Node,
    Num,
    Pow,
    Quotient,
    Sym,
    Tree,
    add,
    mul,
    negative,
    over,
    power,
    symbols,
)
from freebody.symbolic.tree import replace as replaced

_SAME = ("sin", "cos", "exp", "ln", "atan2", "abs", "sign")
_DOTS = {"rate": 1, "accel": 2}


class NoForm(ValueError):
    """An expression that has no symbolic form, as a least of two."""


def read_text(text: str) -> Tree:
    """``m*g*sin(theta) - c*rate(theta)`` as a tree; numbers with a unit are in SI. Raises ``NoForm``, ``ModelProblem``."""
    return _tree(syntax.parse(text).tree)


def _tree(of: Node) -> Tree:
    match of:
        case Num(value):
            return exact(float(value))
        case Sym():
            return Sym(of.name)
        case Negative(inner):
            return negative(_tree(inner))
        case Add(terms):
            return add(*map(_tree, terms))
        case Mul(factors):
            return mul(*map(_tree, factors))
        case Quotient(above, below):
            return over(_tree(above), _tree(below))
        case Pow(base, exponent) if isinstance(number := _tree(exponent), Num):
            return power(_tree(base), number.value)
        case Fn("sqrt", (inner,)):
            return power(_tree(inner), "1/2")
        case Fn("hypot", sides):
            return power(add(*(power(_tree(side), 2) for side in sides)), "1/2")
        case Fn("tan", (angle,)):
            return over(Fn("sin", (_tree(angle),)), Fn("cos", (_tree(angle),)))
        case Fn(name, (Sym(symbol),)) if name in _DOTS:
            return Sym(symbol, _DOTS[name])
        case Fn(name, arguments) if name in _SAME:
            return Fn(name, tuple(map(_tree, arguments)))
    raise NoForm("the expression has no symbolic form")


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
