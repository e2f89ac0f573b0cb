"""Claims about natural frequencies, whichever letter they have."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np

from freebody.model.errors import ModelProblem
from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import sampled
from freebody.symbolic.tree import Quotient, Sym

from .coefficients import multiplied
from .families import ALL
from .language.parser import parse
from .language.spelling import spell
from .language.statements import Equation
from .residual import HOLDS
from .verdict import Kind, Verdict
from .vibration import OfVibration

if TYPE_CHECKING:
    from .api import Checker, Declared
    from .stated import Correction

_FEWEST = 8  # places at which something has to swing
OMEGA = re.compile(r"(?:ω|\\omega(?![A-Za-z])|\bomega)(?:_\{?(?!d)[A-Za-z]\}?)?(?![A-Za-z0-9_(₀-₉])")
"""A natural frequency; ω_d is that of damped vibrations."""
PERIOD = re.compile(r"\A[\s$]*(T|τ|\\tau)\s*=([^=]+?)[\s$]*\Z")
"""A period alone on its side, of a model that has several."""
_OF_PERIOD = re.compile(r"\s*period = ([^=]+)")
"""What is read for a period in words."""
_SAYS_OMEGA = re.compile(
    rf"[\s$]*{OMEGA.pattern}\s*(?:²|\^\s*\{{?2\}}?)?\s*(?:=(?!.*(?:±|\\pm))[^=]*|[-−](?!.*{OMEGA.pattern})[^=±]*=\s*0[\s$.]*)"
)


def frequencies(checker: Checker, declared: Declared, number: str, statement: str) -> Verdict:
    """The verdict about natural frequencies; the corrections of what was said of a period are of that."""
    if period := _OF_PERIOD.fullmatch(statement):
        found = _judged(checker, declared, number, f"ω = 2 π/({period[1]})")
        return replace(found, mends=tuple(as_period(mend, "period") for mend in found.mends))
    return _judged(checker, declared, number, statement)


def _judged(checker: Checker, declared: Declared, number: str, statement: str) -> Verdict:
    """An equation that each natural frequency, or that of a ``number``, satisfies; that one of them does, where it says what ω is: with
    other numbers it may be another one by size."""
    names = _vibrations(checker, declared)
    names = names[int(number) - 1 :][:1] if number and len(names) > 1 else names
    said = [OMEGA.sub(lambda _, name=name: name, statement) for name in names]  # type: ignore[misc]
    if not _SAYS_OMEGA.fullmatch(statement):
        verdicts = (checker.check(text, declared) for text in said)
        first = next(verdicts)
        return next((verdict for verdict in chain((first,), verdicts) if not verdict.ok), first)
    judged = [checker.check(text, declared, correcting=False) for text in said]
    best = min(judged, key=_wrong)
    if best.ok or best.kind not in (Kind.WRONG, Kind.TRUE_IF):
        return best
    cases = [checker.case(text, declared) for text in said]
    left = np.array([np.abs(case.residual(case.equations[0]).ratio).max(axis=1) for case in cases])
    left = left[:, ~np.isnan(left).all(axis=0)]  # where it swings
    if left.shape[1] >= _FEWEST and np.nanmin(left, axis=0).max() < HOLDS:
        reason = "one of the natural frequencies, with any parameters"
        return replace(best, kind=Kind.TRUE, reason=reason, mends=(), evidence=None)
    alone = [one for one in _of_each(checker, declared, statement) if one.ok or one.mends] if checker.hypothesis != ALL else []
    return min(alone or (checker.check(text, declared) for text in said), key=_wrong)


def as_period(mend: Correction, letter: str) -> Correction:
    """The correction of a frequency that was said by its period, ω = 2π/T, as that."""
    with suppress(StatementError):
        match parse(mend.equation).equations[0]:
            case Equation(left=Sym(), right=Quotient(top=top, bottom=bottom)) if not top.symbols:
                turns = 2 * np.pi / float(sampled(top, {})[0])
                if (period := multiplied(bottom, turns)) is not None:
                    return replace(mend, equation=f"{letter} = {spell(period)}")
    return mend


def _wrong(verdict: Verdict) -> tuple[bool, float]:
    """How wrong a verdict calls what is said."""
    return not verdict.ok, verdict.mends[0].size if verdict.mends else np.inf


def _of_each(checker: Checker, declared: Declared, statement: str) -> Iterator[Verdict]:
    """The verdicts about the natural frequency of each coordinate that swings for itself."""
    for name in checker.sampler.names:
        if other := checker.swinging(name, declared):
            with suppress(StatementError, ModelProblem):
                yield other.check(OMEGA.sub("ω_n", statement), declared)


def _vibrations(checker: Checker, declared: Declared) -> list[str]:
    """The names of the natural frequencies: ω_n or ω_1, ω_2 …, or in words where that is the angular velocity of a body, say."""
    vibration = checker.vibration_of(checker.hypothesis)
    numbers = [f"_{i}" for i in vibration.modes(checker.hypothesis.vanishing)] if (count := vibration.count) > 1 else ["_n"]
    known = checker.symbols(declared)
    with suppress(StatementError, ModelProblem):
        known.read(f"ω{numbers[0]} = 0")
    if not count:
        raise ModelProblem("no place of rest was found about which this model swings with small vibrations")
    if isinstance(known.meanings.get(f"ω{numbers[0]}"), OfVibration | None):
        return [f"ω{number}" for number in numbers]
    return [f"natural_frequency{number.removesuffix('_n')}" for number in numbers]
