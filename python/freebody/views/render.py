"""A scene on matplotlib axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from freebody.views.scene import Scene
from freebody.views.style import GROUND, IMPACT, INK, PAPER, colour

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

# Later styles lie on top of earlier ones.
ORDER = ("hatch", "dash", "band", "body", "rail", "block", "mark", "slot", "mass", "weld", "pin")


def render(scene: Scene, ax: Axes, frame: int = 0) -> list[Artist]:
    """Draw one frame; returns what was added."""
    artists: list[Artist] = []
    for i, figure in enumerate(scene.figures):
        tint = GROUND if i == 0 else colour(i - 1)
        for stroke in (s for s in figure.strokes if s.is_there(frame)):
            points = scene.place(i, stroke.points, frame)
            artists.append(ax.add_patch(patch(stroke.style, points, tint, stroke.closed)))
    for pair in scene.pairs:
        for line in scene.pair_lines(pair, frame):
            artists += ax.plot(*line.T, color=INK, lw=1.3, zorder=2.37, solid_joinstyle="round")
    for cord in scene.cords:
        if cord.shown[frame]:
            look = {"color": INK, "lw": 1.2} if cord.taut[frame] else {"color": GROUND, "lw": 1.0}
            artists += ax.plot(*cord.path[frame].T, **look, zorder=2.38, solid_joinstyle="round")
    return artists


def render_markers(scene: Scene, ax: Axes, t: float, lasting: float) -> list[Artist]:
    """The impacts of the last ``lasting`` s before a time; returns what was added."""
    artists: list[Artist] = []
    for marker in scene.impact_markers:
        if glow := marker.glow(t, lasting):
            for ray in marker.rays(scene.spark):
                artists += ax.plot(*ray.T, color=IMPACT, lw=1.6, alpha=glow, zorder=3, solid_capstyle="round")
    return artists


def patch(style: str, points: Any, tint: str, closed: bool = True) -> Any:
    """A stroke where its points (k, 2) are on the axes; ``tint`` is the colour of its body."""
    from matplotlib.patches import Polygon

    return Polygon(points, closed=closed, zorder=2 + 0.05 * ORDER.index(style), joinstyle="round", **_look(style, tint))


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
    width = {"band": 4.0, "mark": 1.5, "rail": 1.6, "hatch": 0.8, "dash": 1.2}[style]
    tone = GROUND if style in ("hatch", "rail") else tint
    return {"fill": False, "edgecolor": tone, "lw": width, "ls": (0, (5, 3)) if style == "dash" else "-"}


def frame_axes(scene: Scene, ax: Axes, margin: float = 2.0) -> None:
    """Equal scales and room for the whole motion."""
    x0, x1, y0, y1 = scene.bounds()
    room = margin * scene.size
    ax.set(xlim=(x0 - room, x1 + room), ylim=(y0 - room, y1 + room), aspect="equal")
