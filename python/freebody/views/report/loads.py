"""The free-body diagrams of a run as they move: every load on every body over time, what it gives the mass centres, and impulses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import GROUND, Array, Body, FreeBodies, Load, MotionError, Part, State
from freebody.impact.impacts import impacts
from freebody.solve.symbolic_state import SymbolicState
from freebody.views.diagram.names import Labels
from freebody.views.report.balances import balances
from freebody.views.report.floats import floats
from freebody.views.report.instants import telling_instants
from freebody.views.sketch import Sketch

if TYPE_CHECKING:
    from freebody.run.simulation import Run

_NUMBERS = 50_000
"""Of all columns together: a quarter of a megabyte."""
_INSTANTS, _MODES, _IMPULSES = 300, 6, 200
_ROUND_OFF = 1e-9
"""Of the largest of its kind, below which a load is what rounding left."""


@dataclass
class _Track:
    """One part of a load over time: columns x, y (m, in the frame of its body), Fx, Fy (N, fixed axes), M (N·m); NaN where it does
    not act, or is not determined."""

    load: Load
    part: Part
    label: str
    arrow: str
    columns: Array = field(repr=False)


def loads(run: Run, sketch: Sketch) -> dict[str, Any] | None:
    """All loads over time; None of a run from a file, which does not know them."""
    if run.recorded or not run.bodies:
        return None
    times, states, free = _instants(run)
    if not free:
        return None
    modes: dict[tuple[str, ...], Labels] = {}
    tracks: dict[tuple[str, str, int], _Track] = {}
    for k, (state, each) in enumerate(zip(states, free, strict=True)):
        mode = _mode(each)
        if mode not in modes:
            modes[mode] = Labels(SymbolicState(run.source, state, given=each), each)
        for load in each.loads:
            for i, part in enumerate(load.on):
                if part.body != GROUND:
                    key = load.symbol, part.body, i
                    if key not in tracks:
                        tracks[key] = _track(load, part, i, modes[mode], len(times))
                    tracks[key].columns[k] = _columns(load, part, each.bodies[part.body], sketch)
    known = list(modes)
    return {
        "t": times.tolist(),
        "tracks": _tracks_data(list(tracks.values()), sketch),
        "bodies": [_effective(name, free, next(iter(modes.values())), sketch) for name in free[0].bodies],
        "mode": [known.index(_mode(each)) for each in free],
        "balances": [balances(labels, sketch.names) for labels in list(modes.values())[:_MODES]],
        "impulses": _impulses(run, sketch),
    }


def _mode(free: FreeBodies) -> tuple[str, ...]:
    """What acts there is."""
    return tuple(load.symbol for load in free.loads)


def _instants(run: Run) -> tuple[Array, list[State], list[FreeBodies]]:
    """Times that tell what acts, those of switches twice: just before and just after; and what acts at them, where it is known."""
    each = 5 * sum(len(load.on) for load in run.source.free_bodies(run.start).loads)
    times = telling_instants(run, int(np.clip(_NUMBERS // max(each, 1), 60, _INSTANTS)))
    states = [run.motion.state(float(t)) for t in times]
    found = [(t, state, free) for t, state in zip(times, states, strict=True) if (free := _free(run, state)) is not None]
    return np.array([t for t, _, _ in found]), [state for _, state, _ in found], [free for _, _, free in found]


def _free(run: Run, state: State) -> FreeBodies | None:
    try:
        return run.source.free_bodies(state)
    except MotionError:
        return None


def _track(load: Load, part: Part, i: int, labels: Labels, instants: int) -> _Track:
    """An empty one. The components of a pin's force are one arrow; each part of a string is one."""
    arrow = f"{load.path} {labels.whole(load).plain} {part.body} {i * (load.kind == 'string')}"
    return _Track(load, part, labels.whole(load).plain, arrow, np.full((instants, 5), np.nan))


def _columns(load: Load, part: Part, body: Body, sketch: Sketch) -> tuple[float, ...]:
    value = load.value if load.determinate else np.nan
    fx, fy = part.force
    return (*_place(load, part, body, sketch), value * fx, value * fy, value * part.couple)


def _place(load: Load, part: Part, body: Body, sketch: Sketch) -> tuple[float, float]:
    """Where it acts in the frame of its body; of a link or wound string at its own end, which is on the same line."""
    if load.kind == "joint" and load.card.pulls:
        fields = next(joint["with"] for joint in sketch.spec["joints"] if joint["name"] == load.name)
        for point in fields.get("of") or [fields["from"]]:
            if sketch.at[point][0] == part.body:
                x, y = sketch.at[point][1].tolist()
                return x, y
    return _local(part.point, body)


def _local(place: Sequence[float], body: Body) -> tuple[float, float]:
    """A place in the frame of a body."""
    way = complex(*np.subtract(place, body.at)) * np.exp(-1j * body.angle)
    return way.real, way.imag


def _tracks_data(tracks: Sequence[_Track], sketch: Sketch) -> list[dict[str, Any]]:
    largest = np.nanmax(np.abs([np.nan_to_num(track.columns) for track in tracks] or np.zeros((1, 1, 5))), axis=(0, 1))
    noise = _ROUND_OFF * np.array([sketch.size, sketch.size, largest[2:4].max(), largest[2:4].max(), largest[4]])
    return [
        {
            "symbol": track.load.symbol,
            "name": track.load.name,
            "kind": track.load.kind,
            "label": track.label,
            "arrow": track.arrow,
            "figure": sketch.names.index(track.part.body),
            "others": [sketch.names.index(name) for name in sorted(track.load.touched - {track.part.body})],
        }
        | {
            name: _column(values, least)
            for name, values, least in zip(("x", "y", "fx", "fy", "m"), track.columns.T, noise, strict=True)
        }
        for track in tracks
    ]


def _column(values: Array, noise: float = 0.0) -> float | str:
    """A number that stays, or numbers over time; what is below the noise is 0."""
    resolved = np.where(np.abs(values) <= noise, 0.0, values)
    return float(resolved[0]) if np.ptp(resolved) <= noise else floats(resolved)


def _effective(name: str, free: Sequence[FreeBodies], labels: Labels, sketch: Sketch) -> dict[str, Any]:
    """m a and I α of a body."""
    bodies = [each.bodies[name] for each in free]
    x, y = _local(bodies[0].G, bodies[0])
    return {
        "figure": sketch.names.index(name),
        "G": [x, y],
        "ma": f"{labels.mass(name).plain} {labels.acceleration(name).plain}",
        "ia": "" if bodies[0].particle else f"{labels.inertia(name).plain} {labels.angular(name).plain}",
        "fx": _column(np.array([body.mass * body.a[0] for body in bodies])),
        "fy": _column(np.array([body.mass * body.a[1] for body in bodies])),
        "m": _column(np.array([body.inertia * body.alpha for body in bodies])),
    }


def _impulses(run: Run, sketch: Sketch) -> list[dict[str, Any]]:
    """Every impulse on a body, N·s and N·m·s, where it acted in the fixed axes, that of a contact with its friction; of very many the
    first."""
    made: dict[tuple[float, str, str, Any], dict[str, Any]] = {}
    for impact in impacts(run):
        for load in impact.impulses.loads if len(made) < _IMPULSES else ():
            for part in load.on if load.determinate else ():
                wrench = load.value * np.array([*part.force, part.couple])
                if part.body != GROUND and wrench.any():
                    others = [sketch.names.index(name) for name in sorted(load.touched - {part.body})]
                    plain = {"t": impact.change.t, "name": load.name, "figure": sketch.names.index(part.body), "others": others,
                             "at": part.point, "wrench": np.zeros(3)}  # fmt: skip
                    made.setdefault((impact.change.t, load.name, part.body, part.point), plain)["wrench"] += wrench
    return [each | {"wrench": each["wrench"].tolist()} for each in made.values()]
