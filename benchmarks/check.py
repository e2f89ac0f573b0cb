"""How far ``freebody check`` can be trusted: correct equations rearranged, and correct equations with one slip.

    python benchmarks/check.py [--count 2000] [--seed 1]

A false alarm is a correct equation not called true. A mutant is discarded where it says the same as the equation it was
made from, by its values at states that are not true ones. A mend is found where the equation before the slip is among
the smallest mends, judged in the same way.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "check"))

from mutants import Mutant, mutant, rearranged
from textbook import BOOKS, Book

from freebody.check import Checker, Kind
from freebody.check.case import Case
from freebody.check.language.nodes import Equation
from freebody.check.language.spelling import spell
from freebody.check.mend import _Search, mends
from freebody.check.verdict import judged
from freebody.model import Mechanism


@dataclass
class Bench:
    """One model with its correct equations, read."""

    book: Book
    checker: Checker = field(init=False)
    equations: list[Equation] = field(init=False)

    def __post_init__(self) -> None:
        self.checker = Checker(Mechanism.loads(f"freebody: 1\n{self.book.model}"), dict(self.book.letters))
        cases = [self.checker.case(text) for text in self.book.equations]
        self.equations = [case.equations[0] for case in cases]
        self.cases = cases
        self.vocabulary = self.checker.case("\n".join(self.book.equations)).meaning.vocabulary

    def case(self, equation: Equation) -> Case:
        """An equation as if it had been typed."""
        return self.checker.case(spell(equation))


def correct(bench: Bench, rng: np.random.Generator) -> tuple[str, Kind, float]:
    """A rearranged equation with its verdict and the time that it took, s."""
    equation = rearranged(rng, bench.equations, bench.vocabulary)
    began = time.perf_counter()
    verdict = judged(bench.case(equation))
    return verdict.text, verdict.kind, time.perf_counter() - began


@dataclass(frozen=True)
class Outcome:
    """What became of a mutant: ``accepted``: it was called true; ``found``: the slip is among the smallest mends."""

    kind: str
    before: str
    after: str
    accepted: bool
    found: bool
    mends: tuple[str, ...]
    seconds: float


def mutated(bench: Bench, rng: np.random.Generator) -> Outcome | None:
    """A mutant with its verdict; None where it says the same as before, or nothing."""
    i = int(rng.integers(len(bench.equations)))
    before = bench.equations[i]
    made = mutant(rng, before, bench.vocabulary)
    if made is None:
        return None
    return judged_mutant(bench, bench.cases[i], before, made)


def judged_mutant(bench: Bench, case: Case, before: Equation, made: Mutant) -> Outcome | None:
    """What becomes of a mutant of the equation ``before``."""
    search = _Search(case, before, case.hypothesis)
    mark = search._mark(before)
    text = spell(made.equation)
    began = time.perf_counter()
    again = bench.checker.case(text)
    other = _Search(again, before, case.hypothesis)
    said = other._mark(again.equations[0])
    mark = other._mark(before) or mark
    if said is None or said == mark:
        return None
    verdict = judged(again)
    seconds = time.perf_counter() - began
    found = list(mends(again, again.equations[0])) if not verdict.mends else list(verdict.mends)
    marks = [other._mark(bench.checker.case(mend.equation).equations[0]) for mend in found]
    return Outcome(made.kind, spell(before), text, verdict.ok, mark in marks, tuple(str(mend) for mend in found), seconds)


def outcomes(count: int, seed: int) -> Iterator[Outcome]:
    """``count`` mutants of all models in turn."""
    rng, benches, done = np.random.default_rng(seed), [Bench(book) for book in BOOKS], 0
    while done < count:
        outcome = mutated(benches[done % len(benches)], rng)
        if outcome is not None:
            done += 1
            yield outcome


def main() -> None:
    """Print the table."""
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--count", type=int, default=2000)
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--show", action="store_true", help="print every miss")
    given = arguments.parse_args()
    rng, benches = np.random.default_rng(given.seed), [Bench(book) for book in BOOKS]
    rows = [correct(benches[i % len(benches)], rng) for i in range(given.count)]
    alarms = [row for row in rows if row[1] is not Kind.TRUE]
    print(
        f"correct, rearranged: {len(rows)} from {len(benches)} models; false alarms {len(alarms)}; {mean_ms(r[2] for r in rows)}"
    )
    for text, kind, _ in alarms:
        print(f"  {kind.value}: {text}")
    done = list(outcomes(given.count, given.seed))
    print(f"mutants: {len(done)}; accepted {sum(o.accepted for o in done)}; {mean_ms(o.seconds for o in done)}")
    print(f"planted edit among the smallest mends: {100 * np.mean([o.found for o in done]):.1f} %")
    total, found = Counter(o.kind for o in done), Counter(o.kind for o in done if o.found)
    for kind in sorted(total):
        print(f"  {kind:14} {found[kind]:5} of {total[kind]}")
    for outcome in done:
        if outcome.accepted or (given.show and not outcome.found):
            print(f"  {'ACCEPTED' if outcome.accepted else 'missed'} ({outcome.kind}) {outcome.after}\n    was {outcome.before}")
            print("".join(f"    mend {mend}\n" for mend in outcome.mends), end="")


def mean_ms(seconds: Iterator[float]) -> str:
    """A mean and a largest time in words."""
    taken = list(seconds)
    return f"{1e3 * np.mean(taken):.0f} ms each, {1e3 * max(taken):.0f} ms at most"


if __name__ == "__main__":
    main()
