"""How a smooth phase of a motion changes with its start: the variational equation Φ' = A(t) Φ along a run, with exact derivatives.

It is integrated by Gauss collocation (Hairer, Nørsett & Wanner, *Solving ODEs* I, II.7) on the steps of the run, so that no stage
lies where something switches.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from freebody.core import Array, CompiledModel, State, Trajectory, quote

_STAGES = 4
_AGREE = 1e-11
"""Part of the largest size of a perturbation so far by which halved steps may change it."""
_HALVINGS = 6


class NotDifferentiable(ValueError):
    """A motion has no derivative by its start: what happens on its way that has none, and when."""


class VectorField:
    """The motion as a system of first order, (q, u)' = (u, u̇(t, q, u, p)), and its derivatives. ``sizes`` (n,) are a radian or the
    extent of the mechanism, by which changes of coordinates are compared."""

    def __init__(self, source: CompiledModel, state: State) -> None:
        self.source = source
        self.names = [quote(each["name"]) for each in source.metadata["coordinates"]]
        self.accelerations = [f"accel({name})" for name in self.names]
        extent = source.free_bodies(state).extent
        self.sizes = np.array([1.0 if each["dimension"] == "rad" else extent for each in source.metadata["coordinates"]])

    def __call__(self, state: State) -> Array:
        """Rates and accelerations (2n,)."""
        return np.concatenate([state.u, self.source.evaluate(self.accelerations, state)])

    def slopes(self, state: State) -> tuple[Array, Array]:
        """Derivatives of rates and accelerations by coordinates and rates (2n, 2n), and by time and parameters (2n, 1 + np)."""
        n, of = len(state.q), self.source.derivatives(self.accelerations, state)
        by_state, by_others = of[:, 1 : 1 + 2 * n], np.delete(of, np.s_[1 : 1 + 2 * n], axis=1)
        upper = np.hstack([np.zeros((n, n)), np.eye(n)])
        return np.vstack([upper, by_state]), np.vstack([np.zeros_like(by_others), by_others])


@dataclass(frozen=True)
class Transition:
    """How coordinates and rates at the end of a phase follow those at its start, Φ ``by_state`` (2n, 2n), and changes of the clock
    and of parameters, ``by_others`` (2n, k). ``error``: by how much halved steps change a column, over its largest size;
    ``liouville``: by how much det Φ differs from exp ∫ tr A dt, relatively."""

    by_state: Array
    by_others: Array
    error: float
    liouville: float


def transition(field: VectorField, motion: Trajectory, steps: Array, others: Array) -> Transition:
    """The transition of a smooth phase, whose ``steps`` are those of the run, for changes of ``others`` (1 + np, k). Raises
    ``NotDifferentiable`` where halving of the steps comes to no end."""
    sizes = np.concatenate([field.sizes, field.sizes / (steps[-1] - steps[0])])[:, None]
    coarse, _, _ = _collocated(field, motion, np.union1d(steps[::2], steps[-1:]), others)
    for _ in range(_HALVINGS):
        fine, largest, divergence = _collocated(field, motion, steps, others)
        most = (largest / sizes).max(axis=0)
        error = float((np.abs(fine - coarse) / sizes / np.where(most > 0, most, 1.0)).max())
        if error <= _AGREE:
            by_state, by_others = np.split(fine, [len(fine)], axis=1)
            volume = float(np.linalg.slogdet(by_state)[1])
            return Transition(by_state, by_others, error, abs(np.expm1(volume - divergence)))
        coarse, steps = fine, np.union1d(steps, (steps[1:] + steps[:-1]) / 2)
    raise NotDifferentiable(f"the variational equation does not settle between t = {steps[0]:g} s and {steps[-1]:g} s")


def _collocated(field: VectorField, motion: Trajectory, steps: Array, others: Array) -> tuple[Array, Array, float]:
    """Φ and the response to the others side by side, the largest sizes of their entries on the way, and ∫ tr A dt."""
    inside = motion.state((steps[0] + steps[1]) / 2)
    times = steps[:-1, None] + np.diff(steps)[:, None] * _C
    places = (each.reshape(*times.shape, -1) for each in motion.sample(times.ravel()))
    size = 2 * len(inside.q)
    columns, inputs = np.eye(size, size + others.shape[1]), np.hstack([np.zeros((len(others), size)), others])
    largest, divergence = np.abs(columns), 0.0
    for h, *stages in zip(np.diff(steps), times, *places, strict=True):
        slopes = [field.slopes(replace(inside, t=t, q=q, u=u)) for t, q, u in zip(*stages, strict=True)]
        columns = _step(columns, inputs, h, slopes)
        divergence += h * sum(b * np.trace(of_state) for b, (of_state, _) in zip(_B, slopes, strict=True))
        largest = np.maximum(largest, np.abs(columns))
    return columns, largest, divergence


def _step(columns: Array, inputs: Array, h: float, slopes: Sequence[tuple[Array, Array]]) -> Array:
    """One step of Gauss collocation of Y' = A Y + B W: the slopes of all stages from one linear system."""
    size, stages = len(columns), len(slopes)
    matrix, right = np.eye(stages * size), np.empty((stages * size, columns.shape[1]))
    for i, (of_state, of_others) in enumerate(slopes):
        rows = slice(i * size, (i + 1) * size)
        matrix[rows] -= h * np.kron(_A[i], of_state)
        right[rows] = of_state @ columns + of_others @ inputs
    found = np.linalg.solve(matrix, right).reshape(stages, size, -1)
    return columns + h * np.tensordot(_B, found, 1)


def _gauss(stages: int) -> tuple[Array, Array, Array]:
    """Nodes c, weights b and matrix a of Gauss collocation on [0, 1]."""
    nodes, weights = np.polynomial.legendre.leggauss(stages)
    c, powers = (nodes + 1) / 2, np.arange(stages)
    a = (c[:, None] ** (powers + 1) / (powers + 1)) @ np.linalg.inv(c[:, None] ** powers)
    return c, weights / 2, a


_C, _B, _A = _gauss(_STAGES)
