"""Figures as they are printed: with the digits that hold."""

from __future__ import annotations

import math

import numpy as np

from freebody.core import Array

MOST = 15  # digits of a double
NOISE = 1e-6  # of the largest of its kind: a quantity that stays below has no size of its own


class Known(float):
    """A number known up to ``error``, and the ``size`` that its quantity had so far, in the same unit. An error that is NaN claims
    nothing."""

    error: float
    size: float

    def __new__(cls, value: float, error: float, size: float) -> Known:
        """A number, its error and its size."""
        made = super().__new__(cls, value)
        made.error, made.size = error, size
        return made

    def __getnewargs__(self) -> tuple[float, float, float]:
        return float(self), self.error, self.size

    def beside(self, largest: float) -> Known:
        """The same beside others of its kind, the largest of which says what is round-off: that is 0."""
        return Known(self, self.error, max(self.size, NOISE * largest))

    def per(self, unit: float) -> Known:
        """The same in a unit of another size."""
        return Known(self / unit, self.error / unit, self.size / unit)

    def like(self, value: float) -> Known:
        """Another value of the same quantity."""
        return Known(value, self.error, self.size)

    @property
    def digits(self) -> int | None:
        """How many digits of the size hold; None if that is not known."""
        return None if math.isnan(self.error) else int(digits_of(self.error, self.size))


def digits_of(error: Array | float, size: Array | float) -> Array:
    """How many digits of a size an error leaves, not rounded: from 0 to 15."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.clip(-np.log10(np.where(np.equal(error, 0), 0.0, np.divide(error, size))), 0, MOST)


def figure(value: float, most: int = 6) -> str:
    """At most so many significant figures, of which all hold; -0 is 0, NaN is indeterminate."""
    if math.isnan(value):
        return "indeterminate"
    kept = most
    if isinstance(value, Known) and value.error > 0:
        if value.digits == 0:
            return "no digit"
        # The last figure that holds is the first place above the error.
        kept = min(most, math.floor(math.log10(abs(value) or value.error)) - math.floor(math.log10(value.error)))
    if kept < 1:
        return "0"
    value = float(value) + 0.0
    return f"{value:.{most}g}" if kept == most else f"{value:#.{kept}g}".rstrip(".").replace(".e", "e")
