"""What there is to draw, as pure data: outlines in body frames, and the frames' poses over time.

Matplotlib and the browser draw the same scene. Everything moves in one of three ways: a ``Stroke`` with its
body's frame, a ``Pair`` stretched between two points, a ``Cord`` as it is laid anew at every time.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.instant import State
from freebody.results import Array, quote
from freebody.switched import Limit, limits_of, there
from freebody.views import shapes
from freebody.views.flashes import LASTING, Flash, flashes

if TYPE_CHECKING:
    from freebody.run import Run, Source

GROUND = "ground"
_OWN_POINTS = ("origin", "G", "centre", "start")


@dataclass(frozen=True)
class Stroke:
    """A polyline (k, 2) in m with its style.

    Styles: ``body`` and ``block`` (filled in the body's colour), ``band`` (a thick line), ``mass`` (solid), ``mark``
    (a line in the body's colour), ``slot`` and ``pin`` (filled with the paper), ``weld`` (solid dark), ``rail``,
    ``hatch`` and ``dash`` (lines in the colour of ground). ``shown`` (nt,): whether it is there; None: always.
    """

    points: Array
    style: str
    closed: bool = True
    shown: Array | None = None

    def is_there(self, frame: int) -> bool:
        """Whether it is drawn."""
        return self.shown is None or bool(self.shown[frame])


@dataclass(frozen=True)
class Figure:
    """A body: strokes and named points in its frame."""

    name: str
    strokes: list[Stroke] = field(default_factory=list)
    points: dict[str, tuple[float, float]] = field(default_factory=dict)

    def add(self, points: Array, style: str, closed: bool = True) -> None:
        """One more stroke."""
        self.strokes.append(Stroke(np.asarray(points, float), style, closed))


@dataclass(frozen=True)
class Pair:
    """Something stretched between two points of bodies.

    ``ends``: (index of the figure, x, y) twice. ``lines``: polylines of (along, across): ``along`` runs from 0 at
    the first end to 1 at the second, ``across`` is in m to the left. ``shown`` (nt,): whether it is there.
    """

    name: str
    kind: str
    ends: tuple[tuple[int, float, float], tuple[int, float, float]]
    lines: list[Array]
    shown: Array


@dataclass(frozen=True)
class Cord:
    """A string: its way (nt, k, 2) in the fixed axes, whether it is taut (nt,) and whether it is there (nt,)."""

    name: str
    path: Array
    taut: Array
    shown: Array


@dataclass(frozen=True)
class Scene:
    """Figures (ground first), pairs, strings, and the figures' poses (nt, nf, 3) at times (nt,); ``size`` in m is that of symbols;
    impacts flash up."""

    name: str
    size: float
    figures: list[Figure]
    pairs: list[Pair]
    cords: list[Cord]
    t: Array
    poses: Array
    traces: list[str]
    flashes: list[Flash] = field(default_factory=list)

    def index(self, body: str) -> int:
        """Place of a body's figure."""
        return next(i for i, figure in enumerate(self.figures) if figure.name == body)

    def place(self, figure: int, points: Array, frame: int = 0) -> Array:
        """Points (k, 2) of a figure in the fixed axes."""
        x, y, angle = self.poses[frame, figure]
        return shapes.turn(points, angle, (x, y))

    def pair_lines(self, pair: Pair, frame: int = 0) -> list[Array]:
        """A pair's polylines in the fixed axes; none where it is not there."""
        if not pair.shown[frame]:
            return []
        a, b = (self.place(i, np.array([[x, y]]), frame)[0] for i, x, y in pair.ends)
        length = np.hypot(*(b - a)) or 1.0
        left = np.array([a[1] - b[1], b[0] - a[0]]) / length
        return [a + line[:, :1] * (b - a) + line[:, 1:] * left for line in pair.lines]

    def points(self) -> dict[str, tuple[int, tuple[float, float]]]:
        """Named points: figure and place in its frame."""
        return {name: (i, at) for i, figure in enumerate(self.figures) for name, at in figure.points.items()}

    def bounds(self) -> tuple[float, float, float, float]:
        """x from, x to, y from, y to: a box about everything that is drawn at any time."""
        frames = np.unique(np.linspace(0, len(self.t) - 1, 80).astype(int))
        seen = [self.place(i, s.points, k) for k in frames for i, f in enumerate(self.figures) for s in f.strokes]
        seen += [line for k in frames for pair in self.pairs for line in self.pair_lines(pair, k)]
        seen += [cord.path[k] for k in frames for cord in self.cords if cord.shown[k]]
        everything = np.vstack(seen or [np.zeros((1, 2))])
        (x0, y0), (x1, y1) = everything.min(axis=0), everything.max(axis=0)
        return float(x0), float(x1), float(y0), float(y1)

    @cached_property
    def spark(self) -> float:
        """The size of what flashes up, in m: seen well, however small the symbols are beside the whole."""
        x0, x1, y0, y1 = self.bounds()
        return max(2.5 * self.size, 0.02 * float(np.hypot(x1 - x0, y1 - y0)))

    def to_json(self) -> dict[str, Any]:
        """The scene for the browser, figures rounded to what a screen can show."""
        digits = 3 - int(np.floor(np.log10(self.size)))
        places = np.concatenate([self.poses[..., :2].round(digits), self.poses[..., 2:].round(5)], axis=2)
        at = self.points()
        return {
            "size": self.size,
            "bounds": self.bounds(),
            "t": self.t.tolist(),
            "poses": places.reshape(len(self.t), -1).tolist(),
            "figures": [
                {
                    "name": figure.name,
                    "strokes": [
                        {"points": s.points.round(digits).tolist(), "style": s.style, "closed": s.closed, **_shown(s)}
                        for s in figure.strokes
                    ],
                }
                for figure in self.figures
            ],
            "pairs": [
                {"kind": p.kind, "ends": p.ends, "lines": [line.round(max(digits, 4)).tolist() for line in p.lines], **_shown(p)}
                for p in self.pairs
            ],
            "cords": [
                {"path": c.path.reshape(len(self.t), -1).round(digits).tolist(), "taut": c.taut.tolist(), **_shown(c)}
                for c in self.cords
            ],
            "traces": [{"name": name, "figure": at[name][0], "at": at[name][1]} for name in self.traces],
            "flashes": [{"t": flash.t, "rays": flash.rays(self.spark).round(digits).tolist()} for flash in self.flashes],
            "lasting": LASTING,
        }


def _shown(item: Stroke | Pair | Cord) -> dict[str, Any]:
    return {} if item.shown is None or item.shown.all() else {"shown": item.shown.tolist()}


class Sketch:
    """What symbols are drawn with: the model's numbers and points, and the figures to draw on. ``run``: where the times are
    from, None for a state by itself."""

    def __init__(self, source: Source, state: State, t: Array, q: Array, poses: Array, run: Run | None = None) -> None:
        self.spec: dict[str, Any] = json.loads(source.spec)
        self.about = source.about
        self._core, self._state, self._run = source.core, state, run
        self.t, self.q = t, q
        fixed = np.zeros((len(t), 1, 3))
        self.poses = np.concatenate([fixed, poses], axis=1)
        self.names = [GROUND, *(body["name"] for body in self.about["bodies"])]
        self.figures = {name: Figure(name) for name in self.names}
        self.pairs: list[Pair] = []
        self.cords: list[Cord] = []
        self.at: dict[str, tuple[str, Array]] = {}
        self.owners: dict[str, str] = {}
        for name, place in json.loads(source.core.points(state.p)).items():
            if not (isinstance(place, list) and len(place) == 3):
                continue
            self.owners[name] = place[0]
            if ".outline[" not in name:  # a corner that only contacts know
                self.at[name] = (place[0], np.array(place[1:], float))
                self.figures[place[0]].points[name] = (float(place[1]), float(place[2]))
        self.outlines = {body: value for body, value in _outlines(source.model).items() if body in self.figures}
        self.size = self._size()

    def number(self, value: float | str) -> float:
        """A number of the model."""
        return float(value) if isinstance(value, (int, float)) else self.value(value)

    def value(self, text: str) -> float:
        """An expression at the drawn state."""
        return float(self.values([text])[0])

    def values(self, texts: Sequence[str]) -> Array:
        """Expressions at the drawn state."""
        s = self._state
        return np.array(self._core.evaluate(list(texts), s.p, s.t, s.q, s.u), float)

    def gap(self, limit: str) -> Array:
        """How far (nt,) a contact is from touching or a string from being taut, m."""
        text = f"{quote(limit)}.gap"
        return np.array([self.value(text)]) if self._run is None else self._run[text]

    def there(self, part: str, engaged: bool = True) -> Array:
        """Whether a part is in place (nt,); ``engaged``: from the start."""
        return there(self._run.changes if self._run else [], part, engaged, self.t)

    def limits(self) -> list[Limit]:
        """What contacts, strings and stops do at the drawn state; nothing where that has no answer."""
        from freebody._core import MotionError

        s = self._state
        try:
            told = self._core.instant(s.p, s.t, s.q, s.u).limits if self.about["limits"] else "[]"
        except MotionError:
            return []
        return list(limits_of(json.loads(told), self.about).values())

    def travel(self, coordinate: str) -> tuple[float, float]:
        """Smallest and largest value of a coordinate; twice its value now where it is not of the state."""
        names = [c["name"] for c in self.about["coordinates"]]
        if coordinate not in names:
            return (self.value(quote(coordinate)),) * 2
        values = self.q[:, names.index(coordinate)]
        return float(values.min()), float(values.max())

    def line(self, place: Mapping[str, Any] | str) -> tuple[str, Array, Array]:
        """Body, point (2,) and unit direction (2,) of a line, in the body's frame."""
        named = {line["name"]: line["line"] for line in self.spec.get("lines", [])}
        told: Mapping[str, Any] = named[place] if isinstance(place, str) else place
        body, point = self.at[told["point"]]
        if told.get("towards"):
            along = self.at[told["towards"]][1] - point
            return body, point, along / np.hypot(*along)
        angle = self.number(told.get("angle") or 0.0)
        return body, point, np.array([np.cos(angle), np.sin(angle)])

    def seen_from(self, body: str, name: str) -> Array:
        """The path (nt, 2) of a named point in the frame of a body."""
        owner, at = self.at[name]
        x, y, angle = self.poses[:, self.names.index(owner)].T
        c, s = np.cos(angle), np.sin(angle)
        px, py = x + at[0] * c - at[1] * s, y + at[0] * s + at[1] * c
        x, y, angle = self.poses[:, self.names.index(body)].T
        c, s = np.cos(angle), np.sin(angle)
        return np.column_stack([c * (px - x) + s * (py - y), c * (py - y) - s * (px - x)])

    def pair(self, name: str, kind: str, ends: Sequence[str], lines: list[Array], engaged: bool = True) -> None:
        """Something stretched between two named points, as long as it is there."""
        (first, a), (second, b) = (self.at[point] for point in ends)
        index = self.names.index
        shown = self.there(name, engaged)
        self.pairs.append(Pair(name, kind, ((index(first), a[0], a[1]), (index(second), b[0], b[1])), lines, shown))

    def _size(self) -> float:
        """A size for symbols that suits the mechanism: a small part of its extent at the start, larger where it travels far."""
        seen = [self.place(name) for name, (body, _) in self.at.items() if body != GROUND]
        for i, body in enumerate(self.spec["bodies"]):
            spans = [self.number(size) for piece in body["pieces"] for size in piece.get("sizes", {}).values()]
            half = max(spans, default=0.0) / 2
            seen += [self.poses[0, i + 1, :2] + half, self.poses[0, i + 1, :2] - half]
        extent = np.ptp(np.array(seen or [np.zeros(2)]), axis=0)
        travel = np.ptp(self.poses[:, 1:, :2].reshape(-1, 2), axis=0) if len(self.poses[0]) > 1 else np.zeros(2)
        own, far = float(np.hypot(*extent)), float(np.hypot(*travel))
        return float(np.clip(0.006 * far, 0.02 * own, 0.05 * own)) or 0.02

    def place(self, point: str) -> Array:
        """Where a named point is at the start, in the fixed axes (2,)."""
        body, at = self.at[point]
        return self.moved(body, at[None])[0]

    def moved(self, body: str, points: Array) -> Array:
        """Points (k, 2) of a body in the fixed axes."""
        x, y, angle = self.poses[0, self.names.index(body)]
        return shapes.turn(points, angle, (x, y))


def of_run(run: Run, times: Sequence[float] | Array | None = None, traces: Sequence[str] | None = None) -> Scene:
    """The scene of a run at times within it (default: its output times)."""
    shown = run if times is None else run.at(times)
    start = State(run.start.p, float(shown.t[0]), shown.q[0], shown.u[0])
    scene = drawn(Sketch(run.source, start, shown.t, shown.q, shown.poses, shown), traces)
    return replace(scene, flashes=flashes(run))


def of_state(source: Source, state: State, traces: Sequence[str] | None = None) -> Scene:
    """The scene at one state."""
    return drawn(sketch_of_state(source, state), traces)


def sketch_of_state(source: Source, state: State) -> Sketch:
    """What is needed to draw on one state."""
    bodies = [quote(body["name"]) for body in source.about["bodies"]]
    texts = [text.format(body) for body in bodies for text in ("x({}.origin)", "y({}.origin)", "angle({})")]
    poses = source.core.evaluate(texts, state.p, state.t, state.q, state.u).reshape(1, -1, 3)
    return Sketch(source, state, np.array([state.t]), state.q[None], poses)


def drawn(sketch: Sketch, traces: Sequence[str] | None = None) -> Scene:
    """Everything drawn; ``traces`` names the points to be traced (default: a few worth it)."""
    from freebody.views.symbols import draw_forces, draw_joints
    from freebody.views.touching import draw_contacts, draw_strings

    for body in sketch.spec["bodies"]:
        _draw_body(sketch, body)
    draw_joints(sketch)
    draw_forces(sketch)
    draw_contacts(sketch)
    draw_strings(sketch)
    figures = [sketch.figures[name] for name in sketch.names]
    chosen = _worth_tracing(sketch) if traces is None else list(traces)
    return Scene(sketch.spec.get("name", ""), sketch.size, figures, sketch.pairs, sketch.cords, sketch.t, sketch.poses, chosen)


def _draw_body(sketch: Sketch, body: Mapping[str, Any]) -> None:
    """The shapes of its pieces; for a body without shape, the hull of its points."""
    figure, thickness = sketch.figures[body["name"]], 0.8 * sketch.size
    outline = sketch.outlines.get(body["name"])
    if outline == "none":
        return
    if outline is not None:
        named = np.array([_corner(sketch, body["name"], corner) for corner in outline])
        figure.add(named if len(named) > 2 else shapes.rounded_hull(named, thickness), "body")
        return
    for piece in body["pieces"]:
        sizes = {name: sketch.number(size) for name, size in piece.get("sizes", {}).items()}
        corners = np.array([[sketch.number(x) for x in corner] for corner in piece.get("corners", [])])
        at = [sketch.number(x) for x in piece.get("at", (0.0, 0.0))]
        for points, style in shapes.piece_outlines(piece["shape"], sizes, corners, thickness):
            figure.add(shapes.turn(points, sketch.number(piece.get("angle", 0.0)), at), style, len(points) > 2)
    joined = {name for joint in sketch.spec["joints"] for name in named_points(joint["with"])}
    own = [at for name, at in figure.points.items() if not name.endswith(".origin") or name in joined]
    bare = not any(stroke.style in ("body", "band", "mass") for stroke in figure.strokes)
    if bare:
        figure.add(shapes.rounded_hull(np.array(own or [(0.0, 0.0)]), thickness), "body")
    else:
        _reach_out(figure, np.array(own or [(0.0, 0.0)]), thickness)


def _corner(sketch: Sketch, body: str, corner: str | Sequence[float | str]) -> Array:
    """Place (2,) of a corner of an outline, which may be a point with or without its body's name, in the body's frame."""
    if isinstance(corner, str):
        return sketch.at[corner if corner in sketch.at else f"{body}.{corner}"][1]
    return np.array([sketch.number(x) for x in corner])


def _reach_out(figure: Figure, points: Array, thickness: float) -> None:
    """Arms from the shape to named points that lie outside of it, so that a joint there does not hang in the air."""
    solid = np.vstack([stroke.points for stroke in figure.strokes])
    hull = shapes.convex_hull(solid)
    for point in points:
        edges = np.roll(hull, -1, axis=0) - hull
        beyond = edges[:, 1] * (point[0] - hull[:, 0]) - edges[:, 0] * (point[1] - hull[:, 1])
        if (beyond > 0.1 * thickness * np.hypot(*edges.T)).any():
            arm = shapes.rounded_hull(np.array([solid.mean(axis=0), point]), 0.6 * thickness)
            figure.strokes.insert(0, Stroke(arm, "body"))


def _outlines(model: str) -> dict[str, Any]:
    """What the model says of outlines: ``none``, or points by name or as numbers in m."""
    said = {name: body.get("outline") for name, body in json.loads(model).get("bodies", {}).items() if isinstance(body, dict)}
    return {name: outline for name, outline in said.items() if outline is not None}


def _worth_tracing(sketch: Sketch) -> list[str]:
    """Up to three points that move and where nothing is joined; mass centres where there is none."""
    joined = [sketch.at[n] for j in sketch.spec["joints"] for n in named_points(j["with"]) if n in sketch.at]
    free = [
        name
        for name, (body, at) in sketch.at.items()
        if body != GROUND
        and name.rpartition(".")[2] not in _OWN_POINTS
        and not any(body == other and np.allclose(at, place) for other, place in joined)
    ]
    return free[:3] or [name for name in sketch.at if name.endswith(".G")][-1:]


def named_points(value: Any) -> list[str]:
    """All names in the fields of an element."""
    if isinstance(value, str):
        return [value]
    if isinstance(value, Mapping):
        return [name for item in value.values() for name in named_points(item)]
    return [name for item in value for name in named_points(item)] if isinstance(value, list) else []
