"""What rigid bodies do not decide: balls that strike at once, and the rules one may choose."""

from __future__ import annotations

import math

import numpy as np
import pytest
from seen import changes, model, motion

ROW = """
gravity: none
parameters: {{gap: 0 m, e: 1}}
bodies: {{{bodies}}}
ground: {{points: {{P: [0, 0], Q: [1, 0]}}}}
joints: {{{joints}}}
{touching}
initial: {{xa: -0.5 m, xb: 0, xc: 0.1 m + gap, rates: {{xa: 1 m/s}}}}
"""


def row(touching: str, masses: tuple[float, float, float] = (1, 1, 1)) -> str:
    """Three balls of diameter 0.1 m on a line, two of them together and the first on its way to them."""
    balls = list(zip("abc", masses, strict=True))
    bodies = ", ".join(f"{n}: {{shape: disk, radius: 0.05 m, mass: {m} kg}}" for n, m in balls)
    slide = "type: slider, along: [ground.P, ground.Q], line"
    joints = ", ".join(f"j{n}: {{{slide}: {{through: {n}.centre, angle: 0}}, coordinate: x{n}}}" for n, _ in balls)
    return ROW.format(bodies=bodies, joints=joints, touching=touching)


STOPS = "stops: {ab: {of: xb - xa, least: 0.1 m, restitution: e}, bc: {of: xc - xb, least: 0.1 m, restitution: e}}"
DISKS = "contacts: {ab: {of: [a, b], restitution: e}, bc: {of: [b, c], restitution: e}}"
BOTH = pytest.mark.parametrize("touching", [STOPS, DISKS], ids=["stops", "disks"])


@BOTH
def test_balls_that_strike_at_once_end_the_run_by_name(touching):
    run = model(row(touching)).simulate(until=2)
    outcome = run.outcome
    assert (outcome.name, outcome.ok) == ("simultaneous_impact", False)
    assert outcome.t == pytest.approx(0.4, abs=1e-12)
    for word in ("`ab`", "`bc`", "newton", "poisson", "sequential", "1.000000, 0.000000", "0.000000, 1.000000"):
        assert word in outcome.sentence


NEWTON = (-1 / 3, 2 / 3, 2 / 3)


@BOTH
@pytest.mark.parametrize("law, after", [("newton", NEWTON), ("poisson", NEWTON), ("sequential", (0, 0, 1))])
def test_the_rules(touching, law, after):
    """Newton: ẋb − ẋa = 1 and ẋc − ẋb = 0 with the momentum kept. One after the other: equal balls swap their speeds."""
    run = motion(row(touching), 2, {"impacts": law})
    assert run.u[-1] == pytest.approx(after, abs=1e-14)
    assert run.evaluate("kinetic()", 2.0) == pytest.approx(0.5, abs=1e-14)


@BOTH
def test_a_small_gap_decides(touching):
    """With any gap the impacts come one after the other, and no rule is needed."""
    for gap in (0.1, 1e-3, 1e-6):
        run = motion(row(touching), 2, gap=gap)
        assert run.u[-1] == pytest.approx((0, 0, 1), abs=1e-12)
        assert [tuple(i.of) for i in changes(run, "impact")] == [("ab",), ("bc",)]


@BOTH
def test_unequal_balls_strike_as_often_as_it_takes(touching):
    """Central impacts of e = 1, worked by hand for as long as a ball is faster than the next one."""
    masses, v, law = (3.0, 1.0, 2.0), [1.0, 0.0, 0.0], []
    while pairs := [i for i in (0, 1) if v[i] > v[i + 1] + 1e-12]:
        i = pairs[0]
        push = 2 * masses[i] * masses[i + 1] / (masses[i] + masses[i + 1]) * (v[i] - v[i + 1])
        v[i], v[i + 1] = v[i] - push / masses[i], v[i + 1] + push / masses[i + 1]
        law.append(i)
    assert len(law) == 3
    run = motion(row(touching, masses), 2, {"impacts": "sequential"})
    assert run.u[-1] == pytest.approx(v, abs=1e-12)


@BOTH
def test_plastic_balls_go_on_as_one(touching):
    """With e = 0 every rule gives the common speed, so the run needs none; two thirds of the energy are lost."""
    run = motion(row(touching), 2, e=0)
    assert run.u[-1] == pytest.approx([1 / 3] * 3, abs=1e-14)
    assert sum(i.lost for i in changes(run, "impact")) == pytest.approx(1 / 3, abs=1e-14)


def test_a_corner_is_struck_symmetrically_only_by_symmetry():
    """A ball runs into a wedge of two walls at right angles along its middle: every rule throws it straight back."""
    text = """
gravity: none
bodies: {ball: {shape: disk, radius: 0.1 m, mass: 1 kg}}
ground: {points: {O1: [-1, 1], M: [0, 0], O2: [1, 1]}}
contacts:
  left: {of: [ball, [ground.O1, ground.M]], restitution: 1}
  right: {of: [ball, [ground.M, ground.O2]], restitution: 1}
initial: {ball.x: 0, ball.y: 1 m, rates: {ball.y: -1}}
"""
    run = motion(text, 1.5)
    assert run.u[-1] == pytest.approx([0, 1, 0], abs=1e-13)
    (impact,) = {round(i.t, 12) for i in changes(run, "impact")}
    assert impact == pytest.approx(1 - 0.1 * math.sqrt(2), abs=1e-12)
    assert np.abs(run.q[:, 0]).max() < 1e-14
