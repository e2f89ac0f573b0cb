"""Which instants tell a motion best: those between which straight lines follow what acts."""

from __future__ import annotations

from heapq import heapify, heappop, heappush
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import Array

if TYPE_CHECKING:
    from freebody.run.simulation import Run

_EVEN, _SWITCHES = 60, 60
"""Instants that are taken in any case: evenly spread ones, and switches, of very many a share of equal steps."""
_FOLLOWED = 1e-3
"""Of the largest of its kind, by which a line may miss: less than a screen shows."""


def telling_instants(run: Run, most: int) -> Array:
    """At most about so many times of a run: of the start, the end, switches (just before and just after), the largest loads, some
    evenly spread; and where lines from one to the next are farthest from reactions and accelerations."""
    closely = run.closely
    jumps = run.jumps[run.jumps < run.edges[-1]]
    jumps = jumps[:: len(jumps) // _SWITCHES + 1]
    peaks = [t for peak in run.peaks for t in (peak.t, peak.t_couple) if t is not None]
    kept = np.concatenate([np.linspace(*run.edges[[0, -1]], min(_EVEN, most)), jumps, np.nextafter(jumps, -np.inf), peaks])
    room = max(most - len(kept), 0)
    return np.unique(np.concatenate([kept, farthest(closely.t, _loads(closely), kept, room)]))


def _loads(run: Run) -> Array:
    """Reactions and accelerations (nt, k), each beside the largest of its kind, which is 1."""
    reactions = np.array([[r.Fx, r.Fy, r.M] for r in run.reactions.values() if r.determinate]).reshape(-1, 3, len(run.t))
    units = np.array([column.unit for column in run.columns if column.kind == "acceleration"])
    kinds = [reactions[:, :2].reshape(-1, len(run.t)), reactions[:, 2]]
    kinds += [run.accelerations.T[units == unit] for unit in np.unique(units)]
    return np.vstack([np.nan_to_num(kind) / (np.nanmax(np.abs(kind), initial=0.0) or 1.0) for kind in kinds]).T


def farthest(t: Array, y: Array, kept: Array, room: int) -> Array:
    """As many of the times t (nt,) as there is room for, beside those that are kept, such that lines between them follow y (nt, k):
    always the one at which they are farthest from it."""
    ends = np.unique(np.searchsorted(t, kept).clip(0, len(t) - 1))

    def miss(first: int, last: int) -> tuple[float, int, int, int]:
        part = ((t[first : last + 1] - t[first]) / (t[last] - t[first]))[:, None]
        apart = np.abs(y[first : last + 1] - y[first] - part * (y[last] - y[first])).max(axis=1, initial=0.0)
        place = int(apart.argmax())
        return -float(apart[place]), first, first + place, last

    open_spans = [miss(first, last) for first, last in pairwise(ends.tolist())]
    heapify(open_spans)
    found = []
    while len(found) < room and open_spans and open_spans[0][0] < -_FOLLOWED:
        _, first, place, last = heappop(open_spans)
        found.append(place)
        for span in ((first, place), (place, last)):
            heappush(open_spans, miss(*span))
    return t[np.array(found, int)]
