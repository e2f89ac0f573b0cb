"""Rates of reactions, forces, energies and accelerations along a motion: closed forms, power laws, events and extremes."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from seen import model, motion
from store import MODELS, run

import freebody as fb

PENDULUM = """
parameters: {l: 0.8 m, m: 1.5 kg}
bodies: {bob: {shape: particle, mass: m}}
joints: {rope: {type: link, of: [ground.O, bob.centre], length: l}, arm: {type: polar, of: [ground.O, bob.centre], coordinates: [r, phi]}}
gauges: {theta: phi + pi/2}
initial: {r: l, phi: 10 deg, at_rest: true}
"""
"""Tension T = m (g cos θ + l ω²), and ω̇ = −(g/l) sin θ."""

RATES = {
    "rate(rope.tension)": lambda theta, omega: -3 * 1.5 * 9.81 * omega * np.sin(theta),
    "rate(rope.tension^2)/(2*rope.tension)": lambda theta, omega: -3 * 1.5 * 9.81 * omega * np.sin(theta),
    "rate(accel(theta))": lambda theta, omega: -9.81 / 0.8 * omega * np.cos(theta),
    "rate(rate(theta))": lambda theta, omega: -9.81 / 0.8 * np.sin(theta),
    "rate(theta*rate(theta))": lambda theta, omega: omega**2 - 9.81 / 0.8 * theta * np.sin(theta),
    "rate(kinetic())": lambda theta, omega: -1.5 * 9.81 * 0.8 * omega * np.sin(theta),
    "rate(energy())/10": lambda theta, omega: 0 * theta,
}


@pytest.mark.parametrize("text", RATES)
def test_rates_are_those_of_the_closed_form(text):
    swing = motion(PENDULUM, 1.5, {"rtol": 1e-11})
    t = np.linspace(0, 1.5, 31)
    known = RATES[text](swing.evaluate("theta", t), swing.evaluate("rate(theta)", t))
    assert_allclose(swing.evaluate(text, t), known, rtol=0, atol=1e-9)


def test_an_event_on_the_rate_of_a_tension_is_at_its_extremes():
    """At the lowest place, and where the bob comes to rest: multiples of a quarter of the period."""
    text = PENDULUM + "events: {extreme: {when: rate(rope.tension), then: record}, low: {when: theta, then: record}}\n"
    swing = motion(text, 3.0, {"rtol": 1e-11})
    times = [event.t for event in swing.events if event.name == "extreme"]
    low = [event.t for event in swing.events if event.name == "low"]
    assert len(times) == len(low) * 2 - (times[-1] in low) or len(times) == len(low) * 2
    assert_allclose(times[0::2], low, atol=1e-10)
    assert_allclose(times[1::2], [2 * (i + 1) * low[0] for i in range(len(times[1::2]))], atol=1e-9)


DRIVEN = """
gravity: none
parameters: {c: 1 m}
bodies: {a: {shape: particle, mass: 2}}
joints: {A: {type: free, of: [ground.O, a.centre], coordinates: [x, y]}}
motions: {drive: {of: x, is: c*sin(3*t)}, hold: {of: y, is: 0}}
events: {peak: {when: rate(drive.force), direction: DIRECTION, then: THEN}}
"""


@pytest.mark.parametrize(("direction", "first"), [("rising", 1.5), ("falling", 0.5)])
def test_an_event_on_the_rate_of_a_driving_force(direction, first):
    """The force −18 sin 3t has its extremes at odd multiples of π/6."""
    moved = motion(DRIVEN.replace("DIRECTION", direction).replace("THEN", "record"), 3.0)
    turns = {"rising": 0.5, "falling": 1.5}[direction]
    expected = [(turns + 2 * i) * math.pi / 3 for i in range(3) if (turns + 2 * i) * math.pi / 3 < 3]
    assert first and [event.t for event in moved.events] == pytest.approx(expected, abs=1e-11)
    assert moved.evaluate("rate(drive.work) - drive.power", 1.234) == pytest.approx(0, abs=1e-9)


def test_an_event_on_a_rate_may_end_the_run():
    ended = model(DRIVEN.replace("DIRECTION", "rising").replace("THEN", "stop")).simulate(until=3.0)
    assert ended.outcome.name.value == "StoppedByEvent" and ended.edges[-1] == pytest.approx(math.pi / 6, abs=1e-11)


@pytest.mark.parametrize("text", ["accel(A.F)", "rate(rate(A.F))", "rate(2*rate(kinetic()))", "accel(rate(x))"])
def test_second_rates_are_refused(text):
    with pytest.raises(fb.ModelError, match=r"second time derivative|of a time derivative"):
        model(DRIVEN.replace("DIRECTION", "rising").replace("THEN", "record")).simulate(until=0.1).evaluate(text, 0.05)


@pytest.mark.parametrize(("name", "texts"), [("examples/four_bar", ["C.F", "A.Fx", "energy()", "accel(phi)"])])
def test_rates_are_the_slopes_of_what_the_run_gives(name, texts):
    """Six values along the dense output beside each time (Abramowitz & Stegun 25.3)."""
    done = run(name)
    assert name in MODELS
    h = 3e-4 * float(np.ptp(done.edges))
    for t in np.linspace(*done.edges[[0, -1]], 9)[1:-1]:
        for text in texts:
            values = done.evaluate(text, t + h * np.arange(-3, 4))
            slope = np.array([-1, 9, -45, 0, 45, -9, 1]) @ values / (60 * h)
            assert done.evaluate(f"rate({text})", t) == pytest.approx(slope, rel=1e-5, abs=1e-6 * np.abs(values).max() / h)
