"""What is asked of other moments of a motion than now: of its start, of what happens on it, of where something is largest."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, field

import numpy as np

from freebody.core import CompiledModel, State, Trajectory
from freebody.core.compiled import BEFORE
from freebody.model.start import quantity
from freebody.run.moments import Unreached, time_of

from .integrals import extreme
from .user_symbols import LARGEST, LEAST, MOMENT, OF_START

_EXACT = 1e-13  # tolerance of the motion on which something is waited for
_DOUBLED, _STEPS = 14, 5000  # how often it is followed twice as long, and how many steps that may take


@dataclass
class Moments:
    """The moments of the motion from a start, which is ``since`` seconds ago; each is looked for once."""

    core: CompiledModel
    start: State
    since: float = 0.0
    known: dict[str, State | None] = field(default_factory=dict)
    reached: dict[str, tuple[Trajectory, float] | None] = field(default_factory=dict)

    def in_numbers(self, text: str) -> str:
        """An expression with numbers for what is asked of other moments; NaN for one to which the motion does not come."""
        return OF_START.sub(lambda found: f"({self._value(found[1])!r})", text)

    def _value(self, of: str) -> float:
        if of.startswith((f"{LARGEST}: ", f"{LEAST}: ")):
            return extreme(of, self.core, self.start, self.since) if self.since else float("nan")
        text, _, moment = of.partition(MOMENT)
        if moment not in self.known:
            self.known[moment] = self._state(moment) if moment else self.start
        there = self.known[moment]
        return float(self.core.evaluate([text], there)[0]) if there else float("nan")

    def _state(self, moment: str) -> State | None:
        """The state at a time, or just before or after the first of what happens under a name."""
        name = moment.removeprefix(BEFORE)
        if name not in self.reached:
            self.reached[name] = self._reached(name)
        if (found := self.reached[name]) is None:
            return None
        motion, t = found
        if moment == name:
            return motion.state(t)
        return self.start if t == self.start.t else motion.state(float(np.nextafter(t, -np.inf)))

    def _reached(self, name: str) -> tuple[Trajectory, float] | None:
        """The motion up to a moment and that; None where it does not come to it."""
        core, start = self.core, self.start
        until, span = None, 1 / core.free_bodies(start).usual_rate(core.metadata["coordinates"], start.u)
        if name[0].isdigit():
            until = quantity("a moment", name, "s")
            span = until - start.t
        for doubled in range(_DOUBLED):
            motion = core.simulate(start, start.t + span * 2**doubled, rtol=_EXACT, max_steps=_STEPS)
            with suppress(Unreached):
                t = time_of(motion, name) if until is None else until
                if t <= motion.end.t:
                    return motion, t
            if until is not None or motion.end.t < start.t + span * 2**doubled:
                break
        return None
