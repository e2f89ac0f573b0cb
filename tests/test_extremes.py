"""Extremes in reports and their times, beside closed forms."""

import numpy as np
import pytest

import freebody as fb
from freebody.run.records import Window, maxima

OSCILLATOR = """
freebody: 1
gravity: none
bodies: {b: {shape: particle, mass: 2}}
joints: {J: {type: free, of: [ground.O, b.centre], coordinates: [s, h]}}
forces: {k: {type: law, along: s, value: -8*s}, fall: {type: force, at: b.centre, x: 0, y: -4}}
initial: {s: 0.3, h: 0, rates: {s: 1.5, h: 3}}
run: {until: 10}
report:
  furthest: max of s
  back: minima of s
  fastest: maxima of abs(rate(s))
  pull: maxima of k.value
  apex: max of h
  part: maxima of s over 2 s .. 5 s
  clock: minima of t
"""
AMPLITUDE, PHASE = float(np.hypot(0.3, 0.75)), float(np.arctan2(0.75, 0.3))
"""s = A cos(2 t − φ); h = 3 t − t²."""

MEANS = """
report:
  mean: mean of s over 2 s .. 5 s
  rms: {rms: s, over: [2 s, 5 s]}
  sum: integral of s over 2 s .. 5 s
"""

CRANK_ROCKER = """
freebody: 1
parameters: {a: 0.1 m, b: 0.25 m, c: 0.3 m, d: 0.35 m}
gravity: none
ground: {points: {D: [d, 0]}}
bodies: {crank: {shape: rod, length: a, mass: 1}, coupler: {shape: rod, length: b, mass: 1}, rocker: {shape: rod, length: c, mass: 1}}
joints:
  A: {type: hinge, of: [ground.O, crank.start], coordinate: phi}
  B: {type: hinge, of: [crank.end, coupler.start], coordinate: {name: beta, absolute: true}}
  C: {type: hinge, of: [ground.D, rocker.start], coordinate: psi}
  D: {type: hinge, of: [coupler.end, rocker.end]}
motions: {motor: {of: phi, is: 0.5 + 2*t}}
initial: {phi: 0.5, guess: {beta: 0.9, psi: 1.9}}
run: {until: 4}
report: {most: max of psi, least: min of psi}
"""


def test_means_over_a_window():
    """s = A cos τ with τ = 2 t − φ: ∫ s dt = A/2 sin τ, ∫ s² dt = A² (τ/2 + sin 2τ/4)/2."""
    found = fb.Mechanism.loads(OSCILLATOR[: OSCILLATOR.index("report:")] + MEANS).simulate(rtol=1e-12).report
    first, last = 2 * 2 - PHASE, 2 * 5 - PHASE
    area = AMPLITUDE / 2 * (np.sin(last) - np.sin(first))
    squares = AMPLITUDE**2 / 2 * ((last - first) / 2 + (np.sin(2 * last) - np.sin(2 * first)) / 4)
    assert [found[name].value for name in ("mean", "rms", "sum")] == pytest.approx(
        [area / 3, np.sqrt(squares / 3), area], abs=1e-11
    )


@pytest.mark.parametrize("rtol", [1e-9, 1e-12])
def test_extremes_of_an_oscillator_and_of_a_throw(rtol):
    report = fb.Mechanism.loads(OSCILLATOR).simulate(rtol=rtol).report
    near = {"abs": 30 * rtol}
    assert report["furthest"].value == pytest.approx(AMPLITUDE, **near)
    assert (report["apex"].t, report["apex"].value) == pytest.approx((1.5, 2.25), **near)
    for label, first, every in (("back", np.pi, 2 * np.pi), ("fastest", np.pi / 2, np.pi), ("pull", np.pi, 2 * np.pi)):
        times = [figure.t for name, figure in report.items() if name.startswith(f"{label}[")]
        known = [t for t in (PHASE + first + every * np.arange(10)) / 2 if t < 10]
        assert times == pytest.approx(known, **near), label
    assert [name for name in report if name.startswith("part")] == ["part[1]"]
    assert report["part[1]"].t == pytest.approx((PHASE + 2 * np.pi) / 2, **near)
    assert report["clock"].value is None and report["clock"].note == "there are no minima"


def test_a_rocker_turns_back_where_crank_and_coupler_align():
    """Haug 1989, *Computer-Aided Kinematics and Dynamics*, 3.6: the distance from crank to rocker is then b ± a."""
    a, b, c, d = 0.1, 0.25, 0.3, 0.35
    report = fb.Mechanism.loads(CRANK_ROCKER).simulate(rtol=1e-12).report

    def angle(reach: float) -> float:
        return float(np.pi - np.arccos((c * c + d * d - reach * reach) / (2 * c * d)))

    assert report["most"].value == pytest.approx(angle(b - a), abs=1e-12)
    assert report["least"].value == pytest.approx(angle(b + a), abs=1e-12)
    for figure, reach, side in ((report["most"], b - a, np.pi), (report["least"], b + a, 0.0)):
        crank = np.arccos((reach * reach + d * d - c * c) / (2 * reach * d)) + side
        assert np.sin((0.5 + 2 * figure.t - crank) / 2) == pytest.approx(0.0, abs=1e-11)


@pytest.mark.parametrize(("ripple", "found"), [(1e-3, 10), (1e-11, 10), (2e-14, 0)])
def test_what_rises_and_falls_by_round_off_is_level(ripple, found):
    """5 + r sin 2π t has its maxima at 1/4, 5/4 …"""
    peaks = maxima(lambda t: 5 + ripple * np.sin(2 * np.pi * t), Window(np.linspace(0, 10, 41)))
    assert [t for t, _ in peaks] == pytest.approx((0.25 + np.arange(10))[:found], abs=1e-2)


SINGULAR = """
freebody: 1
gravity: none
bodies: {b: {shape: particle, mass: 2}}
initial: {b.x: 0, b.y: 0, rates: {b.x: 1, b.y: 0}}
run: {until: 2}
events: {e: {EVENT}}
report: {sum: integral of 1/abs(READ - A)^p, mean: mean of 1/abs(READ - A)^p}
"""


@pytest.mark.parametrize("event", ["at: A s", "when: b.x - A"])
@pytest.mark.parametrize("read", ["t", "b.x"])
@pytest.mark.parametrize("a", [0.3, 1.0])
@pytest.mark.parametrize("p", [0.5, 0.8])
def test_an_integral_over_what_is_singular_where_something_happens(event, read, a, p):
    """∫ |t − a|^(−p) dt = (a^(1−p) + (2 − a)^(1−p))/(1 − p), for x = t."""
    text = SINGULAR.replace("EVENT", event).replace("READ", read).replace("A", str(a)).replace("^p", f"^{p}")
    known, true = fb.Mechanism.loads(text).simulate().accuracy.report, (a ** (1 - p) + (2 - a) ** (1 - p)) / (1 - p)
    for name, expected in (("sum", true), ("mean", true / 2)):
        assert known[name].value == pytest.approx(expected, rel=1e-9) and known[name].value.error < 1e-8
