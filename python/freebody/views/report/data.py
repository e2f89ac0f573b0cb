"""What the page holds as JSON for the player and the plots; the browser's side of it is web/src/data/types.ts."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import Array
from freebody.model.user_units import shown
from freebody.views.plots import pretty_unit
from freebody.views.report.floats import floats
from freebody.views.report.loads import loads
from freebody.views.report.series import over_each_other, plots
from freebody.views.scene import of_run
from freebody.views.sketch import Cord, Pair, Sketch, Stroke, named_points
from freebody.views.style import PALETTE

if TYPE_CHECKING:
    from freebody.run.simulation import Run

_NUMBERS = 60_000
"""Of all frames together: a third of a megabyte."""
_STRING, _SPRING = 80, 22
"""About as many numbers say where a string, or the spring of a contact, is in one frame."""
_UNITS = ("m", "rad", "N", "N*m", "N*s")
"""In which the page has numbers that it shows: all but those of plots, which are in the user's units."""
_UNNAMED = ("origin",)
"""Points that a reader does not ask for."""


def report_data(run: Run, beside: Mapping[str, Run] = MappingProxyType({})) -> dict[str, Any]:
    """All that moves, the plots, those of other runs by their names over them, and the moments worth knowing."""
    sketch = of_run(run, frames(run))
    return {
        "scene": _scene(sketch),
        "loads": loads(run, sketch),
        "plots": over_each_other(plots(run), {name: plots(other) for name, other in beside.items()}),
        "marks": _marks(run),
        "noneFrom": None if run.recorded else run.accuracy.none_from,
        "units": {unit: {"unit": pretty_unit(shown(unit).unit), "size": shown(unit).size} for unit in _UNITS},
    }


def frames(run: Run) -> Array:
    """Times of the animation: 60 a second, yet enough for a short run and not too many for a page."""
    spec = run.source.spec
    springs = sum(contact.get("stiffness") is not None for contact in spec.get("contacts", []))
    each = 3 * max(len(run.bodies), 1) + _STRING * len(spec.get("strings", [])) + _SPRING * springs
    most = int(np.clip(_NUMBERS // each, 120, 1500))
    if run.recorded:
        return run.t if len(run.t) <= most else run.t[np.unique(np.linspace(0, len(run.t) - 1, most).astype(int))]
    start, end = run.edges[0], run.edges[-1]
    return np.linspace(start, end, int(np.clip(60 * (end - start), min(300, most), most)) + 1)


def _marks(run: Run) -> list[dict[str, Any]]:
    made = [{"name": event.name, "t": event.t, "kind": "event"} for event in run.events]
    for change in run.changes:
        kind = "impact" if change.impulses else "switch"
        made.append({"name": f"{change.kind}: {', '.join(change.of)}", "t": change.t, "kind": kind})
    return sorted(made, key=lambda mark: mark["t"])


def _scene(sketch: Sketch) -> dict[str, Any]:
    """The drawing, its outlines rounded to what a screen can show."""
    digits = 3 - int(np.floor(np.log10(sketch.size)))

    def short(points: Array) -> list[Any]:
        return points.round(digits).tolist()

    return {
        "size": sketch.size,
        "bounds": sketch.bounds(),
        "t": sketch.t.tolist(),
        "poses": floats(sketch.poses),
        "figures": [
            {
                "name": figure.name,
                "tone": sketch.tone(figure.name) % len(PALETTE),
                "layer": sketch.layer(figure.name),
                "strokes": [
                    {"points": short(each.points), "style": each.style, "closed": each.closed, "about": each.about}
                    | _passing(each)
                    | ({} if each.tone is None else {"tone": each.tone})
                    for each in figure.strokes
                ],
            }
            for figure in sketch.figures.values()
        ],
        "pairs": [
            {"name": pair.name, "kind": pair.kind, "ends": pair.ends, "lines": [line.round(5).tolist() for line in pair.lines]}
            | _passing(pair)
            for pair in sketch.pairs
        ],
        "cords": [
            {"name": cord.name, "path": floats(cord.path), "taut": cord.taut.tolist(), "symbol": cord.symbol} | _passing(cord)
            for cord in sketch.cords
        ],
        "points": [_point(sketch, name, name) for name in sketch.at if name.rpartition(".")[2] not in _UNNAMED],
        "joints": [
            _point(sketch, joint["name"], points[0])
            for joint in sketch.spec["joints"]
            if (points := [name for name in named_points(joint["with"]) if name in sketch.at])
        ],
        "traced": sketch.traces,
        "flashes": [{"t": each.t, "rays": short(each.rays(sketch.spark))} for each in sketch.impact_markers],
    }


def _passing(each: Stroke | Pair | Cord) -> dict[str, Any]:
    """When it is there, of what comes and goes."""
    return {} if each.shown is None or each.shown.all() else {"shown": each.shown.tolist()}


def _point(sketch: Sketch, name: str, point: str) -> dict[str, Any]:
    """A named place on a figure, which is that of a point of the model."""
    body, at = sketch.at[point]
    return {"name": name, "figure": sketch.names.index(body), "at": at.tolist()}
