"""How contacts and strings look: surfaces hatched on their solid side, springs that stand for contacts, strings along eyelets, pulleys and
drums."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from freebody.core import GROUND, Array, Limit, quote
from freebody.views import shapes
from freebody.views.sketch import Cord, Sketch

Surface = Mapping[str, Any]
_SHARPEST = {"point": 0, "circle": 1, "polygon": 2}
_COIL, _SPRING, _PRESSED = 0.9, 5.0, 2.4  # sizes of symbols, of a spring: half its width, its length, and that when pressed flat
_SAG, _ARC = np.linspace(0, 1, 21), np.linspace(0, 1, 17)


# Surfaces


def draw_contacts(sketch: Sketch) -> None:
    """Every surface that is no body, once; lines as far as what touches them comes, and between the points that name them."""
    touched: dict[str, tuple[Surface, list[Surface]]] = {}
    for contact in sketch.spec.get("contacts", []):
        for surface, other in (contact["of"], contact["of"][::-1]):
            touched.setdefault(repr(surface), (surface, []))[1].append(other)
    for surface, others in touched.values():
        [(kind, shape)] = surface.items()
        if kind == "line":
            _draw_line(sketch, shape, others)
        elif kind == "circle" and (shape.get("ends") or shape.get("hollow")):
            body, at = sketch.at[shape["centre"]]
            start, end = (sketch.number(angle) for angle in shape.get("ends") or (0.0, 2 * np.pi))
            # What is solid lies on the right as one goes along it.
            way = np.linspace(start, end, 121) if shape.get("hollow") else np.linspace(end, start, 121)
            sketch.hatched(body, at + sketch.number(shape["radius"]) * np.column_stack([np.cos(way), np.sin(way)]))
        elif kind == "circle":
            sketch.wheel(shape, _solid(sketch.at[shape["centre"]][0]))
        elif kind == "track":
            sketch.hatched(sketch.at[shape["start"]][0], _track(sketch, shape))
        elif kind in ("polyline", "polygon") and all(name in sketch.at for name in shape):
            body, corners = sketch.at[shape[0]][0], np.array([sketch.at[name][1] for name in shape])
            if kind == "polyline":
                sketch.hatched(body, corners)
            else:
                sketch.figures[body].add(corners, _solid(body))


def _draw_line(sketch: Sketch, line: Surface, others: Sequence[Surface]) -> None:
    body, origin, along = sketch.line(line)
    reaches = [_reach(sketch, body, other) for other in others]
    named = [sketch.at[line[key]][1] for key in ("point", "towards") if isinstance(line, dict) and line.get(key)]
    reaches += [(np.array([place]), -3 * sketch.size) for place in named if line.get("towards")]
    ways = np.concatenate([((path - origin) @ along)[:, None] + [-far, far] for path, far in reaches])
    start, end = ways.min() - 3 * sketch.size, ways.max() + 3 * sketch.size
    own = (np.vstack([origin, *(stroke.points for stroke in sketch.figures[body].strokes)]) - origin) @ along
    if body != GROUND and np.ptp(own):
        # Where the body ends, its surface is not shown to go on.
        start, end = max(start, own.min()), min(end, own.max())
    sketch.rail(body, origin + np.outer([start, end], along))


def _track(sketch: Sketch, track: Surface) -> Array:
    """The way (k, 2) along lines and arcs, in the frame of their body."""
    path = [sketch.at[track["start"]][1]]
    for stretch in track["stretches"]:
        start, end = path[-1], sketch.at[stretch["to"]][1]
        if stretch["centre"] is not None:
            centre = sketch.at[stretch["centre"]][1]
            a, b = (complex(*(place - centre)) for place in (start, end))
            turns = a * np.exp(1j * np.angle(b / a) * _ARC[1:-1])
            path += list(centre + np.column_stack([turns.real, turns.imag]))
        path.append(end)
    return np.array(path)


def _reach(sketch: Sketch, seen_from: str, surface: Surface) -> tuple[Array, float]:
    """The path (nt, 2) of a surface in the frame of a body, and how far it extends about it, m."""
    if "point" in surface:
        return sketch.seen_from(seen_from, surface["point"]), 0.0
    [(kind, shape)] = surface.items()
    name = shape[0] if isinstance(shape, list) else shape[{"circle": "centre", "track": "start"}.get(kind, "point")]
    if kind == "circle":
        return sketch.seen_from(seen_from, name), sketch.number(shape["radius"])
    owner = sketch.owners[name]
    far = max((float(np.hypot(*stroke.points.T).max()) for stroke in sketch.figures[owner].strokes), default=0.0)
    return sketch.seen_from(seen_from, f"{owner}.origin"), far


def _solid(body: str) -> str:
    """The style of what is solid there."""
    return "block" if body == GROUND else "mark"


# Springs that stand for contacts


def draw_compliance(sketch: Sketch) -> None:
    """The spring of every contact that has a stiffness, while it acts: from where it presses into what it presses on."""
    for contact in sketch.spec.get("contacts", []):
        if contact.get("stiffness") is None:
            continue
        limits = [sketch.limits(k).get(contact["name"]) for k in range(len(sketch.t))]
        acts = np.array([limit is not None and limit.at is not None and limit.N > 0 for limit in limits])
        first, second = (_SHARPEST.get(next(iter(surface)), len(_SHARPEST)) for surface in contact["of"])
        side = 1 if first > second else -1  # the spring lies in the flatter of the two
        if found := [_coils(limit, side, sketch.size) for limit, now in zip(limits, acts, strict=True) if limit and now]:
            path = np.array(found)[np.maximum(np.cumsum(acts) - 1, 0)]  # where it does not act, as it was before
            shown = acts & sketch.there(contact["name"], contact.get("engaged", True))
            sketch.cords.append(Cord(contact["name"], path, acts, shown, symbol=True))


def _coils(limit: Limit, side: int, size: float) -> Array:
    """A zigzag (k, 2) at an instant from where a contact acts, along its normal, which shows to the ``first`` of the two."""
    way = side * complex(limit.Fx, limit.Fy) / complex(limit.N, -limit.T)  # friction is along the normal turned clockwise
    depth = max(-limit.gap, 0.0)
    along, across = shapes.zigzag(_COIL * size, teeth=4).T
    line = complex(*(limit.at or ())) + way * (depth + max(_SPRING * size - depth, _PRESSED * size) * along + 1j * across)
    return np.column_stack([line.real, line.imag])


# Strings


def draw_strings(sketch: Sketch) -> None:
    """Every string over its guides, with the rims on which it lies."""
    gravity = np.array([sketch.number(x) for x in sketch.spec.get("gravity") or (0.0, -1.0)])
    down = gravity / (np.hypot(*gravity) or 1.0)
    for string in sketch.spec.get("strings", []):
        first, last = string["ends"]
        if "drum" in last:  # its sense, to be followed from the first end
            last = {"drum": {**last["drum"], "sense": -last["drum"]["sense"]}}
        guides = [shape for place in (first, *string.get("over", []), last) for shape in place.values()]
        names = [guide if isinstance(guide, str) else guide["centre"] for guide in guides]
        radii = [0.0 if isinstance(guide, str) else guide["sense"] * sketch.number(guide["radius"]) for guide in guides]
        slack = np.maximum(sketch.gap(string["name"]), 0.0)
        path = way([sketch.seen_from(GROUND, name) for name in names], radii, slack, down)
        shown = sketch.there(string["name"], string.get("engaged", True))
        sketch.cords.append(Cord(string["name"], path, slack <= 1e-3 * sketch.size, shown))
        for name, guide, radius in zip(names, guides, radii, strict=True):
            body = sketch.at[name][0]
            if radius:
                sketch.wheel(guide, _solid(body))
            if radius or body == GROUND or name not in (names[0], names[-1]):
                sketch.pin(name, 0.3)


def way(centres: Sequence[Array], radii: Sequence[float], slack: Array, down: Array) -> Array:
    """The way (nt, k, 2) of a string over circles with centres (nt, 2) and radii, which are positive where the string goes round
    counter-clockwise; what is slack (nt,) hangs down in the longest free part."""
    spans = [_span(*pair) for pair in pairwise(zip(centres, radii, strict=True))]
    longest = int(np.argmax([np.hypot(*(end - start).T).mean() for start, end in spans]))
    parts: list[Array] = []
    for i, (start, end) in enumerate(spans):
        if i:
            parts.append(_bow(centres[i], radii[i], spans[i - 1][1], start))
        parts.append(_hanging(start, end, slack, down) if i == longest else np.stack([start, end], axis=1))
    return np.concatenate(parts, axis=1)


def _span(first: tuple[Array, float], second: tuple[Array, float]) -> tuple[Array, Array]:
    """Where (nt, 2) the straight part leaves one circle and meets the next."""
    (a, r), (b, s) = first, second
    apart = b - a
    length = np.maximum(np.hypot(*apart.T), 1e-12)
    lean = np.arcsin(np.clip((s - r) / length, -1.0, 1.0))
    c, n = np.cos(lean), np.sin(lean)
    x, y = apart.T / length
    along = np.column_stack([c * x + n * y, c * y - n * x])
    left = np.column_stack([-along[:, 1], along[:, 0]])
    return a - r * left, b - s * left


def _bow(centre: Array, radius: float, start: Array, end: Array) -> Array:
    """The arc (nt, k, 2) about a centre, round the way that the sign of the radius says."""
    a, b = (np.arctan2(*(place - centre).T[::-1]) for place in (start, end))
    sense = np.sign(radius) or 1.0
    sweep = (sense * (b - a)) % (2 * np.pi)
    # A string that only just touches goes round by nothing, not by a full turn.
    angles = a[:, None] + sense * np.where(sweep > 2 * np.pi - 0.05, 0.0, sweep)[:, None] * _ARC
    return centre[:, None] + abs(radius) * np.stack([np.cos(angles), np.sin(angles)], axis=2)


def _hanging(start: Array, end: Array, slack: Array, down: Array) -> Array:
    """A parabola (nt, k, 2) longer than its chord by what is slack, to first order (s = 8 d²/3c)."""
    chord = np.hypot(*(end - start).T)
    sag = np.minimum(np.sqrt(3 * chord * slack / 8), (chord + slack) / 2)
    straight = start[:, None] + (end - start)[:, None] * _SAG[:, None]
    drop: Array = straight + (4 * sag[:, None] * _SAG * (1 - _SAG))[..., None] * down
    return drop


def string_label(sketch: Sketch, cord: Cord) -> tuple[str, Array]:
    """The name of a string and the middle of its longest part, at the drawn state."""
    path = cord.path[0]
    steps = np.hypot(*np.diff(path, axis=0).T)
    i = int(steps.argmax())
    text = f"{quote(cord.name)}.tension"
    return f"{cord.name}: {sketch.value(text):.4g} N" if cord.taut[0] else cord.name, (path[i] + path[i + 1]) / 2
