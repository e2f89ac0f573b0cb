"""Plane outlines as polylines: pure geometry, in the axes of whoever asks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from freebody.core import Array

_ARC_STEP = np.pi / 60
_TIP = 3.0  # radii, the length of a tip
NONE = np.zeros((0, 2))


def turn(points: Array, angle: float, at: ArrayLike = (0.0, 0.0)) -> Array:
    """Points (k, 2) turned counter-clockwise by an angle (rad) about the origin, then moved by ``at``."""
    c, s = np.cos(angle), np.sin(angle)
    turned: Array = np.asarray(points, float) @ np.array([[c, s], [-s, c]]) + np.asarray(at, float)
    return turned


def length(line: Array) -> float:
    """That of a polyline."""
    return float(np.hypot(*np.diff(line, axis=0).T).sum())


def width(outline: Array) -> float:
    """How wide it is on the whole: its area by its largest extent."""
    x, y = outline.T
    return float(abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2 / np.hypot(*(outline - outline[0]).T).max())


def inside(outline: Array, places: Array) -> Array:
    """Which of some places (k, 2) are within an outline, (k,): those from which a way to the right crosses it an odd number of times.
    Matplotlib knows this too, but a report would wait for it to load."""
    (x0, y0), (x1, y1) = outline.T, np.roll(outline, -1, axis=0).T
    x, y = np.asarray(places, float).T[:, :, None]
    rise = np.where(y1 == y0, 1.0, y1 - y0)
    crossed = ((y0 > y) != (y1 > y)) & (x < x0 + (y - y0) * (x1 - x0) / rise)
    within: Array = crossed.sum(axis=1) % 2 == 1
    return within


def arc(centre: ArrayLike, radius: float, start: float, end: float) -> Array:
    """An arc from one angle to another (rad)."""
    angles = np.linspace(start, end, max(2, int(np.ceil(abs(end - start) / _ARC_STEP)) + 1))
    return np.asarray(centre, float) + radius * np.column_stack([np.cos(angles), np.sin(angles)])


def circle(centre: ArrayLike, radius: float) -> Array:
    """A full circle, its last point short of its first."""
    return arc(centre, radius, 0.0, 2 * np.pi)[:-1]


def box(width: float, height: float) -> Array:
    """Corners of a rectangle about the origin."""
    return np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * (width / 2, height / 2)


def convex_hull(points: Array) -> Array:
    """Corners of the convex hull, counter-clockwise (Andrew's monotone chain)."""
    ordered = np.unique(np.round(np.asarray(points, float), 12), axis=0)
    if len(ordered) < 3:
        return ordered
    lower, upper = _chain(ordered), _chain(ordered[::-1])
    return np.array(lower[:-1] + upper[:-1])


def _chain(ordered: Array) -> list[Array]:
    chain: list[Array] = []
    for point in ordered:
        while len(chain) > 1:
            (ax, ay), (bx, by) = chain[-1] - chain[-2], point - chain[-2]
            if ax * by - ay * bx > 1e-12:
                break
            chain.pop()
        chain.append(point)
    return chain


def rounded_hull(points: Array, radius: float, tips: Array = NONE) -> Array:
    """All places within a radius of the convex hull: a disk for one point, a capsule for two. Where one of the points is among the
    ``tips`` (k, 2), the shape ends in it, in a tip."""
    middle = points.mean(axis=0)
    pointed = np.array(
        [(np.hypot(*(tips - point).T) < 1e-9 + 1e-6 * radius).any() and (point != middle).any() for point in points]
    )
    if pointed.any():
        ways = middle - points[pointed]
        lengths = np.hypot(*ways.T)[:, None]
        blunt = points[pointed] + ways / lengths * np.minimum(_TIP * radius, lengths)
        return convex_hull(np.vstack([rounded_hull(np.vstack([points[~pointed], blunt]), radius), points[pointed]]))
    hull = convex_hull(points)
    if len(hull) == 1:
        return circle(hull[0], radius)
    edges = np.roll(hull, -1, axis=0) - hull
    normals = np.arctan2(edges[:, 1], edges[:, 0]) - np.pi / 2
    before = np.roll(normals, 1)
    return np.vstack([arc(p, radius, a, a + (b - a) % (2 * np.pi)) for p, a, b in zip(hull, before, normals, strict=True)])


def dense(lines: Sequence[Array], step: float = 2.5) -> Array:
    """Places (k, 2) along polylines, at most a step apart."""
    starts, ends = (np.vstack([line[piece] for line in lines] or [np.zeros((0, 2))]) for piece in (slice(-1), slice(1, None)))
    counts = (np.hypot(*(ends - starts).T) / step).astype(int) + 2
    side = np.repeat(np.arange(len(counts)), counts)
    place = np.arange(len(side)) - np.repeat(np.cumsum(counts) - counts, counts)
    found: Array = starts[side] + (place / (counts[side] - 1))[:, None] * (ends - starts)[side]
    return found


def piece_outlines(
    shape: str, sizes: Mapping[str, float], corners: Array, thickness: float, tips: Array = NONE
) -> list[tuple[Array, str]]:
    """Outlines with their style of a piece of a body in its own axes; ``thickness`` is that of slender parts, which end in ``tips``."""
    if shape == "rod":
        half = sizes["length"] / 2
        return [(rounded_hull(np.array([[-half, 0.0], [half, 0.0]]), thickness, tips), "body")]
    if shape == "disk":
        radius = sizes["radius"]
        return [(circle((0, 0), radius), "body"), (np.array([[0.0, 0.0], [radius, 0.0]]), "mark")]
    if shape == "ring":
        radius = sizes["radius"]
        return [(circle((0, 0), radius), "band"), (np.array([[radius - thickness, 0.0], [radius + thickness, 0.0]]), "mark")]
    if shape == "rectangle":
        return [(box(sizes["width"], sizes["height"]), "body")]
    if shape == "polygon":
        return [(corners, "body")]
    if shape == "point":
        return [(circle((0, 0), 1.4 * thickness), "mass")]
    return []


def wheel(radius: float, rim: float, spokes: int) -> list[tuple[Array, str]]:
    """Outlines with their style of a wheel with a rim so wide; with spokes, a hub."""
    inner, hub = max(radius - rim, 0.0), 0.12 * radius
    made = [(np.vstack([arc((0, 0), radius, 0, 2 * np.pi), arc((0, 0), inner, 2 * np.pi, 0)]), "body")]
    for angle in np.arange(spokes) * 2 * np.pi / (spokes or 1):
        made.append((np.outer((hub, inner), (np.cos(angle), np.sin(angle))), "mark"))
    return [*made, (circle((0, 0), hub), "body")] if spokes else made


def cart(width: float, height: float, radius: float) -> list[tuple[Array, str]]:
    """Outlines with their style of a rectangle about the origin that stands on two wheels, which reach down to its lower side."""
    axle, aside = radius - height / 2, width / 2 - 1.4 * radius
    box = np.array([[-1, 0], [1, 0], [1, 1], [-1, 1]]) * (width / 2, max(height - radius, radius)) + (0, axle)
    wheels = [
        ((sign * aside, axle), size, style) for sign in (-1, 1) for size, style in ((radius, "block"), (radius / 4, "slot"))
    ]
    return [(box, "body"), *((circle(at, size), style) for at, size, style in wheels)]


def zigzag(width: float, teeth: int = 8) -> Array:
    """A spring from 0 to 1 along, ± width across."""
    along = np.linspace(0.16, 0.84, 2 * teeth + 1)
    across = np.where(np.arange(2 * teeth + 1) % 2, width, -width) * (np.arange(2 * teeth + 1) % (2 * teeth) != 0)
    return np.vstack([[0, 0], np.column_stack([along, across]), [1, 0]])


def dashpot(width: float) -> list[Array]:
    """A damper from 0 to 1 along, ± width across: a cup, a piston and their rods."""
    cup = [[0.66, width], [0.36, width], [0.36, -width], [0.66, -width]]
    piston = [[0.52, -0.75 * width], [0.52, 0.75 * width]]
    return [np.array(line, float) for line in ([[0, 0], [0.36, 0]], cup, piston, [[0.52, 0], [1, 0]])]
