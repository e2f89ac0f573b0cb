"""Impacts in films: where and when they are, and the star that flashes up there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import Array
from freebody.impact.impacts import impacts

if TYPE_CHECKING:
    from freebody.run.simulation import Run

LASTING = 0.3
"""How long a flash is seen, in s of the film."""
_FAINT = 0.02
"""Of the largest impulse, below which an impact is not shown."""
_RAYS = 8


@dataclass(frozen=True)
class ImpactMarker:
    """An impact at a time and a place (m, fixed axes); ``strength``: root of its impulse over the largest of the run."""

    t: float
    at: tuple[float, float]
    strength: float

    def glow(self, t: float, lasting: float) -> float:
        """How bright it is at a time, 1 as it strikes and 0 when ``lasting`` s have gone."""
        return 1 - (t - self.t) / lasting if self.t <= t < self.t + lasting else 0.0

    def rays(self, size: float) -> Array:
        """Its rays (k, 2, 2) in the fixed axes, for sparks of a ``size``."""
        angles = 2 * np.pi * (np.arange(_RAYS) + 0.5) / _RAYS
        out = np.column_stack([np.cos(angles), np.sin(angles)])
        return np.array(self.at) + size * np.stack([0.4 * out, (0.4 + self.strength) * out], axis=1)


def impact_markers(run: Run) -> list[ImpactMarker]:
    """The impacts of a run worth a flash; none of a run from a file, which does not know where impulses acted."""
    if run.recorded:
        return []
    impulses = []
    for impact in impacts(run):
        sizes = impact.change.impulses.sizes if impact.change.impulses else {}
        impulses += [(impact, name, size) for name, size in sizes.items() if name in impact.change.of]
    largest = max((size for _, _, size in impulses), default=0.0)
    made = []
    for impact, name, size in impulses:
        if size > _FAINT * largest:
            places = [part.point for load in impact.free.loads if load.name == name for part in load.on if not part.idle]
            if places:  # in the middle of those where the load of a contact, string or stop acts
                x, y = np.mean(places, axis=0).tolist()
                made.append(ImpactMarker(impact.change.t, (x, y), float(np.sqrt(size / largest))))
    return made
