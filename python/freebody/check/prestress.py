"""Reactions that the balances leave open: one admissible set of them at random, for statements that must hold for all."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import numpy as np

from freebody.core import Array, CompiledModel, Load, State, quote

_SINGULAR = 1e-9  # of the largest singular value: below it a combination of loads moves nothing


def admissible(core: CompiledModel, state: State, rng: np.random.Generator, size: float) -> dict[str, float]:
    """Values of the reactions that are not determined, by their names in the model: those of least norm and, ``size`` times
    as large as they, a random self-stress."""
    free_bodies = core.free_bodies(state)
    loads = [load for load in free_bodies.loads if load.unknown]
    if all(load.determinate for load in loads):
        return {}
    columns = np.array([_effect(load, list(free_bodies.bodies)) for load in loads]).T
    _, sizes, rows = np.linalg.svd(columns)
    free = rows[np.sum(sizes > _SINGULAR * sizes.max()) :]
    values = np.nan_to_num([load.value for load in loads])
    values = values + size * (np.abs(values).max() + 1.0) * (free.T @ rng.uniform(-1, 1, len(free)))
    pairs = zip(loads, values, strict=True)
    return {load.symbol: float(value) for load, value in pairs if not load.determinate}


def _effect(load: Load, bodies: Sequence[str]) -> Array:
    """Force and moment about the origin of a unit load on every body, the ground left out."""
    out = np.zeros((len(bodies), 3))
    for part in load.on:
        if part.body in bodies:
            out[bodies.index(part.body)] += part.wrench()
    return out.ravel()


def written_out(text: str, values: Mapping[str, float]) -> str:
    """An expression with numbers for the reactions of which values are given."""
    for symbol, value in values.items():
        for name in {symbol, f"{quote(symbol.rpartition('.')[0])}.{symbol.rpartition('.')[2]}"}:
            text = re.sub(rf"(?<![\w.]){re.escape(name)}(?![\w.])", f"({value!r})", text)
    return text
