"""What the core tells of a state symbolically: balances, rows, motions of bodies; read from JSON."""

from __future__ import annotations

import gc
import re
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import Any

import numpy as np

from freebody.core import GROUND, CompiledModel, FreeBodies, State, SymbolicAnswers
from freebody.solve.perturbed_states import Closing, nearby
from freebody.solve.symbols import Symbols, load_words
from freebody.symbolic.linear import Linear
from freebody.symbolic.nomenclature import Nomenclature, SymbolEntry
from freebody.symbolic.symbols import Name
from freebody.symbolic.tree import ZERO, Sym, Tree, add, is_zero, mul, read, write

Question = Mapping[str, Any]
_SEED, _OTHERS = 5, 3
_NOT_APART = ("rolling_circles",)
"""Joints whose loads are not those of their equations where they were engaged apart from where they close."""
_NEAR = 0.15
"""Part by which parameters of other states differ from those of a state, or what they are where they are 0 there."""


@dataclass(frozen=True)
class Direction:
    """A part of a vector in the unit direction at an angle to the x axis, and across it, a right angle on."""

    angle: Tree
    along: Tree
    across: Tree


@dataclass(frozen=True)
class Arrow:
    """A vector: parts in turning unit directions, and what is left along the fixed axes; ``xy`` is all of it along those."""

    parts: tuple[Direction, ...]
    i: Tree
    j: Tree
    xy: tuple[Tree, Tree]

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Arrow:
        """From an answer."""
        parts = (Direction(read(d["angle"]), read(d["along"]), read(d["across"])) for d in data["directions"])
        x, y = data["xy"]
        return cls(tuple(parts), read(data["i"]), read(data["j"]), (read(x), read(y)))


@dataclass(frozen=True)
class Motion:
    """A body: its angle and the position, velocity and acceleration of its mass centre."""

    body: str
    particle: bool
    mass: Tree
    inertia: Tree
    angle: Tree
    omega: Tree
    alpha: Tree
    r: Arrow
    v: Arrow
    a: Arrow


@dataclass(frozen=True)
class Contribution:
    """What one load, by its place in the list, gives to a balance; ``internal``: it acts between bodies of the group."""

    load: int
    tree: Tree
    internal: bool

    @property
    def absent(self) -> bool:
        """Whether it gives nothing."""
        return self.internal or is_zero(self.tree)


@dataclass(frozen=True)
class Balance:
    """Σ M = Ḣ or Σ F = L̇ of a group: ``left`` = ``right``; ``momentum`` is 0, and ``inertia`` of no body, where it was not asked for.

    ``place`` is the point about which, or the vector along which; ``linear`` is right − left by what is unknown."""

    bodies: tuple[str, ...]
    turns: bool
    place: Arrow
    contributions: tuple[Contribution, ...]
    inertia: tuple[tuple[str, Tree], ...]
    momentum: Tree
    left: Tree
    right: Tree
    linear: Linear

    @property
    def residual(self) -> Tree:
        """right − left, by what is unknown."""
        return add(*(mul(factor, x) for x, factor in self.linear.coefficients.items()), self.linear.rest)

    def without(self, loads: Collection[int], nomenclature: Collection[str]) -> Balance:
        """The same with some loads left out, by place and symbol: they vanish wherever loops and contacts are closed, though not
        identically in the symbols."""
        if not any(each.load in loads and not each.absent for each in self.contributions):
            return self
        kept = tuple(replace(each, tree=ZERO) if each.load in loads else each for each in self.contributions)
        left = add(*(each.tree for each in kept if not each.internal))
        linear = Linear(
            {x: c for x, c in self.linear.coefficients.items() if x.dots or x.name not in nomenclature}, self.linear.rest
        )
        return replace(self, contributions=kept, left=left, linear=linear)

    def with_trees(self, put: Callable[[Tree], Tree]) -> Balance:
        """The same, every expression as ``put`` makes it; what is unknown and vanishes is left out."""
        loads = tuple(replace(each, tree=put(each.tree)) for each in self.contributions)
        inertia = tuple((body, put(tree)) for body, tree in self.inertia)
        trees = map(put, (self.momentum, self.left, self.right))
        kept = {x: put(tree) for x, tree in self.linear.coefficients.items() if not is_zero(put(mul(tree, x)))}
        return Balance(self.bodies, self.turns, self.place, loads, inertia, *trees, Linear(kept, put(self.linear.rest)))

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Balance:
        """From an answer."""
        test, turns = data["test"], data["test"]["kind"] == "moment"
        loads = (Contribution(each["load"], read(each["tree"]), each["internal"]) for each in data["loads"])
        trees = (read(data.get(word, write(ZERO))) for word in ("momentum", "left", "right"))
        inertia = tuple((each["body"], read(each["tree"])) for each in data["inertia"])
        place = Arrow.read(test["about" if turns else "along"])
        return cls(tuple(data["bodies"]), turns, place, tuple(loads), inertia, *trees, Linear.read(data["linear"]))


@dataclass(frozen=True)
class Row:
    """What a joint that closes a loop, a motion or a closed limit asks: ``value``, ``rate`` and ``acceleration`` vanish.

    A row without a value holds rates only, one without a rate accelerations only."""

    name: str
    kind: str
    value: Tree | None
    rate: Tree | None
    acceleration: Tree
    linear: Linear

    def with_trees(self, put: Callable[[Tree], Tree]) -> Row:
        """The same, every expression as ``put`` makes it."""
        levels = (None if tree is None else put(tree) for tree in (self.value, self.rate, self.acceleration))
        return Row(self.name, self.kind, *levels, self.linear.with_trees(put))

    @property
    def says_nothing(self) -> bool:
        """Whether it holds wherever the coordinates are, and however they move."""
        return all(tree is None or is_zero(tree) for tree in (self.value, self.rate, self.acceleration))

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Row:
        """From an answer."""
        value, rate = (None if data[word] is None else read(data[word]) for word in ("value", "rate"))
        return cls(data["name"], data["kind"], value, rate, read(data["acceleration"]), Linear.read(data["linear"]))


@dataclass(frozen=True)
class SymbolicState:
    """What is derived: a mechanism at a state, of which symbols may be set to numbers; ``given`` are its loads where they are not those
    that the state has by itself: after a mode change, or during an impact."""

    source: CompiledModel
    state: State
    at_rest: bool = False
    numbers: Mapping[str, float] | None = None
    given: FreeBodies | None = field(default=None, repr=False)

    def __post_init__(self) -> None:
        if self.given is None:
            for part, value in zip(("source", "state"), self.source.as_it_holds(self.state), strict=True):
                object.__setattr__(self, part, value)

    def with_numbers(self, names: Sequence[str]) -> SymbolicState:
        """The same with some coordinates and parameters as the numbers that they are at the state."""
        parameters = [p["name"] for p in self.source.metadata["parameters"]]
        known = zip(self.names + parameters, [*self.q, *self.state.p.tolist()], strict=True)
        return replace(self, numbers={name: x for name, x in known if name in names})

    def titled(self, title: str) -> str:
        """A title with the model's name and the moment of the state."""
        return ", ".join(filter(None, (f"{self.source.name}: {title}", self.state.moment)))

    def ask(self, questions: Sequence[Question]) -> list[Any]:
        """The answers of the core, as data. Raises ``MotionError``."""
        return self._ask(questions).answers

    def balances(self, questions: Sequence[Question]) -> list[Balance]:
        """Answers about balances."""
        with uncollected():
            return list(map(Balance.read, self.ask(questions)))

    def of_bodies(self) -> list[Balance]:
        """The balances of every body by itself: force along x and y, and moment about the mass centre of one that is no particle."""
        bodies = self.free.bodies.values()
        ways = ((body, how) for body in bodies for how in ({"along": "x"}, {"along": "y"}, {"about": "centre"}))
        cut = [{"ask": "equation", "bodies": [body.name], **how} for body, how in ways if not (body.particle and "about" in how)]
        return self.balances(cut)

    @cached_property
    def names(self) -> list[str]:
        """The names of the coordinates."""
        return [c["name"] for c in self.coordinates]

    @property
    def coordinates(self) -> list[dict[str, Any]]:
        """The coordinates in place, as the core describes them: all but those along curves that bodies have left."""
        return [self.source.metadata["coordinates"][i] for i in self._places]

    @property
    def q(self) -> list[float]:
        """The values of the coordinates."""
        return self.state.q[self._places].tolist()

    @property
    def u(self) -> list[float]:
        """Their rates."""
        return self.state.u[self._places].tolist()

    @cached_property
    def _places(self) -> list[int]:
        return [i for i, c in enumerate(self.source.metadata["coordinates"]) if c["name"] in self.table]

    @cached_property
    def free(self) -> FreeBodies:
        """All loads at the state, in numbers; they are counted as in contributions."""
        return self.given or self.source.free_bodies(self.state)

    @cached_property
    def usual_rate(self) -> float:
        """What rates are measured by at the state, 1/s."""
        return self.free.usual_rate(self.coordinates, self.state.u)

    @cached_property
    def neighbours(self) -> list[FreeBodies]:
        """The free bodies at the state and at others near by, with other parameters, as far as these are symbols: so what drops out
        of a balance there does so whatever the symbols are."""
        rng, fixed = np.random.default_rng(_SEED), self.numbers or {}
        names, given = [p["name"] for p in self.source.metadata["parameters"]], self.state.p.tolist()
        parts = rng.uniform(1 - _NEAR, 1 + _NEAR, (_OTHERS, len(given)))
        changed = [{n: x if n in fixed else k * (x or _NEAR) for n, x, k in zip(names, given, row, strict=True)} for row in parts]
        return nearby(self.source, self.regular, list(map(self.source.bind, changed)))

    @cached_property
    def regular(self) -> State:
        """The state; or one near by, in which the same is closed, where the core decides symbols beside it: where a spring has no length,
        or a string no free length, more vanishes than does elsewhere."""
        names = self.table.keys() - (self.numbers or {}).keys()
        beside = self.state.q.copy()
        for i, name in zip(self._places, self.names, strict=True):
            if name in names:
                beside[i] = self.table[name]["value"]
        if np.array_equal(beside, self.state.q):
            return self.state
        place = Closing(self.source, self.state, self.free).place(beside)
        return self.state if place is None else replace(self.state, q=place)

    @cached_property
    def rows(self) -> list[Row]:
        """What closes loops, prescribes motions, and holds limits."""
        return list(map(Row.read, self.ask([{"ask": "rows"}])[0]))

    @cached_property
    def motions(self) -> list[Motion]:
        """Of every body."""
        trees = ("mass", "inertia", "angle", "omega", "alpha")
        [stated] = self.ask([{"ask": "kinematics"}])
        return [
            Motion(b["body"], b["particle"], *(read(b[w]) for w in trees), *(Arrow.read(b[w]) for w in "rva")) for b in stated
        ]

    @cached_property
    def table(self) -> dict[str, dict[str, Any]]:
        """The symbols as the core lists them: kind, unit and value by name."""
        return self._ask([]).symbols

    @cached_property
    def laws(self) -> list[tuple[Sym, Tree]]:
        """Loads that follow from others by a law that is not linear, with what they are."""
        return [(Sym(law["load"]), read(law["tree"])) for law in self._ask([]).laws]

    @cached_property
    def symbols(self) -> Symbols:
        """How everything is written."""
        return Symbols.of(self.source, self.free.loads, self.table)

    @cached_property
    def nomenclature(self) -> Nomenclature:
        """All symbols in the order of the model: coordinates, parameters, what the model leaves without a name, unknowns, time."""
        table, written = self.table, self.symbols.names
        given = [p["name"] for p in self.source.metadata["parameters"] if p["name"] in table]
        made = [SymbolEntry(c["name"], "coordinate", c["dimension"] or "", c["doc"].replace("`", "")) for c in self.coordinates]
        made += [SymbolEntry(name, "parameter", table[name]["unit"] or self._multiple(name)) for name in given]
        made += [
            SymbolEntry(name, "constant", each["unit"], each["doc"]) for name, each in table.items() if each["kind"] == "number"
        ]
        made = [x if written[x.name] == Name.parse(x.name) else replace(x, written=written[x.name]) for x in made]
        for load in self.free.loads:
            if load.unknown and not load.follows:
                unit, doc = "N*m" if load.card.couple else "", f"{load_words(load)} ({load.symbol})"
                made.append(SymbolEntry(load.symbol, "unknown", unit, doc, self.symbols.loads[load.symbol]))
        return Nomenclature({x.name: x for x in (*made, SymbolEntry("t", "time", "s", "time"))}, self.symbols.renamed)

    def _multiple(self, name: str) -> str:
        """The unit of a parameter that is another one times numbers: of ``2*l1*sqrt(2)`` m, which might hide another in a model."""
        text = str((self.source.model.get("parameters") or {}).get(name, ""))
        names = [word for word in re.findall(r"[^\W\d]\w*", text) if word not in ("sqrt", "pi")]
        alone = len(names) == 1 and names[0] in self.table and not re.search(r"[\^/+-]|\*\*", text)
        return self.table[names[0]]["unit"] if alone else ""

    @cached_property
    def values(self) -> dict[Sym, float]:
        """The numbers of all symbols at the state."""
        found = {Sym(name): entry["value"] for name, entry in self.table.items()}
        found |= {Sym(load.symbol): load.value for load in self.free.loads if load.unknown}
        for dots, numbers in enumerate((self.q, self.u)):
            found |= {Sym(name, dots): x for name, x in zip(self.names, numbers, strict=True)}
        return found | {Sym(name, 2): x for name, x in self.free.accelerations.items()}

    @cached_property
    def constants(self) -> dict[Sym, float]:
        """Those of what does not move: parameters and numbers without a name."""
        return {Sym(name): np.float64(entry["value"]) for name, entry in self.table.items() if name not in {*self.names, "t"}}

    @cached_property
    def tables(self) -> dict[str, Callable[..., float]]:
        """The functions of the model that are given by points."""

        def at(name: str, x: float) -> float:
            return float(self.source.evaluate([f"{name}({float(x)!r})"], self.state)[0])

        return {table["name"]: partial(at, table["name"]) for table in self.source.spec.get("tables", [])}

    @cached_property
    def points(self) -> Mapping[str, tuple[str, float, float]]:
        """Named points: body, x, y in its frame."""
        return self.source.points(self.state.p)

    @cached_property
    def lines(self) -> Mapping[str, str]:
        """The lines along which joints move, in the words of the model: joint → ``the slope``, ``the track of rod``."""
        found = {}
        for joint, given in (self.source.model.get("joints") or {}).items():
            if isinstance(given.get("along"), str):
                body, _, line = given["along"].rpartition(".")
                name = f"the {line}" if len(line) > 1 else f"the line {line}"
                found[joint] = name if body in ("", GROUND) else f"{name} of {body}"
        return found

    def line(self, direction: str) -> str:
        """A direction that is named after a joint by the name of its line: ``the normal of the slope``."""
        joint = next((name for name in self.lines if direction == name or direction.endswith(f" of {name}")), None)
        return direction.removesuffix(joint) + self.lines[joint] if joint else direction

    @cached_property
    def idle(self) -> list[str]:
        """Contacts, strings and stops that are closed at the state and carry nothing there, so that no load of theirs is known."""
        acting = {load.name for load in self.free.loads}
        limits = {} if self.given else self.source.instant(self.state).limits
        return [name for name, each in limits.items() if not (each.is_open or each.state == "off" or name in acting)]

    def _ask(self, questions: Sequence[Question]) -> SymbolicAnswers:
        found = self.source.symbolic_answers(self.state, questions, self.at_rest, self.numbers)
        if joint := next((name for name in self._not_apart if any(_is_offset(x, name) for x in found.symbols.values())), None):
            raise ValueError(
                f"joints.{joint}: it was engaged where its circles do not touch, and no equations are derived for that\n"
                "  engage it where they touch: `when` their distance says so"
            )
        return found

    @property
    def _not_apart(self) -> list[str]:
        return [joint["name"] for joint in self.source.spec["joints"] if joint["type"] in _NOT_APART]


def _is_offset(entry: Mapping[str, Any], joint: str) -> bool:
    """Whether a symbol says where a joint was engaged."""
    return entry["kind"] == "number" and entry["names"][1].startswith(f"offset_{joint}")


@contextmanager
def uncollected() -> Iterator[None]:
    """No search for cycles while large trees are made, which have none: it would take as long as the making."""
    was = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was:
            gc.enable()
