"""How a smooth phase of a motion changes with its start: the variational equation Φ' = A(t) Φ along a run, with exact derivatives.

It is integrated by Gauss collocation (Hairer, Nørsett & Wanner, *Solving ODEs* I, II.7) on the steps of the run, so that no stage
lies where something switches.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import Array, State, Trajectory, quote

if TYPE_CHECKING:
    from freebody.run.simulation import Run

_STAGES = 4
_AGREE = 1e-11
"""Part of the largest size of a perturbation so far by which halved steps may change it."""
_HALVINGS = 6


class NotDifferentiable(ValueError):
    """A motion has no derivative by its start: what happens on its way that has none, and when."""


class VectorField:
    """The motion of a run as a system of first order, y = (q, u, z) with states z of the model's own, and its derivatives. ``sizes`` (n,)
    are a radian or the extent of the mechanism, by which changes of coordinates are compared; ``own_sizes`` (nz,) the largest
    values of the states on the way, 1 where they are none."""

    def __init__(self, run: Run) -> None:
        self.source = source = run.source
        self.names, self.states = [quote(each) for each in source.coordinate_names], list(source.metadata["states"])
        self.rates = [*(f"accel({name})" for name in self.names), *(f"rate({quote(name)})" for name in self.states)]
        extent = source.free_bodies(run.start).extent
        self.sizes = np.array([1.0 if each["dimension"] == "rad" else extent for each in source.metadata["coordinates"]])
        parameters = [each["name"] for each in source.metadata["parameters"]]
        self.own = [parameters.index(name) for name in self.states]
        largest = np.abs(run.motion.evaluate([quote(name) for name in self.states], run.motion.steps)).max(axis=0, initial=0.0)
        self.own_sizes = np.where(largest > 0, largest, 1.0)

    def __call__(self, state: State) -> Array:
        """Rates of all of y (2n + nz,)."""
        return np.concatenate([state.u, self.source.evaluate(self.rates, state)])

    def split(self, of: Array) -> tuple[Array, Array]:
        """Derivatives (k, 1 + 2n + np) as those by y (k, 2n + nz), and those by the clock and the parameters (k, 1 + np)."""
        placed, own = np.s_[1 : 1 + 2 * len(self.names)], [1 + i for i in self.own]
        others = np.delete(of, placed, axis=1)
        by_state = np.hstack([of[:, placed], others[:, own]])
        others[:, own] = 0.0
        return by_state, others

    def slopes(self, state: State) -> tuple[Array, Array]:
        """Derivatives of these rates by y, and by the clock and the parameters."""
        by_state, by_others = self.split(self.source.derivatives(self.rates, state))
        n = len(self.names)
        return np.vstack([np.eye(n, by_state.shape[1], n), by_state]), np.vstack([np.zeros((n, by_others.shape[1])), by_others])


@dataclass(frozen=True)
class Transition:
    """How y at the end of a phase follows y at its start, Φ ``by_state`` (ny, ny), and changes of the clock
    and of parameters, ``by_others`` (ny, k). ``error``: by how much halved steps change a column, over its largest size;
    ``liouville``: by how much det Φ differs from exp ∫ tr A dt, relatively."""

    by_state: Array
    by_others: Array
    error: float
    liouville: float


def transition(field: VectorField, motion: Trajectory, steps: Array, others: Array) -> Transition:
    """The transition of a smooth phase, whose ``steps`` are those of the run, for changes of ``others`` (1 + np, k). Raises
    ``NotDifferentiable`` where halving of the steps comes to no end."""
    sizes = np.concatenate([field.sizes, field.sizes / (steps[-1] - steps[0]), field.own_sizes])[:, None]
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
    own = motion.evaluate([quote(name) for name in field.states], times.ravel())
    places = (each.reshape(*times.shape, -1) for each in (*motion.sample(times.ravel()), own))
    size = 2 * len(inside.q) + len(field.own)
    columns, inputs = np.eye(size, size + others.shape[1]), np.hstack([np.zeros((len(others), size)), others])
    largest, divergence = np.abs(columns), 0.0
    for h, *stages in zip(np.diff(steps), times, *places, strict=True):
        slopes = []
        for t, q, u, z in zip(*stages, strict=True):
            p = inside.p.copy()
            p[field.own] = z
            slopes.append(field.slopes(replace(inside, p=p, t=t, q=q, u=u)))
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
