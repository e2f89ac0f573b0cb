"""A motion to 25 digits and more, as a reference for other programs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal, localcontext
from itertools import pairwise
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

    from freebody.core import State
    from freebody.core.compiled import CompiledModel

_ORDERS = (32, 26)  # of the series; the second takes other steps, which shows what round-off makes of the motion
_CAUTION = 3  # the error, over what the two differ by
_MOST = 31  # digits of a double-double
_ROUND_OFF = Decimal(1).scaleb(-_MOST)


@dataclass(frozen=True)
class Reference:
    """Coordinates and their rates at times ``t`` (s, SI): ``reference["theta"]``, ``reference["rate(theta)"]``, a ``Decimal`` at each time, with
    the digits that hold. ``digits``: how many hold of the largest of each quantity so far, at least."""

    t: tuple[float, ...]
    values: Mapping[str, tuple[Decimal, ...]]
    digits: int

    def __getitem__(self, quantity: str) -> tuple[Decimal, ...]:
        return self.values[quantity]


def evenly(start: float, end: float) -> list[float]:
    """The times of a reference where none are asked for (s)."""
    return [start + (end - start) * i / 100 for i in range(101)]


def reference(model: CompiledModel, state: State, times: Sequence[float], digits: int) -> Reference:
    """The motion from a state by Taylor series over double-doubles, twice, with other steps. Raises ``MotionError`` for a motion without
    such a series, ``ValueError`` for times that do not follow each other, and where fewer digits hold than are asked for."""
    if late := [t for before, t in pairwise([state.t, *times]) if t < before]:
        raise ValueError(f"times follow each other from the start at {state.t:g} s on; {late[0]:g} s does not")
    names = [*model.coordinate_names, *(f"rate({name})" for name in model.coordinate_names)]
    with localcontext(prec=40):
        one, other = (_columns(*model.mechanism.reference(state.arrays, times, order)) for order in _ORDERS)
        found = {name: _held(*both) for name, both in zip(names, zip(one, other, strict=True), strict=True)}
    least = [min(held) for held in zip(*(held for _, held in found.values()), strict=True)]
    if short := [(t, held) for t, held in zip(times, least, strict=True) if held < digits]:
        (t, held) = short[0]
        hint = f"ask for `digits={max(held, 1)}`, or for a shorter motion"
        raise ValueError(f"{held} digits hold at t = {t:g} s, fewer than {digits}: round-off grows with the motion; {hint}")
    return Reference(tuple(times), {name: values for name, (values, _) in found.items()}, min(least))


def _columns(high: np.ndarray, low: np.ndarray) -> list[list[Decimal]]:
    """Of each quantity its values, of the sum of two doubles each."""
    return [
        [Decimal(a) + Decimal(b) for a, b in zip(*column, strict=True)]
        for column in zip(high.T.tolist(), low.T.tolist(), strict=True)
    ]


def _held(one: list[Decimal], other: list[Decimal]) -> tuple[tuple[Decimal, ...], list[int]]:
    """What holds of a quantity at each time, and how many digits of its largest size so far."""
    values, held = [], []
    size = error = Decimal(0)
    for a, b in zip(one, other, strict=True):
        size = max(size, abs(a))
        error = max(error, _CAUTION * abs(a - b), _ROUND_OFF * size)
        place = error.adjusted() + 1
        values.append(a.quantize(Decimal(1).scaleb(place)) if error else a)
        held.append(size.adjusted() - place if error else _MOST)
    return tuple(values), held
