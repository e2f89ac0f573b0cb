"""Edits by several terms at once: inertias that turn as one, and two terms that an equation lacks."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from freebody.symbolic.dimensions import ENERGY, FORCE
from freebody.symbolic.evaluate import sampled
from freebody.symbolic.tree import Add, Sym, exchange

from .coefficients import more, multiplied
from .edits import Edit, depth
from .inertia_edits import mass_centres, of_whole, wheels
from .known_terms import KnownTerms
from .language.statements import Equation, terms
from .solve_for_term import RequiredTerm, required_terms
from .spans import spanning

_TWO_TERMS = 0.6  # by which two missing terms are more than one: they mostly are components of one force or acceleration
_UNDONE = 0.3  # more, where one of them takes away what is said, or doubles it
_AS_ONE = 0.1  # for several inertias that turn as one


def as_one(equation: Equation, known: KnownTerms) -> Iterator[Edit]:
    """A side that lacks several inertias that turn as one."""
    with np.errstate(all="ignore"):
        required = _longer_side(equation, known)
        if required is not None and required.missing.ndim == 1:
            for term in known.within(of_whole(equation, required.missing, known.vocabulary, known.values)):
                after = exchange(equation, required.node, more(required.node, term))
                yield Edit("missing term", None, term, after, _AS_ONE)


def two_missing(equation: Equation, known: KnownTerms) -> Iterator[Edit]:
    """A side that lacks two terms."""
    with np.errstate(all="ignore"):
        required = _longer_side(equation, known) or next(required_terms(equation, known.values), None)
        if required is None or required.missing.ndim != 1 or not np.isfinite(required.missing).all():
            return
        nodes, rows = known.dictionary(equation)
        arms, of_arms = [], rows[:0]
        if (its := known.dimension_of(equation)) == FORCE:
            turning, of_turning = wheels(equation, known.vocabulary, known.values)
            nodes, rows = [*turning, *nodes], np.concatenate([of_turning, rows])
        if its in (FORCE, ENERGY):
            turning = [n for n in known.vocabulary.accelerations if not known.has_number(n)]
            arms, of_arms = mass_centres(known.vocabulary, known.values, turning, its == ENERGY)
        said = np.array([sampled(term, known.values) * np.ones(len(required.missing)) for term in terms(equation, expand=True)])
        made = [*spanning(of_arms, required.missing, known.within)]
        nodes, rows = (arms, of_arms) if made else (nodes, rows)
        for pair in known.within(made or spanning(rows, required.missing, known.within)):
            sizes, *_ = np.linalg.lstsq(rows[[*pair]].T, required.missing, rcond=None)
            parts = [*zip(pair, sizes, strict=True)]
            lost = [multiplied(nodes[k], float(size)) for k, size in parts]
            if None not in lost:
                after = exchange(equation, required.node, more(required.node, *lost))
                again = any(np.isclose(np.abs(said), np.abs(size * rows[k])).all(axis=1).any() for k, size in parts)
                cost = _TWO_TERMS + 0.02 * sum(map(depth, lost)) + _UNDONE * again
                yield Edit("missing term", None, Add(tuple(lost)), after, cost)


def _longer_side(equation: Equation, known: KnownTerms) -> RequiredTerm | None:
    """The first side that is no symbol alone."""
    sides = (each for each in required_terms(equation, known.values) if each.node in (equation.left, equation.right))
    return next((each for each in sides if not isinstance(each.node, Sym)), None)
