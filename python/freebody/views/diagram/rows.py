"""One diagram of a sheet: its panels beside or below each other, as the column allows, and what is written below. In pt."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from textwrap import wrap

import numpy as np

from freebody.core import Array
from freebody.views.diagram.panel import Panel
from freebody.views.labels import extent

COLUMN = 453.0  # pt, 160 mm: the text of a page
MARGIN, HEAD, LINE = 8.0, 20.0, 13.0
BETWEEN = 26.0  # for a sign = between panels
TITLE, NOTE = 10.5, 8.0
_LETTER = 4.4  # pt, of a remark
_CAPITAL = 7.0  # pt, of a title


@dataclass(frozen=True)
class Row:
    """One diagram: its title, its panels, equal to each other, its scale in pt for each N, and remarks; ``laws``: in mathtext, what
    letters stand for; ``vanishes``: the panel stands for nothing, a body without mass; ``unit``: of what is drawn; ``apart``: the
    coordinates, where they would hide the forces; ``column``: the width of the sheet."""

    title: str
    panels: Sequence[Panel]
    per_newton: float | None
    notes: Sequence[str]
    vanishes: bool = False
    unit: str = "N"
    laws: Sequence[str] = ()
    apart: Panel | None = None
    column: float = COLUMN

    @cached_property
    def heading(self) -> list[str]:
        """The title, line by line."""
        return _lines(self.title, self.column, _CAPITAL)

    @cached_property
    def lines(self) -> list[str]:
        """What is written below, line by line."""
        return [*self.laws, *(line for note in self.notes for line in _lines(note, self.column, _LETTER))]

    @property
    def head(self) -> float:
        """Height of the title."""
        return HEAD + LINE * max(0, len(self.heading) - 1)

    @property
    def foot(self) -> float:
        """Height of what is below the panels."""
        stated = len(self.lines) + (self.per_newton is not None)
        return LINE * stated + (4.0 if stated else 0.0)


@dataclass(frozen=True)
class Laid:
    """A row laid out: its panels with their shifts from the row's upper left corner, places of the signs =, and its size."""

    panels: list[tuple[Panel, Array]]
    signs: list[Array]
    size: Array


def fits(row: Row) -> bool:
    """Whether every panel is as narrow as the column."""
    return laid(row).size[0] <= row.column - 2 * MARGIN


def laid(row: Row) -> Laid:
    """Panels beside each other with the bodies at one height, or below each other where the column is too narrow."""
    widths = [high[0] - low[0] for low, high in (panel.box() for panel in row.panels)]
    signs = len(widths) - 1 + 2 * row.vanishes
    made = (_beside if sum(widths) + BETWEEN * signs <= row.column - 2 * MARGIN else _below)(row)
    if row.apart is not None:  # one more panel below all
        low, high = row.apart.box()
        y = -made.size[1] - LINE
        size = np.array([max(made.size[0], high[0] - low[0]), high[1] - low[1] - y])
        made = Laid([*made.panels, (row.apart, np.array([-low[0], y - high[1]]))], made.signs, size)
    written = [*(extent(line, TITLE, True)[0] for line in row.heading), *(extent(line, NOTE)[0] for line in row.lines)]
    return Laid(made.panels, made.signs, np.array([max([made.size[0], *written]), made.size[1] + row.foot]))


def _beside(row: Row) -> Laid:
    boxes = [panel.box() for panel in row.panels]
    top, bottom = max(high[1] for _, high in boxes), min(low[1] for low, _ in boxes)
    shifts, signs, x, y = [], [], 0.0, -row.head - top
    heights = np.concatenate([stroke.points[:, 1] for stroke in row.panels[0].scenery.strokes] or [np.zeros(1)])
    level = y + float((heights.min() + heights.max()) / 2)  # of the middle of the bodies
    for i, (low, high) in enumerate(boxes):
        if i:
            signs.append(np.array([x + BETWEEN / 2, level]))
            x += BETWEEN
        shifts.append(np.array([x - low[0], y]))
        x += high[0] - low[0]
    if row.vanishes:
        signs.append(np.array([x + BETWEEN, level]))
        x += 2 * BETWEEN
    return Laid(list(zip(row.panels, shifts, strict=True)), signs, np.array([x, row.head + top - bottom]))


def _below(row: Row) -> Laid:
    shifts, signs, width, y = [], [], 0.0, -row.head
    for i, (low, high) in enumerate(panel.box() for panel in row.panels):
        indent = BETWEEN * bool(i)
        if i:
            y -= LINE
            signs.append(np.array([BETWEEN / 2, y - (high[1] - low[1]) / 2]))
        shifts.append(np.array([indent - low[0], y - high[1]]))
        width, y = max(width, indent + high[0] - low[0]), y - (high[1] - low[1])
    if row.vanishes:
        y -= LINE
        signs.append(np.array([BETWEEN, y - LINE / 2]))
        y -= LINE
    return Laid(list(zip(row.panels, shifts, strict=True)), signs, np.array([width, -y]))


def _lines(text: str, column: float, letter: float) -> list[str]:
    """A remark in lines of a column, with no mathtext in it."""
    return [line.replace("$", r"\$") for line in wrap(text, int((column - 2 * MARGIN) / letter))]
