"""A motion that goes on from the end of another is the motion that was not interrupted."""

from __future__ import annotations

import numpy as np
import pytest
from seen import changes, model

# A bob is cut off its cart in mid swing and falls beside a box that slides on, held by friction.
CUT = """
bodies:
  cart: {shape: particle, mass: 2}
  bob: {shape: particle, mass: 1}
  box: {shape: rectangle, width: 0.4, height: 0.2, mass: 3}
ground: {points: {A: [0, 0], B: [1 m, 0], P: [0, -3 m], Q: [1 m, -3 m]}, lines: {rail: [A, B], floor: [P, Q]}}
joints: {rail: {type: slot, along: ground.rail, point: cart.centre, coordinate: s}}
strings: {cord: {ends: [cart.centre, bob.centre]}}
contacts: {floor: {of: [box, ground.floor], friction: 0.3}}
initial: {s: 0, bob.x: 1 m, bob.y: 0, box.x: -5 m, box.y: -2.9 m, rates: {box.x: 2 m/s}}
events: {cut: {at: 0.4 s, then: {cut: cord}}}
"""


@pytest.mark.parametrize("pause", [0.2, 0.5, 0.75])
def test_a_run_goes_on_with_what_is_in_place(pause):
    whole = model(CUT).simulate(until=1.0, rtol=1e-11)
    first = model(CUT).simulate(until=pause, rtol=1e-11)
    then = first.continue_(until=1.0)
    ends = [run.motion.sample(np.array([1.0])) for run in (whole, then)]
    for a, b in zip(*ends, strict=True):
        assert np.abs(a - b).max() < 1e-9
    stops = [change.t for run in (first, then) for change in changes(run, "stick") if change.t > 0]
    assert stops == pytest.approx([2 / (0.3 * 9.81)], abs=1e-9)
