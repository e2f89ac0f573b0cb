"""Symbolic answers: accelerations and reactions of one instant, from the fewest balances, solved and simplified."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import MotionError, State
from freebody.document.blocks import Block, Equation, Heading, Paragraph, Side, Words, equations, listed
from freebody.document.document import Document
from freebody.equations.balances.system import NotUnknown
from freebody.equations.dependent_coordinates import immobile_coordinates
from freebody.equations.derivation.preamble import unloaded
from freebody.equations.derivation.sentences import joined, lettered
from freebody.equations.linearization import is_natural, place_of
from freebody.equations.solve import TooLarge, Unconfirmed, limit, solve
from freebody.equations.substitutions import Substitutions, substitutions_of
from freebody.equations.sufficient_equations import Search, SufficientSet
from freebody.equations.velocity_ratios import blocks as of_ratios
from freebody.equations.velocity_ratios import driven, ratios
from freebody.solve.instant import NOTHING, Instant
from freebody.solve.perturbed_states import nearby, others
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.decimals import shown
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.presentation import PATIENCE, presented
from freebody.symbolic.printers.text import text
from freebody.symbolic.radicals import distances, with_plain_roots
from freebody.symbolic.to_sympy import to_sympy
from freebody.symbolic.tree import MINUS_ONE, ZERO, Add, Mul, Pow, Sym, Tree, mul, negative, operations, power, symbols

if TYPE_CHECKING:
    from freebody.model.builder import Builder

MOST_EQUATIONS = 4
"""More equations together are not solved symbolically."""
MOST_OPERATIONS = {1: 1000, 2: 200, 3: 150, 4: 150}
"""Operations in all coefficients, by the number of equations, above which the answer would fill pages."""
MOST_MEASURED = 8
"""More where lengths and angles are numbers."""
MOST_OPERATIONS_MEASURED = 250
"""The same there."""
AGREES = 1e-7
"""Of what gaps and their rates are measured by, below which what is closed stays so; part of the largest rate by which those of an
impact agree."""
_SAME = 1e-9
"""Difference of an answer from the numbers, relative to the largest acceleration or load of its kind, beyond which it is refused."""
_INERTIAS = ("kg", "kg*m^2")
_BRIEF = 1.0
"""Seconds for the shortest form of what is said beside an answer."""
_OTHERS = 3
_SEED = 5


@dataclass(frozen=True)
class Answers(Document):
    """What was ``wanted``, by name the symbols, as trees, ``values[name]``, SI; ``limits[name, symbol]`` where limits were asked for; ``named`` symbols of theirs,
    each by those before; ``print`` shows the
    equations that give it. ``checked``: at how many states it was held against the numbers."""

    values: Mapping[str, Tree] = field(kw_only=True)
    wanted: Mapping[str, Sym] = field(kw_only=True)
    named: Mapping[Sym, Tree] = field(kw_only=True)
    limits: Mapping[tuple[str, str], Tree] = field(kw_only=True)
    checked: int = field(kw_only=True)

    def __getitem__(self, name: str) -> Tree:
        return self.values[name]

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
    **moment: Any,
) -> Answers:
    """Accelerations and reactions symbolically, near the start of the model or another ``moment`` (``at``, ``before``, ``after``; see
    ``Mechanism.moment``).

    ``wanted``: coordinates (their accelerations), components of reactions (``pivot.Fx``), motions; all accelerations by default.
    ``at_rest``: all rates are 0, as just after release. ``set``: coordinates and parameters as quantities, ``"45 deg"``, or
    parameters as other parameters, ``{"m2": "m1"}``. ``limits``: symbols and what they go to, ``{"m2": "inf", "m1": 0}``.
    What switches (contacts, arms of laws) is as it is at that start. Every answer is held against numbers at the start and at
    states near by. Raises ``TooLarge``, ``Unconfirmed``, ``Singular``, ``KeyError`` for what is not unknown, ``Indeterminate``."""
    chosen = substitutions_of(mechanism, set or {}, limits or {})
    state = chosen.start(mechanism, at_rest, initial, **moment)
    subject = SymbolicState(mechanism.source(), state, at_rest)
    if at_rest and np.any(np.abs(state.u) > AGREES * subject.usual_rate * subject.free.units(subject.coordinates)):
        raise ValueError(
            "it is not at rest: a motion prescribes rates that are not 0, or it has begun to move; leave at_rest out"
        )
    _require_limits(subject, chosen, limits or {})
    names = list(wanted) if wanted else subject.names
    for given_more, named in _ways(subject, chosen, limits or {}):
        try:
            return _answers(subject, given_more, names, limits or {}, patience, named)
        except (TooLarge, Unconfirmed) as error:  # no short answer, or none that the numbers bear out
            refusal = error
    raise refusal


def _require_limits(subject: SymbolicState, chosen: Substitutions, limits: Mapping[str, Any]) -> None:
    """Raises ``ValueError`` for a limit of what is no symbol or set, or to what is negative."""
    known = subject.nomenclature.of_kind("parameter", "constant", "coordinate", "time")
    for name, to in limits.items():
        if name not in known:
            raise ValueError(f"{name!r} has no limit, as it is no symbol; there are {', '.join(known)}")
        if name in chosen.trees:
            raise ValueError(f"{name} is set, so it has no limit; leave one of the two out")
        try:
            below = _target(to) < 0
        except ValueError:
            raise ValueError(f"{name} cannot go to {to!r}; give 0, a positive number in SI, or inf") from None
        if below:
            raise ValueError(f"{name} cannot go to {to}: symbols are taken to be positive; give 0, a positive number, or inf")


def _ways(subject: SymbolicState, chosen: Substitutions, limits: Collection[str]) -> Iterator[tuple[Substitutions, bool]]:
    """What is set; where that is too long, in loops with ratios of rates that are named, or at the places of the start that are so
    whatever the lengths are, first where strings and contacts are written that way; with all lengths and angles as numbers; with
    masses as well."""
    yield chosen, False
    settled = {*chosen.trees, *chosen.defined, *limits}
    natural = {n: place for n, place in place_of(subject).items() if is_natural(place) and n not in settled}
    ratios_too = [(chosen, True)] if subject.rows and not limits else []
    at_start = [(replace(chosen, trees=natural | dict(chosen.trees), at_start=frozenset(natural)), False)] if natural else []
    yield from at_start + ratios_too if subject.source.metadata["limits"] else ratios_too + at_start
    lengths = [n for n in subject.nomenclature.geometric() if n not in settled]
    if lengths:
        measured = chosen.and_numbers(subject.with_numbers(lengths).numbers or {})
        yield measured, False
        masses = {n: x["value"] for n, x in subject.table.items() if x["unit"] in _INERTIAS and n not in settled}
        yield measured.and_numbers(masses), False


def _answers(
    subject: SymbolicState,
    chosen: Substitutions,
    names: Sequence[str],
    limits: Mapping[str, Any],
    patience: float,
    with_ratios: bool,
) -> Answers:
    nomenclature, wanted = subject.nomenclature, {name: _symbol(subject, name) for name in names}
    generic, rng = chosen.generic(subject), np.random.default_rng(_SEED)
    states = nearby(subject.source, generic, [chosen.parameters_near(subject, generic, rng) for _ in range(_OTHERS)])
    held = immobile_coordinates(subject, chosen, states)
    made = [*_title(subject, chosen), *_held(subject, held)]
    chosen = replace(chosen, trees={**chosen.trees, **held.trees}, immobile=held.immobile, follow=held.follow)
    found: dict[Sym, Tree] = {x: ZERO for x in wanted.values() if held.is_immobile(x)}
    ratio = None
    if with_ratios:  # by what is driven, else by the first acceleration that is wanted, or by the first coordinate
        first = driven(subject) or next((x.name for x in wanted.values() if x.dots), subject.names[0])
        places = replace(chosen, follow={x: tree for x, tree in chosen.follow.items() if not x.dots})
        ratio = ratios(subject, places.put, first)
        made += of_ratios(ratio, [x.name for x in wanted.values() if x.dots], shown)
        found |= {Sym(name, 2): Sym(name, 2) for name in ratio.rates} | ratio.driving
        made += [Equation(x, shown(tree), "So") for x, tree in ratio.driving.items() if x in wanted.values()]
    labels = dict[str, str]()
    for x in wanted.values():
        if x not in found:
            system = Search(subject, chosen, replace(held, follow={}), states).enough(x, found, labels)
            solution = _solved(subject, system, chosen, patience)
            made += _stated(subject, system, chosen, labels, solution)
            found |= solution
    values = {name: ratio.acceleration(x.name) if ratio and x.dots else found[x] for name, x in wanted.items()}
    named = ratio.definitions() if ratio else {}
    checked = _check(subject, chosen, {x: values[name] for name, x in wanted.items()}, named)
    at = {(n, x): limit(tree, x, _target(to), nomenclature) for n, tree in values.items() for x, to in limits.items()}
    made += [Heading("Limits")] if at else []
    for symbol, to in limits.items():
        goes = [Sym(symbol), f" → {'∞' if str(to) == 'inf' else to}"]
        made += equations(((x, shown(at[n, symbol])) for n, x in wanted.items()), goes)
    stated = tuple(lettered(block, nomenclature) for block in made)
    return Answers(stated, nomenclature, values=values, wanted=wanted, named=named, limits=at, checked=checked)


def _title(subject: SymbolicState, chosen: Substitutions) -> list[Block]:
    made: list[Block] = [Heading(subject.titled("symbolic answers"), 1)]
    made += unloaded(subject)
    filled = "The fully symbolic form would fill pages: the numbers that stand here are those of the model, in SI."
    made += [Paragraph(filled)] * chosen.measured
    if chosen.at_start:
        made.append(Paragraph("The symbolic form for every configuration would fill pages: this one holds at the start."))
    places = [f"{text(Sym(name))} = {text(shown(tree))}" for name, tree in chosen.trees.items()]
    if said := ["all rates are 0"] * subject.at_rest + places:
        made.append(Paragraph(f"At the instant at which {', '.join(said)}."))
    return made


def _held(subject: SymbolicState, held: Substitutions) -> list[Block]:
    """What cannot move, and where it is."""
    immobile = [Sym(name) for name in subject.names if held.is_immobile(Sym(name, 1))]
    if not immobile:
        return []
    said: list[str | Side] = ["Nothing can move: " if len(immobile) == len(subject.names) else "What cannot move: "]
    said += [*listed(immobile), " stand still" if len(immobile) > 1 else " stands still"]
    for i, (name, place) in enumerate(held.trees.items()):
        said += [", " if i else ", with ", Sym(name), " = ", place]
    return [Paragraph([*said, "."])]


def _stated(
    subject: SymbolicState, system: SufficientSet, chosen: Substitutions, labels: dict[str, str], solution: Mapping[Sym, Tree]
) -> list[Block]:
    """The balances that were not stated before, numbered on; what is closed; what symbols are by others, as parameters that are defined
    so and what follows from what is closed; and the solution."""
    made: list[Block] = []
    for stated in system.stated:
        if stated.title not in labels:
            labels[stated.title] = str(len(labels) + 1)
            made += replace(stated, label=labels[stated.title]).blocks(subject)
    names = list(dict.fromkeys(row.name for row in system.rows))
    made += equations(((row.acceleration, ZERO) for row in system.rows), f"With {joined(names)}" if names else "")
    known = {Sym(name): tree for name, tree in chosen.defined.items()} | dict(chosen.follow)
    there = symbols(*(each.balance.residual for each in system.stated), *(row.acceleration for row in system.rows))
    others = sorted(there & known.keys(), key=lambda x: (x.dots, x.name))
    made += equations(((x, shown(presented(chosen.put(known[x]), patience=_BRIEF))) for x in others), "Where")
    name: Words = "So" if len(solution) > 1 or len(system.linear) > 1 else "It gives"
    if system.known:
        name = ["With ", *listed(system.known), " as above"]
    return made + equations(((x, shown(tree)) for x, tree in solution.items()), name)


def _solved(subject: SymbolicState, system: SufficientSet, chosen: Substitutions, patience: float) -> dict[Sym, Tree]:
    nomenclature, measured, n = subject.nomenclature, chosen.measured, len(system.linear)
    unknowns = sorted(system.unknowns, key=lambda x: (x.dots == 0, nomenclature.place(x.name)))
    rows = [[*(each.coefficients.get(x, ZERO) for x in unknowns), negative(each.rest)] for each in system.linear]
    if n > (MOST_MEASURED if measured else MOST_EQUATIONS):
        raise TooLarge(f"it takes {n} equations together, too many for a symbolic answer; ask for numbers")
    size = sum(operations(entry) for row in rows for entry in row)
    if size > (MOST_OPERATIONS_MEASURED if measured else MOST_OPERATIONS[n]):
        raise TooLarge(f"{n} equations with {size} operations are too long for a symbolic answer; ask for numbers")
    if not measured:
        known = distances(chosen.put(row.value) for row in subject.rows if row.value is not None and row.kind != "motion")
        rows = [[with_plain_roots(entry, known, subject.values) for entry in row] for row in rows]
    found = solve([row[:-1] for row in rows], [row[-1] for row in rows], nomenclature, patience=patience)
    solution = zip(unknowns, found, strict=True)
    return {x: with_positive_divisors(tree, subject.values) for x, tree in solution if x in system.gives}


def with_positive_divisors(tree: Tree, values: Mapping[Sym, float]) -> Tree:
    """A fraction whose divisors are positive at given values of the symbols."""
    if isinstance(tree, Add):
        return Add(tuple(with_positive_divisors(term, values) for term in tree.terms))
    if not isinstance(tree, Mul):
        return tree
    below = [f for f in tree.factors if isinstance(f, Pow) and f.exponent == -1 and isinstance(f.base, Add)]
    turned = [f for f in below if evaluate(f.base, values) < 0]
    made = mul(*(power(negative(f.base), -1) if f in turned else f for f in tree.factors))
    return mul(MINUS_ONE, made) if len(turned) % 2 else made


def _symbol(subject: SymbolicState, name: str) -> Sym:
    """The symbol of something wanted."""
    plain = name.removeprefix("accel(").removesuffix(")")
    if plain in subject.names:
        return Sym(plain, 2)
    loads = [load for load in subject.free.loads if load.unknown and plain in (load.symbol, load.name)]
    exact = [load for load in loads if load.symbol == plain] or loads
    if len(exact) != 1:
        every = subject.names + [x.symbol for x in subject.free.loads if x.unknown]
        many = [load.symbol for load in loads] or every
        raise NotUnknown(f"{name!r} is no coordinate and no single unknown load; there are {', '.join(many)}")
    return Sym(exact[0].symbol)


def _check(subject: SymbolicState, chosen: Substitutions, values: Mapping[Sym, Tree], named: Mapping[Sym, Tree]) -> int:
    """Holds the answers against numbers at the state and at others; says at how many."""
    rng, compared = np.random.default_rng(_SEED), 0
    for state in [subject.state, *(chosen.near(subject, rng) for _ in range(_OTHERS)), *_closed(subject, chosen)]:
        there = None if state is None else SymbolicState(subject.source, state, subject.at_rest)
        if there is None or not _is_like(subject, there):
            continue
        numbers = dict(there.values)
        for x, tree in named.items():
            numbers[x] = float(evaluate(tree, numbers, there.tables))
        for x, tree in values.items():
            found, true = float(evaluate(tree, numbers, there.tables)), there.values[x]
            # relative to the largest of its kind, or among the terms that balance where all of a kind vanish
            kind = there.free.accelerations.values() if x.dots else [load.value for load in there.free.loads if load.unknown]
            scale = max(
                NOTHING, Instant(there.source, state).sizes[1 if x.dots else 0], *(abs(v) for v in kind if np.isfinite(v))
            )
            if not abs(found - true) <= _SAME * max(abs(true), scale):
                raise Unconfirmed(f"the answer for {x.name} is {found:g} where the numbers are {true:g}; take the numbers")
        compared += 1
    if not compared:
        raise Unconfirmed("the answer cannot be held against numbers, not even at the start; take the numbers")
    return compared


def _closed(subject: SymbolicState, chosen: Substitutions) -> list[State]:
    """States near by at which contacts and strings stay closed; none where a coordinate is set that could move."""
    if not subject.source.metadata["limits"] or set(subject.names) & chosen.trees.keys() - chosen.immobile:
        return []
    found = others(subject.source, subject.state)
    places = {tuple(state.q): replace(state, u=np.zeros_like(state.u)) for state in found}
    return list(places.values() if subject.at_rest else found)[:_OTHERS]


def _is_like(subject: SymbolicState, there: SymbolicState) -> bool:
    """Whether the same loads act in another state of a subject, those that follow from others in the same sense, and what is closed
    is so."""

    def acting(each: SymbolicState) -> list[tuple[str, float]]:
        return [(load.symbol, float(np.sign(load.follows[1])) if load.follows else 0.0) for load in each.free.loads]

    try:
        for row, size in zip(there.rows, there.free.row_sizes(there.coordinates), strict=True):
            for tree, most in ((row.value, size), (row.rate, size * there.usual_rate)):
                if tree is not None and not abs(evaluate(tree, there.values, there.tables)) <= AGREES * most:
                    return False
        return acting(there) == acting(subject)
    except MotionError:  # what touches here would be pressed in
        return False


def _target(to: Any) -> float | Fraction:
    return float(to) if str(to).lstrip("-") == "inf" else Fraction(str(to))
