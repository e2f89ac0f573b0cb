"""What a periodic motion tends to as a parameter tends to 0, such as a mass that is left out: by extrapolation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from freebody.core import Array
from freebody.periodic.motion import by_size, find
from freebody.periodic.return_map import ReturnMap

_TERMS = 8


@dataclass(frozen=True)
class Limit:
    """The values of the unknowns, the period (s) and the multipliers in the limit; ``error`` estimates their error, it does not bound it:
    the largest difference of the last two extrapolations of values, period and derivative, relative to the largest of each."""

    values: Mapping[str, float]
    period: float
    multipliers: NDArray[np.complex128]
    error: float


def limit(returns: ReturnMap, parameter: str, first: float, start: Sequence[float] | Array, **others: Any) -> Limit:
    """The periodic motion near ``start`` as a parameter tends to 0 from ``first``: it is halved, each motion is sought from the one
    before, and the polynomial through all of them is read at 0 (Neville; Stoer & Bulirsch, *Introduction to Numerical Analysis*,
    §2.1.2). It must depend on the parameter smoothly."""
    place, found = np.asarray(start, float), []
    at = first * 0.5 ** np.arange(_TERMS)
    for value in at.tolist():
        motion = find(returns, place, **{**others, parameter: value})
        place = motion.start
        found.append(np.concatenate([place, [motion.period], motion.slopes.ravel()]))
    columns = [np.array(found)]
    for order in range(1, _TERMS):
        part = (at[order:] / (at[:-order] - at[order:]))[:, None]
        columns.append(columns[-1][1:] + part * (columns[-1][1:] - columns[-1][:-1]))
    k, best, before = len(place), columns[-1][-1], columns[-2][-1]
    multipliers = by_size(np.linalg.eigvals(best[k + 1 :].reshape(k, k)))
    parts = [slice(0, k), slice(k, k + 1), slice(k + 1, None)]
    error = max(float(np.abs(best - before)[part].max() / (np.abs(best[part]).max() or 1.0)) for part in parts)
    return Limit(dict(zip(returns.unknowns, best[:k].tolist(), strict=True)), float(best[k]), multipliers, error)
