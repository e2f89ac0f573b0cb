"""Figures of a statement: which are measured, to which digits they hold, and which others would hold instead."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from itertools import combinations

import numpy as np

from freebody.symbolic.evaluate import Array
from freebody.symbolic.tree import Mul, Negative, Node, Num, Pow, Sym, exchange, walk

from .language.spelling import spell
from .language.statements import Equation, rows, symbols_in, terms
from .residual import HOLDS, equation_sides, jacobian, sizes
from .stated import Correction

_DIRECTIONS = {Sym(name) for name in ("i", "j", "k")}
_FIGURE = Sym("the figure")
_SIGNIFICANT = 3  # digits of a whole number that count though they are zeros
_COMPUTED = 8  # digits, more than anybody measures
ROUND = 1e-9
"""Of half a digit, so that a figure that lies on the edge is accepted."""


def rounding(equation: Equation, values: Mapping[str, Array]) -> Array:
    """How far the sides may lie apart, by half the last printed digit of each measured figure; (K, n)."""
    allowed = HOLDS * sizes(equation, values)
    for figure in figures(equation):
        allowed = allowed + np.abs(slope(equation, figure, values)) * last_digit(figure) / 2
    return allowed


def figures(equation: Equation) -> list[Num]:
    """The figures that are measured: those with a decimal point or a power of ten, and where no symbol stands beside it, as in
    T = 575 N, a whole number of two digits or more."""
    alone = _alone(equation)
    exponents = [id(n.exponent) for term in alone for n in walk(term) if isinstance(n, Pow)]
    plain = {id(n) for term in alone for n in walk(term) if isinstance(n, Num) and len(n.text) > 1 and id(n) not in exponents}
    found = [n for n in walk(equation) if isinstance(n, Num) and n.text[:1].isdecimal()]
    return [n for n in found if id(n) in plain or not n.text.isdecimal()]


def says_a_figure(equation: Equation) -> bool:
    """Whether a measured figure is a term by itself, as in T = 57.5 N: that is so of one model's numbers."""
    alone = {id(n) for term in _alone(equation) for n in walk(term)}
    return any(id(figure) in alone for figure in figures(equation))


def says_a_measure(equation: Equation) -> bool:
    """Whether one side is a measured figure alone, as in a = 2.91 m/s²."""
    sides = ((equation.left, equation.right), (equation.right, equation.left))
    return any(not symbols_in(side) and symbols_in(other) and says_a_figure(Equation(other, side)) for side, other in sides)


def is_computed(equation: Equation) -> bool:
    """Whether a figure has so many digits that it was computed, of one model's numbers."""
    digits = (re.split("[eE]", figure.text)[0].replace(".", "").strip("0") for figure in figures(equation))
    return says_a_figure(equation) and any(len(each) >= _COMPUTED for each in digits)


def _alone(equation: Equation) -> list[Node]:
    """The terms beside which no symbol stands."""
    return [term for row in rows(equation) for term in terms(row) if _DIRECTIONS.issuperset(symbols_in(term))]


def last_digit(figure: Num) -> float:
    """What one more in the last printed digit is worth; of a whole number zeros beyond the third digit only hold a place."""
    digits, _, power = figure.text.lower().partition("e")
    whole, point, decimals = digits.partition(".")
    held = 0 if point else min(len(whole) - len(whole.rstrip("0")), max(len(whole) - _SIGNIFICANT, 0))
    return 10.0 ** (int(power or 0) - len(decimals) + held)


def slope(equation: Equation, figure: Num, values: Mapping[str, Array]) -> Array:
    """How fast the sides part as a figure grows, (K, rows)."""
    count, of = len(next(iter(values.values()), [0])), exchange(equation, figure, _FIGURE)
    return jacobian([of], {**values, _FIGURE.key: np.full(count, figure.value)}, [_FIGURE.key])[1][:, :, 0]


def corrected_figures(equation: Equation, values: Mapping[str, Array]) -> tuple[tuple[Correction, ...], bool]:
    """The fewest figures to be printed otherwise, and whether they are off by no more than one in the last digit."""
    printed = figures(equation)
    for count in range(1, len(printed) + 1):
        if found := [each for some in combinations(printed, count) for each in _printed_again(equation, some, values)]:
            return tuple(correction for correction, _ in found), all(last for _, last in found)
    return (), False


def _of_other_sign(equation: Equation, figure: Num) -> Equation:
    """The equation with the sign of what a figure stands in changed."""
    whole = next((n for n in walk(equation) if isinstance(n, Mul) and any(part is figure for part in n.factors)), figure)
    signed = next((n for n in walk(equation) if isinstance(n, Negative) and n.of is whole), None)
    return exchange(equation, signed, whole) if signed else exchange(equation, whole, Negative(whole))


def _printed_again(equation: Equation, chosen: tuple[Num, ...], values: Mapping[str, Array]) -> Iterator[tuple[Correction, bool]]:
    """The equation with other numbers for some figures, if these make it hold to its digits."""
    slopes = np.stack([slope(equation, figure, values)[0] for figure in chosen], axis=-1)
    steps = -np.linalg.pinv(slopes) @ equation_sides(equation, values).residual[0]
    after, edits, last = equation, [], True
    for figure, step in zip(chosen, steps, strict=True):
        digits, unit = re.split("[eE]", figure.text)[0], last_digit(figure)
        power = figure.text[len(digits) :]
        rounded = round((figure.value + step) / unit) * unit / float(f"1{power}")
        text = f"{rounded:.{len(digits.partition('.')[2])}f}{power}"
        number = Num(abs(float(text)), text.removeprefix("-"))
        after = exchange(after, figure, number)
        if float(text) * figure.value < 0:
            after = _of_other_sign(after, number)
        edits.append(("figure", figure.text, text))
        last &= abs(float(text) - figure.value) < 1.5 * unit
    left = np.abs(equation_sides(after, values).residual)
    if np.all(left <= rounding(after, values) * (1 + ROUND)):
        yield Correction(tuple(edits), spell(after), float(len(edits)), tuple(figure.span for figure in chosen)), last
