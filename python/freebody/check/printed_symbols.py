"""The symbols of printed equations that are not the model's own: ``N_track``, ``m_rod``, ``x_rod``, ``λ_rod``, ``E_k``."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from freebody.core import MotionError
from freebody.equations.derivation.conserved import energies
from freebody.equations.derivation.preamble import directions
from freebody.model.errors import ModelProblem
from freebody.model.names import spell
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.symbols import Renamed, unicode_name
from freebody.symbolic.tree import Sym, substitute, symbols

from .language.spelling import spell as written

if TYPE_CHECKING:
    from freebody.model.builder import Builder

_ONE_OF_SEVERAL = re.compile(r"\.[NT]\d+$")
"""The force at one place of a contact that holds at several."""


def printed(mechanism: Builder) -> dict[str, str]:
    """What each means, as a declaration. Nothing where the model does not start."""
    derived = _derived(mechanism)
    parts = (_named, _bodies, _whole, _directions) if derived else ()
    return {name: meant for part in parts for name, meant in part(derived)}


def renamed(mechanism: Builder) -> list[Renamed]:
    """What is not called by its usual name, because something else is. Nothing where the model does not start."""
    derived = _derived(mechanism)
    return list(derived.symbols.renamed.values()) if derived else []


def _derived(mechanism: Builder) -> SymbolicState | None:
    try:
        return SymbolicState(mechanism.source(), mechanism.moment()[0])
    except (MotionError, ModelProblem):
        return None


def _named(derived: SymbolicState) -> Iterator[tuple[str, str]]:
    """Loads; parameters and coordinates of which another is written alike; masses and inertias that are numbers in the model."""
    names = derived.symbols.loads
    for load in (load for load in derived.free.loads if load.symbol in names):
        one = f"load {load.symbol}" if _ONE_OF_SEVERAL.search(load.symbol) else load.symbol
        yield names[load.symbol].unicode(), f"{spell(load.name)}.value" if load.kind == "force" else one
    names = derived.symbols.names
    for name in derived.symbols.renamed:
        if name in names and derived.table.get(name, {}).get("kind") in ("coordinate", "parameter"):
            yield names[name].unicode(), spell(name)
    numbers = ((name, entry) for name, entry in derived.table.items() if entry["kind"] == "number")
    yield from ((names[name].unicode(), f"{entry['value']!r} {entry['unit']}") for name, entry in numbers)


def _bodies(derived: SymbolicState) -> Iterator[tuple[str, str]]:
    """Places, velocities and accelerations of mass centres, and angles."""
    for body in derived.source.metadata["bodies"]:
        said, name = spell(body["name"]), body["name"]
        read = {letter: f"[{part}x({said}.G), {part}y({said}.G)]" for letter, part in (("r", ""), ("v", "v"), ("a", "a"))}
        read |= {} if body["particle"] else {"alpha": f"alpha({said})"}
        yield from ((derived.symbols.of_body(letter, name).unicode(), meant) for letter, meant in read.items())
        plain = {"x": f"x({said}.G)", "y": f"y({said}.G)", "phi": f"angle({said})"}
        plain |= {"place_x": plain["x"], "place_y": plain["y"], "angle": plain["phi"]}
        yield from ((unicode_name(f"{stem}_{name}"), meant) for stem, meant in plain.items())


def _whole(derived: SymbolicState) -> Iterator[tuple[str, str]]:
    yield from ((name.text, meant) for name, meant in zip(energies(derived), ("kinetic()", "potential()"), strict=True))
    for axis in "xy":
        yield derived.symbols.quantity(f"L_{axis}", f"momentum along {axis}").unicode(), f"momentum_{axis}()"
    points = [spell(point) for point in derived.points]
    yield from ((f"H/{name}", f"angular_momentum({point})") for name, point in zip(derived.points, points, strict=True))
    for point in points[:1]:
        carried = f"(centre_x() - x({point}))*momentum_y() - (centre_y() - y({point}))*momentum_x()"
        yield "H/G", f"angular_momentum({point}) - ({carried})"


def _directions(derived: SymbolicState) -> Iterator[tuple[str, str]]:
    """Unit directions that turn, λ along the x axis of a body or a link, and n across it."""
    turning = {f"{body['name']}.angle": f"angle({spell(body['name'])})" for body in derived.source.metadata["bodies"]}
    named = directions(derived)
    yield from ((axis, f"[{1 - i}, {i}]") for i, axis in enumerate(named.axes[:2]))
    for pair in named.pairs:
        names = {n: Sym(turning.get(n.name) or spell(n.name)) for n in symbols(pair.angle)}
        angle = written(substitute(pair.angle, names))
        c, s = f"cos({angle})", f"sin({angle})"
        around = (f"[{c}, {s}]", f"[-{s}, {c}]", f"[-{c}, -{s}]", f"[{s}, -{c}]")
        yield pair.along, around[pair.quarters]
        yield pair.across, around[(pair.quarters + 1) % 4]
