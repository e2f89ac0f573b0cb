"""True states where contacts, strings, stops or friction decide what moves: they are taken from short runs."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np

from freebody.core import Array, CompiledModel, State, quote

from .families import ALL, Family, Sample
from .static_facts import StaticFacts

_EXACT = 1e-13  # of runs whose course matters
_RTOL = 1e-7  # of runs: every state on them is solved anew, so that they need not be accurate
_NEAR = 0.15  # of the time typical of the model: a run that lasts so long stays near its start
_APART = 0.2  # rad, or so much of the size of the model, by which places at rest differ
_PLACES = 12  # steps of Newton's method to one
_TOUCHES = 1e-12  # gap that is closed, relative to the size of the model
_STEPS = 2000  # of a run, which is short
_STEP = 1e-6  # of central differences of gaps, relative to the size of the model
_ONE_OF_SEVERAL = re.compile(r"\.N\d+$")  # the force at one place of a contact that holds at several
BALANCED = 1e-11
"""Largest relative residual of a state that may judge: below it is round-off, above it a bad condition."""


class OnRuns(StaticFacts):
    """The part of ``MotionSampler`` that samples runs from the model's start, as long as nothing switches."""

    @cached_property
    def own(self) -> Sample:
        """The state of the model at its start, after the events there."""
        return Sample(self.first, self._run(self.first, 1e-6 / self.rate) if self.restricted else None)

    @cached_property
    def restricted(self) -> bool:
        """Whether limits, joint friction or events at the start decide what moves, so that states must lie on runs."""
        if any(event.get("opening") for event in self.spec.get("events", [])) or self._sticky:
            return True
        return not all(limit.is_open for limit in self.core.instant(self.first).limits.values())

    @cached_property
    def _sticky(self) -> list[str]:
        return [j["name"] for j in self.spec["joints"] if j.get("friction")]

    @cached_property
    def _frictional(self) -> list[str]:
        """The rates at which joints with friction slide."""
        first = {j["name"]: j["coordinates"][0] for j in self.metadata["joints"] if j["coordinates"]}
        return [f"rate({quote(first[name])})" for name in self._sticky if name in first]

    def _run(self, state: State, until: float) -> Any:
        return self.core.simulate(state, state.t + until, rtol=_RTOL, max_steps=_STEPS)

    def rates(self, rng: np.random.Generator, family: Family) -> dict[str, float]:
        n = len(self.names)
        drawn = self.rate * self.sizes * rng.uniform(0.3, 1.5, n) * rng.choice([-1.0, 1.0], n)
        chosen = sorted(rng.permutation(n)[: self.freedom].tolist())
        return {self.names[i]: 0.0 if family.at_rest else float(drawn[i]) for i in chosen}

    def on_a_run(self, rng: np.random.Generator, values: Mapping[str, float], family: Family) -> Sample | None:
        """A state on a run from the model's start with random numbers and admissible rates, as long as nothing switches."""
        state = self.started(values)
        late = 0.0 if family.at_rest or family.at_start else _NEAR * rng.random() / self.rate
        if family.at_rest:
            state = State(state.p, state.t, state.q, np.zeros_like(state.u))
        if not (family.at_start or family.vanishing or state.u.any() or self._lies):
            state = self._placed(rng, state)
        if rng.random() < 0.7 and not (family.at_rest or family.at_start or self._lies):
            state = self._moving(rng, state)
        motion = self._run(state, max(late, 1e-6 / self.rate))
        return self._sampled(motion, state, min(late, 0.9 * motion.end.t))

    def since_start(self, rng: np.random.Generator, values: Mapping[str, float], family: Family) -> Sample | None:
        """A state on a run from the model's own start with random numbers, with the rates there or at rest, before
        anything switches."""
        state = self.started(values)
        if family.since == "rest":
            rates = self.rates(rng, replace(family, at_rest=True))
            state, _ = self.core.assemble(state.p, state.t, guess=self.named(state.q), rates=rates)
        late = rng.uniform(0.05, 0.3) / self.rate
        motion = self.core.simulate(state, state.t + late, rtol=_EXACT, max_steps=_STEPS)
        ends = [motion.end.t, *(change.t for change in motion.changes if change.t > state.t)]
        return self._sampled(motion, state, state.t + 0.99 * (min(ends) - state.t))

    def _sampled(self, motion: Any, start: State, t: float) -> Sample | None:
        """The state of a run at a time, if all holds there as at the model's start, and it may judge."""
        q, u = (a[0] for a in motion.sample(np.array([t])))
        found = State(start.p, t, q, u)
        same = not self.restricted or _same(self._mode(motion, found), self._own_mode)
        return Sample(found, motion) if same and motion.instant(t).residual < BALANCED else None

    def _placed(self, rng: np.random.Generator, state: State) -> State:
        """A random place near the start, at rest, where what is closed there is closed: bodies of other sizes touch elsewhere."""
        q = state.q + _APART * self.sizes * rng.uniform(-1, 1, len(self.names))
        for _ in range(_PLACES):
            found, _ = self.core.assemble(state.p, state.t, guess=self.named(q))
            gaps = self._gaps(found, found.q)
            if not np.isfinite(gaps[self._closed]).all():
                break
            if np.max(np.abs(gaps[self._closed]), initial=0.0) < _TOUCHES * self.length:
                return found if not found.u.any() else state
            slopes = self._slopes(found, self._closed)
            q = found.q - np.linalg.pinv(slopes * self.sizes) @ gaps[self._closed] * self.sizes
        return state

    @cached_property
    def _closed(self) -> list[int]:
        """The limits that are closed at the model's own start."""
        limits = self._own_mode[: len(self.metadata["limits"])]
        return [i for i, held in enumerate(limits) if held[0] not in ("open", "slack")]

    def _moving(self, rng: np.random.Generator, state: State) -> State:
        """Random rates that keep closed what is closed."""
        found, _ = self.core.assemble(state.p, state.t, guess=self.named(state.q), rates=self.rates(rng, ALL))
        if not np.allclose(found.q, state.q, atol=1e-9 * self.length):
            return state
        closed = [i for i, limit in enumerate(self.core.instant(state.at(state.q)).limits.values()) if not limit.is_open]
        u, rows = found.u - state.u, self._slopes(state, closed)
        seen = np.linalg.pinv(rows) @ (rows @ u) if rows.size else 0.0
        return State(state.p, state.t, state.q, found.u - seen)

    def _slopes(self, state: State, closed: Sequence[int]) -> Array:
        """Gradients of the gaps of limits, a row each."""
        steps, q = np.diag(_STEP * self.sizes), state.q
        columns = [(self._gaps(state, q + step) - self._gaps(state, q - step)) / (2 * step.sum()) for step in steps]
        return np.array(columns).T[closed]

    def _gaps(self, state: State, q: Array) -> Array:
        """How far every limit is from closing, less than 0 where it is violated, NaN where it has no gap."""
        return np.array([limit.gap for limit in self._untouched.instant(state.at(q)).limits.values()])

    @cached_property
    def _untouched(self) -> CompiledModel:
        """The model with nothing that its limits do."""
        off = {kind: [{**limit, "engaged": False} for limit in self.spec[kind]] for kind in ("contacts", "strings", "stops")}
        return CompiledModel.of({**self.spec, **off})

    @cached_property
    def _own_mode(self) -> tuple[Any, ...]:
        motion = self._run(self.first, 1e-3 / self.rate)
        return self._mode(motion, motion.end)

    def _mode(self, motion: Any, state: State) -> tuple[Any, ...]:
        """How every limit is held and to which side it slides, the sense of friction in every joint, at how many places contacts hold."""
        limits = tuple(
            (x.state, np.sign(round(np.nan_to_num(x.T), 12)) if x.state == "sliding" else 0)
            for x in motion.instant(state.t).limits.values()
        )
        has_friction = motion.evaluate(self._frictional, np.array([state.t]))[0] if self._frictional else np.empty(0)
        slow = 1e-9 * self.rate * min(self.length, 1.0)
        sides = (float(np.sign(x)) if abs(x) > slow else 0.0 for x in has_friction)
        return (*limits, *sides, self._places(state) if self._lies else 0)

    @cached_property
    def _lies(self) -> bool:
        """Whether a contact holds at several places, so that a turn would lift one: then random places and rates would end it."""
        return self._places(self.first) > 0

    def _places(self, state: State) -> int:
        """At how many places contacts hold that hold at several."""
        return sum(bool(_ONE_OF_SEVERAL.search(load.symbol)) for load in self.core.free_bodies(state).loads)


def _same(a: tuple[Any, ...], b: tuple[Any, ...]) -> bool:
    """Whether two modes are one; what slides without friction does so in either sense."""

    def alike(x: Any, y: Any) -> bool:
        return x == y or (isinstance(x, tuple) and x[0] == y[0] and 0 in (x[1], y[1]))

    return len(a) == len(b) and all(alike(x, y) for x, y in zip(a, b, strict=True))
