"""Claims about the model's own run, with its own numbers: figures at a moment, of its report, and what is alike in several runs."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core.compiled import BEFORE
from freebody.core.errors import NotFinite
from freebody.model.errors import ModelProblem
from freebody.model.start import quantity
from freebody.run.digits import SAFETY
from freebody.run.moments import time_of
from freebody.run.records import Array
from freebody.symbolic.evaluate import sampled

from .case import Case
from .families import AT_START, NoMotion, Samples
from .figures import ROUND, corrected_figures, figures, rounding
from .language.parser import parse
from .language.statements import Equation
from .residual import Sides, equation_sides, residual
from .stated import Correction
from .user_symbols import MOMENT, OF_START
from .verdict import Evidence, Kind, Verdict

if TYPE_CHECKING:
    from .api import Checker, Declared

_KNOWN = (
    1e-6  # part of its sides to which a run knows an equation without figures, where agreeing as closely as that says something
)
_TIMES = 60
_ALIKE = 1e-7  # spread of what is the same in several runs, relative: what the integrator leaves


def at(checker: Checker, declared: Declared, moment: str, statement: str) -> Verdict:
    """At a moment of the model's own run, with its own numbers; figures to their printed digits."""
    case, values, t = _read(checker, declared, moment, statement)
    run, _ = checker.happens.moment(moment)
    for equation in case.equations:
        with np.errstate(all="ignore"):
            sides = equation_sides(equation, values)
        if not np.isfinite(sides.residual).all():
            return Verdict(Kind.UNDECIDABLE, statement, f"at {moment} (t = {t:.6g} s) it has no value: {_figures(sides)}")
        off, allowed = np.abs(sides.residual), rounding(equation, values)
        unsure = _unsure(checker, case, equation, run, t)
        if not figures(equation) and np.all(unsure <= _KNOWN * np.maximum(np.abs(sides.left), np.abs(sides.right))):
            allowed = np.maximum(allowed, unsure)
        if np.any(unsure > allowed) and np.all(off <= allowed + unsure):
            reason = f"at {moment} (t = {t:.6g} s) {_figures(sides)}, and the run does not know it to so many digits: the motion "
            return Verdict(Kind.UNDECIDABLE, statement, reason + run.accuracy.sentence)
        if np.any(off > allowed * (1 + ROUND)):
            seen = Evidence.at(sides, values, 0, float(off.max()), 1)
            others, last = corrected_figures(equation, values)
            mends = others or _symbolically(checker, declared, moment, statement)
            reason = f"at {moment} (t = {t:.6g} s) {_figures(sides)}" + (": off in the last digit" if last else "")
            return Verdict(Kind.WRONG, statement, reason, mends=mends, evidence=seen)
    return Verdict(Kind.TRUE, statement, f"at {moment} (t = {t:.6g} s) {_figures(sides)}, as printed")


def holds_on_run(checker: Checker, declared: Declared, statement: str) -> bool:
    """Whether equations hold all along the model's own run, from the moment of which they are said to the next switch."""
    case, run = checker.case(statement, declared), checker.happens.run
    begins = max(float(run.t[0]), checker.sampler.own.t)
    ends = min((change.t for change in run.changes if change.t > begins), default=float(run.outcome.t))
    try:
        values = case.meaning.values(_OnRun(run, np.linspace(begins, ends, _TIMES)[1:-1], checker, run.evaluate))
    except NotFinite:  # a direction of what stands
        return True
    return all(np.nanmax(np.abs(residual(equation, values).ratio)) < _KNOWN**0.5 for equation in case.equations)


def _symbolically(checker: Checker, declared: Declared, event: str, statement: str) -> tuple[Correction, ...]:
    """The corrections of a statement in symbols at an event, of motions with any parameters."""
    with suppress(ModelProblem, NoMotion):
        there = checker.beside("after", event, {}) if checker.correcting else None
        return there.check(statement, declared, AT_START).mends if there else ()
    return ()


def report(checker: Checker, declared: Declared, label: str, figure: str) -> Verdict:
    """A quantity of the section ``report``, from the model's own run with its own numbers."""
    run = checker.happens.run
    if label not in run.report:
        raise ModelProblem(f"the model reports no `{label}`", f"it reports {', '.join(run.report)}")
    printed = parse(f"0 = {figure}").equations[0]
    known, said = run.accuracy.report[label].value, float(sampled(printed.right, {})[0])
    value, allowed, unsure = float(known), float(rounding(printed, {}).max()), getattr(known, "error", 0.0)
    if allowed < unsure and abs(value - said) <= allowed + unsure:
        what = f"{label} is {value:.6g} against {said:g}, and the run does not know it to so many digits: the motion "
        return Verdict(Kind.UNDECIDABLE, label, what + run.accuracy.sentence)
    kind = Kind.TRUE if abs(value - said) <= allowed * (1 + ROUND) else Kind.WRONG
    return Verdict(kind, label, f"{label} is {value:.6g} against {said:g}" + (", as printed" if kind is Kind.TRUE else ""))


def same(checker: Checker, declared: Declared, moment: str, name: str, numbers: str, expression: str) -> Verdict:
    """An expression has one value at a moment of the runs with several numbers of a parameter."""
    if name not in [*checker.mechanism.parameters]:
        raise ModelProblem(f"the model has no parameter `{name}`", f"it has {', '.join(checker.mechanism.parameters)}")
    before, found, unsure = checker.mechanism.parameters[name], {}, []
    try:
        for number in (part.strip() for part in numbers.split(",")):
            checker.mechanism.parameters[name] = number
            other = type(checker)(checker.mechanism, checker.declared)
            case, values, t = _read(other, declared, moment, f"{expression} = 0")
            found[number] = sampled(case.equations[0].left, values)[0]
            unsure.append(partial(_unsure, other, case, case.equations[0], other.happens.moment(moment)[0], t))
    finally:
        checker.mechanism.parameters[name] = before
    every = np.array(list(found.values()))
    spread = float(np.max(np.ptp(every, axis=0)) / max(float(np.abs(every).max()), 1e-300))
    if spread < _ALIKE:
        return Verdict(Kind.TRUE, expression, f"{_plain(every[0])} in all {len(every)} runs, to {spread:.0e}")
    stated = ", ".join(f"{_plain(value)} with {name} = {number}" for number, value in found.items())
    if np.ptp(every, axis=0).max() <= sum(each().max() for each in unsure):
        return Verdict(Kind.UNDECIDABLE, expression, f"at {moment} it is {stated}, and the runs do not know it to so many digits")
    return Verdict(Kind.WRONG, expression, f"at {moment} it is {stated}")


def _read(checker: Checker, declared: Declared, moment: str, statement: str) -> tuple[Case, Mapping[str, Array], float]:
    """A statement with the values of its symbols at a moment, and its time."""
    case = checker.case(statement, declared)
    run, t = checker.happens.moment(moment)
    return case, case.meaning.values(_OnRun(run, np.array([t]), checker, run.evaluate)), t


def _unsure(checker: Checker, case: Case, equation: Equation, run: Any, t: float) -> Array:
    """How far what an equation leaves over at a time is known on a run (n,): by how much that of the second run differs."""
    if t <= run.edges[0]:
        return np.zeros(1)
    if t >= run.accuracy.parting:
        return np.full(1, np.inf)

    def left(of: Any, at: Array) -> Array:
        read = lambda text, times: of.motion.evaluate([text], times)[:, 0]
        with np.errstate(all="ignore"):
            return equation_sides(equation, case.meaning.values(_OnRun(of, at, checker, read))).residual[0]

    times = np.array([t])
    return SAFETY * np.nan_to_num(np.abs(left(run, times) - left(run.accuracy.other, run.accuracy.there(times))))


def _figures(sides: Sides) -> str:
    return f"it is {_plain(sides.left[0])} against {_plain(sides.right[0])}"


def _plain(value: Any) -> str:
    return np.array2string(np.asarray(value) + 0.0, precision=6, separator=", ") if np.ndim(value) else f"{float(value):.7g}"


class _OnRun:
    """Times (nt,) of a run as samples, at which expressions are read."""

    def __init__(self, run: Any, times: Array, checker: Checker, read: Callable[[str, Array], Array]) -> None:
        self.run, self.times, self.checker, self.read = run, times, checker, read

    def values(self, texts: Any) -> dict[str, Array]:
        """Each expression, (nt,)."""
        sampler = self.checker.sampler
        gravity = re.compile(rf"(?<![\w.]){sampler.gravity}(?![\w.(])")  # which the model itself has as a number
        number = repr(sampler.free_parameters.get(sampler.gravity))
        read = {text: self._with_start(gravity.sub(number, text) if sampler.gravity else text) for text in texts}
        return {text: self.read(of, self.times) for text, of in read.items()}

    def _with_start(self, text: str) -> str:
        """An expression with numbers for what is asked of the start of the run, and of its moments."""

        def value(found: re.Match[str]) -> str:
            of, _, moment = found[1].partition(MOMENT)
            return f"({float(self.read(of, np.array([self._time(moment)]))[0])!r})"

        return OF_START.sub(value, text)

    def _time(self, moment: str) -> float:
        """When a moment is; that of the start without one."""
        name = moment.removeprefix(BEFORE)
        if not name or name[0].isdigit():
            return quantity("a moment", name, "s") if name else float(self.run.edges[0])
        t = time_of(self.run, name)
        return float(np.nextafter(t, -np.inf)) if name != moment else t

    def masses(self) -> dict[str, tuple[Array, Array]]:
        """As of the model's own numbers."""
        sampler, count = self.checker.sampler, len(self.times)
        of = Samples(sampler.core, [sampler.own]).masses()
        return {name: (np.repeat(mass, count), np.repeat(inertia, count)) for name, (mass, inertia) in of.items()}
