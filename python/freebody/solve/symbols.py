"""The symbol of everything in a model, each with one meaning: the same on its diagrams, in its equations and in what is checked.

A component of a pin's force is ``pivot_x``; a normal force ``N_track``, friction ``F_floor``, a tension ``T_rope``, a couple
``M_weld``, any other force ``F_drive``, what damps beside a spring ``F_damper``. Masses, inertias and gravity have the symbols of
the model, else ``m_rod``, ``I_rod``, g.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

from freebody.core import GROUND, CompiledModel, Load, cards
from freebody.symbolic.evaluate import FUNCTIONS
from freebody.symbolic.symbols import Name, Renamed, Taken, folded

_Law: TypeAlias = dict[str, Any] | None
"""A force of the model as the core reads it."""
_OF_BODIES = {
    "m": ("mass", "mass"), "I": ("inertia about the mass centre", "inertia"), "r": ("position", "position"), "v": ("velocity", "velocity"),
    "a": ("acceleration", "acceleration"), "alpha": ("angular acceleration", "angular"),
}  # fmt: skip
"""What a symbol of a body is, and its stem where the usual one is taken."""
PLAIN = re.compile(r"[^\W\d]\w*")
"""A name that is not quoted."""


@dataclass(frozen=True)
class Symbols:
    """How everything in a model is written: ``names`` of coordinates, parameters and numbers without a name of their own; ``loads``
    by their symbols; ``taken`` says what each means, so that nothing else is written alike."""

    names: Mapping[str, Name]
    loads: Mapping[str, Name]
    taken: Taken
    renamed: Mapping[str, Renamed]
    """What is not written as usual, by its name."""

    @classmethod
    def of(cls, source: CompiledModel, loads: Iterable[Load], table: Mapping[str, Mapping[str, Any]]) -> Symbols:
        """Those of a model with some loads; ``table`` are the symbols as the core lists them.

        Functions go first, then what the user names, then time and numbers, then loads. A force whose law is one symbol, or whose
        name is, has that symbol."""
        wanted = {each["name"]: (f"the coordinate {each['name']}", [each["name"]]) for each in source.metadata["coordinates"]}
        wanted |= {each["name"]: (f"the parameter {each['name']}", [each["name"]]) for each in source.metadata["parameters"]}
        wanted |= {"t": ("time", ["t"]), "pi": ("the number π", ["pi"])}
        wanted |= {name: (entry["doc"], entry["names"]) for name, entry in table.items() if entry["kind"] == "number"}
        taken = Taken({name: (name, f"the function {name}") for name in FUNCTIONS})
        given = source.metadata["coordinates"] + source.metadata["parameters"]
        plain = [each["name"] for each in given if folded(each["name"]) == each["name"]]  # goes before what is only read like it
        names = {symbol: taken.give(wanted[symbol][0], *map(Name.parse, wanted[symbol][1])) for symbol in (*plain, *wanted)}
        own = _of_loads(source, loads, taken)
        stated = {symbol: what for symbol, (what, _) in wanted.items()} | {load.symbol: load.symbol for load in loads}
        return cls(names, own, taken, {symbol: taken.renamed[what] for symbol, what in stated.items() if what in taken.renamed})

    def quantity(self, usual: str, what: str) -> Name:
        """A symbol of the whole mechanism: ``E_k``, or ``kinetic_energy`` where the model has the former for something else."""
        return self.taken.give(what, Name.parse(usual), Name(what))

    def of_body(self, stem: str, body: str) -> Name:
        """A symbol of a body: ``m_rod``, or ``mass_rod`` where the model has the former for something else."""
        what, long = _OF_BODIES[stem]
        return self.taken.give(f"{what} of {body}", Name.parse(f"{stem}_{body}"), Name.parse(f"{long}_{body}"))


def _of_loads(source: CompiledModel, loads: Iterable[Load], taken: Taken) -> dict[str, Name]:
    """The symbol of every load but weights. Two that would have the same are written by their symbols."""
    forces = {force["name"]: force for force in source.spec.get("forces", [])}
    laws = {load: forces.get(load.name) if load.kind == "force" else None for load in loads if load.kind != "weight"}
    made = {load.symbol: _name(load, law) for load, law in laws.items()} | _of_locks([*laws])
    own, named = {load.symbol for load, law in laws.items() if _given(law)}, {load.symbol: load for load in laws}
    alike = Counter(folded(name.ascii()) for symbol, name in made.items() if symbol not in own)
    for symbol, name in made.items():
        if symbol not in own:
            wanted = [Name(symbol)] if alike[folded(name.ascii())] > 1 else [name, Name(symbol)]
            made[symbol] = taken.give(load_words(named[symbol]), *wanted, key=symbol)
    return made


def _of_locks(loads: Iterable[Load]) -> dict[str, Name]:
    """The symbols of locks that hold an expression, by their place among them."""
    locks = [load for load in loads if load.kind == "lock" and not PLAIN.fullmatch(load.name.removeprefix("lock "))]
    number = lambda k: (str(k),) if len(locks) > 1 else ()
    return {load.symbol: Name(load.card.stem, ("lock", *number(k))) for k, load in enumerate(locks, 1)}


def load_words(load: Load, bodies: Collection[str] = ()) -> str:
    """What a load is: ``force along x of pivot on rod, from ground``; where it acts on some ``bodies``, as that on them."""
    if load.kind == "weight":
        return f"weight of {load.of[-1]}"
    if load.kind == "force":
        return load.name
    if load.kind in ("motion", "coupling", "lock"):
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


def coefficient(source: CompiledModel, name: str) -> str:
    """The symbol that the model has for the friction of a contact or joint, if it has one."""
    spec = source.spec
    stated = next(each for each in spec["contacts"] + spec["joints"] if each["name"] == name)
    value = (stated | stated.get("with", {})).get("friction")
    value = value["kinetic"] if isinstance(value, dict) else value
    return value if isinstance(value, str) and PLAIN.fullmatch(value) else ""


def _name(load: Load, force: _Law) -> Name:
    if given := _given(force):
        return given
    owner, below = _owner(load.name)
    if load.axis:
        return Name(load.card.stem, (owner, *below, load.axis)) if load.card.stem else Name(owner, (*below, load.axis))
    number = load.number
    if force and number:
        # The load that a force is named for has its name, else the first; each other one what it is in addition.
        parts, number = [part.name for part in cards.forces()[force["type"]].parts], None
        main = next((part for part in parts if part in owner), parts[0])
        if load.card.name != main:
            owner = owner.replace(main, load.card.name) if main in owner else f"{owner} {load.card.name}"
    return Name(load.card.stem, (owner, *below, *([str(number)] if number else [])))


def _given(force: _Law) -> Name | None:
    """The symbol that a force has of its own: that of its law, or its name."""
    if force is None:
        return None
    value = force["with"].get("value")
    if isinstance(value, str) and PLAIN.fullmatch(value):
        return Name.parse(value)
    return Name(force["name"]) if len(force["name"]) == 1 else None


def _owner(name: str) -> tuple[str, tuple[str, ...]]:
    """``pin[2]`` → ``pin``, 2."""
    found = re.fullmatch(r"(.+)\[(\d+)\]", name)
    return (found[1], (found[2],)) if found else (name, ())
