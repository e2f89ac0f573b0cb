"""How far ``freebody check`` can be trusted: correct equations rearranged, and correct equations with one slip.

    python benchmarks/check.py [--count 2000] [--sample N] [--seed 1] [--show]
    python benchmarks/check.py --sizes [3 6 10 20]

A false alarm is a correct equation not called true. A mutant is left out where it is true as well, by its values at true
states of another draw. A slip is found where the equation before it is among the smallest corrections, judged by values at
places that are no true states. The models and their correct equations are in tests/check/corpus.py. With ``--sizes`` one statement is
timed instead, right and wrong, about chains of so many bars, open and closed.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from multiprocessing import get_context
from pathlib import Path

for _threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_threads, "1")  # two processes share the machine

import numpy as np

_TESTS = Path(__file__).parents[1] / "tests"
sys.path[:0] = [str(_TESTS), str(_TESTS / "check")]

from corpus import BENCHES, Outcome
from derivations import SIZES, chain

from freebody.check import Kind
from freebody.equations import text

_TRIES = 20  # for a mutant that is not true as well


def outcomes(model: str, correct: int, slips: int, seed: int) -> list[Outcome]:
    """What becomes of so many statements about one model."""
    bench, rng = BENCHES[model](), np.random.default_rng([seed, list(BENCHES).index(model)])
    made = [bench.correct(rng) for _ in range(correct)]
    return made + [outcome for _ in range(slips) if (outcome := _mutated(bench, rng)) is not None]


def _mutated(bench: object, rng: np.random.Generator) -> Outcome | None:
    return next((o for o in (bench.mutated(rng) for _ in range(_TRIES)) if o is not None), None)  # type: ignore[attr-defined]


def _of_model(job: tuple[str, int], seed: int) -> list[Outcome]:
    model, count = job
    return outcomes(model, count, count, seed)


def every(count: int, seed: int, models: Sequence[str]) -> Iterator[Outcome]:
    """``count`` correct equations and as many mutants, of all models alike, made by two processes."""
    shares = (count // len(models) + (i < count % len(models)) for i in range(len(models)))
    jobs = [(model, share) for model, share in zip(models, shares, strict=True) if share]
    with get_context("spawn").Pool(2) as pool:
        for i, found in enumerate(pool.imap_unordered(partial(_of_model, seed=seed), jobs), 1):
            alarms = sum((o.kind is Kind.TRUE) == bool(o.slip) for o in found)
            lost = sum(not o.found for o in found)
            print(f"{i} of {len(jobs)} {found[0].model}: {alarms} wrong, {lost} not found", file=sys.stderr)
            yield from found


def table(done: Sequence[Outcome], show: bool) -> Iterator[str]:
    """The numbers, and every statement that the check gets wrong."""
    correct, slips = [o for o in done if not o.slip], [o for o in done if o.slip]
    alarms, accepted = [o for o in correct if o.kind is not Kind.TRUE], [o for o in slips if o.kind is Kind.TRUE]
    models = len({o.model for o in done})
    yield f"correct, rearranged: {len(correct)} from {models} models; false alarms {len(alarms)}; {_times(correct)}"
    yield f"one slip: {len(slips)} from {models} models; accepted {len(accepted)}; {_times(slips)}"
    shares = [100 * np.mean([flag(o) for o in slips]) for flag in (lambda o: o.found, lambda o: o.first)]
    yield f"slip among the smallest corrections {shares[0]:.1f} %, the first of them {shares[1]:.1f} %"
    total, found = Counter(o.slip for o in slips), Counter(o.slip for o in slips if o.found)
    yield from (f"  {slip:14} {found[slip]:5} of {total[slip]}" for slip in sorted(total))
    yield from (f"ALARM {o.model}: {o.kind.value}: {o.after}" for o in alarms)
    for outcome in (*accepted, *(o for o in slips if show and not o.found)):
        word = "ACCEPTED" if outcome.kind is Kind.TRUE else "missed"
        yield f"{word} {outcome.model} ({outcome.slip}): {outcome.after}\n    was {outcome.before}"
        yield from (f"    mend {mend}" for mend in outcome.mends)


def _times(done: Iterable[Outcome]) -> str:
    taken = [o.seconds for o in done] or [0.0]
    return f"{1e3 * np.median(taken):.0f} ms in the median, {1e3 * max(taken):.0f} ms at most"


def sizes(numbers: Sequence[int]) -> Iterator[str]:
    """Processor seconds for the last balance of a chain, and for that with a side of the wrong sign, each told of a fresh model."""
    for number in numbers:
        for closed in (False, True):
            derived = chain(number, closed=closed).equations()
            last = [part for part in derived.parts if "MB" in part.title][-1]
            left, right = (text(side, derived.letters) for side in (last.left, last.right))
            said, taken = (f"{left} = {right}", f"{left} = -({right})"), []
            for statement in said:
                began = time.process_time()
                verdict = chain(number, closed=closed).check(statement)
                taken.append(f"{time.process_time() - began:.2f} s {verdict.kind.value}")
            yield f"{number:3} bars, {'closed' if closed else 'open'}: right {taken[0]}, wrong {taken[1]}"


def main() -> None:
    """Print the table."""
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--count", type=int, default=2000, help="correct equations, and as many mutants")
    arguments.add_argument("--sample", type=int, help="so many instead: a quick look")
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--models", nargs="*", default=[], help="words in the names of models; all without")
    arguments.add_argument("--show", action="store_true", help="print every slip that is not found")
    arguments.add_argument(
        "--sizes", nargs="*", type=int, help="bars of chains about which one statement is timed; 3 6 10 20 without"
    )
    given = arguments.parse_args()
    if given.sizes is not None:
        for line in sizes(given.sizes or SIZES):
            print(line, flush=True)
        return
    models = [name for name in BENCHES if not given.models or any(word in name for word in given.models)]
    print("\n".join(table(list(every(given.sample or given.count, given.seed, models)), given.show)))


if __name__ == "__main__":
    main()
