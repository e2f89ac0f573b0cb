"""Points of bodies on the wrong side of a fixed line that holds others off: they have no contact with it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import GROUND, Array

if TYPE_CHECKING:
    from freebody.run.simulation import Run

_CLEARLY = 1e-6
"""Part of the largest distance of a point from a line within which it is on the line."""


def passages(run: Run) -> list[str]:
    """A sentence for each fixed line through which a named point of a body goes, without a contact of the two, or behind which one starts
    while another of its body touches it; other bodies of which that is so are named in the same."""
    touched: dict[str, tuple[Mapping[str, Any], str, list[Mapping[str, Any]]]] = {}
    for contact in run.source.spec["contacts"]:
        for surface, other in (contact["of"], contact["of"][::-1]):
            if "line" in surface and run.points[surface["line"]["point"]][0] == GROUND:
                touched.setdefault(repr(surface), (surface["line"], contact["name"], []))[2].append(other)
    found = []
    for line, contact, held in touched.values():
        behind, kept = dict[str, tuple[str, str]](), [_covered(run, surface) for surface in held]
        for name, (body, *_) in run.points.items():
            if body in (GROUND, *behind) or name.endswith(".origin") or any(name in names for names in kept):
                continue
            height = _height(run.closely, line, name)
            touches = any(run.points[names[0]][0] == body for names in kept)
            if when := _behind(run.closely.t, height, touches):
                behind[body] = name, when
        if behind:
            (name, when), *others = behind.values()
            too = f" ({'so do' if others[1:] else 'so does'} {', '.join(f'`{other}`' for other, _ in others)})" if others else ""
            found.append(
                f"`{name}` {when} the line of the contact `{contact}`{too}, and has no contact there, so nothing holds it; "
                "where something should, give it one of its own"
            )
    return found


def _covered(run: Run, surface: Mapping[str, Any]) -> list[str]:
    """The points that a surface which touches keeps off: those within a circle, or all of a body with another outline."""
    [(kind, shape)] = surface.items()
    centre, radius = (shape["centre"], shape["radius"]) if kind == "circle" else (shape, 0.0)
    if kind in ("point", "circle"):
        (body, *at), reach = run.points[centre], _number(run, radius)
        places = run.points.items()
        return [name for name, (own, *there) in places if own == body and math.dist(at, there) <= (1 + _CLEARLY) * reach]
    first = shape["start"] if kind == "track" else shape["point"] if kind == "line" else shape[0]
    return [name for name, (body, *_) in run.points.items() if body == run.points[first][0]]


def _number(run: Run, value: float | str) -> float:
    return float(run.source.evaluate([value], run.start)[0]) if isinstance(value, str) else float(value)


def _height(run: Run, line: Mapping[str, Any], name: str) -> Array:
    """How far (nt,) a point is from a fixed line, positive on its free side, m."""
    at = np.array(run.points[line["point"]][1:])
    if line.get("towards"):
        x, y = np.array(run.points[line["towards"]][1:]) - at
    else:
        angle = _number(run, line.get("angle") or 0.0)
        x, y = np.cos(angle), np.sin(angle)
    return (run.point(name) - at) @ (np.array([-y, x]) / np.hypot(x, y))


def _behind(t: Array, height: Array, touches: bool) -> str:
    """How a point comes to be clearly behind; nothing where it does not, or was so from the start and its body does not touch."""
    clearly = _CLEARLY * np.abs(height).max()
    if height[0] < -clearly:
        return "starts behind" if touches else ""
    front = np.flatnonzero(height > clearly)
    behind = np.flatnonzero(height < -clearly)
    behind = behind[behind > front[0]] if front.size else front
    if not behind.size:
        return ""
    after, before = behind[0], front[front < behind[0]][-1]
    when = t[before] + (t[after] - t[before]) * height[before] / (height[before] - height[after])
    return f"passes, at t = {when:.4g} s, through"
