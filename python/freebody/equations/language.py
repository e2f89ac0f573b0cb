"""Expressions of the model language as trees."""

from __future__ import annotations

from freebody.model import syntax
from freebody.symbolic.decimals import exact
from freebody.symbolic.tree import Add, Fn, Mul, Negative, Node, Num, Pow, Quotient, Sym, Tree, add, mul, negative, over, power

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
        case Fn(name, (Sym(letter),)) if name in _DOTS:
            return Sym(letter, _DOTS[name])
        case Fn(name, arguments) if name in _SAME:
            return Fn(name, tuple(map(_tree, arguments)))
    raise NoForm("the expression has no symbolic form")
