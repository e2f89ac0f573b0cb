"""The largest reaction of every joint, and when."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from freebody.results import Array, Signal, Window, refined

if TYPE_CHECKING:
    from freebody.run import Run


_ROUND_OFF = 1e-9  # of the largest of its kind: below it a reaction is what rounding left


@dataclass(frozen=True)
class Peak:
    """The largest force of a joint on ``body``: its size and components (N) at time ``t`` (s), and the largest
    couple (N·m) at ``t_couple``, None for a joint that passes none. An indeterminate reaction has no figures: they are None."""

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
    noise = couple_noise(sampled)
    return [_peak(run, sampled, i, name, noise) for i, name in enumerate(run.reactions)]


def couple_noise(run: Run) -> float:
    """The couple (N·m) up to which one is round-off, beside the largest couple and the largest force at its farthest place."""
    known = [reaction for reaction in run.reactions.values() if reaction.determinate]
    force, couple, far = (
        float(np.abs(values).max(initial=0)) for values in ([r.size for r in known], [r.M for r in known], run.poses[..., :2])
    )
    return _ROUND_OFF * max(couple, force * far)


def _peak(run: Run, sampled: Run, i: int, name: str, noise: float) -> Peak:
    reaction = sampled.reactions[name]
    if not reaction.determinate:
        return Peak(name, reaction.second, False)
    t, size = _largest(run, sampled.t, reaction.size, lambda t: np.hypot(*_solved(run, i, t)[:, :2].T))
    couple = t_couple = None
    if reaction.has_couple:
        heard = np.where(np.abs(reaction.M) > noise, np.abs(reaction.M), 0.0)
        t_couple, couple = _largest(run, sampled.t, heard, lambda t: np.abs(_solved(run, i, t)[:, 2]))
    force_x, force_y, _ = _solved(run, i, np.array([t]))[0].tolist()
    return Peak(name, reaction.second, True, t, size, force_x, force_y, couple, t_couple)


def _solved(run: Run, i: int, t: Array) -> Array:
    """The reaction (nt, 3) of the i-th joint at times within the run."""
    return run.motion.instants(t)[0][:, i]


def _largest(run: Run, t: Array, sampled: Array, signal: Signal) -> tuple[float, float]:
    if run.recorded or not sampled.any():
        i = int(sampled.argmax())
        return float(t[i]), float(sampled[i])
    return refined(signal, t, sampled, candidates=2)
