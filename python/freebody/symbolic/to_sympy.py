"""Trees as SymPy expressions, and back."""

from __future__ import annotations

import math
from collections.abc import Collection
from fractions import Fraction
from importlib import import_module
from typing import Any

from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.tree import PI, Add, Fn, Mul, Num, Pow, Sym, Tree

_TO = {"abs": "Abs", "ln": "log"}
_FROM = {to: name for name, to in _TO.items()}
_SAME = ("sin", "cos", "tan", "exp", "atan2", "sign")


class _Later:
    def __getattr__(self, name: str) -> Any:
        setattr(self, name, getattr(import_module("sympy"), name))
        return getattr(self, name)


sympy: Any = _Later()
"""SymPy, which is loaded where something of it is first asked for: that takes longer than all else."""


def to_sympy(
    tree: Tree,
    nomenclature: Nomenclature | None = None,
    *,
    time: bool = False,
    positive: Collection[str] = (),
    real: bool = False,
) -> sympy.Expr:
    """The tree as a SymPy expression.

    With ``time`` a coordinate is ``Function("theta")(t)`` and its rate a ``Derivative``, as ``dynamicsymbols`` makes them;
    which symbols are coordinates the ``nomenclature`` says. Without, ``theta'`` and ``theta''`` are symbols of their own.
    ``positive`` names symbols that are assumed to be positive; ``real`` assumes all symbols to be real."""
    t, kinds, assumed = sympy.Symbol("t"), nomenclature or Nomenclature(), {"real": True} if real else {}

    def symbol(each: Sym) -> Any:
        kind = kinds.kind(each.name)
        if time and (each.dots or kind == "coordinate"):
            function = sympy.Function(each.name)(t)
            return function.diff(t, each.dots) if each.dots else function
        if each == Sym(PI) or (time and kind == "time"):
            return sympy.pi if each == Sym(PI) else t
        is_positive = each.name in positive and not each.dots
        return sympy.Symbol(each.name + "'" * each.dots, **({"positive": True} if is_positive else assumed))

    def of(node: Tree) -> Any:
        match node:
            case Num(Fraction(numerator=above, denominator=below)):
                return sympy.Rational(above, below)
            case Num(value):
                return sympy.Float(value, 17) if abs(value) != math.inf else sympy.oo * (1 if value > 0 else -1)
            case Sym():
                return symbol(node)
            case Add(terms):
                return sympy.Add(*map(of, terms))
            case Mul(factors):
                return sympy.Mul(*map(of, factors))
            case Pow(base, exponent):
                return of(base) ** sympy.Rational(exponent.numerator, exponent.denominator)
            case Fn(name, args):
                known = name in _SAME or name in _TO
                return (getattr(sympy, _TO.get(name, name)) if known else sympy.Function(name))(*map(of, args))

    return of(tree)


def from_sympy(expression: sympy.Expr) -> Tree:
    """The tree of a SymPy expression, written with symbols or with functions of time."""
    match expression:
        case sympy.Rational():
            return Num(Fraction(expression.p, expression.q))
        case sympy.Float():
            return Num(float(expression))
        case sympy.Symbol():
            stem = expression.name.rstrip("'")
            return Sym(stem, len(expression.name) - len(stem))
        case sympy.Add():
            return Add(tuple(map(from_sympy, expression.as_ordered_terms())))
        case sympy.Mul():
            return Mul(tuple(map(from_sympy, expression.as_ordered_factors())))
        case sympy.Pow(exp=sympy.Rational() as exponent):
            return Pow(from_sympy(expression.base), Fraction(exponent.p, exponent.q))
        case sympy.Derivative(expr=sympy.core.function.AppliedUndef() as function):
            return Sym(function.func.__name__, expression.derivative_count)
        case sympy.atan():  # that which SymPy makes of an atan2 of numbers
            return Fn("atan2", (from_sympy(expression.args[0]), Num(Fraction(1))))
    if expression == sympy.pi:
        return Sym(PI)
    if expression in (sympy.oo, -sympy.oo):
        return Num(float(expression))
    if expression == sympy.E:
        return Fn("exp", (Num(Fraction(1)),))
    undefined = isinstance(expression, sympy.core.function.AppliedUndef)
    if undefined and [a.name for a in expression.args if a.is_Symbol] == ["t"]:
        return Sym(expression.func.__name__)
    name = expression.func.__name__
    if isinstance(expression, sympy.Function) and (undefined or name in _SAME or name in _FROM):
        return Fn(_FROM.get(name, name), tuple(map(from_sympy, expression.args)))
    raise ValueError(
        f"{expression} has no form here; sums, products, rational powers, sin, cos, tan, exp, log, atan2, Abs, sign do"
    )
