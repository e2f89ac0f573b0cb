"""How few unknowns balances can do with, whatever the motions: linear algebra that no choice of points is in.

All balances of a group without some unknowns are its rigid motions in which these do no work, a linear space. What the spaces
of all groups give together is a rank, so that what it is short of is short of it for every point and every direction.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import combinations

import numpy as np

from freebody.balances.groups import Group
from freebody.balances.system import DEPENDENT, Problem
from freebody.results import Array

MOST = 100_000
"""Groups, times sets of unknowns kept in their balances, beyond which the smallest set is not looked for."""


def fewest(given: Problem, groups: Sequence[Group], wanted: Sequence[int], most: int) -> int:
    """How many unknowns beside the ``wanted`` (places) stay at least in sets of independent balances of some groups, as many as
    there are unknowns in them: fewer were all tried, and do not do. At most ``most`` + 1."""
    rest = [i for i in range(len(given.unknowns)) if i not in wanted]
    columns = _generic(given)
    sums = np.array([columns[:, list(group)].sum(axis=1) for group in groups])
    tried = 0
    for number in range(most + 1):
        tried += math.comb(len(rest), number) * len(groups)
        if tried > MOST or any(_rank(sums, wanted, more, rest) == len(wanted) + number for more in combinations(rest, number)):
            return number
    return most + 1


def without_reactions(given: Problem, wanted: Sequence[int]) -> int:
    """How many independent equations hold only ``wanted`` unknowns where all bodies may be moved in any way: virtual power."""
    rest = [i for i in range(len(given.unknowns)) if i not in wanted]
    columns = _generic(given)
    return _rank(columns.reshape(1, len(columns), -1), wanted, (), rest)


def _generic(given: Problem) -> Array:
    """What each unknown does, of size 1, where nothing drops out by chance."""
    columns = given.systems[-1].columns
    sizes = np.linalg.norm(columns, axis=(1, 2), keepdims=True)
    return columns / np.where(sizes > 0, sizes, 1.0)


def _rank(sums: Array, wanted: Sequence[int], more: Iterable[int], rest: Sequence[int]) -> int:
    """Of the equations in ``wanted`` and ``more``; ``sums`` (ng, nu, nd): what the unknowns do to the motions of each group."""
    kept = [*wanted, *more]
    gone = [i for i in rest if i not in more]
    if not kept:
        return 0
    rows = np.einsum("gmd,gkd->gmk", _still(sums[:, gone]), sums[:, kept]).reshape(-1, len(kept))
    return int(np.linalg.matrix_rank(rows, tol=DEPENDENT))


def _still(tables: Array) -> Array:
    """For each table (ng, nu, nd) the motions (ng, nd, nd) that none of its rows works in, and zeros."""
    _, sizes, turn = np.linalg.svd(np.pad(tables, ((0, 0), (0, max(0, tables.shape[2] - tables.shape[1])), (0, 0))))
    works = np.arange(turn.shape[1]) < (sizes > DEPENDENT).sum(axis=1)[:, None]
    return np.where(works[:, :, None], 0.0, turn)
