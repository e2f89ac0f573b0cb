"""Stretches of a motion between what switches on it, and where on one something first vanishes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from itertools import pairwise

import numpy as np

from freebody.core import Array, Trajectory
from freebody.run.moments import Unreached, time_of

_BEHIND = 1e-6  # of what is left of a stretch, by which the next zero is looked for behind one
_NOTHING = 1e-9  # of the largest value
_LOOKS, _FINER, _SHORTEST = 65, 12, 1e-15
"""Times at which it is looked for between two, how often again, and how near they may come."""
_ROUND = 2
"""How often again round an extreme: a parabola through values nearer each other is one through round-off."""


def stretches(motion: Trajectory, until: str = "") -> list[tuple[float, float]]:
    """Beginning and end of each, the last where something of a name first happens, if it does."""
    begins, ends = float(motion.steps[0]), motion.end.t
    with suppress(Unreached):
        ends = min(ends, time_of(motion, until)) if until else ends
    inside = (change.t for change in motion.changes if begins < change.t < ends)
    return list(pairwise(dict.fromkeys((begins, *inside, ends)))) or [(begins, ends)]


def zeros(of: Callable[[Array], Array], begins: float, ends: float, most: int) -> Iterator[float]:
    """The first of the zeros of a function of time behind its beginning, at ``most`` so many."""
    for _ in range(most):
        if (t := first_zero(of, begins, ends)) is None:
            return
        yield t
        begins = t + _BEHIND * (ends - t)


def first_zero(of: Callable[[Array], Array], begins: float, ends: float) -> float | None:
    """Where a function of time, read at many times at once, first goes through 0 behind its beginning; None where it does not."""
    times = np.linspace(begins, ends, _LOOKS)
    for _ in range(_FINER):
        values = of(times)
        crossings = np.flatnonzero((values[1:-1] * values[2:] <= 0) & (values[1:-1] != 0)) + 1
        at_once = values[0] * values[1] < 0  # a beginning that is 0 but for round-off is none, where it is 0 later
        if at_once and (not len(crossings) or abs(values[0]) > _NOTHING * np.abs(values).max()):
            crossings = np.zeros(1, int)
        if not len(crossings):
            return _touch(of, times, values)
        a, b = times[crossings[0]], times[crossings[0] + 1]
        if b - a <= _SHORTEST * (abs(b) + ends - begins):
            return float(b - (b - a) * values[crossings[0] + 1] / (values[crossings[0] + 1] - values[crossings[0]]))
        times = np.linspace(a, b, _LOOKS)
    return float(times[-1])


def _touch(of: Callable[[Array], Array], times: Array, values: Array) -> float | None:
    """Where it is 0 at an extreme, as the place at a dead centre; None where it is not."""
    most, sizes = np.abs(values).max(), np.abs(values)
    for i in np.flatnonzero((sizes[1:-1] < sizes[:-2]) & (sizes[1:-1] <= sizes[2:])) + 1:
        a, b = times[i - 1], times[i + 1]
        for _ in range(_ROUND):
            there = np.linspace(a, b, _LOOKS)
            k = int(np.clip(np.abs(of(there)).argmin(), 1, _LOOKS - 2))
            a, b = there[k - 1], there[k + 1]
        before, at, after = of(there[k - 1 : k + 2])
        bend = before - 2 * at + after
        t = float(there[k] + (there[k] - a) * (before - after) / (2 * bend)) if bend else float(there[k])
        if np.abs(of(np.array([t])))[0] <= _NOTHING * most:
            return t
    return None
