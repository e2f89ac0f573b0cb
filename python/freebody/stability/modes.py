"""Modes, frequency response and state feedback of linear equations in numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from freebody.core import Array
from freebody.stability.state_space import StateSpace

Complex = NDArray[np.complex128]

_ZERO = 1e-7
"""Part of an eigenvalue, relative to the largest, below which it is 0: a double one splits by the root of round-off."""
_PLACED = 1e-6
"""Distance of poles from those asked for, relative to the largest, above which they were not placed."""


@dataclass(frozen=True)
class Mode:
    """A motion δq = Re(shape e^(λ t)), of eigenvalue λ in 1/s, and the ``outputs`` in it: complex amplitudes in SI units, such that
    the largest of the ``shape`` of the coordinates is 1."""

    eigenvalue: complex
    shape: Mapping[str, complex]
    outputs: Mapping[str, complex]

    @property
    def frequency(self) -> float:
        """Of the oscillation, damped as it is, in Hz; 0 where nothing oscillates."""
        return abs(self.eigenvalue.imag) / (2 * pi)

    @property
    def damping(self) -> float:
        """The damping ratio −Re λ/|λ|: 1 where nothing oscillates, negative where the motion grows; 0 for λ = 0."""
        return 0.0 - self.eigenvalue.real / abs(self.eigenvalue) if self.eigenvalue else 0.0


def eigenvalues(space: StateSpace) -> Complex:
    """Of A, in 1/s, from slow to fast; parts that round-off alone tells from 0 are 0."""
    return _ordered(np.linalg.eigvals(space.a).astype(complex))[0]


def modes(space: StateSpace) -> tuple[Mode, ...]:
    """The modes from slow to fast, of conjugate eigenvalues that with the positive imaginary part."""
    values, vectors = np.linalg.eig(space.a)
    values, order = _ordered(values.astype(complex))
    found = []
    for value, vector in zip(values, vectors.T[order], strict=True):
        if value.imag < 0:
            continue
        shape = space.places @ vector
        largest = shape[np.argmax(np.abs(shape))] if shape.any() else 1.0
        stated = (dict(zip(names, (part / largest).tolist(), strict=True))
                  for names, part in ((space.coordinates, shape), (space.outputs, space.c @ vector)))  # fmt: skip
        found.append(Mode(complex(value), *stated))
    return tuple(found)


def response(space: StateSpace, frequencies: ArrayLike) -> Complex:
    """C (iω − A)⁻¹ B + D at frequencies in Hz, (nf, outputs, inputs): amplitudes and phases of outputs where inputs are cos ωt, when all
    transients have died away. NaN where an undamped mode has that frequency."""
    omega = 2 * pi * np.atleast_1d(np.asarray(frequencies, float))
    found = np.full((len(omega), len(space.outputs), len(space.inputs)), np.nan + 0j)
    for i, each in enumerate(omega):
        resolvent = 1j * each * np.eye(len(space.a)) - space.a
        if len(space.a) == 0 or np.linalg.cond(resolvent) < 1 / np.finfo(float).eps:
            found[i] = space.c @ np.linalg.solve(resolvent, space.b) + space.d
    return found


def gains(space: StateSpace, poles: Sequence[complex]) -> Array:
    """K (inputs, states) of the feedback w = K x with which A + B K has these eigenvalues, 1/s; conjugates together. Raises
    ``ValueError`` where there are as many poles as states are not, or inputs cannot place them."""
    if len(poles) != len(space.a):
        raise ValueError(f"{len(poles)} poles for {len(space.a)} states ({', '.join(space.states)}); give one for each")
    reached = np.hstack([np.linalg.matrix_power(space.a, i) @ space.b for i in range(len(space.a))])
    size = np.linalg.norm(reached, axis=0)
    if np.linalg.matrix_rank(reached / np.where(size, size, 1.0)) < len(space.a):
        raise ValueError(
            f"{', '.join(space.inputs) or 'no input'} cannot place the poles: some of the motion does not answer to it"
        )
    from scipy.signal import place_poles  # it takes half a second

    placed = place_poles(space.a, space.b, np.asarray(poles))
    found = np.sort_complex(np.linalg.eigvals(space.a - space.b @ placed.gain_matrix))
    asked = np.sort_complex(np.asarray(poles, complex))
    if np.abs(found - asked).max() > _PLACED * np.abs(asked).max():
        raise ValueError(f"these poles were not reached, but {', '.join(f'{x:.6g}' for x in found)}; take poles farther apart")
    return -placed.gain_matrix


def _ordered(values: Complex) -> tuple[Complex, list[int]]:
    scale = np.abs(values).max(initial=0.0)
    clean = [complex(*(part if abs(part) > _ZERO * scale else 0.0 for part in (x.real, x.imag))) for x in values]
    order = sorted(range(len(clean)), key=lambda i: (round(abs(clean[i]) / (scale or 1.0), 9), clean[i].real, clean[i].imag))
    return np.array([clean[i] for i in order], complex), order
