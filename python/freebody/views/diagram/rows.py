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
    letters stand for; ``vanishes``: the panel stands for nothing, a body without mass; ``unit``: of what is drawn; ``apart``: what is
    drawn below, places with many forces, and coordinates where they would hide the forces; ``column``: the width of the sheet."""

    title: str
    panels: Sequence[Panel]
    per_newton: float | None
    notes: Sequence[str]
    vanishes: bool = False
    unit: str = "N"
    laws: Sequence[str] = ()
    apart: Sequence[Panel] = ()
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
    boxes = [panel.box() for panel in row.panels]
    sizes = [high - low for low, high in boxes]
    beside = sum(size[0] for size in sizes) + BETWEEN * (len(sizes) - 1 + 2 * row.vanishes) <= row.column - 2 * MARGIN
    shifts, signs, width, y = [], [], 0.0, -row.head
    if beside:
        heights = np.concatenate([stroke.points[:, 1] for stroke in row.panels[0].scenery.strokes] or [np.zeros(1)])
        top, bottom = max(high[1] for _, high in boxes), min(low[1] for low, _ in boxes)
        level = y - top + float((heights.min() + heights.max()) / 2)  # of the middle of the bodies
        for (low, _), size in zip(boxes, sizes, strict=True):
            if shifts:
                signs.append(np.array([width + BETWEEN / 2, level]))
                width += BETWEEN
            shifts.append(np.array([width - low[0], y - top]))
            width += size[0]
        if row.vanishes:
            signs.append(np.array([width + BETWEEN, level]))
            width += 2 * BETWEEN
        y -= top - bottom
    else:
        for (low, high), size in zip(boxes, sizes, strict=True):
            indent = BETWEEN * bool(shifts)
            if shifts:
                y -= LINE
                signs.append(np.array([BETWEEN / 2, y - size[1] / 2]))
            shifts.append(np.array([indent - low[0], y - high[1]]))
            width, y = max(width, indent + size[0]), y - size[1]
        if row.vanishes:
            signs.append(np.array([BETWEEN, y - 1.5 * LINE]))
            y -= 2 * LINE
    panels = list(zip(row.panels, shifts, strict=True))
    for panel in row.apart:
        low, high = panel.box()
        y -= LINE
        panels.append((panel, np.array([-low[0], y - high[1]])))
        width, y = max(width, high[0] - low[0]), y - (high[1] - low[1])
    written = [*(extent(line, TITLE, True)[0] for line in row.heading), *(extent(line, NOTE)[0] for line in row.lines)]
    return Laid(panels, signs, np.array([max([width, *written]), row.foot - y]))


def _lines(text: str, column: float, letter: float) -> list[str]:
    """A remark in lines of a column, with no mathtext in it."""
    return [line.replace("$", r"\$") for line in wrap(text, int((column - 2 * MARGIN) / letter))]
