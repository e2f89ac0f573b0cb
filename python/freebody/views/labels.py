"""Labels that keep off each other and off the drawing: greedy placement on the finished axes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from freebody.run.records import Array
from freebody.views.style import INK

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_DIRECTIONS = np.linspace(0, 2 * np.pi, 16, endpoint=False) + np.pi / 4
_DISTANCES = (9.0, 18.0, 30.0, 46.0, 66.0)  # px at 100 dpi
_AIR = 4.0  # px at 100 dpi of free room that a label likes around it


@dataclass(frozen=True)
class Label:
    """A text to be put near an anchor (2,) in data coordinates."""

    text: str
    anchor: Array
    colour: str = INK
    size: float = 9.0
    bold: bool = False


def place_labels(ax: Axes, labels: Sequence[Label], ink: Array) -> None:
    """Put every label at the best free place near its anchor; ``ink`` (k, 2) are drawn places to keep off, in data."""
    figure = ax.figure
    figure.canvas.draw()
    drawn = ax.transData.transform(ink)
    frame = ax.get_window_extent()
    taken: list[Array] = []
    for label in labels:
        x, y = label.anchor
        text = ax.text(x, y, label.text, color=label.colour, fontsize=label.size, ha="center", va="center",
                       fontweight="bold" if label.bold else "normal", zorder=5)  # fmt: skip
        extent = text.get_window_extent()
        half = np.array([extent.width, extent.height]) / 2 + 1.5
        anchor = ax.transData.transform(label.anchor)
        centre, distance = _best(anchor, half, drawn, taken, (frame.x0, frame.x1, frame.y0, frame.y1), figure.dpi / 100)
        taken.append(np.array([centre - half, centre + half]))
        text.set_position(tuple(ax.transData.inverted().transform(centre)))
        if distance > 24 * figure.dpi / 100:
            _leader(ax, anchor, centre, half, label.colour)


def _best(
    anchor: Array, half: Array, drawn: Array, taken: Sequence[Array], frame: tuple[float, float, float, float], scale: float
) -> tuple[Array, float]:
    """The cheapest centre for a box of half sizes, in pixels, and how far it is from the anchor."""
    choices = []
    for distance in _DISTANCES:
        for angle in _DIRECTIONS:
            way = np.array([np.cos(angle), np.sin(angle)])
            centre = anchor + way * (distance * scale + np.abs(way) @ half * 0.9)
            low, high = centre - half, centre + half
            overlap = sum(np.prod(np.clip(np.minimum(high, b) - np.maximum(low, a), 0, None)) for a, b in taken)
            covered, close = (np.all((drawn > low - room) & (drawn < high + room), axis=1).sum() for room in (0.0, _AIR * scale))
            outside = np.clip([frame[0] - low[0], high[0] - frame[1], frame[2] - low[1], high[1] - frame[3]], 0, None).sum()
            cost = 40 * overlap + 20 * covered + 5 * close + 60 * outside + distance
            choices.append((cost, distance * scale, centre))
    _, distance, centre = min(choices, key=lambda choice: choice[0])
    return centre, distance


def _leader(ax: Axes, anchor: Array, centre: Array, half: Array, colour: str) -> None:
    """A thin line from the anchor to the edge of the label."""
    way = centre - anchor
    stop = centre - way * min(1.0, float(np.min(half / np.maximum(np.abs(way), 1e-9))))
    ends = ax.transData.inverted().transform([anchor, stop])
    ax.plot(*ends.T, color=colour, lw=0.7, alpha=0.7, zorder=4)
