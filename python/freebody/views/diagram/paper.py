"""Panels put together on a sheet and drawn by matplotlib, one unit of data to the point."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from textwrap import wrap
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.results import Array
from freebody.views.diagram.arrows import Bow
from freebody.views.diagram.layout import extent
from freebody.views.diagram.panel import AXES, MEASURE, Panel, tone
from freebody.views.paint import patch
from freebody.views.style import GROUND as GREY
from freebody.views.style import INK, PAPER, quiet

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLUMN = 454.0  # pt, 160 mm: the text of a page
_MARGIN, _BETWEEN, _ROWS, _HEAD, _LINE = 8.0, 26.0, 22.0, 20.0, 13.0
_PIN = 2.6  # pt
_TITLE, _NOTE = 10.5, 8.0
_LETTERS = 90  # of a remark in a line


@dataclass(frozen=True)
class Row:
    """One diagram: its title, its panels, equal to each other, its scale in pt for each N, and remarks; ``vanishes``: the panel
    stands for nothing, a body without mass. ``unit``: of what is drawn."""

    title: str
    panels: Sequence[Panel]
    per_newton: float | None
    notes: Sequence[str]
    vanishes: bool = False
    unit: str = "N"

    @property
    def lines(self) -> list[str]:
        """The remarks, line by line."""
        return [line.replace("$", r"\$") for note in self.notes for line in wrap(note, _LETTERS)]


@dataclass(frozen=True)
class _Set:
    """A row laid out: the shift of every panel from the row's upper left corner, places of the signs =, and its size."""

    shifts: list[Array]
    signs: list[Array]
    size: Array


def sheet(rows: Sequence[Row]) -> Figure:
    """A figure just as large as it must be."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    laid = [_laid(row) for row in rows]
    width = max(each.size[0] for each in laid) + 2 * _MARGIN
    height = sum(each.size[1] for each in laid) + _ROWS * (len(rows) - 1) + 2 * _MARGIN
    with quiet():
        figure = Figure(figsize=(width / 72, height / 72), dpi=72)
        FigureCanvasAgg(figure)
        ax = figure.add_axes((0, 0, 1, 1))
        ax.set_axis_off()
        ax.set(xlim=(0, width), ylim=(0, height))
        top = height - _MARGIN
        for row, each in zip(rows, laid, strict=True):
            _row(ax, row, each, np.array([_MARGIN, top]))
            top -= each.size[1] + _ROWS
    return figure


def _laid(row: Row) -> _Set:
    """Panels beside each other with the bodies at one height, or below each other where the column is too narrow."""
    boxes = [panel.box() for panel in row.panels]
    widths = [high[0] - low[0] for low, high in boxes]
    beside = sum(widths) + _BETWEEN * (len(boxes) - 1) <= COLUMN
    shifts, signs, x, y = [], [], 0.0, -_HEAD
    top, bottom = max(high[1] for _, high in boxes), min(low[1] for low, _ in boxes)
    for i, (low, high) in enumerate(boxes):
        if i and beside:
            signs.append(np.array([x + _BETWEEN / 2, y - top + _middle(row.panels[0])]))
            x += _BETWEEN
        elif i:
            signs.append(np.array([_BETWEEN / 2, y - (high[1] - low[1]) / 2]))
        indent = _BETWEEN if i and not beside else 0.0
        shifts.append(np.array([x + indent - low[0], y - (top if beside else high[1])]))
        if beside:
            x += widths[i]
        else:
            y -= high[1] - low[1] + _LINE
    if row.vanishes:
        signs.append(np.array([x + _BETWEEN, y - top + _middle(row.panels[0])]))
        x += 2 * _BETWEEN
    depth = -y + (top - bottom if beside else -_LINE)
    width = x if beside else max(w + (_BETWEEN if i else 0.0) for i, w in enumerate(widths))
    written = [extent(row.title, _TITLE, True)[0], *(extent(note, _NOTE)[0] for note in row.lines)]
    return _Set(shifts, signs, np.array([max(width, *written), depth + _foot(row)]))


def _middle(panel: Panel) -> float:
    """Height of the middle of what is drawn of the bodies."""
    heights = np.concatenate([stroke.points[:, 1] for stroke in panel.scenery.strokes] or [np.zeros(1)])
    return float((heights.min() + heights.max()) / 2)


def _foot(row: Row) -> float:
    return _LINE * (len(row.lines) + (row.per_newton is not None)) + (4.0 if row.lines or row.per_newton else 0.0)


def _row(ax: Axes, row: Row, laid: _Set, corner: Array) -> None:
    ax.text(*corner, row.title.replace("$", r"\$"), ha="left", va="top", fontsize=_TITLE, fontweight="bold", color=INK)
    for sign in laid.signs:
        ax.text(*(corner + sign), "= 0" if row.vanishes else "=", ha="center", va="center", fontsize=16, color=INK)
    for panel, shift in zip(row.panels, laid.shifts, strict=True):
        _panel(ax, panel, corner + shift)
    foot = corner - (0.0, laid.size[1] - _foot(row) + 4.0)
    if row.per_newton is not None:
        _scale(ax, row.per_newton, row.unit, foot - (0.0, 8.0))
        foot = foot - (0.0, _LINE)
    for note in row.lines:
        ax.text(*foot, note, ha="left", va="top", fontsize=_NOTE, color=GREY)
        foot = foot - (0.0, _LINE)


def _panel(ax: Axes, panel: Panel, shift: Array) -> None:
    scenery = panel.scenery
    for stroke in scenery.strokes:
        ax.add_patch(patch(stroke.style, stroke.points + shift, stroke.tint, stroke.closed))
    for line in scenery.inner:
        ax.plot(*(line + shift).T, color=INK, lw=1.1, zorder=2.4)
    for dimension in scenery.dimensions:
        for guide in dimension.guides:
            ax.plot(*(guide + shift).T, color=MEASURE, lw=0.7, ls=(0, (4, 3)) if dimension.angle else "-", zorder=3)
        _arrow(ax, dimension.arrow + shift, MEASURE, 0.9, float(np.clip(0.8 * _length(dimension.arrow), 4.0, 7.0)))
    for pin in scenery.pins:
        ax.plot(*(pin + shift), "o", ms=2 * _PIN, mfc=PAPER, mec=INK, mew=1.0, zorder=4)
    for tag in scenery.points:
        if not any(np.hypot(*(pin - tag.at)) < 1.0 for pin in scenery.pins):
            ax.plot(*(tag.at + shift), "o", ms=2.6, color=INK, zorder=4)
    for mark in panel.marks:
        _arrow(ax, mark.line + shift, tone(mark.action), 1.3 if isinstance(mark, Bow) else 1.6, 9.0)
    for label in panel.labels:
        if label.leader is not None:
            ax.plot(*(label.leader + shift).T, color=label.label.colour, lw=0.5, zorder=4.5)
        _write(ax, label.label.text, label.centre + shift, label.label.size, label.label.colour, label.label.bold)
    if panel.axes is not None:
        _axes(ax, panel.axes + shift)


def _write(ax: Axes, text: str, at: Array, size: float, colour: str, bold: bool = False) -> None:
    weight = "bold" if bold else "normal"
    ax.text(*at, text, fontsize=size, color=colour, fontweight=weight, ha="center", va="center", zorder=6, label="label")


def _arrow(ax: Axes, line: Array, colour: str, width: float, head: float) -> None:
    """A line with a head that ends where the line does."""
    look: dict[str, Any] = {"arrowstyle": "-|>,head_width=0.28,head_length=0.62", "mutation_scale": head}
    look |= {"color": colour, "lw": width, "shrinkA": 0, "shrinkB": 0, "joinstyle": "miter", "capstyle": "butt"}
    if len(line) > 2:
        ax.plot(*line[:-1].T, color=colour, lw=width, zorder=5, solid_capstyle="butt")
    ax.annotate("", line[-1], line[-2], arrowprops=look, zorder=5)


def _length(line: Array) -> float:
    return float(np.hypot(*np.diff(line, axis=0).T).sum())


def _axes(ax: Axes, corner: Array) -> None:
    for way, text in ((np.array([1.0, 0.0]), "$x$"), (np.array([0.0, 1.0]), "$y$")):
        _arrow(ax, np.array([corner, corner + AXES * way]), GREY, 1.0, 7.0)
        _write(ax, text, corner + (AXES + 7.0) * way, 9.0, GREY)


def _scale(ax: Axes, per_newton: float, unit: str, corner: Array) -> None:
    """A bar of a round number of newtons, or of another unit."""
    newtons = round_below(60.0 / per_newton)
    end = corner + (newtons * per_newton, 0.0)
    ax.plot(*np.array([corner, end]).T, color=INK, lw=1.4)
    for x, y in (corner, end):
        ax.plot([x, x], [y - 3, y + 3], color=INK, lw=1.0)
    ax.text(end[0] + 6, end[1], f"{newtons:.4g} {unit}", ha="left", va="center", fontsize=9.0, color=INK)


def round_below(value: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that is not above a value."""
    power = 10.0 ** np.floor(np.log10(value) + 1e-9)
    return float(power * max(digit for digit in (1, 2, 5) if digit * power <= value * (1 + 1e-9)))
