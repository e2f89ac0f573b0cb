"""What a mechanism is drawn on, and all that is drawn: outlines in body frames, the frames' poses over time, and the model's numbers
and points. Matplotlib and the browser draw the same sketch.

Everything moves in one of three ways: a ``Stroke`` with its body's frame, a ``Pair`` stretched between two points, a ``Cord`` as
it is laid anew at every time.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import GROUND, Array, Limit, MotionError, State, quote, there
from freebody.model.appearance import COLOURS
from freebody.views import shapes
from freebody.views.impact_markers import ImpactMarker
from freebody.views.style import GROUND as GREY
from freebody.views.style import colour

if TYPE_CHECKING:
    from freebody.core import CompiledModel
    from freebody.run.simulation import Run


@dataclass(frozen=True)
class Stroke:
    """A polyline (k, 2) in m with its style.

    Styles: ``body`` and ``block`` (filled in the body's colour), ``band`` (a thick line), ``mass`` (solid), ``mark``
    (a line in the body's colour), ``coil`` (a dark line), ``slot`` and ``pin`` (filled with the paper), ``weld`` (solid dark), ``rail``,
    ``hatch`` and ``dash`` (lines in the colour of ground). ``shown`` (nt,): whether it is there; None: always. ``about`` is the
    place of a symbol, whose size is not the model's but the drawing's; ``tone`` the place in the palette of a colour that is not its
    body's.
    """

    points: Array
    style: str
    closed: bool = True
    shown: Array | None = None
    about: tuple[float, float] | None = None
    tone: int | None = None


@dataclass(frozen=True)
class Figure:
    """A body: strokes and named points in its frame."""

    name: str
    strokes: list[Stroke] = field(default_factory=list)
    points: dict[str, tuple[float, float]] = field(default_factory=dict)

    def add(self, points: Array, style: str, closed: bool = True, about: Array | None = None, tone: int | None = None) -> None:
        """One more stroke, as ``Stroke`` says; of a symbol, ``about`` is its place (2,)."""
        place = None if about is None else (float(about[0]), float(about[1]))
        self.strokes.append(Stroke(np.asarray(points, float), style, closed, about=place, tone=tone))


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
    """A string: its way (nt, k, 2) in the fixed axes, whether it is taut (nt,) and whether it is there (nt,). Or, as a ``symbol``, whose
    size is the drawing's about its first point, the coils of a spring that stands for a contact."""

    name: str
    path: Array
    taut: Array
    shown: Array
    symbol: bool = False


@dataclass(frozen=True)
class Drawn:
    """A stroke where its body is, points (k, 2); ``tint``, ``body`` and ``layer``: colour, name and layer of its body."""

    style: str
    points: Array
    tint: str
    closed: bool
    body: str
    layer: int = 0

    @property
    def line(self) -> Array:
        """Its polyline (k, 2), back to the first point where it is closed."""
        return np.vstack([self.points, self.points[:1]]) if self.closed else self.points


class Sketch:
    """What symbols are drawn with: the model's numbers and points; what they are drawn on: figures (ground first), pairs and strings, with
    the figures' poses (nt, nf, 3) at times (nt,); ``size`` in m is that of symbols, impacts flash up. ``run``: where the times are from,
    None for a state by itself."""

    def __init__(self, source: CompiledModel, state: State, t: Array, q: Array, poses: Array, run: Run | None = None) -> None:
        self.spec = source.spec
        self.metadata = source.metadata
        self._model, self._state, self._run = source, state, run
        self.t, self.q = t, q
        fixed = np.zeros((len(t), 1, 3))
        self.poses = np.concatenate([fixed, poses], axis=1)
        self.names = [GROUND, *(body["name"] for body in self.metadata["bodies"])]
        self.figures = {name: Figure(name) for name in self.names}
        self.faces: dict[str, tuple[str, Array]] = {}
        """Of sliders and rollers by the name of the joint: their body, and places (k, 2) in its frame that lie on what guides it."""
        self.block = (1.8, 1.1)
        """Half the length and height of the block of a slider, in sizes of symbols."""
        self.pairs: list[Pair] = []
        self.cords: list[Cord] = []
        self.traces: list[str] = []
        self.impact_markers: list[ImpactMarker] = []
        self.at: dict[str, tuple[str, Array]] = {}
        self.owners: dict[str, str] = {}
        for name, place in source.points(state.p).items():
            self.owners[name] = place[0]
            if ".outline[" not in name:  # a corner that only contacts know
                self.at[name] = (place[0], np.array(place[1:], float))
                self.figures[place[0]].points[name] = (float(place[1]), float(place[2]))
        self.looks = source.looks
        self.size = self._size()

    def number(self, value: float | str) -> float:
        """A number of the model."""
        return float(value) if isinstance(value, (int, float)) else self.value(value)

    def tone(self, body: str) -> int:
        """The place of a body's colour in the palette."""
        own = self.looks.get(body, {}).get("colour")
        return COLOURS.index(own) if own else self.names.index(body) - 1

    def layer(self, body: str) -> int:
        """1 for a body in front of all others, -1 for one behind them, else 0."""
        return {"behind": -1, None: 0, "front": 1}[self.looks.get(body, {}).get("layer")]

    def value(self, text: str) -> float:
        """An expression at the drawn state."""
        return float(self.values([text])[0])

    def values(self, texts: Sequence[str]) -> Array:
        """Expressions at the drawn state."""
        return self._model.evaluate(texts, self._state)

    def gap(self, limit: str) -> Array:
        """How far (nt,) a contact is from touching or a string from being taut, m."""
        text = f"{quote(limit)}.gap"
        return np.array([self.value(text)]) if self._run is None else self._run[text]

    def there(self, part: str, engaged: bool = True) -> Array:
        """Whether a part is in place (nt,); ``engaged``: from the start."""
        return there(self._run.changes if self._run else [], part, engaged, self.t)

    def limits(self, frame: int | None = None) -> dict[str, Limit]:
        """What contacts, strings and stops do at the drawn state, or at one of the times; nothing where that has no answer."""
        state = self._state if frame is None or self._run is None else self._run.motion.state(float(self.t[frame]))
        try:
            return self._model.instant(state).limits if self.metadata["limits"] else {}
        except MotionError:
            return {}

    def travel(self, coordinate: str) -> tuple[float, float]:
        """Smallest and largest value of a coordinate; twice its value now where it is not of the state."""
        names = [c["name"] for c in self.metadata["coordinates"]]
        if coordinate not in names:
            return (self.value(quote(coordinate)),) * 2
        values = self.q[:, names.index(coordinate)]
        return float(values.min()), float(values.max())

    def line(self, place: Mapping[str, Any] | str) -> tuple[str, Array, Array]:
        """Body, point (2,) and unit direction (2,) of a line, in the body's frame."""
        named = {line["name"]: line["line"] for line in self.spec.get("lines", [])}
        stated: Mapping[str, Any] = named[place] if isinstance(place, str) else place
        body, point = self.at[stated["point"]]
        if stated.get("towards"):
            along = self.at[stated["towards"]][1] - point
            return body, point, along / np.hypot(*along)
        angle = self.number(stated.get("angle") or 0.0)
        return body, point, np.array([np.cos(angle), np.sin(angle)])

    def seen_from(self, body: str, name: str) -> Array:
        """The path (nt, 2) of a named point in the frame of a body."""
        owner, at = self.at[name]
        own, other = (self.poses[:, self.names.index(each)].T for each in (owner, body))
        place = own[0] + 1j * own[1] + complex(*at) * np.exp(1j * own[2])
        seen = (place - other[0] - 1j * other[1]) * np.exp(-1j * other[2])
        return np.column_stack([seen.real, seen.imag])

    def pair(self, name: str, kind: str, ends: Sequence[tuple[str, Array]], lines: list[Array], engaged: bool = True) -> None:
        """Something stretched between two places (2,) of bodies, as long as it is there."""
        (first, a), (second, b) = ends
        index = self.names.index
        shown = self.there(name, engaged)
        self.pairs.append(Pair(name, kind, ((index(first), a[0], a[1]), (index(second), b[0], b[1])), lines, shown))

    def wheel(self, circle: Mapping[str, Any], style: str) -> None:
        """A circle about a point, unless its body shows it already."""
        body, at = self.at[circle["centre"]]
        radius, figure = abs(self.number(circle["radius"])), self.figures[body]
        away = (np.hypot(*(stroke.points - at).T) for stroke in figure.strokes if len(stroke.points) > 12)
        if radius and not any(np.isclose(each, radius, rtol=1e-5, atol=0).sum() > 12 for each in away):
            figure.add(shapes.circle(at, radius), style)

    def pin(self, point: str, radius: float) -> None:
        """A pin at a named point, its radius in sizes of symbols."""
        body, at = self.at[point]
        self.figures[body].add(shapes.circle(at, radius * self.size), "pin", about=at)

    def rail(self, body: str, path: Array) -> None:
        """What something slides or rolls on, a polyline: on ground hatched, on a body bare."""
        if body == GROUND:
            self.hatched(body, path)
        else:
            self.figures[body].add(path, "rail", closed=False)

    def hatched(self, body: str, path: Array, about: Array | None = None) -> None:
        """A polyline, hatched on its right-hand side; of a symbol, ``about`` its place (2,)."""
        s, figure, sides = self.size, self.figures[body], np.diff(path, axis=0)
        figure.add(path, "rail", closed=False, about=about)
        lengths = np.hypot(*sides.T)
        ends = np.cumsum(lengths)
        for foot in np.arange(0.7 * s, ends[-1] + 1e-9 * s, max(0.65 * s, ends[-1] / 120)):
            i = min(int(np.searchsorted(ends, foot)), len(sides) - 1)
            along = sides[i] / lengths[i]
            root = path[i] + (foot - ends[i] + lengths[i]) * along
            figure.add(np.array([root, root + (np.array([along[1], -along[0]]) - along) * 0.55 * s]), "hatch", False, about)

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

    def moved(self, body: str, points: Array, frame: int = 0) -> Array:
        """Points (k, 2) of a body in the fixed axes, by default at the start."""
        x, y, angle = self.poses[frame, self.names.index(body)]
        return shapes.turn(points, angle, (x, y))

    def pair_lines(self, pair: Pair, frame: int = 0) -> list[Array]:
        """A pair's polylines in the fixed axes; none where it is not there."""
        if not pair.shown[frame]:
            return []
        a, b = (self.moved(self.names[i], np.array([[x, y]]), frame)[0] for i, x, y in pair.ends)
        length = np.hypot(*(b - a)) or 1.0
        left = np.array([a[1] - b[1], b[0] - a[0]]) / length
        return [a + line[:, :1] * (b - a) + line[:, 1:] * left for line in pair.lines]

    def lines(self, frame: int = 0) -> list[Array]:
        """Everything that is drawn at a time, as polylines in the fixed axes; of a small solid mass, the inside as well."""
        found = [line for pair in self.pairs for line in self.pair_lines(pair, frame)]
        found += [cord.path[frame] for cord in self.cords if cord.shown[frame]]
        for stroke in self.strokes(frame):
            line, inside = stroke.line, (0.7, 0.4) if stroke.style == "mass" else ()
            found += [line, *(line.mean(axis=0) + part * (line - line.mean(axis=0)) for part in inside)]
        return found

    def strokes(self, frame: int = 0) -> Iterator[Drawn]:
        """The strokes of all figures in the fixed axes."""
        for i, figure in enumerate(self.figures.values()):
            for each in figure.strokes:
                if each.shown is None or each.shown[frame]:
                    tint = colour(self.tone(figure.name) if each.tone is None else each.tone) if i else GREY
                    points, layer = self.moved(figure.name, each.points, frame), self.layer(figure.name)
                    yield Drawn(each.style, points, tint, each.closed, figure.name, layer)

    def bounds(self) -> tuple[float, float, float, float]:
        """x from, x to, y from, y to: a box about everything that is drawn at any time."""
        frames = np.unique(np.linspace(0, len(self.t) - 1, 80).astype(int))
        seen = [line for k in frames for pair in self.pairs for line in self.pair_lines(pair, k)]
        seen += [cord.path[k] for cord in self.cords for k in frames if cord.shown[k]]
        for figure, poses in zip(self.figures.values(), self.poses[frames].swapaxes(0, 1), strict=True):
            cosine, sine = np.cos(poses[:, 2:]), np.sin(poses[:, 2:])
            for each in figure.strokes:
                x, y = each.points.T
                moved = np.stack([poses[:, :1] + cosine * x - sine * y, poses[:, 1:2] + sine * x + cosine * y], axis=2)
                seen.append(moved[slice(None) if each.shown is None else each.shown[frames]].reshape(-1, 2))
        everything = np.vstack(seen or [np.zeros((1, 2))])
        (x0, y0), (x1, y1) = everything.min(axis=0), everything.max(axis=0)
        return float(x0), float(x1), float(y0), float(y1)

    @cached_property
    def spark(self) -> float:
        """The size of what flashes up, in m: seen well, however small the symbols are beside the whole."""
        x0, x1, y0, y1 = self.bounds()
        return max(2.5 * self.size, 0.02 * float(np.hypot(x1 - x0, y1 - y0)))


def sketch_of_state(source: CompiledModel, state: State) -> Sketch:
    """What is needed to draw on one state."""
    bodies = [quote(body["name"]) for body in source.metadata["bodies"]]
    texts = [text.format(body) for body in bodies for text in ("x({}.origin)", "y({}.origin)", "angle({})")]
    poses = source.evaluate(texts, state).reshape(1, -1, 3)
    return Sketch(source, state, np.array([state.t]), state.q[None], poses)


def named_points(value: Any) -> list[str]:
    """All names in the fields of an element."""
    if isinstance(value, str):
        return [value]
    if isinstance(value, Mapping):
        return [name for item in value.values() for name in named_points(item)]
    return [name for item in value for name in named_points(item)] if isinstance(value, list) else []
