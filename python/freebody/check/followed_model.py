"""A model whose motion is followed: where a start has to be, and where something on its motion first vanishes."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from freebody.core import FreeBodies, State, Trajectory
from freebody.model.errors import ModelProblem
from freebody.solve.perturbed_states import independent, same_mode

from .arrangement import NOTHING, arranged
from .asked_model import AskedModel, does
from .families import BEFORE, Family, Samples
from .integrals import EXACT
from .moments import Moments, Switch, switches
from .sides import turns_over
from .stretches import zeros
from .user_symbols import LARGEST, LEAST, MOMENT, OF_START, OF_TIME

JUST_BEFORE, JUST_AFTER = 1 - 1e-6, 1 + 1e-6  # of the time to a moment, which is not found more exactly
_ROUND_OFF = 1e-12  # of what an expression typically changes by
_FEW_STEPS = 150  # on all of them, beyond which it is followed no farther
_LONG = 12.0  # of the time typical of the model: how long a run is followed at least
_INSIDE = 0.5, 0.3, 0.8  # parts of a stretch
_ZEROS = 4  # of an expression on a stretch, that are looked at
_ELSE = re.compile(f"{MOMENT}|⟦(?:{LARGEST}|{LEAST}): ")
"""What is asked of more than the start."""


@dataclass(frozen=True)
class Course:
    """How a motion goes: what switches on it, in its order, and what acts at the end."""

    switches: list[Switch]
    acts: FreeBodies

    @property
    def impacts(self) -> list[tuple[str, ...]]:
        return [of for kind, of, _ in self.switches if kind == "impact"]

    def is_like(self, other: Course) -> bool:
        """Whether the same switches on both, in the same order, and the same acts at the end."""
        return self.switches == other.switches and same_mode(self.acts, other.acts)


class FollowedModel(AskedModel):
    """A model with the motions that begin where it starts."""

    def vanishes(self, text: str, state: State) -> bool:
        """Whether an expression is 0 there."""
        return abs(float(Samples(self.core, [state]).values([text])[text][0])) <= NOTHING * self.size_of(text, state)

    def are_above(self, texts: Sequence[str], state: State) -> bool:
        """Whether expressions are above 0 there, by more than round-off."""
        values = self.core.evaluate(list(texts), state).tolist() if texts else []
        return all(value > _ROUND_OFF * self.size_of(text, state) for text, value in zip(texts, values, strict=True))

    def size_of(self, text: str, state: State) -> float:
        """What an expression changes by while coordinates, rates and parameters do by what is typical of the model."""
        by = np.abs(self.core.derivatives([text], state)[0, 1:])
        return float(by @ np.concatenate([self.sizes, self.rate * self.sizes, np.abs(state.p)]))

    def of_now(self, text: str, start: State | None) -> str:
        """An expression with numbers for what is asked of other moments of a motion from a start."""
        return Moments(self.core, start).in_numbers(text) if start else text

    def released(self, values: Mapping[str, float], family: Family) -> State:
        """The start, where it has to be, and with no rates where it is to be at rest."""
        start = self.put_together(values, family)
        still = {self.names[i]: 0.0 for i in independent(self.free_rates)}
        return self.put(self.moved(start, start.q, still) if family.at_rest else start, family, values)

    def put_together(self, values: Mapping[str, float], family: Family) -> State:
        """The start with other parameters, with its springs to the same side. Raises ``ModelProblem``."""
        start = self.started(values)
        if not family.scaled and turns_over(self.core, self.spec, self.first, start):
            raise ModelProblem("a spring is turned over at the start", "take other numbers")
        return start

    def put(self, start: State, family: Family, values: Mapping[str, float]) -> State:
        """A start, put where it has to be for what is asked of its place alone."""
        places = [OF_START.sub(r"(\1)", text) for text in self.of_start(family, start)]
        if family.since == BEFORE or all(self.vanishes(text, start) for text in places):
            return start
        return arranged(self, places, start, self._named(start.u), replace(family, at_rest=True, vanishing=()), values, ())

    def of_start(self, family: Family, start: State) -> list[str]:
        """What of that which vanishes is asked of the place alone where a motion starts."""
        asked = [text for text in family.vanishing if OF_START.search(text) and not _ELSE.search(text)]
        moving = slice(1, 1 + 2 * len(self.names))
        alone = (text for text in asked if not OF_TIME.search(text))
        return [text for text in alone if not self.core.derivatives([OF_START.sub("1", text)], start)[0, moving].any()]

    def followed(self, start: State, longs: Sequence[float]) -> Iterator[tuple[Trajectory, bool]]:
        """The motion from a start in stages that are so many times the time typical of the model long, the later ones as long as that
        takes few steps; each, and whether it goes on."""
        begins, steps = start.t, 0
        for long in longs:
            motion = self.run(start, long / self.rate, EXACT)
            goes_on, steps = motion.end.t >= start.t + 0.99 * long / self.rate, steps + len(motion.steps)
            yield motion, goes_on
            if not goes_on or (steps > _FEW_STEPS and motion.end.t > begins + _LONG / self.rate):
                return
            start = motion.end

    def course(self, start: State, until: float, by: float = JUST_BEFORE) -> Course:
        """What switches on the motion from a start up to just before or just after a time, and what acts there."""
        if until <= start.t:
            return Course([], self.core.free_bodies(start))
        motion = self.run(start, by * (until - start.t), EXACT)
        setting = [event["name"] for event in self.spec["events"] if does(event, "set")]
        done = [("event", (event.name,), ()) for event in motion.events if event.name in setting]
        return Course([*switches(motion), *done], self.core.free_bodies(motion.end))

    def _stays(self, text: str, motion: Trajectory, begins: float, ends: float) -> bool:
        """Whether an expression is 0 on all of a stretch."""
        return all(self.vanishes(text, motion.state(begins + part * (ends - begins))) for part in _INSIDE)

    def first_at(
        self, text: str, motion: Trajectory, parts: Sequence[tuple[float, float]], above: Sequence[str] = ()
    ) -> State | None:
        """Where an expression is first 0 behind the beginning of a motion, which may be just where something switches, while others are
        ``above`` 0."""
        for begins, ends in parts:
            if self._stays(text, motion, begins, ends):
                continue
            for t in (*zeros(lambda times: motion.evaluate([text], times)[:, 0], begins, ends, _ZEROS if above else 1), ends):
                it_has_not_jumped = self.vanishes(text, found := motion.state(t))
                if it_has_not_jumped and self.are_above(above, found):
                    return found
        return None
