"""Checking statements about one model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from freebody.model.errors import ModelProblem

from .case import Case, StatementSymbols
from .claims import claimed
from .families import ALL, Family
from .language.dimensions import misfit
from .motion_sampler import MotionSampler
from .symbols import Symbols
from .verdict import Verdict, holds, judged, of_wrong_dimensions

if TYPE_CHECKING:
    from freebody.model.builder import Builder

Declared = Mapping[str, str | Sequence[str | float]]
"""Own letters, each an expression of the model language, components of a vector or a phrase; see ``Symbols``."""


class Checker:
    """Checks many statements about one model; its true motions are made once.

    ``letters`` are own letters for all of them. ``seed`` makes the random motions reproducible.
    """

    def __init__(self, mechanism: Builder, letters: Declared | None = None, seed: int = 0) -> None:
        self.mechanism = mechanism
        self.declared = dict(letters or {})
        self.sampler = MotionSampler(mechanism, seed)
        self.hypothesis = ALL
        self.correcting = True
        self._run: Any = None

    def letters(self, declared: Declared | None = None) -> Symbols:
        """The letters of the model with own ones. Raises ``ModelProblem``."""
        return Symbols(self.mechanism, {**self.declared, **(declared or {})}, self.sampler.gravity)

    def case(self, text: str, letters: Declared | None = None, hypothesis: Family | None = None) -> Case:
        """A statement beside the motions that decide about it. Raises ``StatementError`` and ``ModelProblem``."""
        known = self.letters(letters)
        program = known.read(text)
        meaning = StatementSymbols(known, program, self.sampler)
        return Case(program, meaning, self.sampler, hypothesis or self.hypothesis, self.correcting)

    def check(
        self, text: str, letters: Declared | None = None, hypothesis: Family | None = None, correcting: bool = True
    ) -> Verdict:
        """The verdict about an equation, several lines of them, or a claim (see docs/check.md).

        ``hypothesis``: the motions of which it is said. Without ``correcting`` it is only judged, which is quicker where it is wrong.
        Raises ``StatementError`` and ``ModelProblem``.
        """
        before = self.hypothesis, self.correcting
        self.hypothesis, self.correcting = hypothesis or self.hypothesis, correcting and self.correcting
        try:
            return claimed(self, text, letters or {}) or self._equations(text, letters)
        finally:
            self.hypothesis, self.correcting = before

    def _equations(self, text: str, letters: Declared | None) -> Verdict:
        case = self.case(text, letters)
        return replace(self._judged(case, text), notes=case.meaning.letters.notes(case.program))

    def _judged(self, case: Case, text: str) -> Verdict:
        error = misfit(case.program, case.meaning.letters.dimensions)
        return judged(case) if error is None else _in_figures(case) or of_wrong_dimensions(case, case.equations, text, error.what)

    def moment(self, name: str) -> tuple[Any, float]:
        """The model's own run, and the time of a moment: ``start``, ``end``, an event, or a time like ``0.3 s``."""
        from freebody.model.start import evaluate

        if self._run is None:
            self._run = self.mechanism.simulate(None if self.mechanism.run_numbers().until is not None else 1.0)
        times = {"start": float(self._run.t[0]), "end": float(self._run.outcome.t)}
        times |= {event.name: event.t for event in reversed(self._run.events)}
        if name in times:
            return self._run, times[name]
        try:
            return self._run, evaluate(name, {})
        except ModelProblem:
            raise ModelProblem(
                f"the run has no moment `{name}`", f"there are {', '.join(times)}, and times like `0.3 s`"
            ) from None


def _in_figures(case: Case) -> Verdict | None:
    """The verdict where an equation is true whose dimensions fit if figures stand for measures in SI units."""
    if misfit(case.program, case.meaning.letters.dimensions, figures=True) or not holds(case):
        return None
    verdict = judged(case)
    return replace(verdict, reason=f"{verdict.reason}; figures are in SI units") if verdict.ok else None


def check(mechanism: Builder, text: str, letters: Declared | None = None) -> Verdict:
    """Whether a statement is true of every motion of a model; see ``Checker``."""
    return Checker(mechanism, letters).check(text)
