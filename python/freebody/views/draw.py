"""A labelled drawing of a mechanism at an instant: bodies, joints, points, coordinates, forces, gravity, axes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import GROUND, Array, State
from freebody.formats import Formats
from freebody.run.records import plain
from freebody.views import shapes
from freebody.views.contact_glyphs import string_label
from freebody.views.dimension_lines import digits, dimension_lines, place_between, place_of
from freebody.views.labels import Label, Obstacles, placed, write
from freebody.views.render import frame_axes, render
from freebody.views.scene import drawn
from freebody.views.sketch import Sketch, sketch_of_state
from freebody.views.style import GROUND as GREY
from freebody.views.style import INK, axes, colour, quiet

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from freebody.core import CompiledModel

_MEASURE, _LOAD = "#7a1fa2", "#b3261e"
_CORNER = 74.0  # points
_USUAL, _LARGE, _MANY = (8.0, 6.0), (11.0, 8.5), 20  # inches of the drawing; how many names take a large one
_NARROWEST = 0.8  # of its height, the width of a drawing at least: labels stand beside what is upright
_COVERED = 0.3  # of an arrow that pushes, the part in its body from which it is drawn pulling instead
_OVER_LINES, _OVER_ARROWS = 8.0, 40.0  # what a label pays for each place that it covers
FORMATS = Formats("a drawing is", dict.fromkeys((".svg", ".png", ".pdf")))
UNNAMED = ("origin", "G", "centre", "start", "end")
"""Points that nearly every body has, of which a drawing says nothing."""


class _Drawing:
    """The drawing in the making: axes, labels waiting for a place, and the lines of what was added to the sketch."""

    def __init__(self, sketch: Sketch, ax: Axes) -> None:
        self.sketch, self.ax = drawn(sketch), ax
        self.labels: list[Label] = []
        self.lines: list[Array] = []

    def line(self, points: Array, tone: str, arrow: bool = False, **look: Any) -> None:
        """A polyline, with an arrow head at its end."""
        self.lines.append(points)
        self.ax.plot(*points.T, color=tone, **{"lw": 1.3, "zorder": 4, **look})
        if arrow:
            head = {"arrowstyle": "-|>", "color": tone, "lw": 1.3, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 11}
            self.ax.annotate("", points[-1], points[-2], arrowprops=head, zorder=4)

    def force(self, vector: Array, at: Array, text: str, pulled: str = "") -> None:
        """An arrow of one length that ends where a force acts, unless the force is 0; that begins there, where it would lie in the body
        that is ``pulled``."""
        if size := float(np.hypot(*vector)):
            way = vector / size * 6 * self.sketch.size
            pulls = pulled and self._lies_within(pulled, at - way, at)
            arrow = np.array([at, at + way] if pulls else [at - way, at])
            self.line(arrow, _LOAD, arrow=True, lw=1.8)
            self.label(text, arrow[1 if pulls else 0], _LOAD)

    def _lies_within(self, body: str, start: Array, end: Array) -> bool:
        """Whether a good part of a way lies in a body."""
        way = np.linspace(start, end, 21)
        outlines = [stroke.line for stroke in self.sketch.strokes(0) if stroke.body == body and stroke.closed]
        covered = np.any([shapes.inside(outline, way) for outline in outlines], axis=0) if outlines else np.zeros(21, bool)
        return bool(covered.mean() > _COVERED)

    def label(self, text: str, anchor: Array, tone: str = INK, size: float = 9.0, bold: bool = False) -> None:
        """A label, to be placed when everything is drawn."""
        self.labels.append(Label(text.replace("$", r"\$"), np.reshape(anchor, (1, 2)), size, tone, bold))


def drawing(source: CompiledModel, state: State, ax: Axes | None = None, layers: Sequence[str] | None = None) -> Axes:
    """Draw the mechanism at a state. ``layers`` chooses what is labelled, by default all of ``LAYERS``."""
    with quiet():
        named = sum(len(source.spec[part]) for part in ("bodies", "joints", "forces")) + len(source.metadata["coordinates"])
        ax = axes(ax, _LARGE if named > _MANY else _USUAL)
        sheet = _Drawing(sketch_of_state(source, state), ax)
        ax.set_axis_off()
        frame_axes(sheet.sketch, ax, margin=6.0)
        render(sheet.sketch, ax)
        for layer in LAYERS if layers is None else layers:
            LAYERS[layer](sheet)
        _make_room(sheet)
        _draw_axes_and_gravity(sheet)
        ax.set_title(sheet.sketch.spec.get("name", "").replace("$", r"\$"))
        _write_labels(sheet)
    return ax


def _make_room(sheet: _Drawing) -> None:
    """Wider axes for arrows that leave them, and lower ones where something is drawn in the corners of axes and gravity."""
    ax, lines, room = sheet.ax, [*sheet.sketch.lines(), *sheet.lines], 3.0 * sheet.sketch.size
    ends = np.vstack(lines or [np.zeros((1, 2))])
    low, high = ends.min(axis=0) - room, ends.max(axis=0) + room
    x0, x1 = min(ax.get_xlim()[0], low[0]), max(ax.get_xlim()[1], high[0])
    y0, y1 = min(ax.get_ylim()[0], low[1]), max(ax.get_ylim()[1], high[1])
    box = ax.get_position(original=True)
    width, height = 72 * ax.figure.get_figwidth() * box.width, 72 * ax.figure.get_figheight() * box.height
    for _ in range(3):  # what is lower is drawn smaller
        corner = _CORNER * max((x1 - x0) / width, (y1 - y0) / height)
        x, y = shapes.dense(lines, corner / 20).T
        y0 = min(y0, y[(x < x0 + corner) | (x > x1 - corner)].min(initial=np.inf) - corner)
    wider = max(0.0, _NARROWEST * (y1 - y0) - (x1 - x0)) / 2
    ax.set(xlim=(x0 - wider, x1 + wider), ylim=(y0, y1))


def _write_labels(sheet: _Drawing) -> None:
    """All labels, in places found on the paper, where the axes are when everything is drawn."""
    from matplotlib.transforms import Affine2D

    sheet.ax.figure.canvas.draw()
    pt = 72 / sheet.ax.figure.dpi
    paper = sheet.ax.transData + Affine2D().scale(pt)
    layers = ((sheet.sketch.lines(), _OVER_LINES), (sheet.lines, _OVER_ARROWS))
    obstacles = Obstacles.of(*((shapes.dense([paper.transform(line) for line in lines]), cost) for lines, cost in layers))
    wanted = [replace(label, anchors=paper.transform(label.anchors)) for label in sheet.labels]
    write(sheet.ax, placed(wanted, obstacles, pt * sheet.ax.get_window_extent().get_points()), paper.inverted().transform)


def _draw_bodies(sheet: _Drawing) -> None:
    for body in sheet.sketch.spec["bodies"]:
        strokes = [stroke.points for stroke in sheet.sketch.figures[body["name"]].strokes] or [np.zeros((1, 2))]
        largest = max(strokes, key=lambda points: float(np.prod(np.ptp(points, axis=0)) + np.ptp(points)))
        sheet.label(
            body["name"],
            sheet.sketch.moved(body["name"], largest.mean(axis=0)[None])[0],
            colour(sheet.sketch.tone(body["name"])),
            size=10.5,
            bold=True,
        )


def _draw_joints(sheet: _Drawing) -> None:
    for joint in sheet.sketch.spec["joints"]:
        where = place_of(sheet.sketch, joint)
        if where is not None:
            sheet.label(joint["name"], where, INK, size=9.0)


def _draw_points(sheet: _Drawing) -> None:
    """Points with names of their own, each place once; those of joints go by the joint's name."""
    used = [place_of(sheet.sketch, joint) for joint in sheet.sketch.spec["joints"]]
    seen = [place for place in used if place is not None]
    for name in sheet.sketch.at:
        place = sheet.sketch.place(name)
        stated = name.rpartition(".")[2] not in UNNAMED
        if stated and not any(np.allclose(place, other, atol=0.2 * sheet.sketch.size) for other in seen):
            seen.append(place)
            sheet.line(np.array([place, place]), INK, marker="o", ms=3)
            sheet.label(name, place, GREY, size=8.5)


def _draw_coordinates(sheet: _Drawing) -> None:
    """Every coordinate from its zero to its value."""
    for measure in dimension_lines(sheet.sketch):
        dashes: Any = (0, (4, 3)) if measure.angle else "-"
        for guide in measure.guides:
            sheet.line(guide, _MEASURE, lw=0.9 if measure.angle else 0.7, ls=dashes)
        sheet.line(measure.arrow, _MEASURE, arrow=True)
        middle = measure.arrow[len(measure.arrow) // 2] if measure.angle else measure.arrow.mean(axis=0)
        sheet.label(f"{plain(measure.coordinate)} = {measure.value}", middle, _MEASURE)


def _draw_forces(sheet: _Drawing) -> None:
    """Given torques and forces; and the force of every contact that carries, as it pushes the body that is not ground."""
    for force in sheet.sketch.spec.get("forces", []):
        fields = force["with"]
        if force["type"] == "torque" and fields["on"] != GROUND:
            body = fields["on"]
            at = place_between(sheet.sketch, {body, fields.get("from") or GROUND})
            at = sheet.sketch.poses[0, sheet.sketch.names.index(body), :2] if at is None else at
            sense = np.sign(sheet.sketch.number(fields["value"])) or 1.0
            bow = shapes.arc(at, 2.2 * sheet.sketch.size, -sense * 0.7, sense * 3.4)
            sheet.line(bow, _LOAD, arrow=True, lw=1.6)
            sheet.label(force["name"], bow[-1], _LOAD)
        elif force["type"] == "force":
            body = sheet.sketch.at[fields["at"]][0]
            sheet.force(_vector(sheet.sketch, fields), sheet.sketch.place(fields["at"]), force["name"], pulled=body)
    for limit in sheet.sketch.limits().values():
        if limit.kind == "contact" and limit.at is not None and limit.N > 0:
            vector = np.array([limit.Fx, limit.Fy]) * (-1 if limit.first == GROUND else 1)
            sheet.force(vector, np.array(limit.at), f"{limit.name}: {digits(float(np.hypot(*vector)))} N")


def _vector(sketch: Sketch, fields: Mapping[str, Any]) -> Array:
    """A given force (2,) in N, fixed axes."""
    number = sketch.number
    if fields.get("x") is not None or fields.get("y") is not None:
        vector = np.array([number(fields.get("x") or 0.0), number(fields.get("y") or 0.0)])
    else:
        size, angle = number(fields["value"]), number(fields.get("direction") or 0.0)
        vector = size * np.array([np.cos(angle), np.sin(angle)])
    if fields.get("frame") == "body":
        body = sketch.at[fields["at"]][0]
        vector = shapes.turn(vector[None], float(sketch.poses[0, sketch.names.index(body), 2]))[0]
    return vector


def _draw_springs(sheet: _Drawing) -> None:
    for name, pair in {pair.name: pair for pair in sheet.sketch.pairs if pair.kind in ("spring", "damper")}.items():
        ends = [sheet.sketch.moved(sheet.sketch.names[i], np.array([[x, y]]))[0] for i, x, y in pair.ends]
        sheet.label(name, np.mean(ends, axis=0), GREY)
    for cord in sheet.sketch.cords:
        if cord.shown[0] and not cord.symbol:
            sheet.label(*string_label(sheet.sketch, cord), GREY)


LAYERS: dict[str, Callable[[_Drawing], None]] = {
    "bodies": _draw_bodies,
    "joints": _draw_joints,
    "points": _draw_points,
    "coordinates": _draw_coordinates,
    "forces": _draw_forces,
    "springs": _draw_springs,
}


def _draw_axes_and_gravity(sheet: _Drawing) -> None:
    """The fixed axes in the lower left corner, the direction of gravity in the lower right one."""
    from matplotlib.transforms import Affine2D, ScaledTranslation

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
        transform = Affine2D().scale(ax.figure.dpi / 72) + ScaledTranslation(*corner, ax.transAxes)  # points from the corner
        sheet.lines.append(ax.transData.inverted().transform(transform.transform([start, np.array(start) + 1.3 * np.array(way)])))
        ax.annotate("", end, start, xycoords=transform, textcoords=transform, arrowprops=look, annotation_clip=False)
        beyond = np.array(end) + 8 * np.array(way) / np.hypot(*way)
        ax.annotate(text, tuple(beyond), xycoords=transform, color=tone, ha="center", va="center", fontsize=9.5, style="italic")
