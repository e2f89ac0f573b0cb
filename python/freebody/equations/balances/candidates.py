"""Every balance equation that could be of use, each named by the unknowns that stay in it; and the fewest unknowns that as many of
them hold among themselves: exact, by deepening the number of equations."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from freebody.core import Array
from freebody.equations.balances.system import Group, Problem, groups
from freebody.equations.balances.virtual_motions import (
    NamedPoints,
    VirtualMotion,
    clear_shifts,
    mass_centre,
    named_motions,
    pair_motions,
)
from freebody.solve.perturbed_states import independent

ABSENT = 1e-9
"""Work of an unknown over that of its size in a motion, below which it drops out; it must do so at every state."""
WORTH = 4
"""Unknowns beyond which a set of equations is no longer small."""


@dataclass(frozen=True)
class Candidate:
    """The balance of a group along a virtual motion. ``support`` and ``coefficients`` (nu,) say which unknowns are in it; ``row``
    are these over what a unit of each unknown does at most, so that newtons and kilograms compare."""

    group: Group
    twist: VirtualMotion
    support: int
    coefficients: Array = field(repr=False)
    row: Array = field(repr=False)
    right: float

    def order(self, accelerations: int) -> tuple[int, ...]:
        """Where it stands among its like: no point to construct, fewer bodies, fewer accelerations (as bits), plainer."""
        return bool(self.twist.pair), len(self.group), (self.support & accelerations).bit_count(), self.twist.rank


Supports = Mapping[int, Sequence[Candidate]]


def candidates(problem: Problem, points: NamedPoints, counted: int) -> tuple[dict[int, list[Candidate]], bool]:
    """All equations with at most ``WORTH`` of the unknowns ``counted`` (bits) by what is unknown in them; of those with the same
    unknowns the plainest that are independent; and whether every connected set of bodies was tried."""
    sets, exact = groups(problem)
    named = named_motions(problem, points)
    accelerations = bits(i for i, unknown in enumerate(problem.unknowns) if unknown.coordinate)
    found = [candidate for group in sets for candidate in of_group(problem, group, named, counted)]
    by_support: dict[int, list[Candidate]] = {}
    for candidate in sorted(found, key=lambda candidate: candidate.order(accelerations)):
        by_support.setdefault(candidate.support, []).append(candidate)
    return {support: plainest(alike, accelerations) for support, alike in by_support.items()}, exact


def bits(places: Iterable[int]) -> int:
    """The places as one number."""
    return sum(1 << int(i) for i in places)


def plainest(equations: Sequence[Candidate], accelerations: int) -> list[Candidate]:
    """Those that do not follow from plainer ones at the state asked for, in the order of plainness; what is round-off there, as moments
    about a point at which all is just now, is no equation."""
    ordered = sorted(equations, key=lambda equation: equation.order(accelerations))
    rows = np.array([equation.row for equation in ordered])
    sizes = np.linalg.norm(rows, axis=1, keepdims=True)
    return [ordered[i] for i in independent(np.where(sizes > ABSENT, rows, 0.0) / np.where(sizes > 0, sizes, 1.0))]


def of_group(problem: Problem, group: Group, named: Sequence[VirtualMotion], counted: int) -> list[Candidate]:
    """The equations of a set of bodies along ``named`` motions and those that its loads give."""
    members = list(group)
    columns = np.array([system.columns[:, members].sum(axis=1) for system in problem.systems])
    sizes = np.max([np.linalg.norm(system.columns, axis=2).max(axis=1) for system in problem.systems], axis=0)
    columns = np.where(np.linalg.norm(columns, axis=2, keepdims=True) > ABSENT * sizes[:, None], columns, 0.0)
    boundary = np.flatnonzero(np.abs(columns).max(axis=(0, 2)) > 0)
    shifts = clear_shifts(problem, columns, boundary)
    loads = [i for i in boundary if problem.load(problem.unknowns[i])]
    tried = [*named, *pair_motions(columns, loads), mass_centre(problem, group), *shifts]
    motions = np.array([each.motion for each in tried])
    work = np.einsum("csk,suk->csu", motions, columns)
    reach = np.linalg.norm(motions, axis=2)[:, :, None] * sizes
    generic = slice(1, None) if len(problem.systems) > 1 else slice(None)
    stays = (np.abs(work) > ABSENT * reach)[:, generic].any(axis=1)
    asked = np.array([counted >> i & 1 for i in range(len(problem.unknowns))], bool)
    use = stays.any(axis=1) & ((stays & asked).sum(axis=1) <= WORTH)
    right = motions[:, 0] @ problem.systems[0].right[members].sum(axis=0)
    made, units = np.where(stays, work[:, 0], 0.0), np.where(sizes > 0, sizes, 1.0)
    return [
        Candidate(group, tried[c], bits(np.flatnonzero(stays[c])), made[c], made[c] / units, right[c])
        for c in np.flatnonzero(use)
    ]


def smallest(by_support: Supports, wanted: int, accelerations: int) -> list[Candidate]:
    """The best of the smallest sets of equations that hold ``wanted`` (a bit) and no more unknowns than they are; none if
    every set has more than ``WORTH``."""
    for size in range(1, WORTH + 1):
        if found := best(by_support, grown(by_support, wanted, size), size, accelerations)[0]:
            return found
    return []


def best(by_support: Supports, sets: Iterator[int] | Sequence[int], size: int, accelerations: int) -> tuple[list[Candidate], int]:
    """The best ``size`` independent equations that hold no unknown outside one of some sets, and that set; none where no set has
    as many."""
    held = ((within(by_support, unknowns), unknowns) for unknowns in sets)
    solved = ((plainest(equations, accelerations)[:size], unknowns) for equations, unknowns in held if len(equations) >= size)
    enough = (found for found in solved if len(found[0]) == size)

    def cost(found: tuple[list[Candidate], int]) -> tuple[float, ...]:
        """Constructed points, bodies, condition number, accelerations, plainness."""
        orders = np.array([equation.order(accelerations) for equation in found[0]]).sum(axis=0)
        rows = np.array([equation.row for equation in found[0]])
        condition = np.linalg.cond(rows[:, np.abs(rows).max(axis=0) > 0])
        return *map(float, orders[:2]), float(np.round(2 * np.log10(condition))), *map(float, orders[2:])

    return min(enough, key=cost, default=([], 0))


def grown(by_support: Supports, start: int, size: int) -> Iterator[int]:
    """All sets of ``size`` unknowns that contain ``start`` and are put together from whole equations, each of which shares an
    unknown with what is there."""
    small = [support for support in by_support if support.bit_count() <= size]
    seen, edge = {start}, [start]
    while edge:
        unknowns = edge.pop()
        if unknowns.bit_count() >= size:
            yield unknowns
        for support in small:
            more = unknowns | support
            if more not in seen and more.bit_count() <= size and (unknowns & support or not unknowns):
                seen.add(more)
                edge.append(more)


def unions(by_support: Supports, size: int) -> list[int]:
    """All sets of ``size`` unknowns that are put together from whole equations, those of the last unknowns first."""
    made = {0}
    for support in by_support:
        made |= {more for unknowns in made if (more := unknowns | support).bit_count() <= size}
    return sorted((unknowns for unknowns in made if unknowns.bit_count() == size), reverse=True)


def within(by_support: Supports, unknowns: int) -> list[Candidate]:
    """The equations with no unknown outside a set."""
    found, part = list(by_support.get(0, ())), unknowns
    while part:
        found += by_support.get(part, ())
        part = (part - 1) & unknowns
    return found
