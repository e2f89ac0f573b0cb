"""The symbols of printed equations that are not the model's own: ``N_track``, ``m_rod``, ``x_rod``, ``λ_rod``, ``E_k``."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from functools import cached_property
from typing import TYPE_CHECKING, Any

from freebody.core import MotionError
from freebody.equations.derivation.conserved import energies, momenta
from freebody.equations.derivation.preamble import directions
from freebody.equations.derivation.put_in import Closed
from freebody.model.errors import ModelProblem
from freebody.model.names import spell
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.symbols import Name, Renamed, folded, unicode_name
from freebody.symbolic.tree import Sym, Tree, substitute, symbols

from .language.spelling import spell as written

if TYPE_CHECKING:
    from freebody.model.builder import Builder

_ONE_OF_SEVERAL = re.compile(r"\.[NT]\d+$")
"""The force at one place of a contact that holds at several."""


class PrintedSymbols:
    """What printed equations of a model, as it is at the moment ``asked`` for, call things; nothing where it does not start."""

    def __init__(self, mechanism: Builder, **asked: Any) -> None:
        self.mechanism, self.asked = mechanism, asked

    @cached_property
    def _derived(self) -> SymbolicState | None:
        try:
            return SymbolicState(self.mechanism.source(), self.mechanism.moment(**self.asked)[0])
        except (MotionError, ModelProblem, ValueError):
            return None

    @cached_property
    def plain(self) -> dict[str, str]:
        """What each symbol means, as a declaration."""
        return self._of(_named, _bodies, _whole, _directions, _closed)

    @cached_property
    def momenta(self) -> dict[str, str]:
        """The same of momenta that stay constant, which take longer to be found."""
        return self._of(_momenta)

    def _of(self, *parts: Callable[[SymbolicState], Iterator[tuple[str, str]]]) -> dict[str, str]:
        found: dict[str, str] = {}
        for part in parts if self._derived else ():
            with suppress(MotionError):  # what is too long to be written has no letters
                found |= part(self._derived)
        return found

    @cached_property
    def renamed(self) -> list[Renamed]:
        """What is not called by its usual name, because something else is."""
        return list(self._derived.symbols.renamed.values()) if self._derived else []


def _named(derived: SymbolicState) -> Iterator[tuple[str, str]]:
    """Loads; parameters and coordinates of which another is written alike; masses and inertias that are numbers in the model."""
    names = derived.symbols.loads
    for load in (load for load in derived.free.loads if load.symbol in names):
        one = f"load {load.symbol}" if _ONE_OF_SEVERAL.search(load.symbol) else load.symbol
        yield names[load.symbol].unicode(), f"{spell(load.name)}.value" if load.kind == "force" else one
    names = derived.symbols.names
    own = (name for name, entry in derived.table.items() if entry["kind"] in ("coordinate", "parameter"))
    yield from ((names[name].unicode(), spell(name)) for name in own if folded(names[name].unicode()) != folded(name))
    numbers = ((name, entry) for name, entry in derived.table.items() if entry["kind"] == "number")
    yield from ((names[name].unicode(), f"{entry['value']!r} {entry['unit']}") for name, entry in numbers)


def _bodies(derived: SymbolicState) -> Iterator[tuple[str, str]]:
    """Places, velocities and accelerations of mass centres, accelerations of pins, and angles."""
    for pin in (joint for joint in derived.source.spec["joints"] if joint["type"] == "hinge"):
        point = pin["with"]["of"][0]
        yield Name.parse(f"a_{pin['name']}").unicode(), f"[ax({point}), ay({point})]"
    for body in derived.source.metadata["bodies"]:
        said, name = spell(body["name"]), body["name"]
        read = {symbol: f"[{part}x({said}.G), {part}y({said}.G)]" for symbol, part in (("r", ""), ("v", "v"), ("a", "a"))}
        read |= {} if body["particle"] else {"alpha": f"alpha({said})"}
        yield from ((derived.symbols.of_body(symbol, name).unicode(), meant) for symbol, meant in read.items())
        plain = {"x": f"x({said}.G)", "y": f"y({said}.G)", "phi": f"angle({said})"}
        plain |= {"place_x": plain["x"], "place_y": plain["y"], "angle": plain["phi"]}
        yield from ((unicode_name(f"{stem}_{name}"), meant) for stem, meant in plain.items())


def _whole(derived: SymbolicState) -> Iterator[tuple[str, str]]:
    yield from ((name.text, meant) for name, meant in zip(energies(derived), ("kinetic()", "potential()"), strict=True))
    alone = [spell(body["name"]) for body in derived.source.metadata["bodies"]]
    for axis in "xy":
        yield derived.symbols.quantity(f"L_{axis}", f"momentum along {axis}").unicode(), f"momentum_{axis}()"
        yield f"{axis}_G", f"{axis}({alone[0]}.G)" if len(alone) == 1 else f"centre_{axis}()"
    points = [spell(point) for point in derived.points]
    yield from ((f"H/{name}", f"angular_momentum({point})") for name, point in zip(derived.points, points, strict=True))
    for point in points[:1]:
        carried = f"(centre_x() - x({point}))*momentum_y() - (centre_y() - y({point}))*momentum_x()"
        yield "H/G", f"angular_momentum({point}) - ({carried})"


def _closed(derived: SymbolicState) -> Iterator[tuple[str, str]]:
    """Numbers in laws of motions, and roots that come again and again."""
    closed = Closed(derived)
    yield from ((entry.written.unicode(), f"{size!r} {entry.doc.partition(' ')[2]}") for entry, size in closed.rates)
    yield from ((entry.written.unicode(), f"sqrt({_expression(base, {})})") for entry, base in closed.named)


def _momenta(derived: SymbolicState) -> Iterator[tuple[str, str]]:
    """Momenta that stay constant, of parts of the whole or along any direction."""
    for each in momenta(derived):
        place, bodies = f"[{', '.join(_expression(x, {}) for x in each.place)}]", ", ".join(each.found.bodies)
        of, where = ("angular momentum", f"about {place}, along k") if each.found.turns else ("momentum", f"along {place}")
        yield each.letter(derived).text, f"{of} of {bodies} {where}"


def _expression(tree: Tree, angles: Mapping[str, str]) -> str:
    """A tree in the model language, angles of bodies as they are read there."""
    return written(substitute(tree, {n: Sym(angles.get(n.name) or spell(n.name)) for n in symbols(tree)}))


def _directions(derived: SymbolicState) -> Iterator[tuple[str, str]]:
    """Unit directions that turn, λ along the x axis of a body or a link, and n across it."""
    turning = {f"{body['name']}.angle": f"angle({spell(body['name'])})" for body in derived.source.metadata["bodies"]}
    named = directions(derived)
    yield from zip(named.axes, ("[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]"), strict=True)
    for pair in named.pairs:
        angle = _expression(pair.angle, turning)
        c, s = f"cos({angle})", f"sin({angle})"
        around = (f"[{c}, {s}]", f"[-{s}, {c}]", f"[-{c}, -{s}]", f"[{s}, -{c}]")
        yield pair.along, around[pair.quarters]
        yield pair.across, around[(pair.quarters + 1) % 4]
