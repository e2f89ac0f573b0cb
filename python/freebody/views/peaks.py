"""The largest reaction of every joint, and when."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from freebody.results import Window, refined

if TYPE_CHECKING:
    from freebody.run import Run


@dataclass(frozen=True)
class Peak:
    """The largest force of a joint on ``body``: its size and components (N) at time ``t`` (s), and the largest
    couple (N·m) at ``t_couple``. An indeterminate reaction has no figures: they are None."""

    joint: str
    body: str
    determinate: bool
    t: float | None = None
    size: float | None = None
    Fx: float | None = None
    Fy: float | None = None
    couple: float | None = None
    t_couple: float | None = None


def peak_reactions(run: Run) -> list[Peak]:
    """Peaks of all joints, refined between the steps where the motion is known there."""
    sampled = run if run.recorded else run.at(Window(run.edges).samples())
    return [_peak(run, sampled, name) for name in run.reactions]


def _peak(run: Run, sampled: Run, name: str) -> Peak:
    reaction = sampled.reactions[name]
    if not reaction.determinate:
        return Peak(name, reaction.second, False)
    t, size = _largest(run, sampled, name, "size")
    t_couple, couple = _largest(run, sampled, name, "M")
    then = run.at([t]).reactions[name]
    return Peak(name, reaction.second, True, t, size, float(then.Fx[0]), float(then.Fy[0]), couple, t_couple)


def _largest(run: Run, sampled: Run, name: str, part: str) -> tuple[float, float]:
    values = np.abs(getattr(sampled.reactions[name], part))
    if run.recorded or not values.any():
        i = int(values.argmax())
        return float(sampled.t[i]), float(values[i])
    return refined(lambda t: np.abs(getattr(run.at(t).reactions[name], part)), sampled.t, values, candidates=2)
