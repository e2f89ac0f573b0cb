"""Whether an equation is true, and whether two say the same, found without the check: trees evaluated at drawn values."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from freebody.check.language.statements import Equation, symbols_in
from freebody.symbolic.tree import Add, Dot, Fn, Mul, Negative, Node, Num, Pow, Quotient, Sym, Unit

Array = NDArray[np.float64]
Values = Mapping[Sym, Array]
_ROUND_OFF = 1e-9
_FUNCTIONS = {"sin": np.sin, "cos": np.cos, "tan": np.tan, "sqrt": np.sqrt, "exp": np.exp, "abs": np.abs, "atan2": np.arctan2}
_FUNCTIONS |= {
    "ln": np.log,
    "sign": np.sign,
    "asin": np.arcsin,
    "acos": np.arccos,
    "atan": np.arctan,
    "sinh": np.sinh,
    "cosh": np.cosh,
    "tanh": np.tanh,
}
_FUNCTIONS |= {"cot": lambda x: 1 / np.tan(x), "sec": lambda x: 1 / np.cos(x), "csc": lambda x: 1 / np.sin(x)}


def valued(node: Node, at: Values) -> tuple[Array, Array]:
    """The value of an expression and the sum of the sizes of what was added to make it. Raises ``KeyError``."""
    match node:
        case Num(value=value):
            return np.array(value), np.array(abs(value))
        case Unit(size=size):
            return np.array(size), np.array(abs(size))
        case Sym():
            return at[node], np.abs(at[node])
        case Negative(of=of):
            value, size = valued(of, at)
            return -value, size
        case Add(terms=parts):
            found = [valued(part, at) for part in parts]
            return sum(v for v, _ in found), sum(s for _, s in found)
        case Mul(factors=parts):
            found = [valued(part, at) for part in parts]
            return math.prod(v for v, _ in found), math.prod(s for _, s in found)
        case Dot(left=a, right=b):  # of two numbers: as the pages print a product
            return valued(Mul((a, b)), at)
        case Quotient(top=top, bottom=bottom):
            (a, size), (b, _) = valued(top, at), valued(bottom, at)
            return a / b, size / np.abs(b)
        case Pow(base=base, exponent=exponent):
            (a, size), (n, _) = valued(base, at), valued(exponent, at)
            return a**n, size**n if np.all(n > 0) else np.abs(a**n)
        case Fn(name=name, args=arguments):
            value = _FUNCTIONS[name](*(valued(argument, at)[0] for argument in arguments))
            return value, np.abs(value)
    raise KeyError(type(node).__name__)


def sides(equation: Equation, at: Values) -> tuple[Array, Array]:
    """left − right at each place, and the sizes of all terms together."""
    with np.errstate(all="ignore"):
        (left, a), (right, b) = valued(equation.left, at), valued(equation.right, at)
        return left - right, a + b


def holds(equation: Equation, at: Values) -> bool:
    """Whether it holds at every place but for round-off."""
    off, size = sides(equation, at)
    return bool(np.all(np.abs(off) <= _ROUND_OFF * size))


def says_the_same(one: Equation, other: Equation, at: Values) -> bool:
    """Whether ``other`` holds just where ``one`` does, at places that are no true states: ``one`` is made to hold there by one
    symbol in which it is linear, one that does not make all its terms 0 where there is such."""
    made = [values for symbol in symbols_in(one) if (values := _solved(one, symbol, at)) is not None]
    if not made:
        return False
    best = max(made, key=lambda values: float(np.min(sides(one, values)[1])))
    off, size = sides(other, best)[0], sides(other, at)[1]
    return bool(np.all(np.abs(off) <= _ROUND_OFF * size)) and not holds(other, at)


def _solved(equation: Equation, symbol: Sym, at: Values) -> Values | None:
    """The places moved along one symbol so that an equation holds; None where it is not linear in it."""
    with np.errstate(all="ignore"):
        a, b, c = (
            np.subtract(*(valued(side, {**at, symbol: at[symbol] + step})[0] for side in (equation.left, equation.right)))
            for step in (0.0, 1.0, 2.0)
        )
        slope, bend = b - a, c - 2 * b + a
        if not np.all(np.abs(slope) > 1e-6) or not np.all(np.abs(bend) < 1e-8 * np.abs(slope)):
            return None
        return {**at, symbol: at[symbol] - a / slope}
