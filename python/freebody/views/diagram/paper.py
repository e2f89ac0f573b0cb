"""Panels put together on a sheet and drawn by matplotlib, one unit of data to the point."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import Array
from freebody.views.diagram.arrows import HEAD, HEAD_LENGTH, HEAD_WIDTH
from freebody.views.diagram.couples import CoupleArrow
from freebody.views.diagram.panel import MEASURE, Panel, tone
from freebody.views.diagram.rows import LINE, MARGIN, NOTE, TITLE, Laid, Row, laid
from freebody.views.labels import write
from freebody.views.render import patch
from freebody.views.style import GROUND as GREY
from freebody.views.style import INK, PAPER, quiet

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_PAGE = 700.0  # pt, 247 mm: the height of the text of a page
_ROWS = 22.0  # pt between rows
_PIN = 2.6  # pt
_AXES = 24.0  # pt, length of the arrows that show x and y
_CORNER = _AXES + 22.0  # pt below the rows, for them


def sheet(rows: Sequence[Row]) -> Figure:
    """A figure just as large as it must be."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    placed = [laid(row) for row in rows]
    width = max(each.size[0] for each in placed) + 2 * MARGIN
    height = sum(each.size[1] for each in placed) + _ROWS * (len(rows) - 1) + _CORNER + 2 * MARGIN
    with quiet():
        figure = Figure(figsize=(width / 72, height / 72), dpi=72)
        FigureCanvasAgg(figure)
        ax = figure.add_axes((0, 0, 1, 1))
        ax.set_axis_off()
        ax.set(xlim=(0, width), ylim=(0, height))
        top = height - MARGIN
        for row, each in zip(rows, placed, strict=True):
            _row(ax, row, each, np.array([MARGIN, top]))
            top -= each.size[1] + _ROWS
        _axes(ax, np.array([MARGIN + 3.0, MARGIN + 3.0]))
    return figure


def parted(rows: Sequence[Row]) -> Iterator[list[Row]]:
    """Rows page by page, as many on each as it takes; a higher one has a page of its own."""
    page: list[Row] = []
    left = _PAGE - _CORNER
    for row in rows:
        high = float(laid(row).size[1]) + _ROWS
        if page and high > left:
            yield page
            page, left = [], _PAGE - _CORNER
        page.append(row)
        left -= high
    yield page


def _row(ax: Axes, row: Row, placed: Laid, corner: Array) -> None:
    for i, line in enumerate(row.heading):
        at = corner - (0.0, i * LINE)
        ax.text(*at, line, ha="left", va="top", fontsize=TITLE, fontweight="bold", color=INK)
    for sign in placed.signs:
        ax.text(*(corner + sign), "= 0" if row.vanishes else "=", ha="center", va="center", fontsize=16, color=INK)
    for panel, shift in placed.panels:
        _panel(ax, panel, corner + shift)
    foot = corner - (0.0, placed.size[1] - row.foot + 4.0)
    if row.per_newton is not None:
        _scale(ax, row.per_newton, row.unit, foot - (0.0, 8.0))
        foot = foot - (0.0, LINE)
    for line in row.lines:
        ax.text(*foot, line, ha="left", va="top", fontsize=NOTE, color=GREY)
        foot = foot - (0.0, LINE)


def _panel(ax: Axes, panel: Panel, shift: Array) -> None:
    scenery = panel.scenery
    for stroke in scenery.strokes:
        ax.add_patch(patch(stroke, shift))
    for line in scenery.inner:
        ax.plot(*(line + shift).T, color=INK, lw=1.1, zorder=2.4)
    for dimension in scenery.dimensions:
        for guide in dimension.guides:
            ax.plot(*(guide + shift).T, color=MEASURE, lw=0.7, ls=(0, (4, 3)) if dimension.angle else "-", zorder=3)
        _arrow(ax, dimension.arrow + shift, MEASURE, 0.9, dimension.head)
    for pin in scenery.pins:
        ax.plot(*(pin + shift), "o", ms=2 * _PIN, mfc=PAPER, mec=INK, mew=1.0, zorder=4)
    for tag in scenery.points:
        if not any(np.hypot(*(pin - tag.at)) < 1.0 for pin in scenery.pins):
            ax.plot(*(tag.at + shift), "o", ms=2.6, color=INK, zorder=4)
    for mark in panel.marks:
        _arrow(ax, mark.line + shift, tone(mark.action), 1.3 if isinstance(mark, CoupleArrow) else 1.6, HEAD)
    write(ax, panel.labels, lambda at: at + shift)


def _axes(ax: Axes, corner: Array) -> None:
    """The directions of x and y, once a sheet."""
    for way, text in ((np.array([1.0, 0.0]), "$x$"), (np.array([0.0, 1.0]), "$y$")):
        _arrow(ax, np.array([corner, corner + _AXES * way]), GREY, 1.0, 7.0)
        at = corner + (_AXES + 7.0) * way
        ax.text(*at, text, fontsize=9.0, color=GREY, ha="center", va="center", zorder=6, label="label")


def _arrow(ax: Axes, line: Array, colour: str, width: float, head: float) -> None:
    """A line with a head that ends where the line does."""
    look: dict[str, Any] = {"arrowstyle": f"-|>,head_width={HEAD_WIDTH},head_length={HEAD_LENGTH}", "mutation_scale": head}
    look |= {"color": colour, "lw": width, "shrinkA": 0, "shrinkB": 0, "joinstyle": "miter", "capstyle": "butt"}
    if len(line) > 2:
        ax.plot(*line[:-1].T, color=colour, lw=width, zorder=5, solid_capstyle="butt")
    ax.annotate("", line[-1], line[-2], arrowprops=look, zorder=5)


def _scale(ax: Axes, per_newton: float, unit: str, corner: Array) -> None:
    """A bar of a round number of newtons, or of another unit."""
    newtons = round_below(60.0 / per_newton)
    end = corner + (newtons * per_newton, 0.0)
    ax.plot(*np.array([corner, end]).T, color=INK, lw=1.4)
    for x, y in (corner, end):
        ax.plot([x, x], [y - 3, y + 3], color=INK, lw=1.0)
    ax.text(end[0] + 6, end[1], f"{newtons:g} {unit}", ha="left", va="center", fontsize=9.0, color=INK)


def round_below(value: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that is not above a value."""
    power = 10.0 ** np.floor(np.log10(value) + 1e-9)
    return float(power * max(digit for digit in (1, 2, 5) if digit * power <= value * (1 + 1e-9)))
