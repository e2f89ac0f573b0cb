"""Accelerations from body to body: that of a pin has a name, and what hangs on it goes on from there."""

from __future__ import annotations

from collections.abc import Sequence

from freebody.core import quote
from freebody.equations.derivation.directions import Directions
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.printers.printer import Components
from freebody.symbolic.symbols import Name
from freebody.symbolic.tree import ONE

Stated = tuple[Name, Components]


def from_pins(subject: SymbolicState, named: Directions, bodies: Sequence[str], given: Sequence[Stated]) -> list[Stated]:
    """The accelerations ``given`` of some bodies by those of pins that are in two of them at least."""
    hinges = _carrying(subject)
    pins: dict[frozenset, Stated] = {}
    for body, (_, parts) in zip(bodies, given, strict=True):
        own = {unit for pair in named.pairs if body in (*pair.owners, *pair.turning) for unit in (pair.along, pair.across)}
        rest = tuple(part for part in parts if part[1] not in own)
        if body in hinges and rest and len(rest) < len(parts):
            pins.setdefault(frozenset(rest), (Name.parse(f"a_{hinges[body]}"), rest))
    every = [*(frozenset(parts) for _, parts in given), *pins]
    pins = {key: pin for key, pin in pins.items() if sum(key <= other for other in every) > 2}
    made: list[Stated] = []
    for name, parts in given:
        for key, (pin, rest) in pins.items():
            if key <= frozenset(parts) and all(pin != known for known, _ in made):
                made.append((pin, _from(pins, rest)))
        made.append((name, _from(pins, parts)))
    return made


def _carrying(subject: SymbolicState) -> dict[str, str]:
    """The hinge in which each body hangs on the one before it: of its two bodies, the one that moves with the coordinate."""
    joints = [j for j in subject.source.metadata["joints"] if j["type"] == "hinge" and not j["cut"] and j["coordinates"]]
    ends = [(joint, body) for joint in joints for body in (joint["first"], joint["second"]) if body in subject.free.bodies]
    slopes = subject.source.derivatives([f"angle({quote(body)})" for _, body in ends], subject.state)
    place = {c["name"]: 1 + i for i, c in enumerate(subject.source.metadata["coordinates"])}
    turned = zip(ends, slopes, strict=True)
    return {body: joint["name"] for (joint, body), slope in turned if slope[place[joint["coordinates"][0]]]}


def _from(pins: dict[frozenset, Stated], parts: Components) -> Components:
    """A vector from the pin on, of which it has most."""
    every = frozenset(parts)
    held = max((key for key in pins if key < every), key=len, default=frozenset())
    return ((ONE, pins[held][0]), *(part for part in parts if part not in held)) if held else tuple(parts)
