"""Where the arrows of forces go on paper: at their points, each where it covers least."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from freebody.core import Array
from freebody.views import shapes
from freebody.views.diagram.actions import Action
from freebody.views.diagram.couples import CoupleArrow, couple_arrow
from freebody.views.diagram.scenery import Scenery
from freebody.views.shapes import dense

LENGTH = 36.0  # pt of a symbolic arrow
LONGEST = 72.0  # pt of the largest force to scale
HEAD = 9.0  # pt, what an arrow head is scaled by
HEAD_LENGTH, HEAD_WIDTH = 0.62, 0.28  # of that: a head, and half its width
SHORTEST = 14.0 + HEAD_LENGTH * HEAD  # pt, with a shaft of 14
_LONGER = (1.0, 1.5, 2.0)
_ASIDES = (0.0, 6.0, -6.0, 11.0, -11.0)  # pt that one may be moved which else would be hidden
_MOVED = 5.0  # what a pt of that costs; of a slider, whose couple makes up for it, less
_OFF_ITS_POINT = 120.0  # what it costs to move one that has a point of its own at all
_HIDDEN = 700.0  # what it costs that two arrows lie on each other, all along the shorter one
_SIDE_BY_SIDE = 3.0  # pt between two parallel arrows that can be told apart
_MEETING = 0.5  # pt that two arrows on one line may share where they meet
_PASSING = 0.3  # what it costs of that to lie on each other at all: more than to be moved
_PARALLEL = 0.05  # rad, between arrows that could be taken for one
_SWEEPS = 3
_HEAD_ROOM = 13.0  # pt between two heads
_OWN = 6.0  # pt about its own point, where an arrow may meet others


@dataclass(frozen=True)
class Arrow:
    """A force on paper, in pt: from ``tail`` to ``head``, one of which is the place ``at`` where it is shown to act."""

    action: Action
    at: Array
    tail: Array
    head: Array

    @property
    def line(self) -> Array:
        """Its shaft (2, 2)."""
        return np.array([self.tail, self.head])

    @property
    def length(self) -> float:
        """In pt."""
        return float(np.hypot(*(self.head - self.tail)))

    @property
    def free(self) -> Array:
        """The end at which it has room for a symbol."""
        return self.head if np.array_equal(self.tail, self.at) else self.tail


Mark = Arrow | CoupleArrow


def head(line: Array, size: float = HEAD) -> Array:
    """The outline (4, 2) of the head at the end of a line, for heads scaled by a size in pt."""
    tip, way = line[-1], (line[-1] - line[-2]) / np.hypot(*(line[-1] - line[-2]))
    back, aside = tip - HEAD_LENGTH * size * way, HEAD_WIDTH * size * np.array([-way[1], way[0]])
    return np.array([tip, back + aside, back - aside, tip])


def arranged(actions: Sequence[Action], scenery: Scenery, per_newton: float | None = None) -> list[Mark]:
    """Arrows for all actions. ``per_newton``: pt for each N, to scale; None for arrows of one length."""
    order = sorted((a for a in actions if not a.turns), key=lambda a: 2 * (a.kind != "weight") + scenery.slides(a))
    offered = [_choices(action, scenery, per_newton) for action in order]
    own = [[_alone(choice, scenery) for choice in choices] for choices in offered]
    chosen: list[Arrow | None] = [None] * len(order)
    for _ in range(_SWEEPS):
        before = list(chosen)
        for i, choices in enumerate(offered):
            others = _Drawn.of([arrow for j, arrow in enumerate(chosen) if arrow is not None and j != i])
            costs = [alone + _among(choice, others) for choice, alone in zip(choices, own[i], strict=True)]
            chosen[i] = choices[int(np.argmin(costs))]
        if all(new is old for new, old in zip(chosen, before, strict=True)):
            break
    marks: list[Mark] = [arrow for arrow in chosen if arrow is not None]
    for action in (each for each in actions if each.turns):
        marks.append(couple_arrow(action, scenery, [mark.line for mark in marks]))
    return marks


def _choices(action: Action, scenery: Scenery, per_newton: float | None) -> list[Arrow]:
    """The ways in which a force may be drawn."""
    at, size = scenery.scale * action.at, float(np.hypot(*action.force))
    way = action.force / size
    lengths = [LENGTH * more for more in _LONGER] if per_newton is None else [max(per_newton * size, SHORTEST)]
    starts = [at + aside * np.array([-way[1], way[0]]) for aside in _ASIDES]
    choices: list[Arrow] = []
    if not action.presses:
        choices += [Arrow(action, start, start, start + length * way) for start in starts for length in lengths]
    if action.kind not in ("weight", "effective") and not action.pulls:
        choices += [Arrow(action, start, start - length * way, start) for start in starts for length in lengths]
    return choices


def shared(one: Arrow, other: Arrow) -> float:
    """How far, in pt, two arrows lie on each other."""
    way = (one.head - one.tail) / one.length
    along, aside = np.array([way, (-way[1], way[0])]) @ (other.line - one.tail).T
    if abs(aside[1] - aside[0]) > _PARALLEL * other.length or np.abs(aside).max() > _SIDE_BY_SIDE:
        return 0.0
    return max(0.0, min(one.length, along.max()) - max(0.0, along.min()))


def _alone(arrow: Arrow, scenery: Scenery) -> float:
    """What an arrow hides of the bodies, and how far it is from where one expects it."""
    shaft = dense([arrow.line])
    inside = sum(int(shapes.inside(solid, shaft).sum()) for solid in scenery.solids)
    drawn = _near(_beyond(arrow, shaft), scenery.obstacles, 2.5)
    reverse = 3.0 * np.array_equal(arrow.head, arrow.at)
    action, moved = arrow.action, float(np.hypot(*(arrow.at - scenery.scale * arrow.action.at)))
    pinned = not (action.pulls or action.kind == "force")
    aside = moved if scenery.slides(action) else _MOVED * moved + _OFF_ITS_POINT * (pinned and moved > 0)
    return 1.5 * inside + 1.0 * drawn + 0.6 * arrow.length + reverse + aside


@dataclass(frozen=True)
class _Drawn:
    """Arrows, places along them (k, 2), their heads, and these with the points where they act."""

    arrows: Sequence[Arrow]
    ink: Array
    heads: Array
    places: Array

    @classmethod
    def of(cls, arrows: Sequence[Arrow]) -> _Drawn:
        heads, acting = (np.array(ends).reshape(-1, 2) for ends in ([a.head for a in arrows], [a.at for a in arrows]))
        return cls(arrows, dense([arrow.line for arrow in arrows]), heads, np.vstack([heads, acting]))


def _among(arrow: Arrow, others: _Drawn) -> float:
    """What an arrow hides of others, and they of it."""
    passed = [(shared(arrow, other), min(arrow.length, other.length)) for other in others.arrows]
    hidden = sum(_PASSING + over / shorter for over, shorter in passed if over > _MEETING)
    near = _near(_beyond(arrow, dense([arrow.line])), others.ink, 4.0)
    meeting = np.hypot(*(others.places - arrow.at).T) < 1.0
    crowded = int((np.hypot(*(others.places - arrow.head).T)[~meeting] < _HEAD_ROOM).sum())
    converging = int((np.hypot(*(others.heads - arrow.head).T) < 1.0).sum())
    return _HIDDEN * hidden + 12.0 * near + 40.0 * crowded + 8.0 * converging


def _beyond(arrow: Arrow, shaft: Array) -> Array:
    """What of its shaft is away from where it acts, where arrows may meet."""
    return shaft[np.hypot(*(shaft - arrow.at).T) > _OWN]


def _near(places: Array, obstacles: Array, distance: float) -> int:
    """How many of some places lie near ink."""
    if not len(places) or not len(obstacles):
        return 0
    squares = np.subtract.outer(places[:, 0], obstacles[:, 0]) ** 2 + np.subtract.outer(places[:, 1], obstacles[:, 1]) ** 2
    return int((squares.min(axis=1) < distance**2).sum())
