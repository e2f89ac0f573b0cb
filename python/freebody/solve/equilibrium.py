"""A place of rest near a state, in numbers: where the accelerations that the core gives vanish."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from freebody.core import MotionError, State
from freebody.solve.instant import Instant
from freebody.solve.perturbed_states import Closing

if TYPE_CHECKING:
    from freebody.core import Array, CompiledModel

# Coordinates are angles in rad, and lengths as parts of the size of the mechanism.
_STEPS = 60
_LONGEST = 0.2
"""Step of Newton's method beyond which it is shortened."""
_SLOPE = 1e-6
"""Step over which slopes are differences: the cube root of round-off, about."""
_FOUND = 1e-11
"""Step below which the place is found."""
_SMALL = 1e-9
"""Part of the largest slope below which nothing holds a perturbation."""


def rest_near(source: CompiledModel, state: State, touching: State | None = None) -> State | None:
    """The place of rest that Newton's method comes to on closed loops, from a state, and with closed what touches in it, or in
    another; None if to none."""
    names = source.coordinate_names
    free = source.free_bodies(touching or state)
    closing, units = Closing(source, touching or state, free), free.units(source.metadata["coordinates"])
    by_contacts = bool(closing.closed) and not any(motion["engaged"] for motion in source.metadata["motions"])

    def closed(q: Array) -> Array:
        if not by_contacts:
            return source.assemble(state.p, state.t, guess=dict(zip(names, q.tolist(), strict=True)), history=state.history)[0].q
        if (found := closing.place(q)) is None:
            raise np.linalg.LinAlgError("what touches does not close there")
        return found

    def accelerations(q: Array) -> Array:
        return source.instant(state.at(q)).accelerations

    def step(q: Array) -> Array:
        """Of Newton, along the perturbations that keep loops closed."""
        rows = closing.rows(source.free_bodies(state.at(q))) * units
        lengths = np.linalg.norm(rows, axis=1, keepdims=True)
        _, sizes, directions = np.linalg.svd(rows / np.where(lengths, lengths, 1.0))
        ways = directions[int((sizes > _SMALL).sum()) :]
        ahead, behind = (np.array([accelerations(closed(q + s * units * way)) for way in ways]) for s in (_SLOPE, -_SLOPE))
        slopes = ((ahead - behind) / (2 * _SLOPE)).reshape(len(ways), len(q)).T / units[:, None]
        return ways.T @ np.linalg.lstsq(slopes, -accelerations(q) / units, rcond=_SMALL)[0]

    try:
        q = np.array(state.q, dtype=float)
        q = closed(q) if by_contacts else q
        for _ in range(_STEPS):
            change = step(q)
            longest = float(np.abs(change).max(initial=0.0))
            q = closed(q + units * change * min(1.0, _LONGEST / (longest or 1.0)))
            if longest < _FOUND:
                found = state.at(q)
                return None if Instant(source, found).nonequilibrium() else found
    except (MotionError, np.linalg.LinAlgError):
        pass
    return None
