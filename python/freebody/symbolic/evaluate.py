"""The value of an expression: of numbers or arrays, of vectors and matrices at many samples at once.

A number is a float or (K,) over K samples, a vector (K, 3) with components along i, j, k, a matrix (K, r, c); a column is (K, r, 1).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import reduce
from typing import Any

import numpy as np
from numpy.typing import NDArray

from freebody.symbolic.errors import StatementError
from freebody.symbolic.tree import (
    PI,
    Add,
    Column,
    Cross,
    Dot,
    Fn,
    Matrix,
    Mul,
    Negative,
    Node,
    Num,
    Pow,
    Quotient,
    Sym,
    Unit,
    is_zero,
)

Array = NDArray[np.float64]

FUNCTIONS: dict[str, Callable[..., Any]] = {
    **{name: getattr(np, name) for name in ("sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "sqrt", "sign", "hypot")},
    **{"asin": np.arcsin, "acos": np.arccos, "atan": np.arctan, "atan2": np.arctan2, "ln": np.log, "abs": np.abs},
    **{"asinh": np.arcsinh, "acosh": np.arccosh, "atanh": np.arctanh},
    **{"cot": lambda x: 1 / np.tan(x), "sec": lambda x: 1 / np.cos(x), "csc": lambda x: 1 / np.sin(x)},
    **{"min": np.minimum, "max": np.maximum},
}
"""What the names of functions mean; any other name is a table of the model."""
ARGUMENTS = {"atan2": 2, "hypot": 2, "min": 2, "max": 2}


def evaluate(tree: Node, values: Mapping[Sym, Any], tables: Mapping[str, Callable[..., Any]] | None = None) -> Any:
    """The value of an expression of numbers: a number, or an array if the values are arrays (they are broadcast).

    ``tables`` has the tables of the model by name. A symbol or a table without a value is a ``KeyError`` that names it."""

    def symbol(each: Sym) -> Any:
        if each in values:
            return values[each]
        if each == Sym(PI):
            return math.pi
        raise KeyError(f"no value for {each.name!r} differentiated {each.dots} times")

    return value(tree, symbol, float, {**FUNCTIONS, **(tables or {})})


def sampled(tree: Node, values: Mapping[str, Array]) -> Array:
    """The value of an expression of numbers, vectors and matrices; ``values`` by ``Sym.key``, all over the same K samples.

    Raises ``StatementError`` at a symbol without a value and where kinds do not go together.
    """
    count = len(next(iter(values.values()))) if values else 1

    def symbol(each: Sym) -> Array:
        if each.key not in values:
            raise StatementError(f"`{each.key}` has no meaning here", each.span, "declare it in terms of the model's symbols")
        return np.asarray(values[each.key], dtype=float)

    with np.errstate(all="ignore"):
        return value(tree, symbol, lambda x: np.full(count, float(x)), FUNCTIONS)


def value(
    tree: Node, symbol: Callable[[Sym], Any], number: Callable[[Any], Any], functions: Mapping[str, Callable[..., Any]]
) -> Any:
    """The value of an expression, where symbols, numbers and functions are what these say.

    Raises ``StatementError`` where kinds do not go together, ``KeyError`` at a function that has no meaning."""
    of = lambda node: value(node, symbol, number, functions)
    match tree:
        case Num(x) | Unit(x):
            return number(x)
        case Sym():
            return symbol(tree)
        case Add(terms):
            return _sum([(term, of(term)) for term in terms if not is_zero(term)] or [(tree, number(0))])
        case Mul(factors):
            return reduce(_times, [(factor, of(factor)) for factor in factors] or [(tree, number(1))])[1]
        case Pow(base, exponent):
            return _power(tree, of(base), exponent if isinstance(exponent, Fraction) else of(exponent), functions)
        case Fn("if", (condition, then, otherwise)):
            return of(then) if of(condition) else of(otherwise)
        case Fn(name, args):
            return _call(tree, functions.get(name), [of(arg) for arg in args])
        case Negative(inner):
            return -of(inner)
        case Quotient(top, bottom):
            return _quotient(tree, of(top), of(bottom))
        case Cross(left, right):
            return _cross(tree, of(left), of(right))
        case Dot(left, right):
            a, b = of(left), of(right)
            return np.einsum("ki,ki->k", a, b) if np.ndim(a) == np.ndim(b) == 2 else _times((left, a), (right, b))[1]
        case Column(items):
            return np.stack([_entry(item, of(item)) for item in items], axis=-1)[:, :, None]
        case Matrix(rows):
            return np.stack([np.stack([_entry(item, of(item)) for item in row], axis=-1) for row in rows], axis=1)
    raise TypeError(f"{type(tree).__name__} has no value")


def kind(value: Array) -> str:
    """What a value is, in words."""
    return ("a number", "a number", "a vector", "a matrix")[np.ndim(value)]


def size(value: Array) -> str:
    """What a value is, a matrix with its rows and columns."""
    return f"a matrix {value.shape[1]} × {value.shape[2]}" if np.ndim(value) == 3 else kind(value)


def advice(a: Array, b: Array) -> str:
    """What to try where one of two values is a number and the other a vector."""
    if {_rank(a), _rank(b)} == {1, 2}:
        return "give the number a direction (`i`, `j`, `k`), or take a component of the vector (`· i`)"
    return ""


def _rank(value: Any) -> int:
    """1 for a number, 2 for a vector, 3 for a matrix."""
    return max(np.ndim(value), 1)


def _sum(terms: Sequence[tuple[Node, Any]]) -> Any:
    total = terms[0][1]
    for node, each in terms[1:]:
        if _rank(each) != _rank(total) or (_rank(each) > 1 and each.shape != total.shape):
            raise StatementError(f"{size(each)} is added to {size(total)}", node.span, advice(total, each))
        total = total + each
    return total


def _times(left: tuple[Node, Any], right: tuple[Node, Any]) -> tuple[Node, Any]:
    (_, a), (node, b) = left, right
    ranks = _rank(a), _rank(b)
    if ranks == (1, 1):
        return node, a * b
    if ranks == (2, 2):
        raise StatementError("two vectors side by side", node.span, "write `×` or `·` between them")
    if ranks == (3, 3):
        if a.shape[2] != b.shape[1]:
            raise StatementError(f"{size(a)} cannot multiply {size(b)}", node.span)
        return node, a @ b
    if 1 not in ranks:
        raise StatementError("a matrix and a vector in i, j, k are multiplied", node.span, "write the vector as a column: (x, y)")
    return node, a * spread(b, a) if ranks[0] > 1 else spread(a, b) * b


def spread(value: Array, over: Array) -> Array:
    """The value with axes added behind, so that it multiplies each component."""
    return value.reshape(value.shape + (1,) * (over.ndim - value.ndim))


def _quotient(node: Quotient, top: Any, bottom: Any) -> Any:
    if _rank(top) == _rank(bottom) == 1:
        return top / bottom
    if _rank(bottom) == 1:
        return top / spread(bottom, top)
    if top.ndim == bottom.ndim == 2 and _upright(top) and _upright(bottom):
        return top[:, 2] / bottom[:, 2]
    raise StatementError(f"{kind(top)} is divided by {kind(bottom)}", node.bottom.span, "divide by a number")


def _upright(vector: Array) -> bool:
    """Whether a vector is along k, as cross products in the plane are."""
    return not vector[:, :2].any()


def _power(node: Pow, base: Any, exponent: Any, functions: Mapping[str, Callable[..., Any]]) -> Any:
    if _rank(base) != 1 or (not isinstance(exponent, Fraction) and _rank(exponent) != 1):
        raise StatementError(f"a power of {kind(base)}", node.base.span, "for the square of a vector write `a · a`")
    if not isinstance(exponent, Fraction):
        return functions.get("^", np.power)(base, exponent)
    if exponent == -1:
        return 1.0 / base
    if exponent == Fraction(1, 2):
        return np.sqrt(base)
    return np.power(np.asarray(base, dtype=float), float(exponent))[()]


def _call(node: Fn, function: Callable[..., Any] | None, arguments: list[Any]) -> Any:
    if function is None:
        raise KeyError(f"no table {node.name!r} is given; pass it in `tables`")
    if node.name == "abs" and _rank(arguments[0]) == 2:
        return np.linalg.norm(arguments[0], axis=1)
    for argument, found in zip(node.args, arguments, strict=True):
        if _rank(found) != 1:
            raise StatementError(f"`{node.name}` of {kind(found)}", argument.span, "it takes a number")
    return function(*arguments)


def _cross(node: Cross, left: Array, right: Array) -> Array:
    if left.ndim == right.ndim == 2:
        return np.cross(left, right)
    if left.ndim == right.ndim == 1:
        return left * right
    at = node.left if left.ndim != 2 else node.right
    hint = "an angular velocity is a vector along k: write `omega k ×`" if 1 in (left.ndim, right.ndim) else ""
    raise StatementError(f"a cross product of {kind(left)} and {kind(right)}", at.span, hint)


def _entry(node: Node, value: Array) -> Array:
    """An entry of a column or matrix: a number, or the k component of what is along k."""
    if value.ndim == 2 and _upright(value):
        return value[:, 2]
    if value.ndim != 1:
        raise StatementError(f"an entry that is {kind(value)}", node.span, "take a component, as in `k · (r × F)`")
    return value
