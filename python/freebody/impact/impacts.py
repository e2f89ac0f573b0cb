"""Impacts of a run: what acts during one, its impulses, and what jumps."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from freebody.core import Array, Body, Change, CompiledModel, FreeBodies, Load, State, SymbolicAnswers

if TYPE_CHECKING:
    from freebody.run.simulation import Run

Question: TypeAlias = Mapping[str, Any]
_ROUND_OFF = 1e-13
"""Of the largest impulse, below which one is what is left of 0."""
_JUST_BEFORE = 1e-6
"""Of the time since the change before: far enough from an impact to be in the motion before it."""


class NoImpact(ValueError):
    """An impact that a run does not have; the sentence says why."""


class Impulsive(ABC):
    """A moment in which rates jump, because loads grow beyond all bounds: an impact of a run, or one that a model is given."""

    change: Change
    """What happened, with the state before and after."""
    state: State
    """The state just before."""
    source: CompiledModel
    """The mechanism, to be drawn in that state."""
    free: FreeBodies
    """All loads during the impact: those of what takes part for a unit of each."""

    @abstractmethod
    def symbolic_answers(self, questions: Sequence[Question]) -> SymbolicAnswers:
        """What the core tells of it symbolically, with the rates before it."""

    @abstractmethod
    def rows_before(self) -> list[Any]:
        """What held just before, symbolically, as the core tells its rows."""

    @property
    def given(self) -> Mapping[str, str]:
        """The symbols of impulses that are given from outside, by the names of their loads."""
        return {}

    def grows(self, load: Load) -> bool:
        """Whether a load has an impulse."""
        return load.unknown or load.follows is not None or (load.kind == "force" and load.name in self.given)

    @property
    def acting(self) -> list[Load]:
        """Loads that may grow beyond all bounds and so have impulses: reactions, contacts, strings, stops, their friction."""
        return [load for load in self.free.loads if self.grows(load)]

    @property
    def finite(self) -> list[Load]:
        """Loads of the model that stay finite: weights, springs, dampers, motors."""
        return [load for load in self.free.loads if not self.grows(load)]

    def absent(self, *group: str) -> list[str]:
        """In sentences, what has no impulse on a group of bodies (all by default), and why."""
        chosen, metadata = set(group or self.free.bodies), self.source.metadata
        finite = (x for x in self.finite if not x.inside(chosen) and any(part.body in chosen for part in x.on))
        names = list(dict.fromkeys(f"weight of {x.of[-1]}" if x.kind == "weight" else x.name for x in finite))
        here = [each["name"] for each in metadata["joints"] + metadata["limits"] if {each["first"], each["second"]} & chosen]
        spared = [name for name in (self.change.impulses.spared if self.change.impulses else ()) if name in here]
        closed = {row["name"] for row in self.rows_before()} - {load.name for load in self.acting}
        idle = [x["name"] for x in metadata["limits"] if x["name"] in closed and x["name"] in here and x["name"] not in spared]
        has_friction = [x["name"] for x in self.source.spec["joints"] if x.get("friction") and x["name"] in here]
        stated = [f"{', '.join(names)}: finite, so no impulse in a time that goes to 0"] if names else []
        stated += [f"{name}, which opens: its impulse would have to be negative" for name in spared]
        stated += [f"{name}, which is closed, but not pressed by the impact" for name in idle]
        return stated + [f"friction of {name}, which is neglected in impacts" for name in has_friction]

    def velocities(self, rates: Mapping[str, float]) -> Array:
        """Velocity of the mass centre and angular velocity of every body (nb, 3) at rates of the coordinates: linear in these, as
        accelerations are in theirs."""
        bodies = self.free.bodies.values()
        of = [sum((np.array(by) * rates[c] for c, by in body.by_accelerations.items()), np.zeros(3)) for body in bodies]
        return np.array(of).reshape(-1, 3)

    @cached_property
    def impulses(self) -> FreeBodies:
        """The impulse diagrams as data: loads are impulses, N·s and N·m·s; in place of accelerations stand the jumps of the
        velocities, so that for each body, and each group, impulses add up to m Δv at G and I Δω."""
        before, after = self.change.before, self.change.after
        assert before is not None and after is not None
        jumps = self.velocities({c: after.u[c] - before.u[c] for c in after.u}).tolist()
        each = zip(self.free.bodies.items(), jumps, strict=True)
        bodies = {name: replace(body, a=(x, y), alpha=turn) for (name, body), (x, y, turn) in each}
        loads, sizes = self.free.loads, self._sizes(bodies)
        stated = [replace(load, value=sizes[i]) for i, load in enumerate(loads) if self.grows(load)]
        place = {i: k for k, i in enumerate(i for i, load in enumerate(loads) if self.grows(load))}
        linked = (replace(x, follows=(place[x.follows[0]], x.follows[1])) if x.follows else x for x in stated)
        return FreeBodies(bodies, tuple(linked))

    def _sizes(self, bodies: dict[str, Body]) -> Array:
        """The impulse of every load, from the momentum of every body; NaN of one that this does not determine."""
        loads = self.free.loads
        unknown = [i for i, load in enumerate(loads) if load.unknown and not load.follows]
        known = [i for i, load in enumerate(loads) if self.grows(load) and not load.unknown and not load.follows]
        gives = np.zeros((3 * len(bodies), len(loads)))
        for k, body in enumerate(bodies.values()):
            for i, load in enumerate(loads):
                gives[3 * k : 3 * k + 3, i] = load.unit([body.name], body.G)
        for i, load in enumerate(loads):
            if load.follows:
                gives[:, load.follows[0]] += load.follows[1] * gives[:, i]
        jumps = np.concatenate([body.effective(body.G) for body in bodies.values()] or [np.zeros(0)])
        sizes = np.zeros(len(loads))
        sizes[known] = 1.0  # of what is given the parts are what acts
        sizes[unknown] = np.linalg.lstsq(gives[:, unknown], jumps - gives[:, known] @ sizes[known], rcond=None)[0]
        for i, load in enumerate(loads):
            if load.follows:
                sizes[i] = load.follows[1] * sizes[load.follows[0]]
        sizes[np.abs(sizes) < _ROUND_OFF * np.abs(sizes).max(initial=0.0)] = 0.0
        return np.where([load.determinate for load in loads], sizes, np.nan)


@dataclass(frozen=True)
class Impact(Impulsive):
    """An impact of a ``run``: the change that tells of it, and its ``place`` among all changes."""

    run: Run
    change: Change
    place: int

    @cached_property
    def state(self) -> State:
        """The state just before, held what takes part."""
        return self.run.motion.state_of_impact(self.place)

    @property
    def source(self) -> CompiledModel:
        """The mechanism."""
        return self.run.source

    @cached_property
    def free(self) -> FreeBodies:
        """All loads during the impact: those of what takes part for a unit of each."""
        # What strikes at several places moves there as no constraint allows; where impulses act does not depend on it.
        return self.source.free_bodies(replace(self.state, u=np.zeros_like(self.state.u)))

    def symbolic_answers(self, questions: Sequence[Question]) -> SymbolicAnswers:
        """What the core tells of it symbolically, with the rates before it."""
        return self.source.symbolic_answers(self.state, questions)

    def rows_before(self) -> list[Any]:
        """What held just before, symbolically; nothing where that is not known, as at the start."""
        t = self.change.t
        since = max((each.t for each in self.run.changes if each.t < t), default=float(self.run.t[0]))
        if not since < t:
            return []
        return self.source.symbolic_answers(self.run.motion.state(t - _JUST_BEFORE * (t - since)), [{"ask": "rows"}]).answers[0]


def impacts(run: Run) -> Iterator[Impact]:
    """All impacts of a run, in order of time."""
    yield from (Impact(run, change, place) for place, change in enumerate(run.changes) if change.impulses)


def find(run: Run, number: int = 1, *, of: str | None = None, after: float | None = None) -> Impact:
    """The impact of a ``number``, from 1: of all, of those of one contact, string or stop, or of those not before a time in s.
    Raises ``NoImpact``."""
    if run.recorded:
        raise NoImpact("a run from a file does not know what acted during its impacts; run it again")
    asked = [impact for impact in impacts(run) if of in (None, *impact.change.of) and (after is None or impact.change.t >= after)]
    if not 1 <= number <= len(asked):
        which = (f" of {of}" if of else "") + (f" from {after:g} s on" if after is not None else "")
        raise NoImpact(
            f"the run has {len(asked)} impacts{which}, none of number {number}; let it run longer, or start it otherwise"
        )
    return asked[number - 1]
