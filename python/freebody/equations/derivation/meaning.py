"""What the letters of a derivation mean, and what its loads, points and directions are called."""

from __future__ import annotations

from collections.abc import Sequence

from freebody.equations.derivation.told import Subject
from freebody.equations.letters import Letter, Letters
from freebody.free_body import GROUND, Load

_NUMBERS = {"g": "gravity"}
_BY_PREFIX = {"m": "mass", "I": "inertia about the mass centre"}
_COMPONENTS = {"x": "force along x", "y": "force along y"}
_UNITS = {"couple": "N*m"}


def meanings(subject: Subject) -> Letters:
    """All letters in the order of the model: coordinates, parameters, what the model leaves without a name, unknowns, time."""
    table = subject.table
    found = {c["name"]: Letter(c["name"], "coordinate", c["dimension"] or "", plain(c["doc"])) for c in subject.coordinates}
    given = [p["name"] for p in subject.source.about["parameters"]]
    unnamed = [name for name, entry in table.items() if entry["kind"] == "number"]
    found |= {name: Letter(name, "parameter", table[name]["unit"]) for name in given if name in table}
    found |= {name: Letter(name, "constant", table[name]["unit"], _number(name)) for name in unnamed}
    for load in subject.free.loads:
        if load.unknown and not load.follows:
            found[load.symbol] = Letter(load.symbol, "unknown", _UNITS.get(load.component or "", ""), load_words(load))
    return Letters(found | {"t": Letter("t", "time", "s", "time")})


def plain(doc: str) -> str:
    """A description without the quotes of code."""
    return doc.replace("`", "")


def load_words(load: Load) -> str:
    """What a load is: ``force along x of pivot on rod, from ground``."""
    if load.kind == "weight":
        return f"weight of {load.of[-1]}"
    if load.kind == "force":
        return load.name
    if load.kind in ("motion", "coupling"):
        return f"what {load.name} exerts"
    what = _COMPONENTS.get(load.component or "", load.component) or {"contact": "normal force", "string": "tension"}.get(
        load.kind
    )
    first, second = load.of[0], load.of[-1]
    between = f" on {second}, from {first}" if GROUND in (first, second) or first != second else ""
    return f"{what or ('friction' if load.kind == 'friction' else 'force')} of {load.name}{between}"


def joined(words: Sequence[str], last: str = "and") -> str:
    """``a, b and c``."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} {last} {words[-1]}"


def _number(name: str) -> str:
    stem, _, body = name.partition("_")
    return _NUMBERS.get(name) or f"{_BY_PREFIX.get(stem, stem)} of {body}"
