"""The forces of actuators that give a motion: B τ = what the motion takes, along every motion that the joints allow.

At a state let u̇₀ be the accelerations without the actuators, u̇ those wanted, N the motions that loops leave free (columns) and B the
generalized forces of a unit of each actuator. From M (u̇ − u̇₀) − Gᵀ(λ − λ₀) = B τ it follows that NᵀB τ = NᵀM (u̇ − u̇₀): τ is unique
if NᵀB has as many independent columns as there are actuators, and there is one if the right side is a combination of them. M, N, B and
u̇₀ are those of the core, and so is what is found: it is put into forward dynamics, corrected once, and compared.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.linalg import qr
from scipy.optimize import nnls

from freebody.core import Array, CompiledModel, Indeterminate, State, quote
from freebody.inverse.virtual_motions import DEPENDENT, allowed
from freebody.model.names import suggestion
from freebody.solve.figures import figure

MISSING = 1e-7
"""Part of the largest force among those that balance below which nothing is missing: round-off of a motion that was integrated."""
NAMED = 1e-6
"""Part of the largest entry below which a coordinate or an actuator has no part in a vector."""


class NotRealizable(ValueError):
    """A motion that the actuators, or the mechanism itself, cannot bring about ``at`` a time or ``beyond`` it, and why; ``t`` is that
    time, s, ``posture`` the coordinates then (m, rad)."""

    def __init__(self, when: str, why: str, t: float, posture: Mapping[str, float]) -> None:
        named = ", ".join(f"{name} = {round(value, 6) + 0.0:g}" for name, value in posture.items())
        super().__init__(f"the motion cannot be had {when} t = {t:.6g} s, at {named}: {why}")
        self.t, self.posture = t, dict(posture)


@dataclass(frozen=True)
class Found:
    """The forces (k,) of the actuators at a state, N or N·m; the state with them; ``free`` (k, d): what can be added to them without
    a change of the motion; ``error``: the largest difference between the accelerations that they give and those wanted, relative to
    the largest among the terms that balance."""

    forces: Array
    state: State
    free: Array
    error: float


@dataclass(frozen=True, eq=False)
class Actuators:
    """Forces and torques of a model, by ``names``, whose values are found: each is a parameter of its own. ``limits`` are the
    largest sizes that they can have, by name (N or N·m); ``least`` takes the least sum of squares where they are not unique."""

    source: CompiledModel
    names: Sequence[str]
    limits: Mapping[str, float]
    least: bool = False

    def __post_init__(self) -> None:
        _ = self.places  # what is wrong with the names is said at once

    @cached_property
    def places(self) -> list[int]:
        """Where the parameters are that stand for their values. Raises ``ValueError`` for a force without one of its own."""
        forces = {force["name"]: force["with"] for force in self.source.spec["forces"]}
        parameters = [parameter["name"] for parameter in self.source.metadata["parameters"]]
        found: list[int] = []
        for name in self.names:
            if name not in forces:
                raise ValueError(f"there is no force `{name}`: {suggestion(name, forces, 'forces')}")
            value = forces[name].get("value")
            if value not in parameters:
                hint = "name it as a parameter: `parameters: {T: 0 N*m}`, `value: T`"
                raise ValueError(f"the value of `{name}`, {value}, is not to be found: {hint}")
            found.append(parameters.index(value))
        if len(set(found)) < len(found):
            raise ValueError("two actuators share a parameter: give each its own")
        self._check_alone(parameters, found)
        return found

    def _check_alone(self, parameters: Sequence[str], places: Sequence[int]) -> None:
        usual = self.source.bind()
        for place in places:
            changed = self.source.bind({parameters[place]: float(usual[place]) + 1.0})
            follow = (usual != changed) & (np.arange(len(usual)) != place)
            if others := [name for name, follows in zip(parameters, follow, strict=True) if follows]:
                raise ValueError(
                    f"{', '.join(others)} would follow from {parameters[place]}: give the actuator a parameter of its own"
                )

    @cached_property
    def units(self) -> list[str]:
        """N or N*m, of each."""
        readings = {force["name"]: force["readings"]["value"] for force in self.source.metadata["forces"]}
        return [readings[name] for name in self.names]

    def at(self, state: State, wanted: Array) -> Found:
        """The forces that give the accelerations ``wanted`` (n,) at a state.

        Raises ``NotRealizable`` where there are none, and ``Indeterminate`` where they are not unique and ``least`` is not set."""
        core, off = self.source, self._with(state, np.zeros(len(self.names)))
        still, bodies, mass = core.instant(off), core.free_bodies(off), core.mass_matrix(off)
        along, directions = allowed(core, bodies), self._directions(off)
        scale = np.array([1.0 if unit == "N*m" else bodies.extent for unit in self.units])
        size = still.sizes[0] * bodies.extent
        left, values, right = np.linalg.svd(along.T @ directions / scale)
        largest = np.abs(bodies.units(core.metadata["coordinates"])[:, None] * directions / scale).max(initial=0.0)
        rank = int((values > DEPENDENT * largest).sum())
        free = right[rank:].T / scale[:, None]
        inverse = (right[:rank].T / values[:rank]) @ left[:, :rank].T / scale[:, None]
        takes = along.T @ mass @ (wanted - still.accelerations)
        missing = takes - along.T @ directions @ (inverse @ takes)
        if np.abs(missing).max(initial=0.0) > MISSING * max(size, np.abs(takes).max(initial=0.0)):
            posture = dict(zip(core.coordinate_names, state.q.tolist(), strict=True))
            why = self._lacking(off, along @ missing, float(np.linalg.norm(missing)), bodies.extent)
            raise NotRealizable("at", why, state.t, posture)
        forces = self._chosen(inverse @ takes, free, state.t)
        forces = forces + inverse @ along.T @ mass @ (wanted - core.instant(self._with(state, forces)).accelerations)
        with_forces = self._with(state, forces)
        off_by = np.abs(core.instant(with_forces).accelerations - wanted).max(initial=0.0)
        return Found(
            forces, with_forces, free, float(off_by / max(still.sizes[1], np.abs(wanted).max(initial=0.0), np.finfo(float).tiny))
        )

    def _with(self, state: State, forces: Array) -> State:
        p = state.p.copy()
        p[self.places] = forces
        return replace(state, p=p)

    def _directions(self, state: State) -> Array:
        """Generalized forces (n, k) of a unit of each: their power for a unit of each rate, all else kept."""
        powers = [f"{quote(name)}.power" for name in self.names]
        n, unit = len(state.u), self._with(state, np.ones(len(self.names)))
        return self.source.derivatives(powers, unit)[:, 1 + n : 1 + 2 * n].T

    def _chosen(self, forces: Array, free: Array, t: float) -> Array:
        """Those of all possible forces that are wanted: within the limits if they can be, of least sum of squares."""
        if not free.size:
            return forces
        if not self.least:
            ways = "; ".join(" and ".join(parts) for parts in self.combinations(free))
            hint = "least=True (--least) takes those of least sum of squares; or leave out an actuator"
            raise Indeterminate(
                f"the forces of the actuators are not unique at t = {t:.6g} s: any multiple of {ways} can be added; {hint}"
            )
        free = np.linalg.qr(free)[0]
        forces = forces - free @ (free.T @ forces)
        most = np.array([self.limits.get(name, np.inf) for name in self.names])
        return forces + free @ _least_within(free, -most - forces, most - forces)

    def combinations(self, free: Array) -> list[list[str]]:
        """What can be added to the forces, in words: ``1 hip``, ``−0.5 knee``."""
        basis = _sparse(free)
        return [
            [f"{figure(part, 4)} {name}" for name, part in zip(self.names, way, strict=True) if abs(part) > NAMED]
            for way in basis.T
        ]

    def _lacking(self, off: State, motion: Array, missing: float, extent: float) -> str:
        """What no actuator gives, ``missing`` along a motion of the coordinates (n,), and what these actuators can give instead: as many
        motions as their forces accelerate independently."""
        names = self.source.coordinate_names
        sizes = np.abs(motion) / max(np.abs(motion).max(), np.finfo(float).tiny)
        moving = [name for name, size in zip(names, sizes, strict=True) if size > NAMED]
        works = "in the motion of" if len(moving) > 1 else "on"
        coordinates = self.source.metadata["coordinates"]
        lengths = all(c["dimension"] == "m" for c in coordinates if c["name"] in moving)
        stated = f"{figure(missing / extent, 4)} N" if lengths else f"{figure(missing, 4)} N·m"
        columns = self.source.derivatives([f"accel({quote(name)})" for name in names], off)[:, 1 + 2 * len(names) :]
        per_size = [1.0 if c["dimension"] == "rad" else extent for c in coordinates]
        by_force = columns[:, self.places] / np.array(per_size)[:, None]
        _, triangle, order = qr(by_force.T, mode="economic", pivoting=True)
        pivots = np.abs(np.diag(triangle))
        had = [names[i] for i in np.sort(order[: int((pivots > DEPENDENT * pivots.max(initial=0.0)).sum())])]
        instead = "; they accelerate nothing here"
        if had:
            free = "prescribe no more, and say by `by` along which gauge the actuator acts, so that the rest moves as it will"
            instead = f"; what these give is the motion of {' and '.join(had)}: {free}"
        return f"no actuator works {works} {', '.join(moving)}, where {stated} are missing; add an actuator there{instead}"


def _sparse(basis: Array) -> Array:
    """The same space with as many zeros as elimination gives, the largest entry of every column 1."""
    rows = basis.T.copy()
    for i in range(len(rows)):
        j = int(np.abs(rows[i]).argmax())
        rows[i] /= rows[i, j]
        for k in range(len(rows)):
            rows[k] -= rows[k, j] * rows[i] if k != i else 0.0
    return rows.T


def _least_within(columns: Array, least: Array, most: Array) -> Array:
    """The shortest z with least ≤ columns z ≤ most; 0 where there is none. Lawson & Hanson, *Solving Least Squares Problems*, ch. 23."""
    bounded = np.isfinite(most)
    rows = np.vstack([columns[bounded], -columns[bounded]])
    bounds = np.concatenate([least[bounded], -most[bounded]])
    if (bounds <= 0).all():
        return np.zeros(columns.shape[1])
    u, _ = nnls(np.vstack([rows.T, bounds]), np.append(np.zeros(columns.shape[1]), 1.0))
    r = np.append(rows.T @ u, bounds @ u - 1.0)
    return -r[:-1] / r[-1] if abs(r[-1]) > NAMED else np.zeros(columns.shape[1])
