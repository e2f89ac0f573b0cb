"""Letters of loads: short, with subscripts, the same on every diagram of a model."""

from __future__ import annotations

import json
import re
from collections import Counter
from typing import Any

from freebody.free_body import FreeBodies, Load
from freebody.results import roman, symbol
from freebody.run import Source

_COMPONENTS = {"Fx": "x", "Fy": "y"}
_WORDS = {"normal force": "N", "friction force": "F", "tooth force": "F", "couple": "M"}
_STEMS = {"F": "N", "N": "N", "T": "F", "tension": "T"}  # F1, F2: rollers
_ALONE = ("joint", "contact", "string", "friction")
_TURNING = ("torque", "torsion_spring")
_PLAIN = re.compile(r"[^\W\d]\w*")


class Letters:
    """The letters (LaTeX without dollars) of the loads, masses and inertias of a model."""

    def __init__(self, source: Source, free: FreeBodies) -> None:
        self._bodies = json.loads(source.model).get("bodies", {})
        self._forces = {force["name"]: force for force in json.loads(source.spec).get("forces", [])}
        self._heavy = [name for name, body in free.bodies.items() if body.mass > 0]
        owners = {(self._stem(load)[0], load.name) for load in free.loads if load.unknown}
        self._taken = Counter(stem for stem, _ in owners)
        self._taken.update({parameter["name"]: 2 for parameter in source.about["parameters"]})

    def of(self, load: Load) -> str:
        """The letter of a load; of both sides of a cut it is the same."""
        if load.kind == "weight":
            return self.mass(load.on[0].body) + r"\,g"
        value = self._forces.get(load.name, {}).get("with", {}).get("value")
        if load.kind == "force" and isinstance(value, str) and _PLAIN.fullmatch(value):
            return letter(value)
        component = _COMPONENTS.get(load.symbol.rpartition(".")[2])
        if component:
            return _joined(*_owner(load.name), component)
        if load.kind == "force" and len(load.name) == 1:
            return load.name
        stem, index = self._stem(load)
        alone = load.kind in _ALONE and self._taken[stem] == 1
        return _joined(stem, index) if alone else _joined(stem, _subscript(load.name), index)

    def whole(self, load: Load) -> str:
        """The letter of a force of which a load is one component."""
        component = load.symbol.rpartition(".")[2] in _COMPONENTS
        return _joined(*_owner(load.name)) if component else self.of(load)

    def _stem(self, load: Load) -> tuple[str, str]:
        """A letter for what kind of load it is, and its number among several of one name."""
        if load.component in _WORDS:
            return _WORDS[load.component], ""
        found = re.fullmatch(r"(.*?)(\d*)", load.symbol.rpartition(".")[2])
        assert found
        if found[1] in _STEMS:
            return _STEMS[found[1]], found[2]
        turns = any(part.couple for part in load.on) and not any(any(part.force) for part in load.on)
        return ("M" if turns or self._forces.get(load.name, {}).get("type") in _TURNING else "F"), ""

    def mass(self, body: str) -> str:
        """The letter of a body's mass: its parameter's, where it is one."""
        return self._said(body, "mass", "m")

    def inertia(self, body: str) -> str:
        """The letter of a body's inertia about its mass centre."""
        return self._said(body, "inertia", "I")

    def acceleration(self, body: str, alone: bool) -> str:
        """The acceleration of a body's mass centre, by itself or among several."""
        return r"\mathbf{a}" if alone or len(self._heavy) == 1 else _joined(r"\mathbf{a}", _subscript(body))

    def angular(self, body: str, alone: bool) -> str:
        """The angular acceleration of a body, by itself or among several."""
        return r"\alpha" if alone or len(self._heavy) == 1 else _joined(r"\alpha", _subscript(body))

    def _said(self, body: str, what: str, stem: str) -> str:
        told: Any = self._bodies.get(body)
        value = told.get(what) if isinstance(told, dict) else None
        if isinstance(value, str) and _PLAIN.fullmatch(value):
            return _joined(stem, value[1]) if len(value) == 2 and value[0] == stem else letter(value)
        return stem if len(self._heavy) == 1 else _joined(stem, _subscript(body))


def letter(name: str) -> str:
    """``m2`` → ``m_{2}``, ``mA`` → ``m_{A}``, ``m_rod`` → ``m_{\\mathrm{rod}}``."""
    if "[" in name and "." not in name:
        stem, index = _split(name)
        return _joined(symbol(stem), index)
    if len(name) == 2 and name.isalpha() and name[0].isupper() != name[1].isupper():
        return _joined(name[0], name[1])
    head, _, tail = name.partition("_")
    return _joined(symbol(head), roman(tail.replace("_", " "))) if tail and not tail.isdigit() else symbol(name)


def _owner(name: str) -> tuple[str, str]:
    """``A`` → ``A``; ``pin[2]`` → ``pin``, 2."""
    stem, index = _split(name)
    return (stem if len(stem) == 1 else roman(stem)), index


def _subscript(name: str) -> str:
    return ",".join(part for part in _owner(name) if part)


def _split(name: str) -> tuple[str, str]:
    """A name without its index, and the index: ``pin[2]``, ``knee1``."""
    found = re.fullmatch(r"(.*?[^\d])[\[_ ]?(\d*)\]?", name)
    stem, index = (found[1], found[2]) if found else (name, "")
    return stem.rstrip("[_ ").replace("_", " "), index


def _joined(letter: str, *below: str) -> str:
    kept = [part for part in below if part]
    return f"{letter}_{{{','.join(kept)}}}" if kept else letter
