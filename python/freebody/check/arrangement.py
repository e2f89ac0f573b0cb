"""States at which what is asked of a motion is so: the nearest rates, place or parameter at which expressions are 0."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import Array, MotionError, State

from .families import Family, NoMotion

if TYPE_CHECKING:
    from .motion_sampler import MotionSampler

NOTHING = 1e-11  # of what an expression changes by within the model's sizes: what vanishes by a hypothesis is below it
_DONE = 1e-14  # of the same: where Newton's method has nothing left to do
_MANY_TIMES = 1e3  # a parameter that is to make an expression vanish is at most so much larger than it was drawn
_NEWTON = 30  # steps of it
_FELT = 1e-6  # of what an expression changes by within the model's sizes: below it what is to stay does so by itself
_STEP = 1e-6  # of central differences, relative to the size of a coordinate


def arranged(
    model: MotionSampler,
    conditions: Sequence[str],
    state: State,
    rates: Mapping[str, float],
    family: Family,
    values: Mapping[str, float],
    adjustable: Collection[str],
) -> State:
    """The nearest state at which ``conditions`` are 0, with rates other than those given unless it is at rest; where it cannot be so, with
    another of the ``values`` of those parameters that are ``adjustable``. Raises ``NoMotion`` and ``MotionError``."""
    kept: list[str] = []
    for text in conditions:
        if not model.vanishes(text, state):
            try:
                state = _vanished(model, text, state, [] if family.at_rest else list(rates), kept)
            except (NoMotion, MotionError):
                if (found := _fitted(model, text, state, values, adjustable)) is None:
                    raise
                state = found
        kept += [text] if text in family.vanishing else []  # what is small need not stay just so
    return state


def _fitted(
    model: MotionSampler, text: str, state: State, values: Mapping[str, float], adjustable: Collection[str]
) -> State | None:
    """The same state with another value of one ``adjustable`` parameter, of its sign, at which an expression is 0; first that which matters most."""
    size = model.size_of(text, state)

    def at(name: str, x: float) -> tuple[State, float]:
        other = replace(state, p=model.core.bind({**values, name: x}))
        return other, float(model.core.evaluate([text], other)[0])

    def slope(name: str, x: float) -> float:
        return (at(name, x * (1 + _STEP))[1] - at(name, x * (1 - _STEP))[1]) / (2 * _STEP * x)

    for name in sorted(
        (name for name in adjustable if values[name]), key=lambda name: -abs(slope(name, values[name]) * values[name])
    ):
        x = values[name]
        for _ in range(_NEWTON):
            found, left = at(name, x)
            if abs(left) <= _DONE * size:
                return found
            rises = slope(name, x)
            x -= left / rises if abs(rises * x) > NOTHING * size else x
            if not 0 < x / values[name] < _MANY_TIMES:
                break
    return None


def _vanished(model: MotionSampler, text: str, state: State, free: Sequence[str], kept: Sequence[str]) -> State:
    """The nearest rates, or where they are not in it the nearest place, at which an expression is 0 and those ``kept`` are what they were;
    ``free`` are the rates that can be given. Raises ``NoMotion`` and ``MotionError``."""
    which = [model.names.index(name) for name in free]

    def values(q: Array, rates: Array) -> Array:
        there = model.moved(state, q, dict(zip(free, rates.tolist(), strict=True)))
        return model.core.evaluate([text, *kept], there)

    def way(of: Callable[[Array], Array], at: Array, units: Array, step: float = 1.0) -> Array:
        """The direction in which the expression changes most while those that are kept stay, in ``units``."""
        if not at.size:
            return at
        first, *others = _slopes(of, at, step * units) * units
        felt = [row for row, size in zip(others, sizes[1:], strict=True) if np.abs(row).max(initial=0.0) > _FELT * size]
        return first - np.transpose(felt) @ np.linalg.lstsq(np.transpose(felt), first, rcond=None)[0] if felt else first

    q, u, sizes = state.q, state.u[which], [model.size_of(each, state) for each in (text, *kept)]
    speeds, least = model.rate * model.sizes[which], NOTHING * sizes[0]
    by_rates = np.abs(way(partial(values, q), u, speeds)).max(initial=0.0) > least
    for _ in range(_NEWTON):
        if abs(left := values(q, u)[0]) <= _DONE * sizes[0]:
            break
        units = speeds if by_rates else model.sizes
        along = way(partial(values, q), u, speeds) if by_rates else way(partial(values, rates=u), q, units, _STEP)
        if not np.abs(along).max(initial=0.0) > least:
            why = "it depends on nothing that is free in" if model.free_rates.size else "no freedom is left in"
            raise NoMotion(f"`{stated(text)}` cannot be arranged: {why} this mechanism")
        change = units * along * left / (along @ along)
        q, u = (q, u - change) if by_rates else (q - change, u)
    return model.moved(state, q, dict(zip(free, u.tolist(), strict=True)))


def _slopes(of: Callable[[Array], Array], at: Array, steps: Array) -> Array:
    """Derivatives of several numbers, a row each, by central differences."""
    return np.array([(of(at + step) - of(at - step)) / (2 * step.sum()) for step in np.diag(steps)]).T


def stated(text: str) -> str:
    """What vanishes, as the equation that it comes from."""
    found = re.fullmatch(r"\((.+)\) - \((.+)\)", text)
    return f"{found[1]} = {found[2]}" if found else f"{text} = 0"
