"""Reactions that the balances leave open: one admissible set of them at random, for statements that must hold for all."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from freebody import _core
from freebody.instant import State
from freebody.results import Array, quote

_SINGULAR = 1e-9  # of the largest singular value: below it a combination of loads moves nothing


def admissible(core: _core.Mechanism, state: State, rng: np.random.Generator, size: float) -> dict[str, float]:
    """Values of the reactions that are not determined, by their names in the model: those of least norm and, ``size`` times
    as large as they, a random self-stress."""
    told = json.loads(core.free_bodies(state.p, state.t, state.q, state.u))
    loads = [load for load in told["loads"] if load["unknown"]]
    if all(load["determinate"] for load in loads):
        return {}
    columns = np.array([_effect(load, [b["name"] for b in told["bodies"]]) for load in loads]).T
    _, sizes, rows = np.linalg.svd(columns)
    free = rows[np.sum(sizes > _SINGULAR * sizes.max()) :]
    values = np.array([load["value"] or 0.0 for load in loads])
    values = values + size * (np.abs(values).max() + 1.0) * (free.T @ rng.uniform(-1, 1, len(free)))
    pairs = zip(loads, values, strict=True)
    return {load["symbol"]: float(value) for load, value in pairs if not load["determinate"]}


def _effect(load: Mapping[str, Any], bodies: Sequence[str]) -> Array:
    """Force and moment about the origin of a unit load on every body, the ground left out."""
    out = np.zeros((len(bodies), 3))
    for part in load["on"]:
        if part["body"] in bodies:
            (x, y), (fx, fy) = part["point"], part["force"]
            out[bodies.index(part["body"])] += fx, fy, part["couple"] + x * fy - y * fx
    return out.ravel()


def written_out(text: str, values: Mapping[str, float]) -> str:
    """An expression with numbers for the reactions of which values are given."""
    for symbol, value in values.items():
        for name in {symbol, f"{quote(symbol.rpartition('.')[0])}.{symbol.rpartition('.')[2]}"}:
            text = re.sub(rf"(?<![\w.]){re.escape(name)}(?![\w.])", f"({value!r})", text)
    return text
