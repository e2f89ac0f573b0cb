"""The smallest edits that make a wrong equation true."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from freebody.symbolic.errors import StatementError
from freebody.symbolic.tree import Sym, is_zero

from .assumptions import FROM_START
from .families import NoMotion
from .language.statements import Equation, rows, symbols_in
from .residual import HOLDS, residual
from .search import LIKELIEST, Found, Search, vanishes
from .senses import of_root, one_sense
from .stated import Correction

if TYPE_CHECKING:
    from .case import Case
    from .families import Family

FIRST, SECOND = 0.5, 0.8
"""Parts of the budget after which a first search ends, and one that comes after it."""
_LIKELY = 2.0  # size of a single edit above which pairs may be as likely
_OF_START = 1.0  # by which what is so from the start alone is less likely to be meant
Step = Callable[[Search], Iterator[Found]]
"""A way to look for corrections."""
_SINGLE: tuple[Step, ...] = (Search.singles, Search.other_terms)


def corrections(case: Case, equation: Equation, part: float = FIRST) -> Iterator[Correction]:
    """The smallest corrections of an equation, equally small ones together; nothing where no one or two edits make it true. They are
    looked for within a ``part`` of what is left of the budget."""
    part = case.budget.with_rest(part)
    given, families = case.hypothesis, [(case.hypothesis, "")]
    said = " ".join(text for symbol in symbols_in(equation) for text in case.meaning.texts(Sym(symbol.name)))
    unsaid = case.sampler.free_parameters.keys() - set(re.findall(r"\w+", said)) if given.zeros else ()
    zeros = [name for name, value in case.sampler.free_parameters.items() if value == 0 and name in unsaid]
    for names in (*([name] for name in zeros), *([zeros] if len(zeros) > 1 else ())):
        held = replace(given, held=(*given.held, *((name, 0.0) for name in names)))
        families.append((held, ", ".join(f"{name} = 0" for name in names)))
    families += [forward for sense in (one_sense, of_root) if (forward := sense(case, equation))]
    parts = rows(equation)
    if len(parts) > 1 and (whole := list(_of_row(case, equation, families, _SINGLE, part))):
        yield from whole
        return
    for row in parts:
        yield from _of_row(case, row, families, (*_SINGLE, Search.together, Search.pairs), part)


def _of_row(
    case: Case, row: Equation, families: list[tuple[Family, str]], steps: Sequence[Step], part: float
) -> Iterator[Correction]:
    """The smallest corrections of an equation, in the widest family in which they are smallest."""
    searches = []
    for family, given in families:
        with suppress(NoMotion):
            searches.append((Search(case, row, family, part), given))
    if any(search.right for search, _ in searches):
        return
    tried: list[list[Found]] = [[] for _ in searches]
    some: list[tuple[list[Found], str]] = []
    late: list[Correction] = []
    least = np.inf
    for step in steps:
        if step is Search.other_terms and Search.pairs in steps and not case.sampler.moment:  # kept, if later there is no time
            late = _from_start(case, row, families, part, (Search.singles,))
        if step is Search.pairs:
            late = _from_start(case, row, families, part, (*_SINGLE, Search.together)) or late
            if late and late[0].size + _OF_START < least:
                yield from late
                return
            if some and min(found[0].size for found, _ in some) < _LIKELY:  # a single one, far-fetched as it may be
                break
        some, least = [], np.inf
        for (search, given), seen in zip(searches, tried, strict=True):
            seen += step(search)
            if found := search.best(seen):
                some.append((found, given))
                least = min(least, search.likely_size(found[0]))
                if found[0].size <= LIKELIEST:  # no smaller one is in a narrower family
                    break
        if some and least < _LIKELY:
            break
    if some:
        (found, given), (first, _) = min(some, key=lambda pair: pair[0][0].size), searches[0]
        yield from (each.correction(given, first.why(each), first.differentiated.as_written) for each in found)


def _from_start(
    case: Case, row: Equation, families: list[tuple[Family, str]], part: float, steps: Sequence[Step]
) -> list[Correction]:
    """The single edits after which an equation holds of the motions from the start of the model, if it may be said of them: also through
    what switches on them, where it holds before that."""
    ((given, words), *_) = families
    if given.since or given.at_rest or given.at_start or given.small or given.scaled:
        return []
    since, case = replace(given, since="start"), replace(case, meaning=case.meaning.of_start(), known={})
    with suppress(NoMotion, StatementError):
        values = case.values(since)
        if any(not is_zero(side) and vanishes(side, values) for side in (row.left, row.right)):
            return []  # as things are at first nothing is said
        if residual(row, values).worst < HOLDS:
            since = replace(since, through=True)
    return list(_of_row(case, row, [(since, words or FROM_START)], steps, part))
