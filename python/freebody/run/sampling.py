"""The times at which a run shows a motion."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from freebody.core import Array, Settings, Trajectory

Times = Sequence[float] | Array
MAX_FIGURES = 100_000_000
"""That the table of a run may be asked to hold, rows × columns: 800 MB."""


def check_size(columns: int, settings: Settings, start: float, t_eval: Times | None) -> None:
    """Raises ``ValueError`` for a table that is too large, before anything is computed; ``start`` in s."""
    end = start if settings.until is None else settings.until
    rows = len(t_eval) if t_eval is not None else (end - start) / settings.every if settings.every else 0
    if rows * columns > MAX_FIGURES:
        asked = f"{rows} times" if t_eval is not None else f"`every: {settings.every:g}` until {end:g} s"
        what = f"{asked} makes {rows:.3g} rows of {columns} columns; at most {MAX_FIGURES:.0e} figures are kept"
        raise ValueError(f"{what}: ask for fewer times, or give `every` a larger value")


def output_times(motion: Trajectory, every: float | None = None, t_eval: Times | None = None) -> Array:
    """The output grid (nt,) in s: what was asked for, or 60 a second and at least 400, with the events, all that switched and,
    while they are no more than that, the steps."""
    start, end = motion.steps[0], motion.steps[-1]
    if t_eval is not None:
        asked: Array = np.unique(np.asarray(t_eval, float))
        return asked[(asked >= start) & (asked <= end)]
    if every is not None:
        # The end belongs to the grid even where the spacing does not meet it.
        return _merged(np.array([start, end]), start + every * np.arange(1, np.floor((end - start) / every * (1 + 1e-12)) + 1))
    uniform = np.linspace(start, end, int(np.clip(60 * (end - start), 400, 6000)) + 1)
    stated = [each.t for each in (*motion.events, *motion.changes)]
    marks = np.array([start, end] + [t for t in stated if start <= t <= end])
    return _merged(np.union1d(marks, motion.steps) if len(motion.steps) <= len(uniform) else np.unique(marks), uniform)


def _merged(marks: Array, grid: Array) -> Array:
    """All marks, and those times of the grid that are not one of them to round-off."""
    slack = 1e-10 * (marks[-1] - marks[0])
    near = np.clip(np.searchsorted(marks, grid), 1, max(len(marks) - 1, 1))
    gap = np.minimum(np.abs(grid - marks[near - 1]), np.abs(grid - marks[near % len(marks)]))
    return np.union1d(marks, grid[gap > slack])
