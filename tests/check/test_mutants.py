"""A sample of what ``benchmarks/check.py`` counts at length: no false alarm, no mutant accepted, the planted slip found."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))

from check import Bench, correct, mutated
from textbook import BOOKS, Book

from freebody.check import Kind


@pytest.fixture(scope="module", params=BOOKS, ids=lambda book: book.name)
def bench(request: pytest.FixtureRequest) -> Bench:
    book: Book = request.param
    return Bench(book)


def test_no_false_alarm(bench: Bench) -> None:
    rng = np.random.default_rng(11)
    for _ in range(6):
        text, kind, _ = correct(bench, rng)
        assert kind is Kind.TRUE, text


def test_no_mutant_is_accepted_and_most_slips_are_found(bench: Bench) -> None:
    rng = np.random.default_rng(12)
    done = [outcome for outcome in (mutated(bench, rng) for _ in range(6)) if outcome is not None]
    assert done
    for outcome in done:
        assert not outcome.accepted, outcome.after
    assert sum(not outcome.found for outcome in done) <= 1, [o.after for o in done if not o.found]
