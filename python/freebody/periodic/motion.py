"""Periodic motions: fixed points of a return map, with their multipliers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from freebody.core import Array, MotionError
from freebody.model.errors import ModelProblem
from freebody.periodic.return_map import NoReturn, Return, ReturnMap
from freebody.periodic.variation import NotDifferentiable

_STEPS = 40
_FOUND = 1e-12
"""Step of Newton's method, over the sizes of the unknowns on the way, below which a fixed point is found."""
_ROUND_OFF = 1e-15
"""Part of these sizes by which a motion that repeats itself misses its start by round-off; at a multiplier 1 steps are large."""
_CLOSED = 1e-10
"""Part of these sizes by which the motion may miss its start."""
_SHORTEST = 2.0**-10
"""Part of a step of Newton's method below which it is given up."""
_SAME = 1e-7
"""Distance, over the bounds, below which two fixed points are one."""


class NoPeriodicMotion(ValueError):
    """No fixed point was found: from where, and how far Newton's method came."""


@dataclass(frozen=True)
class PeriodicMotion:
    """A motion that repeats itself: the ``values`` of the unknowns with which it starts, its ``period`` (s), the derivative of the
    return map there, ``slopes`` (k, k), and its ``multipliers`` (k,), largest first: the factors by which perturbations grow
    over a period. ``checks`` say how it was verified: how far it misses its start and the checks of the derivative (``Return``)."""

    values: Mapping[str, float]
    period: float
    slopes: Array
    multipliers: NDArray[np.complex128]
    checks: Mapping[str, float]
    returned: Return

    @property
    def stable(self) -> bool:
        """Whether all perturbations die out."""
        return bool(np.abs(self.multipliers).max() < 1)

    @property
    def exponents(self) -> NDArray[np.complex128]:
        """ln μ / T, 1/s: the growth of perturbations, and the angular frequency (within ±π/T) with which they turn."""
        return np.log(self.multipliers) / self.period


def find(returns: ReturnMap, start: Sequence[float] | Array, **others: Any) -> PeriodicMotion:
    """The periodic motion to which Newton's method comes from a start. Raises ``NoPeriodicMotion``."""
    values = np.asarray(start, float)
    try:
        here = returns(values, **others)
        for _ in range(_STEPS):
            step = np.linalg.lstsq(here.slopes - np.eye(len(values)), values - here.values, rcond=None)[0]
            size = np.maximum(here.scales, np.abs(values))
            miss = _miss(here, values)
            if miss <= _ROUND_OFF or (miss <= _FOUND and (np.abs(step) <= _FOUND * size).all()):
                return _periodic(returns, values, here)
            values, here = _shortened(returns, values, here, step, others)
    except (NoReturn, NotDifferentiable, MotionError) as error:
        raise NoPeriodicMotion(f"{_at(returns, values)}: {error}") from error
    raise NoPeriodicMotion(f"Newton's method did not settle, last at {_at(returns, values)}; try a start nearer to the motion")


def by_size(multipliers: Array) -> NDArray[np.complex128]:
    """Multipliers in order, the largest first; of a pair the one with the positive imaginary part."""
    multipliers = multipliers.astype(complex)
    return multipliers[np.lexsort((-multipliers.imag, -np.abs(multipliers).round(12)))]


def _shortened(returns: ReturnMap, values: Array, here: Return, step: Array, others: Mapping[str, Any]) -> tuple[Array, Return]:
    """A step of Newton's method, halved until the motion comes back nearer to its start."""
    part = 1.0
    while part >= _SHORTEST:
        there = values + part * step
        try:
            new = returns(there, **others)
        except (NoReturn, NotDifferentiable, MotionError):
            new = None
        if new and (_miss(new, there) < max(_miss(here, values), _CLOSED) or (len(values) > 1 and part < _SHORTEST * 2)):
            return there, new
        part /= 2
    raise NoReturn("no shorter step comes nearer to a motion that repeats itself")


def _miss(returned: Return, values: Array) -> float:
    size = np.maximum(returned.scales, np.abs(values))
    return float((np.abs(returned.values - values) / np.where(size > 0, size, 1.0)).max())


def _at(returns: ReturnMap, values: Array) -> str:
    return ", ".join(f"{name} = {value:g}" for name, value in zip(returns.unknowns, values, strict=True))


def _periodic(returns: ReturnMap, values: Array, returned: Return) -> PeriodicMotion:
    if (miss := _miss(returned, values)) > _CLOSED:
        raise NoReturn(f"the motion misses its start by {miss:.1e} of its size")
    multipliers = by_size(np.linalg.eigvals(returned.slopes))
    named = dict(zip(returns.unknowns, values.tolist(), strict=True))
    return PeriodicMotion(named, returned.time, returned.slopes, multipliers, {"return": miss, **returned.checks}, returned)


def find_all(
    returns: ReturnMap, within: Sequence[tuple[float, float]], starts: int = 32, **others: Any
) -> tuple[list[PeriodicMotion], int]:
    """The periodic motions within bounds of the unknowns to which Newton's method comes from ``starts`` points spread evenly over
    them (Sobol), in order of the first unknown; and from how many of the points it came to none."""
    low, high = np.array(within, float).T
    found: list[PeriodicMotion] = []
    lost = 0
    points = qmc.Sobol(len(low), scramble=False).random_base2(int(np.ceil(np.log2(starts))) + 1)[1:]
    for point in low + (high - low) * points:
        try:
            motion = find(returns, point, **others)
        except (NoPeriodicMotion, ModelProblem):
            lost += 1
            continue
        values = np.array(list(motion.values.values()))
        apart = (np.abs(values - np.array(list(known.values.values()))) / (high - low) for known in found)
        if ((low <= values) & (values <= high)).all() and all(each.max() > _SAME for each in apart):
            found.append(motion)
    return sorted(found, key=lambda each: next(iter(each.values.values()))), lost
