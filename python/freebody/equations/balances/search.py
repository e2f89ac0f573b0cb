"""The fewest unknowns that as many equations hold among themselves: exact, by deepening the number of equations."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from freebody.equations.balances.candidates import WORTH, Candidate, independent

Supports = Mapping[int, Sequence[Candidate]]


def smallest(by_support: Supports, wanted: int, accelerations: int) -> list[Candidate] | None:
    """The best of the smallest sets of equations that hold ``wanted`` (a bit) and no more unknowns than they are; None if
    every set has more than ``WORTH``."""
    for size in range(1, WORTH + 1):
        solved = (_solvable(by_support, unknowns, size, accelerations) for unknowns in grown(by_support, wanted, size, size))
        if best := min((found for found in solved if found), key=lambda found: set_cost(found, accelerations), default=None):
            return best
    return None


def grown(by_support: Supports, start: int, size: int, least: int = 0) -> Iterator[int]:
    """All sets of at least ``least`` and at most ``size`` unknowns that contain ``start`` and are put together from whole
    equations, each of which shares an unknown with what is there."""
    small = [support for support in by_support if support.bit_count() <= size]
    seen, edge = {start}, [start]
    while edge:
        unknowns = edge.pop()
        if unknowns.bit_count() >= least:
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


def plainest(equations: Sequence[Candidate], size: int, accelerations: int) -> list[Candidate] | None:
    """The first ``size`` independent equations in the order of plainness, or None if there are fewer."""
    chosen: list[Candidate] = []
    for equation in sorted(equations, key=lambda e: e.order(accelerations)):
        if independent([*chosen, equation]):
            chosen.append(equation)
            if len(chosen) == size:
                return chosen
    return None


def _solvable(by_support: Supports, unknowns: int, size: int, accelerations: int) -> list[Candidate] | None:
    equations = within(by_support, unknowns)
    return plainest(equations, size, accelerations) if len(equations) >= size else None


def set_cost(equations: Sequence[Candidate], accelerations: int) -> tuple[float, ...]:
    """What is less in the better of two sets: points of inertia, bodies, constructed points, condition number, accelerations, plainness."""
    orders = np.array([equation.order(accelerations) for equation in equations]).sum(axis=0)
    rows = np.array([equation.coefficients for equation in equations])
    condition = np.linalg.cond(rows[:, np.abs(rows).max(axis=0) > 0])
    return *map(float, orders[:3]), float(np.round(2 * np.log10(condition))), *map(float, orders[3:])
