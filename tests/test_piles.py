"""Piles of ``benchmarks/piles.py`` that are hard to follow."""

import runpy
from pathlib import Path
from time import process_time

import pytest

PILE = runpy.run_path(str(Path(__file__).parents[1] / "benchmarks" / "piles.py"))["pile"]


@pytest.mark.parametrize(
    ("bodies", "seed", "until"),
    [
        pytest.param(10, 937, 0.6, id="a disk slides between two that roll, and they share more friction than is determined"),
        pytest.param(
            20,
            30,
            1.24,
            id="what came to rest without friction and holds by it now is not let go as something else comes to rest",
        ),
    ],
)
def test_a_pile_goes_on_where_one_mode_leads_to_the_next(bodies, seed, until):
    began = process_time()
    run = PILE(bodies, seed).simulate(until, progress=lambda *_: process_time() - began < 20, impacts="newton", painleve="impact")
    assert run.outcome.ok and len(run.changes) < 2000, run.outcome
