"""Configurations near one, on closed loops, that share nothing with it but the structure of the mechanism."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody import _core
from freebody.free_body import FreeBodies
from freebody.instant import State

if TYPE_CHECKING:
    from freebody.source import Source

SEED = 20
OTHERS = 3
TRIES = 12
STEP = {"rad": 0.3, "m": 0.2}
"""How far a coordinate is moved: an angle in rad, a length as a part of the size of the mechanism."""


def nearby(source: Source, state: State) -> list[FreeBodies]:
    """The free bodies at a state, and at up to three others near by where the same things act. Prescribed motions do not hold
    there: what drops out of a balance does not depend on where a drive has brought the mechanism."""
    first = FreeBodies.read(source.core.free_bodies(state.p, state.t, state.q, state.u))
    acting = [load.symbol for load in first.loads]
    found = [first]
    for other in _moved(source, state, _size(first)):
        if [load.symbol for load in other.loads] == acting and np.isfinite(_places(other)).all():
            found.append(other)
        if len(found) > OTHERS:
            break
    return found


def _moved(source: Source, state: State, size: float) -> Iterator[FreeBodies]:
    rng = np.random.default_rng(SEED)
    loose = _without_motions(source)
    coordinates = source.about["coordinates"]
    steps = np.array([STEP["rad"] if c["dimension"] == "rad" else STEP["m"] * size for c in coordinates])
    for _ in range(TRIES):
        q = state.q + steps * rng.uniform(-1, 1, len(steps))
        guess = {c["name"]: float(value) for c, value in zip(coordinates, q, strict=True)}
        try:
            q, _, _ = loose.assemble(state.p, state.t, guess=guess)
            yield FreeBodies.read(source.core.free_bodies(state.p, state.t, q, state.u))
        except _core.MotionError:
            steps = steps / 2  # nearer, where loops let it go less far


def _without_motions(source: Source) -> _core.Mechanism:
    """The same mechanism, its motions holding accelerations only, so that they have no say in where it is."""
    spec: dict[str, Any] = json.loads(source.spec)
    if not spec.get("motions"):
        return source.core
    spec["motions"] = [{**motion, "level": "acceleration"} for motion in spec["motions"]]
    return _core.Mechanism(json.dumps(spec))


def _size(free: FreeBodies) -> float:
    places = _places(free)
    return float(np.hypot(*np.ptp(places, axis=0))) or 1.0


def _places(free: FreeBodies) -> np.ndarray:
    return np.array([part.point for load in free.loads for part in load.on])
