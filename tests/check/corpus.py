"""Models with correct equations, and what the check says of these rearranged and with a slip."""

from __future__ import annotations

import time
import zlib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import derived
import numpy as np
from generated import GENERATED
from independent import holds, says_the_same
from mutants import mutant
from other_symbols import Other, others
from rearranged import arranged, in_other_symbols, rearranged
from store import MODELS
from textbook import BOOKS, Book

from freebody.check import Checker, Kind
from freebody.check.budget import Budget
from freebody.check.case import Case
from freebody.check.correction import corrections
from freebody.check.language.spelling import spell
from freebody.check.language.statements import Equation, symbols_in
from freebody.check.stated import Correction
from freebody.check.vocabulary import Vocabulary
from freebody.mechanism import Mechanism
from freebody.symbolic.tree import Node, Sym, substitute

_OTHER_SEED = 20  # of the states at which truth is found beside the check
_ARRANGED = 0.3  # share of slips that are made in another arrangement
_PLACES = 12  # at which two equations are compared


@dataclass(frozen=True)
class Outcome:
    """What became of one statement. ``slip``: its kind, "" for a correct equation; ``kind`` what the check said of it;
    ``found``: the equation before the slip is among the smallest corrections, ``first``: it is the first of them."""

    model: str
    slip: str
    before: str
    after: str
    kind: Kind
    found: bool
    first: bool
    mends: tuple[str, ...]
    seconds: float


@dataclass
class Bench:
    """One model with correct equations in text."""

    name: str
    mechanism: Mechanism
    texts: list[str]
    declared: Mapping[str, str]

    @cached_property
    def checker(self) -> Checker:
        return Checker(self.mechanism, dict(self.declared))

    @cached_property
    def cases(self) -> list[Case]:
        return [self.checker.case(line) for line in self.texts]

    @cached_property
    def equations(self) -> list[Equation]:
        return [case.equations[0] for case in self.cases]

    @cached_property
    def vocabulary(self) -> Vocabulary:
        return self.checker.case("\n".join(self.texts)).meaning.vocabulary

    @cached_property
    def others(self) -> list[Other]:
        return others(self.vocabulary)

    # -- found without the check

    @cached_property
    def _judge(self) -> Checker:
        return Checker(self.mechanism, dict(self.declared), seed=_OTHER_SEED)

    def is_true(self, equation: Equation) -> bool:
        """Whether it holds at true states of another draw, evaluated by other code."""
        case = self._judge.case(spell(equation), self._said(equation))
        known = case.values()
        return holds(equation, {n: known[n.key] for n in symbols_in(equation)})

    def same(self, one: Equation, other: Equation, rng: np.random.Generator) -> bool:
        """Whether two say the same, by values of the model's own symbols at places that are no true states."""
        plain = [substitute(equation, self._own) for equation in (one, other)]
        found = dict.fromkeys(n for equation in plain for n in symbols_in(equation))
        return says_the_same(*plain, {n: rng.uniform(0.4, 1.6, _PLACES) for n in found})

    @cached_property
    def _own(self) -> dict[Sym, Node]:
        return {symbol: node for other in self.others for symbol, node in other.own.items()}

    # -- what the check says

    def correct(self, rng: np.random.Generator) -> Outcome:
        """A correct equation rearranged."""
        equation = rearranged(rng, self.equations, self.vocabulary, self.others)
        text = spell(equation)
        began = time.perf_counter()
        verdict = self.checker.check(text, self._said(equation))
        seconds = time.perf_counter() - began
        return Outcome(self.name, "", text, text, verdict.kind, True, True, _edits(verdict.mends), seconds)

    def _said(self, equation: Equation) -> dict[str, str]:
        names = {n.name for n in symbols_in(equation)}
        return {other.name: other.said for other in self.others if other.name in names}

    def mutated(self, rng: np.random.Generator) -> Outcome | None:
        """A correct equation with a slip, at times in another form and other symbols; None where that is true as well."""
        before = self.equations[int(rng.integers(len(self.equations)))]
        if rng.random() < _ARRANGED:
            before = in_other_symbols(rng, arranged(rng, before, self.vocabulary), self.others)
        case = self.checker.case(spell(before), self._said(before))
        (before,) = case.equations  # every part its own: a slip is made in one place
        made = mutant(rng, before, case.meaning.vocabulary)
        if made is None or self.is_true(made.equation):
            return None
        return self.outcome(made.kind, before, made.equation, rng)

    def outcome(self, slip: str, before: Equation, after: Equation, rng: np.random.Generator) -> Outcome:
        """What the check says of ``after`` that should be ``before``."""
        text, said = spell(after), self._said(before) | self._said(after)
        began = time.perf_counter()
        verdict = self.checker.check(text, said)
        found = verdict.mends or tuple(self._corrections(text, said))
        seconds = time.perf_counter() - began
        right = [self.same(before, self.checker.case(mend.equation, said).equations[0], rng) for mend in found]
        first = bool(right) and right[0]
        return Outcome(self.name, slip, spell(before), text, verdict.kind, any(right), first, _edits(found), seconds)

    def _corrections(self, text: str, said: Mapping[str, str]) -> Iterator[Correction]:
        """Those of a statement that is true under an assumption, which is told instead of them."""
        case = self.checker.case(text, said)
        return corrections(replace(case, budget=Budget(self.checker.seconds)), case.equations[0])


def _edits(found: tuple[Correction, ...]) -> tuple[str, ...]:
    return tuple(str(mend) for mend in found)


def _of_book(book: Book) -> Bench:
    return Bench(book.name, Mechanism.loads(f"freebody: 1\n{book.model}"), list(book.equations), dict(book.letters))


def _of_model(name: str, mechanism: Mechanism) -> Bench:
    texts = derived.equations(mechanism, np.random.default_rng(zlib.crc32(name.encode())))
    return Bench(name, mechanism, texts, derived.numbers(mechanism))


BENCHES: dict[str, Callable[[], Bench]] = {
    **{book.name: lambda book=book: _of_book(book) for book in BOOKS},
    **{name: lambda name=name: _of_model(name, Mechanism.load(MODELS[name])) for name in derived.MODELS},
    **{name: lambda name=name, text=text: _of_model(name, Mechanism.loads(text)) for name, text in GENERATED.items()},
}
"""How to make the bench of each model."""
