"""One half of a free-body diagram on paper: the bodies, what acts on them, and every symbol in its place."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from freebody.core import Array
from freebody.views import shapes
from freebody.views.diagram.actions import Action
from freebody.views.diagram.arrows import Arrow, Mark, head
from freebody.views.diagram.couples import CoupleArrow
from freebody.views.diagram.scenery import Scenery
from freebody.views.labels import Label, Obstacles, Placed, mathtext, placed
from freebody.views.style import GROUND as GREY
from freebody.views.style import INK

REACTION, LOAD, EFFECTIVE, MEASURE = "#b3261e", "#0b5fa5", "#1b7f3b", "#7a1fa2"
_REACTIONS = ("joint", "contact", "string", "stop", "friction")


def tone(action: Action) -> str:
    """Red for what other bodies exert by being there, blue for loads that are given, green for m a and I α."""
    return EFFECTIVE if action.kind == "effective" else REACTION if action.kind in _REACTIONS else LOAD


@dataclass(frozen=True)
class Panel:
    """All that is drawn, in pt. ``names``: the bodies that are named."""

    scenery: Scenery
    marks: list[Mark]
    names: Sequence[str]

    @cached_property
    def labels(self) -> list[Placed]:
        """Every symbol in its place."""
        dots = np.array([tag.at for tag in self.scenery.points]).reshape(-1, 2)
        held = [each.centre + 0.5 * (each.line - each.centre) for each in self.marks if isinstance(each, CoupleArrow)]
        obstacles = Obstacles.of(
            (shapes.dense(held), 9.0), (self.scenery.obstacles, 12.0), (self._arrows, 40.0), (dots, 8.0), (self.scenery.pins, 8.0)
        )
        return placed(list(self._wanted()), obstacles)

    def box(self) -> tuple[Array, Array]:
        """Lower left and upper right corner of everything."""
        written = [np.array([label.centre - label.half, label.centre + label.half]) for label in self.labels]
        everything = np.vstack([self.scenery.obstacles, *(mark.line for mark in self.marks), *written])
        return everything.min(axis=0), everything.max(axis=0)

    @cached_property
    def _arrows(self) -> Array:
        marks, dimensions = [mark.line for mark in self.marks], self.scenery.dimensions
        heads = [*map(head, marks), *(head(each.arrow, each.head) for each in dimensions)]
        return shapes.dense([*marks, *(each.arrow for each in dimensions), *heads], 1.5)

    def _wanted(self) -> Iterator[Label]:
        for mark in self.marks:
            around = mark.line[[-1, len(mark.line) // 2, 0, -len(mark.line) // 4]]
            anchors = np.array([mark.free, mark.line.mean(axis=0)]) if isinstance(mark, Arrow) else around
            yield Label(f"${mathtext(mark.action.label)}$", anchors, 10.0, tone(mark.action))
        for dimension in self.scenery.dimensions:
            arrow = dimension.arrow
            anchors = arrow[[len(arrow) // 2, -1]] if len(arrow) > 2 else np.array([arrow[1], arrow.mean(axis=0)])
            yield Label(f"${mathtext(dimension.text)}$", anchors, 9.0, MEASURE)
            if dimension.axis is not None:
                yield Label(f"${mathtext(dimension.axis.text)}$", dimension.axis.at[None], 8.0, MEASURE)
        for tag in filter(lambda tag: tag.text, self.scenery.points):
            yield Label(f"${mathtext(tag.text)}$", tag.at[None], 9.0, INK)
        for name in self.names:
            yield Label(name.replace("$", r"\$"), self.scenery.centres[name][None], 9.0, GREY, bold=True)
