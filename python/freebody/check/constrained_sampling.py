"""States of mechanisms with closed loops at which an expression is 0."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from freebody.core import State

from .families import NoMotion
from .static_facts import StaticFacts

_TRIES = 40  # of the secant method
_STEP = 1e-4  # rad or m, its first one
_DONE = 1e-14
_SEEN = 1e-9  # change by a first step below which a coordinate has no hold on the expression


@dataclass(frozen=True)
class Loop:
    """Where to look: near a state, moving ``free`` coordinates, which are as many as may be given at will."""

    sampler: StaticFacts
    free: Sequence[str]
    branch: Mapping[str, int]

    def vanished(self, text: str, state: State) -> State:
        """One rate is chosen so that the expression is 0; where rates are not in it, a coordinate. Raises ``NoMotion`` and ``MotionError``."""
        for change in (self._hurried, self._moved):
            for name in self.free:
                if (found := change(text, state, name)) is not None:
                    return found
        raise NoMotion(f"`{text}` depends on nothing that is free in this mechanism")

    def _moved(self, text: str, state: State, name: str) -> State | None:
        at = self.sampler.named(state.q)[name]
        x = at, at + _STEP
        tried = [self._closed(state, {name: at}, self._rates(state)) for at in x]
        f = tuple(self._value(text, each) for each in tried)
        if abs(f[1] - f[0]) < _SEEN * _STEP:
            return None
        found = tried[1]
        for _ in range(_TRIES):
            if abs(f[1]) < _DONE or f[1] == f[0]:
                return found
            x = x[1], x[1] - f[1] * (x[1] - x[0]) / (f[1] - f[0])
            found = self._closed(found, {name: x[1]}, self._rates(state))
            f = f[1], self._value(text, found)
        return found

    def _hurried(self, text: str, state: State, name: str) -> State | None:
        """Rates enter linearly, so that one step is enough."""
        here, rates = self.sampler.named(state.q), self._rates(state)
        fixed = {n: here[n] for n in self.free}
        one, two = (self._closed(state, fixed, rates | {name: rates[name] + more}) for more in (0.0, 1.0))
        f, g = self._value(text, one), self._value(text, two)
        return None if abs(g - f) < _SEEN else self._closed(state, fixed, rates | {name: rates[name] - f / (g - f)})

    def _closed(self, state: State, fixed: Mapping[str, float], rates: Mapping[str, float]) -> State:
        near = self.sampler.named(state.q)
        return self.sampler.core.assemble(state.p, state.t, fixed=fixed, guess=near, rates=rates, branch=self.branch)[0]

    def _rates(self, state: State) -> dict[str, float]:
        rates = self.sampler.named(state.u)
        return {name: rates[name] for name in self.free}

    def _value(self, text: str, state: State) -> float:
        return float(self.sampler.core.evaluate([text], state)[0])
