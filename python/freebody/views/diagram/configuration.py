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
_MORE = np.array([3.0, 1.9, 2.4])
_FURTHER = np.array([12.0, 9.0, 15.0])  # sizes of symbols


@dataclass(frozen=True)
class Configuration(Picture):
    """The drawing of a mechanism at a state."""

    source: CompiledModel
    state: State

    @property
    def name(self) -> str:
        """Its title."""
        return f"configuration of {self.source.name}"

    @cached_property
    def scenery(self) -> Scenery:
        """What is seen, with a dimension for every coordinate."""
        return whole(self.source, _opened(self.source, self.state))

    @cached_property
    def rows(self) -> list[Row]:
        """One row of one panel."""
        names = [body["name"] for body in self.source.metadata["bodies"]]
        return [Row("", [Panel(self.scenery, [], names, oriented=True)], None, [])]

    @property
    def description(self) -> str:
        """In words, what the drawing shows."""
        stated = [f"{each['name']}, {each['doc'].replace('`', '')}" for each in self.source.metadata["coordinates"]]
        return f"{self.source.name}, drawn with its coordinates: {'; '.join(stated)}."


@dataclass(frozen=True)
class Places(Configuration):
    """The same with the coordinates of bodies that are placed each by itself: x and y of the mass centre, and the angle."""

    @cached_property
    def scenery(self) -> Scenery:
        """What is seen, with a dimension for every coordinate."""
        drawn = whole(self.source, _opened(self.source, self.state), places)
        return replace(drawn, points=drawn.points + [Tag("", centre) for centre in drawn.centres.values()])

    @property
    def description(self) -> str:
        """In words, what the drawing shows."""
        return f"{self.source.name}, drawn with x and y of each mass centre from the origin O, and the angle of each body."


def _opened(source: CompiledModel, state: State) -> State:
    """A state where one sees what is measured: coordinates that are 0 a little off it, all by different amounts. The same state
    where coordinates depend on each other or something may touch."""
    coupled = any(joint["type"] == "coupling" for joint in source.spec["joints"])
    if coupled or source.metadata["limits"] or any(joint["cut"] for joint in source.metadata["joints"]):
        return state
    size = sketch_of_state(source, state).size
    least = {"rad": _TURNED, "m": size}
    away = {"rad": _TURNED * _MORE, "m": size * _FURTHER}
    q = [
        float(x) if abs(x) > least.get(c["dimension"], -1.0) else float(away[c["dimension"]][i % 3])
        for i, (c, x) in enumerate(zip(source.metadata["coordinates"], state.q, strict=True))
    ]
    return replace(state, q=np.array(q))
