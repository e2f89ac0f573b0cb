"""How joints and forces look: one short function a glyph, drawn on a ``Sketch`` in body frames."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from freebody.core import GROUND, Array
from freebody.core.cards import joints
from freebody.views import shapes
from freebody.views.sketch import Cord, Sketch, Stroke

Fields = Mapping[str, Any]
_SLENDER, _WHEEL = 2.5, 0.9  # sizes of symbols: the width of a bar or particle at most; the radius of a roller
_SEEN, _STOUT = 1.6, 0.3  # the width of a small block at least: in sizes of symbols, that of a bar; in its own extents
Place = tuple[str, Array]
"""A body, and where on it, in its frame (2,)."""
_NEAR, _ROOM = 0.15, 0.4
"""Of a spring along a line, parts of its travel: how near its end comes to the beginning of the line, and how long it is at least."""
_PARALLEL = 1e-6  # rad


def draw_joints(sketch: Sketch) -> None:
    """Every joint as its card says; what holds, pins and welds, is drawn only as long as the joint is there."""
    for joint in sketch.spec["joints"]:
        card, there = joints()[joint["type"]], sketch.there(joint["name"], joint.get("engaged", True))
        for point in joint["with"]["of"] if card.outline else ():
            body, at = sketch.at[point]
            angle = -float(sketch.poses[0, sketch.names.index(body), 2])  # alike along the fixed axes at the start
            lines = [shapes.turn(sketch.size * np.array(stroke), angle, at) for stroke in card.outline]
            sketch.figures[body].strokes.extend(Stroke(line, "rail", False, there) for line in lines)
        if symbol := GLYPHS.get(card.glyph):
            known = {id(stroke) for figure in sketch.figures.values() for stroke in figure.strokes}
            symbol(sketch, joint["name"], joint["with"])
            for figure in sketch.figures.values() if not there.all() else ():
                for i, stroke in enumerate(figure.strokes):
                    if id(stroke) not in known and stroke.style in ("pin", "weld"):
                        figure.strokes[i] = replace(stroke, shown=there)


def draw_forces(sketch: Sketch) -> None:
    """Springs and dampers, between points and along coordinates."""
    for force in sketch.spec.get("forces", []):
        fields = force["with"]
        if force["type"] not in ("spring", "damper") or (ends := _ends(sketch, fields)) is None:
            continue
        width, there = 0.9 * sketch.size, force.get("engaged", True)
        spring, damper = force["type"] == "spring", bool(fields.get("damping"))
        apart = 1.3 * sketch.size if spring and damper else 0.0
        looks = {"spring": [_beside(shapes.zigzag(width), apart)]} if spring else {}
        looks |= {"damper": [_beside(line, -apart) for line in shapes.dashpot(width)]} if damper else {}
        for kind, lines in looks.items():
            sketch.pair(force["name"], kind, ends, lines, there)


def _ends(sketch: Sketch, fields: Fields) -> list[Place] | None:
    """The places on two bodies between which a spring or damper is drawn; None where it acts along no line."""
    if "between" in fields:
        return [sketch.at[point] for point in fields["between"]]
    along = fields["along"]
    if (joint := _measured_by(sketch, along)) and joint["type"] == "polar":
        return [sketch.at[point] for point in joint["with"]["of"]]
    if joint and (point := guided_point(joint)):
        return _from_wall(sketch, *sketch.line(joint["with"]["along"]), point)
    if (parts := along.split(" - "))[1:]:
        return _between_guided(sketch, parts)
    if (found := re.fullmatch(r"([xy])\((.+)\)", along)) and found[2] in sketch.at:
        way = np.array([1.0, 0.0] if found[1] == "x" else [0.0, 1.0])
        middle = sketch.seen_from(GROUND, found[2]).mean(axis=0) * way[::-1]
        return _from_wall(sketch, GROUND, middle, way, found[2])
    return None


def _measured_by(sketch: Sketch, coordinate: str) -> Mapping[str, Any] | None:
    """The joint whose first coordinate it is."""
    named = {each["coordinates"][0]: each["name"] for each in sketch.metadata["joints"] if each["coordinates"]}
    return next((joint for joint in sketch.spec["joints"] if joint["name"] == named.get(coordinate)), None)


def _between_guided(sketch: Sketch, coordinates: Sequence[str]) -> list[Place] | None:
    """Of a difference of two coordinates: the points that go along parallel lines of one body."""
    guided = [joint for name in coordinates if (joint := _measured_by(sketch, name)) and guided_point(joint)]
    if len(guided) != 2:
        return None
    (first, _, one), (second, _, other) = (sketch.line(joint["with"]["along"]) for joint in guided)
    if first != second or abs(one[0] * other[1] - one[1] * other[0]) > _PARALLEL:
        return None
    return [sketch.at[str(guided_point(joint))] for joint in reversed(guided)]


def guided_point(joint: Mapping[str, Any]) -> str | None:
    """The point that a slot, a slider or rollers lead along a line; None of any other joint."""
    own = joint["with"]
    if joint["type"] not in ("slot", "slider", "rollers"):
        return None
    point: str = own.get("point") or (own["points"][0] if "points" in own else own["line"]["point"])
    return point


def _from_wall(sketch: Sketch, body: str, origin: Array, along: Array, point: str) -> list[Place]:
    """From where a line begins to a point that goes along it; where that comes near the beginning or passes it, from a place before."""
    reach = (sketch.seen_from(body, point) - origin) @ along
    if reach.max() < _NEAR * reach.min():
        along, reach = -along, -reach
    start = 0.0 if reach.min() > _NEAR * reach.max() else reach.min() - max(_ROOM * np.ptp(reach), 8 * sketch.size)
    wall = origin + start * along
    if body == GROUND:
        side = 1.2 * sketch.size * np.array([along[1], -along[0]])
        sketch.hatched(body, wall + np.array([-side, side]), about=wall)
    return [(body, wall), sketch.at[point]]


def _beside(line: Array, across: float) -> Array:
    """A line moved aside, still from end to end."""
    moved = line + (0.0, across)
    ends = ([line[0]] if line[0, 0] == 0 else [], [line[-1]] if line[-1, 0] == 1 else [])
    return np.array([*ends[0], *moved, *ends[1]]) if across else line


def _hinge(sketch: Sketch, name: str, fields: Fields) -> None:
    for point in fields["of"]:
        if sketch.at[point][0] == GROUND:
            _support(sketch, sketch.at[point][1])
    sketch.pin(fields["of"][0], 0.55)


def _support(sketch: Sketch, at: Array) -> None:
    """A bearing block standing on hatched ground."""
    s = sketch.size
    feet = at + np.array([[-1.1 * s, -2.0 * s], [1.1 * s, -2.0 * s]])
    sketch.figures[GROUND].add(np.vstack([feet[0], shapes.arc(at, 0.9 * s, np.pi, 0.0), feet[1]]), "block", about=at)
    sketch.hatched(GROUND, at + np.array([[-1.9 * s, -2.0 * s], [1.9 * s, -2.0 * s]]), about=at)


def _travelled(sketch: Sketch, line: Any, points: list[str], margin: float) -> tuple[str, Array, Array]:
    """Body, ends (2, 2) and direction of the part of a line that points travel along."""
    body, origin, along = sketch.line(line)
    reach = np.concatenate([(sketch.seen_from(body, point) - origin) @ along for point in points])
    return body, np.array([origin + (reach.min() - margin) * along, origin + (reach.max() + margin) * along]), along


def _track(sketch: Sketch, line: Any, points: list[str], below: float) -> None:
    """The line that something slides or rolls on, ``below`` it."""
    body, ends, along = _travelled(sketch, line, points, 3 * sketch.size)
    sketch.rail(body, ends + below * np.array([along[1], -along[0]]))


def _slider(sketch: Sketch, name: str, fields: Fields) -> None:
    body, point, along = sketch.line(fields["line"])
    half, right = sketch.size * np.array(sketch.block), np.array([along[1], -along[0]])
    height = above = float(half[1])
    own = [stroke.points for stroke in sketch.figures[body].strokes if stroke.closed]
    if any(_stout(sketch, outline) for outline in own):  # the body is a block of its own
        across = (np.vstack(own) - point) @ right
        height, above = float(across.max()), float(-across.min())
    else:
        block = shapes.turn(shapes.box(*2 * half), float(np.arctan2(along[1], along[0])), point)
        sketch.figures[body].add(block, "block")
    sketch.faces[name] = body, point + np.outer([height, -above], right)
    if isinstance(fields["line"], Mapping) and fields["line"]["point"]:
        _track(sketch, fields["along"], [fields["line"]["point"]], height)


def _stout(sketch: Sketch, outline: Array) -> bool:
    """Whether an outline is that of a block: wide beside symbols, or seen and wide beside its own length."""
    wide = shapes.width(outline)
    return wide > _SLENDER * sketch.size or (
        wide > _SEEN * sketch.size and wide > _STOUT * float(np.hypot(*np.ptp(outline, axis=0)))
    )


def _rollers(sketch: Sketch, name: str, fields: Fields) -> None:
    body, _ = sketch.at[fields["points"][0]]
    own = sketch.looks.get(body, {}).get("wheels")
    radius = _WHEEL * sketch.size if own is None else sketch.number(own)
    wheels = [shapes.circle(sketch.at[point][1], radius) for point in fields["points"]]
    for wheel in wheels:
        sketch.figures[body].add(wheel, "slot" if own is None else "block")
    sketch.faces[name] = body, np.vstack(wheels)
    _track(sketch, fields["along"], list(fields["points"]), radius)


def _slot(sketch: Sketch, name: str, fields: Fields) -> None:
    body, ends, along = _travelled(sketch, fields["along"], [fields["point"]], 0.0)
    if isinstance(fields["along"], Mapping) and fields["along"].get("towards"):
        ends = np.vstack([ends, *(sketch.at[fields["along"][key]][1] for key in ("point", "towards"))])
        ends = ends[[(ends @ along).argmin(), (ends @ along).argmax()]]
    sketch.figures[body].add(shapes.rounded_hull(ends, 0.45 * sketch.size), "slot")
    sketch.pin(fields["point"], 0.45)


def _curve(sketch: Sketch, name: str, fields: Fields) -> None:
    """The stretch of a curve that the motion runs along, and a little more at both ends, with the pin or follower on it; hatched on the
    side away from a follower."""
    curve = next(c for c in sketch.spec["curves"] if c["name"] == fields["along"])
    if coordinates := next(j for j in sketch.metadata["joints"] if j["name"] == name)["coordinates"]:
        start, end = sketch.travel(coordinates[0])
        near = points_of_curve(sketch, curve, np.array([start, start + 1e-4]))
        margin = 12 * sketch.size / max(float(np.hypot(*(near[1] - near[0]))) / 1e-4, 1e-9)
        points = points_of_curve(sketch, curve, np.linspace(start - margin, end + margin, 181))
        if "follower" in fields:
            sketch.hatched(curve["body"], points[::-1] if fields.get("right") else points)
        else:
            sketch.figures[curve["body"]].add(points, "rail", closed=False)
    if "follower" in fields:
        sketch.wheel(fields["follower"], "block")
    else:
        sketch.pin(fields["point"], 0.45)


def points_of_curve(sketch: Sketch, curve: Mapping[str, Any], parameter: Array) -> Array:
    """Points (k, 2) of a curve in its body's frame."""
    texts = [re.sub(r"(?<![\w.'])s(?![\w(.'])", f"({float(s)!r})", curve[axis]) for s in parameter for axis in ("x", "y")]
    return sketch.values(texts).reshape(-1, 2)


def _rolling(sketch: Sketch, name: str, fields: Fields) -> None:
    circle = fields["circle"]
    sketch.wheel(circle, "mark")
    body, ends, _ = _travelled(sketch, fields["on"], [circle["centre"]], sketch.number(circle["radius"]) + 2 * sketch.size)
    sketch.rail(body, ends)


def _rolling_circles(sketch: Sketch, name: str, fields: Fields) -> None:
    sketch.wheel(fields["circle"], "mark")
    sketch.wheel(fields["on"], "mark")


def _skate(sketch: Sketch, name: str, fields: Fields) -> None:
    body, at, along = sketch.line(fields["line"])
    across = 0.25 * np.array([-along[1], along[0]])
    corners = [sketch.size * (s * along + t * across) for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    sketch.figures[body].add(at + np.array(corners), "weld")


def _weld(sketch: Sketch, name: str, fields: Fields) -> None:
    s, (body, at) = sketch.size, sketch.at[fields["of"][0]]
    sketch.figures[body].add(at + shapes.box(0.9 * s, 0.9 * s), "weld", about=at)
    if body == GROUND:
        sketch.hatched(body, at + np.array([[-1.6 * s, -0.45 * s], [1.6 * s, -0.45 * s]]), about=at)


def _link(sketch: Sketch, name: str, fields: Fields) -> None:
    sketch.pair(name, "link", [sketch.at[point] for point in fields["of"]], [np.array([[0.0, 0.0], [1.0, 0.0]])])
    for point in fields["of"]:
        body, at = sketch.at[point]
        if body == GROUND:
            _support(sketch, at)
        sketch.pin(point, 0.4)


def _gear(sketch: Sketch, name: str, fields: Fields) -> None:
    for point, radius in zip(fields["of"], fields["radii"], strict=True):
        sketch.wheel({"centre": point, "radius": radius}, "dash")


def _belt(sketch: Sketch, name: str, fields: Fields) -> None:
    _gear(sketch, name, fields)
    first, second = (sketch.number(radius) for radius in fields["radii"])
    owner, at = sketch.at[fields["of"][0]]
    distance = float(np.hypot(*(sketch.seen_from(owner, fields["of"][1])[0] - at)))
    side = -1.0 if fields.get("crossed") else 1.0
    tilt = np.arcsin(np.clip((first - side * second) / distance, -1.0, 1.0))
    strand = np.array([[first * np.sin(tilt) / distance, first * np.cos(tilt)],
                       [1 + side * second * np.sin(tilt) / distance, side * second * np.cos(tilt)]])  # fmt: skip
    sketch.pair(name, "belt", [sketch.at[point] for point in fields["of"]], [strand, strand * (1, -1)])


def _wound_string(sketch: Sketch, name: str, fields: Fields) -> None:
    sketch.wheel(fields["drum"], "mark")
    path = free_part(sketch, fields)
    sketch.cords.append(Cord(name, path, np.full(len(path), True), sketch.there(name)))


def free_part(sketch: Sketch, fields: Fields) -> Array:
    """The free part (nt, 2, 2) of a wound string in the fixed axes: from where it is tied to where it touches its drum."""
    drum = fields["drum"]
    tied, centre = (sketch.seen_from(GROUND, point) @ (1.0, 1.0j) for point in (fields["from"], drum["centre"]))
    radius = sketch.number(drum["radius"]) * (-1.0 if fields.get("right") else 1.0)
    length = np.sqrt(np.maximum(np.abs(centre - tied) ** 2 - radius**2, 0.0))
    touching = tied + length * (centre - tied) / (length + 1j * radius)
    return np.stack([np.column_stack([place.real, place.imag]) for place in (tied, touching)], axis=1)


GLYPHS: dict[str, Callable[[Sketch, str, Fields], None]] = {
    "pin": _hinge,
    "weld": _weld,
    "block": _slider,
    "rollers": _rollers,
    "slot": _slot,
    "curve": _curve,
    "follower": _curve,
    "link": _link,
    "skate": _skate,
    "wheel": _rolling,
    "wheels": _rolling_circles,
    "pitch_circles": _gear,
    "belt": _belt,
    "wound_string": _wound_string,
}
"""By the names that joints give on their cards; each takes the sketch, the name of the joint and its fields."""
