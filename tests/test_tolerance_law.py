"""The error of a motion is at most thirty times what was asked, times the sensitivity of the motion itself."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from store import MODELS, every

import freebody as fb
from freebody.core import Array, quote
from freebody.run.simulation import Run, simulate

ACCURACY = Path(__file__).parents[1] / "benchmarks" / "accuracy"
REFERENCES = {
    **{name: ACCURACY / f"{name}.yaml" for name in ("andrews", "pendulum", "double_pendulum", "four_bar")},
    **{Path(name).name: MODELS[name] for name in ("examples/four_bar", "examples/new_gun", "examples/tossed_box")},
}
"""Andrews' squeezing mechanism (IVP test set; its digits at 0.03 s are held by benchmarks/accuracy), pendulums, linkages."""
METHODS = ("dop853", "tsit5", "radau")
LAW = {
    f"{name} {method} 1e-{digits}": (name, method, 10.0**-digits)
    for name, method, digits in product(REFERENCES, METHODS, range(3, 14))
}
TIGHTEST = 1e-14
SMALL = 1e-7
"""Relative change of the start, large beside the error of the runs and small beside what bends."""


def figures(run: Run) -> list[Array]:
    """Coordinates, their rates and accelerations at sixty times."""
    times = np.linspace(*run.edges[[0, -1]], 61)[1:]
    accelerations = [f"accel({quote(coordinate['name'])})" for coordinate in run.metadata["coordinates"]]
    return [*map(np.asarray, run.motion.sample(times)), np.asarray(run.motion.evaluate(accelerations, times))]


@cache
def known(name: str) -> tuple[fb.Mechanism, list[Array], list[Array]]:
    """The mechanism, its figures at the tightest tolerance, and what is owed of each for a tolerance of 1: its largest size, and its
    change so far per relative change of each coordinate and rate of the start."""
    mechanism = fb.load(REFERENCES[name])
    run = mechanism.simulate(rtol=TIGHTEST)
    exact = figures(run)
    owed = [np.zeros_like(each) for each in exact]
    for part in ("q", "u"):
        for i in np.flatnonzero(getattr(run.start, part)):
            start = getattr(run.start, part).copy()
            start[i] *= 1 + SMALL
            moved = figures(simulate(run.source, replace(run.start, **{part: start}), run.settings))
            owed = [sum_ + np.abs(a - b) / SMALL for sum_, a, b in zip(owed, moved, exact, strict=True)]
    return mechanism, exact, [np.maximum.accumulate(sum_) + np.abs(a).max(0) for sum_, a in zip(owed, exact, strict=True)]


@every(LAW, "case", share=24)
def test_the_error_is_what_was_asked_times_the_sensitivity_of_the_motion(case):
    name, method, rtol = LAW[case]
    mechanism, exact, owed = known(name)
    found = figures(mechanism.simulate(method=method, rtol=rtol))
    for what, a, b, most in zip(("places", "rates", "accelerations"), found, exact, owed, strict=True):
        assert (np.abs(a - b) <= 30 * rtol * most).all(), what


@pytest.mark.parametrize("name", ["andrews", "double_pendulum"])
def test_two_methods_agree_on_the_references(name):
    """The explicit method of order 8 and the implicit one of order 5 share no formula."""
    mechanism, exact, owed = known(name)
    for a, b, most in zip(figures(mechanism.simulate(method="radau", rtol=1e-13)), exact, owed, strict=True):
        assert (np.abs(a - b) <= 3e-12 * most).all()
