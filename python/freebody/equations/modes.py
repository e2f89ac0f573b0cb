"""How linear equations move, in numbers: what is free, what drifts, where equal eigenvalues share one direction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from freebody.core import Array
from freebody.equations.linearization import Linearised, Matrix
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.algebra import equal
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import is_zero

_SMALL = 1e-7
"""Singular value, relative to the largest, below which a direction is free; a part of a mode, below which a coordinate rests."""
_EQUAL = 1e-4
"""Relative difference of eigenvalues, below which they are equal: a double one that shares its direction splits as √ε."""
_ROUND_OFF = 1e-13
"""Of eigenvalues, relative to the largest: where n of them are equal but share a direction they split by its nth root."""
_MOST_EQUAL = 4
"""Equal eigenvalues that are recognised as such, so that no root of round-off reaches the distance of different ones."""
_ASIDE = 0.2
_SEED = 13


@dataclass(frozen=True)
class Root:
    """An eigenvalue in numbers, 1/s, ``count`` times."""

    value: complex
    count: int


@dataclass(frozen=True)
class Modes:
    """Coordinates that nothing brings back (``free``), of which those ``drifting`` keep a speed; those ``moving`` otherwise.

    ``symmetric``: M and K are, and there is no C. ``grows``: equal eigenvalues ± i ω lack directions of their own."""

    free: tuple[str, ...]
    drifting: tuple[str, ...]
    moving: tuple[str, ...]
    symmetric: bool
    grows: bool


def modes(subject: SymbolicState, found: Linearised) -> Modes:
    """The modes beside the numbers of a subject, so that nothing is so by chance."""
    m, c, k = (_beside(subject, part) for part in (found.mass, found.damping, found.stiffness))
    free = null_space(k)
    reached = null_space(k.T).T @ c @ free  # a speed v that C v, in the range of K, lets be
    drifting = free @ null_space(reached) if free.size else free
    a = first_order(m, c, k)
    values, vectors = np.linalg.eig(a)
    own = [i for i, value in enumerate(values) if abs(value) > _EQUAL * np.abs(values).max(initial=0.0)]
    moving = vectors[: len(m), own]
    symmetric = all(is_zero(entry) for row in found.damping for entry in row) and all(
        equal(x[i][j], x[j][i]) for x in (found.mass, found.stiffness) for i in range(len(m)) for j in range(i)
    )
    scale = np.abs(values).max(initial=0.0)

    def lacks(value: complex) -> bool:
        """Whether an eigenvalue on the imaginary axis is there more often than it has directions."""
        sizes = np.linalg.svd(a - value * np.eye(len(a)), compute_uv=False)
        count = int((np.abs(values - value) < _EQUAL * scale).sum())
        return abs(value.real) < _EQUAL * scale and count > int((sizes < _EQUAL * sizes.max()).sum())

    def moved(directions: Array) -> tuple[str, ...]:
        return tuple(x for x, row in zip(found.coordinates, directions, strict=True) if np.abs(row).max(initial=0.0) > _SMALL)

    grows = not symmetric and any(map(lacks, values[own]))
    return Modes(moved(free), moved(drifting), moved(moving), symmetric, grows)


def first_order(m: Array, c: Array, k: Array) -> Array:
    """A of ż = A z with z = (x, ẋ). Raises ``LinAlgError``."""
    n = len(m)
    return np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(m, k), -np.linalg.solve(m, c)]])


def roots(a: Array) -> tuple[Root, ...]:
    """The eigenvalues of a matrix, equal ones once; parts that are round-off are 0. Ordered by real and imaginary part."""
    left = [complex(value) for value in np.linalg.eigvals(a)]
    scale, found = max(map(abs, left), default=0.0), list[Root]()
    while left:
        near = sorted(left, key=lambda value: abs(value - left[0]))
        for count in range(min(_MOST_EQUAL, len(near)), 0, -1):
            mean = sum(near[:count]) / count
            if count == 1 or max(abs(value - mean) for value in near[:count]) <= scale * _ROUND_OFF ** (1 / count):
                break
        left = near[count:]
        real, imaginary = (part if abs(part) > 10 * _ROUND_OFF * scale else 0.0 for part in (mean.real, mean.imag))
        found.append(Root(complex(real, imaginary), count))
    return tuple(sorted(found, key=lambda root: (root.value.real, root.value.imag)))


def null_space(matrix: Array) -> Array:
    """Orthonormal directions, as columns, that a matrix takes to 0."""
    _, sizes, directions = np.linalg.svd(matrix)
    rank = int((sizes > _SMALL * sizes.max(initial=0.0)).sum())
    return directions[rank:].conj().T


def _beside(subject: SymbolicState, matrix: Matrix) -> Array:
    rng = np.random.default_rng(_SEED)
    values = {x: v * (1 + _ASIDE * rng.uniform(-1, 1)) for x, v in subject.values.items()}
    return np.array([[float(evaluate(entry, values, subject.tables)) for entry in row] for row in matrix])
