"""Blocks that stay, balls that bounce: closed forms of contacts without sliding."""

from __future__ import annotations

import math

import numpy as np
import pytest
from seen import changes, model, motion

G = 9.81

SLOPE = """
parameters: {a: 20 deg, at: 0.1 m, v: 0 m/s}
bodies: {block: {shape: rectangle, width: 0.4 m, height: 0.2 m, mass: 2 kg}}
ground: {lines: {slope: {through: ground.O, angle: a}}}
contacts: {slope: {of: [block, ground.slope], friction: 0.3, static_friction: 0.5}}
initial: {block.x: -at*sin(a), block.y: at*cos(a), block.angle: a, rates: {block.x: v*cos(a), block.y: v*sin(a)}}
"""


@pytest.mark.parametrize("degrees", [0, 10, 20, 26.5])
def test_a_block_inside_the_cone_does_not_creep(degrees):
    """tan 26.5° < 0.5: over 1000 s not one bit of the state changes."""
    run = motion(SLOPE, 1000, a=math.radians(degrees))
    q, u = run.motion.sample(np.linspace(0, 1000, 1001))
    assert (q == q[0]).all() and (u == 0).all()
    weight = 2 * G
    assert run.evaluate("slope.N", 500.0) == pytest.approx(weight * math.cos(math.radians(degrees)), rel=1e-12)
    assert run.evaluate("slope.Fy", 500.0) == pytest.approx(weight, rel=1e-12)


@pytest.mark.parametrize("past", [1e-6, 1e-9, 1e-12])
def test_the_block_slides_just_where_the_slope_leaves_the_cone(past):
    """Static friction 0.5 carries up to tan α = 0.5; beyond it sliding friction 0.3 leaves g (sin α − 0.3 cos α)."""
    edge = math.atan(0.5)
    assert model(SLOPE).solve(a=edge - past)["accel(block.x)"] == 0
    slides = model(SLOPE).solve(a=edge + past)
    assert slides["accel(block.x)"] == pytest.approx(-G * (math.sin(edge) - 0.3 * math.cos(edge)) * math.cos(edge), rel=1e-5)


def test_a_block_thrown_up_the_slope_comes_to_rest_and_stays():
    """At 20° it decelerates by g (sin α + 0.3 cos α), and static friction then holds it."""
    run = motion(SLOPE, 1.5, v=2)
    a = math.radians(20)
    braking = G * (math.sin(a) + 0.3 * math.cos(a))
    (stick,) = changes(run, "stick")
    assert stick.t == pytest.approx(2 / braking, abs=1e-9)
    way = np.hypot(*(run.q[-1, :2] - run.q[0, :2]))
    assert way == pytest.approx(2 / braking, abs=1e-9)  # v²/2 over it, with v = 2
    assert (run.u[-1] == 0).all()


BALL = """
bodies: {ball: {shape: particle, mass: 1 kg}}
ground: {points: {A: [0, 0], B: [1, 0]}, lines: {floor: [A, B]}}
contacts: {floor: {of: [ball, ground.floor], restitution: 0.7}}
initial: {ball.x: 0, ball.y: 1 m, at_rest: true}
"""


def test_bounces_without_end_end():
    """The k-th impact is at √(2h/g) (1 + 2 Σ eʲ), j = 1 … k, and all are over at √(2h/g) (1 + e)/(1 − e)."""
    run = motion(BALL, 5)
    e, fall = 0.7, math.sqrt(2 / G)
    impacts = changes(run, "impact")
    known = [fall * (1 + 2 * (e - e ** (k + 1)) / (1 - e)) for k in range(len(impacts))]
    assert [impact.t for impact in impacts] == pytest.approx(known, abs=1e-9)
    assert [i.after["u"][1] / i.before["u"][1] for i in impacts] == pytest.approx([-e] * len(impacts), rel=1e-12)
    (rest,) = changes(run, "rest")
    assert rest.t == pytest.approx(fall * (1 + e) / (1 - e), abs=1e-9)
    assert len(changes(run)) <= 200
    assert rest.lost > 0 and run.energy["impacts"][-1] == pytest.approx(-sum(change.lost for change in changes(run)), rel=1e-13)
    after = run.motion.sample(np.linspace(rest.t, 5, 50))
    assert np.abs(after[0]).max() < 1e-15 and (after[1] == 0).all()
    assert run.evaluate("floor.N", 4.0) == pytest.approx(G, rel=1e-14)


def test_rest_takes_no_steps():
    """At rest a step is as long as its growth allows, sixfold each: twice the time takes one step more at most."""
    steps = {until: len(motion(BALL, until).motion.steps) for until in (5, 10, 20, 1000)}
    assert steps[10] - steps[5] <= 1 and steps[20] - steps[10] <= 1
    assert steps[1000] - steps[5] <= 4


BILLIARD = """
gravity: none
parameters: {b: 0.37, r: 1 m}
bodies: {ball: {shape: particle, mass: 1}}
contacts: {wall: {of: [ball, {centre: ground.O, radius: r, hollow: true}], restitution: 1}}
initial: {ball.x: r*sin(b), ball.y: 0, rates: {ball.x: 0, ball.y: 1 m/s}}
"""


@pytest.mark.parametrize("count", [1000, pytest.param(10_000, marks=pytest.mark.long)])
def test_bounces_in_a_circle(count):
    """Chords that meet the wall at β from its normal: each turns the place of impact by π − 2β and takes 2 cos β."""
    beta = 0.37
    run = motion(BILLIARD, 2 * math.cos(beta) * count)
    impacts = changes(run)
    assert {change.kind for change in impacts} == {"impact"} and len(impacts) == count
    k = np.arange(count)
    q, u = (np.array([i.after[part] for i in impacts]) for part in ("q", "u"))
    turned = np.arctan2(q[:, 1], q[:, 0]) - (math.pi / 2 - beta) - k * (math.pi - 2 * beta)
    assert np.abs(np.angle(np.exp(1j * turned))).max() < 1e-8
    assert np.abs([i.t for i in impacts] - math.cos(beta) * (1 + 2 * k)).max() < 1e-8
    assert np.abs(np.hypot(*u.T) - 1).max() < 1e-10
    assert np.abs(np.hypot(*q.T) - 1).max() < 1e-10
    assert np.abs(q[:, 0] * u[:, 1] - q[:, 1] * u[:, 0] - math.sin(beta)).max() < 1e-10
