"""The largest reaction of every joint, contact, string, stop and lock, and when."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import quote
from freebody.run.records import Array, Signal, Window, refined

if TYPE_CHECKING:
    from freebody.run.simulation import Run


_ROUND_OFF = 1e-9  # of the largest of its kind: below it a reaction is what rounding left


@dataclass(frozen=True)
class Peak:
    """The largest force of a joint, contact, string, stop or lock on ``body``: its size and components (N) at time ``t`` (s), and the
    largest couple (N·m) at ``t_couple``, None for what passes none. An indeterminate reaction has no figures: they are None."""

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
    """Peaks of all that can carry a load, refined between the steps where the motion is known there."""
    sampled = run if run.recorded else run.at(Window(run.edges).samples())
    noise = couple_noise(sampled)
    joints = [_peak(run, sampled, i, name, noise) for i, (name, reaction) in enumerate(run.reactions.items()) if reaction.carries]
    limits = [_peak_of_limit(run, sampled, limit) for limit in run.about["limits"]]
    return joints + limits + [_peak_of_lock(run, sampled, lock) for lock in run.about["locks"]]


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


def _peak_of_limit(run: Run, sampled: Run, limit: Mapping[str, Any]) -> Peak:
    """The largest force of a contact, string or stop on its first body; of a stop of an angle the largest couple."""
    name, own = limit["name"], quote(limit["name"])
    texts = {"contact": [f"{own}.N", f"{own}.T"], "string": [f"{own}.tension"], "stop": [f"{own}.N"]}[limit["type"]]
    size = np.hypot.reduce(sampled.motion.evaluate(texts, sampled.t), axis=1)
    if np.isnan(size).any():
        return Peak(name, limit["first"], False)
    t, largest = _largest(run, sampled.t, size, lambda t: np.hypot.reduce(run.motion.evaluate(texts, t), axis=1))
    if limit["dimension"] == "rad":
        return Peak(name, limit["first"], True, couple=largest, t_couple=t)
    if run.recorded or limit["type"] == "stop":
        return Peak(name, limit["first"], True, t, largest)
    force = run.motion.evaluate([f"{own}.Fx", f"{own}.Fy"], np.array([t]))[0]
    return Peak(name, limit["first"], True, t, largest, *force.tolist())


def _peak_of_lock(run: Run, sampled: Run, lock: Mapping[str, Any]) -> Peak:
    """The largest force, or couple, along what a lock holds."""
    name, text = lock["name"], f"{quote(lock['name'])}.force"

    def size(motion: Any, t: Array) -> Array:
        return np.abs(motion.evaluate([text], t)[:, 0])

    sizes = size(sampled.motion, sampled.t)
    if np.isnan(sizes).any():
        return Peak(name, lock["second"], False)
    t, largest = _largest(run, sampled.t, sizes, lambda t: size(run.motion, t))
    if lock["turns"]:
        return Peak(name, lock["second"], True, couple=largest, t_couple=t)
    return Peak(name, lock["second"], True, t, largest)


def _solved(run: Run, i: int, t: Array) -> Array:
    """The reaction (nt, 3) of the i-th joint at times within the run."""
    return run.motion.instants(t)[0][:, i]


def _largest(run: Run, t: Array, sampled: Array, signal: Signal) -> tuple[float, float]:
    if run.recorded or not sampled.any():
        i = int(sampled.argmax())
        return float(t[i]), float(sampled[i])
    return refined(signal, t, sampled, candidates=2)
