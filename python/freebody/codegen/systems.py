"""A whole mechanism as code that computes by itself: two linear systems, Lagrange's equations and the balances of all bodies."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

from freebody.codegen.functions import generate
from freebody.codegen.refusals import CannotGenerate, check
from freebody.core import CompiledModel, State
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.linear import Linear, linear_in
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.tree import ZERO, Sym, Tree, negative, read

Matrix = tuple[tuple[Tree, ...], ...]
Row = tuple[Tree, ...]


@dataclass(frozen=True)
class Systems:
    """The equations of a mechanism as they are written into code; each vanishes.

    ``moving`` those of Lagrange, one for every coordinate; ``rows`` what loops and motions ask of the accelerations;
    ``balances`` force along x and y, and moment about the mass centre, body by body. ``values`` are those of the parameters."""

    name: str
    nomenclature: Nomenclature
    values: Mapping[str, float]
    moving: tuple[Linear, ...]
    rows: tuple[Linear, ...]
    balances: tuple[Linear, ...]

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Names, in the order of the state."""
        return tuple(self.nomenclature.of_kind("coordinate"))

    @property
    def loads(self) -> tuple[str, ...]:
        """Names of what is unknown besides the accelerations: all reactions, and what motions take."""
        return tuple(self.nomenclature.of_kind("unknown"))

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


def program(source: CompiledModel, state: State, language: str = "python") -> str:
    """Code of the equations of a mechanism, in one of ``LANGUAGES``.

    ``state`` says what is in place, and on which branch; the functions hold for all coordinates q, rates u, parameters p and times t.
    Raises ``CannotGenerate`` for what switches (contacts, strings, friction, laws with cases) or comes from a table, and where
    reactions are not determined; ``MotionError`` for a state without an answer."""
    check(source, source.free_bodies(state))
    found = systems(source, state)
    pairs = zip(found.coordinates, found.moving, strict=True)
    if idle := [name for name, equation in pairs if not (equation.coefficients or found.is_square)]:
        raise CannotGenerate(
            f"{idle[0]} has no equation of its own: it is a place along a curve, which closes a loop because its joint can be released; "
            "leave out the events that release the joint"
        )
    if not found.is_square:
        raise CannotGenerate(
            "loops and motions ask more of the accelerations than their loads can give; release a joint or a motion"
        )
    return generate(found.functions(), found.nomenclature, language, found)


def systems(source: CompiledModel, state: State) -> Systems:
    """The equations of a mechanism near a state. Raises ``MotionError``."""
    subject = SymbolicState(source, state)
    given = {item["name"]: item["value"] for item in source.spec["parameters"]}
    docs = {
        name: _formula(value, given) for name, value in given.items()
    }  # and of loads without the symbol, which stands beside it
    stated = {name: replace(x, doc=docs.get(name, x.doc.removesuffix(f" ({name})"))) for name, x in subject.nomenclature.items()}
    nomenclature = Nomenclature(stated, subject.nomenclature.renamed)
    unknowns = {*(Sym(name, 2) for name in subject.names), *map(Sym, nomenclature.of_kind("unknown"))}
    moving = subject.ask([{"ask": "lagrange"}])[0]["equations"]
    return Systems(
        source.name,
        nomenclature,
        {name: subject.values[Sym(name)] for name in nomenclature.of_kind("parameter", "constant")},
        tuple(linear_in(read(each["residual"]), unknowns) for each in moving),
        tuple(row.linear for row in subject.rows),
        tuple(balance.linear for balance in subject.of_bodies()),
    )


def _matrix(equations: Sequence[Linear], unknowns: Sequence[Sym]) -> Matrix:
    return tuple(tuple(equation.coefficients.get(symbol, ZERO) for symbol in unknowns) for equation in equations)


def _formula(value: str | float, names: Collection[str]) -> str:
    """What a parameter depends on in the model: in generated code every parameter is free."""
    depends = isinstance(value, str) and set(re.findall(r"[^\W\d][\w.]*", value)) & set(names)
    return f"{value} in the model, here a number of its own" if depends else ""
