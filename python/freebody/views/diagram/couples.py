"""Where couples stand on paper: open circles at their joint or beside it, off all other arrows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from freebody.core import Array
from freebody.views import shapes
from freebody.views.diagram.actions import Action
from freebody.views.diagram.scenery import Scenery, extent

_RADII = np.array([10.0, 13.0])
_AWAY = np.array([16.0, 20.0, 25.0, 31.0, 38.0])  # pt from its joint to a couple beside it
_PARTS = 24  # of a full circle
_TURN = 2 * np.pi * np.arange(_PARTS) / _PARTS
_WAYS = np.column_stack([np.cos(_TURN), np.sin(_TURN)])
_OPEN = (6, 8, 10, 12)  # parts that are left out
_OPENER = 2.0  # what it costs to leave out more
_ARROW, _LINE, _HEAD = 4.0, 2.5, 7.0  # pt kept from arrows, from lines, about the head from both
_ON_ARROW, _ON_LINE, _AT_HEAD = 12.0, 0.5, 12.0  # what it costs to come nearer, for each part
_FAR = 0.6  # what a pt from the joint costs
_WIDE = 0.4  # what a pt of the radius costs
_HOLDING = 1.5  # what it costs to go round a place of an arrow
_BESIDES = 1e3  # what it costs to be neither smaller than half the body nor apart


@dataclass(frozen=True)
class CoupleArrow:
    """A couple on paper, in pt: an open circle with a head at the end of its ``line`` (k, 2)."""

    action: Action
    centre: Array
    line: Array


def couple_arrow(action: Action, scenery: Scenery, arrows: Sequence[Array]) -> CoupleArrow:
    """The place of a couple: round its joint, or beside it where other arrows would cross it or the body is small."""
    own, arrows_at = scenery.scale * action.at, shapes.dense(arrows)
    away = np.vstack([[0.0, 0.0], (_AWAY[:, None, None] * _WAYS).reshape(-1, 2)])
    centres, radii = np.repeat(own + away, len(_RADII), axis=0), np.tile(_RADII, len(away))
    places = centres[:, None] + radii[:, None, None] * _WAYS
    to_arrow, to_line = _distance(places, arrows_at), _distance(places, scenery.obstacles)
    met = _ON_ARROW * (to_arrow < _ARROW) + _ON_LINE * (to_line < _LINE)
    at_head = _AT_HEAD * (np.minimum(to_arrow, to_line) < _HEAD)
    held = (np.hypot(*(centres[:, None] - arrows_at).transpose(2, 0, 1)) < radii[:, None]).sum(axis=1)
    standing = _FAR * np.hypot(*(centres - own).T) + _WIDE * radii + _HOLDING * held
    standing += _BESIDES * _hides(action, scenery, places, radii)

    sense, best = int(np.sign(action.couple)), (np.inf, 0, 0, 0)
    for rank, open_parts in enumerate(_OPEN):
        drawn = _PARTS - open_parts
        for start in range(_PARTS):
            parts = (start + sense * np.arange(drawn + 1)) % _PARTS
            cost = standing + met[:, parts].sum(axis=1) + at_head[:, parts[-1]] + _OPENER * rank
            i = int(np.argmin(cost))
            best = min(best, (float(cost[i]), i, start, drawn))
    _, i, start, drawn = best
    first = _TURN[start]
    return CoupleArrow(action, centres[i], shapes.arc(centres[i], radii[i], first, first + sense * drawn * _TURN[1]))


def _hides(action: Action, scenery: Scenery, places: Array, radii: Array) -> Array:
    """Which circles are neither smaller than half of their body nor apart from all bodies."""
    own = [stroke for stroke in scenery.strokes if stroke.body == action.body and stroke.style != "rail"]
    large = radii > extent(own) / 4
    flat = places.reshape(-1, 2)
    on_body = np.array([shapes.inside(outline, flat) for outline in scenery.solids]).any(axis=0).reshape(places.shape[:2])
    centres, bodies = places.mean(axis=1), np.vstack([stroke.points for stroke in own])
    holds = np.hypot(*(centres[:, None] - bodies).transpose(2, 0, 1)).min(axis=1) < radii
    return large & (on_body.any(axis=1) | holds)


def _distance(places: Array, ink: Array) -> Array:
    """From places (n, k, 2) to the nearest ink (m, 2), (n, k)."""
    if not len(ink):
        return np.full(places.shape[:2], np.inf)
    nearest = np.full(places.shape[:2], np.inf)
    for x, y in ink:
        np.minimum(nearest, (places[..., 0] - x) ** 2 + (places[..., 1] - y) ** 2, out=nearest)
    return np.sqrt(nearest)
