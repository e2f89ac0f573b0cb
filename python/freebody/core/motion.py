"""A motion: what happened on its way, mode changes, how it ended; and what can be read of it at any time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from freebody import _core

from .errors import OutcomeKind
from .state import Array, State


@dataclass(frozen=True)
class Event:
    """Something that happened: time in s, ``crossing``, ``touch`` or ``start``, ±1 rising or falling, the state just before."""

    name: str
    t: float
    kind: str
    direction: int
    q: Mapping[str, float]
    u: Mapping[str, float]


@dataclass(frozen=True)
class Outcome:
    """How a run ended, whether that is what was asked for, when, and why.

    ``path`` is the item of the model that the sentence is about, like ``bodies.crank``, or empty."""

    name: OutcomeKind
    ok: bool
    t: float
    sentence: str
    path: str = ""


@dataclass(frozen=True)
class Snapshot:
    """Coordinates (m, rad) and rates by name."""

    q: Mapping[str, float]
    u: Mapping[str, float]


@dataclass(frozen=True)
class Impulses:
    """The impulses of an impact: ``contacts`` and strings on their first body (x, y in N·s, fixed axes), ``joints`` on their
    second body (x, y in N·s, couple in N·m·s about the joint's point), ``stops`` along what they limit (N·s; N·m·s at an angle).
    ``drives`` (motions and couplings) and ``locks`` along what they hold; ``works`` of motions in J. ``restitution`` is that of what
    collided; ``slides`` is the sign of the speed of sliding at its end, 0 where it sticks, of what has friction; ``spared`` was reached
    too, but would have had to pull."""

    contacts: Mapping[str, tuple[float, float]]
    joints: Mapping[str, tuple[float, float, float]]
    stops: Mapping[str, float] = field(default_factory=dict)
    restitution: Mapping[str, float] = field(default_factory=dict)
    slides: Mapping[str, float] = field(default_factory=dict)
    spared: tuple[str, ...] = ()
    drives: Mapping[str, float] = field(default_factory=dict)
    locks: Mapping[str, float] = field(default_factory=dict)
    works: Mapping[str, float] = field(default_factory=dict)

    @property
    def sizes(self) -> dict[str, float]:
        """How large the impulse of each contact, string, stop, motion, coupling and lock is."""
        held = {name: abs(impulse) for name, impulse in {**self.drives, **self.locks}.items()}
        return {name: float(np.hypot(*force)) for name, force in self.contacts.items()} | dict(self.stops) | held


@dataclass(frozen=True)
class Change:
    """Something that switched: time in s; ``kind`` is impact, taut, slack, contact, lift-off, slip, stick, reversal, rest,
    released, engaged or reset; the names concerned; the energy lost in J. Where rates jumped, the state before and after;
    where there was an impact, its impulses. What is lost is the ``work`` of the motions less the gain of energy."""

    t: float
    kind: str
    of: tuple[str, ...]
    lost: float
    note: str = ""
    impulses: Impulses | None = None
    before: Snapshot | None = None
    after: Snapshot | None = None

    @property
    def work(self) -> float | None:
        """What motions put in by their impulses, J; None where they have none."""
        return sum(self.impulses.works.values()) if self.impulses and self.impulses.works else None

    @property
    def sizes(self) -> Mapping[str, float]:
        """How large the impulses are; none where there was no impact."""
        return self.impulses.sizes if self.impulses else {}


def there(changes: Sequence[Change], name: str, engaged: bool, times: Array) -> Array:
    """Whether a part is in place (nt,) at each time; ``engaged``: before all changes."""
    present = np.full(len(times), engaged)
    for change in changes:
        if change.kind in ("released", "engaged") and name in change.of:
            present[times >= change.t] = change.kind == "engaged"
    return present


class Motion:
    """What is known of a motion: the core's ``Trajectory``, or what a file holds of one. ``record`` is that as plain data."""

    def __init__(self, record: Mapping[str, Any], metadata: Mapping[str, Any]) -> None:
        self.record, self.metadata = record, metadata

    @cached_property
    def outcome(self) -> Outcome:
        """How it ended."""
        return Outcome(**self.record["outcome"] | {"name": OutcomeKind(self.record["outcome"]["name"])})

    @cached_property
    def events(self) -> list[Event]:
        """What happened, in order of time."""
        return [Event(**event | self._named(event)) for event in self.record["events"]]

    @cached_property
    def changes(self) -> list[Change]:
        """Mode changes, in order of time: impacts, contacts that open and close, strings, friction, released parts."""
        return [self._change(**change) for change in self.record["changes"]]

    @property
    def stats(self) -> dict[str, Any]:
        """What it took: accepted and rejected steps, evaluations, the worst gap of a loop."""
        return dict(self.record["stats"])

    def _named(self, state: Mapping[str, Sequence[float]]) -> dict[str, dict[str, float]]:
        names = [c["name"] for c in self.metadata["coordinates"]]
        return {part: dict(zip(names, state[part], strict=True)) for part in "qu"}

    def _change(self, of: list[str], note: str | None, impulses: Any, before: Any, after: Any, **plain: Any) -> Change:
        sides = (state and Snapshot(**self._named(state)) for state in (before, after))
        return Change(**plain, of=tuple(of), note=note or "", impulses=impulses and self._impulses(**impulses),
                      **dict(zip(("before", "after"), sides, strict=True)))  # fmt: skip

    def _impulses(
        self, limits: Any, joints: Any, contact_impulses: Any, spared: list[str], drives: Any = (), works: Any = ()
    ) -> Impulses:
        stops = {limit["name"] for limit in self.metadata["limits"] if limit["type"] == "stop"}
        names = [joint["name"] for joint in self.metadata["joints"]]
        locks = {lock["name"] for lock in self.metadata["locks"]}
        return Impulses(
            contacts={name: tuple(p) for name, p in limits if name not in stops},
            joints={name: tuple(p) for name, p in zip(names, joints, strict=True) if any(p)},
            stops={each["name"]: each["normal"] for each in contact_impulses if each["name"] in stops},
            restitution={each["name"]: each["restitution"] for each in contact_impulses},
            slides={each["name"]: each["slides"] for each in contact_impulses if each["slides"] is not None},
            spared=tuple(spared),
            drives={name: p for name, p in drives if name not in locks},
            locks={name: p for name, p in drives if name in locks},
            works=dict(works),
        )


class Trajectory(Motion):
    """A finished run of the core with dense output: ``steps`` (ns,) are the times of the accepted steps, first and last included. Of
    tables in ``reported`` expressions the outcome says where they are left, as of those in laws."""

    def __init__(self, run: _core.Trajectory, metadata: Mapping[str, Any], reported: Sequence[str] = ()) -> None:
        super().__init__(run.record(list(reported)), metadata)
        self.run = run
        self.steps: Array = run.steps

    def sample(self, times: Array) -> tuple[Array, Array]:
        """q, u (nt, n) at times within the run, on the closed loops."""
        return self.run.sample(times)

    def evaluate(self, texts: Sequence[str], times: Array) -> Array:
        """Expressions (nt, k); reactions and accelerations are solved again at each time."""
        return self.run.evaluate(list(texts), times)

    def poses(self, times: Array) -> Array:
        """Frame origin x, y and angle of every body (nt, nb, 3)."""
        return self.run.poses(times)

    def reactions(self, times: Array) -> Array:
        """Reactions of the joints (nt, nj, 3); NaN where one is not determinate."""
        return self.run.reactions(times)

    def ledger(self, times: Array) -> tuple[list[str], Array]:
        """Column names and values (nt, k): kinetic, potential, work of each non-conservative force and motion, balance."""
        return self.run.ledger(times)

    def state(self, t: float) -> State:
        """The state at a time within the run, on the closed loops, after what happens then."""
        return State(*self.run.state(t))

    def state_of_impact(self, change: int) -> State:
        """The state during an impact, given by its place among the changes: with the rates before it, and held what takes part."""
        return State(*self.run.state_of_impact(change))

    def impact_derivatives(self, change: int) -> Array:
        """Derivatives (n, 1 + 2 n + np) of the rates after an impact, given by its place among the changes, by time, coordinates,
        rates and parameters before it. Raises ``MotionError`` where its law has none."""
        return self.run.impact_derivatives(change).T

    @property
    def end(self) -> State:
        """The state at the end."""
        return State(*self.run.end())
