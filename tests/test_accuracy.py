"""The figures of ``benchmarks/accuracy`` that take little time."""

import runpy
from pathlib import Path

import pytest
from store import but_long

ACCURACY = runpy.run_path(str(Path(__file__).parents[1] / "benchmarks" / "accuracy" / "accuracy.py"))


@pytest.mark.parametrize("check", but_long(ACCURACY["QUICK"], ACCURACY["billiard"]))
def test_every_figure_is_reached(check):
    rows = list(check())
    assert rows
    assert [f"{row.what}: {row.reached:.1e}, wanted {row.wanted:.0e}" for row in rows if not row.ok] == []


def test_a_missed_figure_is_reported():
    row = ACCURACY["Row"]
    assert row("", 1e-9, 1e-9).ok
    assert not row("", 2e-9, 1e-9).ok
    assert not row("", float("nan"), 1e-9).ok
