"""The two linear systems of generated code, read from the core: Lagrange's equations, and the balances of all bodies."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from freebody.core import CompiledModel, FreeBodies, Load, State
from freebody.equations.linear import Linear, linear_in
from freebody.solve.symbols import Symbols
from freebody.symbolic.letters import Letter, Letters
from freebody.symbolic.tree import ZERO, Sym, Tree, negative, read

Matrix = tuple[tuple[Tree, ...], ...]
Row = tuple[Tree, ...]


@dataclass(frozen=True)
class Systems:
    """The equations of a mechanism as they are written into code; each vanishes.

    ``moving`` those of Lagrange, one for every coordinate; ``rows`` what loops and motions ask of the accelerations;
    ``balances`` force along x and y, and moment about the mass centre, body by body. ``values`` are those of the parameters."""

    name: str
    letters: Letters
    values: Mapping[str, float]
    moving: tuple[Linear, ...]
    rows: tuple[Linear, ...]
    balances: tuple[Linear, ...]

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Names, in the order of the state."""
        return tuple(self.letters.of_kind("coordinate"))

    @property
    def loads(self) -> tuple[str, ...]:
        """Names of what is unknown besides the accelerations: all reactions, and what motions take."""
        return tuple(self.letters.of_kind("unknown"))

    @property
    def multipliers(self) -> tuple[str, ...]:
        """The loads that are in the equations of the coordinates: those of what closes loops, and of motions."""
        return tuple(name for name in self.loads if any(Sym(name) in equation.coefficients for equation in self.moving))

    @property
    def is_square(self) -> bool:
        """Whether there are as many equations as unknowns."""
        closed = len(self.multipliers) == len(self.rows)
        return closed and len(self.balances) + len(self.rows) == len(self.coordinates) + len(self.loads)

    def functions(self) -> dict[str, Row | Matrix]:
        """Trees of the generated functions: M q̈ = f + C λ with J q̈ + h = 0, and A x = b for x = (q̈, loads)."""
        accelerations = [Sym(name, 2) for name in self.coordinates]
        loads, multipliers = ([Sym(name) for name in names] for names in (self.loads, self.multipliers))
        found: dict[str, Row | Matrix] = {
            "mass_matrix": _matrix(self.moving, accelerations),
            "right_hand_side": tuple(negative(equation.rest) for equation in self.moving),
        }
        if self.rows:
            found["multiplier_matrix"] = tuple(tuple(map(negative, row)) for row in _matrix(self.moving, multipliers))
            found["constraint_jacobian"] = _matrix(self.rows, accelerations)
            found["constraint_bias"] = tuple(row.rest for row in self.rows)
        every = (*self.balances, *self.rows)
        found["balance_matrix"] = _matrix(every, [*accelerations, *loads])
        found["balance_right_hand_side"] = tuple(negative(equation.rest) for equation in every)
        return found


def systems(source: CompiledModel, state: State) -> Systems:
    """The equations of a mechanism near a state. Raises ``MotionError``."""
    free = source.free_bodies(state)
    cut = [{"ask": "equation", "bodies": [body.name], **how} for body in free.bodies.values() for how in _ways(body.particle)]
    stated = source.letters(state, [{"ask": "rows"}, {"ask": "lagrange"}, *cut])
    rows, lagrange, *balances = stated.answers
    letters = _letters(source, free, stated.letters)
    unknowns = {*(Sym(name, 2) for name in letters.of_kind("coordinate")), *map(Sym, letters.of_kind("unknown"))}
    values = {name: stated.letters[name]["value"] for name in letters.of_kind("parameter", "constant")}
    return Systems(
        source.name,
        letters,
        values | dict(zip((each["name"] for each in source.metadata["parameters"]), state.p.tolist(), strict=True)),
        tuple(linear_in(read(each["residual"]), unknowns) for each in lagrange["equations"]),
        tuple(Linear.read(row["linear"]) for row in rows),
        tuple(Linear.read(each["linear"]) for each in balances),
    )


def _ways(particle: bool) -> list[dict[str, str]]:
    return [{"along": "x"}, {"along": "y"}] + ([] if particle else [{"about": "centre"}])


def _matrix(equations: Sequence[Linear], unknowns: Sequence[Sym]) -> Matrix:
    return tuple(tuple(equation.coefficients.get(letter, ZERO) for letter in unknowns) for equation in equations)


def _letters(source: CompiledModel, free: FreeBodies, table: Mapping[str, Mapping[str, Any]]) -> Letters:
    """All letters in the order of the model: coordinates, parameters, numbers without a name, unknown loads, time."""
    metadata = source.metadata
    found = [Letter(c["name"], "coordinate", c["dimension"] or "", c["doc"].replace("`", "")) for c in metadata["coordinates"]]
    given = {item["name"]: item["value"] for item in source.spec["parameters"]}
    found += [Letter(name, "parameter", table[name]["unit"], _formula(value, given)) for name, value in given.items()]
    unnamed = (name for name, entry in table.items() if entry["kind"] == "number")
    found += [Letter(name, "constant", table[name]["unit"], table[name]["doc"]) for name in unnamed]
    found += [Letter(load.symbol, "unknown", "", _said(load)) for load in free.loads if load.unknown and not load.follows]
    renamed = Symbols.of(source, free.loads, table).renamed
    return Letters({letter.name: letter for letter in (*found, Letter("t", "time", "s"))}, renamed)


def _formula(value: str | float, names: Collection[str]) -> str:
    """What a parameter depends on in the model: in generated code every parameter is free."""
    depends = isinstance(value, str) and set(re.findall(r"[^\W\d][\w.]*", value)) & set(names)
    return f"{value} in the model, here a number of its own" if depends else ""


def _said(load: Load) -> str:
    if load.kind != "joint":
        return f"what {load.name} takes"
    return f"{load.card.name} of {load.name} on {load.of[-1]}, from {load.of[0]}"
