"""The assumptions under which a wrong equation is true, in words."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import replace

import numpy as np

from freebody.core import ModelError, MotionError
from freebody.symbolic.dimensions import INERTIA, LENGTH, Known
from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import Array, is_zero, sampled
from freebody.symbolic.tree import Fn, Mul, Pow, Sym, walk

from .asked_model import WORD
from .case import Case
from .families import BEFORE, Family, NoMotion
from .figures import figures, rounding
from .hypotheses import SMALL
from .language.statements import Equation, symbols_in, terms
from .residual import HOLDS, OFTEN, REACH, SLIGHT, magnitude, residual, unreached

FROM_START = "motions from the start of this model"
FROM_REST = f"{FROM_START} at rest"
OWN_NUMBERS = "these numbers of the model"
_FAR = (1e3, 1e6)
"""Factors at which a limit is tried."""
_STATES = 16
_SOME = 4  # states on motions from the start, near which terms may still be small, on which each has to take part
_PART = 0.85  # of the budget, so that there is time for the balance that comes nearest
_AT_MOMENT = 0.3  # of it, where each state is a run up to a moment
_TINY = 1e-7  # rad, or so much of a typical length, at which what is left of a true linear equation is little beside its terms, and round-off, too
_TINY_SQUARED = 1e-4  # the same of an energy, or of an angle that changes to second order alone: the square of it is no round-off
_OF_SECOND_ORDER = 1e-5  # rad, below which an angle does so, where others are SMALL
_SMALLER = 2  # times that what is small is taken ten times as small
_NEGLIGIBLE = 0.03  # share of the least term that may be left where it is true to first order
_NOTHING = 1e-9  # of its parts, below which a term is 0
_SLOPE = 0.1  # by which a thousandfold step towards a limit has to shrink the residual at least


def assumption(case: Case, equation: Equation) -> tuple[str, ...]:
    """The mildest assumptions, in words, under each of which an equation holds; none without one.

    They count only where every term still takes part: an assumption explains what was left out, not what is wrong.
    """
    for families in case.budget.within(_assumptions(case), _PART):
        if found := tuple(words for words, family in case.budget.within(families, _PART) if of_family(case, equation, family)):
            return found
    words = _to_first_order(case, equation) or _limit(case, equation)
    return (words,) if words else ()


def leaves_out(words: str, mended: bool, lacks: bool, starts_at_rest: bool) -> bool:
    """Whether an assumption takes motion, also that of the start, gravity or a part of the model away, so that it excuses nothing: a term
    was left out. Where one edit has ``mended`` an equation, a limit and the start excuse nothing, either; nor small angles what
    ``lacks`` a term."""
    if words == FROM_REST and not starts_at_rest:
        return True
    taken = words.startswith(("at rest", "without gravity")) or re.fullmatch(r"\S+ = 0( \(no friction\))?", words) is not None
    return taken or (mended and ("→" in words or words == "at the start")) or (lacks and words.startswith("small"))


def linearised(case: Case, equation: Equation) -> str:
    """In words, what is small where an equation in which angles stand outside of sines and cosines is true to first order."""
    return _to_first_order(case, equation) if _has_bare_angles(case, equation) else ""


def is_of_higher_order(case: Case, equation: Equation) -> bool:
    """Whether it has sines of the angles that move, or a product of two rates: who neglects what is small keeps neither."""
    angles = case.meaning.vocabulary.angular & {*case.meaning.vocabulary.coordinates}
    calls = (n for n in walk(equation) if isinstance(n, Fn) and n.name in ("sin", "cos", "tan"))
    return any(angles & {*symbols_in(n)} for n in calls) or any(
        isinstance(n, Pow) and isinstance(n.base, Sym) and n.base.dots == 1 for n in walk(equation)
    )


def tiny(case: Case, equation: Equation) -> tuple[str, Case] | None:
    """The statement of motions so small that sines are angles, in words; None where it is of such ones already, or no angle stands outside
    of sines and cosines."""
    if case.hypothesis.small or not _has_bare_angles(case, equation):
        return None
    words, family = _small(case, equation, _TINY)
    return words, replace(case, hypothesis=family, known={})


def nearer(case: Case) -> Case:
    """The same statement, where it is of small motions of such small ones."""
    if not (given := case.hypothesis.small):
        return case
    known, values = case.meaning.vocabulary, case.values()
    angles = (n for n in symbols_in(case.program) if n in known.coordinates and n in known.angular)
    squares = any(not n.symbols.isdisjoint(known.energies) for n in case.equations)
    squares |= any(np.median(np.abs(values[n.key])) < _OF_SECOND_ORDER for n in angles)
    times = (_TINY_SQUARED if squares else _TINY) / SMALL
    small = tuple((text, size * times) for text, size in given)
    scaled = (*case.hypothesis.scaled, *((name, times) for name in _driving(case)))
    return replace(case, hypothesis=replace(case.hypothesis, small=small, scaled=scaled), known={})


def _driving(case: Case) -> tuple[str, ...]:
    """The parameter of a statement that drives the model, beside which what is small would be nothing if it were not small, too; where
    something moves that is not, it is beside that."""
    vibration, said = case.meaning.symbols.vibration, {*symbols_in(case.program)}
    if not vibration or Sym(vibration.drive) not in said:
        return ()
    moving = {n.name for n in said} & {n.name for n in case.meaning.vocabulary.coordinates}
    small = {word for text, _ in case.hypothesis.small for word in WORD.findall(text)}
    return (vibration.drive,) if not small or moving <= small else ()


def _has_bare_angles(case: Case, equation: Equation) -> bool:
    """Whether angles stand outside of functions, where no torsion spring has them so."""
    springs = {n for n in symbols_in(equation) if not case.sampler.torsional.isdisjoint(case.meaning.texts(n))}
    linear = (n for n in walk(equation) if isinstance(n, Fn) or (isinstance(n, Mul) and springs & n.symbols))
    inside = {id(n) for part in linear for n in walk(part)}
    known = case.meaning.vocabulary
    return any(n in known.coordinates and n in known.angular and id(n) not in inside for n in walk(equation))


def _small(case: Case, equation: Equation, size: float) -> tuple[str, Family]:
    """The motions in which the angles of an equation are small, in words."""
    known = case.meaning.vocabulary
    plain = dict.fromkeys(Sym(n.name) for n in symbols_in(equation))
    angles = [n for n in plain if n in known.coordinates and n in known.angular]
    small = tuple((text, size) for n in angles for text in case.meaning.texts(n))
    return f"small {', '.join(n.name for n in angles)}", replace(case.hypothesis, small=small)


def _to_first_order(case: Case, equation: Equation) -> str:
    """The angles of an equation that have to be small for it to be true to first order, in words; nothing where that does not help."""
    words, family = _small(case, equation, SMALL)
    exact = not _has_bare_angles(case, equation) and is_of_higher_order(case, equation)
    if exact or not case.budget.lasts(_PART):
        return ""
    with suppress(NoMotion, StatementError, ModelError, MotionError):
        if family.small and not case.hypothesis.small and first_order(case, equation, family):
            return f"{words}, to first order"
    return ""


def small_from_start(case: Case, size: float = _TINY) -> Case:
    """The statement of the motions from the start with which the numbers of that are small."""
    given, names = case.hypothesis, case.meaning.of_start_alone
    since = given.since or (BEFORE if case.sampler.moment else "start")
    scaled = (*given.scaled, *((name, size) for name in (*names, *(_driving(case) if names else ()))))
    return replace(case, hypothesis=replace(given, small=(), since=since, scaled=scaled), known={})


def first_order_from_start(case: Case, equation: Equation) -> bool | None:
    """Whether it is true to first order on those; None where it does not speak of the start, or there are none."""
    near, far = (small_from_start(case, size).hypothesis for size in (SMALL, 10 * SMALL))
    with suppress(NoMotion, StatementError, ModelError, MotionError):
        return first_order(case, equation, near, far) if case.meaning.speaks_of_start(equation) else None
    return None


def first_order(case: Case, equation: Equation, family: Family, larger: Family | None = None) -> bool:
    """Whether what is left is of higher order than each term, as what is small grows smaller, from ``larger`` on. Raises ``NoMotion``."""
    larger = larger or wider(family)

    def beside_terms(values: Mapping[str, Array]) -> float:
        """What is left of the equation beside the least of its terms, in the median."""
        left = np.abs(residual(equation, values).sides.residual).max(axis=1)
        with np.errstate(all="ignore"):
            sizes = [np.abs(sampled(term, values)).reshape(len(left), -1).max(axis=1) for term in terms(equation, expand=True)]
            # Where it has a value: what it is said of may not swing with any numbers.
            there = np.isfinite([left, *sizes]).all(axis=0)
            shares = [np.median((left / size)[there]) for size in sizes]
        return float(np.max(shares, initial=0.0)) if there.sum() >= OFTEN else np.nan

    far, near = (beside_terms(case.values(each, count=_STATES)) for each in (larger, family))
    for _ in range(_SMALLER if family.small else 0):
        if not _NEGLIGIBLE <= near < far / 3:
            break
        family = wider(family, 0.1)  # what is neglected may have large numbers before it
        far, near = near, beside_terms(case.values(family, count=_STATES))
    return bool(near < HOLDS or (near < _NEGLIGIBLE and near < far / 3))


def wider(family: Family, times: float = 10.0) -> Family:
    """The same with what is small so many times as large."""
    return replace(family, small=tuple((text, times * size) for text, size in family.small))


def says_zero(equation: Equation) -> bool:
    """Whether one term alone is said to be 0."""
    return len([term for term in terms(equation) if not is_zero(term)]) == 1


def vanishes(equation: Equation, there: Mapping[str, Array], before: Mapping[str, Array], least: float = _SLOPE) -> bool:
    """Whether the side of an equation beside 0 shrinks on the way to a limit."""
    last, first = (float(np.median(np.abs(residual(equation, values).sides.residual))) for values in (there, before))
    return last <= least * first


def of_family(case: Case, equation: Equation, family: Family, count: int = _STATES) -> bool:
    """Whether an equation holds in a family of which there are motions, every term of it taking part."""
    try:
        values = case.values(family, count=count)
        found = residual(equation, values)
    except (NoMotion, StatementError, ModelError, MotionError):
        return False
    if family.at_start and not any(
        np.abs(sampled(term, values)).max() > _NOTHING * magnitude(term, values).max() for term in terms(equation)
    ):
        return False  # what has changed since the start is 0 there
    as_printed = family.numbers and bool(figures(equation))
    near = np.all(np.abs(found.sides.residual) <= rounding(equation, values)) if as_printed else found.holds_but_for_few
    often, reach = (_SOME, SLIGHT) if family.since else (OFTEN, REACH)
    return bool(near) and not unreached(equation, values, often, reach)


def _assumptions(case: Case) -> Iterator[list[tuple[str, Family]]]:
    """Families in words, equally mild ones together."""
    sampler, given = case.sampler, case.hypothesis
    zeros = [name for name, value in sampler.free_parameters.items() if value == 0]
    held = dict(given.held)

    def with_zero(*names: str) -> Family:
        return replace(given, held=tuple({**held, **dict.fromkeys(names, 0.0)}.items()))

    for chosen in ([[name] for name in zeros], [zeros] if len(zeros) > 1 else []):
        yield [(f"{', '.join(f'{name} = 0' for name in names)}, as in this model", with_zero(*names)) for names in chosen]
    others = [n for n in mattering(case) if n not in (*zeros, *sampler.frictions, *sampler.gravities)]
    yield [
        ("at rest", replace(given, at_rest=True)),
        *([("without gravity", replace(given, gravity=False))] if sampler.gravities else ()),
        *((f"{name} = 0 (no friction)", with_zero(name)) for name in sampler.frictions),
        *((f"{name} = 0", with_zero(name)) for name in others if not _is_size(case, name)),
    ]
    own = replace(given, numbers=True, zeros=False)
    yield [(OWN_NUMBERS, own)]
    yield [("at rest, and these numbers of the model", replace(own, at_rest=True))]
    yield [("at the start", replace(given, at_start=True))]
    yield [("at the start, with these numbers of the model", replace(own, at_start=True))]
    if not (given.at_rest or given.at_start or given.small):
        yield [(FROM_START, replace(given, since="start"))]
        yield [(FROM_REST, replace(given, since="rest"))]


def mattering(case: Case) -> list[str]:
    """Free parameters that are more than numbers of the start, and may go far without opening a closed loop."""
    known = {text for n in case.meaning.vocabulary.parameters for text in case.meaning.texts(n)}
    return [name for name in case.sampler.free_parameters if name in known and not case.sampler.shapes_loop(name)]


def _of(case: Case, name: str) -> Known:
    """The dimension of a parameter."""
    return next(its for n, its in case.meaning.vocabulary.parameters.items() if name in case.meaning.texts(n))


def _is_size(case: Case, name: str) -> bool:
    """Whether a parameter is a length of what there is, and not by how much a prescribed motion moves."""
    moves = json.dumps(case.sampler.spec["motions"], ensure_ascii=False)
    return _of(case, name) == LENGTH and not re.search(rf"\b{re.escape(name)}\b", moves)


def _limits(case: Case) -> Iterator[tuple[str, int]]:
    """Parameters with the power of the factor by which they go to ∞ or to 0, as a person would name it: no size goes to 0, nor to ∞ where
    bodies turn, and no inertia or gravity to ∞."""
    given, free = case.hypothesis, case.sampler.free_parameters
    turns = not all(body["particle"] for body in case.sampler.metadata["bodies"])
    for name in mattering(case):
        if not given.since and free[name] != 0 and name not in dict(given.held):
            its = _of(case, name)
            grows = its != INERTIA and not (its == LENGTH and turns) and name not in case.sampler.gravities
            yield from ((name, 1),) if grows else ()
            yield from ((name, -1),) if not _is_size(case, name) and name not in case.sampler.frictions else ()


def _limit(case: Case, equation: Equation) -> str:
    """A limit in which the residual vanishes though every term still takes part, in words; nothing where there is none."""
    given = case.hypothesis
    part = _AT_MOMENT if case.sampler.own.moment else _PART
    for name, power in case.budget.within(_limits(case), part):
        families = (replace(given, scaled=(*given.scaled, (name, far**power))) for far in _FAR)
        with suppress(NoMotion, StatementError, ModelError, MotionError):
            near, far = (case.values(family, count=_STATES) for family in families)
            first, last = (float(np.median(np.abs(residual(equation, values).ratio).max(axis=1))) for values in (near, far))
            shrinks = first < _SLOPE and last < max(_SLOPE * first, HOLDS)
            if shrinks and residual(equation, far).worst < 1e-2 and not unreached(equation, far):
                return f"{name} → {'∞' if power > 0 else '0'}"
    return ""
