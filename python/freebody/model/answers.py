"""The sections ``run`` and ``report``: how long to compute, and what to say of it."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from freebody.core import BEFORE, ReportItem, Settings, cards

from . import start, units
from .errors import ModelProblem, Path
from .names import suggestion
from .schema import EXTREMES, Question, Run
from .writer import Writer

_STATISTIC = re.compile(rf"\s*({'|'.join(EXTREMES)})\s+of\s+(.+)", re.DOTALL)
_OVER = re.compile(r"(.+?)\s+over\s+(.+?)\s*\.\.\s*(.+)", re.DOTALL)
_WORDS = ("start", "end")

Moment = str | float
"""As in ``ReportItem``."""


def timed(item: ReportItem, values: Mapping[str, float]) -> ReportItem:
    """The item with its times as numbers, at these parameters. Raises ``ModelProblem``."""
    time = lambda moment: start.evaluate(moment[1:], values) if isinstance(moment, str) and moment.startswith("=") else moment
    return replace(item, at=time(item.at), over=item.over and (float(time(item.over[0])), float(time(item.over[1]))))


@dataclass
class AnswerWriter:
    """Reads ``run`` and ``report`` of the whole model."""

    write: Writer

    def run(self) -> dict[str, Any]:
        """What the model says of ``Settings``; some may be expressions of parameters."""
        run, write = self.write.scope.model.run or Run(), self.write
        units_of = {"until": "s", "every": "s", "max_step": "s", "step": "s", "rtol": ""}
        given = run.model_dump(exclude_none=True)
        if cards.methods()[run.method].fixed_step and run.step is None:
            hint = f"add `step: 1 ms`, or choose `{Settings.method}`"
            write.scope.complain(("run", "method"), f"`{run.method}` needs a fixed step", hint)
        return {n: write.number(("run", n), v, units_of[n], f"`{n}`") if n in units_of else v for n, v in given.items()}

    def report(self) -> list[ReportItem]:
        """The quantities to report, in order."""
        found: list[ReportItem] = []
        for label, asked in self.write.scope.model.report.items():
            path: Path = ("report", label)
            try:
                found.append(self._mapping(path, asked) if isinstance(asked, Question) else self._text(path, asked))
            except ModelProblem as complaint:
                self.write.scope.complain(path, complaint.what, complaint.hint)
        return found

    def _text(self, path: Path, text: str, unit: str | None = None) -> ReportItem:
        if statistic := _STATISTIC.fullmatch(text):
            kind, rest = statistic.groups()
            window = _OVER.fullmatch(rest)
            if "@" in rest:
                raise ModelProblem(f"`{kind} of` looks at a whole run, not at a moment", "for a window write `over 1 s .. 2 s`")
            return self._item(path, kind, window[1] if window else rest, None, window.group(2, 3) if window else None, unit)
        expression, sign, moment = text.rpartition("@")
        return self._item(path, "value", expression if sign else text, moment.strip() if sign else None, None, unit)

    def _mapping(self, path: Path, asked: Question) -> ReportItem:
        kind = next(word for word in ("value", *EXTREMES) if getattr(asked, word) is not None)
        text = getattr(asked, kind)
        if kind == "value" and asked.at is None:
            return self._text(path, text, asked.unit)
        return self._item(path, kind, text, asked.at, asked.over, asked.unit)

    def _item(self, path: Path, kind: str, text: str, at: Any, over: Sequence[Any] | None, unit: str | None) -> ReportItem:
        expression, dimension = self.write.measured(text.strip())
        moment = "end" if at is None else self._moment(at)
        window = None if over is None else (self._window_end(over[0]), self._window_end(over[1]))
        own = units.TIME if expression == "t" else dimension
        own = own.times(units.TIME) if own and kind == "integral" else own
        asked = None if unit is None else units.convert(unit)[1]
        if asked is not None and own is not None and not own.fits(asked):
            hint = f"write e.g. `unit: {own.unit()}`" if own.unit() else "leave the unit out"
            what = f"the value is {own.words()}; `{unit}` is the unit of {asked.words()}"
            self.write.scope.complain((*path, "unit"), what, hint)
        return ReportItem(str(path[1]), expression, "at" if kind == "value" else kind, moment, window, unit or "")

    def _window_end(self, moment: Any) -> Moment:
        found = self._moment(moment)
        if isinstance(found, str) and not found.startswith("="):
            raise ModelProblem(f"a window goes from one time to another, and `{moment}` is none", "write e.g. `over 1 s .. 2 s`")
        return found

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
