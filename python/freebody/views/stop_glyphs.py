"""How stops look: a hatched face where the body meets it, beside a hinge or across a guide."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from freebody.core import GROUND, quote
from freebody.views import shapes
from freebody.views.glyphs import guided_point
from freebody.views.sketch import Sketch

_FACE = (3.5, 6.5)  # sizes of symbols: from where to where a face beside a hinge reaches
_ASIDE, _HALF = 0.8, 2.4  # sizes of symbols: half a slender body; half a face across a guide, at least
_PARTICLE = 1.4 * np.array([[-1.0, -1.0], [1.0, 1.0]])  # sizes of symbols


def draw_stops(sketch: Sketch) -> None:
    """Of every stop of the coordinate of a hinge or guide that is there from the start and stays."""
    coordinates = {joint["name"]: joint["coordinates"] for joint in sketch.metadata["joints"]}
    for stop in sketch.spec.get("stops", []):
        for joint in sketch.spec["joints"] if sketch.there(stop["name"], stop.get("engaged", True)).all() else ():
            [name] = coordinates.get(joint["name"], [])[:1] or [""]
            way = _way(stop["gap"], quote(name)) if name else 0
            if way and joint["type"] == "hinge":
                _beside_hinge(sketch, joint, way, way * sketch.value(stop["gap"]))
            elif way and (point := guided_point(joint)):
                _across_guide(sketch, joint["with"]["along"], point, way, way * sketch.value(stop["gap"]))


def _way(gap: str, coordinate: str) -> int:
    """Which way a coordinate is stopped: 1 where it grows, -1 where it falls; 0 of a gap of anything else."""
    return -1 if gap.startswith(f"{coordinate} - ") else int(gap.endswith(f" - {coordinate}"))


def _beside_hinge(sketch: Sketch, hinge: Mapping[str, Any], way: int, turn: float) -> None:
    """On the first body, or the one that does not stand still, a face along the second as it lies when it has turned so far (rad)."""
    (first, pin), (second, own) = (sketch.at[point] for point in hinge["with"]["of"])
    if second == GROUND:
        (first, pin), (second, own), way, turn = (second, own), (first, pin), -way, -turn
    outline = np.vstack([stroke.points for stroke in sketch.figures[second].strokes if stroke.about is None] or [own[None]]) - own
    arm = outline[np.hypot(*outline.T).argmax()]
    reach = float(np.hypot(*arm))
    if not reach:
        return
    lean = np.arctan2(arm[1], arm[0]) + _turned(sketch, second) - _turned(sketch, first) + turn
    radii = np.array(_FACE) * min(sketch.size, 0.9 * reach / _FACE[1])
    face = np.column_stack([radii, np.full(2, way * _ASIDE * sketch.size)])[::-way]  # what is solid lies on the right
    sketch.hatched(first, shapes.turn(face, float(lean), pin), about=pin)


def _across_guide(sketch: Sketch, line: Any, point: str, way: int, shift: float) -> None:
    """Across a guide, where what it leads ends when it has gone so far (m)."""
    body, _, along = sketch.line(line)
    owner, at = sketch.at[point]
    solid = [each.points for each in sketch.figures[owner].strokes if each.closed and each.style in ("body", "block", "mass")]
    lean, left = _turned(sketch, owner) - _turned(sketch, body), np.array([-along[1], along[0]])
    met = shapes.turn(np.vstack(solid or [_PARTICLE * sketch.size]) - at, lean) @ np.column_stack([way * along, left])
    end = sketch.seen_from(body, point)[0] + (shift + way * met[:, 0].max()) * along
    face = min(met[:, 1].min(), -_HALF * sketch.size), max(met[:, 1].max(), _HALF * sketch.size)
    sketch.hatched(body, end + np.outer(face[::way], left), about=end)


def _turned(sketch: Sketch, body: str) -> float:
    return float(sketch.poses[0, sketch.names.index(body), 2])
