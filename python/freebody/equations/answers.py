"""Answers in letters: accelerations and reactions of one instant, from the fewest balances, solved and simplified."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.balances.equation import BalanceEquation
from freebody.balances.smallest import smallest_set
from freebody.balances.states import nearby
from freebody.equations.derivation.balancing import Stated, blocks
from freebody.equations.derivation.coordinates import stated as of_coordinates
from freebody.equations.derivation.meaning import joined
from freebody.equations.derivation.sentences import lettered
from freebody.equations.derivation.told import Row, Subject
from freebody.equations.document import Block, Document, Equation, Heading, Paragraph
from freebody.equations.given import Given, given
from freebody.equations.letters import Letters
from freebody.equations.linear import Linear
from freebody.equations.measured import shown
from freebody.equations.simplify import PATIENCE
from freebody.equations.solve import TooLarge, limit, solve
from freebody.equations.to_sympy import to_sympy
from freebody.equations.tree import MINUS_ONE, ZERO, Add, Mul, Pow, Sym, Tree, evaluate, mul, negative, operations, power
from freebody.free_body import FreeBodies
from freebody.instant import Instant

if TYPE_CHECKING:
    from freebody.model.builder import Builder

MOST_EQUATIONS = 4
"""More equations together are not solved in letters."""
MOST_OPERATIONS = {1: 1000, 2: 200, 3: 150, 4: 150}
"""Operations in all coefficients, by the number of equations, above which the answer would fill pages."""
MOST_MEASURED = 8
"""More where lengths and angles are numbers."""
MOST_OPERATIONS_MEASURED = 250
"""The same there."""
AGREES = 1e-7
"""Difference from the numbers, relative to the largest acceleration or load of its kind."""
_OTHERS = 3
_SEED = 5


@dataclass(frozen=True)
class Answers:
    """What was wanted as trees, ``values[name]``, SI; ``limits[name, letter]`` where limits were asked for; ``print`` shows the
    equations that give it. ``checked``: at how many states it was held against the numbers."""

    values: Mapping[str, Tree]
    limits: Mapping[tuple[str, str], Tree]
    letters: Letters
    document: Document = field(repr=False)
    checked: int

    def __getitem__(self, name: str) -> Tree:
        return self.values[name]

    def __str__(self) -> str:
        return self.document.text()

    def _repr_html_(self) -> str:
        return self.document._repr_html_()

    def _repr_latex_(self) -> str:
        return self.document.latex()

    def sympy(self) -> dict[str, Any]:
        """What was wanted as SymPy expressions."""
        return {name: to_sympy(tree) for name, tree in self.values.items()}


def solve_in_letters(
    mechanism: Builder,
    wanted: Sequence[str] | None = None,
    *,
    at_rest: bool = False,
    set: Mapping[str, Any] | None = None,
    limits: Mapping[str, Any] | None = None,
    initial: Mapping[str, Any] | None = None,
    patience: float = PATIENCE,
) -> Answers:
    """Accelerations and reactions in letters, near the start of the model.

    ``wanted``: coordinates (their accelerations), components of reactions (``pivot.Fx``), motions; all accelerations by default.
    ``at_rest``: all rates are 0, as just after release. ``set``: coordinates and parameters as quantities, ``"45 deg"``, or
    parameters as other parameters, ``{"m2": "m1"}``. ``limits``: letters and what they go to, ``{"m2": "inf", "m1": 0}``.
    What switches (contacts, arms of laws) is as it is at that start. Every answer is held against numbers at the start and at
    states near by. Raises ``TooLarge``, ``Singular``, ``KeyError`` for what is not unknown, ``Indeterminate``."""
    chosen = given(mechanism, set or {})
    state = chosen.start(mechanism, at_rest, initial)
    if at_rest and np.abs(state.u).max(initial=0.0) > AGREES:
        raise ValueError("a motion prescribes rates that are not 0, so it is not at rest; leave at_rest out")
    subject = Subject(mechanism.source(), state, at_rest)
    names = list(wanted) if wanted else [c["name"] for c in subject.coordinates]
    try:
        return _answers(subject, chosen, names, limits or {}, patience)
    except TooLarge:
        lengths = [n for n in subject.letters.geometric() if n not in chosen.trees and n not in (limits or {})]
        if not lengths:
            raise
        return _answers(subject, chosen.and_numbers(subject.with_numbers(lengths).numbers or {}), names, limits or {}, patience)


def _answers(subject: Subject, chosen: Given, names: Sequence[str], limits: Mapping[str, Any], patience: float) -> Answers:
    letters = subject.letters
    found: dict[str, Tree] = {}
    made: list[Block] = []
    for system in _systems(subject, chosen, names):
        solution = _solved(subject, system, chosen, patience)
        made += [*(b for s in system.stated for b in blocks(subject, s)), *_asked(system.rows), *_shown(system, solution)]
        found |= solution
    values = {name: found[_letter(subject, name)] for name in names}
    checked = _check(subject, chosen, {_letter(subject, name): tree for name, tree in values.items()})
    at = {(n, x): limit(tree, x, _target(to), letters) for n, tree in values.items() for x, to in limits.items()}
    told = (*_title(subject, chosen), *made, *_limits(subject, at, limits))
    document = Document(tuple(lettered(block, letters) for block in told), letters)
    return Answers(values, at, letters, document, checked)


@dataclass(frozen=True)
class _System:
    """Balances and rows that together give ``gives``."""

    stated: tuple[Stated, ...]
    rows: tuple[Row, ...]
    gives: tuple[Sym, ...]

    @property
    def linear(self) -> list[Linear]:
        """All of them in what is unknown."""
        return [*(each.balance.linear for each in self.stated), *(row.linear for row in self.rows)]


def _systems(subject: Subject, chosen: Given, names: Sequence[str]) -> list[_System]:
    """Of each thing wanted the smallest set; where there is none, all balances of the coordinates first."""
    states = nearby(subject.source, chosen.generic(subject))
    made: list[_System] = []
    for name in names:
        wanted = _letter(subject, name)
        if any(wanted in system.gives for system in made):
            continue
        if wanted.dots and _is_prescribed(states[0], wanted):
            made.append(_closed(subject, [], wanted))
            continue
        least = smallest_set(name, states, subject.points)
        asked = [e.question for e in least.equations]
        if not asked or None in asked:
            made.append(_of_all(subject, states, wanted))
            continue
        try:
            made.append(_closed(subject, _in_letters(subject, least.equations), wanted))
        except TooLarge:  # what drops out at these numbers does not in letters
            made.append(_of_all(subject, states, wanted))
    return made


def _is_prescribed(free: FreeBodies, wanted: Sym) -> bool:
    """Whether motions and loops alone give an acceleration."""
    rows = np.array([list(row.coefficients.values()) for row in free.rows])
    if not len(rows):
        return False
    unit = np.array([name == wanted.name for name in free.rows[0].coefficients], dtype=float)
    return bool(np.linalg.norm(unit - np.linalg.pinv(rows) @ (rows @ unit)) < AGREES)


def _in_letters(subject: Subject, equations: Sequence[BalanceEquation]) -> list[Stated]:
    balances = subject.balances([each.question for each in equations if each.question])
    return [
        Stated(b, e.about, "about" if b.turns else "along", str(i), e.constructed)
        for i, (b, e) in enumerate(zip(balances, equations, strict=True), 1)
    ]


def _of_all(subject: Subject, states: Sequence[FreeBodies], wanted: Sym) -> _System:
    """The balances of the coordinates, and for a load that is not in them the fewest more, the motion being known from those."""
    stated = of_coordinates(subject)
    if not wanted.dots and not any(wanted in s.balance.linear.coefficients for s in stated):
        more = smallest_set(wanted.name, states, subject.points, known_motion=True).equations
        if any(each.question is None for each in more):
            raise TooLarge(f"{wanted.name}: no set of balances about named points gives it; ask for numbers")
        stated += _in_letters(subject, more)
    return _closed(subject, [replace(s, label=str(i)) for i, s in enumerate(stated, 1)], wanted)


def _closed(subject: Subject, stated: Sequence[Stated], wanted: Sym) -> _System:
    """With as many rows as it takes to have an equation for every unknown."""
    linear, rows = [s.balance.linear for s in stated], list[Row]()
    while True:
        unknown = {wanted, *(x for each in linear for x in each.coefficients)}
        more = next((row for row in subject.rows if row not in rows and unknown & row.linear.coefficients.keys()), None)
        if more is None or len(unknown) <= len(linear):
            break
        rows.append(more)
        linear.append(more.linear)
    if len(unknown) != len(linear) or not any(wanted in each.coefficients for each in linear):
        raise TooLarge(f"{wanted.name}: {len(linear)} equations leave {len(unknown)} unknowns; ask for numbers")
    return _System(tuple(stated), tuple(rows), tuple(unknown))


def _solved(subject: Subject, system: _System, chosen: Given, patience: float) -> dict[Sym, Tree]:
    letters = subject.letters
    unknowns = sorted(system.gives, key=lambda x: (x.dots == 0, letters.place(x.name)))
    matrix = [[chosen.put(each.coefficients.get(x, ZERO)) for x in unknowns] for each in system.linear]
    right = [chosen.put(negative(each.rest)) for each in system.linear]
    _require_short(matrix, right, chosen.measured)
    solution = solve(matrix, right, letters, patience=patience)
    return {x: with_positive_divisors(tree, subject.values) for x, tree in zip(unknowns, solution, strict=True)}


def _require_short(matrix: Sequence[Sequence[Tree]], right: Sequence[Tree], measured: bool) -> None:
    n, size = len(right), sum(operations(entry) for row in (*matrix, right) for entry in row)
    if n > (MOST_MEASURED if measured else MOST_EQUATIONS):
        raise TooLarge(f"it takes {n} equations together, too many for an answer in letters; ask for numbers")
    if size > (MOST_OPERATIONS_MEASURED if measured else MOST_OPERATIONS[n]):
        raise TooLarge(f"{n} equations with {size} operations are too long for an answer in letters; ask for numbers")


def with_positive_divisors(tree: Tree, values: Mapping[Sym, float]) -> Tree:
    """A fraction whose divisors are positive at given values of the letters."""
    if isinstance(tree, Add):
        return Add(tuple(with_positive_divisors(term, values) for term in tree.terms))
    if not isinstance(tree, Mul):
        return tree
    below = [f for f in tree.factors if isinstance(f, Pow) and f.exponent == -1 and isinstance(f.base, Add)]
    turned = [f for f in below if evaluate(f.base, values) < 0]
    made = mul(*(power(negative(f.base), -1) if f in turned else f for f in tree.factors))
    return mul(MINUS_ONE, made) if len(turned) % 2 else made


def _asked(rows: Sequence[Row]) -> list[Block]:
    names = joined(list(dict.fromkeys(row.name for row in rows))) if rows else ""
    return [Equation(row.acceleration, ZERO, f"With {names}" if i == 0 else "") for i, row in enumerate(rows)]


def _shown(system: _System, solution: Mapping[Sym, Tree]) -> list[Block]:
    name = "So" if len(solution) > 1 or len(system.linear) > 1 else "It gives"
    return [Equation(x, shown(tree), name if i == 0 else "") for i, (x, tree) in enumerate(solution.items())]


def _letter(subject: Subject, name: str) -> Sym:
    """The letter of something wanted."""
    plain = name.removeprefix("accel(").removesuffix(")")
    if plain in (c["name"] for c in subject.coordinates):
        return Sym(plain, 2)
    loads = [load for load in subject.free.loads if load.unknown and plain in (load.symbol, load.name)]
    exact = [load for load in loads if load.symbol == plain] or loads
    if len(exact) != 1:
        many = [load.symbol for load in loads] or [x.symbol for x in subject.free.loads if x.unknown]
        raise KeyError(f"{name!r} is no coordinate and no single unknown load; there are {', '.join(many)}")
    return Sym(exact[0].symbol)


def _check(subject: Subject, chosen: Given, values: Mapping[Sym, Tree]) -> int:
    """Holds the answers against numbers at the state and at others; says at how many."""
    rng, compared = np.random.default_rng(_SEED), 0
    for state in [subject.state, *(chosen.near(subject, rng) for _ in range(_OTHERS))]:
        there = state and _like(subject, Subject(subject.source, state, subject.at_rest))
        if not there:
            continue
        numbers = there.values
        for x, tree in values.items():
            found, true = float(evaluate(tree, numbers, there.tables)), numbers[x]
            if abs(found - true) > AGREES * max(abs(true), _scale(there, x)):
                raise ArithmeticError(f"the answer for {x.name} is {found:g} where the numbers are {true:g}; take the numbers")
        compared += 1
    return compared


def _like(subject: Subject, there: Subject) -> Subject | None:
    """Another state of a subject, if the same loads act there."""
    from freebody import _core

    try:
        same = [x.symbol for x in there.free.loads] == [x.symbol for x in subject.free.loads]
    except _core.MotionError:  # what touches here would be pressed in
        return None
    return there if same else None


def _scale(there: Subject, x: Sym) -> float:
    """The largest of its kind, or among the terms that balance where all of a kind vanish."""
    free, state = there.free, there.state
    values = free.accelerations.values() if x.dots else [load.value for load in free.loads if load.unknown]
    sizes = Instant(there.source.core, state, about=there.source.about).sizes
    return max(sizes[1 if x.dots else 0], *(abs(v) for v in values if np.isfinite(v)))


def _target(to: Any) -> float | Fraction:
    return float(to) if str(to).lstrip("-") == "inf" else Fraction(str(to))


def _title(subject: Subject, chosen: Given) -> list[Block]:
    said = ["all rates are 0"] * subject.at_rest + chosen.said()
    made: list[Block] = [Heading(f"{subject.source.name}: answers in letters", 1)]
    if chosen.measured:
        made.append(
            Paragraph("In letters alone this would fill pages: lengths, angles and plain numbers are those of the model, in SI.")
        )
    return made + ([Paragraph(f"At the instant at which {', '.join(said)}.")] if said else [])


def _limits(subject: Subject, found: Mapping[tuple[str, str], Tree], limits: Mapping[str, Any]) -> list[Block]:
    made: list[Block] = [Heading("Limits")] if found else []
    for (name, letter), tree in found.items():
        to = "∞" if str(limits[letter]) == "inf" else str(limits[letter])
        made.append(Equation(_letter(subject, name), shown(tree), [Sym(letter), f" → {to}"]))
    return made
