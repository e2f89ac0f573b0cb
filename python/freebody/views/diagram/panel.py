"""One half of a free-body diagram on paper: the bodies, what acts on them, and every letter in its place."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from freebody.results import Array
from freebody.views.diagram.actions import Action
from freebody.views.diagram.arrows import Arrow, Mark, arranged, lines
from freebody.views.diagram.layout import Ink, Label, Placed, placed
from freebody.views.diagram.scenery import Scenery, dense
from freebody.views.style import GROUND as GREY
from freebody.views.style import INK

REACTION, LOAD, EFFECTIVE, MEASURE = "#b3261e", "#0b5fa5", "#1b7f3b", "#7a1fa2"
AXES = 24.0  # pt, length of the arrows that show x and y
_CORNER = AXES + 14.0
_REACTIONS = ("joint", "contact", "string", "stop", "friction")


def tone(action: Action) -> str:
    """Red for what other bodies exert by being there, blue for loads that are given, green for m a and I α."""
    return EFFECTIVE if action.kind == "effective" else REACTION if action.kind in _REACTIONS else LOAD


@dataclass(frozen=True)
class Panel:
    """All that is drawn, in pt; ``axes`` is where x and y are shown, if they are."""

    scenery: Scenery
    marks: list[Mark]
    labels: list[Placed]
    axes: Array | None

    def box(self) -> tuple[Array, Array]:
        """Lower left and upper right corner of everything."""
        seen = [self.scenery.ink(), *lines(self.marks), *_corners(self.labels)]
        seen += [] if self.axes is None else [np.array([self.axes - 3, self.axes + _CORNER])]
        everything = np.vstack(seen)
        return everything.min(axis=0), everything.max(axis=0)


def panel(scenery: Scenery, actions: Sequence[Action], names: Sequence[str], per_newton: float | None, axes: bool) -> Panel:
    """Everything put in place. ``names``: the bodies to be named."""
    marks = arranged(actions, scenery, per_newton)
    strokes, arrows = scenery.ink(), dense(lines(marks), 1.5)
    dots = np.array([tag.at for tag in scenery.points]).reshape(-1, 2)
    ink = Ink.of((strokes, 2.0), (arrows, 15.0), (dots, 8.0), (scenery.pins, 8.0))
    labels = placed([*_letters(marks), *_others(scenery, names)], ink)
    rough = Panel(scenery, marks, labels, None)
    return Panel(scenery, marks, labels, _corner(rough, np.vstack([strokes, arrows])) if axes else None)


def _letters(marks: Sequence[Mark]) -> Iterator[Label]:
    for mark in marks:
        text = f"${mark.action.label}$"
        if isinstance(mark, Arrow):
            anchors = np.array([mark.free, mark.line.mean(axis=0)])
        else:
            anchors = mark.line[[-1, len(mark.line) // 2, 0, -len(mark.line) // 4]]
        yield Label(text, anchors, 10.0, tone(mark.action))


def _others(scenery: Scenery, names: Sequence[str]) -> Iterator[Label]:
    for dimension in scenery.dimensions:
        n = len(dimension.arrow)
        yield Label(f"${dimension.text}$", dimension.arrow[[n // 2, -1]], 9.0, MEASURE)
    for tag in scenery.points:
        yield Label(f"${tag.text}$", tag.at[None], 9.0, INK, led=False)
    for name in names:
        yield Label(name.replace("$", r"\$"), scenery.centres[name][None], 9.0, GREY, bold=True)


def _corners(labels: Sequence[Placed]) -> list[Array]:
    return [np.array([label.centre - label.half, label.centre + label.half]) for label in labels]


def _corner(rough: Panel, ink: Array) -> Array:
    """Where the axes are in nobody's way: the free place nearest to the lower left corner, or outside of it."""
    low, high = rough.box()
    boxes = _corners(rough.labels)
    spots = [
        np.array([x, y]) for x in np.arange(low[0], high[0] - _CORNER, 6.0) for y in np.arange(low[1], high[1] - _CORNER, 6.0)
    ]
    for at in sorted(spots, key=lambda spot: float(np.abs(spot - low).sum())):
        start, end = at - 4, at + _CORNER
        written = any((lower < end).all() and (upper > start).all() for lower, upper in boxes)
        covered = ((ink > start) & (ink < end)).all(axis=1).any() or rough.scenery.within(
            np.array([start, end, (start + end) / 2])
        )
        if not written and not covered:
            return at
    return np.array([low[0], low[1] - _CORNER])
