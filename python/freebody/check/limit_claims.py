"""Claims in a limit: of parameters that go to 0 or to infinity, of small motions, of what a motion comes to."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from copy import copy
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import OutcomeKind
from freebody.model.errors import ModelProblem
from freebody.symbolic.evaluate import Array, sampled

from .assumptions import first_order, first_order_from_start, nearer, says_zero, small_from_start, vanishes, wider
from .case import Case
from .correction import SECOND, corrections
from .described import described
from .families import ALL, Family, NoMotion
from .held import with_held
from .hypotheses import FAR, SMALL, SMALL_MOTIONS, WORDS, family
from .language.statements import Equation, symbols_in, terms
from .phases import phase
from .residual import HOLDS, residual
from .stated import Correction
from .user_symbols import LARGEST
from .verdict import EVERY_TERM_IS_0, NO_AMPLITUDE, NOTHING_LEFT, Kind, Verdict, evidence
from .worded_claims import in_phase
from .wording import IN_WORDS

if TYPE_CHECKING:
    from freebody.model.builder import Builder

    from .api import Checker, Declared

_TIME = "(t) - 0"
"""What is small where it is the time since the start."""
_AT_ZERO = re.compile(r"- \(?0\)?\Z")
"""Of what is small by itself: for small θ it need not rest at θ = 0."""
_CONSTANT = re.compile(r"(?:[^=:]*:\s*)?constant\s*:|[^:]*:?[^:]*=\s*const")
_TO_ZERO, _ARROW = re.compile(r"\s*\w+\s*->\s*0(?:\s*,\s*\w+\s*->\s*0)*\s*"), re.compile(r"\s*->\s*")
"""What stays the same, and where parameters go to 0."""
_SOON = (0.05, 0.005)  # of the time typical of the model
_REACHED = 1e-8  # share of its terms that may be left at a moment, which is found to that
_BESIDE_TERM = 1e-2  # of a term that is small, that may be left beside it
_SETTLING = 1e-3  # share of its terms that may be left at the end of a motion, if it dies away


def limit(checker: Checker, declared: Declared, statement: str, limits: str) -> Verdict:
    """In a limit: what is left shrinks with the parameter, or vanishes."""
    if _CONSTANT.match(statement) and _TO_ZERO.fullmatch(limits):
        return checker.check(f"if {_ARROW.sub(' = ', limits)}: {statement}", declared, correcting=checker.correcting)
    *others, words = sorted((part.strip() for part in limits.split(",")), key=lambda part: IN_WORDS.fullmatch(part) is not None)
    if others and IN_WORDS.fullmatch(words) and words not in WORDS and (found := phase(checker, words)):
        return in_phase(checker, declared, found, words, f"limit: {statement} as {', '.join(others)}")
    if (found_held := with_held(checker, declared, limits)) and found_held[1]:
        there, others, read = found_held
        verdict = limit(there, declared, statement, others)
        return replace(verdict, notes=(*verdict.notes, read))
    given = _extreme(checker, declared, words, others) or family(limits, checker, declared)
    if given.late and (ends := _ends(checker)):
        verdict = limit(checker.of_model(("without", *ends), partial(_without, ends)), declared, statement, limits)
        return replace(verdict, notes=(*verdict.notes, f"The motion is followed on past {', '.join(ends)}."))
    case = checker.case(statement, declared, given)
    if given.scaled and not given.since and any(map(case.meaning.speaks_of_start, case.equations)):
        given = replace(given, since="start")
        case = checker.case(statement, declared, given)
    # What can be 0 is so: nothing is left that would have to shrink.
    if given.held and not (given.scaled or given.small or given.late or any(map(says_zero, case.equations))):
        verdict = checker.check(statement, declared, given)
        scaled = tuple((name, 1 / FAR[-1]) for name, value in given.held if value == 0)
        small = replace(given, held=tuple(one for one in given.held if one[1] != 0), scaled=scaled)
        if not (verdict.ok and verdict.untested and verdict.reason.startswith(EVERY_TERM_IS_0)):
            lost = next((term for term in verdict.untested for name, _ in scaled if re.search(rf"(?<!\w){name}(?!\w)", term)), "")
            return _of_what_goes(checker.case(statement, declared, small), verdict, lost) if verdict.ok and lost else verdict
        given = small  # both sides vanish there, and it says how
        case = checker.case(statement, declared, given)
    if given.steady and (given.small or _is_drive(checker, given)) and (asked := _amplitudes(case)):
        there = copy(_swinging(checker, given, limits))
        there.vibration = there.vibration.driven(asked)
        others = {name: said for name, said in declared.items() if name not in asked}
        return there.check(statement, others, replace(given, small=(), scaled=(), steady=False), correcting=checker.correcting)
    if given.small and all(n.name in case.meaning.symbols.constants for n in symbols_in(case.program)):  # ω_n² = k/m
        if given.steady:
            return Verdict(Kind.UNDECIDABLE, statement, NO_AMPLITUDE)
        return _swinging(checker, given, limits).check(statement, declared, replace(given, small=()))
    if given.small:
        return _small(case, statement, limits)
    near = replace(given, scaled=tuple((name, x ** (4 / 7)) for name, x in given.scaled), late=given.late ** (4 / 7))
    values, before = case.values(), case.values(near)
    for equation in case.equations:
        found = residual(equation, values)
        if says_zero(equation):
            if not vanishes(equation, values, before if given.scaled or given.late else case.values(ALL)):
                what = f"it does not vanish in the limit {limits}"
                return Verdict(Kind.WRONG, statement, what, evidence=evidence(found, values))
            rest = 0.0
            continue
        rest, earlier = (float(np.median(np.abs(r.ratio).max(axis=1))) for r in (found, residual(equation, before)))
        if given.late and HOLDS < rest < _SETTLING:
            if not _settles(case, equation):
                what = f"{rest:.0e} of its terms is left where motions were followed to, and it is not seen to die away"
                return Verdict(Kind.UNDECIDABLE, statement, what)
            rest = 0.0
        shrinks = not given.late and rest < 1e-3 and rest < 0.1 * earlier
        lost = [n for n in symbols_in(equation) if n.key in values and not np.isfinite(values[n.key]).all()]
        if any(LARGEST in text for n in lost for text in case.meaning.texts(n)):
            return Verdict(Kind.UNDECIDABLE, statement, f"something of it has no value in the limit {limits}")
        if np.isnan(rest) or (rest > (_REACHED if case.sampler.moment else HOLDS) and not shrinks):
            mends = tuple(corrections(case, equation, SECOND)) if case.correcting else ()
            return Verdict(Kind.WRONG, statement, f"not so in the limit {limits}", mends=mends, evidence=evidence(found, values))
        if not says_zero(equation) and _leaves_out(equation, given, values, before):
            mends = tuple(corrections(case, equation, SECOND)) if case.correcting else ()
            what = f"a term that is small as {limits} is another"
            return Verdict(Kind.WRONG, statement, what, mends=mends, evidence=evidence(found, values))
    return Verdict(Kind.TRUE, statement, f"what is left vanishes as {limits}: {rest:.0e} there", limits)


def _amplitudes(case: Case) -> dict[str, str]:
    """The names of amplitudes in a statement that is of them and of what stays the same, with what they are of."""
    symbols = case.meaning.symbols
    found = {
        n.name: meaning.texts[0]
        for n in symbols_in(case.program)
        if (meaning := symbols.spelt(n.name)) and meaning.kind == "amplitude"
    }
    return found if all(n.name in (*symbols.constants, *found) for n in symbols_in(case.program)) else {}


def _is_drive(checker: Checker, given: Family) -> bool:
    """Whether what goes to 0 is that alone by which the model is driven."""
    return [name for name, factor in given.scaled if factor < 1] == [checker.vibration.drive] and len(given.scaled) == 1


def _of_what_goes(case: Case, verdict: Verdict, term: str) -> Verdict:
    """The verdict about what is true without a term that goes in a limit, where that is so before it has gone; else not decidable."""
    far = replace(case.hypothesis, scaled=tuple((name, x**0.5) for name, x in case.hypothesis.scaled))
    with suppress(NoMotion):
        near, before = case.values(), case.values(far)
        if not any(_leaves_out(equation, case.hypothesis, near, before) for equation in case.equations):
            return verdict
    return replace(verdict, kind=Kind.UNDECIDABLE, reason=f"{NOTHING_LEFT} `{term}` there, by which it could be told from others")


def _leaves_out(equation: Equation, given: Family, near: Mapping[str, Array], far: Mapping[str, Array]) -> bool:
    """Whether what is left is no smaller than a term with a parameter that goes to 0, as it does: that term is another."""
    names = {name for name, factor in given.scaled if factor < 1}
    for term in (term for term in terms(equation, expand=True) if names & {n.name for n in symbols_in(term)}):
        ratios = [
            float(np.median(np.abs(residual(equation, values).sides.residual) / np.abs(sampled(term, values))))
            for values in (near, far)
        ]
        if np.isfinite(ratios).all() and ratios[0] > _BESIDE_TERM and ratios[0] > ratios[1] / 2:
            return True
    return False


def _swinging(checker: Checker, given: Family, limits: str) -> Checker:
    """The checker, of vibrations about the place that is said. Raises ``ModelProblem`` where it does not swing there."""
    places = tuple(text for text, _ in given.small if not _AT_ZERO.search(text))
    if not places or SMALL_MOTIONS in limits:
        return checker
    there = copy(checker)
    there.vibration = checker.vibration.about(places)
    if there.vibration_of(given).rest is None:
        said = limits.replace(" -> ", " = ")
        raise ModelProblem(f"this model does not swing about {said}", "it has no place of rest there, or no stable one")
    return there


def _extreme(checker: Checker, declared: Declared, words: str, others: Sequence[str]) -> Family | None:
    """The motions of a limit to where something is greatest or least, ``at the lowest point``; None where words say nothing of the kind."""
    if not others or words in WORDS or not IN_WORDS.fullmatch(words):
        return None
    there = copy(checker)
    there.hypothesis = family(", ".join(others), checker, declared)
    return described(words, there, declared)


def _ends(checker: Checker) -> list[str]:
    """The events that do nothing but end the model's own run, where one has."""
    if checker.happens.run.outcome.name is not OutcomeKind.STOPPED_BY_EVENT:
        return []
    return [name for name, event in checker.mechanism.model.events.items() if event.actions() == ["stop"]]


def _without(events: Sequence[str], mechanism: Builder) -> None:
    for name in events:
        del mechanism.model.events[name]


def _settles(case: Case, equation: Equation) -> bool:
    """Whether what is left of it at the end of motions dies away: by a larger factor in each span of time, not as a power of the time."""
    given = case.hypothesis
    late = (replace(given, late=given.late**part) for part in (2 / 3, 5 / 6, 1.0))
    first, second, last = (float(np.median(np.abs(residual(equation, case.values(one)).ratio).max(axis=1))) for one in late)
    return second / last > (first / second) ** 2 > 2.0


def _small(case: Case, statement: str, limits: str) -> Verdict:
    """For small motions, to first order."""
    if [text for text, _ in case.hypothesis.small] == [_TIME]:
        return _soon(case, statement, limits)
    if case.hypothesis.steady and (drive := _drive(case)):
        near, far = (replace(case.hypothesis, small=(), scaled=((drive, size),)) for size in (SMALL, 10 * SMALL))
        return _as_it_shrinks(case, statement, limits, near, far)
    for equation in case.equations:
        if says_zero(equation) and vanishes(equation, case.values(), case.values(wider(case.hypothesis)), 1 / 3):
            continue
        from_start = first_order_from_start(case, equation)
        if not (from_start or _first_order(case, equation, from_start is None)):
            # What names the time alone may be of anything that is driven.
            of_start = from_start is not None and case.meaning.of_start_alone
            near = small_from_start(case) if of_start else nearer(case)
            mends: tuple[Correction, ...] = ()
            with suppress(NoMotion):
                mends = tuple(corrections(near, equation, SECOND)) if case.correcting else ()
            values = (case if from_start is None else small_from_start(case, SMALL)).values()
            seen = evidence(residual(equation, values), values)
            return Verdict(Kind.WRONG, statement, f"not so to first order as {limits}", mends=mends, evidence=seen)
    return _true(statement, limits)


def _drive(case: Case) -> str:
    """The parameter by which a model is driven to and fro; nothing where none does."""
    vibration = case.meaning.symbols.vibration
    return vibration.drive if vibration else ""


def _true(statement: str, limits: str) -> Verdict:
    return Verdict(Kind.TRUE, statement, f"what is left is small beside each term as {limits}: true to first order", limits)


def _soon(case: Case, statement: str, limits: str) -> Verdict:
    """For small times: soon after the start, to the order of what is said."""
    soon, sooner = (replace(case.hypothesis, small=(), since="start", late=late) for late in _SOON)
    return _as_it_shrinks(case, statement, limits, sooner, soon)


def _as_it_shrinks(case: Case, statement: str, limits: str, family: Family, larger: Family) -> Verdict:
    """To the order of what is said, from larger motions of a kind to smaller ones."""
    values = case.values(family)
    for equation in case.equations:
        if not first_order(case, equation, family, larger):
            near = replace(case, hypothesis=family, known={})
            mends = tuple(corrections(near, equation, SECOND)) if case.correcting else ()
            seen = evidence(residual(equation, values), values)
            return Verdict(Kind.WRONG, statement, f"not so to first order as {limits}", mends=mends, evidence=seen)
    return _true(statement, limits)


def _first_order(case: Case, equation: Equation, needed: bool) -> bool:
    """Whether it is true to first order in small motions of any kind. Raises ``NoMotion`` where that is ``needed`` and there are none."""
    try:
        return first_order(case, equation, case.hypothesis)
    except NoMotion:
        if needed:
            raise
        return False
