"""Both sides of an equation on true motions: how far they are apart, relative to its own terms."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce

import numpy as np

from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import Array, advice, is_zero, sampled, size, spread
from freebody.symbolic.tree import (
    Add,
    Column,
    Cross,
    Dot,
    Fn,
    Matrix,
    Mul,
    Negative,
    Node,
    Quotient,
    walk,
)

from .language.statements import Equation, terms

HOLDS = 1e-10
"""Below it, relative to the terms, an equation holds but for round-off."""
FAILS = 1e-6
"""Above it an equation is wrong; between the two a bad condition is to be suspected."""
_FEW, _BLURRED = 0.1, 1e-8
"""Share of the states that may be badly conditioned, and the worst that they may show."""
REACH = 1e-3
"""A term below it, relative to all, cannot be judged right or wrong."""
SLIGHT = 1e-5
"""The same where motions are short and exact: what holds to round-off holds such a term to a part of it."""
OFTEN = 8
"""Samples in which a term must reach that far."""
_ROUND_OFF = 1e-11  # of the terms on the sample where they are largest: on one where all are below it they are round-off
_FLOOR = 1e-6  # of a component of a vector against its largest: below it is round-off of directions
_THROUGH_ZERO = ("sin", "cos", "tan", "sinh", "asin", "atan")
"""Functions whose zero may be a difference of angles that are equal but for round-off."""
_MANY = 400  # terms, beyond which brackets stay
_STEP = 1e-4  # of a symbol's size, by which slopes are taken: they are exact where an equation is linear in it


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


def equation_sides(equation: Equation, values: Mapping[str, Array]) -> Sides:
    """Both sides of an equation; ``values`` by ``Sym.key``. Raises ``StatementError`` where they are of different kinds."""
    left, right = sampled(equation.left, values), sampled(equation.right, values)
    if is_zero(equation.right):
        right = np.zeros_like(left)
    elif is_zero(equation.left):
        left = np.zeros_like(right)
    if left.ndim == right.ndim == 3 and left.shape[1:] == right.shape[:0:-1] and 1 in left.shape[1:]:
        right = right.transpose(0, 2, 1)  # a row beside a column
    if left.shape != right.shape:
        raise StatementError(f"the left side is {size(left)}, the right side {size(right)}", equation.span, advice(left, right))
    return Sides(equation, left, right)


@dataclass(frozen=True)
class Residual:
    """An equation on K samples: ``ratio`` (K, n) is (left − right) over the sum of the sizes of all terms, a column a component."""

    sides: Sides
    ratio: Array

    @property
    def holds_but_for_few(self) -> bool:
        """Whether an equation holds where it has a value, as it has at most states, badly conditioned ones aside if they are few."""
        worst = np.abs(self.ratio).max(axis=1)
        there = worst[np.isfinite(worst)]
        return bool(2 * len(there) > len(worst) and np.mean(there >= HOLDS) <= _FEW and there.max() < _BLURRED)

    @property
    def worst(self) -> float:
        """Largest size of all; NaN where the equation has no value."""
        return float(np.max(np.abs(self.ratio), initial=0.0)) if np.isfinite(self.ratio).all() else float("nan")


def residual(equation: Equation, values: Mapping[str, Array]) -> Residual:
    """The relative residual. Raises ``StatementError``."""
    with np.errstate(all="ignore"):
        found, size = equation_sides(equation, values), sizes(equation, values)
        if found.left.ndim == 2:
            size = np.maximum(size, _FLOOR * size.max(axis=1, keepdims=True))
        nothing = _ROUND_OFF * np.max(size, axis=0, where=np.isfinite(size), initial=0.0)
        ratio = np.divide(found.residual, size, out=np.zeros_like(size), where=~(size <= nothing))
    return Residual(found, ratio)


class Edited:
    """Residuals of one equation after edits, at ``values``: the parts that they leave as they are have their values found once."""

    def __init__(self, equation: Equation, values: Mapping[str, Array]) -> None:
        self._values, self._count = values, len(next(iter(values.values()), [0.0]))
        self._own = {id(node): node for node in walk(equation)}
        self._known: dict[int, tuple[Array, Array]] = {}

    def residual(self, equation: Equation) -> Residual:
        """As the function ``residual`` has it. Raises ``StatementError``."""
        try:
            with np.errstate(all="ignore"):
                (left, a), (right, b) = self._both(equation.left), self._both(equation.right)
                size = (a + b)[:, None]
                nothing = _ROUND_OFF * np.max(size, axis=0, where=np.isfinite(size), initial=0.0)
                rest = (left - right)[:, None]
                return Residual(
                    Sides(equation, left, right), np.divide(rest, size, out=np.zeros_like(size), where=~(size <= nothing))
                )
        except _NoNumber:
            return residual(equation, self._values)

    def _both(self, node: Node) -> tuple[Array, Array]:
        """The value of a number and the sum of the sizes of its terms."""
        if (found := self._known.get(id(node))) is None:
            found = self._found(node)
            if found[0].ndim != 1:
                raise _NoNumber
            if id(node) in self._own:
                self._known[id(node)] = found
        return found

    def _found(self, node: Node) -> tuple[Array, Array]:
        match node:
            case Negative(of=of):
                value, size = self._both(of)
                return -value, size
            case Add(terms=terms):
                parts = [self._both(term) for term in terms if not is_zero(term)]
                zero = np.zeros(self._count)
                return sum((v for v, _ in parts), start=zero), sum((s for _, s in parts), start=zero)
            case Mul(factors=factors):
                parts = [self._both(factor) for factor in factors]
                return reduce(np.multiply, [v for v, _ in parts]), reduce(np.multiply, [s for _, s in parts])
            case Quotient(top=top, bottom=bottom):
                (above, size), (below, _) = self._both(top), self._both(bottom)
                return above / below, size / np.abs(below)
        value = sampled(node, self._values)
        return value, magnitude(node, self._values) if isinstance(node, Fn) else np.abs(value)


class _NoNumber(Exception):
    """What is a vector or a matrix."""


def sizes(equation: Equation, values: Mapping[str, Array]) -> Array:
    """The sum of the sizes of all terms of an equation, (K, n): one column a component."""
    rest = equation_sides(equation, values).residual
    return np.zeros_like(rest) + sum(magnitude(side, values).reshape(len(rest), -1) for side in (equation.left, equation.right))


def magnitude(node: Node, values: Mapping[str, Array]) -> Array:
    """The sum of the sizes of all terms of an expression, brackets multiplied out."""
    inside = lambda n: magnitude(n, values)
    match node:
        case Negative(of=of):
            return inside(of)
        case Add(terms=terms):
            return reduce(np.add, [inside(term) for term in terms if not is_zero(term)] or [np.abs(sampled(node, values))])
        case Mul(factors=factors):
            return reduce(_times, [inside(factor) for factor in factors])
        case Quotient(top=top, bottom=bottom):
            above, below = inside(top), np.abs(sampled(bottom, values))
            return above[:, 2] / below[:, 2] if above.ndim == below.ndim == 2 else above / spread(below, above)
        case Cross(left=left, right=right):
            a, b = inside(left), inside(right)
            pairs = ((1, 2), (2, 0), (0, 1))
            return a * b if a.ndim == 1 else np.stack([a[:, i] * b[:, j] + a[:, j] * b[:, i] for i, j in pairs], axis=-1)
        case Dot(left=left, right=right):
            a, b = inside(left), inside(right)
            return np.einsum("ki,ki->k", a, b) if a.ndim == b.ndim == 2 else _times(a, b)
        case Column(items=items):
            return np.stack([_scalar(inside(item)) for item in items], axis=-1)[:, :, None]
        case Matrix(rows=rows):
            return np.stack([np.stack([_scalar(inside(x)) for x in row], axis=-1) for row in rows], axis=1)
        case Fn(name=function, args=(of,)) if function in _THROUGH_ZERO:
            return np.maximum(np.abs(sampled(node, values)), np.minimum(_scalar(inside(of)), 1.0))
    return np.abs(sampled(node, values))


def _times(a: Array, b: Array) -> Array:
    if a.ndim == b.ndim == 3:
        return a @ b
    small, large = sorted((a, b), key=np.ndim)
    return spread(small, large) * large


def _scalar(value: Array) -> Array:
    return value[:, 2] if value.ndim == 2 else value


def unreached(equation: Equation, values: Mapping[str, Array], often: int = OFTEN, reach: float = REACH) -> list[Node]:
    """The terms that stay so small beside the others that this says nothing about them, but on ``often`` samples."""
    found = terms(equation, expand=True)
    found = found if len(found) <= _MANY else terms(equation)
    size = _length(magnitude(equation.left, values)) + _length(magnitude(equation.right, values))
    with np.errstate(all="ignore"):
        shares = [np.nan_to_num(_length(np.abs(sampled(term, values))) / size) for term in found]
    needed = min(often, len(size) // 2 or 1)
    return [term for term, share in zip(found, shares, strict=True) if np.sum(share >= reach) < needed]


def _length(value: Array) -> Array:
    return np.linalg.norm(value.reshape(len(value), -1), axis=1) if value.ndim > 1 else np.abs(value)


# -- how fast the sides part


def jacobian(equations: Sequence[Equation], values: Mapping[str, Array], keys: Iterable[str]) -> tuple[Array, Array]:
    """Left less right of equations, (K, rows), and how fast it grows with symbols, (K, rows, columns): a number has one column, a
    vector one for each direction that it takes."""

    def left(moved: Mapping[str, Array]) -> Array:
        return np.concatenate([equation_sides(equation, {**values, **moved}).residual for equation in equations], axis=1)

    base, columns = left({}), []
    for key in keys:
        step = _STEP * (np.max(np.abs(values[key])) or 1.0)
        ways = [way for way in np.eye(3) if (values[key] @ way).any()] if values[key].ndim == 2 else [1.0]
        columns += [(left({key: values[key] + step * way}) - base) / step for way in ways]
    return base, np.stack(columns, axis=-1) if columns else np.zeros((*base.shape, 0))
