"""A quantity followed over what is varied: intervals are halved until it is what its neighbours say, and where it jumps, has no value
or turns a corner the place is found to the last digits."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from freebody.find.response import Response, Sample
from freebody.model.user_units import shown
from freebody.solve.rich_tables import figure_in

FOLLOWED = 1e-3
"""Part of its swing by which the quantity may differ amid an interval from the cubic through its neighbours."""
_HALVINGS = 8
"""Of an interval of the first grid, at most."""
_TOLD_APART = 3
"""Halvings after which different things that happen on the two sides are taken to be the reason."""
_EDGE = 1e-14
"""Part of the range to which the place of a break is found."""
_LEVEL, _SAFETY = 1e-9, 10.0
"""Part of the size of the quantity that may be its error; how much larger the error may be elsewhere than where it is known."""


@dataclass(frozen=True)
class Break:
    """A place between two samples where the quantity jumps, turns a corner, or ceases to have a value."""

    below: Sample
    above: Sample

    @property
    def x(self) -> float:
        """Where it is."""
        return (self.below.x + self.above.x) / 2

    @property
    def reason(self) -> str:
        """What differs below and above."""
        for side, sample in (("below", self.below), ("above", self.above)):
            if not sample.is_known:
                return f"{side} there is no value: {sample.why}"
        at = next((i for i, (one, other) in enumerate(zip(*self.stories, strict=True)) if one != other), None)
        if at is None:
            return "the same happens on both sides"
        one, other = (story[at] or "nothing more" for story in self.stories)
        before = [name for name in self.stories[0][:at] if name]
        after = f" after {before[-1]} ({len(before)} before)" if before else ""
        return f"below, {one} comes{after}; above, {other}"

    @property
    def stories(self) -> tuple[list[str], list[str]]:
        """What happens below and above, of one length."""
        one, other = list(self.below.story), list(self.above.story)
        longest = max(len(one), len(other))
        return one + [""] * (longest - len(one)), other + [""] * (longest - len(other))

    @property
    def jump(self) -> float:
        """By how much the quantity differs; NaN where it has no value on one side."""
        return self.above.y - self.below.y


@dataclass(eq=False)
class Curve:
    """What is known of a quantity between two places: samples in order, breaks, and intervals where it could not be followed.
    ``respond`` is a ``Response``, or what answers as one does."""

    respond: Response
    start: float
    end: float
    points: int = 33
    runs: int = 2000
    samples: list[Sample] = field(default_factory=list)
    breaks: list[Break] = field(default_factory=list)
    unresolved: list[tuple[float, float]] = field(default_factory=list)

    def __post_init__(self) -> None:
        grid = np.linspace(self.start, self.end, self.points).tolist()
        waiting = deque(pairwise([self._take(x) for x in grid]))
        known = [sample for sample in self.samples if sample.is_known]
        self.error = _SAFETY * self.respond.error(known) if known else 0.0
        while waiting:
            if len(self.samples) >= self.runs:
                self.unresolved += [(low.x, high.x) for low, high in waiting]
                return
            waiting.extend(self._halved(*waiting.popleft()))

    # What it looks like

    @property
    def pieces(self) -> list[list[Sample]]:
        """The samples with values, between breaks."""
        ends, found = {each.below.x for each in self.breaks}, [[]]
        for sample in self.samples:
            if sample.is_known:
                found[-1].append(sample)
            if not sample.is_known or sample.x in ends:
                found.append([])
        return [piece for piece in found if piece]

    @property
    def resolution(self) -> float:
        """The widest interval without a sample."""
        return max(high.x - low.x for low, high in pairwise(self.samples))

    @property
    def swing(self) -> float:
        """Between the least and the greatest value."""
        known = [sample.y for sample in self.samples if sample.is_known]
        return float(np.ptp(known)) if known else 0.0

    @property
    def level(self) -> float:
        """Differences below this may be errors."""
        return max(self.error, self._round_off)

    @property
    def _round_off(self) -> float:
        return _LEVEL * max((abs(sample.y) for sample in self.samples if sample.is_known), default=0.0)

    def printed(self, unit: str, y: float, most: int = 6) -> str:
        """A value of the quantity as it is shown; what is round-off beside its size is 0."""
        return figure_in(unit, y if abs(y) > self._round_off else 0.0, most)

    def sentence(self, unit: str) -> str:
        """How closely it was looked at."""
        widest = f"{figure_in(unit, self.resolution, 3)} {shown(unit).unit}".rstrip()
        told = [f"{len(self.samples)} places, at most {widest} apart"]
        told += [f"between them it follows its neighbours to {FOLLOWED:g} of its swing, so what is narrower can be missed"]
        if self.unresolved:
            where = ", ".join(f"{figure_in(unit, a, 4)} to {figure_in(unit, b, 4)}" for a, b in self.unresolved[:3])
            told += [f"not followed: {where}" + f" and {len(self.unresolved) - 3} more" * (len(self.unresolved) > 3)]
        return "; ".join(told)

    # How it is found

    def _take(self, x: float) -> Sample:
        sample = self.respond(x)
        place = bisect_left(self.samples, x, key=lambda each: each.x)
        if place == len(self.samples) or self.samples[place].x != x:
            self.samples.insert(place, sample)
        return sample

    def _halved(self, low: Sample, high: Sample) -> Iterator[tuple[Sample, Sample]]:
        """The intervals that are to be looked at in place of one."""
        amid = self._take((low.x + high.x) / 2)
        both, width = [(low, amid), (amid, high)], (self.end - self.start) / (self.points - 1) / (high.x - low.x)
        halvings = round(math.log2(width))
        if len({sample.is_known for sample in (low, amid, high)}) == 2:
            yield from (part for one, other in both if one.is_known != other.is_known for part in self._broken(one, other))
        elif not amid.is_known or abs(amid.y - self._expected(amid)) <= FOLLOWED * self.swing + self.level:
            return
        elif halvings >= _TOLD_APART and len({sample.story for sample in (low, amid, high)}) > 1:
            yield from (part for one, other in both if one.story != other.story for part in self._broken(one, other))
        elif halvings < _HALVINGS:
            yield from both
        elif abs(high.y - low.y) > FOLLOWED * self.swing:
            one, other = max(both, key=lambda pair: abs(pair[1].y - pair[0].y))
            yield from self._broken(one, other)
        else:
            self.unresolved.append((low.x, high.x))

    def _broken(self, low: Sample, high: Sample) -> Iterator[tuple[Sample, Sample]]:
        """Find the break in an interval; what is beside it is looked at again, as far as that is wide enough."""
        first, last = low, high
        while high.x - low.x > _EDGE * (self.end - self.start) and low.x < (x := (low.x + high.x) / 2) < high.x:
            amid = self._take(x)
            if _alike(amid, low, high):
                low = amid
            else:
                high = amid
        self.breaks = sorted([*self.breaks, Break(low, high)], key=lambda each: each.x)
        least = (self.end - self.start) / (self.points - 1) / 2**_HALVINGS
        yield from ((a, b) for a, b in ((first, low), (high, last)) if b.x - a.x > least)

    def _expected(self, amid: Sample) -> float:
        """What the samples beside one say that it is: the cubic through four of its piece, none too near another."""
        piece = next(piece for piece in self.pieces if amid in piece)
        others = sorted((each for each in piece if each is not amid), key=lambda each: abs(each.x - amid.x))
        if not others:
            return amid.y
        least, taken = 0.9 * abs(others[0].x - amid.x), list[Sample]()
        for each in others:
            if len(taken) < 4 and all(abs(each.x - other.x) >= least for other in (*taken, amid)):
                taken.append(each)
        return float(
            sum(
                each.y * math.prod((amid.x - other.x) / (each.x - other.x) for other in taken if other is not each)
                for each in taken
            )
        )


def _alike(sample: Sample, low: Sample, high: Sample) -> bool:
    """Whether a sample is on the side of ``low`` rather than of ``high``."""
    if low.is_known != high.is_known:
        return sample.is_known == low.is_known
    if low.story != high.story:
        return sample.story == low.story
    return abs(sample.y - low.y) <= abs(sample.y - high.y)
