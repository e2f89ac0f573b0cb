"""Laws of time for a motion, in the words of the model file, and the mechanism in which they are prescribed."""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.linalg

from freebody.core import Array, MotionError
from freebody.inverse.virtual_motions import allowed
from freebody.model import units
from freebody.model.errors import ModelFileError, ModelProblem
from freebody.model.names import suggestion

if TYPE_CHECKING:
    from freebody.model.builder import Builder


@dataclass(frozen=True, eq=False)
class Recording:
    """Places ``y`` (nt,) of a gauge at times ``t`` (nt,), s, in SI; between them the cubic spline that has no curvature at its ends.
    Its accelerations are those of the spline: what is noisy is to be smoothed before."""

    t: Array
    y: Array


Law = float | str | Mapping[str, Any] | Recording
"""An expression of t for the place, the words of a motion, ``{"is": "20 rad/s", "level": "velocity"}``, or a recording."""


def quintic(start: Any, end: Any, duration: Any, begin: Any = 0) -> str:
    """The law that leads from rest at one value to rest at another: s = 10τ³ − 15τ⁴ + 6τ⁵ with τ = (t − ``begin``)/``duration``,
    without acceleration at either end, at rest before and after. Values and times are numbers, quantities or expressions of
    parameters. Craig, *Introduction to Robotics*, 7.3."""
    part = f"min(1, max(0, (t - ({begin}))/({duration})))"
    return f"({start}) + (({end}) - ({start}))*({part}^3*(10 + {part}*(6*{part} - 15)))"


def steady(speed: Any) -> dict[str, Any]:
    """The law of a constant speed, from where the mechanism starts."""
    return {"is": speed, "level": "velocity"}


_HEAD = re.compile(r"(.*?)\s*(?:\[(.*)\])?")


def recorded(path: str | Path, column: str, unit: str | None = None, time: str = "t") -> Recording:
    """A motion that was recorded: a ``column`` of a CSV file over that of the ``time``. Heads are names, with units in brackets where
    numbers are not SI, ``angle [deg]``, as freebody writes them; ``unit`` overrules. Raises ``ModelProblem``."""
    with Path(path).open(encoding="utf-8-sig", newline="") as stream:
        head, *rows = [row for row in csv.reader(stream) if any(cell.strip() for cell in row)] or [[]]
    heads = [_HEAD.fullmatch(cell.strip()).groups() for cell in head]
    names = [name for name, _ in heads]
    found = []
    for name, stated in ((time, None), (column, unit)):
        if name not in names:
            raise ModelProblem(f"`{path}` has no column `{name}`", suggestion(name, names))
        place = names.index(name)
        size = float(units.unit(stated or heads[place][1] or "").size)
        try:
            found.append(size * np.array([float(row[place]) for row in rows]))
        except (ValueError, IndexError):
            raise ModelProblem(f"the column `{name}` of `{path}` holds what is no number", "leave rows without one out") from None
    t, y = found
    if len(t) < 2 or (np.diff(t) <= 0).any():
        raise ModelProblem(f"the times of `{path}` do not grow", "a motion needs two rows or more, in the order of time")
    return Recording(t, y)


def prescribed(
    mechanism: Builder, motion: Mapping[str, Law], given: Mapping[str, Any] | None, t: float, changes: Mapping[str, Any]
) -> tuple[Builder, dict[str, Any]]:
    """A copy of a mechanism with a motion prescribed, by gauge, and its start in the words of ``initial``. Where the motion says the
    places, those of the model's start are only where they are looked for first; of the other coordinates those stay where they are
    that can, first those of which the motion says the rate."""
    driven, levels = mechanism.copy(), dict[str, str]()
    for gauge, law in motion.items():
        name = " ".join(["motion of", *re.findall(r"\w+", gauge)])
        words = dict(law) if isinstance(law, Mapping) else {"is": law}
        if isinstance(law, Recording):
            table = re.sub(r"\W", "_", name)
            driven.put("tables", table, {"x": law.t.tolist(), "y": law.y.tolist(), "interpolation": "spline"})
            words = {"is": f"{table}(t)"}
        driven.put("motions", name, {"of": gauge, **words})
        levels[gauge] = words.get("level", "position")
    start = mechanism.lowered().start
    initial: dict[str, Any] = {
        "guess": start.guess,
        "points": start.points,
        "branch": {text: "positive" if sign > 0 else "negative" for text, sign in start.branch.items()},
        "rates": start.rates if set(levels.values()) == {"acceleration"} else {},
    }
    if given is not None or "position" not in levels.values():
        return driven, initial | start.fixed if given is None else dict(given)
    initial |= {"points": {}, "guess": start.guess | start.fixed}
    if set(levels.values()) != {"position"}:
        here = dict(zip(mechanism.compile().coordinate_names, mechanism.start(None, t, **changes)[0].q.tolist(), strict=True))
        for name in sorted(here, key=lambda name: levels.get(name, "position") == "position"):
            try:
                driven.start({**initial, name: here[name]}, t, **changes)
                initial[name] = here[name]
            except (MotionError, ModelFileError):  # it moves as the places ask
                continue
    return driven, initial


def rest(mechanism: Builder, initial: Mapping[str, Any] | None, t: float, changes: Mapping[str, Any]) -> dict[str, Law]:
    """The motion that keeps the start of a mechanism at rest: as many coordinates as it has freedoms stand still."""
    state, _ = mechanism.start(initial, t, **changes)
    with mechanism.core_errors():
        motions = allowed(mechanism.compile(), mechanism.compile().free_bodies(state))
    _, _, order = scipy.linalg.qr(motions.T, pivoting=True)
    names = [c["name"] for c in mechanism.compile().metadata["coordinates"]]
    return {names[i]: steady(0) for i in np.sort(order[: motions.shape[1]])}
