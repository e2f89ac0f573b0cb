"""A place in the motion."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from freebody import _core

Array = NDArray[np.float64]


@dataclass(frozen=True)
class State:
    """A place in the motion: parameters (np,), time in s, coordinates (n,) and rates (n,); and its ``history``, what a motion has
    brought there: what is in place and holds, and the works since its start. Without one it is a state before which nothing moved.
    ``moment`` says which it is of those that a model has: ``after cut``, ``t = 2 s``; empty where there is but one start."""

    p: Array
    t: float
    q: Array
    u: Array
    history: _core.History | None = field(default=None, repr=False)
    moment: str = ""

    @property
    def arrays(self) -> tuple[Array, float, Array, Array, _core.History | None]:
        """As the core takes it."""
        return self.p, self.t, self.q, self.u, self.history

    def at(self, q: Array) -> State:
        """Another place, at rest."""
        return replace(self, q=q, u=np.zeros_like(self.u))
