"""The fewest unknowns that as many equations hold among themselves: exact, by deepening the number of equations."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from freebody.equations.balances.candidates import WORTH, Candidate, independent

Supports = Mapping[int, Sequence[Candidate]]


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
    solved = ((plainest(within(by_support, unknowns), size, accelerations), unknowns) for unknowns in sets)
    return min((found for found in solved if found[0]), key=lambda found: set_cost(found[0], accelerations), default=([], 0))


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


def plainest(equations: Sequence[Candidate], size: int, accelerations: int) -> list[Candidate]:
    """The first ``size`` independent equations in the order of plainness; none if there are fewer."""
    chosen: list[Candidate] = []
    for equation in sorted(equations, key=lambda e: e.order(accelerations)) if len(equations) >= size else ():
        if independent([*chosen, equation]):
            chosen.append(equation)
            if len(chosen) == size:
                return chosen
    return []


def set_cost(equations: Sequence[Candidate], accelerations: int) -> tuple[float, ...]:
    """What is less in the better of two sets: points of inertia, bodies, constructed points, condition number, accelerations, plainness."""
    orders = np.array([equation.order(accelerations) for equation in equations]).sum(axis=0)
    rows = np.array([equation.coefficients for equation in equations])
    condition = np.linalg.cond(rows[:, np.abs(rows).max(axis=0) > 0])
    return *map(float, orders[:3]), float(np.round(2 * np.log10(condition))), *map(float, orders[3:])
