"""Contacts that are met and left within one step: nothing small is passed through."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar
from seen import changes, model

BALL = """
gravity: none
parameters: {{r: 1 mm, x: 10 m, b: 0 m}}
bodies: {{ball: {{shape: {ball}, mass: 1 kg}}{body}}}
ground: {{points: {{P: [x, 0]}}}}
contacts: {{hit: {{of: [ball, {surface}], restitution: 1}}}}
initial: {{ball.x: 0, ball.y: b{start}, rates: {{ball.x: 1}}}}
"""
THINGS = {
    "particle on a peg": (BALL.format(ball="particle", body="", surface="{centre: ground.P, radius: r}", start=""), 1.0, 0.0),
    "disk on a disk": (
        BALL.format(
            ball="disk, radius: r/2",
            body=", other: {shape: disk, radius: r/2, mass: 1 kg}",
            surface="other",
            start=", other.x: x, other.y: 0",
        ),
        1.0,
        0.0,
    ),
    "particle on a square": (
        BALL.format(
            ball="particle",
            body=", other: {shape: rectangle, width: 2*r, height: 2*r, mass: 1 kg}",
            surface="other",
            start=", other.x: x, other.y: 0",
        ),
        0.0,
        1.0,
    ),
}


@pytest.mark.parametrize("thing", THINGS)
@pytest.mark.parametrize("until, r", [(1, 0.01), (10, 0.1), (10, 1e-3), (1000, 0.1), (1000, 0.01)])
def test_a_small_thing_in_the_way_is_struck(thing, until, r):
    """A ball at 1 m/s meets it at x − √(r² − b²), or x − r where it is square, and is in its place for 1e-5 of the run."""
    text, is_round, is_square = THINGS[thing]
    rng, m = np.random.default_rng(1), model(text)
    for _ in range(20):
        x, b = rng.uniform(0.25, 0.9) * until, rng.uniform(-0.9, 0.9) * r
        m.parameters.update(x=x, b=b, r=r)
        run = m.simulate(until=until, impacts="newton")
        assert len(changes(run, "impact")) == 1, (x, b)
        known = x - is_round * math.sqrt(r**2 - b**2) - is_square * r
        assert changes(run, "impact")[0].t == pytest.approx(known, abs=1e-9)


def test_crossings_of_a_cubic_within_one_step():
    """Events at the roots of random cubics of the time, at least 1e-6 of the step apart: each is recorded, at its time."""
    text = """
parameters: {a: 0.1, b: 0.2, c: 2}
bodies: {ball: {shape: particle, mass: 1 kg}}
gravity: none
initial: {ball.x: 0, ball.y: 0, rates: {ball.x: 1}}
events: {zero: {when: (t - a)*(t - b)*(t - c)}}
"""
    rng, m = np.random.default_rng(2), model(text)
    for _ in range(500):
        gap = 10.0 ** (-6 * rng.random())
        a = 0.001 + (0.998 - gap) * rng.random()
        b, c = a + gap, rng.choice([-1, 1]) * (1.2 + rng.random())  # c is clear of the step, and so of the other two
        m.parameters.update(a=a, b=b, c=c)
        run = m.simulate(until=1, step=1, method="rk4")
        # Between roots so near the extremum is zero to 1e-12 of the function's size: that may be recorded as a touch.
        crossings = [event.t for event in run.events if event.kind == "crossing"]
        assert crossings == pytest.approx([a, b], abs=1e-9), (a, gap, c)


PENDULUM = """
parameters: {depth: 10 m}
bodies: {upper: {shape: rod, length: 1 m, mass: 1 kg}, lower: {shape: rod, length: 1 m, mass: 1 kg}}
ground: {points: {F: [0, -depth]}, lines: {floor: {through: F, angle: 0}}}
joints:
  pivot: {type: hinge, of: [ground.O, upper.start], coordinate: a}
  elbow: {type: hinge, of: [upper.end, lower.start], coordinate: b}
contacts: {floor: {of: [lower.end, ground.floor], friction: 0.3}}
initial: {a: 0.3, b: -1.1, rates: {a: 0, b: 0}}
"""


@pytest.mark.parametrize("within", [1e-3, 1e-5, 1e-8])
def test_a_floor_is_struck_just_within_the_lowest_place(within):
    """The tip of a double pendulum comes to its lowest place, for a while far shorter than a step, and passes it where there is no floor."""
    m = model(PENDULUM)
    free = m.simulate(until=10, rtol=1e-11)
    height = lambda t: float(free.evaluate("y(lower.end)", t))
    times = np.linspace(0, 10, 20001)
    near = times[np.argmin(free.evaluate("y(lower.end)", times))]
    lowest = minimize_scalar(height, bounds=(near - 1e-3, near + 1e-3), method="bounded", options={"xatol": 1e-10})
    m.parameters["depth"] = -lowest.fun + within
    assert not changes(m.simulate(until=10, rtol=1e-11))
    m.parameters["depth"] = -lowest.fun - within
    first = changes(m.simulate(until=10, rtol=1e-11))[0]
    assert first.t == pytest.approx(brentq(lambda t: height(t) + m.parameters["depth"], near - 0.05, lowest.x), abs=1e-6)
