"""What a peer offers for a row."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

TOLERANCES = tuple(float(x) for x in 10.0 ** -np.arange(5, 14.01, 0.5))


def steps(span, least, count):
    """Steps that divide a span of time, s: into ``least`` at first, then each time into √2 times as many."""
    return tuple(span / round(least * 2 ** (k / 2)) for k in range(count))


@dataclass(frozen=True)
class Entry:
    """``solve`` at a setting is what is timed; ``read`` makes of what it gives the numbers of the row's reference, or the first of them. Of
    the settings, the loosest first, the first at which the error is small enough is taken."""

    name: str
    solve: Callable[[float], Any]
    settings: Sequence[float] = (0.0,)
    says: str = ""
    """What is computed, and what is not."""
    read: Callable[[Any], np.ndarray] = np.asarray
    share: float = 1.0
    """Of the row's work, what a call does."""
