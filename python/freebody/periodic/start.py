"""How a start follows from the unknowns of a return map: parameters, coordinates, ``rate(coordinate)``."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import Array, State, quote
from freebody.model.errors import ModelProblem

if TYPE_CHECKING:
    from freebody.model.start import Start
    from freebody.periodic.variation import VectorField

_RATE = re.compile(r"rate\((.+)\)")
_DEPENDENT = 1e-10
"""Part of the largest singular value below which the start leaves a direction open."""


def changes(unknowns: Sequence[str], values: Array, others: Mapping[str, Any]) -> dict[str, Any]:
    """Unknowns and ``others`` as changes of a start."""
    found, rates = dict(others), dict(others.get("rates", {}))
    for name, value in zip(unknowns, values.tolist(), strict=True):
        if of := _RATE.fullmatch(name):
            rates[of[1].strip("'")] = value
        else:
            found[name] = value
    return found | ({"rates": rates} if rates else {})


def slopes(
    field: VectorField, start: Start, state: State, unknowns: Sequence[str], others: Mapping[str, Any]
) -> tuple[Array, Array]:
    """Derivatives by the unknowns of coordinates, rates and own states at the start (2n + nz, k), and of parameters (1 + np, k; the
    first row, of the clock, is 0). Raises ``ModelProblem`` where the start leaves something open."""
    source, n, k = field.source, len(state.q), len(unknowns)
    parameters = [parameter["name"] for parameter in source.metadata["parameters"]]
    by = np.array([[float(name == unknown) for unknown in unknowns] for name in ["", *parameters]]).reshape(-1, k)
    stated = {quote(name): text for name, text in start.fixed.items()}
    stated |= {f"rate({quote(name)})": text for name, text in start.rates.items()}
    stated |= {quote(name): None for name in others if name in start.fixed}
    stated |= {f"rate({quote(name)})": None for name in others.get("rates", {})}
    mine = {(f"rate({quote(of[1].strip(chr(39)))})" if (of := _RATE.fullmatch(name)) else quote(name)): i
            for i, name in enumerate(unknowns) if name not in parameters}  # fmt: skip
    rows, right = [], []
    for row in source.row_derivatives(state):
        for held in (row.value, row.rate):
            if held is not None:
                rows.append(held[1 : 1 + 2 * n])
                right.append(-np.delete(held, np.s_[1 : 1 + 2 * n]) @ by)
    for reading in {**stated, **mine}:
        of = source.derivatives([reading], state)[0]
        if reading in mine:
            asked = np.eye(k)[mine[reading]]
        else:
            text = stated[reading]
            asked = np.zeros(k) if text is None else source.derivatives([str(text)], state)[0, 1 + 2 * n :] @ by[1:]
        rows.append(of[1 : 1 + 2 * n])
        right.append(asked - np.delete(of, np.s_[1 : 1 + 2 * n]) @ by)
    matrix, right = np.array(rows), np.array(right)
    scale = np.linalg.norm(matrix, axis=1)
    used = scale > 0
    matrix, right = matrix[used] / scale[used, None], right[used] / scale[used, None]
    found, _, rank, _ = np.linalg.lstsq(matrix, right, rcond=_DEPENDENT)
    if rank < 2 * n:
        names = ", ".join(f"`{each['name']}`" for each in source.metadata["coordinates"])
        raise ModelProblem(
            f"the unknowns {', '.join(unknowns)} and `initial` do not say the whole start, the rates included, of {names}",
            "give what is missing in `initial` and its `rates`, or as an unknown",
        )
    own = [1 + i for i in field.own]
    found, by[own] = np.vstack([found, by[own]]), 0.0
    return found, by
