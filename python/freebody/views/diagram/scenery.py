"""The bodies of a group on paper, in points (1/72 inch): outlines, what joins them inside, named points, coordinates."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeAlias

import numpy as np

from freebody.core import GROUND, Array, CompiledModel, FreeBodies, State
from freebody.core.cards import joints
from freebody.views import shapes
from freebody.views.diagram.actions import Action, attached
from freebody.views.diagram.names import symbol
from freebody.views.dimension_lines import DimensionLine, Paper, dimension_lines
from freebody.views.draw import UNNAMED
from freebody.views.scene import drawn
from freebody.views.sketch import Drawn, Sketch, sketch_of_state

SYMBOL = 5.0  # pt, the size of symbols; a slender body is 1.6 times that thick
_ROOM = 130.0, 115.0  # pt, what a single body may take
_WIDER = 260.0, 160.0  # pt, what two or three may take
_WIDEST = 400.0, 300.0  # pt, what more may take
CROWD = 3  # bodies of which a diagram has room for the names, the loads and the coordinates
_LARGEST = 30.0  # pt for the size of a symbol in the whole mechanism, so that a small body is not drawn as large as a large one
_FAR = 60.0  # pt, longest arrow of a coordinate on a small body
_FURTHER = 6.0  # extents of the bodies, how long an arrow may be that they are drawn smaller for
_POINT = 4.0  # sizes of symbols, below which a mechanism is no more than a point
_NEARBY = 40.0  # pt about all else, in which points of ground are shown
_RADIUS = 5.0  # sizes of symbols, of the arcs of angles
_BESIDE = 8.0  # pt from its body at which a force hangs in the air
_BLOCK, _SMALL_BLOCK = (5.6, 2.6), (3.2, 1.6)  # sizes of symbols, half of a block by itself, or among others
_LOOSE = ("rail", "slot", "hatch", "coil")
_SOLID = ("body", "block", "band", "mass")
_CUT = ("pin", "weld", "coil")
Dimensioned: TypeAlias = Callable[[Sketch, Paper], Iterable[DimensionLine]]
"""What finds coordinates to draw in a sketch."""


@dataclass(frozen=True)
class Tag:
    """A name for a place; without a text it is only a dot."""

    text: str
    at: Array


@dataclass(frozen=True)
class Dimension:
    """A coordinate on paper: its arrow (k, 2) and guides (2, 2); ``axis`` names the direction that turns where the body does not
    show it."""

    text: str
    arrow: Array
    guides: list[Array]
    angle: bool
    axis: Tag | None = None

    @property
    def head(self) -> float:
        """What the head of its arrow is scaled by, in pt."""
        return float(np.clip(0.8 * shapes.length(self.arrow), 4.0, 7.0))


@dataclass(frozen=True)
class Scenery:
    """What is seen of a group on paper. ``inner``: lines of springs and strings within it; ``pins``, ``centres``: places (k, 2);
    ``scale`` in pt for each m."""

    strokes: list[Drawn]
    inner: list[Array]
    pins: Array
    centres: dict[str, Array]
    points: list[Tag]
    dimensions: list[Dimension]
    scale: float
    sketch: Sketch

    def bare(self) -> Scenery:
        """The same without coordinates and points other than mass centres."""
        return replace(self, dimensions=[], points=[tag for tag in self.points if tag.text == "G"])

    @property
    def solids(self) -> list[Array]:
        """Outlines of what is solid."""
        return [stroke.points for stroke in self.strokes if stroke.style in _SOLID]

    def slides(self, action: Action) -> bool:
        """Whether it is the force of a slider, which has no point of its own."""
        kinds = {joint["name"]: joint["type"] for joint in self.sketch.metadata["joints"]}
        return action.kind == "joint" and joints()[kinds[action.name]].slides

    def within(self, places: Array) -> bool:
        """Whether any of some places (k, 2) is on a body."""
        return any(shapes.inside(outline, places).any() for outline in self.solids)

    def measured(self, group: Sequence[str], scaled: bool, taken: Sequence[Array], figures: int) -> Scenery:
        """With the coordinates that say where the group's bodies are, off lines that are ``taken``; of their values so many ``figures``
        hold."""
        far = max(extent(self.strokes), _FAR) / self.scale
        blocks = [stroke.line for stroke in self.strokes if stroke.style == "block"]
        paper = Paper(_RADIUS, group, far, [line / self.scale for line in (*taken, *blocks)], figures)
        return replace(self, dimensions=_dimensions(self.sketch, self.strokes, self.scale, scaled, paper, dimension_lines))

    @cached_property
    def obstacles(self) -> Array:
        """Places (k, 2) all along what is drawn, a few pt apart."""
        dimensions = [line for each in self.dimensions for line in (each.arrow, *each.guides)]
        return shapes.dense([*(stroke.line for stroke in self.strokes), *self.inner, *dimensions])


def scenery(source: CompiledModel, state: State, free: FreeBodies, group: Sequence[str], size: float = 1.0) -> Scenery:
    """The bodies of a group, without coordinates, as large as the paper allows, or ``size`` of that."""
    width, height = _ROOM if len(group) == 1 else _WIDER if len(group) <= CROWD else _WIDEST
    room, block = (size * width, size * height), _BLOCK if len(group) == 1 else _SMALL_BLOCK

    def seen(sketch: Sketch) -> list[Array]:
        return [*(each.points for each in _strokes(sketch, group, 1.0)), *(at[None] for _, at in _loaded(sketch, free, group))]

    sketch, scale = _fitted(source, state, room, seen, block)
    strokes = _strokes(sketch, group, scale)
    strokes = _arms(strokes, sketch, free, group, scale) + strokes
    centres = {name: scale * np.array(free.bodies[name].G) for name in group}
    inner = [scale * line for line in _joining(sketch, {load.name for load in free.inside(*group)})]
    pinned = {joint["name"] for joint in sketch.metadata["joints"] if joints()[joint["type"]].pinned}
    cut = [(load, part) for load in free.loads if load.name in pinned for part in load.on if part.body in group]
    places = np.reshape([attached(load, part, sketch) for load, part in cut], (-1, 2))
    pins = scale * np.unique(np.round(places, 12), axis=0)
    points = _points(sketch, group, centres, scale)
    return Scenery(strokes, inner, pins, centres, points, [], scale, sketch)


def extent(strokes: Sequence[Drawn]) -> float:
    """From corner to corner of the box about some strokes."""
    return float(np.hypot(*np.ptp(np.vstack([stroke.points for stroke in strokes] or [np.zeros((1, 2))]), axis=0)))


def whole(source: CompiledModel, state: State, measured: Dimensioned = dimension_lines) -> Scenery:
    """The mechanism on its ground with joints, springs and strings, and all its coordinates, or others, as large as the paper
    allows."""
    names = [body["name"] for body in source.metadata["bodies"]]

    def seen(sketch: Sketch) -> list[Array]:
        lines = [stroke.points for stroke in _strokes(sketch, [GROUND, *names], 1.0)] + _joining(sketch)
        across = float(np.hypot(*np.ptp(np.vstack(lines), axis=0)))
        far = _FURTHER * across if across > _POINT * sketch.size else np.inf
        return lines + [m.arrow for m in measured(sketch, Paper(_RADIUS)) if np.hypot(*np.ptp(m.arrow, axis=0)) < far]

    sketch, scale = _fitted(source, state, _WIDEST, seen, _SMALL_BLOCK)
    strokes = _strokes(sketch, [GROUND, *names], scale, hidden=())
    inner = [scale * line for line in _joining(sketch)]
    centres = {name: scale * sketch.place(f"{name}.G") for name in names}
    paper = Paper(_RADIUS, far=float(np.hypot(*_WIDEST)) / scale)
    dimensions = _dimensions(sketch, strokes, scale, False, paper, measured)
    made = Scenery(strokes, inner, np.zeros((0, 2)), centres, [], dimensions, scale, sketch)
    low, high = made.obstacles.min(axis=0) - _NEARBY, made.obstacles.max(axis=0) + _NEARBY
    points = _points(sketch, [GROUND, *names], centres, scale)
    return replace(made, points=[tag for tag in points if (low < tag.at).all() and (tag.at < high).all()])


def _fitted(
    source: CompiledModel,
    state: State,
    room: tuple[float, float],
    seen: Callable[[Sketch], list[Array]],
    block: tuple[float, float],
) -> tuple[Sketch, float]:
    """What is drawn, and the scale in pt for each m at which what is ``seen`` of it fills the room."""
    sketch = drawn(sketch_of_state(source, state))
    least = sketch.size
    for _ in range(2):  # the thickness of slender parts depends on the scale, and the extent on it
        extent = np.ptp(np.vstack(seen(sketch) or [np.zeros((1, 2))]), axis=0)
        scale = float(min([size / along for size, along in zip(room, extent, strict=True) if along > 0] + [_LARGEST / least]))
        sketch = sketch_of_state(source, state)
        sketch.size, sketch.block = SYMBOL / scale, block
        drawn(sketch)
    return sketch, scale


def _strokes(sketch: Sketch, group: Collection[str], scale: float, hidden: Collection[str] = _CUT) -> list[Drawn]:
    """All strokes of the group's bodies but those of some styles, by default the symbols of joints."""
    seen = (stroke for stroke in sketch.strokes() if stroke.body in group and stroke.style not in hidden)
    return [replace(stroke, points=scale * stroke.points) for stroke in seen]


def _arms(strokes: list[Drawn], sketch: Sketch, free: FreeBodies, group: Collection[str], scale: float) -> list[Drawn]:
    """An arm of its body to every force that would hang in the air."""
    arms = []
    for body, place in _loaded(sketch, free, group):
        own = [stroke for stroke in strokes if stroke.body == body and stroke.style not in _LOOSE]
        solid = [stroke for stroke in own if stroke.style in _SOLID]
        at, seen = scale * place, shapes.dense([stroke.line for stroke in own])
        if not solid or any(shapes.inside(stroke.points, at[None]) for stroke in solid):
            continue
        gaps = np.hypot(*(seen - at).T)
        if gaps.min() > _BESIDE:
            outline = shapes.rounded_hull(np.array([seen[gaps.argmin()], at]), 0.6 * SYMBOL)
            arms.append(Drawn("body", outline, solid[0].tint, True, body))
    return arms


def _loaded(sketch: Sketch, free: FreeBodies, group: Collection[str]) -> list[tuple[str, Array]]:
    """Where forces act on the bodies of a group, with the body, in m."""
    cuts = [(load, part) for load in free.loads for part in load.on if part.body in group and any(part.force)]
    return [(part.body, attached(load, part, sketch)) for load, part in cuts]


def _joining(sketch: Sketch, among: Collection[str] | None = None) -> list[Array]:
    """Springs, links and strings, all of them or those of some names."""
    lines = [line for pair in sketch.pairs if among is None or pair.name in among for line in sketch.pair_lines(pair)]
    return lines + [cord.path[0] for cord in sketch.cords if (among is None or cord.name in among) and cord.shown[0]]


def _points(sketch: Sketch, group: Collection[str], centres: dict[str, Array], scale: float) -> list[Tag]:
    """Points with names of their own, each place once, and the mass centre of a single body."""
    tags: list[Tag] = []
    for name, (body, _) in sketch.at.items():
        last, place = name.rpartition(".")[2], scale * sketch.place(name)
        seen = any(np.hypot(*(tag.at - place)) < 1.0 for tag in tags)
        if body in group and last not in UNNAMED and not seen:
            tags.append(Tag(symbol(last), place))
    particles = {body["name"] for body in sketch.spec["bodies"] if body["particle"]}
    if len(group) == 1 and not particles & set(group):
        [place] = centres.values()
        if not any(np.hypot(*(tag.at - place)) < 1.0 for tag in tags):
            tags.append(Tag("G", place))
    return tags


def _dimensions(
    sketch: Sketch, strokes: Sequence[Drawn], scale: float, scaled: bool, paper: Paper, measured: Dimensioned
) -> list[Dimension]:
    """Coordinates on paper; ``scaled``: with their values."""
    found = []
    for measure in measured(sketch, paper):
        value = rf" = \mathrm{{{measure.value}}}".replace(" m}", r"\ m}").replace("°", r"^\circ") if scaled else ""
        arrow, guides = scale * measure.arrow, [scale * guide for guide in measure.guides]
        axis = _axis(measure.second, guides[1], strokes) if measure.of_axis else None
        found.append(Dimension(symbol(measure.coordinate) + value, arrow, guides, measure.angle, axis))
    return found


def _axis(body: str, guide: Array, strokes: Sequence[Drawn]) -> Tag | None:
    """The name of a body's x axis at the end of a guide that runs along it, unless the body lies there."""
    own = [stroke for stroke in strokes if stroke.body == body]
    seen = shapes.dense([stroke.line for stroke in own])
    lies = any(shapes.inside(stroke.points, guide[1:]) for stroke in own if stroke.style in _SOLID)
    if not own or lies or np.hypot(*(seen - guide[1]).T).min() < SYMBOL:
        return None
    return Tag(symbol(f"x_{body}"), guide[1])
