"""What is said of a model in which something switches: whether it still holds after that, and what corrects it there."""

from __future__ import annotations

import re
from collections.abc import Collection
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from freebody.model.errors import ModelProblem
from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import sampled
from freebody.symbolic.tree import Sym

from .assumptions import FROM_START
from .families import SINCE_START
from .language.spelling import spell
from .language.statements import symbols_in, terms
from .phases import called, kind_of, phase
from .prose import plainly
from .residual import magnitude
from .verdict import Kind, Verdict
from .wording import DOING, IN_WORDS, OF_WHAT, with_condition_first

if TYPE_CHECKING:
    from .api import Checker, Declared

AT_FIRST = "It holds as the model is at first"
_ROUND_OFF = 1e-9  # of the terms of an equation, below which one of them is 0
_LOWER = re.compile(r"(?<![\w\\])(?!(?:for|the|and|with|about|along|both|whole|from)\b)[a-z]{3,}(?!\w)")
_GOES_ON = re.compile(r"\b(?:still|until|before)\b")
"""Words by which a label is of the model as it is at first."""
_SETS_FREE = ("lift-off ", "slack ", "released ")  # what switches so that more moves
_SWITCHES = 2  # of these, after which corrections are tried


def also_later(checker: Checker, verdict: Verdict, text: str, letters: Declared | None) -> Verdict:
    """The verdict about what holds as the model is at first: wrong where it does not hold after something switches, and some of it is 0 at
    first; else that is told."""
    said, shown = ", ".join(f"`{term}`" for term in verdict.untested), False
    for name in checker.happens.switches if verdict.untested else checker.happens.switches[:_SWITCHES]:
        with suppress(ModelProblem, StatementError):
            there = checker.beside("after", name, {})
            later = there.check(text, letters, correcting=bool(verdict.untested))
            if later.kind is not Kind.WRONG or _is_let_go(name, there, text, letters):
                if later.ok and not later.untested:  # there all of it shows
                    verdict, shown = replace(verdict, untested=()), True
                continue
            if not (verdict.untested or shown) and (still := _standing(checker, verdict, text, letters)):
                later = replace(later, mends=there.check(text, letters).mends if checker.correcting else ())
                return replace(
                    later, notes=(*later.notes, f"At first, where {still} stands still, it holds; not so after {name}.")
                )
            if not verdict.untested:
                told = replace(verdict, notes=(*verdict.notes, f"{AT_FIRST}, not after {name}."))
                return only_at_first(told) if _says_what_happens(checker, text) else told
            if _stays_zero(checker, verdict, text, letters):
                return replace(later, notes=(*later.notes, f"At first, where {said} is 0, it holds; not so after {name}."))
    return verdict


def only_at_first(verdict: Verdict) -> Verdict:
    """True under the assumption that it is said of the model as it is at first, of which words that are passed over may not speak."""
    only = "as the model is at first"
    return replace(verdict, kind=Kind.TRUE_IF, assumption=only, reason=f"true only {only}")


def only_later(checker: Checker, verdict: Verdict, text: str, letters: Declared | None) -> Verdict:
    """The verdict about what is wrong as the model is at first: true under the assumption that it is said of after something switches, where
    it holds then, and words of its label may speak of that."""
    label, colon, _ = text.rpartition(":")
    if not colon or not any(_may_say_when(clause, checker.symbols().bodies) for clause in re.split("[,()]", label)):
        return verdict
    words = re.findall(r"\w+", label)
    if any(phase(checker, clause.strip()) for clause in re.split("[,()]", label) if IN_WORDS.fullmatch(clause.strip())):
        return verdict  # it is understood, as of the model at first
    for name in checker.happens.switches:
        if name.startswith(_SETS_FREE) and called([name.partition(" ")[2]], words):  # of what is there, before
            continue
        with suppress(ModelProblem, StatementError):
            later = checker.beside("after", name, {}).check(text, letters, correcting=False)
            if later.ok and not (later.untested or later.is_idle):
                return replace(later, kind=Kind.TRUE_IF, assumption=f"after {name}", reason=f"true only after {name}")
    return verdict


def _says_what_happens(checker: Checker, text: str) -> bool:
    """Whether in a label something does what is not understood: ``frame going over:``."""
    label, colon, _ = text.rpartition(":")
    doing = {*DOING.findall(label)} - {*checker.symbols().bodies} if colon else set()
    return bool(doing) and kind_of(label) is None and _GOES_ON.search(label) is None


def _may_say_when(clause: str, bodies: Collection[str]) -> bool:
    """Whether a clause of a label has words that are no names of what it is of."""
    return bool({*_LOWER.findall(clause)} - {*bodies}) and OF_WHAT.fullmatch(clause) is None


def corrected_later(checker: Checker, verdict: Verdict, text: str, letters: Declared | None) -> Verdict:
    """The verdict about what is wrong as the model is at first, where parts of it are 0 or move as one: with the corrections of after
    something switches that are true at first, too."""
    holds = lambda asked, correction: asked.check(correction.equation, letters, correcting=False).ok
    for name in [name for name in checker.happens.switches if name.startswith(_SETS_FREE)][:_SWITCHES]:
        with suppress(ModelProblem, StatementError):
            there = checker.beside("after", name, {})
            if holds(there, verdict.mends[0]):
                continue
            later = there.check(text, letters)
            if later.kind is Kind.WRONG and (mends := tuple(each for each in later.mends if holds(checker, each))):
                return replace(later, mends=mends, notes=(*later.notes, f"It is corrected by what is so after {name}."))
    return verdict


def _standing(checker: Checker, verdict: Verdict, text: str, letters: Declared | None) -> str:
    """The first coordinate of a statement about rates that stands still as the model is at first; nothing where all move."""
    since = SINCE_START if verdict.assumption == FROM_START else None
    case = checker.case(with_condition_first(plainly(text)[0]), letters, since)
    known, values, said = case.meaning.vocabulary, case.values(), symbols_in(case.program)
    if not any(map(known.is_rate, said)):
        return ""
    rates = {n.name: values[Sym(n.name, 1).key] for n in said if n in known.coordinates and not n.dots}
    return next((name for name, rate in rates.items() if not np.any(rate)), "")


def _is_let_go(name: str, there: Checker, text: str, letters: Declared | None) -> bool:
    """Whether a reaction of which a statement speaks is gone after something that sets free: it is said of what is held by it."""
    if not name.startswith(_SETS_FREE):
        return False
    case = there.case(with_condition_first(plainly(text)[0]), letters)
    values, known = case.values(), case.meaning.vocabulary
    reactions = [n for n in symbols_in(case.program) if n in known.others and known.is_load(n)]
    return any(not np.any(values[n.key]) for n in reactions if n.key in values)


def _stays_zero(checker: Checker, verdict: Verdict, text: str, letters: Declared | None) -> bool:
    """Whether what is not established of a statement is 0 as the model is at first, and not only small where it was tried."""
    since = SINCE_START if verdict.assumption == FROM_START else None
    case = checker.case(with_condition_first(plainly(text)[0]), letters, since)
    values = case.values()
    untested = [
        (equation, term)
        for equation in case.equations
        for term in terms(equation, expand=True)
        if spell(term) in verdict.untested
    ]
    return all(np.all(np.abs(sampled(term, values)) <= _ROUND_OFF * magnitude(one.left, values)) for one, term in untested)
