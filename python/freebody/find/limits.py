"""Where a quantity tends to as time goes on, and integrals to infinity: a tail that is seen to be exponential or a power law is
extrapolated, and the extrapolation held against what comes later."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import Array, MotionError, quote
from freebody.find.response import Response
from freebody.model.start import quantity
from freebody.model.user_units import shown
from freebody.run.records import Window, integral, over_time, unit_of
from freebody.solve.figures import Known, figure
from freebody.solve.rich_tables import PlainText, figure_in
from freebody.stability.equilibria import Equilibrium, equilibrium
from freebody.stability.state_space import SingularConfiguration

if TYPE_CHECKING:
    from freebody.model.builder import Builder
    from freebody.run.simulation import Run

_FIRST, _SPANS = 1.0, 14
"""The first time that is looked at, s, and how often it is doubled."""
_TERMS = 9
"""Values of which a limit is extrapolated."""
_SAFETY = 3.0
_AIMED, _WANTED = 1e-10, 1e-6
"""Parts of the size of a quantity to which its limit is looked for, and must be seen."""
_SETTLED = 1e-14
"""Part of the size of a quantity that is round-off."""
_LESS = 0.9
"""What is left of a swing when the time has doubled, at most, where there is a limit."""
_DIED_OUT, _REACHED = 20.0, 1e-3
"""Times of the slowest decay for which a motion is followed on to an equilibrium, and what is left of its distance if it comes there."""
RTOL = 1e-12
"""Of the runs of a limit, unless another is asked for."""
_LOOKS = 64
"""Times in the quarter before the last half; twice as many in that."""


class NoLimit(ValueError):
    """A quantity that was not seen to tend to anything."""


@dataclass(frozen=True)
class Limit(PlainText):
    """What a quantity ``of`` a motion tends to (SI): ``value`` with an estimate of its error, no bound: what the motion does later is
    not known; but where the motion ``rests``, within reach of an asymptotically stable equilibrium, the value is that of the
    equilibrium, known as far as Newton's method tells. ``tail`` says how it gets there; up to ``until`` (s, or the value of what is
    ``varied``) it was followed, where the quantity was ``last``."""

    of: str
    value: Known
    unit: str
    tail: str
    until: float
    last: float
    varied: str = ""
    rests: bool = False

    @property
    def sentence(self) -> str:
        """The answer, with its unit."""
        (unit, size), how = shown(self.unit), "" if self.rests else "an estimated "
        value, last = (figure_in(self.unit, each, digits) for each, digits in ((self.value, 12), (self.last, 8)))
        told = f"{self.of} tends to {f'{value} {unit}'.rstrip()}, to {how}{self.value.error / size:.0e}"
        return f"{told}: {self.tail}; it was {last} at {self.varied}{figure(self.until)}{'' if self.varied else ' s'}."

    def to_json(self) -> dict[str, Any]:
        """As plain data, in SI."""
        stated = {name: getattr(self, name) for name in ("of", "sentence", "tail", "unit", "until", "last", "rests")}
        return stated | {"value": float(self.value), "error" if self.rests else "estimated_error": self.value.error}

    def __rich_console__(self, console: Any, options: Any) -> Iterator[Any]:
        yield self.sentence

    def __str__(self) -> str:
        return self.sentence


def limit_over(respond: Response, begin: Any, towards: Any) -> Limit:
    """What a quantity of the motion tends to as what is varied goes from ``begin`` ``towards`` a value, or infinity: it is looked at
    where what is left of the way halves, or where the value doubles. Raises ``NoLimit``."""
    of, vary = respond.of, respond.varied
    first, to = respond.place(begin), math.inf if towards in (math.inf, "inf") else respond.place(towards)
    steps = np.arange(_TERMS + 1)
    places = first * 2.0**steps if to == math.inf else to + (first - to) * 2.0**-steps
    values = np.array([respond(float(x)).y for x in places])
    if missing := [respond(float(x)) for x in places if not respond(float(x)).is_known]:
        raise NoLimit(f"{of} has no value at {vary} = {missing[0].x:g}: {missing[0].why}")
    gaps, size = np.abs(np.diff(values)), float(np.abs(values).max())
    level = max(_SETTLED * size, respond.error([respond(float(x)) for x in places]))
    whole, *parts = (extrapolated(each) for each in (values, values[:-1], values[1:]))
    still = max(_AIMED * size, level)
    if gaps.max() <= still:
        whole, parts = float(values[-1]), [values[-1] - gaps.max()]
    error = _SAFETY * max([level, *(abs(whole - part) for part in parts)])
    if gaps[-1] > max(_LESS * gaps[-2], still) or not error <= _WANTED * size:
        seen = f"it was {values[-2]:.8g} at {places[-2]:.6g} and is {values[-1]:.8g} at {places[-1]:.6g}"
        raise NoLimit(f"no limit of {of} is seen as {vary} tends to {towards}: {seen}")
    tail = _tail("power", values, whole, places)
    way = vary if to in (0, math.inf) else f"({vary} − {to:g})"
    tail = tail.replace("t^", f"{way}^") if to == math.inf else tail.replace("t^-", f"{way}^")
    found = Known(whole, error, max(size, abs(whole)))
    return Limit(of, found, respond.quantity_unit, tail, float(places[-1]), float(values[-1]), f"{vary} = ")


def limit(mechanism: Builder, of: str, until: Any, changes: Mapping[str, Any]) -> Limit:
    """What an expression, or ``integral of`` one, tends to as t → ∞. It is followed to times that double, at most to ``until`` (s, or a
    quantity) or 16 000 s, as far as it takes; what is extrapolated of a part of the motion must hold for all that follows.

    ``changes`` are those of ``simulate``, settings among them. Raises ``NoLimit`` where no limit is seen.
    """
    most = _FIRST * 2**_SPANS if until is None else quantity("until", until, "s")
    summed = of.startswith("integral of ")
    text = of.removeprefix("integral of ").strip()
    end = min(most, 8 * _FIRST)
    while True:
        run = mechanism.simulate(end, **{"rtol": RTOL, **changes})
        if run.edges[-1] < end:
            raise NoLimit(f"{of} has no limit t → ∞: the motion ends at {run.edges[-1]:g} s: {run.outcome.sentence}")
        read = _integrated(run, text) if summed else partial(run.evaluate, text)
        found = _seen(read, float(run.edges[0]), end)
        if end >= most or (found and found[0].error <= _AIMED * found[0].size):
            break
        end = min(2 * end, most)
    last = float(read(np.array([end]))[0])
    if not found or found[0].error > _WANTED * found[0].size:
        half = float(read(np.array([end / 2]))[0])
        raise NoLimit(f"no limit of {of} is seen until {end:g} s: it was {half:.8g} at {end / 2:g} s and is {last:.8g} then")
    unit = unit_of(text, run.columns, run.metadata)
    if not summed and (value := _at_rest(mechanism, run, text, found[0], most, changes)):
        return Limit(of, value, unit, "it comes to rest in an asymptotically stable equilibrium", end, last, rests=True)
    return Limit(of, found[0], over_time(unit) if summed else unit, found[1], end, last)


def _at_rest(mechanism: Builder, run: Run, text: str, seen: Known, most: float, changes: Mapping[str, Any]) -> Known | None:
    """The value at the asymptotically stable equilibrium to which a motion comes, as it goes on until what is left has died out; None
    where laws of time go on, and where it is not seen to come there."""
    try:
        rest = equilibrium(run.source, run.end)
    except (MotionError, SingularConfiguration):
        return None
    if rest is None or rest.stability != "stable" or (slowest := _slowest(rest)) <= 0:
        return None
    names = [f"accel({quote(name)})" for name in run.source.coordinate_names]
    until = float(run.edges[-1]) + _DIED_OUT / slowest
    if until > most or run.source.derivatives([*names, text], rest.state)[:, 0].any():
        return None
    later = mechanism.simulate(until, **{"rtol": RTOL, **changes})
    far, near = (float(np.abs(state.q - rest.state.q).max(initial=0.0)) for state in (run.end, later.end))
    other = equilibrium(run.source, later.end)
    if later.edges[-1] < until or other is None or near > _REACHED * max(far, seen.size * _SETTLED):
        return None
    value, again = (float(run.source.evaluate([text], each.state)[0]) for each in (rest, other))
    error = _SAFETY * max(abs(value - again), _SETTLED * seen.size)
    return Known(value, error, max(seen.size, abs(value))) if abs(value - seen) <= _SAFETY * seen.error + error else None


def _slowest(rest: Equilibrium) -> float:
    """The rate at which the slowest of all perturbations dies out, 1/s."""
    return float(-np.linalg.eigvals(rest.space.a).real.max(initial=-math.inf))


def _integrated(run: Run, text: str) -> Any:
    """The integral of an expression from the start to times."""

    def read(times: Array) -> Array:
        spans = pairwise([run.edges[0], *times])
        return np.cumsum([integral(lambda t: run.evaluate(text, t), Window.within(run.edges, span)) for span in spans])

    return read


def _seen(read: Any, start: float, end: float) -> tuple[Known, str] | None:
    """The limit with its error, and how it is reached, by the extrapolation that serves best; None where it does not settle: where it
    swings about as much in the last half of the time as in the quarter before."""
    grid = start + (end - start) * np.linspace(0.25, 1, 3 * _LOOKS + 1)
    doubled = start + (end - start) * 2.0 ** np.arange(-_TERMS + 1, 1)
    even = start + (end - start) * np.linspace(0.5, 1, _TERMS)
    times = np.unique(np.concatenate([grid, doubled, even]))
    known = read(times)
    at = lambda asked: known[np.searchsorted(times, asked)]
    size = float(np.abs(known).max())
    before, after = (float(np.ptp(at(part))) for part in (grid[: _LOOKS + 1], grid[_LOOKS:]))
    if after > max(_LESS * before, _SETTLED * size):
        return None
    left = after / (1 - min(after / before, _LESS)) if before else 0.0
    found = []
    for law, of in (("power", doubled), ("exponential", even)):
        values = at(of)
        whole, *parts = (extrapolated(each) for each in (values, values[:-1], values[1:]))
        if math.isfinite(whole) and abs(whole - values[-1]) <= left + _SETTLED * size:
            error = _SAFETY * max(*(abs(whole - part) for part in parts), _SETTLED * size)
            found.append((Known(whole, error, max(size, abs(whole))), _tail(law, values, whole, of)))
    return min(found, key=lambda each: each[0].error) if found else None


def _tail(name: str, values: Array, to: float, times: Array) -> str:
    """How the last values approach their limit, in words."""
    left = np.abs(values[-2:] - to)
    if left[1] <= _SETTLED * np.abs(values).max():
        return "it is there to round-off"
    if name == "power":
        power = math.log2(left[0] / left[1])
        return f"what is left falls as t^-{power:.2f}, {left[1]:.1e} at the end"
    rate = math.log(left[0] / left[1]) / (times[-1] - times[-2])
    if rate <= 0:
        return f"what is left swings, {left[1]:.1e} at the end"
    return f"what is left falls as exp(-{rate:.3g} t), {left[1]:.1e} at the end"


def extrapolated(values: Sequence[float] | Array) -> float:
    """The limit of a sequence that is a sum of geometric ones, by Wynn's epsilon algorithm (1956, MTAC 10, 91)."""
    before, now = [0.0] * (len(values) + 1), [float(value) for value in values]
    best = now[-1]
    for column in range(1, len(values)):
        gaps = np.diff(now)
        if (np.abs(gaps) <= _SETTLED * max(map(abs, values))).any():
            break
        before, now = now, [old + 1 / gap for old, gap in zip(before[1:], gaps.tolist(), strict=False)]
        if column % 2 == 0:
            best = now[-1]
    return best
