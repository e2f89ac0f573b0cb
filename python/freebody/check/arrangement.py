"""States at which what is asked of a motion is so: the nearest rates, place or parameter at which expressions are 0."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import Array, MotionError, State

from .families import Family, NoMotion

if TYPE_CHECKING:
    from .followed_model import FollowedModel

NOTHING = 1e-11  # of what an expression changes by within the model's sizes: what vanishes by a hypothesis is below it
_DONE = 1e-14  # of the same: where Newton's method has nothing left to do
_MANY_TIMES = 1e3  # a parameter that is to make an expression vanish is at most so much larger than it was drawn
_NEWTON = 30  # steps of it
_PATIENCE = 6  # of these, after which each has to halve what is left
_AGAIN = 2  # times that what is to vanish is arranged anew: to second order one moves another
_HALVES = 6  # times that a step is halved
_FELT = 1e-6  # of what an expression changes by within the model's sizes: below it what is to stay does so by itself
_STEP = 1e-6  # of central differences, relative to a parameter


def arranged(
    model: FollowedModel,
    conditions: Sequence[str],
    state: State,
    rates: Mapping[str, float],
    family: Family,
    values: Mapping[str, float],
    adjustable: Collection[str],
) -> State:
    """The nearest state at which ``conditions`` are 0, with rates other than those given unless it is at rest; where it cannot be so, with
    other ``values`` of those parameters that are ``adjustable``. Raises ``NoMotion`` and ``MotionError``."""
    kept: list[str] = []
    fitted: list[str] = []
    for text in (*conditions, *family.vanishing * _AGAIN):
        if family.at_rest or not model.vanishes(text, state):  # at rest what it changes by is less than with rates
            try:
                others = [each for each in kept if each != text]
                state = _vanished(model, text, state, list(rates), others, not family.at_rest)
            except (NoMotion, MotionError):
                fitted = list(dict.fromkeys((*fitted, text)))
                if (found := with_parameters(model, fitted, state, values, adjustable)) is None:
                    raise
                state = found
        kept += [text] if text in family.vanishing and text not in kept else []  # what is small need not stay just so
    return state


def with_parameters(
    model: FollowedModel, texts: Sequence[str], state: State, values: Mapping[str, float], adjustable: Collection[str]
) -> State | None:
    """The same state with other values of the ``adjustable`` parameters, of their signs and in ratios as near 1 as possible, at which expressions
    are 0."""
    names = [name for name in adjustable if values[name]]
    sizes, ratios = np.array([model.size_of(text, state) or 1.0 for text in texts]), np.zeros(len(names))
    off = np.inf

    def at(ratios: Array) -> tuple[State, Array]:
        fitted = {name: values[name] * ratio for name, ratio in zip(names, np.exp(ratios).tolist(), strict=True)}
        other = replace(state, p=model.core.bind({**values, **fitted}))
        return other, model.core.evaluate(list(texts), other) / sizes

    for _ in range(_NEWTON if names else 0):
        found, left = at(ratios)
        before, off = off, float(np.abs(left).max())
        if off <= _DONE or before / 2 < off <= NOTHING:
            return found
        slopes = np.array([at(ratios + step)[1] - at(ratios - step)[1] for step in _STEP * np.eye(len(names))]).T / (2 * _STEP)
        if not np.isfinite(slopes).all():
            return None
        ratios = ratios - np.clip(np.linalg.pinv(slopes, rcond=NOTHING) @ left, -1.0, 1.0)
        if np.abs(ratios).max() > math.log(_MANY_TIMES):
            return None
    return None


def _vanished(model: FollowedModel, text: str, state: State, free: Sequence[str], kept: Sequence[str], by_rates: bool) -> State:
    """The nearest rates if it may be ``by_rates``, or where they are not in it the nearest place, at which an expression is 0 and those ``kept``
    are what they were; ``free`` are the rates that can be given. Raises ``NoMotion`` and ``MotionError``."""
    kinds = (_Rates, _Place) if by_rates else (_Place,)
    ways = [kind(model, state, (text, *kept), free) for kind in kinds]
    way = next((way for way in ways if way.change(state) is not None), None)
    if way is None and ways[-1].left(state) <= NOTHING:  # it is so, whatever is free
        return state
    if way is None:
        why = "it depends on nothing that is free in" if model.free_rates.size else "no freedom is left in"
        raise NoMotion(f"`{stated(text)}` cannot be arranged: {why} this mechanism")
    left = [way.left(state)]
    for step in range(_NEWTON):
        crawls = step >= _PATIENCE and left[-1] > left[-2] / 2  # as towards what is infinitely far
        if left[-1] <= _DONE or crawls or (change := way.change(state)) is None:
            break
        state = way.towards(state, change)
        left.append(way.left(state))
    if left[-1] > NOTHING:
        raise NoMotion(f"`{stated(text)}` cannot be arranged: nothing near is so")
    return state


class _Rates:
    """By which rates the first of some expressions becomes 0, while the others are kept."""

    step = 1.0  # of central differences, in units

    def __init__(self, model: FollowedModel, state: State, texts: Sequence[str], free: Sequence[str]) -> None:
        self.model, self.texts, self.free = model, texts, free
        self.which = [model.names.index(name) for name in free]
        self.units = model.rate * model.sizes[self.which]
        self.sizes = np.array([model.size_of(each, state) or 1.0 for each in self.texts])

    def at(self, state: State) -> Array:
        """What is to be changed, in its units."""
        return state.u[self.which] / self.units

    def reached(self, state: State, x: Array) -> State:
        """The state with another of it."""
        return self.model.moved(state, state.q, dict(zip(self.free, (x * self.units).tolist(), strict=True)))

    def moves(self, state: State) -> Array:
        """What moves with it, by which is measured how near it stays."""
        return self.at(state)

    def left(self, state: State) -> float:
        """How far the expression is from 0, of what it changes by."""
        return abs(float(self.model.core.evaluate(self.texts[:1], state)[0])) / self.sizes[0]

    def slope(self, read: Callable[[Array], Array], x: Array, step: Array, here: Array) -> Array:
        """By how much what is read changes with one of it: both ways, so that squares of a rate that is 0 change nothing."""
        return (read(x + step) - read(x - step)) / (2 * self.step)

    def change(self, state: State) -> Array | None:
        """The least change by which the expression is 0 to first order; None where nothing changes it."""
        x = self.at(state)
        if not x.size:
            return None

        def read(there: Array) -> Array:
            found = self.reached(state, there)
            return np.concatenate([self.model.core.evaluate(self.texts, found) / self.sizes, self.moves(found)])

        here, steps = read(x), np.diag(np.full(len(x), self.step))
        slopes = np.array([self.slope(read, x, step, here) for step in steps]).T
        if not np.isfinite(slopes).all():
            return None  # nearby it has no value
        (first, *others), moved = np.split(slopes, [len(self.texts)])
        rows = np.array([first, *(row for row in others if np.abs(row).max() > _FELT)])
        near = np.linalg.pinv(moved.T @ moved) @ rows.T
        wanted = -self.model.core.evaluate(self.texts[:1], state)[0] / self.sizes[0] * np.eye(len(rows))[0]
        change = near @ np.linalg.pinv(rows @ near) @ wanted
        reaches = np.abs(first).max() > NOTHING and np.allclose(rows @ change, wanted, rtol=_FELT, atol=_FELT * abs(wanted[0]))
        return change if reaches else None

    def towards(self, state: State, change: Array) -> State:
        """The state so much farther on, or half as far where loops do not come there. Raises ``MotionError``."""
        for _ in range(_HALVES):
            with suppress(MotionError):
                return self.reached(state, self.at(state) + change)
            change = change / 2
        return self.reached(state, self.at(state) + change)


class _Place(_Rates):
    """By which place it becomes 0, with the same rates."""

    step = 1e-6

    def at(self, state: State) -> Array:
        return state.q / self.model.sizes

    def reached(self, state: State, x: Array) -> State:
        rates = dict(zip(self.free, state.u[self.which].tolist(), strict=True))
        return self.model.moved(state, x * self.model.sizes, rates)

    moves = at

    def slope(self, read: Callable[[Array], Array], x: Array, step: Array, here: Array) -> Array:
        return (read(x + step) - here) / self.step


def stated(text: str) -> str:
    """What vanishes, as the equation that it comes from."""
    found = re.fullmatch(r"(?:sin\(\()?\((.+)\) - \((.+?)\)(?:\)/2\))?", text)
    return f"{found[1]} = {found[2]}" if found else f"{text} = 0"
