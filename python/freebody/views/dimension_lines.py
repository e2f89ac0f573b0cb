"""What coordinates measure, as arrows: angles from where they are 0, lengths along their line."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from freebody.core import GROUND, Array
from freebody.views import shapes
from freebody.views.glyphs import free_part, points_of_curve
from freebody.views.sketch import Sketch, named_points

FIGURES = 4  # of a value, where they hold
_ROUND_OFF = 1e-7  # sizes of symbols, below which a length is what assembly leaves of 0
_NO_TURN = 1e-9  # degrees, or of a curve's parameter: the same
_SEEN = 0.2  # rad, the least angle whose arc can be seen
_LEAST = 0.35  # rad, the arc that shows the sense of an angle whose own cannot be seen
_LEVELS, _ARCS = np.arange(8), np.arange(5)  # places further and further out where an arrow or an arc may keep off others
_NEARER = -0.9  # one for an angle that meets others on all of them
_APART, _TOUCH = 1.6, 0.2  # sizes of symbols between two arrows, between an arc and an arrow
_STUB, _GUIDE = 5.2, 14.0  # sizes of symbols that are shown of an arrow from far away, of a guide to bodies that are cut free
_TWO_POINTS = "direction"
_GAP = "gap"  # of a follower from its curve
_OWN_ANGLE = "phi"  # of a body by itself
_AXES = {"x": np.array([1.0, 0.0]), "y": np.array([0.0, 1.0])}


@dataclass(frozen=True)
class DimensionLine:
    """A coordinate in the fixed axes: ``arrow`` (k, 2) in its positive sense, between its zero and its value, and so from its value
    to its zero where that is ``below`` zero; ``guides`` (2, 2) to where it is 0 and, of an angle, to where it ends, and its value in
    words. An arrow of fixed size shows the sense of one that is nearly 0. ``place`` is the joint's point on the second body; an angle
    has its vertex there, or, of a direction from point to point, at the first of these. ``of_axis``: it is the angle of the second
    body's x axis."""

    coordinate: str
    first: str
    second: str
    arrow: Array
    guides: list[Array]
    place: Array
    angle: bool
    of_axis: bool
    value: str
    below: bool


@dataclass(frozen=True)
class _Asked:
    """A coordinate of a joint: ``word`` is what the joint's card calls it; ``zero`` the joint's own measure where it is 0."""

    name: str
    joint: Mapping[str, Any]
    first: str
    second: str
    word: str
    dimension: str
    value: float
    sense: int = 1
    zero: float = 0.0


@dataclass(frozen=True)
class Paper:
    """What coordinates are drawn on: ``radius`` of arcs in sizes of symbols; ``cut``: the bodies that are seen, None: all; ``far``
    in m: of a longer arrow only the end is drawn; ``taken``: lines (k, 2) that are there already; so many ``figures`` of values hold."""

    radius: float = 3.4
    cut: Collection[str] | None = None
    far: float = np.inf
    taken: Sequence[Array] = ()
    figures: int = FIGURES


_PAPER = Paper()


def dimension_lines(sketch: Sketch, paper: Paper = _PAPER) -> Iterator[DimensionLine]:
    """Every coordinate that can be drawn at the sketched state, off each other."""
    return _apart(sketch, _asked(sketch), paper)


def places(sketch: Sketch, paper: Paper = _PAPER) -> Iterator[DimensionLine]:
    """x and y of every mass centre from ``ground.O`` and the angle of every body that has one, as if each were free."""
    return _apart(sketch, _as_if_free(sketch), paper)


def _apart(sketch: Sketch, wanted: Iterable[_Asked], paper: Paper) -> Iterator[DimensionLine]:
    taken = list(paper.taken)
    for asked in wanted:
        place = place_of(sketch, asked.joint)
        if place is None or (paper.cut is not None and asked.second not in paper.cut):
            continue
        angle, offered = asked.dimension == "rad", list(_offers(sketch, asked, place, paper))
        gap, ends = (_TOUCH * sketch.size, slice(1, -1)) if angle else (_APART * sketch.size, slice(None))
        met = [sum(_distance(each[0][ends], other, gap) <= gap for other in taken) for each in offered]
        arrow, guides, shown = offered[int(np.argmin(met))]
        taken.append(arrow)
        value, unit = (float(np.degrees(asked.value)), "°") if angle else (asked.value, f" {asked.dimension}".rstrip())
        least = _ROUND_OFF * sketch.size if asked.dimension == "m" else _NO_TURN
        stated = digits(value, least, paper.figures) + unit if paper.figures else "?"
        of_axis = angle and asked.word not in (_TWO_POINTS, _OWN_ANGLE)
        arrow = arrow if shown > 0 else arrow[::-1]
        yield DimensionLine(asked.name, asked.first, asked.second, arrow, guides, place, angle, of_axis, stated, shown < 0)


def _distance(one: Array, other: Array, gap: float) -> float:
    """Between two arrows, from places close enough to see what comes within a gap; of a long one not too many."""
    steps = (max(gap / 2, shapes.length(arrow) / 200) for arrow in (one, other))
    mine, its = (shapes.dense([arrow], step) for arrow, step in zip((one, other), steps, strict=True))
    return float(np.hypot(*(mine[:, None] - its).transpose(2, 0, 1)).min())


def _asked(sketch: Sketch) -> Iterator[_Asked]:
    stated = {joint["name"]: joint for joint in sketch.spec["joints"]}
    metadata = {joint["name"]: joint for joint in sketch.metadata["joints"]}
    for coordinate, value in zip(sketch.metadata["coordinates"], sketch.q[0], strict=True):
        first, second = (metadata[coordinate["joint"]][end] for end in ("first", "second"))
        # A body that nothing joins to ground is free from its origin.
        joint = stated.get(coordinate["joint"], {"type": "free", "with": {"of": [f"{first}.origin", f"{second}.origin"]}})
        name = coordinate["name"]
        given: Mapping[str, Any] = next((c for c in joint.get("coordinates", []) if c["name"] == name), {})
        word, dimension = coordinate["word"], coordinate["dimension"]
        zero = sketch.number(given.get("zero") or 0.0)
        yield _Asked(name, joint, first, second, word, dimension, float(value), given.get("sense", 1), zero)


def _as_if_free(sketch: Sketch) -> Iterator[_Asked]:
    for body in sketch.spec["bodies"]:
        name = body["name"]
        joint = {"type": "free", "with": {"of": [f"{GROUND}.O", f"{name}.G"]}}
        place = sketch.place(f"{name}.G") - sketch.place(f"{GROUND}.O")
        yield from (
            _Asked(f"{axis}_{name}", joint, GROUND, name, axis, "m", x) for axis, x in zip("xy", place.tolist(), strict=True)
        )
        if not body["particle"]:
            angle = float(sketch.poses[0, sketch.names.index(name), 2])
            yield _Asked(f"phi_{name}", joint, GROUND, name, _OWN_ANGLE, "rad", angle)


_Offered: TypeAlias = tuple[Array, list[Array], float]
"""A line from the zero of a coordinate on, its guides, and how far it goes: the value, or of one that is nearly 0 a little more."""


def _offers(sketch: Sketch, asked: _Asked, place: Array, paper: Paper) -> Iterator[_Offered]:
    """The ways to draw a coordinate, further and further out, a length on either side."""
    if asked.dimension == "rad":
        for level in (*_ARCS, _NEARER):
            yield _angle(sketch, asked, place, (1 + 0.35 * level) * paper.radius * sketch.size, paper)
        return
    for aside in (2.6 + 2.4 * _LEVELS) * sketch.size:
        if asked.dimension:
            yield from (_length(sketch, asked, place, side * aside, paper) for side in (1, -1))
        else:
            yield _along_curve(sketch, asked, aside, paper.far)


def _angle(sketch: Sketch, asked: _Asked, place: Array, radius: float, paper: Paper) -> _Offered:
    """About the joint to the second body's x axis, or about the first of two points to the second; where the first is on no body
    that is seen, about the second, which they hold."""
    if asked.word == _TWO_POINTS:
        at, along = _outwards(sketch, asked.joint)
        end = float(np.arctan2(*along[::-1]))
        at = at if paper.cut is None or asked.first in paper.cut else place
    else:
        at, end = place, float(sketch.poses[0, sketch.names.index(asked.second), 2])
    turn = float(np.fmod(asked.value, 2 * np.pi))
    start, shown = end - asked.sense * turn, turn if abs(turn) > _SEEN else _LEAST
    guides = [np.array([at, at + 1.25 * radius * np.array([np.cos(way), np.sin(way)])]) for way in (start, end)]
    return shapes.arc(at, radius, start, start + asked.sense * shown), guides, shown


def _length(sketch: Sketch, asked: _Asked, place: Array, aside: float, paper: Paper) -> _Offered:
    """Beside the way from where the joint would be at 0."""
    along = _way(sketch, asked)
    if asked.word == _GAP:  # measured to the rim of the follower
        place = place - sketch.number(asked.joint["with"]["follower"]["radius"]) * along
    zero = place - asked.value * asked.sense * along
    shown = asked.value if abs(asked.value) > sketch.size else 3 * sketch.size
    left = aside * np.array([-along[1], along[0]])
    arrow = np.array([zero, zero + shown * asked.sense * along]) + left
    foot = sketch.place(asked.joint["with"]["of"][0]) if asked.word in _AXES else zero
    guides = [np.array([foot, arrow[0] + 0.2 * left])]
    guides += [np.array([place, place + 1.2 * left])] * (shown == asked.value)
    longest = paper.far if paper.cut is None else min(paper.far, _GUIDE * sketch.size)
    if abs(shown) > paper.far:
        return _end(arrow, _STUB * sketch.size), [], shown
    return arrow, [guide for guide in guides if shapes.length(guide) <= longest], shown


def _along_curve(sketch: Sketch, asked: _Asked, aside: float, far: float) -> _Offered:
    """Beside the curve from where the coordinate is 0."""
    curve = _curve_of(sketch, asked.joint)
    start = points_of_curve(sketch, curve, asked.zero + np.array([0.0, 1e-4]))
    least = sketch.size * 1e-4 / float(np.hypot(*(start[1] - start[0])))
    end = asked.value if abs(asked.value) > least else 3 * least
    line = sketch.moved(curve["body"], points_of_curve(sketch, curve, asked.zero + asked.sense * np.linspace(0.0, end, 61)))
    slopes = np.gradient(line, axis=0) * np.sign(end) * asked.sense
    left = aside * np.column_stack([-slopes[:, 1], slopes[:, 0]]) / np.hypot(*slopes.T)[:, None]
    if shapes.length(line) > far:
        return _end(line + left, _STUB * sketch.size), [], end
    return line + left, [np.array([line[0], line[0] + 1.2 * left[0]])], end


def _end(line: Array, length: float) -> Array:
    """The last stretch of a polyline."""
    left = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line[::-1], axis=0).T))])
    shown = np.linspace(length, 0.0, len(line))
    return np.column_stack([np.interp(shown, left, coordinate) for coordinate in line[::-1].T])


def _curve_of(sketch: Sketch, joint: Mapping[str, Any]) -> Mapping[str, Any]:
    return next(each for each in sketch.spec["curves"] if each["name"] == joint["with"]["along"])


def _normal(sketch: Sketch, asked: _Asked) -> Array:
    """Unit direction from the place of a curve that is nearest to its follower to that."""
    s = next(c["name"] for c in sketch.metadata["coordinates"] if c["joint"] == asked.joint["name"])
    near = points_of_curve(sketch, _curve_of(sketch, asked.joint), sketch.travel(s)[0] + np.array([-1e-4, 1e-4]))
    x, y = (near[1] - near[0]) * (-1.0 if asked.joint["with"].get("right") else 1.0)
    return np.array([-y, x]) / np.hypot(x, y)


def place_of(sketch: Sketch, joint: Mapping[str, Any]) -> Array | None:
    """Where a joint is: at the point of its second body."""
    fields = joint["with"]
    if "drum" in fields:
        return free_part(sketch, fields)[0, 1]
    if "line" in fields:
        body, point, _ = sketch.line(fields["line"])
        return sketch.moved(body, point[None])[0]
    for key in ("point", "points", "circle", "follower", "of"):
        names = [name for name in named_points(fields.get(key, [])) if name in sketch.at]
        if names:
            return sketch.place(names[-1] if key == "of" else names[0])
    return None


def place_between(sketch: Sketch, bodies: Set[str]) -> Array | None:
    """Where a joint of two bodies is, if there is one that has a place."""
    between = {joint["name"] for joint in sketch.metadata["joints"] if {joint["first"], joint["second"]} == bodies}
    places = (place_of(sketch, joint) for joint in sketch.spec["joints"] if joint["name"] in between)
    return next((place for place in places if place is not None), None)


def _outwards(sketch: Sketch, joint: Mapping[str, Any]) -> tuple[Array, Array]:
    """The first of two points, and the unit direction from it in which their distance ``r`` grows: to the second where that is
    positive, or no coordinate."""
    fields = joint["with"]
    if "drum" in fields:
        first, second = free_part(sketch, fields)[0]
    else:
        names = fields["of"] if "of" in fields else (fields["on"]["centre"], fields["circle"]["centre"])
        first, second = (sketch.place(name) for name in names)
    words = [(each["joint"], each["word"]) for each in sketch.metadata["coordinates"]]
    distance = float(np.hypot(*(second - first))) or 1.0
    below = (joint.get("name"), "r") in words and sketch.q[0, words.index((joint.get("name"), "r"))] < 0
    return first, (first - second if below else second - first) / distance


def _way(sketch: Sketch, asked: _Asked) -> Array:
    """Unit direction in which a length grows: an axis of the first body, from the first point to the second, the normal of a curve,
    or the line's."""
    fields = asked.joint["with"]
    if asked.word in ("r", "length"):
        return _outwards(sketch, asked.joint)[1]
    if asked.word in _AXES:
        body, along = asked.first, _AXES[asked.word]
    elif asked.word == _GAP:
        body, along = asked.first, _normal(sketch, asked)
    else:
        body, _, along = sketch.line(fields.get("along") or fields["on"])
    return shapes.turn(along[None], float(sketch.poses[0, sketch.names.index(body), 2]))[0]


def digits(value: float, least: float = 0.0, most: int = FIGURES) -> str:
    """Four digits for people, or as many as hold; 0 of what is smaller than ``least``."""
    return f"{0.0 if abs(value) < least else value:.{most}g}".replace("-", "−")
