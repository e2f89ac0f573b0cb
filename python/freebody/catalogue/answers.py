"""Questions, and answers beside an independent value."""

from __future__ import annotations

import math
import random
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.solve.figures import Known

if TYPE_CHECKING:
    from freebody.catalogue.case import Case
    from freebody.symbolic.nomenclature import Nomenclature
    from freebody.symbolic.tree import Tree

Figure = float | Sequence[float] | np.ndarray
MOST_DIGITS = 16.0
PLACES = 4
"""Places of random symbols at which an answer and its closed form are compared."""
RANGE = (0.3, 1.4)
"""Of the symbols: angles stay below a right angle."""
TOLERANCE = 1e-9
_SEED = 9


@dataclass(frozen=True)
class Answer:
    """A figure, or a row of figures of one kind, that freebody computed, and the same from an independent source.

    ``against`` says where ``check`` comes from. ``tolerance`` is relative to the largest figure of the row, or to
    ``scale`` where that is larger: give it where the true value may be 0. ``said``: the answer symbolically, of which the figures
    are values. ``own``: the check is of the same run, which shows that it is consistent, and not that it is right. Figures that are
    ``Known`` have no more digits than hold; truth values are read as yes and no.

    ``says``: the answer as a sentence, ``"The rod falls flat at {}."``, where ``{}`` is what was found: all the row with its unit,
    or one figure each where there are more of them. ``variant``: what differs from the system as it is told, ``"g = 10"``.
    """

    label: str
    value: Figure
    unit: str = ""
    check: Figure = math.nan
    against: str = ""
    tolerance: float = 1e-10
    scale: float = 0.0
    said: str = ""
    own: bool = False
    says: str = ""
    variant: str = ""

    @property
    def error(self) -> float:
        """Largest difference, relative; NaN where a figure is missing."""
        value, check = np.broadcast_arrays(np.asarray(self.value, float), np.asarray(self.check, float))
        size = max(float(np.max(np.abs(check))), self.scale)
        difference = float(np.max(np.abs(value - check)))
        return difference if size == 0 else difference / size

    @property
    def digits(self) -> float:
        """Digits of agreement, at most 16; no more than hold of any figure."""
        error = self.error
        agree = min(MOST_DIGITS, -math.log10(error)) if error > 0 else math.nan if math.isnan(error) else MOST_DIGITS
        return min([agree, *(float(x.digits) for x in self.row if isinstance(x, Known))])

    @property
    def row(self) -> list[float]:
        """The figures."""
        if isinstance(self.value, (list, tuple)):
            return list(self.value)
        return [self.value] if isinstance(self.value, float) else np.atleast_1d(np.asarray(self.value, float)).tolist()

    @property
    def known(self) -> list[float]:
        """The figures with the digits that agree, and hold."""
        size = max(float(np.max(np.abs(np.asarray(self.check, float)), initial=0.0)), self.scale)
        errors = (max(self.error * size, getattr(x, "error", 0.0)) for x in self.row)
        return [Known(x, error, max(size, abs(x))) for x, error in zip(self.row, errors, strict=True)]

    @property
    def ok(self) -> bool:
        """Whether the two agree within the tolerance."""
        return bool(self.error <= self.tolerance)

    def as_dict(self) -> dict[str, Any]:
        """As plain data; NaN where a figure is missing."""
        return {
            "label": self.label,
            "variant": self.variant,
            "value": np.asarray(self.value, float).tolist(),
            "unit": self.unit,
            "check": np.asarray(self.check, float).tolist(),
            "against": self.against,
            "digits": round(self.digits, 1),
            "tolerance": self.tolerance,
            "ok": self.ok,
            "independent": not self.own,
            **({"letters": self.said} if self.said else {}),
        }


@dataclass
class Asked:
    """A question with the answers it got. ``failure``: why it stopped, if it did."""

    label: str
    answers: list[Answer] = field(default_factory=list)
    failure: str = ""
    seconds: float = 0.0

    @property
    def ok(self) -> bool:
        """Whether it went through, with every answer within its tolerance."""
        return not self.failure and all(answer.ok for answer in self.answers)


@dataclass(frozen=True)
class Question:
    """A label and a function from a case to answers."""

    label: str
    answers: Callable[[Case], Iterable[Answer]]

    def put_to(self, case: Case) -> Asked:
        """Its answers; a failure is kept with those that came before it, and does not stop other questions."""
        asked, start = Asked(self.label), time.perf_counter()
        try:
            for answer in self.answers(case):
                asked.answers.append(answer)
        except Exception as error:  # whatever goes wrong is shown as such
            asked.failure = f"{type(error).__name__}: {error}"
        asked.seconds = time.perf_counter() - start
        return asked


def ask(label: str) -> Callable[[Callable[[Case], Iterable[Answer]]], Question]:
    """Make a question of a generator of answers."""
    return lambda answers: Question(label, answers)


def formula(label: str, found: Tree, closed: str, against: str, nomenclature: Nomenclature | None = None) -> Answer:
    """A symbolic answer beside a closed form in the words of the model language, ``rate(theta)`` for a rate: both at random
    values of all symbols, of which neither knows anything."""
    from freebody.equations.language import read_text
    from freebody.symbolic.decimals import shown
    from freebody.symbolic.evaluate import evaluate
    from freebody.symbolic.printers.text import text
    from freebody.symbolic.tree import symbols

    true, draw = read_text(closed), random.Random(_SEED)
    every = sorted(symbols(found, true), key=str)
    places = [{symbol: draw.uniform(*RANGE) for symbol in every} for _ in range(PLACES)]
    value, check = ([float(evaluate(tree, place)) for place in places] for tree in (found, true))
    return Answer(label, value, "", check, against, TOLERANCE, said=text(shown(found), nomenclature))
