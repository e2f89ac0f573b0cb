"""What coordinates measure, as arrows: angles from where they are 0, lengths along their line."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from freebody.results import Array
from freebody.views import shapes
from freebody.views.scene import GROUND, Sketch, named_points

_POINT_TO_POINT = ("link", "rolling_circles", "polar")
_ROUND_OFF = 1e-9  # m or degrees, below which a coordinate is told as 0


@dataclass(frozen=True)
class Measure:
    """A coordinate in the fixed axes: ``arrow`` (k, 2) from its zero to its value, ``guide`` (2, 2) to where it is 0, and its
    value in words. An arrow of fixed size shows the sense of a coordinate that is 0. ``place`` is the joint's point on the second
    body; an angle has its vertex there, or, of a link, at its other end."""

    coordinate: str
    first: str
    second: str
    arrow: Array
    guide: Array
    place: Array
    angle: bool
    value: str


def measures(sketch: Sketch, radius: float = 3.4) -> Iterator[Measure]:
    """Every coordinate that can be drawn at the sketched state; ``radius`` of the arcs in sizes of symbols."""
    joints = {joint["name"]: joint for joint in sketch.spec["joints"]}
    bodies = {joint["name"]: (joint["first"], joint["second"]) for joint in sketch.about["joints"]}
    for i, coordinate in enumerate(sketch.about["coordinates"]):
        joint, name = joints.get(coordinate["joint"]), coordinate["name"]
        place = joint and place_of(sketch, joint)
        if joint is None or place is None:
            continue
        value = float(sketch.q[0, i])
        given: Mapping[str, Any] = next((c for c in joint.get("coordinates", []) if c["name"] == name), {})
        sense, angle = given.get("sense", 1), coordinate["dimension"] == "rad"
        drawn = _angle(sketch, joint, value, sense, radius) if angle else _length(sketch, joint, value, sense)
        if drawn is not None:
            told = f"{digits(np.degrees(value))}°" if angle else f"{digits(value)} m"
            yield Measure(name, *bodies[joint["name"]], *drawn, place, angle, told)


def _angle(sketch: Sketch, joint: Mapping[str, Any], value: float, sense: int, radius: float) -> tuple[Array, Array] | None:
    at, end = _vertex(sketch, joint), _direction(sketch, joint)
    if at is None or end is None:
        return None
    angle = np.fmod(value, 2 * np.pi) if abs(value) > 0.1 else 0.35
    start, far = end - sense * np.fmod(value, 2 * np.pi), radius * sketch.size
    guide = np.array([at, at + 1.25 * far * np.array([np.cos(start), np.sin(start)])])
    return shapes.arc(at, far, start, start + sense * angle), guide


def _length(sketch: Sketch, joint: Mapping[str, Any], value: float, sense: int) -> tuple[Array, Array] | None:
    at, along = place_of(sketch, joint), _way(sketch, joint)
    if at is None or along is None:
        return None
    way = along * sense
    aside = 2.6 * sketch.size * np.array([along[1], -along[0]])
    shown = value if abs(value) > sketch.size else 3 * sketch.size
    start = at - value * way
    arrow = np.array([start, start + shown * way]) - aside
    return arrow, np.array([start, arrow[0] - 0.2 * aside])


def place_of(sketch: Sketch, joint: Mapping[str, Any]) -> Array | None:
    """Where a joint is: at the point of its second body."""
    fields = joint["with"]
    for key in ("point", "points", "circle", "follower", "line", "of"):
        names = [name for name in named_points(fields.get(key, [])) if name in sketch.at]
        if names:
            return sketch.place(names[-1] if key == "of" else names[0])
    return None


def _vertex(sketch: Sketch, joint: Mapping[str, Any]) -> Array | None:
    """Where the joint's angle is measured: at the first of two points, else at the joint."""
    return sketch.place(_two_points(joint)[0]) if joint["type"] in _POINT_TO_POINT else place_of(sketch, joint)


def _direction(sketch: Sketch, joint: Mapping[str, Any]) -> float | None:
    """Where the joint's angle points to: along the second body's x axis, or from point to point."""
    if joint["type"] in _POINT_TO_POINT:
        first, second = (sketch.place(name) for name in _two_points(joint))
        return float(np.arctan2(*(second - first)[::-1]))
    about = next(j for j in sketch.about["joints"] if j["name"] == joint["name"])
    return None if about["second"] == GROUND else float(sketch.poses[0, sketch.names.index(about["second"]), 2])


def _two_points(joint: Mapping[str, Any]) -> tuple[str, str]:
    fields = joint["with"]
    return tuple(fields["of"]) if "of" in fields else (fields["on"]["centre"], fields["circle"]["centre"])


def _way(sketch: Sketch, joint: Mapping[str, Any]) -> Array | None:
    """Unit direction in which a length grows: along the joint's line, or from the first point to the second."""
    if joint["type"] == "polar":
        first, second = (sketch.place(name) for name in _two_points(joint))
        gap = float(np.hypot(*(second - first)))
        return (second - first) / gap if gap else None
    line = joint["with"].get("along") or joint["with"].get("on")
    if not isinstance(line, Mapping) or "point" not in line:
        return None
    body, _, along = sketch.line(line)
    return shapes.turn(along[None], float(sketch.poses[0, sketch.names.index(body), 2]))[0]


def digits(value: float) -> str:
    """Four digits for people."""
    return f"{0.0 if abs(value) < _ROUND_OFF else value:.4g}".replace("-", "−")
