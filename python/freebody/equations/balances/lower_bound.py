"""How few unknowns balances can do with, whatever the motions: linear algebra that no choice of points is in.

All balances of a group without some unknowns are its rigid motions in which these do no work, a linear space. What the spaces
of all groups give together is a rank, so that what it is short of is short of it for every point and every direction.

Such a space is spanned by motions in which two do no work each: two of the unknowns that are to be gone, or one or none of them and
some of three motions' worth of arbitrary loads. So the rows of all pairs are found once, and each set of unknowns takes those it may.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import combinations, islice

import numpy as np

from freebody.core import Array
from freebody.equations.balances.system import Group, Problem
from freebody.solve.perturbed_states import DEPENDENT

MOST = 100_000
"""Sets of unknowns kept in balances beyond which the smallest is not looked for."""
_AT_ONCE = 1000
"""Sets that are tried at once."""
_SEED = 7


def fewest(given: Problem, groups: Sequence[Group], wanted: Sequence[int], most: int) -> int:
    """How many unknowns beside the ``wanted`` (places) stay at least in sets of independent balances of some groups, as many as
    there are unknowns in them: fewer were all tried, and do not do. At most ``most`` + 1."""
    rest = [i for i in range(len(given.unknowns)) if i not in wanted]
    columns = _generic(given)
    rows = np.concatenate([_rows(columns[:, list(group)].sum(axis=1), rest) for group in groups] or [np.zeros((0, len(columns)))])
    held = np.abs(rows[:, rest]) > DEPENDENT
    tried = 0
    for number in range(most + 1):
        tried += math.comb(len(rest), number)
        if tried > MOST or any(_rank(rows[within]) >= len(wanted) + number for within in _within(held, len(wanted), number)):
            return number
    return most + 1


def without_reactions(given: Problem, wanted: Sequence[int]) -> int:
    """How many independent equations hold only ``wanted`` unknowns where all bodies may be moved in any way: virtual power."""
    rest = [i for i in range(len(given.unknowns)) if i not in wanted]
    columns = _generic(given).reshape(len(given.unknowns), -1)
    _, sizes, turn = np.linalg.svd(columns[rest]) if rest else (None, np.zeros(0), np.eye(columns.shape[1]))
    return _rank(columns[list(wanted)] @ turn[(sizes > DEPENDENT).sum() :].T) if wanted else 0


def _generic(given: Problem) -> Array:
    """What each unknown does, of size 1, where nothing drops out by chance."""
    columns = given.systems[-1].columns
    sizes = np.linalg.norm(columns, axis=(1, 2), keepdims=True)
    return columns / np.where(sizes > 0, sizes, 1.0)


def _rows(columns: Array, rest: Sequence[int]) -> Array:
    """The equations (n, nu) of a group on which its unknowns have ``columns`` (nu, 3), one for every two that are to be gone."""
    own = columns[rest]
    sizes = np.linalg.norm(own, axis=1)
    units = own[sizes > DEPENDENT] / sizes[sizes > DEPENDENT, None]
    units = np.concatenate([units, np.random.default_rng(_SEED).normal(size=(3, 3))])
    first, second = np.triu_indices(len(units), 1)
    motions = np.cross(units[first], units[second])
    length = np.linalg.norm(motions, axis=1)
    made = (motions[length > DEPENDENT] / length[length > DEPENDENT, None]) @ columns.T
    size = np.linalg.norm(made, axis=1)
    return made[size > DEPENDENT] / size[size > DEPENDENT, None]


def _within(held: Array, wanted: int, number: int) -> Iterator[Array]:
    """For every set of so many unknowns the equations (places) that hold no others, where these may be enough; ``held`` (n, nu)."""
    unknowns = held.shape[1]
    sets = combinations(range(unknowns), number)
    few = np.flatnonzero(held.sum(axis=1) <= number)
    while chunk := list(islice(sets, _AT_ONCE)):
        kept = np.zeros((len(chunk), unknowns))
        np.put_along_axis(kept, np.array(chunk, dtype=int).reshape(len(chunk), number), 1.0, axis=1)
        free = (1.0 - kept) @ held[few].T.astype(float) == 0
        for place in np.flatnonzero(free.sum(axis=1) >= wanted + number):
            yield few[free[place]]


def _rank(rows: Array) -> int:
    return int(np.linalg.matrix_rank(rows, tol=DEPENDENT)) if rows.size else 0
