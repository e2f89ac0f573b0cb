"""A motion as an SVG that moves by itself, for the middle of a page: bodies, what is stretched between them, and strings.

The page's own style says what colour things have: every line has its style and the tone of its body as classes."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import GROUND, Array
from freebody.views.render import ORDER, height
from freebody.views.scene import of_run
from freebody.views.sketch import Figure, Pair, Sketch, Stroke
from freebody.views.style import PALETTE

if TYPE_CHECKING:
    from freebody.run.simulation import Run

WIDTH, HEIGHT = 320, 210
_MARGIN = 14
_LEAST = 5.0
"""Of symbols, in units of the picture."""
_TURNS, _TRAVEL = 3.0, 8.0
"""What is shown of a long motion: until some body has turned or gone so far, in turns and in extents of the whole."""
_LASTS = (3.0, 8.0)
"""Seconds of one showing, at least and at most; between them as long as in life."""
_POSES = 720
"""Of all bodies together: more bodies have fewer frames."""
_STRETCHED = (0, ORDER.index("coil") - 0.5)
"""The layer of what is stretched between bodies, below their pins."""
_HELD = 0.15
"""The part of a showing for which its end stands."""


def moving_picture(run: Run, title: str = "") -> str:
    """The first part of a run as an SVG element, which begins again when it has ended."""
    until = _part(run)
    frames = int(np.clip(_POSES // (len(run.bodies) + 1), 12, 72))
    return _Drawn(of_run(run, np.linspace(run.edges[0], until, frames)), title or run.name).svg()


def _part(run: Run) -> float:
    """Until when the motion is shown."""
    times = np.linspace(run.edges[0], run.edges[-1], 2001)
    poses = run.at(times).poses
    if not poses.shape[1]:
        return float(times[-1])
    steps = np.abs(np.diff(poses, axis=0)).max(axis=1)
    places = poses[:, :, :2].reshape(-1, 2)
    extent = float(np.hypot(*np.ptp(places, axis=0))) or 1.0
    shown = (np.cumsum(steps[:, 2]) < _TURNS * 2 * np.pi) & (np.cumsum(np.hypot(*steps[:, :2].T)) < _TRAVEL * extent)
    return float(times[max(int(shown.sum()), 20)])


class _Drawn:
    """A sketch on paper: y down, in units of the picture."""

    def __init__(self, sketch: Sketch, title: str) -> None:
        self.sketch, self.title = sketch, title
        x0, x1, y0, y1 = sketch.bounds()
        wide, high = max(x1 - x0, 6 * sketch.size), max(y1 - y0, 6 * sketch.size)
        self.scale = min((WIDTH - 2 * _MARGIN) / wide, (HEIGHT - 2 * _MARGIN) / high)
        self.middle = np.array([x0 + x1, y0 + y1]) / 2
        self.symbol = max(1.0, _LEAST / (sketch.size * self.scale))
        lasts = float(np.clip(sketch.t[-1] - sketch.t[0], *_LASTS))
        self.frames = [*range(len(sketch.t)), *[len(sketch.t) - 1] * round(_HELD * len(sketch.t))]
        self.still = 0.4 * lasts
        self.clock = f'dur="{lasts * (1 + _HELD):.2f}s" repeatCount="indefinite"'
        self.places = self.paper(sketch.poses[:, :, :2])  # (nt, nf, 2)
        self.turns = -np.degrees(sketch.poses[:, :, 2])

    def svg(self) -> str:
        body = "".join(part for _, part in sorted(self._parts(), key=lambda part: part[0]))
        box = f'viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{escape(self.title)}, in motion"'
        return f'<svg class="moving" xmlns="http://www.w3.org/2000/svg" data-still="{self.still:.2f}" {box}>{self._traces()}{body}</svg>'

    def paper(self, points: Array) -> Array:
        """Places in the fixed axes."""
        return (points - self.middle) * self.scale * (1, -1) + (WIDTH / 2, HEIGHT / 2)

    def _parts(self) -> Iterator[tuple[tuple[int, float], str]]:
        """What is drawn, each with its layer and its place within it."""
        for i, figure in enumerate(self.sketch.figures.values()):
            for stroke in figure.strokes:
                yield (
                    (self.sketch.layer(figure.name), height(stroke.style, figure.name)),
                    self._with_body(i, self._stroke(figure, stroke)),
                )
        for pair in self.sketch.pairs:
            yield _STRETCHED, self._pair(pair)
        for cord in self.sketch.cords:
            start = cord.path[:, :1]
            path = self.paper(start + (self.symbol if cord.symbol else 1.0) * (cord.path - start))
            moved = self._values("points", [_points(each) for each in path])
            drawn = f'<polyline class="cord" points="{_points(path[0])}">{moved}{self._shown(cord.shown)}</polyline>'
            yield _STRETCHED, drawn

    def _stroke(self, figure: Figure, stroke: Stroke) -> str:
        points = stroke.points
        if stroke.about is not None:
            points = np.asarray(stroke.about) + self.symbol * (points - stroke.about)
        place = self.sketch.tone(figure.name) if stroke.tone is None else stroke.tone
        tone = "ground" if figure.name == GROUND else f"tone{place % len(PALETTE)}"
        shape = "polygon" if stroke.closed else "polyline"
        shown = "" if stroke.shown is None else self._shown(stroke.shown)
        return f'<{shape} class="{stroke.style} {tone}" points="{_points(points * self.scale * (1, -1))}">{shown}</{shape}>'

    def _with_body(self, figure: int, drawn: str) -> str:
        places, turns = self.places[:, figure], self.turns[:, figure]
        start = f"translate({_pair(places[0])}) rotate({turns[0]:.1f})"
        if np.ptp(places, axis=0).max() < 0.05 and np.ptp(turns) < 0.05:
            return f'<g transform="{start}">{drawn}</g>'
        shifts = self._moves("translate", [_pair(place) for place in places])
        turned = self._moves("rotate", [f"{turn:.1f}" for turn in turns])
        return (
            f'<g transform="translate({_pair(places[0])})">{shifts}<g transform="rotate({turns[0]:.1f})">{turned}{drawn}</g></g>'
        )

    def _pair(self, pair: Pair) -> str:
        """What is stretched: from its first end, turned, its length as the scale along it."""
        ends = []
        for i, x, y in pair.ends:
            pose = self.sketch.poses[:, i].T
            ends.append(self.paper(np.column_stack([
                pose[0] + x * np.cos(pose[2]) - y * np.sin(pose[2]), pose[1] + x * np.sin(pose[2]) + y * np.cos(pose[2])
            ])))  # fmt: skip
        along = ends[1] - ends[0]
        lengths, turns = np.hypot(*along.T), np.degrees(np.unwrap(np.arctan2(along[:, 1], along[:, 0])))
        moves = [("translate", [_pair(end) for end in ends[0]]), ("rotate", [f"{turn:.1f}" for turn in turns]),
                 ("scale", [f"{length:.2f},1" for length in lengths])]  # fmt: skip
        across = self.scale * self.symbol * np.array([0.0, -1.0]) + (1, 0)
        lines = "".join(f'<polyline class="pair" points="{_points(line * across, 3)}"/>' for line in pair.lines)
        for kind, values in reversed(moves):
            lines = f'<g transform="{kind}({values[0]})">{self._moves(kind, values)}{lines}</g>'
        return f"<g>{self._shown(pair.shown)}{lines}</g>"

    def _traces(self) -> str:
        names = [name for name in self.sketch.traces if name in self.sketch.at]
        paths = (self.paper(self.sketch.seen_from("ground", name)) for name in names[:2])
        return "".join(f'<polyline class="trace" points="{_points(path)}"/>' for path in paths)

    def _moves(self, kind: str, values: list[str]) -> str:
        listed = ";".join(values[k] for k in self.frames)
        return f'<animateTransform attributeName="transform" type="{kind}" values="{listed}" {self.clock}/>'

    def _values(self, name: str, values: list[str], how: str = "linear") -> str:
        listed = ";".join(values[k] for k in self.frames)
        return f'<animate attributeName="{name}" calcMode="{how}" values="{listed}" {self.clock}/>'

    def _shown(self, shown: Array) -> str:
        """When it is there, of what comes and goes."""
        return "" if shown.all() else self._values("visibility", ["visible" if each else "hidden" for each in shown], "discrete")


def _pair(place: Array) -> str:
    return f"{place[0]:.1f},{place[1]:.1f}"


def _points(points: Array, digits: int = 1) -> str:
    return " ".join(f"{x:.{digits}f},{y:.{digits}f}" for x, y in points)
