"""How long is looked for what would make a wrong statement true."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from time import thread_time
from typing import TypeVar

import numpy as np

T = TypeVar("T")
_CORRECTIONS = 0.8  # of the budget, so that there is time for assumptions
_GONE = 0.7  # of the budget, as which counts what is gone at most where a claim asks again
_ALL_BUT_GONE = 0.9  # the same, where the whole is used up
_SECONDS = (10, 20), (2.0, 10.0)
"""Bodies, and how long a statement about them may take."""


@dataclass
class Budget:
    """Seconds that the asking thread computes, from the first question on: those of the threads of linear algebra do not count.
    ``spent``: something was left out for want of time; ``whole``: that of the claim of which this is a part."""

    seconds: float
    spent: bool = False
    begins: float = math.nan
    whole: Budget | None = None

    @staticmethod
    def seconds_for(bodies: int) -> float:
        """How many a statement about a model of so many bodies may take."""
        return float(np.interp(bodies, *_SECONDS))

    def part(self) -> Budget:
        """What is left of it for one question of a claim that asks several; little where nothing is."""
        now = thread_time()
        gone = _GONE if now - self.begins < self.seconds else _ALL_BUT_GONE
        return Budget(self.seconds, begins=max(self.begins, now - gone * self.seconds), whole=self)

    @property
    def words(self) -> str:
        """That it was not enough."""
        return "For want of time no more was looked for: there may be other corrections."

    def leaves_out_since(self, began: float) -> None:
        """What has been computed since then does not count: it is no search, and is done once for a model."""
        passed = thread_time() - began
        self.begins += passed
        if self.whole:
            self.whole.begins += passed

    def within(self, found: Iterable[T], part: float = _CORRECTIONS) -> Iterator[T]:
        """What there is, as long as there is a ``part`` of the time left: by default so that assumptions can be tried after corrections."""
        for each in found:
            if not self.lasts(part):
                return
            yield each

    def at_least(self, found: Iterable[T], part: float, share: float) -> Iterator[T]:
        """What there is, as long as there is a ``part`` of the time left, or this itself has not taken a ``share`` of it."""
        begins = thread_time()
        for each in found:
            if not self.lasts(part) and thread_time() - begins > share * self.seconds:
                return
            yield each

    def with_rest(self, part: float) -> float:
        """The part of the whole that is gone when a part of what is left is."""
        if math.isnan(self.begins) or math.isinf(self.seconds):
            return part
        gone = min((thread_time() - self.begins) / self.seconds, 1.0)
        return gone + part * (1 - gone)

    def lasts(self, part: float = 1.0) -> bool:
        """Whether there is time, or a ``part`` of it, left."""
        self.begins = thread_time() if math.isnan(self.begins) else self.begins
        over = thread_time() - self.begins > part * self.seconds
        self.spent |= over
        return not over
