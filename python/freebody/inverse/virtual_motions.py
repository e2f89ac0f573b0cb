"""The motions that loops and prescribed motions leave free at a state."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from freebody.core import Array, CompiledModel, FreeBodies

if TYPE_CHECKING:
    from freebody.run.simulation import Run

DEPENDENT = 1e-9
"""Part of the largest singular value below which a row or a column follows from others."""

_NEAR, _PLACES = 0.02, 8
"""Part of a run before its end from which it is followed to a dead position, by how many places."""


def allowed(source: CompiledModel, free: FreeBodies) -> Array:
    """A basis (n, f) of the rates of the coordinates with which everything that is closed stays closed and prescribed motions
    stand still; its columns are orthonormal when lengths are measured by the size of the mechanism."""
    return free.units(source.metadata["coordinates"])[:, None] * null_space(closing_rows(source, free))


def closing_rows(source: CompiledModel, free: FreeBodies) -> Array:
    """The rows (m, n) of what is closed and of prescribed motions, lengths measured by the size of the mechanism."""
    names = [c["name"] for c in source.metadata["coordinates"]]
    rows = np.array([[row.coefficients[name] for name in names] for row in free.rows]).reshape(-1, len(names))
    return rows * free.units(source.metadata["coordinates"])


def dead_position(run: Run) -> tuple[float, dict[str, float]]:
    """The time and the posture at which the rows of a run that ended near by depend on each other. There both go as a power series of
    the least singular value of the rows, which is followed to 0."""
    first, last = run.edges[[0, -1]]
    times = last - _NEAR * (last - first) * np.linspace(0, 1, _PLACES) ** 2
    states = [run.motion.state(t) for t in times.tolist()]
    rows = [closing_rows(run.source, run.source.free_bodies(state)) for state in states]
    least = [np.linalg.svd(each, compute_uv=False)[-1] for each in rows]
    places = np.column_stack([times, [state.q for state in states]])
    t, *q = np.polyfit(least, places, _PLACES - 2)[-1].tolist()
    return t, dict(zip(run.coordinates, q, strict=True))


def null_space(rows: Array) -> Array:
    """An orthonormal basis (n, k) of what rows (m, n) take to 0; they are compared at equal sizes."""
    sizes = np.linalg.norm(rows, axis=1, keepdims=True)
    rows = rows[sizes[:, 0] > 0] / sizes[sizes > 0][:, None]
    _, values, right = np.linalg.svd(rows.reshape(-1, rows.shape[1]))
    return right[int((values > DEPENDENT * values.max(initial=0.0)).sum()) :].T
