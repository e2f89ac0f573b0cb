"""Laws of time for a motion, in the words of the model file, and the mechanism in which they are prescribed."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.linalg

from freebody.inverse.virtual_motions import allowed

if TYPE_CHECKING:
    from freebody.model.builder import Builder

Law = float | str | Mapping[str, Any]
"""An expression of t for the place, or the words of a motion: ``{"is": "20 rad/s", "level": "velocity"}``."""


def quintic(start: Any, end: Any, duration: Any, begin: Any = 0) -> str:
    """The law that leads from rest at one value to rest at another: s = 10τ³ − 15τ⁴ + 6τ⁵ with τ = (t − ``begin``)/``duration``,
    without acceleration at either end, at rest before and after. Values and times are numbers, quantities or expressions of
    parameters. Craig, *Introduction to Robotics*, 7.3."""
    part = f"min(1, max(0, (t - ({begin}))/({duration})))"
    return f"({start}) + (({end}) - ({start}))*({part}^3*(10 + {part}*(6*{part} - 15)))"


def steady(speed: Any) -> dict[str, Any]:
    """The law of a constant speed, from where the mechanism starts."""
    return {"is": speed, "level": "velocity"}


def prescribed(mechanism: Builder, motion: Mapping[str, Law]) -> tuple[Builder, dict[str, Any]]:
    """A copy of a mechanism with a motion prescribed, by gauge, and its start in the words of ``initial``. Where the motion says the
    places, those of the model's start are only where they are looked for first."""
    driven, levels = mechanism.copy(), set()
    for gauge, law in motion.items():
        words = dict(law) if isinstance(law, Mapping) else {"is": law}
        driven.put("motions", " ".join(["motion of", *re.findall(r"\w+", gauge)]), {"of": gauge, **words})
        levels.add(words.get("level", "position"))
    start = mechanism.lowered().start
    placed = "position" in levels
    initial: dict[str, Any] = {
        "guess": start.guess | (start.fixed if placed else {}),
        "points": {} if placed else start.points,
        "branch": {text: "positive" if sign > 0 else "negative" for text, sign in start.branch.items()},
        "rates": start.rates if levels == {"acceleration"} else {},
    }
    return driven, initial | ({} if placed else start.fixed)


def rest(mechanism: Builder, initial: Mapping[str, Any] | None, t: float, changes: Mapping[str, Any]) -> dict[str, Law]:
    """The motion that keeps the start of a mechanism at rest: as many coordinates as it has freedoms stand still."""
    state, _ = mechanism.start(initial, t, **changes)
    with mechanism.core_errors():
        motions = allowed(mechanism.compile(), mechanism.compile().free_bodies(state))
    _, _, order = scipy.linalg.qr(motions.T, pivoting=True)
    names = [c["name"] for c in mechanism.compile().metadata["coordinates"]]
    return {names[i]: steady(0) for i in np.sort(order[: motions.shape[1]])}
