"""What loops, motions and contacts hold still: coordinates that cannot move, and where they are, whatever the lengths are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from freebody.equations.departures import is_natural, place_of
from freebody.equations.derivation.told import Row, Subject
from freebody.equations.given import Given
from freebody.equations.tree import Sym, Tree, is_zero, symbols
from freebody.free_body import FreeBodies

_HELD = 1e-7
"""Part of a unit departure that rows leave free below which they hold it."""


def held_still(subject: Subject, chosen: Given, states: Sequence[FreeBodies]) -> Given:
    """The coordinates that nothing lets move, at all ``states``, as ``still``, and their places where these do not depend on any
    letter but those ``chosen``."""
    names = [c["name"] for c in subject.coordinates]
    fixed = [i for i, row in enumerate(subject.rows) if _is_fixed(row, Given({}, still=frozenset(names)))]
    free = [np.array([[state.rows[i].coefficients[name] for name in names] for i in fixed]) for state in states]
    still = frozenset(name for i, name in enumerate(names) if fixed and all(holds(rows, i) for rows in free))
    natural = {
        name: place for name, place in place_of(subject).items() if is_natural(place) and name in still - chosen.trees.keys()
    }
    closed = [chosen.put(value) for i in fixed if (value := subject.rows[i].value) is not None]
    return _placed(Given({}, still=still), closed, natural)


def holds(rows: np.ndarray, place: int) -> bool:
    """Whether rows, linear in some unknowns, determine the one at a place."""
    unit = np.eye(rows.shape[1])[place]
    return bool(np.linalg.norm(unit - np.linalg.pinv(rows) @ (rows @ unit)) < _HELD)


def _is_fixed(row: Row, rest: Given) -> bool:
    """Whether it asks for rest: it is met where all rates and accelerations are 0. A motion may ask for accelerations alone."""
    asked = [row.acceleration, *([] if row.rate is None else [row.rate])]
    return not (row.rate is None and row.kind == "motion") and all(is_zero(rest.put(tree)) for tree in asked)


def _placed(held: Given, closed: Sequence[Tree], natural: Mapping[str, Tree]) -> Given:
    """With the places that follow one after the other from what vanishes, each by an equation in that coordinate alone."""
    for value in map(held.put, closed):
        moving = [name for name in held.still if Sym(name) in symbols(value)]
        if len(moving) == 1 and moving[0] in natural:
            more = replace(held, trees={**held.trees, moving[0]: natural[moving[0]]})
            if is_zero(more.put(value)):
                return _placed(more, closed, natural)
    return held
