"""What loops, motions and contacts make of coordinates: some cannot move, others follow, y = R + d sin φ of a body that rolls."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace as replaced
from typing import Any

import numpy as np

from freebody.core import FreeBodies
from freebody.equations.linearization import is_natural, place_of
from freebody.equations.substitutions import Substitutions
from freebody.solve.symbolic_state import Row, SymbolicState
from freebody.symbolic.algebra import equal
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.presentation import PATIENCE, presented
from freebody.symbolic.to_sympy import from_sympy, sympy, to_sympy
from freebody.symbolic.tree import ZERO, Sym, Tree, is_zero, operations, replace, symbols

MOST_OPERATIONS = 120
"""In what is closed, above which nothing is sought that follows from it."""
_HELD = 1e-7
"""Part of a unit perturbation that rows leave free below which they hold it."""


def followed(
    rows: Sequence[Row], put: Callable[[Tree], Tree], free: Collection[str], values: Mapping[Sym, float]
) -> dict[Sym, Tree]:
    """Of the coordinates ``free`` to be written by others, those of which a row is linear whatever the rest is, and their rates;
    ``values`` are the numbers at which a factor by which is divided should be large."""
    places = solved([put(row.value) for row in rows if row.value is not None], free, 0, values)
    rates = solved([replace(put(row.rate), places) for row in rows if row.rate is not None], free, 1, values)
    short = {x: to_sympy(presented(tree, patience=PATIENCE / 5)) for x, tree in (places | rates).items()}
    plain = lambda angle: sympy.sin(angle) / sympy.cos(angle)  # tangents are in no balance and would not cancel there
    return {x: from_sympy(tree.replace(sympy.tan, plain)) for x, tree in short.items()}


def solved(given: Sequence[Tree], free: Collection[str], dots: int, values: Mapping[Sym, float]) -> dict[Sym, Tree]:
    """Symbols of coordinates, or of their rates, in which expressions that vanish are linear, by the others; one of each."""
    found: dict[Sym, Tree] = {}
    for value in given:
        rest = replace(value, found)
        if operations(rest) > MOST_OPERATIONS or (one := _one(to_sympy(rest), free, dots, values)) is None:
            continue
        symbol, tree = one
        found = {x: replace(known, {symbol: tree}) for x, known in found.items()} | {symbol: tree}
    return found


def _one(value: Any, free: Collection[str], dots: int, values: Mapping[Sym, float]) -> tuple[Sym, Tree] | None:
    """The symbol with the plainest factor that depends on no place and no rate, and what it is."""
    moving = {sympy.Symbol(name + "'" * n) for name in free for n in (0, 1)}
    asked = sorted(value.free_symbols & {sympy.Symbol(name + "'" * dots) for name in free}, key=str)
    factors = {x: value.diff(x) for x in asked}
    sizes = {x: abs(float(evaluate(from_sympy(factors[x]), values))) for x in asked if not factors[x].free_symbols & moving}
    if not sizes or max(sizes.values()) == 0:
        return None
    chosen = min((x for x in sizes if sizes[x] > 0), key=lambda x: (factors[x].count_ops(), -sizes[x]))
    made = sympy.cancel(sympy.together(-value.subs(chosen, 0) / factors[chosen]))
    return Sym(chosen.name.rstrip("'"), dots), from_sympy(made)


def immobile_coordinates(subject: SymbolicState, chosen: Substitutions, states: Sequence[FreeBodies]) -> Substitutions:
    """The coordinates that nothing lets move, at all ``states``, as ``immobile``, and their places where these do not depend on any
    symbol but those ``chosen``; and what ``follow`` from others."""
    names = subject.names
    fixed = [i for i, row in enumerate(subject.rows) if _is_fixed(row, Substitutions({}, immobile=frozenset(names)))]
    free = [np.array([[state.rows[i].coefficients[name] for name in names] for i in fixed]) for state in states]
    immobile = frozenset(name for i, name in enumerate(names) if fixed and all(holds(rows, i) for rows in free))
    held = Substitutions({}, immobile=immobile)
    natural = {
        name: place for name, place in place_of(subject).items() if is_natural(place) and name in immobile - chosen.trees.keys()
    }
    moving = [name for name in names if name not in immobile and name not in chosen.trees]
    closed = [held.put(chosen.put(value)) for i in fixed if (value := subject.rows[i].value) is not None]
    places = Substitutions(_closing(closed, natural, moving, subject.values), immobile=immobile)
    rows = [row for row in subject.rows if row.kind != "motion"]
    return replaced(places, follow=followed(rows, lambda tree: places.put(chosen.put(tree)), moving, subject.values))


def holds(rows: np.ndarray, place: int) -> bool:
    """Whether rows, linear in some unknowns, determine the one at a place."""
    unit = np.eye(rows.shape[1])[place]
    return bool(np.linalg.norm(unit - np.linalg.pinv(rows) @ (rows @ unit)) < _HELD)


def _is_fixed(row: Row, rest: Substitutions) -> bool:
    """Whether it asks for rest: it is met where all rates and accelerations are 0. A motion may ask for accelerations alone."""
    asked = [row.acceleration, *([] if row.rate is None else [row.rate])]
    return not (row.rate is None and row.kind == "motion") and all(is_zero(rest.put(tree)) for tree in asked)


def _closing(
    closed: Sequence[Tree], places: Mapping[str, Tree], moving: Sequence[str], numbers: Mapping[Sym, float]
) -> Mapping[str, Tree]:
    """Of these places those with which everything that they are in vanishes, whatever the symbols are, or tells what is moving."""
    there = Substitutions(places)
    values = [there.put(value) for value in closed]
    found = solved(values, moving, 0, numbers)
    unmet = [value for value, put in zip(closed, values, strict=True) if not equal(replace(put, found), ZERO)]
    open_by = {x.name for x in symbols(*unmet)}
    if not open_by & places.keys():
        return places
    return _closing(closed, {n: place for n, place in places.items() if n not in open_by}, moving, numbers)
