"""Small vibrations that something harmonic forces, in the steady state (Thomson, Theory of Vibration, chapters 3 and 5)."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import Array, State, quote

if TYPE_CHECKING:
    from .asked_model import AskedModel

_TIMES = np.array([0.13, 0.71, 1.6, 2.3, 3.7, 4.1, 5.9, 7.7])
"""When accelerations are looked at, in times typical of the model: at no even spacing, so that no harmonic is taken for another."""
_HARMONIC = re.compile(r"\b(sin|cos)\(\s*[^\W\d]\w*\s*\*\s*t\s*\)")
_OF_TIME = re.compile(r"\b(?:sin|cos)\([^()]*(?<![.\w])t(?![.\w])[^()]*\)")
"""``sin(Ω*t)``, and any other that changes with time."""
_PART = 1e-3  # of the drive, by which its slope is taken, to fourth order
_PURE = 1e-8  # of the harmonic, that may be left beside it


def forced_vibrations(
    model: AskedModel, rest: State, a: Array, free: Sequence[str], values: Mapping[str, float], drive: str
) -> dict[str, complex]:
    """The amplitudes of the ``free`` coordinates, in m or rad, in the steady state about a place of ``rest``, to first order in the
    parameter ``drive``, at the ``values`` of all: X = (iΩ − A)⁻¹ (0, f), where d(x, ẋ)/dt = A (x, ẋ), shape (2n, 2n), are the linear
    equations at rest and f e^{iΩt}, f of shape (n,), are the accelerations that the drive gives there. Ω is the parameter with which these
    are harmonic, beside a mean; nothing is returned where none is. The phase of each, negative where it lags, is that from what drives: the
    sine or cosine in the model, or else its force."""

    def at(part: float, late: float) -> State:
        p = model.core.bind({**model.free_parameters, **values, drive: part * values[drive]})
        return model.moved(rest, rest.q, {}, t=rest.t + late, p=p)

    falls, late = [f"accel({quote(name)})" for name in free], _TIMES / model.rate

    def slope(part: float) -> Array:
        more, less = (np.array([model.core.evaluate(falls, at(way * part, t)) for t in late]) for way in (1, -1))
        return (more - less) / (2 * part)

    def harmonic(frequency: float) -> tuple[float, float, Array]:
        """What is left of the accelerations beside a mean and a harmonic, its frequency, and its complex amplitudes."""
        basis = np.array([np.ones(len(late)), np.cos(frequency * late), np.sin(frequency * late)]).T
        found = np.linalg.lstsq(basis, given, rcond=None)[0]
        return float(np.abs(given - basis @ found).max()), frequency, found[1] - 1j * found[2]

    given = (4 * slope(_PART / 2) - slope(_PART)) / 3
    left, frequency, force = min(map(harmonic, {abs(x) for x in values.values() if x}), key=lambda each: each[0])
    if not force.any() or left > _PURE * np.abs(force).max():
        return {}
    found = np.linalg.solve(1j * frequency * np.eye(len(a)) - a, np.concatenate([np.zeros(len(free)), force]))[: len(free)]
    return dict(zip(free, (found / (_phase(model) or _direction(force))).tolist(), strict=True))


def _phase(model: AskedModel) -> complex | None:
    """1 where all that drives a model is cosines of Ωt, −i where it is sines; None where there are others."""
    written = json.dumps([model.spec[part] for part in ("forces", "motions")], ensure_ascii=False)
    named, every = _HARMONIC.findall(written), _OF_TIME.findall(written)
    return {"cos": 1.0 + 0j, "sin": -1j}[named[0]] if len({*named}) == 1 and len(named) == len(every) else None


def _direction(force: Array) -> complex:
    """The phase of the largest force, as a number of size 1."""
    largest = force[np.abs(force).argmax()]
    return complex(largest / abs(largest))
