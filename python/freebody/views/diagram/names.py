"""Letters of loads: short, with subscripts, the same on every diagram of a model."""

from __future__ import annotations

import json
import re
from collections import Counter
from typing import Any

from freebody.free_body import FreeBodies, Load
from freebody.results import roman, symbol
from freebody.run import Source

_PARTS = {"force along x": "x", "force along y": "y"}
_STEMS = {"normal force": "N", "friction force": "F", "couple": "M", "tension": "T", "thrust": "F", "friction": "F"}
_ORDINALS = {"first": "1", "second": "2"}
_PLAIN = re.compile(r"[^\W\d]\w*")


class Letters:
    """The letters (LaTeX without dollars) of the loads, masses and inertias of a model."""

    def __init__(self, source: Source, free: FreeBodies) -> None:
        self._bodies = json.loads(source.model).get("bodies", {})
        self._values = {f["name"]: f["with"].get("value") for f in json.loads(source.spec).get("forces", [])}
        self._heavy = [name for name, body in free.bodies.items() if body.mass > 0]
        self._stems = Counter({(self._stem(load), load.name) for load in free.loads}.__iter__())
        self._once = Counter(stem for stem, _ in self._stems)

    def of(self, load: Load) -> str:
        """The letter of a load; of both sides of a cut it is the same."""
        if load.kind == "weight":
            return self.mass(load.on[0].body) + r"\,g"
        value = self._values.get(load.name)
        if load.kind == "force" and isinstance(value, str) and _PLAIN.fullmatch(value):
            return symbol(value)
        if load.component in _PARTS:
            return _below(load.name, _PARTS[load.component])
        stem, owner = self._stem(load), load.name
        if load.kind == "force" and len(owner) == 1:
            return owner
        alone = self._once[stem] == 1 and load.kind in ("joint", "contact", "string")
        ordinal = next((digit for word, digit in _ORDINALS.items() if word in (load.component or "")), "")
        return _joined(stem, ordinal) if alone else _joined(stem, _subscript(owner), ordinal)

    def _stem(self, load: Load) -> str:
        if load.component in _STEMS:
            return _STEMS[load.component]
        if "roller" in (load.component or ""):
            return "N"
        if load.kind == "string":
            return "T"
        return "M" if any(part.couple for part in load.on) and not any(any(part.force) for part in load.on) else "F"

    def mass(self, body: str) -> str:
        """The letter of a body's mass: its parameter's, where it is one."""
        return self._said(body, "mass", "m")

    def inertia(self, body: str) -> str:
        """The letter of a body's inertia about its mass centre."""
        return self._said(body, "inertia", "I")

    def acceleration(self, body: str, part: str = "") -> str:
        """``a_x``, ``a_y`` of the mass centre of the only body, or the vector of one among several."""
        only = len(self._heavy) == 1
        return _joined("a" if part else r"\mathbf{a}", part, "" if only else _subscript(body))

    def angular(self, body: str) -> str:
        """The angular acceleration of a body."""
        return _joined(r"\alpha", "" if len(self._heavy) == 1 else _subscript(body))

    def _said(self, body: str, what: str, stem: str) -> str:
        told: Any = self._bodies.get(body)
        value = told.get(what) if isinstance(told, dict) else None
        if isinstance(value, str) and _PLAIN.fullmatch(value):
            return symbol(value)
        return stem if len(self._heavy) == 1 else _joined(stem, _subscript(body))


def _below(name: str, part: str) -> str:
    """``A`` → ``A_x``, ``pin[2]`` → ``pin_{2,x}``."""
    stem, index = _split(name)
    letter = stem if len(stem) == 1 else roman(stem)
    return _joined(letter, index, part)


def _subscript(name: str) -> str:
    stem, index = _split(name)
    return ",".join(part for part in (roman(stem) if len(stem) > 1 else stem, index) if part)


def _split(name: str) -> tuple[str, str]:
    found = re.fullmatch(r"(.+?)[\[_ ]?(\d*)\]?", name)
    return (found[1], found[2]) if found else (name, "")


def _joined(letter: str, *below: str) -> str:
    kept = [part for part in below if part]
    return f"{letter}_{{{','.join(kept)}}}" if kept else letter
