"""Rows of values of which others are made."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

import numpy as np

from freebody.symbolic.evaluate import Array

_SAME = 1e-8  # relative: below it two rows are one but for a factor
_LIKELY = 60  # rows of which pairs with all others are tried


def proportional(rows: Array, wanted: Array, same: float = _SAME) -> list[int]:
    """Rows that are ``wanted`` but for a factor."""
    with np.errstate(all="ignore"):
        dots, sizes = rows @ wanted, np.sum(rows**2, axis=1)
        off = np.abs(rows * (dots / sizes)[:, None] - wanted).max(axis=1)
    return np.flatnonzero(off <= same * np.abs(wanted).max()).tolist()


def spanning(rows: Array, wanted: Array, within: Callable[[Iterable[int]], Iterator[int]]) -> Iterator[tuple[int, int]]:
    """Pairs of rows of which ``wanted`` is made, the first among those most like it."""
    sizes = np.linalg.norm(rows, axis=1)
    order = np.argsort(-np.abs(rows @ wanted) / sizes)[:_LIKELY]
    for i in within(order.tolist()):
        along = rows[i] / sizes[i]
        rest, others = wanted - (wanted @ along) * along, rows - np.outer(rows @ along, along)
        others[np.linalg.norm(others, axis=1) < 1e-6 * sizes] = np.nan
        yield from ((i, j) for j in proportional(others, rest) if i < j or j not in order)
