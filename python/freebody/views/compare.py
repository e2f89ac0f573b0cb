"""Two runs side by side."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import zip_longest
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import Array
from freebody.solve.rich_tables import captured, table
from freebody.views.plots import overlay

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from freebody.run.simulation import Run


_SIDE = 1e-7  # of the common time: nearer than that to a switch, one run may be before it and the other after


@dataclass(frozen=True)
class Difference:
    """How far one column of two runs lies apart: largest |a − b|, when (s), its root mean square, and
    the largest relative to the size of all columns of its kind and unit (a ledger that balances has no size of its own)."""

    name: str
    unit: str
    largest: float
    t: float
    rms: float
    relative: float


@dataclass(frozen=True)
class Comparison:
    """Two runs at the times ``t`` (nt,) both know, column by column; ``only`` lists columns that one run alone has."""

    a: Run = field(repr=False)
    b: Run = field(repr=False)
    t: Array = field(repr=False)
    differences: list[Difference]
    only: list[str]

    def __getitem__(self, name: str) -> Difference:
        return next(difference for difference in self.differences if difference.name == name)

    @property
    def largest(self) -> Difference:
        """The column that differs most, relative to its size."""
        return max(self.differences, key=lambda difference: difference.relative)

    @property
    def parting(self) -> str:
        """Where the two begin to switch differently, in words; empty where the same happens in the same order."""
        stated = [[f"{change.kind} of {', '.join(change.of)}" for change in run.changes] for run in (self.a, self.b)]
        for i, (mine, other) in enumerate(zip_longest(*stated, fillvalue="nothing")):
            if mine != other:
                t = min(run.changes[i].t for run in (self.a, self.b) if i < len(run.changes))
                return f"from t = {t:.6g} s on their mode changes differ: {mine} in the first, {other} in the second"
        return ""

    def plot(self, *names: str, ax: Axes | None = None) -> Axes:
        """Columns of both runs over time: the first solid, the second dashed."""
        return overlay(self.a, self.b, names or (self.largest.name,), ax=ax)

    def __rich__(self) -> Any:
        heads = ("column", "unit", "largest |a − b|", "at t / s", "rms", "relative")
        rows = [
            (d.name, d.unit, f"{d.largest:.3e}", f"{d.t:.6g}", f"{d.rms:.3e}", f"{d.relative:.1e}")
            for d in self.differences
            if d.largest
        ]
        return table("", heads, rows, figures=heads[2:])

    def __str__(self) -> str:
        return captured(self, 110)


def compare(a: Run, b: Run) -> Comparison:
    """Columns that two runs share, at the times that both know."""
    t = common_times(a, b)
    left, right = (
        dict(zip((column.name for column in run.columns), np.hstack(list(run.blocks.values())).T, strict=True))
        for run in (a.at(t), b.at(t))
    )
    shared = [column for column in a.columns if column.name in right]
    sizes: dict[tuple[str, str], float] = {}
    for column in shared:
        key, values = (column.kind, column.unit), np.abs([left[column.name], right[column.name]])
        sizes[key] = max(sizes.get(key, 0.0), float(np.nanmax(values, initial=0.0)))
    differences = []
    for column in shared:
        one, other, size = left[column.name], right[column.name], sizes[column.kind, column.unit]
        # Where a reaction is indeterminate in both runs there is nothing to compare.
        gap = np.where(np.isnan(one) & np.isnan(other), 0.0, np.abs(one - other))
        i, rms = int(np.argmax(gap)), float(np.sqrt(np.mean(gap**2)))
        relative = float(gap[i] / size) if size else 0.0
        differences.append(Difference(column.name, column.unit, float(gap[i]), float(t[i]), rms, relative))
    return Comparison(a, b, t, differences, sorted(right.keys() ^ left.keys()))


def common_times(a: Run, b: Run) -> Array:
    """Output times of one run at which the other is known too: all of them where it is known at any time, but those at which
    something switches, since the other may be before it."""
    if a.recorded and b.recorded:
        times = np.intersect1d(a.t, b.t)
    else:
        grid, other = (b, a) if b.recorded else (a, b)
        times = grid.t[(grid.t >= other.edges[0]) & (grid.t <= other.edges[-1])]
    if len(times):
        jumps = np.concatenate([[-np.inf], np.union1d(a.jumps, b.jumps), [np.inf]])
        after = np.searchsorted(jumps, times)
        near = np.minimum(jumps[after] - times, times - jumps[after - 1])
        times = times[near > _SIDE * (times[-1] - times[0])]
    if not len(times):
        raise ValueError("the two runs have no time in common; run.again() makes one of them known at all times")
    return times
