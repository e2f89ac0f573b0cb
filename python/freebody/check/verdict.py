"""The verdict about a statement, with its evidence."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.solve.rich_tables import PlainText

from .families import NoMotion
from .language.statements import symbols_in
from .residual import Residual, Sides
from .stated import Correction

if TYPE_CHECKING:
    from freebody.symbolic.evaluate import Array

_UNITS = ("i", "j", "k")
EVERY_TERM_IS_0 = "every term is 0"
NOTHING_LEFT = "nothing is left of"
NO_AMPLITUDE = "how far small motions go to and fro in a steady state is not found"


class Kind(str, Enum):
    """What can be said of a statement; of one among many also that it cannot be read."""

    TRUE = "true"
    TRUE_IF = "true only under an assumption"
    WRONG = "wrong"
    UNDECIDABLE = "not decidable from this model"
    DIMENSIONS = "dimensions do not fit"
    UNREADABLE = "cannot be read"

    @property
    def short(self) -> str:
        """In a word or two, for tables."""
        return {Kind.TRUE_IF: "true if", Kind.UNDECIDABLE: "not decidable", Kind.DIMENSIONS: "dimensions"}.get(self, self.value)

    @property
    def colour(self) -> str:
        """For a terminal."""
        return {Kind.TRUE: "green", Kind.TRUE_IF: "yellow", Kind.UNDECIDABLE: "yellow"}.get(self, "red")


@dataclass(frozen=True)
class Evidence:
    """A true state: the symbols of the statement there (SI), the two sides, and how far apart they are beside all terms."""

    letters: dict[str, Any]
    left: Any
    right: Any
    ratio: float
    states: int

    @classmethod
    def at(cls, sides: Sides, values: Mapping[str, Array], k: int, ratio: float, states: int) -> Evidence:
        """That of state ``k``."""
        shown = {n.key: values[n.key][k].tolist() for n in symbols_in(sides.equation) if n.key in values}
        return cls(shown, sides.left[k].tolist(), sides.right[k].tolist(), ratio, states)

    def __str__(self) -> str:
        stated = {name: value for name, value in self.letters.items() if not (name in _UNITS and isinstance(value, Sequence))}
        at = ", ".join(f"{name} = {_plain(value)}" for name, value in stated.items())
        return f"at {at}: left {_plain(self.left)}, right {_plain(self.right)}"


@dataclass(frozen=True)
class Verdict(PlainText):
    """What is so about one statement. ``reason`` is a sentence; ``assumption`` names under what it holds; ``mends`` are the
    smallest edits that make it true, equally small ones side by side; ``true`` is the nearest true equation, where there are none;
    ``untested`` are terms about which nothing was learnt."""

    kind: Kind
    text: str
    reason: str = ""
    assumption: str = ""
    mends: tuple[Correction, ...] = ()
    evidence: Evidence | None = None
    untested: tuple[str, ...] = ()
    true: str = ""
    differs: str = ""
    """How the statement differs from the nearest true equation."""
    notes: tuple[str, ...] = ()
    """What the statement calls by a name that means something else in this model."""
    moment: str = ""
    """Of which moment it is, where a model has several: ``after cut``, ``t = 2 s``."""
    of_no_motion: bool = False
    """Whether none was found of which it is said."""

    @classmethod
    def without_motion(cls, text: str, error: NoMotion) -> Verdict:
        """That of what is said of motions of which none was found."""
        return cls(Kind.UNDECIDABLE, text, str(error), of_no_motion=True)

    @property
    def ok(self) -> bool:
        """Whether it is true of every motion of the model."""
        return self.kind is Kind.TRUE

    @property
    def is_idle(self) -> bool:
        """Whether a letter is 0 where it was judged, or every term: then it may not be meant of that stretch of the motion."""
        return self.evidence is None or any(value == 0 for name, value in self.evidence.letters.items() if name != "t")

    @property
    def details(self) -> list[str]:
        """What is behind it, a line each."""
        lines = [self.reason] if self.reason else []
        for correction in self.mends:
            lines += [f"correction: {correction}", *([f"  {correction.why}"] if correction.why else [])]
        lines += filter(None, (self.true, self.differs))
        if self.evidence and not self.ok:
            lines.append(str(self.evidence))
        if self.untested:
            lines.append(f"nothing was established about {', '.join(f'`{term}`' for term in self.untested)}")
        return [*lines, *self.notes, *([f"of the model {self.moment}"] if self.moment else [])]

    def __str__(self) -> str:
        return "\n  ".join([self.kind.value, *self.details])


def evidence(found: Residual, values: Mapping[str, Array]) -> Evidence:
    """The state at which the two sides are farthest apart."""
    k = int(np.abs(found.ratio).max(axis=1).argmax())
    return Evidence.at(found.sides, values, k, float(np.abs(found.ratio[k]).max()), len(found.ratio))


def _plain(value: Any) -> str:
    if isinstance(value, str):
        return value
    if isinstance(value, Sequence):
        return "(" + ", ".join(_plain(v) for v in value) + ")"
    return f"{value + 0.0:.6g}"
