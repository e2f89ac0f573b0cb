"""Figures that are printed to so many digits."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from freebody.symbolic.evaluate import Array
from freebody.symbolic.tree import Num, walk
from freebody.symbolic.tree import exchange as replaced

from .language.sides import equation_sides
from .language.statements import Equation, letters
from .residual import HOLDS, magnitude


def rounding(equation: Equation, values: Mapping[str, Array]) -> Array:
    """How far the sides may lie apart, by half the last printed digit of each figure with a decimal point; (K, n)."""
    base = equation_sides(equation, values).residual
    size = (magnitude(equation.left, values) + magnitude(equation.right, values)).reshape(len(base), -1)
    allowed = HOLDS * size
    for figure in figures(equation):
        allowed = allowed + np.abs(slope(equation, figure, values)) * last_digit(figure) / 2
    return allowed


def figures(equation: Equation) -> list[Num]:
    """The figures with a decimal point."""
    return [n for n in walk(equation) if isinstance(n, Num) and "." in n.text]


def last_digit(figure: Num) -> float:
    """What one more in the last printed digit is worth."""
    digits, _, power = figure.text.partition("e")
    return 10.0 ** (int(power or 0) - len(digits.split(".")[1]))


def slope(equation: Equation, figure: Num, values: Mapping[str, Array]) -> Array:
    """How fast the sides part as a figure grows."""
    step = last_digit(figure)
    moved = replaced(equation, figure, Num(figure.value + step, figure.text))
    return (equation_sides(moved, values).residual - equation_sides(equation, values).residual) / step


def is_figure(equation: Equation) -> bool:
    """Whether it says what one quantity is, in a figure."""
    return any(not letters(side) for side in (equation.left, equation.right)) and bool(figures(equation))
