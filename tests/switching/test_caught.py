"""What is caught moves on with what caught it: momenta are kept, and accelerations are those of the motion."""

from __future__ import annotations

import numpy as np
import pytest
from seen import model

CAUGHT = """
gravity: none
parameters: {{R: 0.8 m, J: 2 kg*m^2, m: 1.5 kg, w: 0.7 rad/s, u: 2 m/s}}
bodies:
  table: {{mass: 5 kg, inertia: J, points: {{H: [R, 0]}}}}
  ball: {{shape: particle, mass: m}}
joints:
  bearing: {{type: hinge, of: [ground.O, table.origin], coordinate: a}}
  free: {{type: free, of: [ground.O, ball.centre], coordinates: [x, y]}}
  grip: {{type: hinge, of: [table.H, ball.centre], engaged: false}}
initial: {{a: {a}, x: {x}, y: {y}, rates: {{a: w, x: -u/2, y: u}}}}
events: {{catch: {{{when}, then: {{engage: grip}}}}}}
run: {{until: 1.5 s}}
"""
STARTS = {
    "at the start": {"a": 0, "x": "R", "y": 0, "when": "at: start"},
    "on the way": {"a": "-w*(0.3 s)", "x": "R + u/2*(0.3 s)", "y": "-u*(0.3 s)", "when": "at: 0.3 s"},
}


@pytest.mark.parametrize("start", STARTS)
def test_what_is_caught_keeps_the_angular_momentum(start):
    run = model(CAUGHT.format(**STARTS[start])).simulate()
    caught = next(event.t for event in run.events if event.name == "catch")
    times = np.linspace(caught + 0.05, 1.4, 9)
    momentum, rate, slope = (run.evaluate(text, times) for text in ("(J + m*R^2)*rate(a)", "rate(a)", "accel(a)"))
    assert np.allclose(momentum, momentum[0], rtol=1e-7)  # the steps' own tolerance
    assert np.allclose(momentum[0], 2 * 0.7 + 1.5 * 0.8 * 2, rtol=1e-7)  # J w + m R u
    step = 1e-3
    ahead, behind = (run.evaluate("rate(a)", times + side) for side in (step, -step))
    assert np.allclose((ahead - behind) / (2 * step), slope, atol=1e-5 * np.abs(rate).max())  # differences of second order
