"""Labels on paper that keep off each other: a few places to choose from for each, the cheapest set found by going over all
labels again and again. All lengths in pt; the same input gives the same places."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from freebody.results import Array
from freebody.views.style import quiet

if TYPE_CHECKING:
    from matplotlib.figure import Figure

AIR = 2.0  # pt about a label
_FINE = 4  # text is measured on a grid this much finer than a point
_DIRECTIONS = np.linspace(0, 2 * np.pi, 16, endpoint=False)
_DISTANCES = (3.0, 7.0, 13.0, 22.0, 34.0, 48.0)
_LED = 14.0  # pt from which a thin line leads to what is labelled
_SWEEPS = 6


@dataclass(frozen=True)
class Label:
    """A text (mathtext, or plain) wanted near one of some anchors (k, 2), of which an earlier one is better."""

    text: str
    anchors: Array
    size: float
    colour: str
    bold: bool = False
    led: bool = True


@dataclass(frozen=True)
class Placed:
    """A label with its place: centre, half extents, and the start of a leader where it is far from its anchor."""

    label: Label
    centre: Array
    half: Array
    leader: Array | None = None


@dataclass(frozen=True)
class Ink:
    """Drawn places (k, 2) and how bad it is to write over each (k,)."""

    places: Array
    weights: Array

    @classmethod
    def of(cls, *layers: tuple[Array, float]) -> Ink:
        """Layers of places with a weight each."""
        return cls(np.vstack([places for places, _ in layers]), np.concatenate([np.full(len(p), w) for p, w in layers]))


def placed(labels: Sequence[Label], ink: Ink) -> list[Placed]:
    """Places for all labels."""
    halves = [extent(label.text, label.size, label.bold) / 2 + AIR for label in labels]
    options = [_options(label, half) for label, half in zip(labels, halves, strict=True)]
    own = [_covering(centres, half, ink) + near for (centres, near, _), half in zip(options, halves, strict=True)]
    chosen = [-1] * len(labels)
    order = sorted(range(len(labels)), key=lambda i: -float(np.prod(halves[i])))
    for _ in range(_SWEEPS):
        before = list(chosen)
        for i in order:
            cost = own[i].copy()
            for j, at in enumerate(chosen):
                if j != i and at >= 0:
                    cost += 1e3 * _overlap(options[i][0], halves[i], options[j][0][at], halves[j])
            chosen[i] = int(np.argmin(cost))
        if chosen == before:
            break
    return [_done(labels[i], options[i], chosen[i], halves[i]) for i in range(len(labels))]


def _options(label: Label, half: Array) -> tuple[Array, Array, Array]:
    """Centres (k, 2), what their distance and rank cost (k,), and the anchors they belong to (k, 2)."""
    centres, costs, owners = [], [], []
    for rank, anchor in enumerate(label.anchors):
        for distance in _DISTANCES:
            for angle in _DIRECTIONS:
                way = np.array([np.cos(angle), np.sin(angle)])
                reach = float(np.min(half / np.maximum(np.abs(way), 1e-9)))
                centres.append(anchor + way * (distance - AIR + min(reach, float(np.hypot(*half)))))
                costs.append(distance + 2.5 * rank)
                owners.append(anchor)
    return np.array(centres), np.array(costs), np.array(owners)


def _covering(centres: Array, half: Array, ink: Ink) -> Array:
    """How much ink (k,) a box covers at each centre."""
    apart = np.abs(centres[:, None] - ink.places[None])
    return ((apart < half).all(axis=2) * ink.weights).sum(axis=1)


def _overlap(centres: Array, half: Array, other: Array, its_half: Array) -> Array:
    """Area (k,) that a box shares with another, or 0."""
    shared: Array = np.prod(np.clip(half + its_half - np.abs(centres - other), 0, None), axis=1)
    return shared


def _done(label: Label, options: tuple[Array, Array, Array], i: int, half: Array) -> Placed:
    centre, anchor = options[0][i], options[2][i]
    way = centre - anchor
    edge = centre - way * min(1.0, float(np.min(half / np.maximum(np.abs(way), 1e-9))))
    far = label.led and np.hypot(*(edge - anchor)) > _LED
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
