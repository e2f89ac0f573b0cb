"""True motions of a model: random states with random parameters, solved by the core, on which a statement is tried."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import ModelError, MotionError, State
from freebody.model.errors import ModelProblem
from freebody.model.start import evaluate, initial_state
from freebody.run.records import Array
from freebody.symbolic.dimensions import ANGLE, Dimension

from .constrained_sampling import Loop
from .families import ALL, Family, NoMotion, Sample, Samples
from .runs import BALANCED, OnRuns

if TYPE_CHECKING:
    from freebody.model.builder import Builder

SAMPLES = 64
_TRIES = 40  # for one sample; a four-bar with random bars closes in about one of three
_FEW_TRIES = 8  # where a parameter is far from the model's, and states are rarer or none
_PATIENCE = 3  # samples, of which one at least must be found
_ENOUGH = 8  # samples to judge by
_FAST = 20  # times the usual rate: beyond it a closed loop is near a dead point
_FACTOR = (0.3, 3.0)
_LOOP_FACTOR = (0.7, 1.4)  # of lengths of closed loops, which have to close
_ANGLE_FACTOR = (0.4, 1.6)  # of angles, which are not free to grow
_NOTHING = 1e-11  # SI: what vanishes by a hypothesis is below it
_STEP = 1e-6  # of central differences by coordinates


class MotionSampler(OnRuns):
    """The true motions of a model. Families of samples are made once and kept."""

    def __init__(self, mechanism: Builder, seed: int = 0) -> None:
        super().__init__(mechanism)
        self.seed = seed
        self._families: dict[tuple[Family, int], Samples] = {}

    def samples(self, family: Family = ALL, count: int = SAMPLES, fresh: int = 0) -> Samples:
        """True states of a family; ``fresh`` other than 0 gives others than before. Raises ``NoMotion``."""
        key = (family, 1000 * fresh + count)
        if key not in self._families:
            self._families[key] = Samples(self.core, self._drawn_samples(family, count, fresh))
        if not self._families[key].samples:
            raise NoMotion(self._why_none(family))
        return self._families[key]

    def _why_none(self, family: Family) -> str:
        try:
            _ = self.first
        except MotionError as error:
            return f"the model does not start: {error.what}"
        there = "".join(f"has `{_stated(text)}` and " for text in family.vanishing)
        return f"no motion of this model was found that {there}is not singular, on a limit or of another mode than its start"

    def has(self, family: Family) -> bool:
        """Whether there are motions of a family."""
        with suppress(NoMotion):
            return bool(self.samples(family, _PATIENCE).samples)
        return False

    def _drawn_samples(self, family: Family, count: int, fresh: int) -> list[Sample]:
        """``count`` samples; none where the first ones already fail."""
        rng = np.random.default_rng([self.seed, fresh])
        found: list[Sample] = []
        for i in range(count):
            if i == _PATIENCE and not found:
                return []
            if (sample := self._sample(rng, family)) is not None:
                found.append(sample)
        return found if len(found) >= min(_ENOUGH, count) else []

    def _sample(self, rng: np.random.Generator, family: Family) -> Sample | None:
        for _ in range(_FEW_TRIES if family.scaled or family.held else _TRIES):
            with suppress(MotionError, ModelError, ModelProblem, ZeroDivisionError):
                if (made := self._made(rng, self._parameters(rng, family), family)) is not None:
                    return made
        return None

    def _made(self, rng: np.random.Generator, values: Mapping[str, float], family: Family) -> Sample | None:
        if family.since:
            found: Sample | None = self.since_start(rng, values, family)
        elif not self.restricted and not family.at_start:
            found = self._anywhere(rng, values, family)
        else:
            found = self.on_a_run(rng, values, family) if self.restricted else Sample(self.started(values))
        return found if found and all(self._vanishes(text, found, family) for text in family.vanishing) else None

    def _vanishes(self, text: str, sample: Sample, family: Family) -> bool:
        """Whether an expression is 0 there. Raises ``NoMotion`` where nothing can be done for it."""
        if abs(float(Samples(self.core, [sample]).values([text])[text][0])) < _NOTHING:
            return True
        if self.restricted:
            why = "contacts, strings, stops or friction decide how this model moves, so that it is tried on runs from its start"
            raise NoMotion(f"`{_stated(text)}` cannot be arranged: {why}")
        if family.at_start:
            raise NoMotion(f"`{_stated(text)}` does not hold at the start of this model")
        return False

    def _parameters(self, rng: np.random.Generator, family: Family) -> dict[str, float]:
        held, scaled = dict(family.held), dict(family.scaled)
        held |= {} if family.gravity else dict.fromkeys(self.gravities, 0.0)
        drawn = {name: self._drawn(rng, name, value, family) for name, value in self.free_parameters.items()}
        numbers = {name: x for name, x in held.items() if not isinstance(x, str)}
        plain = {name: numbers.get(name, value) * scaled.get(name, 1.0) for name, value in drawn.items()}
        return plain | {name: evaluate(x, plain) for name, x in held.items() if isinstance(x, str)}

    def _drawn(self, rng: np.random.Generator, name: str, value: float, family: Family) -> float:
        dimension = self.start.parameters.get(name)
        size, sign = rng.random(), rng.choice([-1.0, 1.0])
        if family.numbers or (value == 0 and not family.zeros):
            return value
        low, high = _ANGLE_FACTOR if dimension == ANGLE else _LOOP_FACTOR if self.shapes_loop(name) else _FACTOR
        factor = low * (high / low) ** size
        return value * factor if value else sign * factor * self.unit(dimension)

    def unit(self, dimension: Dimension | None) -> float:
        """What is typical of a dimension, SI."""
        if dimension is None:
            return 1.0
        return self.mass**dimension.mass * self.length**dimension.length * self.rate ** (-dimension.time)

    def _anywhere(self, rng: np.random.Generator, values: Mapping[str, float], family: Family) -> Sample | None:
        """A random state on the model's branch, none of whose limits is closed."""
        words = initial_state(self.start, self.core, values)
        t, own = 3 * rng.random() / self.rate, self.first.q
        angle = math.pi if self.loops == 0 or words["branch"] else 0.6
        spread = self.sizes * np.array([angle if c["dimension"] == "rad" else 1.0 for c in self.coordinates])
        guess = self.named(own + spread * rng.uniform(-1, 1, len(own)))
        rates = self.rates(rng, family)
        state, _ = self.core.assemble(words["p"], t, guess=guess, rates=rates, branch=words["branch"])
        small = [f"({text}) - ({size * _about(rng)!r})" for text, size in family.small]
        slow = [f"rate({text}) - ({size * self.rate * _about(rng)!r})" for text, size in family.small if not family.at_rest]
        for text in (*family.vanishing, *small, *slow):
            state = self._vanished(text, state, list(rates), words["branch"])
        solved = self.core.instant(state)
        if not all(limit.is_open and limit.gap >= 0 for limit in solved.limits.values()):
            return None
        judges = solved.residual < BALANCED and np.isfinite(solved.accelerations).all()
        return Sample(state) if judges and np.all(np.abs(state.u) < _FAST * self.rate * self.sizes) else None

    def _vanished(self, text: str, state: State, free: list[str], branch: Mapping[str, int]) -> State:
        """The nearest place, or else the nearest rates there, where an expression is 0."""
        q, u = state.q, state.u
        if self.loops:
            if abs(self._slope(text, state, q, u, 0)[0]) > _NOTHING and not free:
                raise NoMotion(f"`{_stated(text)}` cannot be arranged: the loops of this mechanism leave it no freedom")
            return Loop(self, free, branch).vanished(text, state) if free else state
        for _ in range(30):
            value, slope = self._slope(text, state, q, u, 0)
            if not slope.any() or abs(value) < 1e-14:
                break
            q = q - slope * value / (slope @ slope)
        value, slope = self._slope(text, state, q, u, 1)
        return replace(state, q=q, u=u - slope * value / (slope @ slope) if slope.any() else u)

    def _slope(self, text: str, state: State, q: Array, u: Array, order: int) -> tuple[float, Array]:
        """The value of an expression and its gradient by coordinates (0) or rates (1)."""

        def at(dq: Array, du: Array) -> float:
            return float(self.core.evaluate([text], replace(state, q=q + dq, u=u + du))[0])

        still, steps = np.zeros_like(q), _STEP * np.eye(len(q))
        if order:
            steps = steps / _STEP * self.rate
            return at(still, still), np.array([at(still, s) - at(still, still) for s in steps]) / self.rate
        return at(still, still), np.array([at(s, still) - at(-s, still) for s in steps]) / (2 * _STEP)


def _about(rng: np.random.Generator) -> float:
    """A number of the size of 1, of either sign."""
    return float(rng.uniform(0.3, 1.0) * rng.choice([-1.0, 1.0]))


def _stated(text: str) -> str:
    """What vanishes, as the equation that it comes from."""
    found = re.fullmatch(r"\((.+)\) - \((.+)\)", text)
    return f"{found[1]} = {found[2]}" if found else f"{text} = 0"
