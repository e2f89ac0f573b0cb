"""What switches: the changes of a run, and what contacts, strings and stops do at an instant."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from freebody.results import Array

_WORDS = {"string": {"open": "slack", "closed": "taut"}, "contact": {"closed": "touching"}, "stop": {"closed": "at its end"}}


@dataclass(frozen=True)
class Snapshot:
    """Coordinates (m, rad) and rates by name."""

    q: Mapping[str, float]
    u: Mapping[str, float]


@dataclass(frozen=True)
class Impulses:
    """The impulses of a blow: ``contacts`` and strings on their first body (x, y in N·s, fixed axes), ``joints`` on their
    second body (x, y in N·s, couple in N·m·s about the joint's point), ``stops`` along what they limit (N·s; N·m·s at an angle).
    ``restitution`` is that of what was struck; ``spared`` was reached too, but would have had to pull."""

    contacts: Mapping[str, tuple[float, float]]
    joints: Mapping[str, tuple[float, float, float]]
    stops: Mapping[str, float] = field(default_factory=dict)
    restitution: Mapping[str, float] = field(default_factory=dict)
    spared: tuple[str, ...] = ()

    @property
    def sizes(self) -> dict[str, float]:
        """How large the impulse of each contact, string and stop is."""
        return {name: float(np.hypot(*force)) for name, force in self.contacts.items()} | dict(self.stops)


@dataclass(frozen=True)
class Change:
    """Something that switched: time in s; ``kind`` is impact, taut, slack, contact, lift-off, slip, stick, reversal, rest,
    released, engaged or reset; the names concerned; the energy lost in J. Where rates jumped, the state before and after;
    where there was a blow, its impulses."""

    t: float
    kind: str
    of: tuple[str, ...]
    lost: float
    note: str = ""
    impulses: Impulses | None = None
    before: Snapshot | None = None
    after: Snapshot | None = None


def changes_of(told: Sequence[Mapping[str, Any]], about: Mapping[str, Any]) -> list[Change]:
    """Changes as the core tells them, with names for its places."""
    coordinates = [c["name"] for c in about["coordinates"]]
    joints = [j["name"] for j in about["joints"]]
    stops = [limit["name"] for limit in about["limits"] if limit["type"] == "stop"]

    def snapshot(state: Mapping[str, Any] | None) -> Snapshot | None:
        return state and Snapshot(*(dict(zip(coordinates, state[part], strict=True)) for part in "qu"))

    def impulses(blow: Mapping[str, Any] | None) -> Impulses | None:
        if not blow:
            return None
        felt = {name: tuple(p) for name, p in zip(joints, blow["joints"], strict=True) if any(p)}
        forces = {name: tuple(p) for name, p in blow["limits"] if name not in stops}
        at_stops = {each["name"]: each["normal"] for each in blow["struck"] if each["name"] in stops}
        back = {each["name"]: each["restitution"] for each in blow["struck"]}
        return Impulses(forces, felt, at_stops, back, tuple(blow["spared"]))

    return [
        Change(c["t"], c["kind"], tuple(c["of"]), c["lost"], c["note"] or "",
               impulses(c["impulses"]), snapshot(c["before"]), snapshot(c["after"]))
        for c in told
    ]  # fmt: skip


def there(changes: Sequence[Change], name: str, engaged: bool, times: Array) -> Array:
    """Whether a part is in place (nt,) at each time; ``engaged``: before all changes."""
    present = np.full(len(times), engaged)
    for change in changes:
        if change.kind in ("released", "engaged") and name in change.of:
            present[times >= change.t] = change.kind == "engaged"
    return present


@dataclass(frozen=True)
class Limit:
    """What a contact, string or stop does at an instant.

    ``state``: off, open, touching, stuck or sliding; taut or slack; at its end. ``gap``: how far it is from closing,
     m (rad for a stop of an angle). ``N``: the normal force, tension or force of the stop, ``T``: friction along the
    tangent, N (N·m at an angle); ``Fx``, ``Fy``: the force on the body ``first``, N; ``at``: where a contact's resultant acts, m.
    A force that the balances do not determine is NaN.
    """

    name: str
    kind: str
    first: str
    second: str
    dimension: str
    state: str
    gap: float
    N: float
    T: float
    Fx: float
    Fy: float
    at: tuple[float, float] | None = None


def limits_of(told: Sequence[Mapping[str, Any]], about: Mapping[str, Any]) -> dict[str, Limit]:
    """Contacts, strings and stops by name, as the core's instant tells them."""
    found = {}
    for who, now in zip(about["limits"], told, strict=True):
        forces = zip((now["normal"], now["friction"], *now["force"]), now["determinate"], strict=True)
        found[who["name"]] = Limit(
            *(who[word] for word in ("name", "type", "first", "second", "dimension")),
            _WORDS[who["type"]].get(now["state"], now["state"]),
            now["gap"],
            *(force if known else np.nan for force, known in forces),
            now["at"] and tuple(now["at"]),
        )
    return found


def with_dimensions(about: dict[str, Any], spec: Mapping[str, Any]) -> dict[str, Any]:
    """The core's words on a mechanism, where every limit knows whether its gap is in m or rad; empty: not known."""
    units = {c["name"]: c["dimension"] for c in about["coordinates"] + about["closure_coordinates"]}
    gaps = {stop["name"]: stop["gap"] for stop in spec.get("stops", [])}
    for limit in about["limits"]:
        named = {
            unit
            for name, unit in units.items()
            if re.search(rf"(?<![\w.]){re.escape(name)}(?![\w.(])", gaps.get(limit["name"], ""))
        }
        limit["dimension"] = "m" if limit["type"] != "stop" else named.pop() if len(named) == 1 else ""
    return about
