"""Trees as SymPy expressions, and back."""

from __future__ import annotations

from collections.abc import Collection
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from freebody.symbolic.letters import Letters
from freebody.symbolic.tree import PI, Add, Fn, Mul, Num, Pow, Sym, Tree

if TYPE_CHECKING:
    import sympy

_TO = {"abs": "Abs", "ln": "log"}
_FROM = {to: name for name, to in _TO.items()}
_SAME = ("sin", "cos", "tan", "exp", "atan2", "sign")


def to_sympy(
    tree: Tree, letters: Letters | None = None, *, time: bool = False, positive: Collection[str] = (), real: bool = False
) -> sympy.Expr:
    """The tree as a SymPy expression.

    With ``time`` a coordinate is ``Function("theta")(t)`` and its rate a ``Derivative``, as ``dynamicsymbols`` makes them;
    which letters are coordinates the ``letters`` say. Without, ``theta'`` and ``theta''`` are symbols of their own.
    ``positive`` names letters that are assumed to be positive; ``real`` assumes all letters to be real."""
    return _Maker(letters or Letters(), time, frozenset(positive), real).expression(tree)


def from_sympy(expression: sympy.Expr) -> Tree:
    """The tree of a SymPy expression, written with symbols or with functions of time."""
    import sympy

    match expression:
        case sympy.Rational():
            return Num(Fraction(expression.p, expression.q))
        case sympy.Float():
            return Num(float(expression))
        case sympy.Symbol():
            stem = expression.name.rstrip("'")
            return Sym(stem, len(expression.name) - len(stem))
        case sympy.Add():
            return Add(tuple(map(from_sympy, _ordered(expression))))
        case sympy.Mul():
            return Mul(tuple(map(from_sympy, _ordered(expression))))
        case sympy.Pow(exp=sympy.Rational() as exponent):
            return Pow(from_sympy(expression.base), Fraction(exponent.p, exponent.q))
        case sympy.Derivative(expr=sympy.core.function.AppliedUndef() as function):
            return Sym(function.func.__name__, expression.derivative_count)
        case _:
            return _special(expression)


def _special(expression: sympy.Expr) -> Tree:
    import sympy

    if expression == sympy.pi:
        return Sym(PI)
    if expression in (sympy.oo, -sympy.oo):
        return Num(float(expression))
    if expression == sympy.E:
        return Fn("exp", (Num(Fraction(1)),))
    if isinstance(expression, sympy.core.function.AppliedUndef) and [a.name for a in expression.args if a.is_Symbol] == ["t"]:
        return Sym(expression.func.__name__)
    if isinstance(expression, sympy.atan):  # that which SymPy makes of an atan2 of numbers
        return Fn("atan2", (from_sympy(expression.args[0]), Num(Fraction(1))))
    if isinstance(expression, sympy.Function):
        name = expression.func.__name__
        known = name in _SAME or name in _FROM or isinstance(expression, sympy.core.function.AppliedUndef)
        if known:
            return Fn(_FROM.get(name, name), tuple(map(from_sympy, expression.args)))
    raise ValueError(
        f"{expression} has no form here; sums, products, rational powers, sin, cos, tan, exp, log, atan2, Abs, sign do"
    )


def _ordered(expression: Any) -> list[Any]:
    return list(expression.as_ordered_terms() if expression.is_Add else expression.as_ordered_factors())


class _Maker:
    def __init__(self, letters: Letters, time: bool, positive: frozenset[str], real: bool) -> None:
        import sympy

        self.sympy, self.letters, self.time, self.positive = sympy, letters, time, positive
        self.real = {"real": True} if real else {}
        self.t = sympy.Symbol("t")

    def expression(self, tree: Tree) -> Any:
        match tree:
            case Num(value):
                return (
                    self.sympy.Rational(value.numerator, value.denominator) if isinstance(value, Fraction) else self._float(value)
                )
            case Sym():
                return self._letter(tree)
            case Add(terms):
                return self.sympy.Add(*map(self.expression, terms))
            case Mul(factors):
                return self.sympy.Mul(*map(self.expression, factors))
            case Pow(base, exponent):
                return self.expression(base) ** self.sympy.Rational(exponent.numerator, exponent.denominator)
            case Fn(name, args):
                return self._function(name)(*map(self.expression, args))

    def _float(self, value: float) -> Any:
        return self.sympy.Float(value, 17) if abs(value) != float("inf") else self.sympy.oo * (1 if value > 0 else -1)

    def _letter(self, letter: Sym) -> Any:
        if letter == Sym(PI):
            return self.sympy.pi
        kind = self.letters.kind(letter.name)
        if self.time and (letter.dots or kind == "coordinate"):
            function = self.sympy.Function(letter.name)(self.t)
            return function.diff(self.t, letter.dots) if letter.dots else function
        if self.time and kind == "time":
            return self.t
        assumed = {"positive": True} if letter.name in self.positive and not letter.dots else self.real
        return self.sympy.Symbol(letter.name + "'" * letter.dots, **assumed)

    def _function(self, name: str) -> Any:
        known = name in _SAME or name in _TO
        return getattr(self.sympy, _TO.get(name, name)) if known else self.sympy.Function(name)
