"""Checking statements about one model."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from freebody.core import ModelError, MotionError
from freebody.model.errors import ModelFileError, ModelProblem
from freebody.model.start import quantity
from freebody.symbolic.errors import StatementError

from .budget import Budget
from .case import Case, StatementSymbols
from .claims import claimed
from .families import ALL, Family
from .language.dimensions import misfit
from .motion_sampler import MotionSampler
from .printed_symbols import PrintedSymbols
from .symbols import Symbols
from .verdict import Verdict, judged, of_wrong_dimensions

if TYPE_CHECKING:
    from freebody.model.builder import Builder

Declared = Mapping[str, str | Sequence[str | float]]
"""Own symbols, each an expression of the model language, components of a vector or a phrase; see ``Symbols``."""


class Checker:
    """Checks many statements about one model; its true motions are made once.

    ``letters`` are own symbols for all of them. ``seconds`` of computing are spent on a statement at most before what was found is
    answered: by default 2 up to ten bodies, 10 from twenty on. ``seed`` makes the random motions reproducible. ``asked`` tells the moment of which the
    model is spoken, ``at``, ``before`` or ``after``, and the start, ``initial``, ``t`` and changes, as in ``Mechanism.solve``.
    """

    def __init__(
        self, mechanism: Builder, letters: Declared | None = None, seed: int = 0, seconds: float | None = None, **asked: Any
    ) -> None:
        self.mechanism = mechanism
        self.declared = dict(letters or {})
        self.sampler, self.printed = MotionSampler(mechanism, seed, **asked), PrintedSymbols(mechanism, **asked)
        self.hypothesis = ALL
        self.correcting = True
        self.seconds = Budget.seconds_for(len(self.sampler.metadata["bodies"])) if seconds is None else seconds
        self.budget = Budget(self.seconds)
        self._runs: list[Any] = []  # the model's own, once it is asked for

    def symbols(self, declared: Declared | None = None) -> Symbols:
        """The symbols of the model with own ones. Raises ``ModelProblem``."""
        return Symbols(self.mechanism, {**self.declared, **(declared or {})}, self.sampler.gravity, self.printed)

    def case(self, text: str, letters: Declared | None = None, hypothesis: Family | None = None, units: bool = True) -> Case:
        """A statement beside the motions that decide about it, read with ``units`` or without. Raises ``StatementError`` and
        ``ModelProblem``."""
        known = self.symbols(letters)
        program = known.read(text, units)
        meaning = StatementSymbols(known, program, self.sampler)
        given = hypothesis or self.hypothesis
        given = replace(given, since="start") if meaning.needs_past and not given.since else given
        return Case(program, meaning, self.sampler, given, self.correcting, self.budget)

    def check(
        self, text: str, letters: Declared | None = None, hypothesis: Family | None = None, correcting: bool = True
    ) -> Verdict:
        """The verdict about an equation, several lines of them, or a claim (see docs/check.md).

        ``hypothesis``: the motions of which it is said. Without ``correcting`` it is only judged, which is quicker where it is wrong.
        Raises ``StatementError``, with the place, where it cannot be read or asks for what the model does not have.
        """
        if broken := re.search("[\ud800-\udfff]", text):  # half of a character, as a damaged file has it
            shown = text.encode(errors="replace").decode()
            raise StatementError("this is no character", broken.span(), "write it again", shown)
        checker = copy(self)
        checker.hypothesis, checker.correcting = hypothesis or self.hypothesis, correcting and self.correcting
        checker.budget = Budget(self.seconds)
        try:
            verdict = claimed(checker, text, letters or {}) or _stated(checker, text, letters)
            return replace(verdict, moment=self.sampler.own.moment) if self.sampler.has(checker.hypothesis) else verdict
        except (ModelProblem, ModelError, MotionError) as error:
            what, hint = error.args[-2:]
        except ModelFileError as error:  # a number of a parameter that is none
            what, hint = error.problems[0].what, error.problems[0].hint
        except StatementError as error:
            if error.text:
                raise
            what, hint = error.what, error.hint
        word = next((word for word in re.findall("`([^`]+)`", what) if word in text), text)
        start = text.find(word)
        raise StatementError(what, (start, start + len(word)), hint, text)

    def moment(self, name: str) -> tuple[Any, float]:
        """The model's own run, and the time of a moment: ``start``, ``end``, an event, or a time like ``0.3 s``."""
        if not self._runs:
            self._runs += [self.mechanism.simulate(None if self.mechanism.run_numbers().until is not None else 1.0)]
        run = self._runs[0]
        times = {"start": float(run.t[0]), "end": float(run.outcome.t)}
        times |= {event.name: event.t for event in reversed(run.events)}
        try:
            return run, times[name] if name in times else quantity("at", name, "s")
        except ModelProblem:
            raise ModelProblem(
                f"the run has no moment `{name}`", f"there are {', '.join(times)}, and times like `0.3 s`"
            ) from None


def _stated(checker: Checker, text: str, letters: Declared | None) -> Verdict:
    """The verdict about equations."""
    case = checker.case(text, letters)
    if case.program.units and (found := _in_figures(checker.case(text, letters, units=False))):
        return found
    if (error := misfit(case.program, case.meaning.symbols.dimensions)) is None:
        verdict = judged(case)
    else:
        verdict = _in_figures(case) or of_wrong_dimensions(case, case.equations, text, error.what)
    unfinished = (case.budget.words,) if case.budget.spent else ()
    return replace(verdict, notes=(*case.meaning.symbols.notes(case.program), *unfinished))


def _in_figures(case: Case) -> Verdict | None:
    """The verdict where an equation is true whose dimensions do not fit, since figures in it are measures in SI units."""
    verdict = judged(replace(case, correcting=False))
    return replace(verdict, reason=f"{verdict.reason}; figures are in SI units") if verdict.ok else None
