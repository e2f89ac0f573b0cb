"""Configurations near one, on closed loops, that share nothing with it but the structure of the mechanism."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from freebody.core import Array, CompiledModel, FreeBodies, MotionError, OutcomeKind, State

DEPENDENT = 1e-7
"""Part of a row or column that is left when those before it are taken out, below which it is a combination of them."""
SEED = 20
OTHERS = 3
TRIES = 12
NEARER = 0.7
CORRECTIONS = 60
NEARLY, OUT = 0.98, 0.05
"""Part of a gap by which it is closed at once; part by which one that is pierced is opened."""
PLACES, RATES, PASSES = 3, 4, 3
CLOSED_RATE = 1e-9
"""Rate of a gap, over what it is at the rates tried, below which it stays closed."""
STEP = {"rad": 0.3, "m": 0.2}
"""How far a coordinate is moved: an angle in rad, a length as a part of the size of the mechanism."""
CLOSED = 1e-12
"""Gap over size of the mechanism below which what touches does so, and the reasons for zeros hold to round-off."""


def independent(rows: Array, part: float = DEPENDENT) -> list[int]:
    """The first rows of which none follows from those before; of one that does no more is left than this ``part`` of the largest entry."""
    found: list[int] = []
    most = int(rows.any(axis=0).sum())
    for i in range(len(rows)):
        if len(found) < most and np.linalg.svd(rows[[*found, i]], compute_uv=False)[-1] > part * np.abs(rows).max():
            found.append(i)
    return found


def nearby(source: CompiledModel, state: State, parameters: Sequence[Array] = ()) -> list[FreeBodies]:
    """The free bodies at a state, and at up to three others near by where the same things act. Prescribed motions do not hold
    there: what drops out of a balance does not depend on where a drive has brought the mechanism. The others have
    ``parameters``, one after the other, or come as near to these as they can."""
    first, coordinates = source.free_bodies(state), source.metadata["coordinates"]
    first = replace(first, accelerations={c["name"]: first.accelerations[c["name"]] for c in coordinates})
    found = [first]
    rng = np.random.default_rng(SEED)
    steps = np.array([STEP["rad"] if c["dimension"] == "rad" else STEP["m"] * first.extent for c in coordinates])
    changes = [p - state.p for p in parameters] or [np.zeros_like(state.p)]
    part = 1.0
    for _ in range(TRIES):
        closing = Closing(source, state, first, state.p + part * changes[len(found) % len(changes)])
        other = closing.near(state.q + steps * part * rng.uniform(-1, 1, len(steps)))
        if other is not None and alike(other, first) and np.isfinite(_places(other)).all():
            found.append(other)
        else:
            part *= NEARER
        if len(found) > OTHERS:
            break
    return found


def moving_states(source: CompiledModel, state: State) -> list[FreeBodies]:
    """The free bodies at a state, and at ``others`` where the same things act."""
    return [source.free_bodies(each) for each in (state, *others(source, state))]


def others(source: CompiledModel, state: State) -> list[State]:
    """States of the same mode: at the places of a state and near by, with random rates that keep closed what is closed, each at a
    time of its own, as fast as is usual for the mechanism. The same things act there, and what slides or bears on a tooth does so in the same sense."""
    first = source.free_bodies(state)
    rng = np.random.default_rng(SEED)
    coordinates = source.metadata["coordinates"]
    scale, rate = first.units(coordinates), first.usual_rate(coordinates, state.u)
    closing, found = Closing(source, state, first), []
    steps = [np.zeros_like(scale), *(STEP["m"] * NEARER**k * scale * rng.uniform(-1, 1, len(scale)) for k in range(PLACES))]
    for q in (closing.place(state.q + step) for step in steps):
        for _ in range(RATES if q is not None else 0):
            rates, t = rate * scale * rng.uniform(-1, 1, len(scale)), state.t + rng.uniform(0, 1) / rate
            try:
                other = closing.moving(q, rates, t)
                free = source.free_bodies(other)
            except MotionError:
                continue
            off = np.abs(closing.rows(free) @ other.u - closing.prescribed(free, q, t))
            held = off <= CLOSED_RATE * rate * free.row_sizes(coordinates)
            if held.all() and same_mode(free, first) and np.isfinite(_places(free)).all():
                found.append(other)
    return found


def alike(one: FreeBodies, other: FreeBodies) -> bool:
    """Whether the same things act, and hold, in both."""
    (first, second) = ([(load.symbol, load.unknown, load.follows is None) for load in free.loads] for free in (one, other))
    return first == second and [row.name for row in one.rows] == [row.name for row in other.rows]


def same_mode(one: FreeBodies, other: FreeBodies) -> bool:
    """Whether the same things act and hold in both, slide in the same sense and bear on the same flank."""
    return alike(one, other) and _senses(one) == _senses(other)


def _senses(free: FreeBodies) -> list[bool]:
    """In which sense everything slides with friction, and on which flank teeth bear."""
    sliding = [load.follows[1] > 0 for load in free.loads if load.follows]
    turning = [load.value > 0 for load in free.loads if load.symbol.endswith(".friction")]
    return sliding + turning + [load.value > 0 for load in free.loads if load.card.flank]


class Closing:
    """Brings coordinates onto closed loops of the assembly of a state, and what touches or is taut in it back to a gap of 0; with
    other parameters ``p`` if these are given."""

    def __init__(self, source: CompiledModel, state: State, first: FreeBodies, p: Array | None = None) -> None:
        self.core, self.beginning = source, state
        self.state = state if p is None else replace(state, p=p)
        motions = [{**motion, "level": "acceleration"} for motion in source.spec.get("motions", [])]
        # Motions do not say where it is.
        self.loose = CompiledModel.of({**source.spec, "motions": motions}) if motions else source
        self.names = source.coordinate_names
        limits, held = [limit["name"] for limit in source.metadata["limits"]], []
        for name in dict.fromkeys(row.name for row in first.rows if row.name in limits):
            loads = [load for load in first.loads if load.name == name and load.unknown and not load.follows]
            held += zip([row for row in first.rows if row.name == name], loads, strict=False)  # they come in the same order
        self.closed = [limits.index(row.name) for row, _ in held]
        self.normal = np.array([load.kind != "friction" for _, load in held], bool)
        self.slopes = self.rows(replace(first, rows=tuple(row for row, _ in held)))
        self.back = np.linalg.pinv(self.slopes, rcond=DEPENDENT) if held else np.zeros((len(self.names), 0))
        self.size = first.extent

    def near(self, q: Array) -> FreeBodies | None:
        """The free bodies where loops and gaps are closed near ``q``; None where they do not close."""
        s, found = self.state, self.place(q)
        try:
            u = s.u - self.back @ (self.slopes @ s.u)
            return None if found is None else self.core.free_bodies(replace(s, q=found, u=u))
        except MotionError:
            return None

    def place(self, q: Array) -> Array | None:
        """The coordinates near ``q`` where loops and gaps are closed, these from outside; None where they do not close."""
        s, outward, found = self.state, self.back @ self.normal, self.beginning
        q = s.q + (np.eye(len(q)) - self.back @ self.slopes) @ (q - s.q)
        out = OUT * self.size
        try:
            for _ in range(CORRECTIONS):
                guess = dict(zip(self.names, q.tolist(), strict=True))
                found, _ = self.loose.assemble(s.p, s.t, guess=guess, history=s.history, beginning=found)
                q, gaps = found.q, self._gaps(found.q)
                if gaps is None:
                    q, out = q + out * outward, 2 * out
                elif (largest := np.abs(gaps).max(initial=0.0)) < CLOSED * self.size:
                    return q
                else:
                    q, out = q - NEARLY * (self.back @ gaps), OUT * largest
        except MotionError:
            pass
        return None

    def moving(self, q: Array, rates: Array, t: float) -> State:
        """A place and a time, with the rates nearest to some that keep closed what is closed, and that motions prescribe at that time:
        what is closed depends on the rates. Raises ``MotionError``."""
        found = replace(self.state, t=t, q=q)
        for _ in range(PASSES):
            free = self.core.free_bodies(found)
            held = self.rows(free)
            rates = rates + np.linalg.pinv(held, rcond=DEPENDENT) @ (self.prescribed(free, q, t) - held @ rates)
            found = replace(found, u=rates)
        return found

    def prescribed(self, free: FreeBodies, q: Array, t: float) -> Array:
        """The rate of every row: 0 of what is closed; of a motion what it is at a time, where the motion has brought the mechanism."""
        motions = {motion["name"] for motion in self.core.spec.get("motions", ())} & {row.name for row in free.rows}
        if not motions:
            return np.zeros(len(free.rows))
        brought = self.core.assemble(
            self.state.p, t, guess=dict(zip(self.names, q.tolist(), strict=True)), history=self.state.history
        )[0]
        there = self.core.free_bodies(brought)
        rates = dict(zip([row.name for row in there.rows], self.rows(there) @ brought.u, strict=True))
        return np.array([rates.get(row.name, 0.0) if row.name in motions else 0.0 for row in free.rows])

    def rows(self, free: FreeBodies) -> Array:
        """What is closed, as rows among the rates."""
        return np.array([[row.coefficients[name] for name in self.names] for row in free.rows]).reshape(
            len(free.rows), len(self.names)
        )

    def _gaps(self, q: Array) -> Array | None:
        """What is left of the gap of every row, 0 for one of friction; None where something is pierced, or stretched too far."""
        if not self.closed:
            return np.zeros(0)
        try:
            stated = list(self.core.instant(self.state.at(q)).limits.values())
        except MotionError as error:
            if error.kind is OutcomeKind.PENETRATION:
                return None
            raise
        if any(limit.is_open and limit.gap < 0 for limit in stated):
            return None
        return np.array([stated[i].gap for i in self.closed]) * self.normal


def _places(free: FreeBodies) -> Array:
    return np.array([part.point for load in free.loads for part in load.on] + [body.G for body in free.bodies.values()])
