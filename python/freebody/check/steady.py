"""Steady states of what is driven: motions that repeat with the drive."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import Array, State, quote
from freebody.solve.perturbed_states import independent

if TYPE_CHECKING:
    from .asked_model import AskedModel

_NEWTON = 4  # steps by which the motion that repeats is found; of a linear model one would do
_STEP = 1e-3  # of sizes and rates, by which slopes are taken
_REPEATS = 1e-10  # by how much, of the same, a period later it may be off
_SAME = 1e-9  # of accelerations, that they are the same a period later


def steady_state(model: AskedModel, rng: np.random.Generator, values: Mapping[str, float], rtol: float) -> State | None:
    """A state on the motion that repeats with the period of what drives a model with such parameters; None where none is found, or
    nothing drives it."""
    start = model.started(values)
    if (period := _period(model, start)) is None:
        return None
    places = [model.names[i] for i in independent(model.free_rates)]
    which = [model.names.index(name) for name in places]
    sizes = np.concatenate([model.sizes[which], model.rate * model.sizes[which]])

    def at(z: Array) -> State:
        q = start.q.copy()
        q[which] = z[: len(which)]
        return model.moved(start, q, dict(zip(places, z[len(which) :].tolist(), strict=True)))

    def back(z: Array) -> Array:
        end = model.run(at(z), period, rtol).end
        return (np.concatenate([end.q[which], end.u[which]]) - z) / sizes

    z = np.concatenate([start.q[which], start.u[which]])
    for _ in range(_NEWTON):
        off = back(z)
        if np.abs(off).max() < _REPEATS:
            return model.run(at(z), period * rng.uniform(0.1, 1.0), rtol).end
        slopes = np.array([(back(z + step) - back(z - step)) / (2 * _STEP) for step in np.diag(_STEP * sizes)]).T
        z = z - sizes * np.linalg.lstsq(slopes, off, rcond=None)[0]
    return None


def _period(model: AskedModel, state: State) -> float | None:
    """The longest time 2π/Ω, Ω a parameter, after which the same forces act at the same place; None where that is so at all times."""
    falls = [f"accel({quote(name)})" for name in model.names]
    frequencies = [x for x in np.abs(state.p).tolist() if x > 0]
    accelerations = lambda t: model.core.evaluate(falls, model.moved(state, state.q, {}, t=state.t + t))
    times = np.array([0.1, 0.37, 0.71]) / model.rate
    first = np.array([accelerations(t) for t in times])
    most = np.abs(first).max()
    if np.abs(np.diff(first, axis=0)).max() <= _SAME * most:
        return None
    for period in sorted((2 * np.pi / x for x in frequencies), reverse=True):
        if np.abs(np.array([accelerations(t + period) for t in times]) - first).max() <= _SAME * most:
            return float(period)
    return None
