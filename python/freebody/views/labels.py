"""Labels on paper that keep off each other: a few places to choose from for each, the cheapest set found by going over all
labels again and again. All lengths in pt; the same input gives the same places."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property, lru_cache
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import Array
from freebody.views.style import INK, quiet

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

AIR = 2.0  # pt about a label
_FINE = 4  # text is measured on a grid this much finer than a point
_DIRECTIONS = np.linspace(0, 2 * np.pi, 16, endpoint=False)
_DISTANCES = (3.0, 7.0, 13.0, 22.0, 34.0, 48.0, 66.0, 90.0)
_LED = 14.0  # pt from which a thin line leads to what is labelled
_ALONG = np.linspace(0.05, 1.0, 40)  # of a leader, where it is looked at
_CROSSED = 1e3  # what a leader through a label costs
_OWN = 5.0  # pt from its anchor, where a leader may be on a line
_CELL = 2.0  # pt, by which it is looked up what a leader is on
_OUTSIDE = 60.0  # what a pt beyond the frame costs
_SWEEPS = 6
_SIGN = re.compile(r"\\text(?:backslash|asciicircum|asciitilde)\{\}|\\[$#&]")


@dataclass(frozen=True)
class Label:
    """A text (mathtext, or plain) wanted near one of some anchors (k, 2), of which an earlier one is better."""

    text: str
    anchors: Array
    size: float = 9.0
    colour: str = INK
    bold: bool = False


@dataclass(frozen=True)
class Placed:
    """A label with its place: centre, half extents, and a leader (2, 2) from its anchor where it is far from it."""

    label: Label
    centre: Array
    half: Array
    leader: Array | None = None


@dataclass(frozen=True)
class Obstacles:
    """Drawn places (k, 2) and how bad it is to write over each (k,)."""

    places: Array
    weights: Array

    @classmethod
    def of(cls, *layers: tuple[Array, float]) -> Obstacles:
        """Layers of places with a weight each."""
        return cls(np.vstack([places for places, _ in layers]), np.concatenate([np.full(len(p), w) for p, w in layers]))

    @cached_property
    def _cells(self) -> tuple[Array, Array]:
        """A lower left corner, and the worst of what is drawn in each cell of a grid from there on."""
        low = self.places.min(axis=0)
        cells = ((self.places - low) / _CELL).astype(int)
        worst = np.zeros(cells.max(axis=0) + 1)
        np.maximum.at(worst, tuple(cells.T), self.weights)
        return low, worst

    def at(self, places: Array) -> Array:
        """How bad it is to draw over places (…, 2)."""
        if not len(self.places):
            return np.zeros(places.shape[:-1])
        low, worst = self._cells
        cells = np.floor((np.nan_to_num(places, nan=-1e9) - low) / _CELL).astype(int)
        there = ((cells >= 0) & (cells < worst.shape)).all(axis=-1)
        return np.where(there, worst[tuple(np.where(there[..., None], cells, 0).T)].T, 0.0)


@dataclass(frozen=True)
class _Choice:
    """Where a label of some half extents may go: centres (k, 2), leaders (k, 2, 2), NaN where none is needed, and places (k, n, 2)
    along them; what each costs (k,) without the other labels."""

    half: Array
    centres: Array
    leaders: Array
    along: Array
    cost: Array


def placed(labels: Sequence[Label], obstacles: Obstacles, frame: Array | None = None) -> list[Placed]:
    """Places for all labels, which should stay within a ``frame``, its lower left and upper right corner, if there is one."""
    choices = [_choice(label, obstacles, frame) for label in labels]
    largest = sorted(range(len(labels)), key=lambda i: -float(np.prod(choices[i].half)))
    forced = sorted(largest, key=lambda i: -float(np.median(choices[i].cost)))
    between = cache(lambda i, j, at: _between(choices[i], choices[j], at))
    orders = (largest, forced, largest[::-1])
    _, chosen = min((_swept(choices, order, between) for order in orders), key=lambda found: found[0])
    found = [(label, c.centres[i], c.half, c.leaders[i]) for label, c, i in zip(labels, choices, chosen, strict=True)]
    return [Placed(*place, None if np.isnan(leader).any() else leader) for *place, leader in found]


def _swept(
    choices: Sequence[_Choice], order: Sequence[int], between: Callable[[int, int, int], Array]
) -> tuple[float, list[int]]:
    """The cost of a set of places, and the set: each label in its turn takes its cheapest place beside the others, again and again.
    ``between``: what each place of one label costs beside a place of another."""
    chosen = [-1] * len(choices)
    for _ in range(_SWEEPS):
        before, total = list(chosen), 0.0
        for i in order:
            cost = choices[i].cost + sum(between(i, j, at) for j, at in enumerate(chosen) if j != i and at >= 0)
            chosen[i] = int(np.argmin(cost))
            total += float(cost[chosen[i]])
        if chosen == before:
            break
    return total, chosen


def _between(mine: _Choice, other: _Choice, at: int) -> Array:
    """What each place of a label costs (k,) beside another that has its place."""
    centre = other.centres[at]
    shared: Array = np.prod(np.clip(mine.half + other.half - np.abs(mine.centres - centre), 0, None), axis=1)
    led = _within(mine.along - centre, other.half)
    crossed = _within(mine.centres[:, None] - other.along[at], mine.half)
    return 1e3 * shared + _CROSSED * led.any(axis=1) + _CROSSED * crossed.any(axis=1)


def _within(offsets: Array, half: Array) -> Array:
    """Which places (…, 2) from a centre are within half extents about it."""
    inside: Array = (np.abs(offsets[..., 0]) < half[0]) & (np.abs(offsets[..., 1]) < half[1])
    return inside


def _choice(label: Label, obstacles: Obstacles, frame: Array | None) -> _Choice:
    """Places all about each anchor. They cost by their distance, by the rank of their anchor and by what they cover."""
    half = extent(label.text, label.size, label.bold) / 2 + AIR
    ways = np.column_stack([np.cos(_DIRECTIONS), np.sin(_DIRECTIONS)])
    reach = np.minimum(np.min(half / np.maximum(np.abs(ways), 1e-9), axis=1), np.hypot(*half))
    away = np.add.outer(np.array(_DISTANCES) - AIR, reach)[..., None] * ways
    centres = (label.anchors[:, None, None] + away).reshape(-1, 2)
    anchors = np.repeat(label.anchors, away.shape[0] * away.shape[1], axis=0)
    near = np.add.outer(2.5 * np.arange(len(label.anchors)), np.repeat(_DISTANCES, len(ways))).ravel()

    reached = (np.abs(obstacles.places - centres.mean(axis=0)) < half + np.ptp(centres, axis=0)).all(axis=1)
    (x, y), weights = obstacles.places[reached].T, obstacles.weights[reached]
    low, high = (centres - half).T[..., None], (centres + half).T[..., None]
    over = (low[0] < x) & (x < high[0]) & (low[1] < y) & (y < high[1])
    cost = np.where(over, weights, 0.0).sum(axis=1) + near
    if frame is not None:
        cost += _OUTSIDE * np.clip([frame[0] - centres + half, centres + half - frame[1]], 0, None).sum(axis=(0, 2))

    to = centres - anchors
    edges = centres - to * np.minimum(1.0, np.min(half / np.maximum(np.abs(to), 1e-9), axis=1))[:, None]
    leaders = np.stack([anchors, edges], axis=1)
    leaders[np.hypot(*(edges - anchors).T) <= _LED] = np.nan
    along = leaders[:, :1] + _ALONG[:, None] * (leaders[:, 1:] - leaders[:, :1])
    cost += (obstacles.at(along) * (np.hypot(*(along - anchors[:, None]).T).T > _OWN)).sum(axis=1)
    return _Choice(half, centres, leaders, along, cost)


def mathtext(latex: str) -> str:
    """LaTeX as matplotlib knows it, which has no ``\\tfrac`` and cannot write some signs of names."""
    return _SIGN.sub(" ", latex).replace(r"\tfrac", r"\frac")


def write(ax: Axes, labels: Sequence[Placed], to_data: Callable[[Array], Array]) -> None:
    """Labels and their leaders on axes; ``to_data`` takes places (…, 2) on paper to those of the axes."""
    for each in labels:
        label = each.label
        if each.leader is not None:
            ax.plot(*to_data(each.leader).T, color=label.colour, lw=0.5, zorder=4.5)
        ax.text(*to_data(each.centre), label.text, fontsize=label.size, color=label.colour, ha="center", va="center",
                fontweight="bold" if label.bold else "normal", zorder=6, label="label", in_layout=False)  # fmt: skip


@lru_cache(maxsize=4096)
def extent(text: str, size: float, bold: bool = False) -> Array:
    """Width and height of a text as it will be printed, (2,)."""
    with quiet():
        drawn = _sheet().text(0, 0, text, fontsize=size, fontweight="bold" if bold else "normal")
        box = drawn.get_window_extent()
        drawn.remove()
    return np.array([box.width, box.height]) / _FINE


@lru_cache(maxsize=1)
def _sheet() -> Figure:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(dpi=72 * _FINE)
    FigureCanvasAgg(figure)
    return figure
