"""Places of rest followed as a parameter changes, through folds; where others branch off, and where oscillations begin to grow.

Pseudo-arclength continuation: Seydel, *Practical Bifurcation and Stability Analysis*, 3rd ed., ch. 4 and 5."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from scipy.optimize import brentq

from freebody.core import Array, CompiledModel, MotionError, State
from freebody.stability.equilibria import Equilibrium, equilibrium
from freebody.stability.modes import eigenvalues
from freebody.stability.state_space import SingularConfiguration, by_parameter, state_space

# Along a curve angles are in rad, lengths in parts of the size of the mechanism, the parameter in parts of its range.
_STEP, _SHORTEST = 0.03, 1e-6
STEPS, _CURVES = 1000, 12
_CORRECTIONS, _CLOSE = 8, 1e-11
_BEND = 0.9
"""Cosine between the directions at both ends of a step, below which it is halved."""
_ON = 0.1
"""Distance from a curve, in steps, within which a point is on it."""


@dataclass(frozen=True)
class Special:
    """Where a curve is special: at a ``fold`` it turns back in the parameter, at a ``branch point`` another crosses it, at a
    ``Hopf point`` an oscillation begins to grow, or ceases to. ``value`` is that of the parameter, SI; ``state`` the place."""

    kind: str
    value: float
    state: State


@dataclass(frozen=True)
class Curve:
    """Places of rest in the order of a curve, with the ``values`` of the parameter (SI) and ``special`` points. ``is_cut``: it goes on
    beyond the steps that were made."""

    values: Array
    equilibria: tuple[Equilibrium, ...]
    special: tuple[Special, ...]
    is_cut: bool = False


@dataclass(frozen=True)
class _Point:
    """A place of rest on a curve: its state, the scaled ``place`` with the parameter last, the direction ``along`` the curve, and what
    changes its sign at branch points and at Hopf points."""

    state: State
    place: Array
    along: Array
    determinant: float
    growth: float


def follow(
    source: CompiledModel, first: State, parameter: str, within: tuple[float, float], bind: Callable[[float], Array]
) -> tuple[list[Curve], int]:
    """The curves of places of rest through the place of rest ``first`` and through the branch points on them, while the parameter is
    ``within`` its range; ``bind`` gives all parameters for a value of it. A curve also ends where loops do not close or lose their
    independence. With them the number of branch points that are left. Raises ``ValueError`` where ``first`` is singular."""
    route = _Route(source, first, parameter, within, bind)
    curves: list[Curve] = []
    followed: list[list[_Point]] = []
    crossed: list[Array] = []
    waiting = [route.first(first)]
    while waiting and len(curves) < _CURVES:
        start = waiting.pop(0)
        back, on = (route.walk(replace(start, along=sign * start.along)) for sign in (-1, 1))
        if any(_is_on(side[0][0].place, known) for side in (back, on) for known in followed if side):
            continue
        points = [*(p for p, _ in reversed(back)), start, *(p for p, _ in on)]
        special = [found for _, found in [*reversed(back), *on] if found is not None]
        is_cut = any(len(side) >= STEPS for side in (back, on))
        followed.append(points)
        judged_points = tuple(each for p in points if (each := route.judged(p.state)) is not None)
        curves.append(
            Curve(np.array([each.state.p[route.which] for each in judged_points]), judged_points, tuple(special), is_cut)
        )
        for point in (route.crossing(each.state, points) for each in special if each.kind == "branch point"):
            if all(np.abs(point.place - place).max() > _ON * _STEP for place in crossed):
                crossed.append(point.place)
                waiting.append(point)
    return curves, len(waiting)


class _Route:
    """Steps along curves in the plane of scaled coordinates and parameter."""

    def __init__(
        self, source: CompiledModel, first: State, parameter: str, within: tuple[float, float], bind: Callable[[float], Array]
    ) -> None:
        coordinates = source.metadata["coordinates"]
        self.source, self.bind, self.low, self.range = source, bind, within[0], within[1] - within[0]
        self.names = [c["name"] for c in coordinates]
        if source.metadata["states"]:
            raise ValueError("places of rest of a model with states of its own are not followed along a parameter")
        self.which = [p["name"] for p in source.metadata["parameters"]].index(parameter)
        self.units = np.append(source.free_bodies(first).units(coordinates), self.range)

    def first(self, state: State) -> _Point:
        a, ways = self.slopes(state)
        return self.point(state, ways @ np.linalg.svd(a)[2][-1])

    def slopes(self, state: State) -> tuple[Array, Array]:
        """How accelerations change by the independent coordinates and the parameter, and what these make of the scaled place."""
        space = state_space(self.source, state)
        f, (by_q, by_p) = len(space.free), by_parameter(self.source, state, space, self.which)
        ways = np.zeros((len(self.units), f + 1))
        ways[:-1, :f], ways[:-1, f], ways[-1, f] = space.places[:, :f], by_q, 1.0
        return np.column_stack([space.a[f:, :f], by_p]), ways / self.units[:, None]

    def point(self, state: State, toward: Array) -> _Point:
        """A place of rest, with the direction along the curve that is nearest to another."""
        a, ways = self.slopes(state)
        scaled = np.linalg.qr(ways)[1]  # directions are measured in the scaled place
        along = ways @ np.linalg.solve(scaled, np.linalg.svd(a @ np.linalg.inv(scaled))[2][-1])
        values = eigenvalues(state_space(self.source, state))
        oscillating = values.real[values.imag != 0]
        sign, _ = np.linalg.slogdet(a[:, :-1])
        place = np.append(state.q, state.p[self.which] - self.low) / self.units
        growth = float(oscillating.max(initial=-np.inf))
        return _Point(state, place, along * (1 if along @ toward >= 0 else -1), float(sign), growth)

    def corrected(self, start: _Point, step: float) -> _Point | None:
        """The place of rest on the plane across the curve a step ahead; None where Newton's method does not come to one."""
        place = start.place + step * start.along
        try:
            for _ in range(_CORRECTIONS):
                state = self.closed(start.state, place)
                place = np.append(state.q, state.p[self.which] - self.low) / self.units
                a, ways = self.slopes(state)
                left = np.append(self.source.instant(state).accelerations[self.moving(state)], 0.0)
                left[-1] = start.along @ (place - start.place) - step
                change = ways @ np.linalg.solve(np.vstack([a, start.along @ ways]), -left)
                place = place + change
                if np.abs(change).max() < _CLOSE:
                    return self.point(self.closed(start.state, place), start.along)
        except (MotionError, SingularConfiguration, np.linalg.LinAlgError):
            pass
        return None

    def walk(self, start: _Point) -> list[tuple[_Point, Special | None]]:
        """The points from a start on, each with what is special between it and the one before."""
        found: list[tuple[_Point, Special | None]] = []
        here, step = start, _STEP
        while len(found) < STEPS:
            there = self.corrected(here, step)
            if there is None or there.along @ here.along < _BEND:
                step /= 2
                if step < _SHORTEST:
                    return found
                continue
            if not -1e-9 <= there.place[-1] <= 1 + 1e-9:
                if (last := self.at_border(here, step)) is not None:
                    found.append((last, None))
                return found
            found.append((there, self.special(here, there, step)))
            here, step = there, min(_STEP, 1.5 * step)
        return found

    def at_border(self, here: _Point, step: float) -> _Point | None:
        """Where the curve leaves the range of the parameter."""
        edge = 1.0 if here.along[-1] > 0 else 0.0
        try:
            part = brentq(lambda s: self.ahead(here, s).place[-1] - edge, 0.0, step, xtol=_CLOSE)
        except ValueError:
            return None
        return self.corrected(here, part)

    def ahead(self, here: _Point, step: float) -> _Point:
        """The point of a step that was made, or of a shorter one. Raises ``ValueError`` where there is none after all."""
        if step == 0.0:
            return here
        if (there := self.corrected(here, step)) is None:
            raise ValueError("the curve is lost within a step")
        return there

    def special(self, here: _Point, there: _Point, step: float) -> Special | None:
        """What changed its sign within a step, and where."""
        turns, singular = here.along[-1] * there.along[-1] < 0, here.determinant * there.determinant < 0
        begins = np.isfinite([here.growth, there.growth]).all() and here.growth * there.growth < 0
        try:
            if turns:
                part = brentq(lambda s: self.ahead(here, s).along[-1], 0.0, step, xtol=_CLOSE)
            elif singular or begins:
                sign = (lambda p: p.determinant) if singular else (lambda p: p.growth)
                part = brentq(lambda s: sign(self.ahead(here, s)), 0.0, step, xtol=_CLOSE)
            else:
                return None
            state = self.ahead(here, part).state
        except ValueError:
            return None
        kind = "fold" if turns and singular else "branch point" if turns or singular else "Hopf point"
        return Special(kind, float(state.p[self.which]), state)

    def crossing(self, state: State, points: list[_Point]) -> _Point:
        """A branch point with the direction of the curve that crosses the one of ``points`` there."""
        here = self.point(state, points[0].along)
        nearest = min(points, key=lambda p: float(np.abs(p.place - here.place).max()))
        a, ways = self.slopes(state)
        both = ways @ np.linalg.svd(a)[2][-2:].T  # the plane of both directions
        across = both - np.outer(nearest.along, nearest.along @ both)
        way = across[:, int(np.argmax(np.linalg.norm(across, axis=0)))]
        return replace(here, along=way / np.linalg.norm(way))

    def closed(self, near: State, place: Array) -> State:
        """The state at rest with loops closed near a scaled place."""
        *q, value = (place * self.units).tolist()
        guess = dict(zip(self.names, q, strict=True))
        found = self.source.assemble(self.bind(value + self.low), near.t, guess=guess, history=near.history)[0]
        return found.at(found.q)

    def moving(self, state: State) -> list[int]:
        """The coordinates that are independent."""
        return [self.names.index(name) for name in state_space(self.source, state).free]

    def judged(self, state: State) -> Equilibrium | None:
        """With its stability; None where it is singular."""
        try:
            return equilibrium(self.source, state)
        except SingularConfiguration:
            return None


def _is_on(place: Array, points: list[_Point]) -> bool:
    """Whether a place is on the polyline through points."""
    for one, other in pairwise(points):
        way = other.place - one.place
        part = np.clip(way @ (place - one.place) / (way @ way or 1.0), 0, 1)
        if np.linalg.norm(place - one.place - part * way) < _ON * _STEP:
            return True
    return False
