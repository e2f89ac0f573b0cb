"""Momenta that stay constant: of which connected sets of bodies, along which direction or about which point, in numbers.

A momentum along a direction that is fixed, about a point that is fixed, or about the mass centre of the bodies, changes by the
power that outside loads have in that shift or turn. It lasts where every unknown load, and the sum of the known ones, has none
at states that share nothing but the structure of the mechanism.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from freebody.core import Array, FreeBodies
from freebody.equations.balances.candidates import ABSENT
from freebody.equations.balances.system import Group, Problem, groups, problem
from freebody.equations.balances.virtual_motions import (
    SAME_PLACE,
    NamedPoints,
    VirtualMotion,
    known_shifts,
    mass_centre,
    named_motions,
)
from freebody.solve import perturbed_states

DISTINCT = 1e-6
"""Part of a momentum's values that is left when those found before are taken out, below which it follows from them."""


@dataclass(frozen=True)
class ConservedMomentum:
    """A constant momentum of some ``bodies``: along or about what ``twist`` names; it ``turns`` about the place ``at`` (m), or
    shifts along that unit direction, at the first state. ``elsewhere``: seen at other places as well."""

    bodies: tuple[str, ...]
    twist: VirtualMotion
    turns: bool
    at: tuple[float, float]
    elsewhere: bool
    values: Array = field(repr=False)


def conserved_momenta(states: Sequence[FreeBodies], points: NamedPoints) -> list[ConservedMomentum]:
    """All constant momenta, those of fewer bodies first. Of a set that keeps all of its momentum, of its moments only that about
    its mass centre: the others say no more.

    ``states`` move, all at once; as for the smallest sets the first is the one asked about."""
    given = problem(states)
    tried = [*named_motions(given, points), *known_shifts(given)]
    kept, fixed = _Kept(given), [each for each in tried if np.abs(each.motion - each.motion[0]).max() < SAME_PLACE]
    found: list[ConservedMomentum] = []
    for group in groups(given, known=True)[0]:
        named = sorted(kept.of(group, fixed), key=lambda each: each.twist.rank)
        shifts = [each for each in named if not each.turns]
        turning = [] if len(independent(shifts)) > 1 else [each for each in named if each.turns]
        found += [*shifts, *turning, *kept.of(group, [mass_centre(given, group)])]
    return found


def independent(found: Sequence[ConservedMomentum]) -> list[ConservedMomentum]:
    """The first of them that do not follow from those before: not the momentum of a set that is the sum of its parts'."""
    rows = np.array([each.values / np.linalg.norm(each.values) for each in found])
    return [found[i] for i in perturbed_states.independent(rows, DISTINCT)]


class _Kept:
    """What is at every state: ``columns`` (ns, nl, nb, 3) of the unknown loads on every body, and of their ``sizes`` (nl,); the sum of
    the ``known`` ones and the ``momentum`` of every body (ns, nb, 3), moments about the origin of the problem over its length."""

    def __init__(self, given: Problem) -> None:
        self.given = given
        about, scale = (given.origin[0], given.origin[1]), np.array([1.0, 1.0, 1.0 / given.length])
        loads = [i for i, unknown in enumerate(given.unknowns) if unknown.load is not None]
        self.columns = np.array([system.columns[loads] for system in given.systems])
        self.sizes = np.linalg.norm(self.columns, axis=3).max(axis=(0, 2), initial=0.0)
        states = [(system.free, [load for load in system.free.loads if not load.unknown]) for system in given.systems]
        known = [[sum((load.unit([b], about) for load in of), np.zeros(3)) for b in given.bodies] for _, of in states]
        bodies = [[free.bodies[name] for name in given.bodies] for free, _ in states]
        self.known = np.array(known) * scale
        self.momentum = np.array([[body.effective(about, (*body.v, body.omega)) for body in row] for row in bodies]) * scale
        self.elsewhere = len({body.G for row in bodies for body in row}) > len(given.bodies)

    def of(self, group: Group, tried: Sequence[VirtualMotion]) -> list[ConservedMomentum]:
        """The momenta of a group in some motions that no load from outside changes, and that are not 0 always."""
        motions, given = np.array([each.motion for each in tried]), self.given
        columns, known, momentum = (of[..., list(group), :].sum(axis=-2) for of in (self.columns, self.known, self.momentum))
        unknown = np.abs(np.einsum("csk,suk->csu", motions, columns) / self.sizes).max(axis=(1, 2), initial=0.0)
        power = np.abs(np.einsum("csk,sk->cs", motions, known)).max(axis=1)
        values = np.einsum("csk,sk->cs", motions, momentum)
        stays = (unknown < ABSENT) & (power < ABSENT * max(1.0, np.abs(self.known).max()))
        stays &= np.abs(values).max(axis=1) > ABSENT * max(1.0, np.abs(momentum).max())
        found = []
        for c in np.flatnonzero(stays):
            x, y, turn = motions[c, 0]
            if turns := bool(abs(turn) >= SAME_PLACE * np.linalg.norm(motions[c, 0])):
                x, y = given.origin + np.array([-y, x]) / turn * given.length
            bodies = tuple(given.bodies[i] for i in group)
            found.append(ConservedMomentum(bodies, tried[c], turns, (float(x), float(y)), self.elsewhere, values[c]))
        return found
