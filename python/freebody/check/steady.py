"""Steady states: motions that repeat with what drives a model, and those that are left where nothing of it changes with time."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import Array, MotionError, State, quote
from freebody.solve.perturbed_states import independent

if TYPE_CHECKING:
    from .asked_model import AskedModel

_NEWTON = 4  # steps by which the motion that repeats is found; of a linear model one would do
_STEP = 1e-3  # of sizes and rates, by which slopes are taken
_REPEATS = 1e-10  # by how much, of the same, a period later it may be off
_SETTLES, _RESTS, _FELT = 30, 1e-12, 1e-9
"""Steps by which a state is found where what dies away has done so, what may be left of it, and of what something depends on."""
_SAME = 1e-9  # of accelerations, that they are the same a period later


def steady_state(model: AskedModel, rng: np.random.Generator, values: Mapping[str, float], rtol: float) -> State | None:
    """A state on the motion that repeats with the period of what drives a model with such parameters; where nothing does, one in which
    what dies away has done so. None where none is found."""
    start = model.started(values)
    if (period := period_of(model, start)) is None:
        return None if start.t and model.spec["events"] else _settled(model, start)
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


def _settled(model: AskedModel, state: State) -> State | None:
    """The steady state near one; None where there is none. In it no direction accelerates on which accelerations depend, by place or by
    rate; those on which they depend by place move only as they keep up with what is prescribed."""
    which = independent(model.free_rates)
    names, n = [model.names[i] for i in which], len(model.names)
    if not names:
        return state
    falls, sizes = [f"accel({quote(name)})" for name in names], model.sizes[which]

    def parts(state: State) -> tuple[Array, Array, Array, Array, Array]:
        """In units typical of the model: the rates of all coordinates for unit rates of those that are free; the accelerations; their slopes
        by places and by rates of those; and how fast they change as all places move on."""
        free = model.rates_free_in(model.core.free_bodies(state))
        carried, units = free @ np.linalg.pinv(free[which]), model.rate**2 * sizes
        read = model.core.derivatives(falls, state)[:, 1 : 1 + 2 * n] * np.tile(model.sizes, 2) / units[:, None]
        goes_on = read[:, :n] @ (state.u / (model.rate * model.sizes))
        falling = model.core.evaluate(falls, state) / units
        return carried, falling, read[:, :n] @ carried, model.rate * read[:, n:] @ carried, goes_on

    def at(q: Array, change: Array) -> State:
        """The state at a place with rates that are changed by so much of those; strings stay taut where all have theirs."""
        rates = dict(zip(model.names, (state.u + model.rate * model.sizes * (carried @ change)).tolist(), strict=True))
        with suppress(MotionError):
            return model.moved(state, q, rates)
        return model.moved(state, q, {name: rates[name] for name in names})

    for step in range(_SETTLES):
        carried, falling, by_place, by_rate, goes_on = parts(state)
        held = _rows(by_place)
        if step == 0:  # what resists as a square of a rate has to have one
            push = falling - held.T @ (held @ falling)
            state = at(state.q, push / max(np.abs(push).max(), _RESTS))
            continue
        slowed = _rows(by_rate - by_rate @ held.T @ held)
        wanted = np.vstack([held, slowed])
        off = np.concatenate([wanted @ falling, held @ np.linalg.pinv(by_place) @ goes_on])
        if np.abs(off).max(initial=0.0) < _RESTS:
            return state
        slopes = np.block([[wanted @ by_place, wanted @ by_rate], [np.zeros_like(held), held]])
        change = -np.linalg.lstsq(slopes, off, rcond=None)[0]
        state = at(state.q + model.sizes * (carried @ change[: len(which)]), change[len(which) :])
    return None


def _rows(slopes: Array) -> Array:
    """Directions, in rows, on which something depends."""
    _, sizes, rows = np.linalg.svd(slopes)
    return rows[: int(np.sum(sizes > _FELT * max(1.0, sizes.max(initial=0.0))))]


def period_of(model: AskedModel, state: State) -> float | None:
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
        with suppress(MotionError):  # what is driven may be too far away by then
            if np.abs(np.array([accelerations(t + period) for t in times]) - first).max() <= _SAME * most:
                return float(period)
    return None
