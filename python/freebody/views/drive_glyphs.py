"""How torsion springs look, and what drives a joint: a spiral and a turning arrow about a hinge, an arrow along a guide."""

from __future__ import annotations

from typing import Any

import numpy as np

from freebody.core import GROUND, Array
from freebody.views import shapes
from freebody.views.glyphs import guided_point
from freebody.views.sketch import Sketch

_TURN, _SPIRAL = 2.2, (0.7, 1.9)  # sizes of symbols: radius of a turning arrow, first and last radius of a spiral
_TURNS = 2.25
_HEAD = 0.6
_ASIDE, _LONG = 2.4, 2.0  # sizes of symbols: how far from a guide an arrow along it lies, and half its length


def draw_drives(sketch: Sketch) -> None:
    """Of every torsion spring, torque between bodies on a hinge, and motion that is prescribed to a joint, once a place."""
    for force in sketch.spec.get("forces", []):
        bodies = {force["with"].get("on"), force["with"].get("from") or GROUND}
        if force["type"] in ("torsion_spring", "torque") and (hinge := _hinge(sketch, bodies)):
            _about(sketch, hinge, _spiral() if force["type"] == "torsion_spring" else _turning())
    coordinates = {joint["name"]: joint["coordinates"] for joint in sketch.metadata["joints"]}
    driven = {motion["of"] for motion in sketch.spec.get("motions", [])}
    for joint in sketch.spec["joints"]:
        if not driven & set(coordinates.get(joint["name"], [])[:1]):
            continue
        if joint["type"] == "hinge":
            _about(sketch, joint, _turning())
        elif point := guided_point(joint):
            _along(sketch, joint, point)


def _hinge(sketch: Sketch, bodies: set[Any]) -> dict[str, Any] | None:
    """The hinge between two bodies."""
    found = (
        joint
        for joint in sketch.spec["joints"]
        if joint["type"] == "hinge" and {sketch.at[point][0] for point in joint["with"]["of"]} == bodies
    )
    return next(found, None)


def _about(sketch: Sketch, hinge: dict[str, Any], lines: list[Array]) -> None:
    """Lines in sizes of symbols about the first point of a hinge."""
    body, at = sketch.at[hinge["with"]["of"][0]]
    for line in lines:
        sketch.figures[body].add(at + sketch.size * line, "coil", closed=False, about=at)


def _along(sketch: Sketch, joint: dict[str, Any], point: str) -> None:
    """An arrow to and fro beside what a guide leads, along the guide."""
    carrier, _, way = sketch.line(joint["with"]["along"])
    body, at = sketch.at[point]
    poses = sketch.poses[0, [sketch.names.index(carrier), sketch.names.index(body)], 2]
    line = _LONG * np.array([[-1.0, 0.0], [1.0, 0.0]]) + (0, _ASIDE)
    turned = float(np.arctan2(way[1], way[0]) + poses[0] - poses[1])
    for stroke in (line, _head(line[1], 0.0), _head(line[0], np.pi)):
        sketch.figures[body].add(at + sketch.size * shapes.turn(stroke, turned), "coil", closed=False, about=at)


def _spiral() -> list[Array]:
    angle = np.linspace(0, 2 * np.pi * _TURNS, 90)
    radius = np.linspace(*_SPIRAL, 90)
    return [np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])]


def _turning() -> list[Array]:
    start, end = -0.25 * np.pi, 1.1 * np.pi
    arc = shapes.arc((0, 0), _TURN, start, end)
    return [arc, _head(arc[-1], end + np.pi / 2)]


def _head(tip: Array, way: float) -> Array:
    """The open head of an arrow that points along an angle."""
    return tip + shapes.turn(np.array([[-1.0, 0.55], [0.0, 0.0], [-1.0, -0.55]]) * _HEAD, way)
