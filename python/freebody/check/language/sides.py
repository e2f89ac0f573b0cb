"""Statements, evaluated: both sides of each equation at many samples."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import Array, advice, is_zero, sampled, size

from .statements import Equation, Program, inlined


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


def sides(program: Program, values: Mapping[str, Array]) -> list[Sides]:
    """The equations of a program, evaluated with its own names. Keys of ``values`` are those of ``Sym.key``."""
    try:
        return [equation_sides(line, values) for line in inlined(program)]
    except StatementError as error:
        raise error.within(program.text) from None


def equation_sides(equation: Equation, values: Mapping[str, Array]) -> Sides:
    """Both sides of an equation. Raises ``StatementError`` where they are of different kinds."""
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
