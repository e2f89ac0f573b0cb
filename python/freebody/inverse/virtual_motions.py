"""The motions that loops and prescribed motions leave free at a state."""

from __future__ import annotations

import numpy as np

from freebody.core import Array, CompiledModel, FreeBodies

DEPENDENT = 1e-9
"""Part of the largest singular value below which a row or a column follows from others."""


def allowed(source: CompiledModel, free: FreeBodies) -> Array:
    """A basis (n, f) of the rates of the coordinates with which everything that is closed stays closed and prescribed motions
    stand still; its columns are orthonormal when lengths are measured by the size of the mechanism."""
    names = [c["name"] for c in source.metadata["coordinates"]]
    scale = free.units(source.metadata["coordinates"])
    rows = np.array([[row.coefficients[name] for name in names] for row in free.rows]).reshape(-1, len(names)) * scale
    return scale[:, None] * null_space(rows)


def null_space(rows: Array) -> Array:
    """An orthonormal basis (n, k) of what rows (m, n) take to 0; they are compared at equal sizes."""
    sizes = np.linalg.norm(rows, axis=1, keepdims=True)
    rows = rows[sizes[:, 0] > 0] / sizes[sizes > 0][:, None]
    _, values, right = np.linalg.svd(rows.reshape(-1, rows.shape[1]))
    return right[int((values > DEPENDENT * values.max(initial=0.0)).sum()) :].T
