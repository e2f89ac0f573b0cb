"""Where arrows go on paper: forces at their points, couples as open circles, each where it covers least."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from freebody.results import Array
from freebody.views import shapes
from freebody.views.diagram.actions import Action
from freebody.views.diagram.scenery import Scenery
from freebody.views.shapes import dense

LENGTH = 36.0  # pt of a symbolic arrow
LONGEST = 72.0  # pt of the largest force to scale
SHORTEST = 9.0  # pt below which an arrow is all head
_LONGER = (1.0, 1.5, 2.0)
_ASIDES = (0.0, 6.0, -6.0)  # pt that one may be moved which else would be hidden: of a slider its couple makes up for it
_MOVED = 5.0  # how much worse it is to move any other
_HEAD_ROOM = 13.0  # pt between two heads
_RADII = (11.0, 15.0, 19.0, 23.0)
_OWN = 6.0  # pt about its own point, where an arrow may meet others
_TOWARDS = (0.0, 8.0, 16.0, 24.0)  # pt from its joint to the middle of its body at which the couple of a motor may stand
_OPEN = np.deg2rad(80.0)
_GAPS = np.linspace(0, 2 * np.pi, 8, endpoint=False)


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
    def free(self) -> Array:
        """The end at which it has room for a letter."""
        return self.head if np.array_equal(self.tail, self.at) else self.tail


@dataclass(frozen=True)
class Bow:
    """A couple on paper, in pt: an open circle with a head at the end of its ``line`` (k, 2)."""

    action: Action
    centre: Array
    line: Array


Mark = Arrow | Bow


def arranged(actions: Sequence[Action], scenery: Scenery, per_newton: float | None = None) -> list[Mark]:
    """Arrows for all actions. ``per_newton``: pt for each N, to scale; None for arrows of one length."""
    marks: list[Mark] = []
    order = sorted((a for a in actions if not a.turns), key=lambda a: 2 * (a.kind != "weight") + scenery.slides(a))
    for action in order:
        marks.append(_arrow(action, scenery, marks, per_newton))
    for action in actions:
        if action.turns:
            marks.append(_bow(action, scenery, marks))
    return marks


def _arrow(action: Action, scenery: Scenery, marks: Sequence[Mark], per_newton: float | None) -> Arrow:
    at, size = scenery.place(action.at), float(np.hypot(*action.force))
    way = action.force / size
    lengths = [LENGTH * more for more in _LONGER] if per_newton is None else [max(per_newton * size, SHORTEST)]
    slides = scenery.slides(action)
    movable = per_newton is None and (slides or action.pulls or action.kind == "force")
    asides = _ASIDES if movable else (0.0,)
    starts = [at + aside * np.array([-way[1], way[0]]) for aside in asides]
    choices = [Arrow(action, start, start, start + length * way) for start in starts for length in lengths]
    if action.kind not in ("weight", "effective") and not action.pulls:
        choices += [Arrow(action, start, start - length * way, start) for start in starts for length in lengths]
    ink = scenery.ink
    moved = 1.0 if slides else _MOVED
    costs = [_cost(choice, scenery, ink, marks) + moved * float(np.hypot(*(choice.at - at))) for choice in choices]
    return choices[int(np.argmin(costs))]


def _cost(arrow: Arrow, scenery: Scenery, ink: Array, marks: Sequence[Mark]) -> float:
    """What an arrow hides and what hides it."""
    shaft = dense([arrow.line])
    inside = sum(int(_within(shaft, solid).sum()) for solid in scenery.solids)
    other = dense([mark.line for mark in marks])
    beyond = shaft[np.hypot(*(shaft - arrow.at).T) > _OWN]
    near = _near(beyond, other, 4.0)
    heads = [mark.line[-1] for mark in marks] + [mark.at for mark in marks if isinstance(mark, Arrow)]
    crowded = sum(float(np.hypot(*(arrow.head - head)) < _HEAD_ROOM) for head in heads if not np.allclose(head, arrow.at))
    converging = sum(float(np.hypot(*(mark.line[-1] - arrow.head)) < 1.0) for mark in marks)
    drawn = _near(beyond, ink, 2.5)
    reverse = 3.0 * np.array_equal(arrow.head, arrow.at)
    return (
        1.5 * inside
        + 12.0 * near
        + 40.0 * crowded
        + 8.0 * converging
        + 1.0 * drawn
        + 0.6 * float(np.hypot(*(arrow.head - arrow.tail)))
        + reverse
    )


def _near(places: Array, ink: Array, distance: float) -> int:
    """How many of some places lie near ink."""
    if not len(places) or not len(ink):
        return 0
    squares = np.subtract.outer(places[:, 0], ink[:, 0]) ** 2 + np.subtract.outer(places[:, 1], ink[:, 1]) ** 2
    return int((squares.min(axis=1) < distance**2).sum())


def _within(places: Array, outline: Array) -> Array:
    from matplotlib.path import Path

    inside: Array = Path(outline).contains_points(places)
    return inside


def _bow(action: Action, scenery: Scenery, marks: Sequence[Mark]) -> Bow:
    """A couple may stand anywhere on its body: that of a joint at it, that of its motor near it; else its own point comes first,
    then the mass centre."""
    own, centre = scenery.place(action.at), scenery.centres[action.body]
    parts = [min(0.5, step / (float(np.hypot(*(centre - own))) or 1.0)) for step in _TOWARDS]
    parts = [0.0] if action.kind in ("joint", "friction") else parts if action.bound else [0.0, 1.0, 0.5, 0.75, 1.4]
    places = [own + part * (centre - own) for part in parts]
    turn, ink, others = np.sign(action.couple), scenery.ink, dense([mark.line for mark in marks])
    best: tuple[float, Bow] | None = None
    for rank, place in enumerate(places):
        for radius in _RADII:
            if best is not None and 5.0 * rank + 0.6 * radius >= best[0]:
                break
            for gap in _GAPS:
                start = gap + turn * _OPEN / 2
                line = shapes.arc(place, radius, start, start + turn * (2 * np.pi - _OPEN))
                covered = (
                    5.0 * _near(line[::2], others, 3.5) + 1.0 * _near(line[::2], ink, 2.5) + 12.0 * _near(line[-2:], others, 7.0)
                )
                cost = covered + 5.0 * rank + 0.6 * radius
                if best is None or cost < best[0]:
                    best = cost, Bow(action, place, line)
    assert best is not None
    return best[1]


def lines(marks: Iterable[Mark]) -> list[Array]:
    """The lines of all arrows."""
    return [mark.line for mark in marks]
