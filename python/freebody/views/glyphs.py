"""How joints and forces look: one short function a glyph, drawn on a ``Sketch`` in body frames."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from freebody.core import GROUND
from freebody.core.cards import joints
from freebody.run.records import Array
from freebody.views import shapes
from freebody.views.sketch import Sketch, Stroke

Fields = Mapping[str, Any]


def draw_joints(sketch: Sketch) -> None:
    """Every joint as its card says; what holds is drawn only as long as the joint is there."""
    for joint in sketch.spec["joints"]:
        card, there = joints()[joint["type"]], sketch.there(joint["name"], joint.get("engaged", True))
        if card.outline:
            _outline(sketch, joint["with"]["of"], card.outline, there)
        if symbol := GLYPHS.get(card.glyph):
            known = {id(stroke) for figure in sketch.figures.values() for stroke in figure.strokes}
            symbol(sketch, joint["name"], joint["with"])
            if not there.all():
                _fade(sketch, known, there)


def _fade(sketch: Sketch, known: set[int], there: Array) -> None:
    """Pins and welds that are not among those ``known`` before are shown only at times (nt,) at which they are ``there``."""
    for figure in sketch.figures.values():
        for i, stroke in enumerate(figure.strokes):
            if id(stroke) not in known and stroke.style in ("pin", "weld"):
                figure.strokes[i] = replace(stroke, shown=there)


def _outline(sketch: Sketch, points: list[str], strokes: tuple[tuple[tuple[float, float], ...], ...], there: Array) -> None:
    """Strokes in sizes of symbols at each of some points, alike along the fixed axes at the start."""
    for point in points:
        body, at = sketch.at[point]
        angle = -float(sketch.poses[0, sketch.names.index(body), 2])
        for stroke in strokes:
            line = shapes.turn(sketch.size * np.array(stroke), angle, (at[0], at[1]))
            sketch.figures[body].strokes.append(Stroke(line, "rail", False, there))


def draw_forces(sketch: Sketch) -> None:
    """Springs and dampers between points."""
    for force in sketch.spec.get("forces", []):
        fields = force["with"]
        if "between" not in fields:
            continue
        width, ends = 0.9 * sketch.size, fields["between"]
        there = force.get("engaged", True)
        spring, damper = force["type"] == "spring", bool(fields.get("damping"))
        apart = 1.3 * sketch.size if spring and damper else 0.0
        if spring:
            sketch.pair(force["name"], "spring", ends, [_beside(shapes.zigzag(width), apart)], there)
        if damper:
            sketch.pair(force["name"], "damper", ends, [_beside(line, -apart) for line in shapes.dashpot(width)], there)


def _beside(line: Array, across: float) -> Array:
    """A line moved aside, still from end to end."""
    moved = line + (0.0, across)
    ends = ([line[0]] if line[0, 0] == 0 else [], [line[-1]] if line[-1, 0] == 1 else [])
    return np.array([*ends[0], *moved, *ends[1]]) if across else line


def _hinge(sketch: Sketch, name: str, fields: Fields) -> None:
    for point in fields["of"]:
        if sketch.at[point][0] == GROUND:
            _support(sketch, sketch.at[point][1])
    body, at = sketch.at[fields["of"][0]]
    sketch.figures[body].add(shapes.circle(at, 0.55 * sketch.size), "pin")


def _support(sketch: Sketch, at: Array) -> None:
    """A bearing block standing on hatched ground."""
    s, ground = sketch.size, sketch.figures[GROUND]
    feet = at + np.array([[-1.1 * s, -2.0 * s], [1.1 * s, -2.0 * s]])
    tent = np.vstack([feet[0], shapes.arc(at, 0.9 * s, np.pi, 0.0), feet[1]])
    ground.add(tent, "block")
    _hatched(sketch, at + (-1.9 * s, -2.0 * s), at + (1.9 * s, -2.0 * s))


def _hatched(sketch: Sketch, start: Array, end: Array) -> None:
    """A line of ground, hatched on its right-hand side."""
    s, ground = sketch.size, sketch.figures[GROUND]
    ground.add(np.array([start, end]), "rail", closed=False)
    length = float(np.hypot(*(end - start)))
    along = (end - start) / length
    lean = (np.array([along[1], -along[0]]) - along) * 0.55 * s
    for foot in np.arange(0.7 * s, length + 1e-9 * s, max(0.65 * s, length / 120)):
        root = start + foot * along
        ground.add(np.array([root, root + lean]), "hatch", closed=False)


def _rail(sketch: Sketch, line: Any, points: list[str], margin: float) -> tuple[str, Array, Array, Array, Array]:
    """Body, start, end, direction of the part of a line that points travel along, and their first places along it."""
    body, origin, along = sketch.line(line)
    paths = [(sketch.seen_from(body, point) - origin) @ along for point in points]
    reach = np.concatenate(paths)
    start, end = origin + (reach.min() - margin) * along, origin + (reach.max() + margin) * along
    return body, start, end, along, np.array([path[0] for path in paths])


def _track(sketch: Sketch, line: Any, points: list[str], below: float) -> None:
    """The line that something slides or rolls on, ``below`` it: hatched on ground, a rail on a body."""
    body, start, end, along, _ = _rail(sketch, line, points, 3 * sketch.size)
    right = np.array([along[1], -along[0]])
    start, end = start + below * right, end + below * right
    if body == GROUND:
        _hatched(sketch, start, end)
    else:
        sketch.figures[body].add(np.array([start, end]), "rail", closed=False)


def _slider(sketch: Sketch, name: str, fields: Fields) -> None:
    body, point, along = sketch.line(fields["line"])
    height = 1.1 * sketch.size
    named = fields["line"]["point"] if isinstance(fields["line"], Mapping) else None
    shaped = any(len(stroke.points) == 4 for stroke in sketch.figures[body].strokes)
    if not shaped:
        block = shapes.turn(shapes.box(3.6 * sketch.size, 2 * height), float(np.arctan2(along[1], along[0])), point)
        sketch.figures[body].add(block, "block")
    if named:
        _track(sketch, fields["along"], [named], _depth(sketch, body, point, along) if shaped else height)


def _depth(sketch: Sketch, body: str, point: Array, along: Array) -> float:
    """How far a body reaches to the right of a line through it."""
    right = np.array([along[1], -along[0]])
    return float(max((((stroke.points - point) @ right).max() for stroke in sketch.figures[body].strokes), default=0.0))


def _rollers(sketch: Sketch, name: str, fields: Fields) -> None:
    radius = 0.6 * sketch.size
    for point in fields["points"]:
        body, at = sketch.at[point]
        sketch.figures[body].add(shapes.circle(at, radius), "pin")
    _track(sketch, fields["along"], list(fields["points"]), radius)


def _slot(sketch: Sketch, name: str, fields: Fields) -> None:
    body, start, end, _, _ = _rail(sketch, fields["along"], [fields["point"]], 0.0)
    if isinstance(fields["along"], Mapping) and fields["along"].get("towards"):
        along = [sketch.at[fields["along"][key]][1] for key in ("point", "towards")]
        start, end = _extremes([start, end, *along])
    sketch.figures[body].add(shapes.rounded_hull(np.array([start, end]), 0.45 * sketch.size), "slot")
    second, at = sketch.at[fields["point"]]
    sketch.figures[second].add(shapes.circle(at, 0.45 * sketch.size), "pin")


def _extremes(points: list[Array]) -> tuple[Array, Array]:
    """The two of several points on a line that lie furthest apart."""
    spread = np.array(points)
    gaps = np.hypot(*(spread[:, None] - spread[None]).T)
    i, j = np.unravel_index(gaps.argmax(), gaps.shape)
    return spread[i], spread[j]


def _curved_slot(sketch: Sketch, name: str, fields: Fields) -> None:
    _curve(sketch, name, fields["along"])
    body, at = sketch.at[fields["point"]]
    sketch.figures[body].add(shapes.circle(at, 0.45 * sketch.size), "pin")


def _cam(sketch: Sketch, name: str, fields: Fields) -> None:
    _curve(sketch, name, fields["along"])
    _wheel(sketch, fields["follower"], "block")


def _curve(sketch: Sketch, joint: str, name: str) -> None:
    """The stretch of a curve that the motion runs along, and a little more at both ends."""
    curve = next((c for c in sketch.spec.get("curves", []) if c["name"] == name), None)
    about = next(j for j in sketch.about["joints"] if j["name"] == joint)
    if curve is None or not about["coordinates"]:
        return
    start, end = sketch.travel(about["coordinates"][0])
    near = points_of_curve(sketch, curve, np.array([start, start + 1e-4]))
    margin = 12 * sketch.size / max(float(np.hypot(*(near[1] - near[0]))) / 1e-4, 1e-9)
    points = points_of_curve(sketch, curve, np.linspace(start - margin, end + margin, 181))
    sketch.figures[curve["body"]].add(points, "rail", closed=False)


def points_of_curve(sketch: Sketch, curve: Mapping[str, Any], parameter: Array) -> Array:
    """Points (k, 2) of a curve in its body's frame."""
    texts = [re.sub(r"(?<![\w.'])s(?![\w(.'])", f"({float(s)!r})", curve[axis]) for s in parameter for axis in ("x", "y")]
    return sketch.values(texts).reshape(-1, 2)


def _wheel(sketch: Sketch, circle: Mapping[str, Any], style: str) -> None:
    body, at = sketch.at[circle["centre"]]
    sketch.figures[body].strokes.insert(0, Stroke(shapes.circle(at, sketch.number(circle["radius"])), style))


def _rolling(sketch: Sketch, name: str, fields: Fields) -> None:
    radius = sketch.number(fields["circle"]["radius"])
    _wheel(sketch, fields["circle"], "mark")
    body, start, end, _, _ = _rail(sketch, fields["on"], [fields["circle"]["centre"]], radius + 2 * sketch.size)
    if body == GROUND:
        _hatched(sketch, start, end)
    else:
        sketch.figures[body].add(np.array([start, end]), "rail", closed=False)


def _rolling_circles(sketch: Sketch, name: str, fields: Fields) -> None:
    _wheel(sketch, fields["circle"], "mark")
    _wheel(sketch, fields["on"], "mark")


def _weld(sketch: Sketch, name: str, fields: Fields) -> None:
    body, at = sketch.at[fields["of"][0]]
    sketch.figures[body].add(at + shapes.box(0.9 * sketch.size, 0.9 * sketch.size), "weld")
    if body == GROUND:
        _hatched(sketch, at + (-1.6 * sketch.size, -0.45 * sketch.size), at + (1.6 * sketch.size, -0.45 * sketch.size))


def _link(sketch: Sketch, name: str, fields: Fields) -> None:
    sketch.pair(name, "link", fields["of"], [np.array([[0.0, 0.0], [1.0, 0.0]])])
    for point in fields["of"]:
        body, at = sketch.at[point]
        if body == GROUND:
            _support(sketch, at)
        sketch.figures[body].add(shapes.circle(at, 0.4 * sketch.size), "pin")


def _gear(sketch: Sketch, name: str, fields: Fields) -> None:
    for point, radius in zip(fields["of"], fields["radii"], strict=True):
        body, at = sketch.at[point]
        sketch.figures[body].add(shapes.circle(at, sketch.number(radius)), "dash")


def _belt(sketch: Sketch, name: str, fields: Fields) -> None:
    _gear(sketch, name, fields)
    first, second = (sketch.number(radius) for radius in fields["radii"])
    owner, at = sketch.at[fields["of"][0]]
    distance = float(np.hypot(*(sketch.seen_from(owner, fields["of"][1])[0] - at)))
    side = -1.0 if fields.get("crossed") else 1.0
    tilt = np.arcsin(np.clip((first - side * second) / distance, -1.0, 1.0))
    strand = np.array([[first * np.sin(tilt) / distance, first * np.cos(tilt)],
                       [1 + side * second * np.sin(tilt) / distance, side * second * np.cos(tilt)]])  # fmt: skip
    sketch.pair(name, "belt", fields["of"], [strand, strand * (1, -1)])


GLYPHS: dict[str, Callable[[Sketch, str, Fields], None]] = {
    "pin": _hinge,
    "weld": _weld,
    "block": _slider,
    "rollers": _rollers,
    "slot": _slot,
    "curve": _curved_slot,
    "follower": _cam,
    "link": _link,
    "wheel": _rolling,
    "wheels": _rolling_circles,
    "pitch_circles": _gear,
    "belt": _belt,
}
"""By the names that joints give on their cards; each takes the sketch, the name of the joint and its fields."""
