"""A simulation and what can be asked of it."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import (
    BEFORE,
    Change,
    CompiledModel,
    Indeterminate,
    ModelError,
    Motion,
    NotFinite,
    OutcomeKind,
    ReportItem,
    Settings,
    State,
)
from freebody.run import selection, storage
from freebody.run.digits import Accuracy, expression, other_settings, other_start
from freebody.run.passages import passages
from freebody.run.peaks import Peak, known_peaks
from freebody.run.progress import Progress, reporting
from freebody.run.records import (
    KINDS,
    Array,
    Column,
    Energy,
    Reported,
    Signal,
    Window,
    columns_of,
    expression_of_entry,
    over_time,
    quote,
    reduce,
    unit_of,
)
from freebody.run.sampling import Times, check_size, output_times
from freebody.run.tipping import worded_changes
from freebody.solve.instant import Instant, Reaction, Reactions, refuse
from freebody.solve.rich_tables import PlainText, table

if TYPE_CHECKING:
    import pandas
    import xarray


MAX_STEPS = 1_000_000
AS_LONG, SHORT_RUN = 20, 10_000
"""Times the steps of a run that the second one may take, and steps that it always may."""


def simulate(
    source: CompiledModel,
    start: State,
    settings: Settings,
    t_eval: Times | None = None,
    progress: Progress | bool | None = None,
    max_steps: int = MAX_STEPS,
) -> Run:
    """The motion from a state. ``t_eval`` fixes the output times; neither it nor ``every`` changes the steps. ``progress`` is ``True`` for a bar
    (tqdm), or a function that is told the time reached (s) and ends the run by returning False."""
    if settings.every or t_eval is not None:
        check_size(len(columns_of(source, ())), settings, start.t, t_eval)
    options = {key: value for key, value in vars(settings).items() if key != "every"}
    with reporting(progress, settings.until) as progress:
        trajectory = source.simulate(start, progress=progress, max_steps=max_steps, **options)
    later = partial(output_times, trajectory, settings.every)
    return Run(source, start, settings, trajectory, later if t_eval is None else output_times(trajectory, t_eval=t_eval))


@dataclass(eq=False, repr=False)
class Run(PlainText):
    """Results of a simulation, on the output times ``t`` (nt,) in s and, by ``evaluate``, at any time within it.

    ``next`` is the run of the model to which this one handed over, if it did. ``previous`` is the run that this one continues, and
    ``resume`` continues any like that in the same way with other settings.
    """

    source: CompiledModel
    start: State
    settings: Settings
    motion: Motion
    grid: Array | Callable[[], Array]
    next: Run | None = None
    previous: Run | None = None
    resume: Callable[[Run, Settings], Run] | None = None

    def __post_init__(self) -> None:
        self.metadata = self.source.metadata
        self.name = self.source.name
        self.outcome = self.motion.outcome
        """How the run ended."""
        self.events = self.motion.events
        """What happened, in order of time."""

    def __repr__(self) -> str:
        return f"<run of {self.name!r} to t = {self.end.t:g} s: {self.outcome.sentence}>"

    def __rich_console__(self, console: Any, options: Any) -> Iterator[Any]:
        """How it ended, what the model reports, and what each coordinate did."""
        yield "\n".join([str(self), *self.passages])
        shown = zip(self.metadata["coordinates"], self.q.T, strict=True) if len(self.t) else ()
        rows = [(c["name"], c["dimension"], *map(float, (q[0], q[-1], q.min(), q.max()))) for c, q in shown]
        yield table("coordinates", ["", "unit", "at the start", "at the end", "least", "largest"], rows)

    def _ipython_key_completions_(self) -> list[str]:
        """What is offered for ``run[…]``, of all that may stand there: its columns and the paths of points."""
        return ["t", *(column.name for column in self.columns), *self.points]

    @cached_property
    def t(self) -> Array:
        """The output times (nt,), s; made when they are first asked for."""
        return self.grid() if callable(self.grid) else self.grid

    # What happened

    @cached_property
    def changes(self) -> list[Change]:
        """Everything that switched, in order of time: impacts, contacts that open and close, strings, friction, released parts."""
        return worded_changes(self)

    @property
    def impacts(self) -> list[Change]:
        """The changes with impulses."""
        return [change for change in self.changes if change.impulses]

    @property
    def stats(self) -> dict[str, Any]:
        """What it took: accepted and rejected steps, evaluations, the worst gap of a loop."""
        return self.motion.stats

    # The motion

    @property
    def q(self) -> Array:
        """Coordinates (nt, n), m or rad."""
        return self._sampled[0]

    @property
    def u(self) -> Array:
        """Rates (nt, n), m/s or rad/s."""
        return self._sampled[1]

    @cached_property
    def accelerations(self) -> Array:
        """Second time derivatives of the coordinates (nt, n), solved again at each time."""
        texts = [f"accel({quote(name)})" for name in self.coordinates]
        return self.motion.evaluate(texts, self.t) if texts else np.empty((len(self.t), 0))

    @cached_property
    def dependent(self) -> Array:
        """Coordinates that follow from others (nt, 3 k): their values, then their rates, then their accelerations."""
        return self._read("dependent")

    @cached_property
    def poses(self) -> Array:
        """Frame origin x, y (m) and angle (rad) of every body (nt, nb, 3)."""
        return self.motion.poses(self.t)

    @property
    def coordinates(self) -> list[str]:
        """Names of the coordinates, in the order of ``q``."""
        return [c["name"] for c in self.metadata["coordinates"]]

    @property
    def bodies(self) -> list[str]:
        """Names of the bodies, in the order of ``poses``."""
        return [b["name"] for b in self.metadata["bodies"]]

    @cached_property
    def points(self) -> dict[str, tuple[str, float, float]]:
        """Named points: body, x and y in its frame (m)."""
        return self.source.points(self.start.p)

    def point(self, name: str) -> Array:
        """Path of a named point (nt, 2) in the fixed axes, m."""
        body, x, y = self.points[name]
        if body == "ground":
            return np.tile([x, y], (len(self.t), 1))
        px, py, angle = self.poses[:, self.bodies.index(body)].T
        return np.column_stack([px + x * np.cos(angle) - y * np.sin(angle), py + x * np.sin(angle) + y * np.cos(angle)])

    # Forces and energy

    @cached_property
    def reactions(self) -> Reactions:
        """Reaction of every joint over ``t``, on its second body unless ``.on(body)`` says otherwise."""
        made = {}
        for i, joint in enumerate(self.metadata["joints"]):
            values = self._reactions[:, i]
            least, evaluate = partial(self._least, i), partial(self.motion.evaluate, times=self.t)
            made[joint["name"]] = Reaction.of(joint, values, ~np.isnan(values), least, evaluate)
        return Reactions(made)

    @cached_property
    def closely(self) -> Run:
        """The same run on output times of which every step has some, so that between two of them everything is simple."""
        return self if self.recorded else self.at(Window(self.edges).samples(least=3))

    @cached_property
    def peaks(self) -> list[Peak]:
        """The largest load of each joint, contact, string, stop, lock and prescribed motion, with the digits that hold."""
        return known_peaks(self)

    @cached_property
    def passages(self) -> list[str]:
        """What is worth saying of points that go through a line without a contact there."""
        return passages(self)

    @cached_property
    def energy(self) -> Energy:
        """The energy ledger over ``t``."""
        names, values = self.motion.ledger(self.t)
        return Energy(self.t, tuple(names), values)

    @cached_property
    def _own_entries(self) -> list[str]:
        """The entries of the energy ledger that no expression gives."""
        return [name for name in self.motion.ledger(self.t[:0])[0] if not expression_of_entry(name, self.metadata)]

    # Anything by name

    def __getitem__(self, name: str) -> Array:
        """Values over ``t`` of a column, a point's path (nt, 2), or any expression."""
        if name == "t":
            return self.t
        if name in self._own_entries:
            return self.energy[name]
        return self.point(name) if name in self.points else np.asarray(self.evaluate(name))

    def evaluate(self, text: str, t: float | Times | None = None) -> Any:
        """Values of an expression at times within the run (default ``t``); a single time gives a single number.

        Raises ``Indeterminate`` for an expression that reads a reaction that is not determined, ``NotFinite`` where at one of the
        times it has no finite value.
        """
        times = np.ascontiguousarray(self.t if t is None else t, float)
        values = self.motion.evaluate([text], times)[:, 0]
        if (missing := times[~np.isfinite(values)]).size:
            refuse(text, missing[0], self.metadata, lambda texts: self.motion.evaluate(texts, missing[:1]))
        return float(values[0]) if np.isscalar(t) else values

    def instant(self, t: float, route: str = "minimal") -> Instant:
        """The whole instant at a time within the run, with what is in place and holds then."""
        if self.recorded:
            raise LookupError("a run from a file holds no whole instants; run.again() simulates it anew and knows all")
        return Instant(self.source, self.motion.state(t), route)

    def before(self, text: str, t: float) -> float:
        """The value of an expression just before a time, at which something may switch."""
        if t > self.edges[0]:
            return self.evaluate(text, float(np.nextafter(t, -np.inf)))
        value = float(self.source.evaluate([text], self.start)[0])
        if not math.isfinite(value):
            refuse(text, self.start.t, self.metadata, lambda texts: self.source.evaluate(texts, self.start))
        return value

    @cached_property
    def report(self) -> dict[str, Reported]:
        """The quantities that the model asks for, by label."""
        if isinstance(self.motion, storage.Recorded):
            return dict(self.motion.header.report)
        found: dict[str, Reported] = {}
        for item in self.source.report:
            try:
                found |= self.reported(item)
            except (Indeterminate, NotFinite) as error:
                found[item.label] = Reported(None, "", note=str(error))
        return found

    def unit_of(self, text: str) -> str:
        """The SI unit of an expression; empty for a plain number, and where bare numbers in it leave the unit open."""
        return unit_of(text, self.columns, self.metadata)

    def reported(self, item: ReportItem) -> dict[str, Reported]:
        """One such quantity, by its label; all local extremes as ``label[1]``, ``label[2]`` …. Raises as ``evaluate`` does."""
        si = self.unit_of(item.value)
        if item.how != "at":
            window, own = Window.within(self.edges, item.over), over_time(si) if item.how == "integral" else si
            with np.errstate(over="ignore", invalid="ignore"):
                found = reduce(item.how, lambda t: self.evaluate(item.value, t), window, self._rate(item.value))
            if not all(math.isfinite(value) for _, value in found):
                raise NotFinite(f"{item.how} of {item.value!r} has no finite value")
            figures = [Reported.of(item, value, when, own) for when, value in found]
            if item.how not in ("maxima", "minima"):
                return {item.label: figures[0]}
            numbered = {f"{item.label}[{i}]": figure for i, figure in enumerate(figures, 1)}
            return numbered or {item.label: Reported(None, "", note=f"there are no {item.how}")}
        at, before = (item.at[len(BEFORE) :], True) if str(item.at).startswith(BEFORE) else (item.at, False)
        if at in ("start", "end"):
            moments = [float(self.edges[0 if at == "start" else -1])]
        elif isinstance(at, str):
            moments = [event.t for event in self.events if event.name == at]
        else:
            moments = [float(at)] if self.edges[0] <= at <= self.edges[-1] else []
        if not moments:
            return {item.label: Reported(None, "", note=f"{at} did not happen")}
        note = ", ".join(["just before"] * before + [f"the first of {len(moments)}"] * (len(moments) > 1))
        value = (self.before if before else self.evaluate)(item.value, moments[0])
        return {item.label: Reported.of(item, value, moments[0], si, note)}

    def _rate(self, text: str) -> Signal | None:
        """The time derivative of an expression of the configuration, NaN where there is none; None for any other."""
        read = expression(f"rate({text})")
        try:
            read(self, self.edges[:1])
        except ModelError:
            return None
        return lambda t: read(self, t)[:, 0]

    @cached_property
    def edges(self) -> Array:
        """Times (…,) at which steps and events end: between them the motion is smooth."""
        return np.union1d(self.motion.steps, [*(event.t for event in self.events), *self.jumps])

    @cached_property
    def jumps(self) -> Array:
        """Times (…,) at which something switched after the start, within the run: rates and forces may jump there."""
        first, last = self.motion.steps[0], self.motion.steps[-1]
        return np.unique([change.t for change in self.changes if first < change.t <= last])

    # How far it can be trusted

    @cached_property
    def accuracy(self) -> Accuracy:
        """This run beside the same motion followed once more at another tolerance, which it does when first asked.

        Raises ``LookupError`` for a run from a file."""
        if self.recorded:
            raise LookupError("a run from a file does not know which digits hold; run.again() simulates it anew and does")
        length = self.end.t - self.start.t
        settings = other_settings(self.settings, length)
        if not self.outcome.ok and length > 0:
            beyond = 0.0 if self.outcome.name is OutcomeKind.INTERRUPTED else length
            settings = replace(settings, until=min(self.settings.until, self.end.t + beyond))
        if not (self.previous and self.resume):
            taken = self.stats["accepted"] + self.stats["rejected"]
            most = min(MAX_STEPS, AS_LONG * taken + SHORT_RUN)
            return Accuracy(self, simulate(self.source, other_start(self.start), settings, max_steps=most))
        before = self.previous.accuracy
        if before.parting < math.inf:
            return Accuracy(self, self, parted=True)
        return Accuracy(self, self.resume(before.other, settings))

    def digits(self, text: str, t: float | Times | None = None) -> Any:
        """How many digits of an expression hold at times within the run (default ``t``), of its largest size so far; a single time
        gives a single number. See ``accuracy``."""
        self.evaluate(text, t)
        held = self.accuracy.digits(text, np.ascontiguousarray(self.t if t is None else t, float))
        return int(held[0]) if np.isscalar(t) else held

    # As a table

    @cached_property
    def columns(self) -> list[Column]:
        """Everything that is kept over ``t``, in the order of ``blocks``."""
        return columns_of(self.source, self.motion.ledger(self.t[:0])[0])

    @property
    def blocks(self) -> dict[str, Array]:
        """Values of the columns by kind, each (nt, k); an indeterminate reaction is NaN."""
        nt = len(self.t)
        own = (self.q, self.u, self.accelerations, self.dependent)
        arrays = (*own, self._reactions, self._limits, self.energy.values, self.poses)
        return {kind: array.reshape(nt, -1) for kind, array in zip(KINDS, arrays, strict=True)}

    def to_xarray(self) -> xarray.Dataset:
        """An xarray Dataset with time, coordinate, joint, ledger and body as dimensions."""
        return storage.to_xarray(self)

    def to_pandas(self, *names: str) -> pandas.DataFrame:
        """A pandas table, one row a time and one column each of ``columns``; indeterminate reactions are NaN. ``names`` choose others:
        columns, expressions, and points as their x and y, with units in their heads, those of ``fb.units``."""
        return storage.to_pandas(self, *names)

    def save(self, path: str | Path, *names: str) -> Path:
        """Write ``.nc`` (netCDF) or ``.csv``, with the model, the settings and the versions inside; with ``names`` a plain table of
        these in CSV, as ``to_pandas`` has them, or the paths of points as outlines in SVG, in mm and true to size."""
        return selection.save(self, Path(path), names) if names else storage.save(self, Path(path))

    @staticmethod
    def load(path: str | Path) -> Run:
        """A run from a file. It knows its saved times; ``again()`` knows all."""
        source, motion = storage.load(Path(path))
        return Run(source, motion.header.start, motion.header.settings, motion, motion.saved_times)

    # On from here

    @property
    def recorded(self) -> bool:
        """Whether the run comes from a file and is known at its saved times only."""
        return isinstance(self.motion, storage.Recorded)

    @property
    def end(self) -> State:
        """The state at the end, enough to continue from."""
        return self.motion.end

    def continue_(self, until: float, progress: Progress | bool | None = None) -> Run:
        """The motion from the end of this run on, with what is in place then; ``progress`` as in ``simulate``. Works and the ledger start anew.

        Raises ``ValueError`` for a run from a file on whose way parts were released or engaged: the file does not hold them.
        """
        if self.recorded and any(change.kind in ("released", "engaged") for change in self.changes):
            raise ValueError("a saved run does not know what its events released and engaged\n  simulate again, to the later end")
        later = simulate(self.source, self.end, replace(self.settings, until=until), progress=progress)
        if not self.recorded:
            later.previous, later.resume = self, lambda run, settings: simulate(run.source, run.end, settings)
        return later

    def at(self, times: Times) -> Run:
        """The same run on other output times."""
        other = replace(self, grid=np.ascontiguousarray(times, float))
        if "accuracy" in vars(self):
            other.accuracy = self.accuracy
        return other

    def again(self) -> Run:
        """The same simulation once more, with the same output times."""
        return simulate(self.source, self.start, self.settings, t_eval=self.t)

    def __str__(self) -> str:
        lines = [f"{self.name}: {self.outcome.sentence}"]
        lines += [f"  {event.name} at t = {event.t:.6g} s" for event in self.events]
        if kinds := Counter(change.kind for change in self.changes):
            lines.append("  mode changes: " + ", ".join(f"{count} × {kind}" for kind, count in kinds.items()))
        lines += [f"  {label}: {value}" for label, value in self.report.items()]
        return "\n".join(lines)

    # Inside

    @cached_property
    def _sampled(self) -> tuple[Array, Array]:
        return self.motion.sample(self.t)

    @cached_property
    def _reactions(self) -> Array:
        return self.motion.reactions(self.t)

    @cached_property
    def _limits(self) -> Array:
        return self._read("limit")

    def _read(self, kind: str) -> Array:
        texts = [column.name for column in columns_of(self.source, ()) if column.kind == kind]
        return self.motion.evaluate(texts, self.t) if texts else np.empty((len(self.t), 0))

    def _least(self, i: int) -> Array:
        if self.recorded and not np.array_equal(self.end.p, self.start.p):
            raise ValueError("an event changed parameters during this run, and the file does not hold which: simulate it again")
        return np.array([self.source.instant(self.motion.state(t)).least_reactions for t in self.t.tolist()])[:, i]
