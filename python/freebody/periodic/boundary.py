"""Boundaries of stability: where a multiplier of a periodic motion comes to the unit circle as a parameter changes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise
from typing import Any

import numpy as np
from scipy.optimize import brentq

from freebody.core import Array
from freebody.periodic.motion import NoPeriodicMotion, find
from freebody.periodic.return_map import ReturnMap

_CONSERVED = 1e-8
"""Largest product of two multipliers less 1 along a scan that is none: they come in pairs μ, 1/μ."""
_ROUGH = 1e-7
"""Relative tolerance of the runs of a scan."""
_MET = 1e-8
"""What may be left of a condition on a boundary."""
_SETTLED = 1e-13
"""Part of a parameter by which a last step may change it."""


@dataclass(frozen=True)
class Crossing:
    """A place on a boundary of stability: the ``value`` of the parameter, at what ``others``; ``kind`` says how a multiplier leaves the
    unit circle: ``at 1``, ``at -1`` or ``as a pair``. ``multipliers`` (k,) are those there, ``miss`` is what is left of the
    condition."""

    value: float
    others: Mapping[str, float]
    kind: str
    multipliers: Array
    miss: float


CONDITIONS: Mapping[str, Callable[[Array], float]] = {
    "at 1": lambda slopes: float(np.linalg.det(slopes - np.eye(len(slopes)))),
    "at -1": lambda slopes: float(np.linalg.det(slopes + np.eye(len(slopes)))),
    "as a pair": lambda slopes: float(np.prod([a * b - 1 for a, b in combinations(np.linalg.eigvals(slopes), 2)]).real),
}
"""What vanishes where a multiplier is on the unit circle; for a pair the product of μᵢ μⱼ − 1 over all pairs (Kuznetsov, *Elements of
Applied Bifurcation Theory*, §10.2)."""


def crossings(
    returns: ReturnMap,
    parameter: str,
    within: tuple[float, float],
    start: Sequence[float] | Array,
    samples: int = 24,
    **others: Any,
) -> list[Crossing]:
    """All values of a parameter within bounds at which a multiplier of the periodic motion near ``start`` is on the unit circle: sign
    changes between ``samples`` values, spread evenly in the logarithm where the bounds are positive, then refined until a step
    no longer changes them. Two that lie between neighbouring samples are missed; more samples find them."""
    low, high = within
    values = np.geomspace(low, high, samples) if low > 0 else np.linspace(low, high, samples)
    rough = ReturnMap(**{**vars(returns), "rtol": _ROUGH})
    place = np.asarray(start, float)

    def slopes(by: ReturnMap, value: float) -> Array:
        nonlocal place  # each motion is sought from the last
        motion = find(by, place, **{**others, parameter: value})
        place = motion.start
        return motion.slopes

    scanned = [slopes(rough, value) for value in values.tolist()]
    found = []
    for kind, condition in CONDITIONS.items():
        of = [condition(each) for each in scanned]
        if kind == "as a pair" and (place.size < 2 or np.abs(of).max() < _CONSERVED):
            continue
        for (a, fa), (b, fb) in pairwise(zip(values.tolist(), of, strict=True)):
            if fa * fb < 0:
                near = brentq(lambda x: condition(slopes(rough, x)), a, b, rtol=1e-9)  # noqa: B023
                found.append(_refined(lambda x: slopes(returns, x), condition, kind, near, others))
    return sorted(found, key=lambda each: each.value)


def _refined(
    slopes: Callable[[float], Array], condition: Callable[[Array], float], kind: str, near: float, others: Mapping[str, float]
) -> Crossing:
    """Secants at the full tolerance from a value nearby."""
    old, new = near * (1 - 1e-4), near
    gap = condition(slopes(old))
    while True:
        at = slopes(new)
        here = condition(at)
        step = 0.0 if here == gap else here * (new - old) / (here - gap)
        if abs(step) <= _SETTLED * abs(new) or abs(step) >= abs(new - old):
            if abs(here) > _MET:
                raise NoPeriodicMotion(
                    f"the condition for a multiplier {kind} is not met near {near:g}: {here:.1e} is left of it"
                )
            return Crossing(new, dict(others), kind, np.linalg.eigvals(at), abs(here))
        old, gap, new = new, here, new - step
