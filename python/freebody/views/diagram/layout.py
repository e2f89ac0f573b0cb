"""Labels on paper that keep off each other: a few places to choose from for each, the cheapest set found by going over all
labels again and again. All lengths in pt; the same input gives the same places."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from freebody.run.records import Array
from freebody.views.style import quiet

if TYPE_CHECKING:
    from matplotlib.figure import Figure

AIR = 2.0  # pt about a label
_FINE = 4  # text is measured on a grid this much finer than a point
_DIRECTIONS = np.linspace(0, 2 * np.pi, 16, endpoint=False)
_DISTANCES = (3.0, 7.0, 13.0, 22.0, 34.0, 48.0)
_LED = 14.0  # pt from which a thin line leads to what is labelled
_ALONG = np.linspace(0.1, 1.0, 8)  # of a leader, where it is looked at
_CROSSED = 1e3  # what a leader through a label costs
_SWEEPS = 6


@dataclass(frozen=True)
class Label:
    """A text (mathtext, or plain) wanted near one of some anchors (k, 2), of which an earlier one is better."""

    text: str
    anchors: Array
    size: float
    colour: str
    bold: bool = False


@dataclass(frozen=True)
class Placed:
    """A label with its place: centre, half extents, and the start of a leader where it is far from its anchor."""

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


def placed(labels: Sequence[Label], obstacles: Obstacles) -> list[Placed]:
    """Places for all labels."""
    halves = [extent(label.text, label.size, label.bold) / 2 + AIR for label in labels]
    options = [_options(label, half) for label, half in zip(labels, halves, strict=True)]
    own = [_covering(centres, half, obstacles) + near for (centres, near, _), half in zip(options, halves, strict=True)]
    leaders = [_leaders(option, half) for option, half in zip(options, halves, strict=True)]
    chosen = [-1] * len(labels)
    order = sorted(range(len(labels)), key=lambda i: -float(np.prod(halves[i])))
    for _ in range(_SWEEPS):
        before = list(chosen)
        for i in order:
            cost = own[i].copy()
            for j, at in enumerate(chosen):
                if j != i and at >= 0:
                    other = options[j][0][at]
                    cost += 1e3 * _overlap(options[i][0], halves[i], other, halves[j])
                    cost += _CROSSED * (np.abs(leaders[i] - other) < halves[j]).all(axis=2).any(axis=1)
                    cost += _CROSSED * (np.abs(options[i][0][:, None] - leaders[j][at]) < halves[i]).all(axis=2).any(axis=1)
            chosen[i] = int(np.argmin(cost))
        if chosen == before:
            break
    return [_done(labels[i], options[i], chosen[i], halves[i]) for i in range(len(labels))]


def _options(label: Label, half: Array) -> tuple[Array, Array, Array]:
    """Centres (k, 2), what their distance and rank cost (k,), and the anchors they belong to (k, 2)."""
    ways = np.column_stack([np.cos(_DIRECTIONS), np.sin(_DIRECTIONS)])
    reach = np.minimum(np.min(half / np.maximum(np.abs(ways), 1e-9), axis=1), np.hypot(*half))
    away = np.add.outer(np.array(_DISTANCES) - AIR, reach)[..., None] * ways
    centres = (label.anchors[:, None, None] + away).reshape(-1, 2)
    each = away.shape[0] * away.shape[1]
    costs = np.add.outer(2.5 * np.arange(len(label.anchors)), np.repeat(_DISTANCES, len(ways))).ravel()
    return centres, costs, np.repeat(label.anchors, each, axis=0)


def _covering(centres: Array, half: Array, obstacles: Obstacles) -> Array:
    """How much ink (k,) a box covers at each centre."""
    reached = (np.abs(obstacles.places - centres.mean(axis=0)) < half + np.ptp(centres, axis=0)).all(axis=1)
    (x, y), weights = obstacles.places[reached].T, obstacles.weights[reached]
    over = (np.abs(np.subtract.outer(centres[:, 0], x)) < half[0]) & (np.abs(np.subtract.outer(centres[:, 1], y)) < half[1])
    covered: Array = over @ weights
    return covered


def _overlap(centres: Array, half: Array, other: Array, its_half: Array) -> Array:
    """Area (k,) that a box shares with another, or 0."""
    shared: Array = np.prod(np.clip(half + its_half - np.abs(centres - other), 0, None), axis=1)
    return shared


def _edges(centres: Array, anchors: Array, half: Array) -> tuple[Array, Array]:
    """Where the lines from anchors (k, 2) to centres enter the boxes there (k, 2), and which are so long that they are drawn."""
    ways = centres - anchors
    edges = centres - ways * np.minimum(1.0, np.min(half / np.maximum(np.abs(ways), 1e-9), axis=1))[:, None]
    return edges, np.hypot(*(edges - anchors).T) > _LED


def _leaders(options: tuple[Array, Array, Array], half: Array) -> Array:
    """Places (k, n, 2) along the leader of each option, NaN where it has none."""
    centres, _, anchors = options
    edges, far = _edges(centres, anchors, half)
    places: Array = anchors[:, None] + _ALONG[:, None] * (edges - anchors)[:, None]
    places[~far] = np.nan
    return places


def _done(label: Label, options: tuple[Array, Array, Array], i: int, half: Array) -> Placed:
    centre, anchor = options[0][i], options[2][i]
    [edge], [far] = _edges(centre[None], anchor[None], half)
    return Placed(label, centre, half, np.array([anchor, edge]) if far else None)


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
