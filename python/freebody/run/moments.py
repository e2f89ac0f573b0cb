"""Moments of a motion: its start, a time, just before or after what happens."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import CompiledModel, MotionError, State, Trajectory
from freebody.model.start import quantity
from freebody.run.simulation import MAX_STEPS, Run, simulate

if TYPE_CHECKING:
    from freebody.model.builder import Builder

START = "start"
"""What the events at the start are called together."""
_MOMENT = 1e-6
"""Length of a motion in which nothing but the events at its start happens, of the time natural to the mechanism, or of the run where
it has none before these events."""


PATIENT = 10.0
"""s, for which something is waited for where the model does not say how long it runs."""


ORDINALS = {"first": 1, "second": 2, "third": 3, "fourth": 4, "fifth": 5}
"""How often something has happened, in words."""


class Unreached(ValueError):
    """A moment to which a motion does not come."""


def _at_start(mechanism: Builder) -> list[str]:
    """The events at the start of a motion, by name."""
    return [event["name"] for event in mechanism.lowered().spec["events"] if event.get("opening")]


def opening(mechanism: Builder, start: State, source: CompiledModel) -> Run | None:
    """A moment of the motion from a state, at whose start the events there have happened; None where the model has no such event.
    Raises ``Unreached`` where they let nothing move on."""
    if not _at_start(mechanism):
        return None
    try:
        time = 1 / source.free_bodies(start).usual_rate(source.metadata["coordinates"], start.u)
    except MotionError:  # what the events put in place is missed
        time = _end(mechanism, start) - start.t
    run = simulate(source, start, mechanism.run_plan(start.t + _MOMENT * time, {"step": _MOMENT * time}))
    if run.outcome.t == start.t:
        raise Unreached(f"after the events at the start: {run.outcome.name}: {run.outcome.sentence}")
    return run


def state_of(
    mechanism: Builder,
    start: State,
    source: CompiledModel,
    at: float | str | None = None,
    before: str | None = None,
    after: str | None = None,
    max_steps: int = MAX_STEPS,
    **settings: float,
) -> State:
    """The state of the motion from ``start`` at a time, after what happens then, or just before or after the first event or mode
    change of a name; without any the start, after the events there. ``source`` is the mechanism compiled; ``settings`` overrule those of
    the model's run. Raises ``Unreached`` for what the motion does not reach within so many steps."""
    if sum(each is not None for each in (at, before, after)) > 1:
        raise ValueError("at, before and after are one moment: give one of them")
    t, named = start.t if at is None else quantity("at", at, "s"), before or after
    if t < start.t:
        raise Unreached(f"the motion begins at {start.t:g} s: there is nothing at {t:g} s")
    happen = _at_start(mechanism)
    if happen and (before == START or before in happen):
        return replace(start, moment=f"before {' and '.join(happen)}")
    if t == start.t and (named in (None, START) or named in happen):
        run = opening(mechanism, start, source)
        return replace(run.motion.state(t), moment=f"after {' and '.join(happen)}") if run else start
    run = simulate(source, start, mechanism.run_plan(_end(mechanism, start) if named else t, settings), max_steps=max_steps)
    if named:
        t = time_of(run, named)
    elif run.outcome.t < t:
        raise Unreached(f"the motion ends at {run.outcome.t:g} s, before {t:g} s: {run.outcome.sentence}")
    stated = f"{'before' if before else 'after'} {named}, t = {t:g} s" if named else f"t = {t:g} s"
    if before and t == start.t:
        return replace(start, moment=stated)
    return replace(run.motion.state(float(np.nextafter(t, -np.inf)) if before else t), moment=stated)


def _end(mechanism: Builder, start: State) -> float:
    """When the model's own run ends, or how long what happens is waited for where it says nothing, s."""
    return mechanism.run_numbers().until or start.t + PATIENT


def time_of(run: Run | Trajectory, name: str) -> float:
    """When an event, or a mode change of a part, of this name comes first, s; of a name like ``stick wheel`` a change of that kind, of one
    like ``rail`` that of an end of it, ``rail.most``; of ``second impact`` and ``second impact ball`` when one comes so often. Raises
    ``Unreached`` where it does not come."""
    happened = [(event.t, event.name) for event in run.events]
    happened += [(change.t, part) for change in run.changes for part in change.of]
    kinds = [(change.t, f"{change.kind} {part}") for change in run.changes for part in change.of]
    kinds += [(change.t, change.kind) for change in run.changes]
    which, _, said = name.partition(" ")
    for often, what_comes in ((1, name), (ORDINALS.get(which, 0), said)):
        times = sorted({t for t, what in (*happened, *kinds) if what_comes in (what, what.partition(".")[0])})
        if 0 < often <= len(times):
            return times[often - 1]
    known = ", ".join(dict.fromkeys(what for _, what in sorted(happened))) or "nothing does"
    raise Unreached(f"{name!r} does not happen until {run.outcome.t:g} s; what happens: {known}")
