"""Small vibrations that something harmonic forces, in the steady state (Thomson, Theory of Vibration, chapters 3 and 5)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import Array, State, quote

if TYPE_CHECKING:
    from .asked_model import AskedModel

_TIMES = np.array([0.13, 0.71, 1.6, 2.3, 3.7, 4.1, 5.9, 7.7])  # in typical ones of the model, at which it is felt what drives
_PART = 1e-3  # of what drives, by which slopes of fourth order are taken
_PURE = 1e-8  # of a harmonic, that the others may be


def forced_amplitudes(
    model: AskedModel, rest: State, a: Array, free: Sequence[str], values: Mapping[str, float], drive: str
) -> dict[str, float]:
    """How far the ``free`` coordinates go to and fro about a place of rest, of which ``a`` is the matrix of the linear equations
    d(x, x')/dt = a (x, x'), by a parameter ``drive`` that is small; none where what it does is not
    harmonic with a parameter as its frequency."""

    def at(part: float, late: float) -> State:
        p = model.core.bind({**model.free_parameters, **values, drive: part * values[drive]})
        return model.moved(rest, rest.q, {}, t=rest.t + late, p=p)

    falls, late = [f"accel({quote(name)})" for name in free], _TIMES / model.rate

    def slope(part: float) -> Array:
        more, less = (np.array([model.core.evaluate(falls, at(way * part, t)) for t in late]) for way in (1, -1))
        return (more - less) / (2 * part)

    def harmonic(frequency: float) -> tuple[float, float, Array]:
        """What is left of what is felt beside a mean value and a harmonic of a frequency, and that."""
        basis = np.array([np.ones(len(late)), np.cos(frequency * late), np.sin(frequency * late)]).T
        found = np.linalg.lstsq(basis, felt, rcond=None)[0]
        return float(np.abs(felt - basis @ found).max()), frequency, found[1] - 1j * found[2]

    felt = (4 * slope(_PART / 2) - slope(_PART)) / 3
    left, frequency, force = min(map(harmonic, {abs(x) for x in values.values() if x}), key=lambda each: each[0])
    if left > _PURE * np.abs(force).max():
        return {}
    found = np.linalg.solve(1j * frequency * np.eye(len(a)) - a, np.concatenate([np.zeros(len(free)), force]))[: len(free)]
    return dict(zip(free, np.abs(found).tolist(), strict=True))
