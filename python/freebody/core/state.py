"""A place in the motion."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class State:
    """A place in the motion: parameters (np,), time in s, coordinates (n,) and rates (n,)."""

    p: Array
    t: float
    q: Array
    u: Array

    @property
    def arrays(self) -> tuple[Array, float, Array, Array]:
        """As the core takes it."""
        return self.p, self.t, self.q, self.u

    def at(self, q: Array) -> State:
        """Another place, at rest."""
        return replace(self, q=q, u=np.zeros_like(self.u))
