"""The largest reaction of every joint, contact, string, stop, lock and prescribed motion, and when."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import Array, quote
from freebody.run.records import Signal, refined
from freebody.solve.figures import Known

if TYPE_CHECKING:
    from freebody.core import Motion
    from freebody.run.simulation import Run


_ROUND_OFF = 1e-9  # of the largest of its kind: below it a reaction is what rounding left


@dataclass(frozen=True)
class Peak:
    """The largest force of a joint, contact, string, stop, lock or prescribed motion on ``body`` (empty for a motion, which may act on
    several): its size and components (N) at time ``t`` (s), and the largest couple (N·m) at ``t_couple``, None for what passes none.
    An indeterminate reaction has no figures: they are None."""

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
    sampled = run.closely
    noise = couple_noise(sampled)
    peaks = [
        _peak(run, sampled, i, name, noise) for i, (name, reaction) in enumerate(sampled.reactions.items()) if reaction.carries
    ]
    return peaks + [_peak_of_part(run, sampled, *part) for part in _parts(run)]


def _parts(run: Run) -> Iterator[tuple[str, str, list[str], bool, list[str]]]:
    """Of contacts, strings, stops, locks and motions: the name, the body that the force acts on, expressions of the components of the
    force, whether it is a couple, and expressions of the components in the fixed axes."""
    for limit in run.metadata["limits"]:
        name, turns = limit["name"], limit["dimension"] == "rad"
        parts = {"contact": ["N", "T"], "string": ["tension"], "stop": ["N"]}[limit["type"]]
        axes = [] if limit["type"] == "stop" else ["Fx", "Fy"]
        yield name, limit["first"], [f"{quote(name)}.{part}" for part in parts], turns, [f"{quote(name)}.{part}" for part in axes]
    for lock in run.metadata["locks"]:
        yield lock["name"], lock["second"], [f"{quote(lock['name'])}.force"], lock["turns"], []
    for motion in run.metadata["motions"]:
        yield motion["name"], "", [f"{quote(motion['name'])}.force"], motion["readings"]["force"] == "N*m", []


def known_peaks(run: Run) -> list[Peak]:
    """The peaks with the digits that hold, as far as they are known: of a run from a file they are not."""
    if run.recorded:
        return peak_reactions(run)
    accuracy = run.accuracy
    texts = [f"{quote(name)}.{part}" for part in "FM" for name, reaction in run.reactions.items() if reaction.carries]
    others = [f"hypot({', '.join(parts)})" if len(parts) > 1 else parts[0] for _, _, parts, _, _ in _parts(run)]
    band = accuracy.band(lambda run, t: np.abs(run.motion.evaluate([*texts, *others], t)))
    joints, known = len(texts) // 2, []
    pairs = list(zip(peak_reactions(run), peak_reactions(accuracy.other), strict=True))
    force, couple = (
        max((value(peak) or 0.0 for peak, _ in pairs), default=0.0) for value in (lambda p: p.size, lambda p: p.couple)
    )
    couple = max(couple, force * _farthest(run))
    for i, (peak, other) in enumerate(pairs):
        column, parts = i if i < joints else joints + i, {}
        if peak.size is not None:
            t, size = accuracy.extreme(band, column, (peak.t, peak.size), (other.t, other.size))
            xy = {part: value and Known(value, size.error, size.size) for part, value in (("Fx", peak.Fx), ("Fy", peak.Fy))}
            parts |= {"t": t, "size": size.beside(force), **xy}
        if peak.couple is not None:
            column = joints + i
            t, size = accuracy.extreme(band, column, (peak.t_couple, peak.couple), (other.t_couple, other.couple))
            parts |= {"t_couple": t, "couple": size.beside(couple)}
        known.append(replace(peak, **parts))
    return known


def couple_noise(run: Run) -> float:
    """The couple (N·m) up to which one is round-off, beside the largest couple and the largest force at its farthest place."""
    known = [reaction for reaction in run.reactions.values() if reaction.determinate]
    force, couple = (float(np.abs(values).max(initial=0)) for values in ([r.size for r in known], [r.M for r in known]))
    return _ROUND_OFF * max(couple, force * _farthest(run))


def _farthest(run: Run) -> float:
    """The largest coordinate of a body at about a hundred output times, m."""
    places = run.poses if run.recorded else run.motion.poses(run.t[:: len(run.t) // 100 + 1].copy())
    return float(np.abs(places[..., :2]).max(initial=0))


def _peak(run: Run, sampled: Run, i: int, name: str, noise: float) -> Peak:
    reaction = sampled.reactions[name]
    if not reaction.determinate:
        return Peak(name, reaction.second, False)

    def solved(t: Array) -> Array:
        return run.motion.reactions(t)[:, i]

    t, size = _largest(run, sampled.t, reaction.size, lambda t: np.hypot(*solved(t)[:, :2].T))
    couple = t_couple = None
    if reaction.has_couple:
        resolved = np.where(np.abs(reaction.M) > noise, np.abs(reaction.M), 0.0)
        t_couple, couple = _largest(run, sampled.t, resolved, lambda t: np.abs(solved(t)[:, 2]))
    force_x, force_y, _ = solved(np.array([t]))[0].tolist()
    return Peak(name, reaction.second, True, t, size, force_x, force_y, couple, t_couple)


def _peak_of_part(run: Run, sampled: Run, name: str, body: str, texts: list[str], turns: bool, parts: list[str]) -> Peak:
    """The largest force, or couple where it ``turns``, of which expressions give the components; ``parts``: those in the fixed axes."""

    def size(motion: Motion, t: Array) -> Array:
        return np.hypot.reduce(motion.evaluate(texts, t), axis=1)

    sizes = size(sampled.motion, sampled.t)
    if np.isnan(sizes).any():
        return Peak(name, body, False)
    t, largest = _largest(run, sampled.t, sizes, lambda t: size(run.motion, t))
    if turns:
        return Peak(name, body, True, couple=largest, t_couple=t)
    if run.recorded or not parts:
        return Peak(name, body, True, t, largest)
    force = run.motion.evaluate(parts, np.array([t]))[0]
    return Peak(name, body, True, t, largest, *force.tolist())


def _largest(run: Run, t: Array, sampled: Array, signal: Signal) -> tuple[float, float]:
    if run.recorded or not sampled.any():
        i = int(sampled.argmax())
        return float(t[i]), float(sampled[i])
    return refined(signal, t, sampled, candidates=2)
