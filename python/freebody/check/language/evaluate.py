"""The value of what a person wrote, at many samples at once.

A number is (K,) over K samples, a vector (K, 3) with components along i, j, k, a matrix (K, r, c); a column is (K, r, 1).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import reduce

import numpy as np
from numpy.typing import NDArray

from .errors import StatementError
from .nodes import (
    Call,
    Column,
    Cross,
    Dot,
    Equation,
    Letter,
    Matrix,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Program,
    Quotient,
    Sum,
    Unit,
    inlined,
)

Array = NDArray[np.float64]

FUNCTIONS: dict[str, Callable[..., Array]] = {
    **{name: getattr(np, name) for name in ("sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "sqrt", "sign", "hypot")},
    **{"asin": np.arcsin, "acos": np.arccos, "atan": np.arctan, "atan2": np.arctan2, "ln": np.log, "abs": np.abs},
    **{"cot": lambda x: 1 / np.tan(x), "sec": lambda x: 1 / np.cos(x), "csc": lambda x: 1 / np.sin(x)},
    **{"min": np.minimum, "max": np.maximum},
}
ARGUMENTS = {"atan2": 2, "hypot": 2, "min": 2, "max": 2}


@dataclass(frozen=True)
class Sides:
    """Both sides of an equation, of one kind and shape."""

    equation: Equation
    left: Array
    right: Array

    @property
    def residual(self) -> Array:
        """Left less right, (K, n): one column a component."""
        return (self.left - self.right).reshape(len(self.left), -1)


def kind(value: Array) -> str:
    """What a value is, in words."""
    return ("a number", "a vector", "a matrix")[value.ndim - 1]


def sides(program: Program, values: Mapping[str, Array]) -> list[Sides]:
    """The equations of a program, evaluated with its own names. Keys of ``values`` are those of ``Letter.key``."""
    try:
        written_out = [equation_sides(line, values) for line in inlined(program)]
    except StatementError as error:
        raise error.within(program.text) from None
    return [Sides(line, s.left, s.right) for line, s in zip(program.equations, written_out, strict=True)]


def equation_sides(equation: Equation, values: Mapping[str, Array]) -> Sides:
    """Both sides of an equation. Raises ``StatementError`` where they are of different kinds."""
    left, right = evaluate(equation.left, values), evaluate(equation.right, values)
    if is_zero(equation.right):
        right = np.zeros_like(left)
    elif is_zero(equation.left):
        left = np.zeros_like(right)
    if left.ndim == right.ndim == 3 and left.shape[1:] == right.shape[:0:-1] and 1 in left.shape[1:]:
        right = right.transpose(0, 2, 1)  # a row beside a column
    if left.shape != right.shape:
        raise StatementError(
            f"the left side is {_size(left)}, the right side {_size(right)}", equation.span, _advice(left, right)
        )
    return Sides(equation, left, right)


def is_zero(node: Node) -> bool:
    """Whether it is a written 0, which fits numbers, vectors and matrices alike."""
    return isinstance(node, Number) and node.value == 0


def evaluate(node: Node, values: Mapping[str, Array]) -> Array:
    """The value of an expression; ``values`` by ``Letter.key``, all over the same K samples.

    Raises ``StatementError`` at a letter without a value and where kinds do not go together.
    """
    match node:
        case Number(value=value) | Unit(size=value):
            return np.full(_samples(values), value)
        case Letter():
            return _letter(node, values)
        case Negative(of=of):
            return -evaluate(of, values)
        case Sum(terms=terms):
            return _sum([(term, evaluate(term, values)) for term in terms if not is_zero(term)], values)
        case Product(factors=factors):
            return _product([(factor, evaluate(factor, values)) for factor in factors])
        case Quotient(top=top, bottom=bottom):
            return _quotient(node, evaluate(top, values), evaluate(bottom, values))
        case Power(base=base, exponent=exponent):
            return _power(node, evaluate(base, values), evaluate(exponent, values))
        case Call(function=function, arguments=arguments):
            return _call(node, function, [evaluate(argument, values) for argument in arguments])
        case Cross(left=left, right=right):
            return _cross(node, evaluate(left, values), evaluate(right, values))
        case Dot(left=left, right=right):
            return _dot((left, evaluate(left, values)), (right, evaluate(right, values)))
        case Column(items=items):
            return np.stack([_entry(item, values) for item in items], axis=-1)[:, :, None]
        case Matrix(rows=rows):
            return np.stack([np.stack([_entry(item, values) for item in row], axis=-1) for row in rows], axis=1)
    raise TypeError(f"{type(node).__name__} has no value")


def _samples(values: Mapping[str, Array]) -> int:
    return len(next(iter(values.values()))) if values else 1


def _letter(letter: Letter, values: Mapping[str, Array]) -> Array:
    if letter.key not in values:
        raise StatementError(f"`{letter.key}` has no meaning here", letter.span, "declare it in terms of the model's letters")
    return np.asarray(values[letter.key], dtype=float)


def _sum(terms: list[tuple[Node, Array]], values: Mapping[str, Array]) -> Array:
    if not terms:
        return np.zeros(_samples(values))
    first = terms[0][1]
    for node, value in terms[1:]:
        if value.shape != first.shape:
            raise StatementError(f"{_size(value)} is added to {_size(first)}", node.span, _advice(first, value))
    return reduce(np.add, [value for _, value in terms])


def _product(factors: list[tuple[Node, Array]]) -> Array:
    return reduce(_times, factors)[1]


def _times(left: tuple[Node, Array], right: tuple[Node, Array]) -> tuple[Node, Array]:
    (_, a), (node, b) = left, right
    if a.ndim == b.ndim == 2:
        raise StatementError("two vectors side by side", node.span, "write `×` or `·` between them")
    if a.ndim == b.ndim == 3:
        if a.shape[2] != b.shape[1]:
            raise StatementError(f"{_size(a)} cannot multiply {_size(b)}", node.span)
        return node, a @ b
    if {a.ndim, b.ndim} == {2, 3}:
        raise StatementError("a matrix and a vector in i, j, k are multiplied", node.span, "write the vector as a column: (x, y)")
    return node, a * _spread(b, a) if a.ndim >= b.ndim else _spread(a, b) * b


def _spread(value: Array, over: Array) -> Array:
    """The value with axes added behind, so that it multiplies each component."""
    return value.reshape(value.shape + (1,) * (over.ndim - value.ndim))


def _quotient(node: Quotient, top: Array, bottom: Array) -> Array:
    if bottom.ndim == 1:
        return top / _spread(bottom, top)
    if top.ndim == bottom.ndim == 2 and _upright(top) and _upright(bottom):
        return top[:, 2] / bottom[:, 2]
    raise StatementError(f"{kind(top)} is divided by {kind(bottom)}", node.bottom.span, "divide by a number")


def _upright(vector: Array) -> bool:
    """Whether a vector is along k, as cross products in the plane are."""
    return not vector[:, :2].any()


def _power(node: Power, base: Array, exponent: Array) -> Array:
    if base.ndim != 1 or exponent.ndim != 1:
        raise StatementError(f"a power of {kind(base)}", node.base.span, "for the square of a vector write `a · a`")
    with np.errstate(all="ignore"):
        return np.power(base, exponent)


def _call(node: Call, function: str, arguments: list[Array]) -> Array:
    if function == "abs" and arguments[0].ndim == 2:
        return np.linalg.norm(arguments[0], axis=1)
    for argument, value in zip(node.arguments, arguments, strict=True):
        if value.ndim != 1:
            raise StatementError(f"`{function}` of {kind(value)}", argument.span, "it takes a number")
    with np.errstate(all="ignore"):
        return FUNCTIONS[function](*arguments)


def _cross(node: Cross, left: Array, right: Array) -> Array:
    if left.ndim == right.ndim == 2:
        return np.cross(left, right)
    if left.ndim == right.ndim == 1:
        return left * right
    at = node.left if left.ndim != 2 else node.right
    hint = "an angular velocity is a vector along k: write `omega k ×`" if 1 in (left.ndim, right.ndim) else ""
    raise StatementError(f"a cross product of {kind(left)} and {kind(right)}", at.span, hint)


def _dot(left: tuple[Node, Array], right: tuple[Node, Array]) -> Array:
    if left[1].ndim == right[1].ndim == 2:
        return np.einsum("ki,ki->k", left[1], right[1])
    return _times(left, right)[1]


def _entry(node: Node, values: Mapping[str, Array]) -> Array:
    """An entry of a column or matrix: a number, or the k component of what is along k."""
    value = evaluate(node, values)
    if value.ndim == 2 and _upright(value):
        return value[:, 2]
    if value.ndim != 1:
        raise StatementError(f"an entry that is {kind(value)}", node.span, "take a component, as in `k · (r × F)`")
    return value


def _size(value: Array) -> str:
    return f"a matrix {value.shape[1]} × {value.shape[2]}" if value.ndim == 3 else kind(value)


def _advice(a: Array, b: Array) -> str:
    if {a.ndim, b.ndim} == {1, 2}:
        return "give the number a direction (`i`, `j`, `k`), or take a component of the vector (`· i`)"
    return ""
