"""Configurations near one, on closed loops, that share nothing with it but the structure of the mechanism."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody import _core
from freebody.balances.system import alike
from freebody.free_body import FreeBodies
from freebody.instant import State
from freebody.results import Array

if TYPE_CHECKING:
    from freebody.source import Source

SEED = 20
OTHERS = 3
TRIES = 12
NEARER = 0.7
CORRECTIONS = 40
STEP = {"rad": 0.3, "m": 0.2}
"""How far a coordinate is moved: an angle in rad, a length as a part of the size of the mechanism."""
CLOSED = 1e-12
"""Gap over size of the mechanism below which what touches does so, and the reasons for zeros hold to round-off."""


def nearby(source: Source, state: State, parameters: Sequence[Array] = ()) -> list[FreeBodies]:
    """The free bodies at a state, and at up to three others near by where the same things act. Prescribed motions do not hold
    there: what drops out of a balance does not depend on where a drive has brought the mechanism. The others have
    ``parameters``, one after the other, or come as near to these as they can."""
    first = FreeBodies.read(source.core.free_bodies(state.p, state.t, state.q, state.u))
    coordinates = source.about["coordinates"]
    in_order = {c["name"]: first.accelerations[c["name"]] for c in coordinates}
    first = replace(first, accelerations=in_order)
    found = [first]
    rng = np.random.default_rng(SEED)
    steps = np.array([STEP["rad"] if c["dimension"] == "rad" else STEP["m"] * _size(first) for c in coordinates])
    changes = [p - state.p for p in parameters] or [np.zeros_like(state.p)]
    part = 1.0
    for _ in range(TRIES):
        closing = _Closing(source, replace(state, p=state.p + part * changes[len(found) % len(changes)]), first)
        other = closing.near(state.q + steps * part * rng.uniform(-1, 1, len(steps)))
        if other is not None and alike(other, first) and np.isfinite(_places(other)).all():
            found.append(other)
        else:
            part *= NEARER
        if len(found) > OTHERS:
            break
    return found


class _Closing:
    """Brings coordinates onto closed loops, and what touches or is taut back to a gap of 0."""

    def __init__(self, source: Source, state: State, first: FreeBodies) -> None:
        self.core, self.state = source.core, state
        self.loose = _without_motions(source)
        self.names = [c["name"] for c in source.about["coordinates"]]
        limits = [limit["name"] for limit in source.about["limits"]]
        normals = {row.name: row for row in reversed(first.rows) if row.name in limits}  # the first row of a limit is its gap's
        self.closed = [limits.index(name) for name in normals]
        self.slopes = np.array([[row.coefficients[name] for name in self.names] for row in normals.values()])
        self.slopes = self.slopes.reshape(len(normals), len(self.names))
        self.back = np.linalg.pinv(self.slopes) if normals else np.zeros((len(self.names), 0))
        self.size = _size(first)

    def near(self, q: Array) -> FreeBodies | None:
        """The free bodies where loops and gaps are closed near ``q``; None where they do not close."""
        s = self.state
        q = s.q + (np.eye(len(q)) - self.back @ self.slopes) @ (q - s.q)
        try:
            for _ in range(CORRECTIONS):
                q, _, _ = self.loose.assemble(s.p, s.t, guess=dict(zip(self.names, q.tolist(), strict=True)))
                gaps = self._gaps(q)
                if np.abs(gaps).max(initial=0.0) < CLOSED * self.size:
                    u = s.u - self.back @ (self.slopes @ s.u)
                    return FreeBodies.read(self.core.free_bodies(s.p, s.t, q, u))
                q = q - self.back @ gaps
        except _core.MotionError:
            pass
        return None

    def _gaps(self, q: Array) -> Array:
        if not self.closed:
            return np.zeros(0)
        s = self.state
        told = json.loads(self.core.instant(s.p, s.t, q, np.zeros_like(s.u)).limits)
        return np.array([told[i]["gap"] for i in self.closed])


def _without_motions(source: Source) -> _core.Mechanism:
    """The same mechanism, its motions holding accelerations only, so that they have no say in where it is."""
    spec: dict[str, Any] = json.loads(source.spec)
    if not spec.get("motions"):
        return source.core
    spec["motions"] = [{**motion, "level": "acceleration"} for motion in spec["motions"]]
    return _core.Mechanism(json.dumps(spec))


def _size(free: FreeBodies) -> float:
    return float(np.hypot(*np.ptp(_places(free), axis=0))) or 1.0


def _places(free: FreeBodies) -> Array:
    return np.array([part.point for load in free.loads for part in load.on] + [body.G for body in free.bodies.values()])
