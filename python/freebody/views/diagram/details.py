"""Where too many forces act at one place: the place drawn large, with its forces side by side."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from freebody.core import Array
from freebody.views import shapes
from freebody.views.diagram.actions import Action
from freebody.views.diagram.arrows import LENGTH, Arrow
from freebody.views.diagram.scenery import Scenery, Tag
from freebody.views.sketch import Drawn

_MANY = 4  # forces at one place that a diagram has room for
_SAME, _TURNED = 1.0, 0.01  # pt, rad: what is less is the same place, the same direction
_BESIDE = 14.0  # pt between arrows side by side
_RADIUS = 10.0  # pt of the place, beside what its arrows need
_RING = 9.0  # pt, about a place that is drawn large elsewhere


@dataclass(frozen=True)
class Detail:
    """A place on paper with the forces that act there, and its name."""

    at: Array
    forces: Sequence[Action]
    name: str

    def scenery(self, of: Scenery) -> Scenery:
        """The place by itself, as large as its arrows need."""
        tint = next(stroke.tint for stroke in of.strokes if stroke.body == self.forces[0].body)
        disk = Drawn("body", shapes.circle(self.at, self._radius), tint, True, self.forces[0].body)
        return replace(of, strokes=[disk], inner=[], pins=np.zeros((0, 2)), points=[Tag(self.name, self.at)], dimensions=[])

    def marks(self) -> list[Arrow]:
        """Its arrows, away from the rim, those of one direction side by side."""
        made = []
        for group in self._sides:
            for i, action in enumerate(group):
                way = action.force / np.hypot(*action.force)
                aside = _BESIDE * (i - (len(group) - 1) / 2)
                tail = self.at + aside * np.array([-way[1], way[0]]) + np.sqrt(self._radius**2 - aside**2) * way
                made.append(Arrow(action, tail, tail, tail + LENGTH * way))
        return made

    @property
    def _radius(self) -> float:
        return _RADIUS + _BESIDE / 2 * max(map(len, self._sides))

    @property
    def _sides(self) -> list[list[Action]]:
        """The forces by their direction."""
        return _grouped(self.forces, lambda action: action.force / np.hypot(*action.force) / _TURNED)


def crowded(forces: Sequence[Action], scenery: Scenery) -> list[Detail]:
    """The places at which more forces act than can be drawn there."""
    places = _grouped([each for each in forces if not each.turns], lambda action: scenery.scale * action.at / _SAME)
    many = [place for place in places if len(place) > _MANY]
    return [Detail(scenery.scale * place[0].at, place, _named(place[0], i, scenery)) for i, place in enumerate(many, 1)]


def _grouped(forces: Sequence[Action], by: Callable[[Action], Array]) -> list[list[Action]]:
    """Forces with the same whole numbers."""
    groups: dict[tuple[float, ...], list[Action]] = {}
    for action in forces:
        groups.setdefault(tuple(np.round(by(action)) + 0.0), []).append(action)
    return list(groups.values())


def _named(action: Action, number: int, scenery: Scenery) -> str:
    """The name of the point there, or a number of the detail."""
    at = scenery.scale * action.at
    return next((tag.text for tag in scenery.points if np.hypot(*(tag.at - at)) < _SAME), rf"\text{{detail {number}}}")


def marked(scenery: Scenery, details: Sequence[Detail]) -> Scenery:
    """The bodies with a ring about every place that is drawn large, and its name."""
    rings = [Drawn("mark", shapes.circle(each.at, _RING), stroke.tint, True, stroke.body)
             for each in details for stroke in scenery.strokes[:1]]  # fmt: skip
    known = {tag.text for tag in scenery.points}
    tags = [Tag(each.name, each.at) for each in details if each.name not in known]
    return replace(scenery, strokes=scenery.strokes + rings, points=scenery.points + tags)
