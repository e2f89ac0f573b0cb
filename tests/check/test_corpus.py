"""A sample of what ``benchmarks/check.py`` counts at length: no false alarm, no slip accepted, the slip named."""

from __future__ import annotations

import numpy as np
import pytest
from corpus import BENCHES, Bench, Outcome
from generated import GENERATED
from independent import holds, says_the_same
from store import family

from freebody.check import Kind
from freebody.check.language.parser import parse
from freebody.mechanism import Mechanism
from freebody.symbolic.tree import Sym

_EACH = 2  # correct equations, and as many with a slip, of each model
_SLOW = ("chain of 3 rods", "GEN-FOURBAR", "S19.20", "S19.21")
MODELS = [name for name in BENCHES if not any(word in name for word in _SLOW)]


@pytest.fixture(scope="module", params=family(MODELS, group="corpus"))
def bench(request: pytest.FixtureRequest) -> Bench:
    return BENCHES[request.param]()


def test_correct_equations_are_true_however_they_are_arranged(bench: Bench) -> None:
    rng = np.random.default_rng(11)
    for outcome in (bench.correct(rng) for _ in range(_EACH)):
        assert outcome.kind is Kind.TRUE, outcome.after


def test_no_slip_is_accepted(bench: Bench, outcomes: list[Outcome]) -> None:
    rng = np.random.default_rng(12)
    for outcome in (bench.mutated(rng) for _ in range(_EACH)):
        if outcome is not None:
            assert outcome.kind is not Kind.TRUE, outcome.after
            outcomes.append(outcome)
    missed = [f"{outcome.after} was {outcome.before}" for outcome in outcomes if not outcome.found]
    assert len(missed) <= 1 + 0.05 * len(outcomes), missed


@pytest.fixture(scope="module")
def outcomes() -> list[Outcome]:
    """What the check said of all models so far."""
    return []


def test_models_made_by_rule_have_as_many_freedoms_as_their_name_says() -> None:
    stated = {name: Mechanism.loads(text).compile().metadata for name, text in GENERATED.items()}
    counts = {name: len(metadata["coordinates"]) for name, metadata in stated.items()}
    assert counts == {
        "chain of 1 rods": 1, "chain of 2 rods": 2, "chain of 3 rods": 3, "trolley with 1": 2, "trolley with 2": 3,
        "row of 2 blocks": 2, "row of 3 blocks": 3,
    }  # fmt: skip


def _read(text: str):
    return parse(text, ["a", "b", "c", "x"]).equations[0]


def test_equations_say_the_same_where_they_hold_at_the_same_places() -> None:
    at = dict(zip(map(Sym, "abcx"), np.random.default_rng(1).uniform(0.4, 1.6, (4, 9)), strict=True))
    assert says_the_same(_read("a x + b = c"), _read("3 (c - b)/x = 3 a"), at)
    assert not says_the_same(_read("a x + b = c"), _read("a x + b = c + a"), at)
    assert not says_the_same(_read("a x + b = c"), _read("a = a"), at)
    assert holds(_read("sin(x)^2 + cos(x)^2 = 1"), at) and not holds(_read("sin(x)^2 = cos(x)^2"), at)
