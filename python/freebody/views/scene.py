"""What there is to draw, as pure data: figures, what is stretched between them, and the figures' poses over time.

Matplotlib and the browser draw the same scene.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import GROUND, Array, State
from freebody.views import shapes
from freebody.views.contact_glyphs import draw_contacts, draw_strings
from freebody.views.glyphs import draw_forces, draw_joints
from freebody.views.impact_markers import LASTING, ImpactMarker, impact_markers
from freebody.views.sketch import Cord, Figure, Pair, Sketch, Stroke, named_points
from freebody.views.style import GROUND as GREY
from freebody.views.style import colour

if TYPE_CHECKING:
    from freebody.run.simulation import Run

_OWN_POINTS = ("origin", "G", "centre", "start")


@dataclass(frozen=True)
class Drawn:
    """A stroke where its body is, points (k, 2); ``tint`` and ``body``: colour and name of its body."""

    style: str
    points: Array
    tint: str
    closed: bool
    body: str

    @property
    def line(self) -> Array:
        """Its polyline (k, 2), back to the first point where it is closed."""
        return np.vstack([self.points, self.points[:1]]) if self.closed else self.points


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
    impact_markers: list[ImpactMarker] = field(default_factory=list)

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
        for i, figure in enumerate(self.figures):
            for each in figure.strokes:
                if each.shown is None or each.shown[frame]:
                    tint = colour(i - 1) if i else GREY
                    yield Drawn(each.style, self.place(i, each.points, frame), tint, each.closed, figure.name)

    def bounds(self) -> tuple[float, float, float, float]:
        """x from, x to, y from, y to: a box about everything that is drawn at any time."""
        frames = np.unique(np.linspace(0, len(self.t) - 1, 80).astype(int))
        everything = np.vstack([line for k in frames for line in self.lines(k)] or [np.zeros((1, 2))])
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
        at = {name: (i, place) for i, figure in enumerate(self.figures) for name, place in figure.points.items()}

        def short(values: Any) -> Any:
            return values.round(digits).tolist() if isinstance(values, np.ndarray) else values

        def item(each: Stroke | Pair | Cord, **stated: Any) -> dict[str, Any]:
            sometimes = {} if each.shown is None or each.shown.all() else {"shown": each.shown.tolist()}
            return {key: short(value) for key, value in stated.items()} | sometimes

        return {
            "size": self.size,
            "bounds": self.bounds(),
            "t": self.t.tolist(),
            "poses": places.reshape(len(self.t), -1).tolist(),
            "figures": [
                {"name": f.name, "strokes": [item(s, points=s.points, style=s.style, closed=s.closed) for s in f.strokes]}
                for f in self.figures
            ],
            "pairs": [item(p, kind=p.kind, ends=p.ends, lines=[line.round(max(digits, 4)).tolist() for line in p.lines])
                      for p in self.pairs],
            "cords": [item(c, path=c.path.reshape(len(self.t), -1), taut=c.taut.tolist()) for c in self.cords],
            "traces": [{"name": name, "figure": at[name][0], "at": at[name][1]} for name in self.traces],
            "flashes": [{"t": each.t, "rays": short(each.rays(self.spark))} for each in self.impact_markers],
            "lasting": LASTING,
        }  # fmt: skip


def of_run(run: Run, times: Sequence[float] | Array | None = None, traces: Sequence[str] | None = None) -> Scene:
    """The scene of a run at times within it (default: its output times)."""
    shown = run if times is None else run.at(times)
    start = State(run.start.p, float(shown.t[0]), shown.q[0], shown.u[0])
    scene = drawn(Sketch(run.source, start, shown.t, shown.q, shown.poses, shown), traces)
    return replace(scene, impact_markers=impact_markers(run))


def drawn(sketch: Sketch, traces: Sequence[str] | None = None) -> Scene:
    """Everything drawn; ``traces`` names the points to be traced (default: a few worth it)."""
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
        # A corner is two numbers or a point, with or without its body's name.
        named = np.array([
            [sketch.number(x) for x in corner] if not isinstance(corner, str)
            else sketch.at[corner if corner in sketch.at else f"{body['name']}.{corner}"][1]
            for corner in outline
        ])  # fmt: skip
        figure.add(named if len(named) > 2 else shapes.rounded_hull(named, thickness), "body")
        return
    for piece in body["pieces"]:
        sizes = {name: sketch.number(size) for name, size in piece.get("sizes", {}).items()}
        corners = np.array([[sketch.number(x) for x in corner] for corner in piece.get("corners", [])])
        at = [sketch.number(x) for x in piece.get("at", (0.0, 0.0))]
        for points, style in shapes.piece_outlines(piece["shape"], sizes, corners, thickness):
            figure.add(shapes.turn(points, sketch.number(piece.get("angle", 0.0)), at), style, len(points) > 2)
    joined = {name for joint in sketch.spec["joints"] for name in named_points(joint["with"])}
    own = np.array([at for name, at in figure.points.items() if not name.endswith(".origin") or name in joined] or [(0.0, 0.0)])
    if any(stroke.style in ("body", "band", "mass") for stroke in figure.strokes):
        _reach_out(figure, own, thickness)
    else:
        figure.add(shapes.rounded_hull(own, thickness), "body")


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


def _worth_tracing(sketch: Sketch) -> list[str]:
    """Up to three points that move and where nothing is joined; mass centres where there is none."""
    joined = [sketch.at[n] for j in sketch.spec["joints"] for n in named_points(j["with"]) if n in sketch.at]
    free = [
        name
        for name, (body, at) in sketch.at.items()
        if body != GROUND
        and name.rpartition(".")[2] not in _OWN_POINTS
        and not any(body == other and np.allclose(at, place, atol=1e-6 * sketch.size) for other, place in joined)
    ]
    return free[:3] or [name for name in sketch.at if name.endswith(".G")][-1:]
