"""How many digits of a run hold: the same motion is followed once more at another tolerance, and the two are held side by side.

What two runs differ by at a time is the most that they did so far, so that curves which cross by chance gain nothing; a digit is
of the largest size of the quantity so far. Where different things happen in the two, nothing holds from there on. Between the two
instants of one impact the instants are compared, not what jumps there.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import Array, Change, OutcomeKind, ReportItem, Settings, State, cards
from freebody.run.records import Reported, Window, unit_size
from freebody.solve.figures import MOST, NOISE, Known, digits_of

if TYPE_CHECKING:
    from freebody.run.simulation import Run

TIGHTER = 100.0  # the second run's error is small beside that of the first
TIGHTEST = 1e-14  # the core takes no tolerance below
SAFETY = 3.0  # what two runs differ by is an estimate of the error, and at a tight tolerance both have one
ROUND_OFF = 2.0**-52
LOOKS = 200  # steps of the second run, at least: what a law does in less than a few such steps both may pass over
UNREACHED = 3.0  # times that are left to a dead position, over which a figure there is seen to change
NEAR_END = 0.1  # of the run: where so much would be left, speeds do not grow without bound
DEAD_ENDS = (OutcomeKind.DEAD_POSITION, OutcomeKind.STRING_ZERO_LENGTH)
JUST_MISSED = 1e-6  # of the duration: what only one run meets so near its end is no parting of ways
EVENT = "event"
PRINTED = 6  # digits of the figures in tables

Read = Callable[["Run", Array], Array]
"""Values (nt, k) of quantities of a run at times (nt,)."""


def other_settings(settings: Settings, length: float = math.inf) -> Settings:
    """Those of the second run of a motion of a ``length`` (s): a tighter tolerance; another method where there is none, or where steps
    are fixed, since the same steps have the same errors; and no step so long that much could happen unseen."""
    methods = cards.methods()
    adaptive = [name for name, method in methods.items() if not method.fixed_step and name != settings.method]
    longest = min(settings.max_step / 2 if settings.max_step else math.inf, length / LOOKS)
    finer = replace(settings, max_step=longest if 0 < longest < math.inf else None)
    if methods[settings.method].fixed_step:
        return replace(finer, method=adaptive[0], rtol=1e-12, step=None)
    rtol = max(settings.rtol / TIGHTER, TIGHTEST)
    return replace(finer, rtol=rtol, method=settings.method if settings.rtol > 5 * rtol else adaptive[0])


def other_start(start: State) -> State:
    """The same start to round-off, so that a motion that hangs on the last bit of a number, like a fall from the top, is seen to."""
    signs = np.resize([1.0, -1.0], len(start.q)) * ROUND_OFF
    return replace(start, q=start.q * (1 + signs), u=start.u * (1 - signs))


@dataclass(frozen=True)
class Band:
    """Quantities at times ``t`` (nt,): ``values``, ``error`` and ``size`` so far, each (nt, k)."""

    t: Array
    values: Array
    error: Array
    size: Array


@dataclass(frozen=True)
class KnownChange(Change):
    """A mode change whose work of motions and sizes of impulses are known as far as two runs agree."""

    known_work: Known | None = None
    known_sizes: Mapping[str, Known] = field(default_factory=dict)

    @property
    def work(self) -> Known | None:
        """What motions put in, J."""
        return self.known_work

    @property
    def sizes(self) -> Mapping[str, Known]:
        """How large the impulses are."""
        return self.known_sizes


@dataclass(frozen=True, eq=False)
class Accuracy:
    """A run beside the ``other`` that followed the same motion; ``parted``: before it began."""

    run: Run
    other: Run
    parted: bool = False

    # What happened in both

    @cached_property
    def _pairs(self) -> dict[tuple[str, str], list[tuple[float, float]]]:
        """The times of what happened in the run and in the other, by what it was and to which part; infinite: it did not."""
        mine, other = _times(self.run), _times(self.other)
        start, end = self.run.edges[[0, -1]].tolist()
        pairs = {}
        for key in {**mine, **other}:
            both = [list(times.get(key, ())) for times in (mine, other)]
            longer, lacking = max(both, key=len), abs(len(both[0]) - len(both[1]))
            # What only one run meets just after the start was so there for the other: a tyre that begins to be pressed.
            at_start = lacking > 0 and longer[lacking - 1] < start + JUST_MISSED * (end - start)
            missing, most = [start if at_start else math.inf] * lacking, len(longer)
            padded = ((missing + own)[-most:] if at_start else (own + missing)[:most] for own in both)
            pairs[key] = list(zip(*padded, strict=True))
        return pairs

    @cached_property
    def parting(self) -> float:
        """From when on something switches in one of the two runs alone, or one has ended, s; infinite if never."""
        start, end = self.run.edges[[0, -1]].tolist()
        if self.parted:
            return start
        changed = [pair for (kind, _), pairs in self._pairs.items() if kind != EVENT for pair in pairs]
        alone = [min(pair) for pair in changed if math.inf in pair]
        if not self.same_end:
            alone.append(self.other.outcome.t)
        return min((t for t in alone if t < end - JUST_MISSED * (end - start)), default=math.inf)

    @cached_property
    def _apart(self) -> dict[float, float]:
        """At each time at which something happened in the run: how far the two disagree, so far, about when."""
        apart: dict[float, float] = {}
        for pairs in self._pairs.values():
            most = 0.0
            for mine, other in pairs:
                most = max(most, 0.0 if mine == other else abs(mine - other))
                apart[mine] = max(apart.get(mine, 0.0), most)
        return apart

    def time(self, t: float) -> Known:
        """A time of the run: when something happens it is known as far as the two agree on that."""
        return Known(t, SAFETY * self._apart.get(t, 0.0) if t < self.parting else math.inf, abs(t))

    @cached_property
    def _both(self) -> dict[float, float]:
        """The times of what happened in both runs."""
        return {mine: other for pairs in self._pairs.values() for mine, other in pairs if max(mine, other) < math.inf}

    def there(self, times: Array) -> Array:
        """The times in the other run: of what happens, when it happens there."""
        return np.clip([self._both.get(float(t), float(t)) for t in times], *self.other.edges[[0, -1]])

    @property
    def same_end(self) -> bool:
        """Whether both ended in the same way, unless the run was interrupted."""
        return self.run.outcome.name in (self.other.outcome.name, OutcomeKind.INTERRUPTED)

    @cached_property
    def end(self) -> Known:
        """When the run ended; nothing is claimed of an end that the other did not come to."""
        mine, other = self.run.outcome.t, self.other.outcome.t
        lost = mine >= self.parting and mine != self.run.settings.until
        apart = SAFETY * abs(mine - other) + (mine - self._unreached if self._unreached else 0.0)
        return Known(mine, math.inf if lost else apart if self.same_end else math.nan, abs(mine))

    @cached_property
    def _unreached(self) -> float | None:
        """Where a run ended because a dead position was near: a time before, since when a figure has changed at least as much as it would
        have up to there. The square of speeds grows as the time that is left falls."""
        if self.run.outcome.name not in DEAD_ENDS:
            return None
        t, length = self.run.motion.steps[-2:], np.ptp(self.run.edges)
        before, end = (self.run.motion.sample(t)[1] ** 2).sum(axis=1)
        left = before * np.ptp(t) / (end - before) if end > before else math.inf
        return float(max(t[-1] - UNREACHED * left, self.run.edges[0])) if left < NEAR_END * length else None

    @cached_property
    def changes(self) -> list[Change]:
        """The mode changes of the run: their times, losses, works of motions and sizes of impulses with the digits that hold."""
        there: dict[Any, list[Change]] = {}
        for change in reversed(self.other.changes):
            there.setdefault((change.kind, change.of), []).append(change)
        apart: dict[Any, float] = {}
        largest, known = max((abs(change.lost) for change in self.run.changes), default=0.0), []
        for change in self.run.changes:
            key, t = (change.kind, change.of), self.time(change.t)
            other = there[key].pop() if there.get(key) else None
            lost = t.error == math.inf or other is None

            def figure(of: str, mine: float, its_value: float, key: Any = key, lost: bool = lost) -> Known:
                apart[key, of] = max(apart.get((key, of), 0.0), math.inf if lost else abs(mine - its_value))
                return Known(mine, SAFETY * apart[key, of], abs(mine))

            its_sizes, its_work = (other.sizes, other.work or 0.0) if other else ({}, 0.0)
            sizes = {name: figure(f"impulse {name}", size, its_sizes.get(name, math.inf)) for name, size in change.sizes.items()}
            known.append(
                KnownChange(
                    **{field.name: getattr(change, field.name) for field in fields(change)}
                    | {"t": t, "lost": figure("lost", change.lost, other.lost if other else math.inf).beside(largest)},
                    known_work=None if change.work is None else figure("work", change.work, its_work),
                    known_sizes=sizes,
                )
            )
        return known

    # How far quantities are known

    @cached_property
    def t(self) -> Array:
        """Times (nt,) at which the two are compared: none between the two instants of one change, and none after they part."""
        start, end = self.run.edges[[0, -1]].tolist()
        t: Array = np.linspace(start, end, int(np.clip(60 * (end - start), 400, 6000)) + 1)
        t = t[(t < self.parting) & (t >= self.other.edges[0]) & (t <= self.other.edges[-1])]
        # The first comparison time that is not before each of the two instants.
        pairs = np.sort(np.array([*self._both.items()]).reshape(-1, 2))
        first, last = (np.searchsorted(t, side, side="left") for side in pairs.T)
        between = np.zeros(len(t) + 1)
        np.add.at(between, first, 1)
        np.add.at(between, last, -1)
        return t[np.cumsum(between)[:-1] == 0]

    def band(self, read: Read) -> Band:
        """How far what is read is known at ``t``."""
        mine, other = (read(run, self.t) for run in (self.run, self.other))
        size = np.fmax.accumulate(np.abs(mine))
        return Band(self.t, mine, np.fmax.accumulate(np.fmax(SAFETY * np.abs(mine - other), ROUND_OFF * size)), size)

    def at(self, read: Read, times: Array) -> Band:
        """How far it is known at any times of the run."""
        values, band = read(self.run, times), self.band(read)
        apart = np.nan_to_num(SAFETY * np.abs(values - read(self.other, self.there(times))), nan=np.inf)
        rows, none = np.searchsorted(band.t, times, side="right"), np.zeros_like(values[:1])
        error = np.fmax(apart, np.vstack([none, band.error])[rows])
        error[times >= self.parting] = np.inf
        if self._unreached is not None:
            last = times == self.run.edges[-1]
            error[last] = np.fmax(error[last], np.abs(values[last] - read(self.run, np.array([self._unreached]))))
        return Band(times, values, error, np.fmax(np.abs(values), np.vstack([none, band.size])[rows]))

    def digits(self, text: str, times: Array) -> Array:
        """How many digits (nt,) of an expression hold at times of the run."""
        known = self.at(expression(text), times)
        return np.floor(digits_of(known.error, known.size)[:, 0]).astype(int)

    def figures(self, read: Read, t: float) -> list[Known]:
        """What is read (k,) at a time of the run, with the digits that hold."""
        known = self.at(read, np.array([t]))
        return [Known(*each) for each in zip(known.values[0], known.error[0], known.size[0], strict=True)]

    def extreme(self, band: Band, column: int, mine: tuple[float, float], other: tuple[float, float]) -> tuple[Known, Known]:
        """Time and value of an extreme found in both runs, of a column of what is read. Where the two are equal and far apart, any of
        several times will do, and nothing is claimed about it."""
        (t, value), (there, its_value) = mine, other
        if self.parting < math.inf:
            return Known(t, math.inf, abs(t)), Known(value, math.inf, abs(value))
        i = max(int(np.searchsorted(band.t, t, side="right")) - 1, 0)
        error = max(float(band.error[i, column]), SAFETY * abs(value - its_value))
        if self._unreached is not None and t > self._unreached:
            error = max(error, abs(value - float(band.values[np.searchsorted(band.t, self._unreached) - 1, column])))
        either = error < NOISE * abs(value) and abs(t - there) > 2 * np.diff(self.t).max()
        return Known(t, math.nan if either else SAFETY * abs(t - there), abs(t)), Known(value, error, float(band.size[i, column]))

    # The motion as a whole

    @cached_property
    def held(self) -> Array:
        """How many digits (nt,) of all coordinates and rates hold at ``t``, not rounded."""
        band = self.band(lambda run, t: np.hstack(run.motion.sample(t)))
        units = np.array([column.unit for column in self.run.columns if column.kind in ("coordinate", "rate")])
        size, n = band.size.copy(), len(units) // 2
        # What is round-off is no motion: beside a radian, where bodies are, and the coordinate of a rate.
        far = np.abs(self.run.motion.poses(self.run.edges[[0, -1]])[..., :2]).max(initial=0.0)
        for unit, scale in (("rad", 1.0), ("m", far)):
            same = units == unit
            size[:, same] = np.maximum(size[:, same], NOISE * max(size[:, same].max(initial=0.0), scale))
        size[:, n:] = np.maximum(size[:, n:], size[:, :n] / (np.ptp(self.run.edges) or 1.0))
        return digits_of(band.error, size).min(axis=1, initial=MOST)

    def until(self, number: int) -> float:
        """Up to when so many digits hold, s: infinite if to the end, the start if never."""
        held = np.flatnonzero(self.held >= number)
        if not len(held):
            return float(self.run.edges[0])
        return math.inf if held[-1] == len(self.t) - 1 and self.parting == math.inf else float(self.t[held[-1]])

    @property
    def none_from(self) -> float | None:
        """From when on no digit holds, s; None if some do to the end."""
        return None if (t := self.until(1)) == math.inf else t

    @property
    def stated(self) -> int:
        """The number of digits that the sentence speaks of: as many as tables print, if ever so many hold."""
        return int(min(PRINTED, self.held.max(initial=0)))

    @property
    def better(self) -> tuple[float, float] | None:
        """The tolerance with which as many digits as ``stated`` would hold for longer, and up to when, s (infinite: to the end); None
        where they do, or that cannot be known. Digits are taken to be lost at the rate at which they were, and errors to be as large as
        the tolerance makes them."""
        rtol, most, end = self.run.settings.rtol, self.stated, self.run.edges[-1]
        if most < 2 or self.until(most) == math.inf or cards.methods()[self.run.settings.method].fixed_step:
            return None
        first, then = (int(np.flatnonzero(self.held >= number)[-1]) for number in (most, 1))
        if first == then:
            return None
        lost = (self.held[first] - self.held[then]) / (self.t[then] - self.t[first])
        needed = math.floor(math.log10(rtol) - (most - self.held[then]) - lost * (end - self.t[then]))
        if needed >= math.log10(TIGHTEST):
            return 10.0**needed, math.inf
        reached = float(self.t[first]) + math.log10(rtol / TIGHTEST) / lost
        return (TIGHTEST, reached) if rtol > 10 * TIGHTEST else None

    @property
    def sentence(self) -> str:
        """Until when how many digits hold, and at which tolerance more would."""
        if self.until(PRINTED) == math.inf:
            return f"holds to {int(self.held[-1])} digits"
        most = self.stated
        parts = [f"holds to {most} digits until {self.until(most):.3g} s" if most else "no digit holds"]
        if most and self.none_from is None:
            parts.append(f"to {int(self.held[-1])} at the end")
        elif most:
            parts.append(f"from {self.none_from:.3g} s on no digit holds")
        if self.parting < math.inf:
            parts.append(f"what happens from {self.parting:.6g} s on depends on the tolerance")
        if not self.same_end and self.parting == math.inf:
            parts.append("at another tolerance it does not end so")
        if self.better:
            rtol, until = self.better
            when = "to the end" if until == math.inf else f"until about {until:.2g} s"
            parts.append(f"at rtol {rtol:.0e} it would hold to {most} digits {when}")
        return "; ".join(parts)

    def to_json(self) -> dict[str, Any]:
        """As plain data: the sentence, until when 1, 2, … digits hold (null: to the end), and what the second run was."""

        def plain(t: float) -> float | None:
            return None if t == math.inf else t

        settings, better = self.other.settings, self.better
        return {
            "sentence": self.sentence,
            "until": {n: plain(self.until(n)) for n in range(1, int(self.held.max(initial=0)) + 1)},
            "none_from": self.none_from,
            "better": better and {"rtol": better[0], "digits": self.stated, "until": plain(better[1])},
            "second": {"method": settings.method, "rtol": settings.rtol, "outcome": self.other.outcome.name},
        }

    @cached_property
    def energy(self) -> dict[str, Known]:
        """What is stored and every work at the end of the run, by the words of ``Energy.entries``."""
        ledger = self.run.energy
        ends = self.figures(lambda run, t: run.motion.ledger(t)[1], float(self.run.edges[-1]))
        largest = max((entry.size for entry in ends), default=0.0)
        return {label: ends[ledger.names.index(name)].beside(largest) for label, name in ledger.labels.items()}

    # What the model asks for

    @cached_property
    def report(self) -> dict[str, Reported]:
        """The reported quantities of the run, with the digits that hold."""
        of = {
            label: item for item in self.run.source.report for label in self.run.report if label.rpartition("[")[0] == item.label
        }
        of |= {item.label: item for item in self.run.source.report if item.label in self.run.report}
        known: dict[str, Reported] = {}
        apart: dict[str, float] = {}
        for label, mine in self.run.report.items():
            item = of[label]
            known[label] = found = self._reported(item, label, mine)
            if isinstance(found.t, Known) and item.how in ("maxima", "minima"):
                # How far the two disagree about when is the most that they did so far.
                apart[item.label] = max(apart.get(item.label, 0.0), found.t.error)
                known[label] = replace(found, t=Known(found.t, apart[item.label], found.t.size))
        return known

    def _reported(self, item: ReportItem, label: str, mine: Reported) -> Reported:
        if mine.value is None:
            return mine
        over, read, unit = Window.within(self.run.edges, item.over), expression(item.value), unit_size(item.unit)
        t, value = mine.t, mine.value * unit
        other = self.other.report.get(label)
        its_value = math.inf if other is None or other.value is None else other.value * unit
        if item.how == "at":
            [known], t = self.figures(read, t), self.time(t) if t in self._apart else t
            known = Known(value, max(known.error, SAFETY * abs(value - its_value)), max(known.size, abs(value)))
        elif its_value == math.inf or over.edges[-1] >= self.parting:
            known, t = Known(value, math.inf, abs(value)), None if t is None else Known(t, math.inf, abs(t))
        elif item.how in ("max", "min", "maxima", "minima"):
            t, known = self.extreme(self.band(read), 0, (t, value), (other.t, its_value))
        else:
            known = self._integral(item.how, read, over, value, its_value)
        return replace(mine, value=Known(mine.value, known.error / unit, known.size / unit), t=t)

    def _integral(self, how: str, read: Read, over: Window, value: float, its_value: float) -> Known:
        """A mean, rms or integral over a window: it is known as far as the integrals up to any time agree."""
        t = self.t[(self.t >= over.edges[0]) & (self.t <= over.edges[-1])]
        amid = Window(t).amid  # what is singular is so at an edge of a step, which may be one of the times
        mine, other = (read(run, amid)[:, 0] ** (2 if how == "rms" else 1) for run in (self.run, self.other))
        per = {"integral": 1.0, "mean": over.length, "rms": 2 * abs(value) * over.length}[how]
        apart, size = (float(np.abs(np.cumsum(y * np.diff(t))).max(initial=0.0)) / per for y in (mine - other, mine))
        if self._unreached is not None and over.edges[-1] == self.run.edges[-1]:
            last = read(self.run, over.edges[-1:])[0, 0] ** (2 if how == "rms" else 1)
            apart = max(apart, float(abs(last)) * (over.edges[-1] - self._unreached) / per)
        return Known(value, SAFETY * max(apart, abs(value - its_value)), max(abs(value), size))


def _times(run: Run) -> dict[tuple[str, str], list[float]]:
    """When what happened, and to which part, in order of time."""
    found: dict[tuple[str, str], list[float]] = {}
    stated = [((EVENT, event.name), event.t) for event in run.events]
    stated += [((change.kind, name), change.t) for change in run.changes for name in change.of or ("",)]
    for key, t in stated:
        found.setdefault(key, []).append(t)
    return found


def expression(text: str) -> Read:
    """The values of an expression, as one column; NaN where it has no finite value."""

    def read(run: Run, t: Array) -> Array:
        values = run.motion.evaluate([text], t)
        return np.where(np.isfinite(values), values, np.nan)

    return read
