"""A place of rest near a state, in numbers: where the accelerations that the core gives vanish."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from freebody.core import MotionError, State
from freebody.solve.instant import Instant
from freebody.solve.perturbed_states import Closing

if TYPE_CHECKING:
    from freebody.core import Array, CompiledModel

_STEPS = 60
_LONGEST = 0.2
"""Step of Newton's method, rad or m, beyond which it is shortened."""
_SLOPE = 1e-6
_FOUND = 1e-11
"""Step, rad or m, below which the place is found."""
_SMALL = 1e-9
"""Part of the largest slope below which nothing holds a departure."""


def rest_near(source: CompiledModel, state: State, touching: State | None = None) -> State | None:
    """The place of rest that Newton's method comes to on closed loops, from a state, and with closed what touches in it, or in
    another; None if to none."""
    return _Search(source, state, touching or state).found()


class _Search:
    def __init__(self, source: CompiledModel, state: State, touching: State) -> None:
        self.core, self.about, self.state = source, source.about, state
        self.names = [c["name"] for c in source.about["coordinates"]]
        free = self.core.free_bodies(touching)
        closing = Closing(source, touching, free)
        self.closing = closing if closing.closed and not any(m["engaged"] for m in source.about["motions"]) else None

    def found(self) -> State | None:
        try:
            q = self._closed(np.array(self.state.q, dtype=float)) if self.closing else np.array(self.state.q, dtype=float)
            for _ in range(_STEPS):
                step = self._step(q)
                longest = float(np.abs(step).max(initial=0.0))
                q = self._closed(q + step * min(1.0, _LONGEST / (longest or 1.0)))
                if longest < _FOUND:
                    found = self.state.at(q)
                    return None if Instant(self.core, found).nonequilibrium() else found
        except (MotionError, np.linalg.LinAlgError):
            pass
        return None

    def _closed(self, q: Array) -> Array:
        if self.closing:
            if (found := self.closing.place(q)) is None:
                raise np.linalg.LinAlgError("what touches does not close there")
            return found
        s, guess = self.state, dict(zip(self.names, q.tolist(), strict=True))
        return self.core.assemble(s.p, s.t, guess=guess)[0].q

    def _accelerations(self, q: Array) -> Array:
        return self.core.instant(self.state.at(q)).accelerations

    def _step(self, q: Array) -> Array:
        """Of Newton, along the departures that keep loops closed."""
        ways = self._ways(q)
        ahead, behind = (np.array([self._accelerations(self._closed(q + s * way)) for way in ways]) for s in (_SLOPE, -_SLOPE))
        slopes = ((ahead - behind) / (2 * _SLOPE)).reshape(len(ways), len(q)).T
        return ways.T @ np.linalg.lstsq(slopes, -self._accelerations(q), rcond=_SMALL)[0]

    def _ways(self, q: Array) -> Array:
        free = self.core.free_bodies(self.state.at(q))
        rows = [[row.coefficients.get(name, 0.0) for name in self.names] for row in free.rows]
        return _null_space(np.array(rows).reshape(len(rows), len(self.names)))


def _null_space(matrix: Array) -> Array:
    """Orthonormal directions, as rows, that a matrix takes to 0."""
    _, sizes, directions = np.linalg.svd(matrix)
    rank = int((sizes > _SMALL * max(1.0, sizes.max(initial=0.0))).sum())
    return directions[rank:]
