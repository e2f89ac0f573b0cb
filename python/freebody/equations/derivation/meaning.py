"""What the letters of a derivation mean, and what its loads, points and directions are called."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from freebody.equations.derivation.told import Subject
from freebody.equations.letters import Letter, Letters
from freebody.free_body import GROUND, Load
from freebody.naming import load_names

_NUMBERS = {"g": "gravity"}
_BY_PREFIX = {"m": "mass", "I": "inertia about the mass centre"}


def meanings(subject: Subject) -> Letters:
    """All letters in the order of the model: coordinates, parameters, what the model leaves without a name, unknowns, time."""
    table = subject.table
    found = {c["name"]: Letter(c["name"], "coordinate", c["dimension"] or "", plain(c["doc"])) for c in subject.coordinates}
    given = [p["name"] for p in subject.source.about["parameters"]]
    unnamed = [name for name, entry in table.items() if entry["kind"] == "number"]
    found |= {name: Letter(name, "parameter", table[name]["unit"]) for name in given if name in table}
    found |= {name: Letter(name, "constant", table[name]["unit"], _number(name)) for name in unnamed}
    written = load_names(subject.free.loads, subject.source)
    for load in subject.free.loads:
        if load.unknown and not load.follows:
            unit, doc = "N*m" if load.card.couple else "", f"{load_words(load)} ({load.symbol})"
            found[load.symbol] = Letter(load.symbol, "unknown", unit, doc, written[load.symbol])
    return Letters(found | {"t": Letter("t", "time", "s", "time")})


def plain(doc: str) -> str:
    """A description without the quotes of code."""
    return doc.replace("`", "")


def load_words(load: Load, bodies: Collection[str] = ()) -> str:
    """What a load is: ``force along x of pivot on rod, from ground``; where it acts on some ``bodies``, as that on them."""
    if load.kind == "weight":
        return f"weight of {load.of[-1]}"
    if load.kind == "force":
        return load.name
    if load.kind in ("motion", "coupling"):
        return f"what {load.name} exerts"
    return f"{load.card.name} of {load.name}{_between(load, bodies)}"


def _between(load: Load, bodies: Collection[str]) -> str:
    """On which body, from which. Its value is positive on the first body of a contact, on the second one of a joint."""
    other, on = (load.of[-1], load.of[0]) if load.path.startswith("contacts.") else (load.of[0], load.of[-1])
    pair = load.kind == "contact" or load.card.pulls
    if (bodies and on not in bodies) or (not bodies and pair and on == GROUND):
        on, other = other, on
    if load.kind == "string":
        return f" on {on}" if bodies else f" between {load.of[0]} and {load.of[-1]}"
    return f" on {on}, from {other}" if on != other else ""


def joined(words: Sequence[str], last: str = "and") -> str:
    """``a, b and c``."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} {last} {words[-1]}"


def _number(name: str) -> str:
    stem, _, body = name.partition("_")
    return _NUMBERS.get(name) or f"{_BY_PREFIX.get(stem, stem)} of {body}"
