"""The sections ``run`` and ``report``: how long to compute, and what to say of it."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from freebody.core import BEFORE, ReportItem, cards
from freebody.symbolic.dimensions import Dimension

from . import start, units
from .errors import ModelProblem, Path
from .names import suggestion
from .schema import EXTREMES, Question
from .writer import Number, Writer

_STATISTIC = re.compile(rf"\s*({'|'.join(EXTREMES)})\s+of\s+(.+)", re.DOTALL)
_OVER = re.compile(r"(.+?)\s+over\s+(.+?)\s*\.\.\s*(.+)", re.DOTALL)
_WORDS = ("start", "end")

Moment = str | float
"""``start``, ``end``, the name of an event, ``before`` and such a name, a time in s, or an expression of parameters for one, marked by ``=``."""


@dataclass(frozen=True)
class Asked:
    """A quantity to report before parameters are known; see ``ReportItem``."""

    label: str
    value: str
    how: str = "at"
    at: Moment = "end"
    over: tuple[Moment, Moment] | None = None
    unit: str = ""

    def with_parameters(self, values: Mapping[str, float]) -> ReportItem:
        """The item with times as numbers. Raises ``ModelProblem``."""
        over = None if self.over is None else (float(_time(self.over[0], values)), float(_time(self.over[1], values)))
        return ReportItem(self.label, self.value, self.how, _time(self.at, values), over, self.unit)


@dataclass(frozen=True)
class Run:
    """Settings of a run, None where the model does not say; before parameters are known some may be expressions of them."""

    until: Number | None = None
    method: str = next(iter(cards.methods()))
    rtol: Number = 1e-9
    every: Number | None = None
    max_step: Number | None = None
    step: Number | None = None
    impacts: str = "stop"
    painleve: str = "stop"

    def with_parameters(self, values: Mapping[str, float]) -> Run:
        """The settings as numbers. Raises ``ModelProblem``."""
        numbers = {name: getattr(self, name) for name in ("until", "rtol", "every", "max_step", "step")}
        return replace(self, **{n: None if v is None else start.evaluate(v, values) for n, v in numbers.items()})


def _time(moment: Moment, values: Mapping[str, float]) -> Moment:
    """A time as a number; the names of moments stay. Times that are expressions are marked by ``=``."""
    return start.evaluate(moment[1:], values) if isinstance(moment, str) and moment.startswith("=") else moment


class AnswerWriter:
    """Reads ``run`` and ``report`` of the whole model."""

    def __init__(self, write: Writer) -> None:
        self.write = write
        self.model = write.scope.model

    def run(self) -> Run:
        """The settings."""
        run = self.model.run
        if run is None:
            return Run()
        units_of = {"until": "s", "every": "s", "max_step": "s", "step": "s", "rtol": ""}
        given = {n: getattr(run, n) for n in units_of if getattr(run, n) is not None}
        found: dict[str, Any] = {n: self.write.number(("run", n), v, units_of[n], f"`{n}`") for n, v in given.items()}
        if cards.methods()[run.method].fixed_step and run.step is None:
            hint = f"add `step: 1 ms`, or choose `{Run.method}`"
            self.write.scope.complain(("run", "method"), f"`{run.method}` needs a fixed step", hint)
        return Run(method=run.method, impacts=run.impacts, painleve=run.painleve, **found)

    def report(self) -> list[Asked]:
        """The quantities to report, in order."""
        found: list[Asked] = []
        for label, asked in self.model.report.items():
            path: Path = ("report", label)
            try:
                found.append(self._mapping(path, asked) if isinstance(asked, Question) else self._text(path, asked))
            except ModelProblem as complaint:
                self.write.scope.complain(path, complaint.what, complaint.hint)
        return found

    def _text(self, path: Path, text: str, unit: str | None = None) -> Asked:
        if statistic := _STATISTIC.fullmatch(text):
            kind, rest = statistic.groups()
            window = _OVER.fullmatch(rest)
            if "@" in rest:
                raise ModelProblem(f"`{kind} of` looks at a whole run, not at a moment", "for a window write `over 1 s .. 2 s`")
            return self._item(path, kind, window[1] if window else rest, None, window.group(2, 3) if window else None, unit)
        expression, sign, moment = text.rpartition("@")
        return self._item(path, "value", expression if sign else text, moment.strip() if sign else None, None, unit)

    def _mapping(self, path: Path, asked: Question) -> Asked:
        kind = next(word for word in ("value", *EXTREMES) if getattr(asked, word) is not None)
        text = getattr(asked, kind)
        if kind == "value" and asked.at is None:
            return self._text(path, text, asked.unit)
        return self._item(path, kind, text, asked.at, asked.over, asked.unit)

    def _item(self, path: Path, kind: str, text: str, at: Any, over: Sequence[Any] | None, unit: str | None) -> Asked:
        expression, dimension = self.write.measured(text.strip())
        moment = "end" if at is None else self._moment(at)
        window = None if over is None else (self._window_end(over[0]), self._window_end(over[1]))
        if unit is not None:
            self._check_unit(path, unit, self._dimension(kind, units.TIME if expression == "t" else dimension))
        return Asked(str(path[1]), expression, "at" if kind == "value" else kind, moment, window, unit or "")

    def _check_unit(self, path: Path, unit: str, own: Dimension | None) -> None:
        _, dimension = units.convert(unit)
        if own is not None and not own.fits(dimension):
            what = f"the value is {own.words()}; `{unit}` is the unit of {dimension.words()}"
            self.write.scope.complain(
                (*path, "unit"), what, f"write e.g. `unit: {own.unit()}`" if own.unit() else "leave the unit out"
            )

    def _window_end(self, moment: Any) -> Moment:
        found = self._moment(moment)
        if isinstance(found, str) and not found.startswith("="):
            raise ModelProblem(f"a window goes from one time to another, and `{moment}` is none", "write e.g. `over 1 s .. 2 s`")
        return found

    def _dimension(self, kind: str, dimension: Dimension | None) -> Dimension | None:
        return dimension.times(units.TIME) if dimension and kind == "integral" else dimension

    def _moment(self, moment: Any) -> Moment:
        if not isinstance(moment, str):
            return float(moment)
        full = self.write.full(moment)
        if moment in _WORDS or full in self.write.meanings.events:
            return moment if moment in _WORDS else full
        event = self.write.full(moment.removeprefix(BEFORE).strip())
        if moment.startswith(BEFORE) and event in self.write.meanings.events:
            return BEFORE + event
        try:
            number, dimension = self.write.number_of(moment)
        except ModelProblem:
            events = self.write.meanings.seen_from(self.write.scope, self.write.meanings.events)
            raise ModelProblem(
                f"`{moment}` is no moment", suggestion(moment, [*events, *_WORDS]) + "; or a time like `0.3 s`"
            ) from None
        if dimension is not None and not dimension.fits(units.TIME):
            raise ModelProblem(f"a moment is a time (s); `{moment}` is {dimension.words()}", "write e.g. `@ 0.3 s`")
        return number if isinstance(number, float) else f"={number}"
