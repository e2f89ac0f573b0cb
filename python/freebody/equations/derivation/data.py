"""What the core tells of a state symbolically: balances, rows, motions of bodies; read from JSON."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from freebody.core import GROUND, CompiledModel, FreeBodies, State, SymbolicAnswers
from freebody.equations.derivation.meaning import plain
from freebody.equations.linear import Linear
from freebody.solve.perturbed_states import nearby
from freebody.solve.symbols import Symbols, load_words
from freebody.symbolic.collect import divided
from freebody.symbolic.letters import Letter, Letters
from freebody.symbolic.symbols import Name
from freebody.symbolic.tree import ZERO, Sym, Tree, add, is_zero, minus, mul, negative, read

Question = Mapping[str, Any]
_SEED, _OTHERS = 5, 3
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
    """Σ M = Ḣ or Σ F = L̇ of a group: ``left`` = ``right``; ``residual`` = right − left.

    ``place`` is the point about which, or the vector along which; ``linear`` that of the residual."""

    bodies: tuple[str, ...]
    turns: bool
    place: Arrow
    contributions: tuple[Contribution, ...]
    inertia: tuple[tuple[str, Tree], ...]
    momentum: Tree
    left: Tree
    right: Tree
    residual: Tree
    linear: Linear

    def without(self, loads: Collection[int], letters: Collection[str]) -> Balance:
        """The same with some loads left out, by place and letter: they vanish wherever loops and contacts are closed, though not
        identically in the letters."""
        if not any(each.load in loads and not each.absent for each in self.contributions):
            return self
        kept = tuple(replace(each, tree=ZERO) if each.load in loads else each for each in self.contributions)
        left = add(*(each.tree for each in kept if not each.internal))
        coefficients = {x: tree for x, tree in self.linear.coefficients.items() if x.dots or x.name not in letters}
        linear = Linear(coefficients, self.linear.rest)
        return replace(self, contributions=kept, left=left, residual=minus(self.right, left), linear=linear)

    def with_trees(self, put: Callable[[Tree], Tree]) -> Balance:
        """The same, every expression as ``put`` makes it; what is unknown and vanishes is left out."""
        loads = tuple(replace(each, tree=put(each.tree)) for each in self.contributions)
        inertia = tuple((body, put(tree)) for body, tree in self.inertia)
        momentum, left, right, residual = map(put, (self.momentum, self.left, self.right, self.residual))
        kept = {x: put(tree) for x, tree in self.linear.coefficients.items() if not is_zero(put(mul(tree, x)))}
        linear = Linear(kept, put(self.linear.rest))
        return Balance(self.bodies, self.turns, self.place, loads, inertia, momentum, left, right, residual, linear)

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Balance:
        """From an answer."""
        test, turns = data["test"], data["test"]["kind"] == "moment"
        loads = (Contribution(each["load"], read(each["tree"]), each["internal"]) for each in data["loads"])
        trees = (read(data[word]) for word in ("momentum", "left", "right", "residual"))
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

    @property
    def negative(self) -> Row:
        """The same with all signs changed."""
        value, rate = (None if tree is None else negative(tree) for tree in (self.value, self.rate))
        return replace(self, value=value, rate=rate, acceleration=negative(self.acceleration), linear=self.linear.negative())

    def over(self, factor: Tree) -> Row:
        """The same with everything divided by a number."""
        value, rate = (None if tree is None else divided(tree, factor) for tree in (self.value, self.rate))
        return replace(
            self, value=value, rate=rate, acceleration=divided(self.acceleration, factor), linear=self.linear.over(factor)
        )

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
    """What is derived: a mechanism at a state, of which letters may be set to numbers."""

    source: CompiledModel
    state: State
    at_rest: bool = False
    numbers: Mapping[str, float] | None = None

    def with_numbers(self, names: Sequence[str]) -> SymbolicState:
        """The same with some coordinates and parameters as the numbers that they are at the state."""
        places = {c["name"]: float(x) for c, x in zip(self.coordinates, self.state.q, strict=True)}
        places |= {p["name"]: float(x) for p, x in zip(self.source.about["parameters"], self.state.p, strict=True)}
        return replace(self, numbers={name: places[name] for name in names})

    def ask(self, questions: Sequence[Question]) -> list[Any]:
        """The answers of the core, as data. Raises ``MotionError``."""
        return self._ask(questions).answers

    def balances(self, questions: Sequence[Question]) -> list[Balance]:
        """Answers about balances."""
        return list(map(Balance.read, self.ask(questions)))

    @property
    def coordinates(self) -> list[dict[str, Any]]:
        """The coordinates of the tree, as the core describes them."""
        return self.source.about["coordinates"]

    @cached_property
    def free(self) -> FreeBodies:
        """All loads at the state, in numbers; they are counted as in contributions."""
        return self.source.free_bodies(self.state)

    @cached_property
    def neighbours(self) -> list[FreeBodies]:
        """The free bodies at the state and at others near by, with other parameters, as far as these are letters: so what drops out
        of a balance there does so whatever the letters are."""
        rng, fixed = np.random.default_rng(_SEED), self.numbers or {}
        given = [(p["name"], float(x)) for p, x in zip(self.source.about["parameters"], self.state.p, strict=True)]
        parts = rng.uniform(1 - _NEAR, 1 + _NEAR, (_OTHERS, len(given)))
        changed = [
            self.source.bind(
                {name: x if name in fixed else part * (x or _NEAR) for (name, x), part in zip(given, row, strict=True)}
            )
            for row in parts
        ]
        return nearby(self.source, self.state, changed)

    @cached_property
    def rows(self) -> list[Row]:
        """What closes loops, prescribes motions, and holds limits."""
        return list(map(Row.read, self.ask([{"ask": "rows"}])[0]))

    @cached_property
    def motions(self) -> list[Motion]:
        """Of every body."""
        arrows, trees = ("r", "v", "a"), ("mass", "inertia", "angle", "omega", "alpha")
        stated = self.ask([{"ask": "kinematics"}])[0]
        return [
            Motion(b["body"], b["particle"], **{w: read(b[w]) for w in trees}, **{w: Arrow.read(b[w]) for w in arrows})
            for b in stated
        ]

    @cached_property
    def table(self) -> dict[str, dict[str, Any]]:
        """The letters as the core lists them: kind, unit and value by name."""
        return self._ask([]).letters

    @cached_property
    def laws(self) -> list[tuple[Sym, Tree]]:
        """Loads that follow from others by a law that is not linear, with what they are."""
        return [(Sym(law["load"]), read(law["tree"])) for law in self._ask([]).laws]

    @cached_property
    def symbols(self) -> Symbols:
        """How everything is written."""
        return Symbols.of(self.source, self.free.loads, self.table)

    @cached_property
    def letters(self) -> Letters:
        """All letters in the order of the model: coordinates, parameters, what the model leaves without a name, unknowns, time."""
        table, written = self.table, self.symbols.names
        found = {c["name"]: Letter(c["name"], "coordinate", c["dimension"] or "", plain(c["doc"])) for c in self.coordinates}
        given = [p["name"] for p in self.source.about["parameters"]]
        unnamed = [name for name, entry in table.items() if entry["kind"] == "number"]
        found |= {name: Letter(name, "parameter", table[name]["unit"]) for name in given if name in table}
        found |= {name: Letter(name, "constant", table[name]["unit"], table[name]["doc"]) for name in unnamed}
        found = {name: letter if written[name] == Name.parse(name) else replace(letter, written=written[name])
                 for name, letter in found.items()}  # fmt: skip
        for load in self.free.loads:
            if load.unknown and not load.follows:
                unit, doc = "N*m" if load.card.couple else "", f"{load_words(load)} ({load.symbol})"
                found[load.symbol] = Letter(load.symbol, "unknown", unit, doc, self.symbols.loads[load.symbol])
        return Letters(found | {"t": Letter("t", "time", "s", "time")}, self.symbols.renamed)

    @cached_property
    def values(self) -> dict[Sym, float]:
        """The numbers of all letters at the state."""
        s, free, names = self.state, self.free, [c["name"] for c in self.coordinates]
        found = {Sym(name): entry["value"] for name, entry in self.table.items()}
        found |= {Sym(load.symbol): load.value for load in free.loads if load.unknown}
        found |= {Sym(name): float(x) for name, x in zip(names, s.q, strict=True)}
        found |= {Sym(name, 1): float(x) for name, x in zip(names, s.u, strict=True)}
        return found | {Sym(name, 2): x for name, x in free.accelerations.items()}

    @cached_property
    def tables(self) -> dict[str, Callable[..., float]]:
        """The functions of the model that are given by points."""
        s, core = self.state, self.source
        names = [table["name"] for table in self.source.spec.get("tables", [])]

        def table(name: str) -> Callable[..., float]:
            return lambda x: float(core.evaluate([f"{name}({float(x)!r})"], s)[0])

        return {name: table(name) for name in names}

    @cached_property
    def points(self) -> Mapping[str, tuple[str, float, float]]:
        """Named points: body, x, y in its frame."""
        return self.source.points(self.state.p)

    @cached_property
    def lines(self) -> Mapping[str, str]:
        """The lines along which joints move, in the words of the model: joint → ``the slope``, ``the track of rod``."""
        joints = self.source.model.get("joints") or {}
        along = {name: joint.get("along") for name, joint in joints.items()}
        return {name: _line_words(*text.rpartition(".")[::2]) for name, text in along.items() if isinstance(text, str)}

    def line(self, direction: str) -> str:
        """A direction that is named after a joint by the name of its line: ``the normal of the slope``."""
        joint = next((name for name in self.lines if direction == name or direction.endswith(f" of {name}")), None)
        return direction.removesuffix(joint) + self.lines[joint] if joint else direction

    def _ask(self, questions: Sequence[Question]) -> SymbolicAnswers:
        return self.source.letters(self.state, questions, self.at_rest, self.numbers)


def _line_words(body: str, line: str) -> str:
    name = f"the {line}" if len(line) > 1 else f"the line {line}"
    return name if body in ("", GROUND) else f"{name} of {body}"
