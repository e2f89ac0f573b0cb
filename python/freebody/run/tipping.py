"""Mode changes in the words of a person: which body tips, about what, and which slides."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import GROUND, Change, quote

if TYPE_CHECKING:
    from freebody.run.simulation import Run

_PARTIAL = "at another it touches"
"""In the note of a contact that opens at one of its places."""
_CLOSED = 1e-9
"""Gap below which a contact is closed, m."""
_Stands = Mapping[str, tuple[str, str]]


def worded_changes(run: Run) -> list[Change]:
    """The mode changes of a run. A body tips where it parts from a line at one place and not at another, and slides where all places
    at which it touches slip."""
    stands, sliding, found = _stands(run), set[str](), []
    happen = defaultdict[tuple[float, str], set[str]](set)
    for change in run.motion.changes:
        happen[change.t, change.kind] |= {*change.of}
    for change in run.motion.changes:
        if change.kind == "slip":
            sliding |= happen[change.t, "slip"]
        elif change.kind != "reversal":
            sliding -= {*change.of}
        parting = happen[change.t, "lift-off"]
        words = [note for name in change.of if name in stands for note in _words(run, change, name, stands, sliding, parting)]
        found.append(replace(change, note="; ".join(filter(None, [change.note, *words]))) if words else change)
    return found


def _stands(run: Run) -> _Stands:
    """Of each contact of a corner or an outline with a line, the body and the line."""
    found = {}
    for contact in run.source.spec["contacts"]:
        for surface, other in (contact["of"], contact["of"][::-1]):
            corner = surface.get("point") or surface.get("polygon", [None])[0]
            if corner and "line" in other and run.points[corner][0] != GROUND:
                found[contact["name"]] = run.points[corner][0], repr(other)
    return found


def _words(run: Run, change: Change, name: str, stands: _Stands, sliding: set[str], parting: set[str]) -> Iterator[str]:
    body = stands[name][0]
    if change.kind == "lift-off" and _PARTIAL in change.note:
        yield f"`{body}` tips"
    elif change.kind == "lift-off" and (mates := _mates(run, change.t, name, stands, parting)):
        yield f"`{body}` tips about {' and '.join(f'`{mate}`' for mate in mates)}"
    elif change.kind == "slip" and sliding >= {*_mates(run, change.t, name, stands, parting)}:
        yield f"`{body}` slides"


def _mates(run: Run, t: float, name: str, stands: _Stands, parting: set[str]) -> list[str]:
    """The other contacts of the body with that line that are closed from then on."""
    others = [other for other, stand in stands.items() if stand == stands[name] and other not in {name, *parting}]
    if not others or run.recorded:
        return []
    gaps = run.motion.evaluate([f"{quote(other)}.gap" for other in others], np.array([t]))[0]
    return [other for other, gap in zip(others, gaps, strict=True) if abs(gap) < _CLOSED]
