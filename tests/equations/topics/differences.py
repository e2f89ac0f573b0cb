"""Linear equations of a mechanism by differences of the core's accelerations, on what is closed: nothing of them is symbolic."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from freebody.core import CompiledModel, State
from freebody.solve.perturbed_states import Closing

STEP, SHORTER = 1e-4, 0.1
"""rad and m; of accelerations a difference of fourth order leaves 1e-12, their round-off as much. A shorter step, where friction gives
way within the first."""
SAME = 1e-6
PASSES = 3
"""Each leaves the square of what the free coordinates are off."""


def tangent(source: CompiledModel, state: State, free: Sequence[str]) -> np.ndarray:
    """What all coordinates do for a unit of each of the free ones, by the rows of the core; a motion that prescribes an acceleration
    holds no place."""
    lawful = {motion["name"] for motion in source.spec["motions"] if motion["level"] == "acceleration"}
    names = [c["name"] for c in source.metadata["coordinates"]]
    rows = [[row.coefficients[name] for name in names] for row in source.free_bodies(state).rows if row.name not in lawful]
    held = np.array(rows).reshape(len(rows), len(names))
    _, sizes, directions = np.linalg.svd(held)
    ways = directions[int((sizes > 1e-9 * sizes.max(initial=0.0)).sum()) :].T
    assert ways.shape[1] == len(free), f"{ways.shape[1]} perturbations are free, not {', '.join(free)}"
    return ways @ np.linalg.inv(ways[[names.index(name) for name in free]])


def slope(of: Callable[[float], np.ndarray]) -> np.ndarray:
    """The derivative at 0, of fourth order, by the longest step that a shorter one confirms."""

    def by(h: float) -> np.ndarray:
        return (8 * (of(h) - of(-h)) - (of(2 * h) - of(-2 * h))) / (12 * h)

    long, short = by(STEP), by(SHORTER * STEP)
    return long if np.abs(long - short).max() <= SAME * max(1.0, np.abs(short).max()) else short


def first_order(source: CompiledModel, state: State, free: Sequence[str]) -> np.ndarray:
    """A of ż = A z at a place of rest, z being the free perturbations and their rates."""
    names = [c["name"] for c in source.metadata["coordinates"]]
    places, ways = [names.index(name) for name in free], tangent(source, state, free)
    closing = Closing(source, state, source.free_bodies(state))

    def moved(way: np.ndarray) -> np.ndarray:
        """What is closed is closed from one side or the other, and the free ones are brought back to where they were to be."""
        q = state.q + way
        for _ in range(PASSES):
            placed = closing.place(q)
            assert placed is not None, "what is closed does not stay so"
            q = placed + ways @ (state.q + way - placed)[places]
        return placed

    def beside(way: np.ndarray, rates: bool) -> np.ndarray:
        def accelerations(h: float) -> np.ndarray:
            q = state.q if rates else moved(h * way)
            return source.instant(replace(state, q=q, u=h * way if rates else np.zeros_like(way))).accelerations[places]

        return slope(accelerations)

    n = len(free)
    below = np.array([beside(way, rates) for rates in (False, True) for way in ways.T]).reshape(2 * n, n).T
    return np.vstack([np.hstack([np.zeros((n, n)), np.eye(n)]), below])
