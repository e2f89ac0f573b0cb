"""The letter of every load, mass and inertia of a model: the same on its diagrams and in its equations.

A component of a pin's force is ``pivot_x``; a normal force ``N_track``, friction ``F_floor``, a tension ``T_rope``, a couple
``M_weld``, any other force ``F_drive``, what damps beside a spring ``F_damper``. Masses, inertias and gravity have the letters of
the model, else ``m_rod``, ``I_rod``, g.
"""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeAlias

from freebody.blow import Impulsive
from freebody.equations.names import Name, ascii_name
from freebody.equations.tree import Tree, read
from freebody.free_body import FreeBodies, Load
from freebody.instant import State
from freebody.model import cards
from freebody.run import Source

_Law: TypeAlias = dict[str, Any] | None
"""A force of the model as the core reads it."""
_PLAIN = re.compile(r"[^\W\d]\w*")


def load_names(loads: Iterable[Load], source: Source) -> dict[str, Name]:
    """The letter of every load but weights, by its symbol in the model's language, each a letter of its own. A force whose law
    is one letter, or whose name is, has that letter."""
    forces = {force["name"]: force for force in json.loads(source.spec).get("forces", [])}
    laws = {load: forces.get(load.name) if load.kind == "force" else None for load in loads if load.kind != "weight"}
    made = {load.symbol: _name(load, law) for load, law in laws.items()}
    own = {load.symbol for load, law in laws.items() if _given(law)}
    listed = source.about["parameters"] + source.about["coordinates"]
    taken = Counter(_folded(ascii_name(each["name"])) for each in listed)
    taken.update(_folded(name.ascii()) for symbol, name in made.items() if symbol not in own)
    return {s: name if s in own or taken[_folded(name.ascii())] == 1 else Name(s) for s, name in made.items()}


def coefficient(source: Source, name: str) -> str:
    """The letter that the model has for the friction of a contact or joint, if it has one."""
    spec = json.loads(source.spec)
    told = next(each for each in spec["contacts"] + spec["joints"] if each["name"] == name)
    value = (told | told.get("with", {})).get("friction")
    value = value["kinetic"] if isinstance(value, dict) else value
    return value if isinstance(value, str) and _PLAIN.fullmatch(value) else ""


def _name(load: Load, force: _Law) -> Name:
    if given := _given(force):
        return given
    owner, below = _owner(load.name)
    if load.axis:
        return Name(owner, (*below, load.axis))
    number = load.number
    if force and number:
        # The first load of a force has its name; each further one what it is in addition.
        first, number = cards.forces()[force["type"]].loads[0], None
        if load.card.name != first:
            owner = owner.replace(first, load.card.name) if first in owner else f"{owner} {load.card.name}"
    return Name(load.card.stem, (owner, *below, *([str(number)] if number else [])))


def _given(force: _Law) -> Name | None:
    """The letter that a force has of its own: that of its law, or its name."""
    if force is None:
        return None
    value = force["with"].get("value")
    if isinstance(value, str) and _PLAIN.fullmatch(value):
        return Name.parse(value)
    return Name(force["name"]) if len(force["name"]) == 1 else None


def _owner(name: str) -> tuple[str, tuple[str, ...]]:
    """``pin[2]`` → ``pin``, 2."""
    found = re.fullmatch(r"(.+)\[(\d+)\]", name)
    return (found[1], (found[2],)) if found else (name, ())


def _folded(name: str) -> str:
    return name.replace("_", "")


@dataclass(frozen=True)
class Naming:
    """All letters of a model at a state."""

    source: Source
    state: State
    free: FreeBodies

    @cached_property
    def loads(self) -> dict[str, Name]:
        """The letters of loads, see ``load_names``."""
        return load_names(self.free.loads, self.source)

    @cached_property
    def bodies(self) -> dict[str, tuple[Tree, Tree]]:
        """Mass and inertia of every body, as they stand in the equations."""
        told = self._told("kinematics")
        return {each["body"]: (read(each["mass"]), read(each["inertia"])) for each in told}

    def _told(self, question: str) -> list[dict[str, Any]]:
        """An answer of the core at the state."""
        s = self.state
        return json.loads(self.source.core.letters(s.p, s.t, s.q, s.u, "{}", json.dumps([{"ask": question}])))["answers"][0]

    @cached_property
    def gravity(self) -> Name | None:
        """The letter of gravity: its parameter's, else g; None where it is a vector of two letters."""
        x, y = (str(part).strip("-()") for part in json.loads(self.source.spec)["gravity"] or (0, 0))
        if _PLAIN.search(x) or float(x):
            return None
        return Name.parse(y if _PLAIN.fullmatch(y) else "g")

    def friction(self, load: Load) -> Name | None:
        """The letter that the model has for the coefficient of a contact's or joint's friction, if it has one."""
        letter = coefficient(self.source, load.name)
        return Name.parse(letter) if letter else None


@dataclass(frozen=True)
class ImpulseNaming(Naming):
    """The letters of a blow: an impulse is J with the letter of its force below, ``J_N_floor``."""

    blow: Impulsive

    @classmethod
    def of(cls, blow: Impulsive) -> ImpulseNaming:
        """Those of a blow."""
        return cls(blow.source, blow.state, blow.impulses, blow)

    @cached_property
    def loads(self) -> dict[str, Name]:
        """The letters of impulses, by the symbols of their forces."""
        forces = load_names(self.blow.free.loads, self.source)
        given = {load.symbol: self.blow.given[load.name] for load in self.blow.acting if load.name in self.blow.given}
        made = {symbol: Name("J", (force.stem, *force.below), force.owner) for symbol, force in forces.items()}
        return made | {symbol: Name.parse(letter) for symbol, letter in given.items()}

    def _told(self, question: str) -> list[dict[str, Any]]:
        """An answer of the core during the blow."""
        return self.blow.letters([{"ask": question}])["answers"][0]
