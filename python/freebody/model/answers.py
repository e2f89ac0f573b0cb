"""The sections ``run`` and ``report``: how long to compute, and what to say of it."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from freebody.core import BEFORE, EXTREMES, PlotItem, ReportItem, Settings, cards

from . import start, units
from .errors import ModelProblem, Path
from .names import suggestion
from .schema import Over, Question, Run
from .writer import Writer

_STATISTIC = re.compile(rf"\s*({'|'.join(EXTREMES)})\s+of\s+(.+)", re.DOTALL)
_OVER = re.compile(r"(.+?)\s+over\s+(.+?)\s*\.\.\s*(.+)", re.DOTALL)
_WORDS = ("start", "end")
_UNITS = {"until": "s", "rtol": "", "every": "s", "step": "s", "max_step": "s"}
"""Of the settings that are numbers."""
MAX_ROWS = 1_000_000
"""Rows of output, and fixed steps, that a run may be asked for."""

Moment = str | float
"""As in ``ReportItem``."""


def timed(item: ReportItem, values: Mapping[str, float]) -> ReportItem:
    """The item with its times as numbers, at these parameters. Raises ``ModelProblem``."""
    stated = lambda moment: isinstance(moment, str) and moment.startswith("=")
    time = lambda moment: start.quantity(item.label, moment[1:], "s", values) if stated(moment) else moment
    return replace(item, at=time(item.at), over=item.over and (float(time(item.over[0])), float(time(item.over[1]))))


def numbers(given: Mapping[str, Any], values: Mapping[str, float]) -> dict[str, Any]:
    """What is given of ``Settings``, its numbers worked out at these parameters. Raises ``ModelProblem``."""
    return {n: v if v is None or n not in _UNITS else start.quantity(n, v, _UNITS[n], values) for n, v in given.items()}


def fault(settings: Settings) -> tuple[str, str, str] | None:
    """The setting with which there is no run, what is wrong with it, and what to try."""
    for name, unit in _UNITS.items():
        value = getattr(settings, name)
        if value is not None and not (math.isfinite(value) and (value > 0 or (name == "until" and value == 0))):
            return name, f"`{name}` is {value:g}, and must be above 0", f"write e.g. {'`5 s` or `200 ms`' if unit else '`1e-9`'}"
    if settings.rtol >= 1:
        return "rtol", f"`rtol` is {settings.rtol:g}; a relative tolerance is below 1", f"by default it is {Settings.rtol:g}"
    method = cards.methods().get(settings.method)
    if method and method.fixed_step and settings.step is None:
        return "method", f"`{settings.method}` needs a fixed step", f"add `step: 1 ms`, or choose `{Settings.method}`"
    for name, rows in (("every", "rows"), ("step", "steps"), ("max_step", "steps")):
        if (spacing := getattr(settings, name)) and (settings.until or 0.0) / spacing > MAX_ROWS:
            what = f"`{name}: {spacing:g}` makes {settings.until / spacing:.3g} {rows} until {settings.until:g} s; at most {MAX_ROWS} are kept"
            return name, what, f"choose a larger `{name}`"
    return None


def run(write: Writer) -> dict[str, Any]:
    """What the model says of ``Settings``; some may be expressions of parameters."""
    stated = write.scope.model.run or Run()
    given = stated.model_dump(exclude_none=True)
    found = {n: write.number(("run", n), v, _UNITS[n]) if n in _UNITS else v for n, v in given.items()}
    sizes = {n: write.size(v) if n in _UNITS else v for n, v in given.items()}
    if None not in sizes.values() and (wrong := fault(Settings(**sizes))):
        write.scope.complain(("run", wrong[0]), *wrong[1:])
    return found


def report(write: Writer) -> list[ReportItem]:
    """The quantities to report, in order."""
    found: list[ReportItem] = []
    for label, asked in write.scope.model.report.items():
        path: Path = ("report", label)
        with write.scope.noting(path):
            found.append(_item(write, path, asked if isinstance(asked, Question) else _question(asked)))
    return found


def plots(write: Writer) -> list[PlotItem]:
    """The plots that are wanted, in order."""
    found: list[PlotItem] = []
    for title, asked in write.scope.model.plots.items():
        with write.scope.noting(("plots", title)):
            if isinstance(asked, Over):
                across, _ = write.measured(asked.over or asked.around)
                found.append(PlotItem(title, (write.measured(asked.of)[0],), across, asked.around is not None))
                continue
            up = [write.measured(text) for text in ([asked] if isinstance(asked, str) else asked)]
            known = [dimension for _, dimension in up if dimension is not None]
            if other := next((each for each in known if not each.fits(known[0])), None):
                what = f"the curves of one plot measure the same; here are {known[0].words()} and {other.words()}"
                raise ModelProblem(what, "make two plots of them")
            found.append(PlotItem(title, tuple(text for text, _ in up)))
    return found


def _question(text: str, unit: str | None = None) -> Question:
    """What a line like ``max of speed(P) over 1 s .. 2 s`` or ``theta @ end`` asks for."""
    if statistic := _STATISTIC.fullmatch(text):
        kind, rest = statistic.groups()
        if "@" in rest:
            raise ModelProblem(f"`{kind} of` looks at a whole run, not at a moment", "for a window write `over 1 s .. 2 s`")
        window = _OVER.fullmatch(rest)
        return Question.model_construct(**{kind: window[1] if window else rest}, over=window and window.group(2, 3), unit=unit)
    expression, sign, moment = text.rpartition("@")
    return Question.model_construct(value=expression if sign else text, at=moment.strip() if sign else None, unit=unit)


def _item(write: Writer, path: Path, asked: Question) -> ReportItem:
    kind = next(word for word in ("value", *EXTREMES) if getattr(asked, word) is not None)
    if kind == "value" and asked.at is None and ("@" in asked.value or _STATISTIC.fullmatch(asked.value)):
        return _item(write, path, _question(asked.value, asked.unit))
    expression, dimension = write.measured(getattr(asked, kind).strip())
    moment = "end" if asked.at is None else _moment(write, asked.at)
    window = None if asked.over is None else tuple(_moment(write, end) for end in asked.over)
    for end, found in zip(asked.over or (), window or (), strict=True):
        if isinstance(found, str) and not found.startswith("="):
            raise ModelProblem(f"a window goes from one time to another, and `{end}` is none", "write e.g. `over 1 s .. 2 s`")
    own = units.TIME if expression == "t" else dimension
    own = own.times(units.TIME) if own and kind == "integral" else own
    wanted = None if asked.unit is None else units.unit(asked.unit).dimension
    if wanted is not None and own is not None and not own.fits(wanted):
        hint = f"write e.g. `unit: {own.unit()}`" if own.unit() else "leave the unit out"
        what = f"the value is {own.words()}; `{asked.unit}` is the unit of {wanted.words()}"
        write.scope.complain((*path, "unit"), what, hint)
    return ReportItem(str(path[1]), expression, "at" if kind == "value" else kind, moment, window, asked.unit or "")


def _moment(write: Writer, moment: Any) -> Moment:
    if not isinstance(moment, str):
        return float(moment)
    if moment in _WORDS:
        return moment
    before = BEFORE if moment.startswith(BEFORE) else ""
    for name, prefix in ((moment, ""), (moment.removeprefix(before).strip(), before)):
        if (event := write.full(name)) in write.meanings.events:
            return prefix + event
    try:
        number, dimension = write.number_of(moment)
    except ModelProblem:
        events = write.meanings.seen_from(write.scope, write.meanings.events)
        hint = suggestion(moment, [*events, *_WORDS]) + "; or a time like `0.3 s`"
        raise ModelProblem(f"`{moment}` is no moment", hint) from None
    if dimension is not None and not dimension.fits(units.TIME):
        raise ModelProblem(f"a moment is a time (s); `{moment}` is {dimension.words()}", "write e.g. `@ 0.3 s`")
    return number if isinstance(number, float) else f"={number}"
