"""The bodies of a group on paper, in points (1/72 inch): outlines, what joins them inside, named points, coordinates."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from freebody.free_body import FreeBodies
from freebody.instant import State
from freebody.results import Array, symbol
from freebody.run import Source
from freebody.views.draw import UNTOLD
from freebody.views.measures import measures
from freebody.views.scene import Scene, Sketch, drawn, sketch_of_state
from freebody.views.style import colour

SYMBOL = 5.0  # pt, the size of symbols; a slender body is 1.6 times that thick
_ROOM = 150.0, 130.0  # pt, what a single body may take
_WIDER = 290.0, 210.0  # pt, what a group may take
_LARGEST = 30.0  # pt for the size of a symbol in the whole mechanism, so that a small body is not drawn as large as a large one
_SOLID = ("body", "block", "band", "mass")
_CUT = ("pin", "weld", "dash")
_PINNED = ("hinge", "link", "slot", "curved_slot", "polar")


@dataclass(frozen=True)
class Drawn:
    """A stroke on paper: style of ``Stroke``, points (k, 2), colour of its body."""

    style: str
    points: Array
    tint: str
    closed: bool


@dataclass(frozen=True)
class Tag:
    """A name for a place."""

    text: str
    at: Array


@dataclass(frozen=True)
class Dimension:
    """A coordinate on paper: its arrow (k, 2) and a guide (2, 2)."""

    text: str
    arrow: Array
    guide: Array
    angle: bool


@dataclass(frozen=True)
class Scenery:
    """What is seen of a group on paper. ``inner``: lines of springs and strings within it; ``pins``, ``centres``: places (k, 2)."""

    strokes: list[Drawn]
    inner: list[Array]
    pins: Array
    centres: dict[str, Array]
    points: list[Tag]
    dimensions: list[Dimension]
    scale: float
    sketch: Sketch

    def place(self, at: Array) -> Array:
        """From fixed axes in m to paper in pt."""
        return self.scale * at

    def bare(self) -> Scenery:
        """The same without coordinates and points other than mass centres."""
        return replace(self, dimensions=[], points=[tag for tag in self.points if tag.text == "G"])

    @property
    def solids(self) -> list[Array]:
        """Outlines of what is solid."""
        return [stroke.points for stroke in self.strokes if stroke.style in _SOLID]

    def ink(self) -> Array:
        """Places (k, 2) all along what is drawn, a few pt apart."""
        lines = [np.vstack([s.points, s.points[:1]]) if s.closed else s.points for s in self.strokes]
        lines += self.inner + [d.arrow for d in self.dimensions] + [d.guide for d in self.dimensions]
        return dense(lines)


def dense(lines: Sequence[Array], step: float = 2.5) -> Array:
    """Places along polylines, at most a step apart."""
    sides = [(a, b) for line in lines for a, b in pairwise(line)]
    return np.vstack([np.linspace(a, b, int(np.hypot(*(b - a)) / step) + 2) for a, b in sides] or [np.zeros((0, 2))])


def scenery(source: Source, state: State, free: FreeBodies, group: Sequence[str], scaled: bool) -> Scenery:
    """The bodies of a group as large as the paper allows."""
    room = _ROOM if len(group) == 1 else _WIDER
    sketch = sketch_of_state(source, state)
    scene, whole = drawn(sketch), sketch.size
    for _ in range(2):  # the thickness of slender parts depends on the scale, and the extent on it
        extent = np.ptp(np.vstack([points for points, *_ in _strokes(scene, group)] or [np.zeros((1, 2))]), axis=0)
        scale = float(min([size / along for size, along in zip(room, extent, strict=True) if along > 0] + [_LARGEST / whole]))
        sketch = sketch_of_state(source, state)
        sketch.size = SYMBOL / scale
        scene = drawn(sketch)
    strokes = [Drawn(style, scale * points, tint, closed) for points, style, tint, closed in _strokes(scene, group)]
    centres = {name: scale * np.array(free.bodies[name].G) for name in group}
    inner = [scale * line for line in _inner(scene, free, group)]
    pins = scale * _pins(source, free, group)
    points = _points(sketch, group, centres, scale)
    return Scenery(strokes, inner, pins, centres, points, _dimensions(sketch, group, scale, scaled), scale, sketch)


def _strokes(scene: Scene, group: Collection[str]) -> list[tuple[Array, str, str, bool]]:
    """Place, style, colour and whether closed, of all strokes of the group's bodies but the symbols of joints."""
    return [
        (scene.place(i, stroke.points), stroke.style, colour(i - 1), stroke.closed)
        for i, figure in enumerate(scene.figures)
        for stroke in figure.strokes
        if figure.name in group and stroke.style not in _CUT
    ]


def _inner(scene: Scene, free: FreeBodies, group: Collection[str]) -> list[Array]:
    """Springs, links and strings that are not cut."""
    inside = {load.name for load in free.inside(*group)}
    lines = [line for pair in scene.pairs if pair.name in inside for line in scene.pair_lines(pair)]
    return lines + [cord.path[0] for cord in scene.cords if cord.name in inside and cord.shown[0]]


def _pins(source: Source, free: FreeBodies, group: Collection[str]) -> Array:
    """Where the group's bodies are pinned, to each other or to others, (k, 2) in m."""
    kinds = {joint["name"]: joint["type"] for joint in source.about["joints"]}
    parts = [p for load in free.loads if kinds.get(load.name) in _PINNED for p in load.on if p.body in group]
    return np.array([part.point for part in parts]).reshape(-1, 2)


def _points(sketch: Sketch, group: Collection[str], centres: dict[str, Array], scale: float) -> list[Tag]:
    """Points with names of their own, each place once, and the mass centre of a single body."""
    tags: list[Tag] = []
    for name, (body, _) in sketch.at.items():
        last, place = name.rpartition(".")[2], scale * sketch.place(name)
        seen = any(np.hypot(*(tag.at - place)) < 1.0 for tag in tags)
        if body in group and last not in UNTOLD and not seen:
            tags.append(Tag(symbol(last), place))
    particles = {body["name"] for body in sketch.spec["bodies"] if body["particle"]}
    if len(group) == 1 and not particles & set(group):
        [place] = centres.values()
        if not any(np.hypot(*(tag.at - place)) < 1.0 for tag in tags):
            tags.append(Tag("G", place))
    return tags


def _dimensions(sketch: Sketch, group: Collection[str], scale: float, scaled: bool) -> list[Dimension]:
    """The coordinates that say where the group's bodies are."""
    found = []
    for measure in measures(sketch, radius=5.0):
        if measure.second in group:
            value = rf" = \mathrm{{{measure.value}}}".replace(" m}", r"\ m}").replace("°", r"^\circ") if scaled else ""
            text = symbol(measure.coordinate) + value
            found.append(Dimension(text, scale * measure.arrow, scale * measure.guide, measure.angle))
    return found
