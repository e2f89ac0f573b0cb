"""Another number in the condition under which something is said, where what is said holds then: `if h = 2*l/3` for `if h = l/2`."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from typing import TYPE_CHECKING

from freebody.core import ModelError, MotionError
from freebody.model.errors import ModelProblem
from freebody.symbolic.errors import StatementError
from freebody.symbolic.tree import Sym, is_zero

from .assumptions import says_zero
from .case import Case
from .coefficients import multiplied
from .families import Family, NoMotion
from .hypotheses import family
from .language.parser import parse_expression
from .language.spelling import spell
from .language.statements import Equation
from .residual import HOLDS, residual
from .stated import Correction

if TYPE_CHECKING:
    from .api import Checker, Declared

_TIMES = (2.0, 1 / 2, 4 / 3, 3 / 4, 3 / 2, 2 / 3, 4.0, 1 / 4, 3.0, 1 / 3)
"""By which a value is mistaken, as a half or a third for another."""
_STATES = 8
_SIZE = 1.0
_WHY = "it is so at another value: where a force, a moment or a motion is to vanish follows from the balance itself"


def other_conditions(checker: Checker, declared: Declared, condition: str, statement: str) -> Iterator[Correction]:
    """A condition whose value is another number times that given, where something said to be 0, or to be another, is so there."""
    name, equals, value = condition.partition("=")
    if not equals or re.search(r"[=,<>]|\band\b", value):
        return
    with suppress(StatementError, ModelProblem):
        case, given = checker.case(statement, declared), parse_expression(value, checker.symbols(declared).names)
        if is_zero(given) or not all(map(_is_special, case.equations)):
            return
        others = (multiplied(given, times) for times in case.budget.within(_TIMES))
        for new in (other for other in others if other is not None):
            there = f"{name.strip()} = {spell(new)}"
            if _holds(case, family(there, checker, declared)):
                stated = (("factor", spell(given), spell(new)),)
                yield Correction(stated, f"if {there}: {statement}", _SIZE, why=_WHY)


def _is_special(equation: Equation) -> bool:
    """Whether something is said to be 0, or two to be the same: what is so at a special value alone."""
    return says_zero(equation) or (isinstance(equation.left, Sym) and isinstance(equation.right, Sym))


def _holds(case: Case, there: Family) -> bool:
    """Whether what is said is so on motions of a family."""
    try:
        return all(residual(equation, case.values(there, count=_STATES)).worst < HOLDS for equation in case.equations)
    except (NoMotion, StatementError, ModelError, MotionError):
        return False
