"""A mechanism drawn once, to no forces, with what each of its coordinates measures."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from freebody.core import CompiledModel, State
from freebody.views.diagram.panel import Panel
from freebody.views.diagram.picture import Picture
from freebody.views.diagram.rows import Row
from freebody.views.diagram.scenery import Scenery, Tag, whole
from freebody.views.dimension_lines import places
from freebody.views.sketch import sketch_of_state

_TURNED = 0.2  # rad, below which an angle can hardly be seen
_MORE = 3.0, 1.9, 2.4
_FURTHER = 12.0, 9.0, 15.0  # sizes of symbols


@dataclass(frozen=True)
class Configuration(Picture):
    """The drawing of a mechanism at a state, with its coordinates; or, ``each_body``, with those of bodies that are placed each by
    itself: x and y of the mass centre, and the angle."""

    source: CompiledModel
    state: State
    each_body: bool = False

    @property
    def name(self) -> str:
        """Its title."""
        return f"configuration of {self.source.name}"

    @cached_property
    def scenery(self) -> Scenery:
        """What is seen, with a dimension for every coordinate."""
        state = opened(self.source, self.state)
        if not self.each_body:
            return whole(self.source, state)
        drawn = whole(self.source, state, places)
        return replace(drawn, points=drawn.points + [Tag("", centre) for centre in drawn.centres.values()])

    @cached_property
    def rows(self) -> list[Row]:
        """One row of one panel."""
        names = [body["name"] for body in self.source.metadata["bodies"]]
        return [Row("", [Panel(self.scenery, [], names)], None, [])]

    @property
    def description(self) -> str:
        """In words, what the drawing shows."""
        if self.each_body:
            return f"{self.source.name}, drawn with x and y of each mass centre from the origin O, and the angle of each body."
        stated = [f"{each['name']}, {each['doc'].replace('`', '')}" for each in self.source.metadata["coordinates"]]
        return f"{self.source.name}, drawn with its coordinates: {'; '.join(stated)}."


def opened(source: CompiledModel, state: State) -> State:
    """A state where one sees what is measured: coordinates that are 0 a little off it, all by different amounts. The same state
    where coordinates depend on each other or something may touch."""
    coupled = any(joint["type"] == "coupling" for joint in source.spec["joints"])
    if coupled or source.metadata["limits"] or any(joint["cut"] for joint in source.metadata["joints"]):
        return state
    size = sketch_of_state(source, state).size
    dimensions = [c["dimension"] for c in source.metadata["coordinates"]]
    least = [{"rad": _TURNED, "m": size}.get(each, -1.0) for each in dimensions]
    away = [_TURNED * _MORE[i % 3] if each == "rad" else size * _FURTHER[i % 3] for i, each in enumerate(dimensions)]
    return replace(state, q=np.where(np.abs(state.q) > least, state.q, away))
