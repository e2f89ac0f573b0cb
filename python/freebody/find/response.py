"""A quantity of the motion as a function of a parameter or of an initial value."""

from __future__ import annotations

import copy
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any

from freebody.core import BEFORE, Indeterminate, ModelError, MotionError, NotFinite, Settings
from freebody.model.errors import ModelFileError, ModelProblem
from freebody.model.names import suggestion
from freebody.model.start import quantity
from freebody.run.records import columns_of, over_time, unit_of, unit_size
from freebody.solve.figures import Known

if TYPE_CHECKING:
    from freebody.model.builder import Builder
    from freebody.run.records import Reported
    from freebody.run.simulation import Run
    from freebody.solve.instant import Instant

_NO_VALUE = (MotionError, ModelError, ModelFileError, ModelProblem, Indeterminate, NotFinite)
_ROUND_OFF = 1e-13
"""Of what is read of one instant, relative."""


@dataclass(frozen=True)
class Sample:
    """The quantity ``y`` (SI) at one place ``x``: NaN where it has no value, and ``why``. ``story`` is what happened on the way to it:
    events and mode changes in order."""

    x: float
    y: float
    story: tuple[str, ...] = ()
    why: str = ""

    @property
    def is_known(self) -> bool:
        """Whether the quantity has a value here."""
        return not math.isnan(self.y)


@dataclass(eq=False)
class Response:
    """The quantity ``of`` a line of a report (``theta @ 1 s``, ``max of A.Fx``, or a label of the model's own report) over what is
    ``varied``: a parameter, a coordinate of the start, or its ``rate(…)``. ``changes`` and settings are those of ``simulate``.

    Raises ``ModelFileError`` and ``ModelProblem`` for words that mean nothing."""

    mechanism: Builder
    of: str
    varied: str
    changes: Mapping[str, Any] = field(default_factory=dict)
    samples: dict[float, Sample] = field(default_factory=dict)

    def __post_init__(self) -> None:
        asked = self.mechanism.model.report.get(self.of, self.of)
        self.mechanism = copy.copy(self.mechanism)
        self.mechanism.model = self.mechanism.model.model_copy(update={"report": {self.of: asked}})
        self.mechanism._lowered = None
        start = self.mechanism.lowered().start
        (self.item,) = self.mechanism.report_items()
        if self.item.how in ("maxima", "minima"):
            raise ModelProblem(f"`{self.of}` is several figures", f"write `{self.item.how[:3]} of …`")
        self.coordinate = self.varied.removeprefix("rate(").removesuffix(")") if self.varied.startswith("rate(") else ""
        known = {**start.parameters, **start.coordinates}
        if (self.coordinate or self.varied) not in (start.coordinates if self.coordinate else known):
            hint = suggestion(self.coordinate or self.varied, known, "parameters and coordinates")
            raise ModelProblem(f"`{self.varied}` is no parameter, coordinate or `rate(coordinate)`", hint)
        dimension = known[self.coordinate or self.varied]
        unit = dimension.unit() if dimension else "rad" if self.varied in start.angles else ""
        self.unit = f"{unit}/s" if self.coordinate else unit

    def place(self, value: Any) -> float:
        """A value of what is varied in SI, from a number or a quantity like ``"30 deg"``."""
        return quantity(self.varied, value, self.unit)

    def target(self, value: Any) -> float:
        """A value of the quantity in SI, from a number or a quantity like ``"2 ft"``."""
        return quantity(self.of, value, self.quantity_unit) if isinstance(value, str) else float(value)

    @property
    def quantity_unit(self) -> str:
        """The SI unit of the quantity; empty for a plain number, and where bare numbers leave it open."""
        source = self.mechanism.source()
        unit = unit_of(self.item.value, columns_of(source, ()), source.metadata)
        return over_time(unit) if self.item.how == "integral" else unit

    def __call__(self, x: float) -> Sample:
        """The quantity at a place, by a run of its own, or by the start alone where that is enough."""
        if x not in self.samples:
            self.samples[x] = self._sample(x)
        return self.samples[x]

    def known(self, x: float) -> Known:
        """The quantity at a place, found anew, with how far it is known. Raises what has no value there."""
        if self._at_start:
            solved = self._solved(x)
            y = solved[self.item.value]
            return Known(y, _ROUND_OFF * max(abs(y), *solved.sizes), abs(y))
        run, _ = self._reported(x)
        found = run.accuracy.report[self.item.label]
        unit = unit_size(found.unit)
        return found.value.per(1 / unit)

    @property
    def _at_start(self) -> bool:
        return self.item.how == "at" and self.item.at == "start"

    def _sample(self, x: float) -> Sample:
        try:
            if self._at_start:
                return Sample(x, self._solved(x)[self.item.value])
            run, reported = self._reported(x)
        except _NO_VALUE as error:
            return Sample(x, math.nan, why=_reason(error))
        stopped = () if run.outcome.ok else (str(run.outcome.name),)
        if reported.value is None or (stopped and self.item.at == "end"):
            return Sample(x, math.nan, (*_story(run, math.inf), *stopped), reported.note or f"the run ends by {run.outcome.name}")
        return Sample(x, reported.value * unit_size(reported.unit), _story(run, self._moment(run)))

    def _solved(self, x: float) -> Instant:
        return self.mechanism.solve(**self._changes(x, of_run=False))

    def error(self, samples: Sequence[Sample]) -> float:
        """How large the error of the quantity is, from the first, the middle and the last sample of some."""
        known = [self.known(samples[i].x).error for i in sorted({0, len(samples) // 2, len(samples) - 1})]
        return max(filter(math.isfinite, known), default=0.0)

    def _reported(self, x: float) -> tuple[Run, Reported]:
        """The run at a place, or that which it hands over to, in which the quantity has its value, and the quantity."""
        run = self.mechanism.simulate(**self._changes(x))
        while run.next and (self.item.at == "end" or run.report[self.item.label].value is None):
            run = run.next
        return run, run.report[self.item.label]

    def _changes(self, x: float, of_run: bool = True) -> dict[str, Any]:
        asked = dict(self.changes)
        if of_run and isinstance(self.item.at, (int, float)):
            asked.setdefault("until", self.item.at)
        if of_run and self.item.over:
            asked.setdefault("until", self.item.over[1])
        if not of_run:
            settings = {each.name for each in fields(Settings)}
            asked = {name: value for name, value in asked.items() if name not in settings}
        if self.coordinate:
            return asked | {"rates": {**asked.get("rates", {}), self.coordinate: x}}
        return asked | {self.varied: x}

    def _moment(self, run: Run) -> float:
        """When the quantity has its value: later it does not matter what happens."""
        if self.item.how != "at" or self.item.at == "end":
            return self.item.over[1] if self.item.over else math.inf
        if isinstance(self.item.at, str):
            name = self.item.at.removeprefix(BEFORE)
            return next(event.t for event in run.events if event.name == name)
        return self.item.at


def _story(run: Run, until: float) -> tuple[str, ...]:
    """What happened until a time, in order."""
    told = [(event.t, 0, event.name) for event in run.events if event.kind != "touch"]
    told += [(change.t, 1, " ".join([change.kind, *change.of])) for change in run.changes]
    return tuple(name for t, _, name in sorted(told) if t <= until)


def _reason(error: Exception) -> str:
    if isinstance(error, ModelFileError):
        return error.problems[0].what
    return str(getattr(error, "what", "") or error)
