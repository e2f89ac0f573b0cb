"""An impulse applied at a point of a model at rest, and what it does at once.

An impulse does to velocities what a force does to the accelerations of what is at rest. So a strike is the instant of the model
without all that stays finite, with a force in place of the impulse: N·s for N, rates for accelerations.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import Change, CompiledModel, FreeBodies, Impulses, Load, Snapshot, State, SymbolicAnswers
from freebody.impact.impacts import Impulsive, NoImpact, Question
from freebody.model.start import quantity

if TYPE_CHECKING:
    from freebody.model.builder import Builder

_NAME = "applied_impulse"
_SYMBOLS = ("J", "J0", "J_applied")
_ROUND_OFF = 1e-12
"""Of the impulse over the mass of all bodies, below which a rate is what is left of 0."""


@dataclass(frozen=True)
class AppliedImpulse(Impulsive):
    """The impulse ``symbol``, a parameter of ``source`` (N for N·s), on a ``whole`` model at rest.

    ``before`` is its state without the impulse; ``source`` is the model without weights, springs, dampers, motors and friction of joints; its force ``applied_impulse`` is the impulse."""

    whole: CompiledModel
    source: CompiledModel
    state: State
    before: State
    symbol: str

    @property
    def given(self) -> Mapping[str, str]:
        """The symbol of the impulse, by the name of its load."""
        return {_NAME: self.symbol}

    @cached_property
    def free(self) -> FreeBodies:
        """All loads while it acts, in N for N·s. Raises ``MotionError`` where they leave the outcome open."""
        return self.source.free_bodies(self.state)

    @property
    def size(self) -> float:
        """The impulse in numbers, N·s."""
        places = [each["name"] for each in self.source.metadata["parameters"]]
        return float(self.state.p[places.index(self.symbol)])

    @property
    def finite(self) -> list[Load]:
        """Loads of the whole model that stay finite: weights, springs, dampers, motors."""
        return [x for x in self.whole.free_bodies(self.before).loads if not self.grows(x)]

    @cached_property
    def change(self) -> Change:
        """Rates jump from 0."""
        names = self.source.coordinate_names
        q = dict(zip(names, map(float, self.state.q), strict=True))
        small = _ROUND_OFF * abs(self.size) / (sum(body.mass for body in self.free.bodies.values()) or 1.0)
        jumps = {name: u if abs(u) > small else 0.0 for name, u in self.free.accelerations.items()}
        loaded, limits = {load.name for load in self.free.loads}, {each["name"] for each in self.source.metadata["limits"]}
        closed = dict.fromkeys(row["name"] for row in self.rows_before() if row["name"] in limits)
        stated = Impulses({}, {}, spared=tuple(name for name in closed if name not in loaded))
        energy = 0.0  # what it gives, J: half of every momentum by its rate
        for body in self.free.bodies.values():
            x, y, turn = sum((np.array(by) * jumps[name] for name, by in body.by_accelerations.items()), np.zeros(3))
            energy += float(body.mass * (x * x + y * y) + body.inertia * turn * turn) / 2
        before, after = Snapshot(q, dict.fromkeys(names, 0.0)), Snapshot(q, {name: jumps[name] for name in names})
        return Change(self.state.t, "applied impulse", (), -energy, impulses=stated, before=before, after=after)

    def symbolic_answers(self, questions: Sequence[Question]) -> SymbolicAnswers:
        """What the core says of it symbolically."""
        return self.source.symbolic_answers(self.state, questions)

    def rows_before(self) -> list[Any]:
        """What holds the model at rest, symbolically."""
        return self.whole.symbolic_answers(self.before, [{"ask": "rows"}]).answers[0]


def strike(
    mechanism: Builder, state: State, point: str, direction: Any = 0, impulse: Any = 1.0, frame: str = "fixed"
) -> AppliedImpulse:
    """An ``impulse`` (N·s) at a named point on a model at rest, along a ``direction`` (``"-90 deg"``, or an expression) from the x
    axis of the ``frame``, ``fixed`` or ``body``. Where joints alone hold it, rates
    that it had before stay and the jumps add to them. Raises ``NoImpact`` where it moves and may touch something, ``ModelFileError``
    for a point that there is not."""
    if state.u.any() and mechanism.source().metadata["limits"]:
        raise NoImpact(
            "the model moves at its start, and it has contacts, strings or stops, which then decide by that motion what an impact does; "
            "an impulse is applied to a model at rest: give the start no rates, or let something hit it in a run"
        )
    state = replace(state, u=np.zeros_like(state.u))
    size = quantity("impulse", impulse, "N*s")
    taken = {c["name"] for kind in ("parameters", "coordinates") for c in mechanism.source().metadata[kind]}
    symbol = next(name for name in _SYMBOLS if name not in taken)
    model = mechanism.copy()
    model.parameter(symbol, size)
    model.force(name=_NAME, at=point, value=symbol, direction=direction, frame=frame)
    lowered = model.lowered()
    core = CompiledModel.of(_bare(lowered.spec))
    source = replace(mechanism.source(), mechanism=core.mechanism, spec=lowered.spec)
    p = dict(zip((each["name"] for each in mechanism.source().metadata["parameters"]), state.p, strict=True))
    values = np.array([p.get(each["name"], size) for each in source.metadata["parameters"]])
    return AppliedImpulse(mechanism.source(), source, replace(state, p=values), state, symbol)


def _bare(spec: Mapping[str, Any]) -> dict[str, Any]:
    """A model without what stays finite, and with prescribed motions that stand still."""
    joints = [joint | {"with": {k: v for k, v in joint["with"].items() if k != "friction"}} for joint in spec["joints"]]
    joints = [{k: v for k, v in joint.items() if k != "friction"} for joint in joints]
    locked = [motion | {"is": "0", "level": "velocity"} for motion in spec["motions"]]
    impact = [force for force in spec["forces"] if force["name"] == _NAME]
    return {**spec, "gravity": None, "joints": joints, "motions": locked, "forces": impact, "events": []}
