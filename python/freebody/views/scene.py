"""Everything that is drawn of a mechanism: its bodies, and by way of their own modules joints, forces, contacts and strings."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import zip_longest
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import GROUND, Array, State
from freebody.model.appearance import COLOURS
from freebody.views import shapes
from freebody.views.contact_glyphs import draw_compliance, draw_contacts, draw_strings
from freebody.views.drive_glyphs import draw_drives
from freebody.views.glyphs import draw_forces, draw_joints
from freebody.views.impact_markers import impact_markers
from freebody.views.sketch import Figure, Sketch, Stroke, named_points
from freebody.views.stop_glyphs import draw_stops

if TYPE_CHECKING:
    from freebody.run.simulation import Run

_FLAT = 0.99  # cosine of an angle from which on a body lies on a line
_OWN_POINTS = ("origin", "G", "centre", "start")


def of_run(run: Run, times: Sequence[float] | Array | None = None, traces: Sequence[str] | None = None) -> Sketch:
    """A run drawn at times within it (default: its output times)."""
    shown = run if times is None else run.at(times)
    start = State(run.start.p, float(shown.t[0]), shown.q[0], shown.u[0])
    sketch = drawn(Sketch(run.source, start, shown.t, shown.q, shown.poses, shown), traces)
    sketch.impact_markers = impact_markers(run)
    return sketch


def drawn(sketch: Sketch, traces: Sequence[str] | None = None) -> Sketch:
    """The sketch with everything drawn on it; ``traces`` names the points to be traced (default: a few worth it)."""
    for body in sketch.spec["bodies"]:
        _draw_body(sketch, body)
    draw_joints(sketch)
    draw_forces(sketch)
    draw_drives(sketch)
    draw_contacts(sketch)
    draw_compliance(sketch)
    draw_strings(sketch)
    draw_stops(sketch)
    sketch.traces = _worth_tracing(sketch) if traces is None else list(traces)
    return sketch


def _draw_body(sketch: Sketch, body: Mapping[str, Any]) -> None:
    """The shapes of its pieces; for a body without shape, the hull of its points."""
    figure, look = sketch.figures[body["name"]], sketch.looks.get(body["name"], {})
    thickness = _half(sketch, look, 0.8 * sketch.size)
    tips, side = _tips(sketch, body["name"]), _upper_side(sketch, body["name"])
    if (outline := look.get("outline")) is not None:
        _draw_outline(sketch, figure, outline, thickness, tips)
        return
    for piece, own in zip_longest(body["pieces"], look.get("pieces", ()), fillvalue={}):
        drawn_so = {word: look[word] for word in look.keys() & {"thickness", "spokes", "wheels"}} | own
        half = _half(sketch, own, thickness)
        tone = COLOURS.index(own["colour"]) if "colour" in own else None
        sizes = {name: sketch.number(size) for name, size in piece.get("sizes", {}).items()}
        corners = np.array([[sketch.number(x) for x in corner] for corner in piece.get("corners", [])])
        at = [sketch.number(x) for x in piece.get("at", (0.0, 0.0))]
        angle = sketch.number(piece.get("angle", 0.0))
        own_tips = shapes.turn(tips - at, -angle)
        for points, style in _outlines(sketch, body["name"], drawn_so, piece["shape"], sizes, corners, half, own_tips):
            if side and piece["shape"] == "rod":
                points = np.array([[-1.0, 0], [1, 0], [1, 2 * side], [-1, 2 * side]]) * (sizes["length"] / 2, half)
            placed, place = shapes.turn(points, angle, at), np.array(at)
            figure.add(placed, style, len(points) > 2, place if style == "mass" else None, tone)
    masses = [stroke.points.mean(axis=0) for stroke in figure.strokes if stroke.style == "mass"]
    if 1 < len(masses) == len(figure.strokes):  # held together by a bar without mass
        figure.strokes.insert(0, Stroke(shapes.rounded_hull(np.array(masses), 0.6 * thickness), "body"))
    joined = {name for joint in sketch.spec["joints"] for name in named_points(joint["with"])}
    own = np.array([at for name, at in figure.points.items() if not name.endswith(".origin") or name in joined] or [(0.0, 0.0)])
    if any(stroke.style in ("body", "band", "mass") for stroke in figure.strokes):
        _reach_out(figure, own, thickness, tips)
    else:
        figure.add(shapes.rounded_hull(own, thickness, tips), "body")


def _half(sketch: Sketch, look: Mapping[str, Any], usual: float) -> float:
    """Half the thickness that a look says, in m."""
    return sketch.number(look["thickness"]) / 2 if "thickness" in look else usual


def _draw_outline(sketch: Sketch, figure: Figure, outline: Any, thickness: float, tips: Array) -> None:
    """What the model says instead of the shapes: nothing, corners, or a drawing, in which what lies within another part is cut out."""
    if isinstance(outline, Mapping):
        size = sketch.number(outline["unit"]) * np.array([1.0, -1.0 if outline["y"] == "down" else 1.0])
        at, seen = np.array([sketch.number(x) for x in outline["at"]]), list[Array]()
        for points, closed in outline["subpaths"]:
            hole = closed and any(shapes.inside(other, points[:1]).any() for other in seen)
            seen += [points] if closed else []
            figure.add(at + size * points, ("slot" if hole else "body") if closed else "mark", closed)
    elif outline != "none":
        corners = np.array([sketch.at[c][1] if isinstance(c, str) else [sketch.number(x) for x in c] for c in outline])
        figure.add(corners if len(corners) > 2 else shapes.rounded_hull(corners, thickness, tips), "body")


def _tips(sketch: Sketch, body: str) -> Array:
    """Points (k, 2) with which a body may touch something: there it ends, however thick it is drawn."""
    touching = [
        surface["point"] for contact in sketch.spec.get("contacts", []) for surface in contact["of"] if "point" in surface
    ]
    return np.array([sketch.at[name][1] for name in touching if sketch.at[name][0] == body]).reshape(-1, 2)


def _upper_side(sketch: Sketch, body: str) -> float:
    """Of a body that comes to lie flat on a line with both of its ends, the side on which it is drawn, so that it lies on it: that of
    its y axis, 1, or the other, -1; 0 of any other body."""
    touching = Counter[str]()
    lines: dict[str, Mapping[str, Any]] = {}
    for contact in sketch.spec.get("contacts", []):
        for surface, other in (contact["of"], contact["of"][::-1]):
            if "line" in other and "point" in surface and sketch.at[surface["point"]][0] == body:
                touching[repr(other)] += 1
                lines[repr(other)] = other
    flat = [lines[words] for words, count in touching.items() if count > 1]
    for line in flat:
        owner, _, along = sketch.line(line["line"])
        turned = sketch.poses[:, sketch.names.index(body), 2] - sketch.poses[:, sketch.names.index(owner), 2]
        level = np.cos(turned - np.arctan2(along[1], along[0]))
        if abs(best := level[np.abs(level).argmax()]) > _FLAT:
            return float(np.sign(best))
    return 0.0


def _outlines(
    sketch: Sketch,
    body: str,
    look: Mapping[str, Any],
    shape: str,
    sizes: Mapping[str, float],
    corners: Array,
    thickness: float,
    tips: Array,
) -> list[tuple[Array, str]]:
    """Outlines of a piece with their style, as it looks; what goes on rollers has these for wheels."""
    rolls = any(
        joint["type"] == "rollers" and sketch.at[joint["with"]["points"][0]][0] == body for joint in sketch.spec["joints"]
    )
    if shape in ("disk", "ring") and look.keys() & {"spokes", "thickness"}:
        rim = 2 * thickness if "thickness" in look else 0.14 * sizes["radius"]
        return shapes.wheel(sizes["radius"], rim, int(look.get("spokes", 0)))
    if shape == "rectangle" and "wheels" in look and not rolls:
        return shapes.cart(sizes["width"], sizes["height"], sketch.number(look["wheels"]))
    return shapes.piece_outlines(shape, sizes, corners, thickness, tips)


def _reach_out(figure: Figure, points: Array, thickness: float, tips: Array) -> None:
    """Arms from the shape to named points that lie outside of it, so that a joint there does not hang in the air: from its middle, or
    its nearest place where the middle is not on it."""
    solid = np.vstack([stroke.points for stroke in figure.strokes])
    hull, middle = shapes.convex_hull(solid), solid.mean(axis=0)
    held = any(shapes.inside(stroke.points, middle[None]).any() for stroke in figure.strokes if stroke.closed)
    seen = solid if held else shapes.dense([np.vstack([each.points, each.points[:1]]) for each in figure.strokes], thickness)
    for point in points:
        edges = np.roll(hull, -1, axis=0) - hull
        beyond = edges[:, 1] * (point[0] - hull[:, 0]) - edges[:, 0] * (point[1] - hull[:, 1])
        if (beyond > 0.1 * thickness * np.hypot(*edges.T)).any():
            arm = shapes.rounded_hull(
                np.array([middle if held else seen[np.hypot(*(seen - point).T).argmin()], point]), 0.6 * thickness, tips
            )
            figure.strokes.insert(0, Stroke(arm, "body"))


def _worth_tracing(sketch: Sketch) -> list[str]:
    """Up to three points that move and where nothing is joined; mass centres where there is none."""
    joined = [sketch.at[n] for j in sketch.spec["joints"] for n in named_points(j["with"]) if n in sketch.at]
    free = [
        name
        for name, (body, at) in sketch.at.items()
        if body != GROUND
        and name.rpartition(".")[2] not in _OWN_POINTS
        and not any(body == other and np.allclose(at, place, atol=1e-6 * sketch.size) for other, place in joined)
    ]
    return free[:3] or [name for name in sketch.at if name.endswith(".G")][-1:]
