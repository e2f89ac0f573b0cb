"""The linear equations of small vibrations about a place of rest, and their natural frequencies."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from freebody.core import Array, CompiledModel, State
from freebody.stability.state_space import StateSpace, state_space

NOTHING = 1e-8  # of the stiffest, below which a square of a natural frequency is 0; of damping beside stiffness
_WELDS = 1e3  # of the largest natural frequency: rates at which dampers make motions fade, above which they are as good as rigid
_LASTING = 30.0  # of the rate at which it fades, the rate of what swings for long


def linear_equations(core: CompiledModel, state: State) -> StateSpace:
    """The linear equations of perturbations of a state in which what is locked stays where it is."""
    space = state_space(core, state)
    kept = [i for i, name in enumerate(space.states) if name not in space.coordinates or space.a[i].any()]
    return replace(space, states=tuple(space.states[i] for i in kept), a=space.a[np.ix_(kept, kept)])


def swings(a: Array) -> bool:
    """Whether linear equations are those of a vibration."""
    return bool(np.linalg.det(a) > 0) if len(a) == 2 else len(squares_of(a)) > 0


def squares_of(a: Array) -> Array:
    """The squares of the natural frequencies of the linear equations of several freedoms, those without their damping, the least first and
    without those that are 0; none where it is not stable, or rates bind it otherwise than dampers do. Dampers that are far stiffer than all
    springs let nothing slide past each other: then those of what swings beside them."""
    n = len(a) // 2
    if len(a) != 2 * n:
        return np.zeros(0)
    found, fading = np.linalg.eigvals(-a[n:, :n]), np.linalg.eigvals(-a[n:, n:])
    most = float(np.abs(found).max())
    if most > 0 and np.abs(fading).max() > _WELDS * np.sqrt(most):
        swinging = np.linalg.eigvals(a)
        return np.sort(np.abs(swinging[swinging.imag > _LASTING * np.abs(swinging.real)]) ** 2)
    both = np.linalg.eigvals(a)
    if most > 0 and np.abs(both.real).max() <= np.sqrt(NOTHING * most):  # gyroscopic forces alone make nothing fade
        return np.sort(both.imag[both.imag > np.sqrt(NOTHING * most)] ** 2)
    # The rates at which dampers make it fade are real; those of gyroscopic forces are imaginary.
    if (
        max(np.abs(fading.imag).max(), -fading.real.min()) ** 2 > NOTHING * most
        or np.abs(found.imag).max() > NOTHING * most
        or found.real.min() < -NOTHING * most
    ):
        return np.zeros(0)
    return np.sort(found.real[found.real > NOTHING * most])


def of_several(squares: Array) -> dict[str, float]:
    """Natural frequencies by their size; that alone, where there is one."""
    found = np.sqrt(squares).tolist()
    if len(found) == 1:
        return {"natural frequency": found[0], "frequency": found[0] / (2 * np.pi), "period": 2 * np.pi / found[0]}
    return {f"natural frequency {i}": each for i, each in enumerate(found, 1)}
