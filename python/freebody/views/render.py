"""A sketch on matplotlib axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from freebody.core import GROUND as FIXED
from freebody.views.sketch import Drawn, Sketch
from freebody.views.style import GROUND, IMPACT, INK, PAPER

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

# Later styles lie on top of earlier ones.
ORDER = ("hatch", "band", "body", "dash", "rail", "block", "mark", "slot", "coil", "mass", "weld", "pin")
_LAYER = 0.6  # more than all styles of one body need


def height(style: str, body: str) -> int:
    """The place of a stroke in the order: the lines of ground lie behind all bodies."""
    return ORDER.index("hatch" if body == FIXED and style == "rail" else style)


def render(sketch: Sketch, ax: Axes, frame: int = 0) -> list[Artist]:
    """Draw one frame; returns what was added."""
    artists: list[Artist] = [ax.add_patch(patch(stroke)) for stroke in sketch.strokes(frame)]
    for pair in sketch.pairs:
        for line in sketch.pair_lines(pair, frame):
            artists += ax.plot(*line.T, color=INK, lw=1.3, zorder=2.37, solid_joinstyle="round")
    for cord in sketch.cords:
        if cord.shown[frame]:
            look = {"color": INK, "lw": 1.2} if cord.taut[frame] else {"color": GROUND, "lw": 1.0}
            artists += ax.plot(*cord.path[frame].T, **look, zorder=2.38, solid_joinstyle="round")
    return artists


def render_markers(sketch: Sketch, ax: Axes, t: float, lasting: float) -> list[Artist]:
    """The impacts of the last ``lasting`` s before a time; returns what was added."""
    artists: list[Artist] = []
    for marker in sketch.impact_markers:
        if glow := marker.glow(t, lasting):
            for ray in marker.rays(sketch.spark):
                artists += ax.plot(*ray.T, color=IMPACT, lw=1.6, alpha=glow, zorder=3, solid_capstyle="round")
    return artists


def patch(stroke: Drawn, shift: ArrayLike = (0.0, 0.0)) -> Any:
    """A stroke on the axes, moved by a ``shift``."""
    from matplotlib.patches import Polygon

    order, look = 2 + 0.05 * height(stroke.style, stroke.body) + _LAYER * stroke.layer, _look(stroke.style, stroke.tint)
    return Polygon(stroke.points + shift, closed=stroke.closed, zorder=order, joinstyle="round", **look)


def _look(style: str, tint: str) -> dict[str, Any]:
    """Fill, line and width of a style."""
    if style in ("body", "block"):
        from matplotlib.colors import to_rgb

        return {"facecolor": tuple(0.78 + 0.22 * channel for channel in to_rgb(tint)), "edgecolor": tint, "lw": 1.5}
    if style == "mass":
        return {"facecolor": tint, "edgecolor": tint, "lw": 1}
    if style == "weld":
        return {"facecolor": INK, "edgecolor": INK, "lw": 1}
    if style in ("pin", "slot"):
        return {"facecolor": PAPER, "edgecolor": INK if style == "pin" else tint, "lw": 1.4 if style == "pin" else 1.1}
    if style == "coil":
        return {"fill": False, "edgecolor": INK, "lw": 1.2}
    width = {"band": 4.0, "mark": 1.5, "rail": 1.6, "hatch": 0.8, "dash": 1.2}[style]
    tone = GROUND if style in ("hatch", "rail") else tint
    return {"fill": False, "edgecolor": tone, "lw": width, "ls": (0, (5, 3)) if style == "dash" else "-"}


def frame_axes(sketch: Sketch, ax: Axes, margin: float = 2.0) -> None:
    """Equal scales and room for the whole motion."""
    x0, x1, y0, y1 = sketch.bounds()
    room = margin * sketch.size
    ax.set(xlim=(x0 - room, x1 + room), ylim=(y0 - room, y1 + room), aspect="equal")
