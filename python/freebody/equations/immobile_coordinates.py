"""What loops, motions and contacts hold still: coordinates that cannot move, and where they are, whatever the lengths are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from freebody.core import FreeBodies
from freebody.equations.dependent_coordinates import followed, solved, vanishing
from freebody.equations.derivation.data import Row, SymbolicState
from freebody.equations.linearization import is_natural, place_of
from freebody.equations.substitutions import Substitutions
from freebody.symbolic.tree import Sym, Tree, is_zero, symbols

_HELD = 1e-7
"""Part of a unit departure that rows leave free below which they hold it."""


def held_still(subject: SymbolicState, chosen: Substitutions, states: Sequence[FreeBodies]) -> Substitutions:
    """The coordinates that nothing lets move, at all ``states``, as ``still``, and their places where these do not depend on any
    letter but those ``chosen``; and what ``follow`` from others."""
    names = subject.names
    fixed = [i for i, row in enumerate(subject.rows) if _is_fixed(row, Substitutions({}, still=frozenset(names)))]
    free = [np.array([[state.rows[i].coefficients[name] for name in names] for i in fixed]) for state in states]
    still = frozenset(name for i, name in enumerate(names) if fixed and all(holds(rows, i) for rows in free))
    held = Substitutions({}, still=still)
    natural = {
        name: place for name, place in place_of(subject).items() if is_natural(place) and name in still - chosen.trees.keys()
    }
    moving = [name for name in names if name not in still and name not in chosen.trees]
    closed = [held.put(chosen.put(value)) for i in fixed if (value := subject.rows[i].value) is not None]
    places = Substitutions(_closing(closed, natural, moving, subject.values), still=still)
    rows = [row for row in subject.rows if row.kind != "motion"]
    return replace(places, follow=followed(rows, lambda tree: places.put(chosen.put(tree)), moving, subject.values))


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
    """Of these places those with which everything that they are in vanishes, whatever the letters are, or tells what is moving."""
    there = Substitutions(places)
    values = [there.put(value) for value in closed]
    met = vanishing(values, solved(values, moving, 0, numbers))
    open_by = {x.name for value, vanishes in zip(closed, met, strict=True) if not vanishes for x in symbols(value)}
    if not open_by & places.keys():
        return places
    return _closing(closed, {n: place for n, place in places.items() if n not in open_by}, moving, numbers)
