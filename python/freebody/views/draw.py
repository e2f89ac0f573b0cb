"""A labelled drawing of a mechanism at an instant: bodies, joints, points, coordinates, forces, gravity, axes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import GROUND, State
from freebody.run.records import Array, plain
from freebody.views import shapes
from freebody.views.contact_glyphs import string_label
from freebody.views.dimension_lines import digits, dimension_lines, place_of
from freebody.views.labels import Label, place_labels
from freebody.views.render import frame_axes, render
from freebody.views.scene import Scene, drawn
from freebody.views.sketch import Sketch, sketch_of_state
from freebody.views.style import GROUND as GREY
from freebody.views.style import INK, axes, colour, quiet

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from freebody.core import CompiledModel

LAYERS = ("bodies", "joints", "points", "coordinates", "forces", "springs")
_MEASURE, _LOAD = "#7a1fa2", "#b3261e"
_CORNER = 66.0  # points
UNTOLD = ("origin", "G", "centre", "start", "end")


class _Drawing:
    """The drawing in the making: axes, labels waiting for a place, and where there is ink already."""

    def __init__(self, sketch: Sketch, scene: Scene, ax: Axes) -> None:
        self.sketch, self.scene, self.ax = sketch, scene, ax
        self.labels: list[Label] = []
        self.obstacles: list[Array] = []

    def line(self, points: Array, tone: str, arrow: bool = False, **look: Any) -> None:
        """A polyline, with an arrow head at its end."""
        self.obstacles.append(points)
        self.ax.plot(*points.T, color=tone, **{"lw": 1.3, "zorder": 4, **look})
        if arrow:
            head = {"arrowstyle": "-|>", "color": tone, "lw": 1.3, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 11}
            self.ax.annotate("", points[-1], points[-2], arrowprops=head, zorder=4)

    def everything(self) -> Array:
        """Places (k, 2) all along what is drawn."""
        lines = [*_lines_of(self.scene), *self.obstacles]
        return np.vstack([_dense(line, 0.4 * self.scene.size) for line in lines] or [np.zeros((1, 2))])

    def say(self, text: str, anchor: Array, tone: str = INK, **look: Any) -> None:
        """A label, to be placed when everything is drawn."""
        self.labels.append(Label(text.replace("$", r"\$"), np.asarray(anchor, float), tone, **look))


def drawing(source: CompiledModel, state: State, ax: Axes | None = None, layers: Sequence[str] = LAYERS) -> Axes:
    """Draw the mechanism at a state. ``layers`` chooses what is labelled."""
    with quiet():
        ax = axes(ax, (8.0, 6.0))
        sketch = sketch_of_state(source, state)
        scene = drawn(sketch)
        sheet = _Drawing(sketch, scene, ax)
        ax.set_axis_off()
        frame_axes(scene, ax, margin=6.0)
        render(scene, ax)
        for layer in layers:
            _LAYERS[layer](sheet)
        _make_room(sheet)
        _draw_axes_and_gravity(sheet)
        ax.set_title(scene.name.replace("$", r"\$"))
        place_labels(ax, sheet.labels, sheet.everything())
    return ax


def _lines_of(scene: Scene) -> list[Array]:
    """All lines of a scene in the fixed axes; of what is filled with a strong colour, the inside as well."""
    placed = [line for pair in scene.pairs for line in scene.pair_lines(pair)]
    placed += [cord.path[0] for cord in scene.cords if cord.shown[0]]
    for i, figure in enumerate(scene.figures):
        for stroke in (s for s in figure.strokes if s.is_there(0)):
            line = scene.place(i, np.vstack([stroke.points, stroke.points[:1]]) if stroke.closed else stroke.points)
            middle = line.mean(axis=0)
            placed += [middle + part * (line - middle) for part in ((1.0, 0.7, 0.4) if stroke.style == "mass" else (1.0,))]
    return placed


def _dense(line: Array, step: float) -> Array:
    """A polyline with a point at least every ``step``, up to 300 a side."""
    sides = [(a, b, int(np.clip(np.hypot(*(b - a)) / step, 1, 300)) + 1) for a, b in pairwise(line)]
    return np.vstack([np.linspace(*side) for side in sides])


def _make_room(sheet: _Drawing) -> None:
    """Wider axes for arrows that leave them, and lower ones where something is drawn in the corners of axes and gravity."""
    ax, obstacles, room = sheet.ax, sheet.everything(), 3.0 * sheet.scene.size
    low, high = obstacles.min(axis=0) - room, obstacles.max(axis=0) + room
    x0, x1 = min(ax.get_xlim()[0], low[0]), max(ax.get_xlim()[1], high[0])
    y0, y1 = min(ax.get_ylim()[0], low[1]), max(ax.get_ylim()[1], high[1])
    box = ax.get_position(original=True)
    width, height = 72 * ax.figure.get_figwidth() * box.width, 72 * ax.figure.get_figheight() * box.height
    corner = _CORNER * max((x1 - x0) / width, (y1 - y0) / height)
    beside = (obstacles[:, 0] < x0 + corner) | (obstacles[:, 0] > x1 - corner)
    y0 = min(y0, obstacles[beside, 1].min(initial=np.inf) - corner)
    ax.set(xlim=(x0, x1), ylim=(y0, y1))


def _draw_bodies(sheet: _Drawing) -> None:
    for i, body in enumerate(sheet.sketch.spec["bodies"], start=1):
        strokes = [stroke.points for stroke in sheet.scene.figures[i].strokes] or [np.zeros((1, 2))]
        largest = max(strokes, key=lambda points: float(np.prod(np.ptp(points, axis=0)) + np.ptp(points)))
        sheet.say(body["name"], sheet.scene.place(i, largest.mean(axis=0)[None])[0], colour(i - 1), size=10.5, bold=True)


def _draw_joints(sheet: _Drawing) -> None:
    for joint in sheet.sketch.spec["joints"]:
        where = place_of(sheet.sketch, joint)
        if where is not None:
            sheet.say(joint["name"], where, INK, size=9.0)


def _draw_points(sheet: _Drawing) -> None:
    """Points with names of their own, each place once; those of joints go by the joint's name."""
    used = [place_of(sheet.sketch, joint) for joint in sheet.sketch.spec["joints"]]
    seen = [place for place in used if place is not None]
    for name in sheet.sketch.at:
        place = sheet.sketch.place(name)
        stated = name.rpartition(".")[2] not in UNTOLD
        if stated and not any(np.allclose(place, other, atol=0.2 * sheet.scene.size) for other in seen):
            seen.append(place)
            sheet.line(np.array([place, place]), INK, marker="o", ms=3)
            sheet.say(name, place, GREY, size=8.5)


def _draw_coordinates(sheet: _Drawing) -> None:
    """Every coordinate from its zero to its value."""
    for measure in dimension_lines(sheet.sketch):
        dashes: Any = (0, (4, 3)) if measure.angle else "-"
        for guide in measure.guides:
            sheet.line(guide, _MEASURE, lw=0.9 if measure.angle else 0.7, ls=dashes)
        sheet.line(measure.arrow, _MEASURE, arrow=True)
        middle = measure.arrow[len(measure.arrow) // 2] if measure.angle else measure.arrow.mean(axis=0)
        sheet.say(f"{plain(measure.coordinate)} = {measure.value}", middle, _MEASURE)


def _draw_forces(sheet: _Drawing) -> None:
    for force in sheet.sketch.spec.get("forces", []):
        fields = force["with"]
        if force["type"] == "torque" and fields["on"] != GROUND:
            _draw_torque(sheet, force["name"], fields)
        elif force["type"] == "force":
            _draw_force(sheet, force["name"], fields)
    _draw_contact_forces(sheet)


def _draw_contact_forces(sheet: _Drawing) -> None:
    """The force of every contact that carries, as it pushes the body that is not ground at the place where it acts."""
    for limit in sheet.sketch.limits():
        if limit.kind != "contact" or limit.at is None or limit.N <= 0:
            continue
        force = np.array([limit.Fx, limit.Fy]) * (-1 if limit.first == GROUND else 1)
        at = np.array(limit.at)
        tail = at - force / np.hypot(*force) * 6 * sheet.scene.size
        sheet.line(np.array([tail, at]), _LOAD, arrow=True, lw=1.8)
        sheet.say(f"{limit.name}: {digits(float(np.hypot(*force)))} N", tail, _LOAD)


def _draw_torque(sheet: _Drawing, name: str, fields: Mapping[str, Any]) -> None:
    x, y, _ = sheet.sketch.poses[0, sheet.sketch.names.index(fields["on"])]
    sense = np.sign(sheet.sketch.number(fields["value"])) or 1.0
    bow = shapes.arc((x, y), 2.2 * sheet.scene.size, -sense * 0.7, sense * 3.4)
    sheet.line(bow, _LOAD, arrow=True, lw=1.6)
    sheet.say(name, bow[-1], _LOAD)


def _draw_force(sheet: _Drawing, name: str, fields: Mapping[str, Any]) -> None:
    number, at = sheet.sketch.number, sheet.sketch.place(fields["at"])
    if fields.get("x") is not None or fields.get("y") is not None:
        vector = np.array([number(fields.get("x") or 0.0), number(fields.get("y") or 0.0)])
    else:
        size, angle = number(fields["value"]), number(fields.get("direction") or 0.0)
        vector = size * np.array([np.cos(angle), np.sin(angle)])
    if fields.get("frame") == "body":
        body = sheet.sketch.at[fields["at"]][0]
        vector = shapes.turn(vector[None], float(sheet.sketch.poses[0, sheet.sketch.names.index(body), 2]))[0]
    length = np.hypot(*vector)
    if length > 0:
        tail = at - vector / length * 6 * sheet.scene.size
        sheet.line(np.array([tail, at]), _LOAD, arrow=True, lw=1.8)
        sheet.say(name, tail, _LOAD)


def _draw_springs(sheet: _Drawing) -> None:
    for name, pair in {pair.name: pair for pair in sheet.scene.pairs if pair.kind in ("spring", "damper")}.items():
        ends = [sheet.scene.place(i, np.array([[x, y]]))[0] for i, x, y in pair.ends]
        sheet.say(name, np.mean(ends, axis=0), GREY)
    for cord in sheet.scene.cords:
        if cord.shown[0]:
            sheet.say(*string_label(sheet.sketch, cord), GREY)


_LAYERS: dict[str, Callable[[_Drawing], None]] = {
    "bodies": _draw_bodies,
    "joints": _draw_joints,
    "points": _draw_points,
    "coordinates": _draw_coordinates,
    "forces": _draw_forces,
    "springs": _draw_springs,
}


def _draw_axes_and_gravity(sheet: _Drawing) -> None:
    """The fixed axes in the lower left corner, the direction of gravity in the lower right one."""
    ax, gravity = sheet.ax, sheet.sketch.spec.get("gravity")
    g = np.array([sheet.sketch.number(x) for x in gravity]) if gravity else np.zeros(2)
    ax.apply_aspect()
    arrows = [((18, 18), (34, 0), "x", GREY), ((18, 18), (0, 34), "y", GREY)]
    if np.hypot(*g) > 0:
        way = 34 * g / np.hypot(*g)
        arrows.append((tuple(np.array([-24.0, 36.0]) - way / 2), tuple(way), "g", _LOAD))
    for start, way, text, tone in arrows:
        corner = (1, 0) if start[0] < 0 else (0, 0)
        look = {"arrowstyle": "-|>", "color": tone, "lw": 1.3, "shrinkA": 0, "shrinkB": 0}
        end = (start[0] + way[0], start[1] + way[1])
        transform = _offset(ax, corner)
        sheet.obstacles.append(ax.transData.inverted().transform(transform.transform([start, np.array(start) + 1.3 * np.array(way)])))
        ax.annotate("", end, start, xycoords=transform, textcoords=transform, arrowprops=look, annotation_clip=False)
        beyond = np.array(end) + 8 * np.array(way) / np.hypot(*way)
        ax.annotate(text, tuple(beyond), xycoords=transform, color=tone, ha="center", va="center", fontsize=9.5, style="italic")


def _offset(ax: Axes, corner: tuple[float, float]) -> Any:
    """Points (1/72 inch) from a corner of the axes."""
    from matplotlib.transforms import Affine2D, ScaledTranslation

    return Affine2D().scale(ax.figure.dpi / 72) + ScaledTranslation(*corner, ax.transAxes)
