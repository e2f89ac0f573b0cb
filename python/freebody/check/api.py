"""Checking statements about one model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from .case import Case
from .language.dimensions import DimensionError, check_dimensions
from .language.errors import StatementError
from .language.parser import parse
from .letters import Letters
from .meaning import StatementLetters
from .mend import mends
from .truth import ALL, Family, Truth
from .verdict import Kind, Verdict, judged

if TYPE_CHECKING:
    from freebody.model.builder import Builder

Declared = Mapping[str, str | Sequence[str | float]]
"""Own letters, each an expression of the model language, components of a vector or a phrase; see ``Letters``."""


class Checker:
    """Checks many statements about one model; its true motions are made once.

    ``letters`` are own letters for all of them. ``seed`` makes the random motions reproducible.
    """

    def __init__(self, mechanism: Builder, letters: Declared | None = None, seed: int = 0) -> None:
        self.mechanism = mechanism
        self.declared = dict(letters or {})
        self.truth = Truth(mechanism, seed)

    def case(self, text: str, letters: Declared | None = None, hypothesis: Family = ALL) -> Case:
        """A statement beside the motions that decide about it. Raises ``StatementError`` and ``Complaint``."""
        known = Letters(self.mechanism, {**self.declared, **(letters or {})}, self.truth.gravity)
        program = parse(text, known.names)
        return Case(program, StatementLetters(known, program, self.truth), self.truth, hypothesis)

    def check(self, text: str, letters: Declared | None = None, hypothesis: Family = ALL) -> Verdict:
        """The verdict about an equation, or about several lines of them. Raises ``StatementError`` and ``Complaint``."""
        case = self.case(text, letters, hypothesis)
        try:
            units = case.meaning.letters.dimensions
            check_dimensions(case.program, units)
        except DimensionError as error:
            found = tuple(mend for equation in case.equations for mend in mends(case, equation))
            return Verdict(Kind.DIMENSIONS, text, error.what, mends=found)
        except StatementError:
            pass
        return judged(case)


def check(mechanism: Builder, text: str, letters: Declared | None = None) -> Verdict:
    """Whether an equation is true of every motion of a model; see ``Checker``."""
    return Checker(mechanism, letters).check(text)
