"""What is asked of other moments of a motion than now: of its start, of what happens on it, of where something is largest."""

from __future__ import annotations

import re
from contextlib import suppress
from dataclasses import dataclass, field

import numpy as np

from freebody.core import CompiledModel, State, Trajectory
from freebody.core.compiled import BEFORE
from freebody.model.start import quantity
from freebody.run.moments import Unreached, time_of

from .integrals import EXACT, extreme, turning
from .user_symbols import LARGEST, LEAST, MOMENT, OF_START

_DOUBLED, _STEPS = 14, 5000  # how often it is followed twice as long, and how many steps that may take


Switch = tuple[str, tuple[str, ...], tuple[float, ...]]
"""Of which kind something is that switches, what does so, and how it slides in an impact."""


@dataclass
class Moments:
    """The moments of the motion from a start, which is ``since`` seconds ago; each is looked for once. One to which it comes otherwise than
    the ``usual`` motion, that of the model itself, is none."""

    core: CompiledModel
    start: State
    since: float = 0.0
    usual: Moments | None = None
    known: dict[str, State | None] = field(default_factory=dict)
    reached: dict[str, tuple[Trajectory, float] | None] = field(default_factory=dict)

    def in_numbers(self, text: str) -> str:
        """An expression with numbers for what is asked of other moments; NaN for one to which the motion does not come."""
        return OF_START.sub(lambda found: f"({self._value(found[1])!r})", text)

    def of_repeating(self, text: str) -> str:
        """The same on a motion that goes to and fro: only what is largest or least has a value."""

        def between(found: re.Match[str]) -> str:
            which, _, of = found[1].partition(": ")
            ends = turning(of, self.core, self.start) if which in (LARGEST, LEAST) else (float("nan"),)
            return f"({(max if which == LARGEST else min)(ends)!r})"

        return OF_START.sub(between, text)

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
        if (found := self.coming_to(name)) is None:
            return None
        motion, t = found
        if moment == name:
            return motion.state(t)
        return self.start if t == self.start.t else motion.state(float(np.nextafter(t, -np.inf)))

    def coming_to(self, name: str) -> tuple[Trajectory, float] | None:
        """The motion up to a moment and that; None where it does not come to it, or not as the usual one does."""
        if name not in self.reached:
            self.reached[name] = found = self._reached(name)
            own = self.usual.coming_to(name) if self.usual and found else None
            if found and own and switches(*found) != switches(*own):
                self.reached[name] = None
        return self.reached[name]

    def _reached(self, name: str) -> tuple[Trajectory, float] | None:
        """The motion up to a moment and that; None where it does not come to it."""
        core, start = self.core, self.start
        until, span = None, 1 / core.free_bodies(start).usual_rate(core.metadata["coordinates"], start.u)
        if name[0].isdigit():
            until = quantity("a moment", name, "s")
            span = until - start.t
        for doubled in range(_DOUBLED):
            motion = core.simulate(start, start.t + span * 2**doubled, rtol=EXACT, max_steps=_STEPS)
            with suppress(Unreached):
                t = time_of(motion, name) if until is None else until
                if t <= motion.end.t:
                    return motion, t
            if until is not None or motion.end.t < start.t + span * 2**doubled:
                break
        return None


def switches(motion: Trajectory, until: float = np.inf) -> list[Switch]:
    """What switches on a motion up to a time."""
    slides = lambda change: tuple(change.impulses.slides.values()) if change.impulses else ()
    return [(change.kind, change.of, slides(change)) for change in motion.changes if change.t <= until]
