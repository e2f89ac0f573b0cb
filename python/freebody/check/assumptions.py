"""Assumptions under which an equation that does not hold of every motion does hold."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from freebody import _core

from .case import Case
from .families import Family, NoMotion
from .language.errors import StatementError
from .language.nodes import Equation
from .residual import HOLDS, residual, unreached
from .rounding import is_figure, rounding

_FAR = (1e3, 1e6)
"""Factors at which a limit is tried."""
_STATES = 16
_SLOPE = 0.1  # by which a thousandfold step towards a limit has to shrink the residual at least


def assumption(case: Case, equation: Equation) -> tuple[str, Family] | None:
    """The mildest assumption under which an equation holds, in words, and its motions; None without one.

    It counts only where every term still takes part: an assumption explains what was left out, not what is wrong.
    """
    for words, family in _assumptions(case):
        try:
            if _holds(case, equation, family):
                return words, family
        except (StatementError, _core.ModelError):
            continue
    for words, families in _limits(case):
        try:
            if _tends(case, equation, families):
                return words, families[-1]
        except (NoMotion, StatementError, _core.ModelError):
            continue
    return None


def _holds(case: Case, equation: Equation, family: Family) -> bool:
    """Whether an equation holds in a family of which there are motions, every term of it taking part."""
    try:
        values = case.values(family, count=_STATES)
    except NoMotion:
        return False
    found = residual(equation, values)
    as_printed = family.at_start and family.numbers and is_figure(equation)
    near = np.all(np.abs(found.sides.residual) <= rounding(equation, values)) if as_printed else found.worst < HOLDS
    return bool(near) and not unreached(equation, values)


def _assumptions(case: Case) -> Iterator[tuple[str, Family]]:
    truth, given = case.truth, case.hypothesis
    zeros = [name for name, value in truth.free_parameters.items() if value == 0]
    held = dict(given.held)

    def with_zero(*names: str) -> Family:
        return replace(given, held=tuple({**held, **dict.fromkeys(names, 0.0)}.items()))

    yield from ((f"{name} = 0, as in this model", with_zero(name)) for name in zeros)
    if len(zeros) > 1:
        yield f"{', '.join(f'{name} = 0' for name in zeros)}, as in this model", with_zero(*zeros)
    yield "at rest", replace(given, at_rest=True)
    if truth.gravities:
        yield "without gravity", replace(given, gravity=False)
    yield from ((f"{name} = 0 (no friction)", with_zero(name)) for name in truth.frictions)
    others = [n for n in mattering(case) if n not in (*zeros, *truth.frictions, *truth.gravities)]
    yield from ((f"{name} = 0", with_zero(name)) for name in others)
    yield "these numbers of the model", replace(given, numbers=True, zeros=False)
    yield "at rest, and these numbers of the model", replace(given, numbers=True, zeros=False, at_rest=True)
    yield "at the start", replace(given, at_start=True)
    yield "at the start, with these numbers of the model", replace(given, numbers=True, zeros=False, at_start=True)


def mattering(case: Case) -> list[str]:
    """Free parameters that are more than numbers of the start, and may go far without opening a closed loop."""
    known = {text for n in case.meaning.vocabulary.parameters for text in case.meaning.texts(n)}
    return [name for name in case.truth.free_parameters if name in known and not case.truth.shapes_loops(name)]


def _limits(case: Case) -> Iterator[tuple[str, tuple[Family, ...]]]:
    given = case.hypothesis
    for name in mattering(case):
        if case.truth.free_parameters[name] == 0 or name in dict(given.held):
            continue
        for words, power in (("→ ∞", 1), ("→ 0", -1)):
            yield f"{name} {words}", tuple(replace(given, scaled=(*given.scaled, (name, far**power))) for far in _FAR)


def _tends(case: Case, equation: Equation, families: tuple[Family, ...]) -> bool:
    """Whether the residual vanishes in a limit in which every term still takes part."""
    near, far = (case.values(family, count=_STATES) for family in families)
    sizes = [float(np.median(np.abs(residual(equation, values).ratio).max(axis=1))) for values in (near, far)]
    if not sizes[0] < _SLOPE or not sizes[1] < max(_SLOPE * sizes[0], HOLDS):
        return False
    return residual(equation, far).worst < 1e-2 and not unreached(equation, far)
