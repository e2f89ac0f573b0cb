"""``Mechanism.inverse``: a motion given, the forces that it takes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import CompiledModel, OutcomeKind, Settings
from freebody.inverse.actuators import Actuators, NotRealizable
from freebody.inverse.laws import Law, Recording, prescribed, rest
from freebody.inverse.result import InverseDynamics
from freebody.inverse.virtual_motions import dead_position
from freebody.model.names import suggestion
from freebody.model.start import quantity
from freebody.run.simulation import Run

if TYPE_CHECKING:
    from freebody.model.builder import Builder

REST, REST_LASTS = "rest", 1.0
"""The motion that stands still, and for how long it does where no end is given, s."""
RTOL = 1e-12
"""Of the motion, unless the model or the caller asks for another: what is prescribed is exact, its other coordinates nearly so."""


def inverse(
    mechanism: Builder,
    motion: Mapping[str, Law] | Run | str | None,
    actuators: Sequence[str] | str,
    limits: Mapping[str, Any] | None,
    least: bool,
    until: float | str | None,
    initial: Mapping[str, Any] | None,
    t: float,
    settings: Mapping[str, Any],
) -> InverseDynamics:
    """See ``Analysis.inverse``."""
    names = [actuators] if isinstance(actuators, str) else list(actuators)
    chosen = mechanism.model.run.model_fields_set if mechanism.model.run else set()
    given = settings if "rtol" in chosen else {"rtol": RTOL, **settings}
    if isinstance(motion, Run):
        run = motion
    elif motion is None:
        if not mechanism.compile().metadata["motions"]:
            raise ValueError("the model prescribes no motion; give one: {'theta': '2*pi*t'} (--motion 'theta=2*pi*t')")
        run = mechanism.simulate(until, initial=initial, t=t, **given)
    else:
        run = _prescribed_run(mechanism, motion, until, initial, t, given)
    if not run.outcome.ok:
        raise _not_had(run)
    own = len(mechanism.compile().spec["motions"]) if isinstance(motion, (str, Mapping)) else 0
    gauge = next((each["of"] for each in run.source.spec["motions"][own:]), run.coordinates[0])
    if not names:
        return InverseDynamics(run, gauge)
    if run.changes:
        raise ValueError(
            f"{run.changes[0].kind} at t = {run.changes[0].t:.6g} s: with actuators nothing may switch during the motion"
        )
    bare = mechanism.compile()
    if motion is None:  # what prescribed it gives way to the actuators
        bare = CompiledModel.of({**bare.spec, "motions": [], "events": []})
    found = Actuators(bare, names, {}, least)
    units = dict(zip(found.names, found.units, strict=True))
    if unknown := [name for name in limits or {} if name not in units]:
        raise ValueError(f"the limit of {unknown[0]} is of no actuator: {suggestion(unknown[0], units, 'actuators')}")
    limited = {name: abs(quantity(f"the limit of {name}", most, units[name])) for name, most in (limits or {}).items()}
    return InverseDynamics(run, gauge, replace(found, limits=limited))


def _prescribed_run(
    mechanism: Builder,
    motion: Mapping[str, Law] | str,
    until: float | str | None,
    initial: Mapping[str, Any] | None,
    t: float,
    settings: Mapping[str, Any],
) -> Run:
    """The run of a mechanism that moves as prescribed, or rests."""
    words = {field.name for field in fields(Settings)}
    changes = {name: value for name, value in settings.items() if name not in words}
    if isinstance(motion, str):
        if motion != REST:
            raise ValueError(f"{motion!r} is no motion: give laws of time by gauge, a run, or {REST!r}")
        motion = rest(mechanism, initial, t, changes)
        until = t + REST_LASTS if until is None else until
    if recordings := [law for law in motion.values() if isinstance(law, Recording)]:
        last = min(float(np.nextafter(law.t[-1], -np.inf)) for law in recordings)  # beyond it the table stands still
        until = last if until is None else min(quantity("until", until, "s"), last)
        t = max([t, *(float(law.t[0]) for law in recordings)])
    driven, start = prescribed(mechanism, motion, initial, t, changes)
    return driven.simulate(until, initial=start, t=t, **settings)


def _not_had(run: Run) -> NotRealizable:
    """What keeps a run from going on, with the time and the posture; those of a dead position itself where it is one."""
    t, posture = run.outcome.t, dict(zip(run.coordinates, run.end.q.tolist(), strict=True))
    if run.outcome.name is OutcomeKind.DEAD_POSITION:
        t, posture = dead_position(run)
    return NotRealizable("beyond", run.outcome.sentence, t, posture)
