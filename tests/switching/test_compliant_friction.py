"""Friction of contacts for which a spring and a damper stand: closed forms, Newton's laws, the ledger."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from seen import acceleration, changes, kinds, model, motion, within

G = 9.81

BELT = """
parameters: {v: 0.1 m/s, k: 100 N/m, mu: 0.2, mu_s: 0.4, K: 5000 N/m}
bodies: {block: {shape: particle, mass: 1 kg}, belt: {shape: rod, length: 1 m, mass: 1 kg}}
ground: {points: {P: [-1, 0], Q: [1, 0]}}
joints: {guide: {type: slider, along: [ground.P, ground.Q], line: [belt.start, belt.end], coordinate: s}}
motions: {drive: {of: s, is: v*t}}
forces: {spring: {type: spring, along: block.x, stiffness: k}}
contacts: {grip: {of: [block, [belt.start, belt.end]], friction: mu, static_friction: mu_s, stiffness: K, damping: 20 N*s/m}}
initial: {block.x: 0, block.y: -9.81/K, s: 0, rates: {block.x: v}}
"""


@pytest.mark.parametrize("v", [0.05, 0.4])
def test_stick_and_slip_on_a_soft_belt(v):
    """At rest across the belt, the block is pressed by its weight: it sticks and slips as on a rigid one (`test_friction`)."""
    omega, a = 10.0, 0.2 * G / 100
    slip, stick = 2 * (math.pi - math.atan(a * omega / v)) / omega, 2 * a / v
    first = 0.4 * G / 100 / v
    run = motion(BELT, first + 2 * (slip + stick), {"rtol": 1e-11}, v=v)
    starts = [first, first + slip + stick]
    known = [pair for t in starts for pair in ((t, "slip"), (t + slip, "stick"))]
    seen = [change for change in changes(run) if 0 < change.t < run.outcome.t - 1e-6]
    assert [change.kind for change in seen] == [kind for _, kind in known]
    assert [change.t for change in seen] == pytest.approx([t for t, _ in known], abs=1e-8)
    middle = first + slip + stick / 2  # as the block sticks, the spring passes μ m g
    assert run.evaluate("grip.slip", middle) == pytest.approx(0, abs=1e-14)
    assert run.evaluate("abs(grip.T)", middle) == pytest.approx(0.2 * G, abs=1e-7)
    assert run.instant(middle).limits["grip"].state == "stuck"
    assert np.abs(run.evaluate("grip.T", first + slip * np.array([0.1, 0.9]))) == pytest.approx(0.2 * G, rel=1e-9)


SLOPE = """
parameters: {mu: 0.3, alpha: 0, K: 4e4 N/m}
gravity: [9.81*sin(alpha), -9.81*cos(alpha)]
bodies: {block: {shape: rectangle, width: 0.4 m, height: 0.2 m, mass: 3 kg}}
ground: {lines: {floor: {through: O, angle: 0}}}
contacts: {floor: {of: [block, ground.floor], friction: mu, stiffness: K, damping: 200 N*s/m}}
initial: {block.x: 0, block.y: 0.0998, block.angle: 0, at_rest: true}
"""


def test_a_block_on_springs_stays_on_its_slope():
    """Once its springs have settled it creeps by nothing at all, for a hundred seconds."""
    run = model(SLOPE, alpha=math.atan(0.29)).simulate(until=100.0)
    x = run.evaluate("block.x", [40.0, 100.0])
    assert run.outcome.ok and x[0] == pytest.approx(x[1], abs=1e-12)
    assert abs(run.evaluate("rate(block.x)", 100.0)) < 1e-14
    forces = [run.evaluate(f"floor.{part}", 100.0) for part in ("N", "T")]
    tilt = math.atan(0.29)
    assert np.abs(forces) == pytest.approx([3 * G * math.cos(tilt), 3 * G * math.sin(tilt)], rel=1e-6)


@pytest.mark.parametrize("part", [1 - 1e-6, 1 + 1e-6])
def test_the_verdict_flips_on_the_edge_of_the_cone(part):
    """A point mass at rest on its spring: it goes as soon as tan α passes μ."""
    text = SLOPE.replace("shape: rectangle, width: 0.4 m, height: 0.2 m", "shape: particle")
    text = text.replace("block.y: 0.0998, block.angle: 0", "block.y: -3*9.81*cos(alpha)/K")
    run = model(text, alpha=math.atan(0.3) * part).simulate(until=1.0)
    assert (run.evaluate("block.x", 1.0) == 0) == (part < 1)


ROLL = """
parameters: {v: 3 m/s, mu: 0.2, K: 1e5 N/m}
bodies: {wheel: {shape: disk, radius: 0.3 m, mass: 2 kg}}
ground: {lines: {floor: {through: O, angle: 0}}}
contacts: {tyre: {of: [wheel, ground.floor], friction: mu, stiffness: K, damping: 500 N*s/m}}
initial: {wheel.x: 0, wheel.y: 0.3 - 2*9.81/K, wheel.angle: 0, rates: {wheel.x: v}}
"""


def test_a_tyre_slides_until_it_rolls():
    """μ g takes speed and gives spin until v = −r ω: for a disk at 2/3 of its first speed, after v/(3 μ g)."""
    run = motion(ROLL, 2.0)
    (stick,) = changes(run, "stick")
    assert stick.t == pytest.approx(3 / (3 * 0.2 * G), rel=1e-8)
    assert [run.evaluate(e, 2.0) for e in ("rate(wheel.x)", "-0.3*omega(wheel)")] == pytest.approx([2, 2], rel=1e-8)
    assert run.evaluate("friction_work()", 2.0) == pytest.approx(-3.0, rel=1e-7)  # a third of ½ m v²
    assert abs(run.evaluate("tyre.slip", 1.8)) < 1e-13


def test_what_bounces_off_a_spring_slides_by_mu_times_the_push():
    """Thrown fast along, it slides all the time: the impulse along is μ times the one across, 2 m v without a damper."""
    text = ROLL.replace("damping: 500 N*s/m", "damping: 0 N*s/m").replace("wheel.y: 0.3 - 2*9.81/K", "wheel.y: 0.5")
    run = motion(text, 0.35, {"rtol": 1e-11}, v=20.0)
    down, up = changes(run, "contact")[0].t, changes(run, "lift-off")[0].t
    across, along = (run.evaluate(f"rate(wheel.{c})", [down, up]) for c in "yx")
    weight = 2 * G * (up - down)
    assert across[1] == pytest.approx(-across[0], rel=1e-9)
    assert 2 * (along[0] - along[1]) == pytest.approx(0.2 * (2 * (across[1] - across[0]) + weight), rel=1e-9)
    assert run.evaluate("omega(wheel)", up) * 0.3 / 2 == pytest.approx(along[1] - along[0], rel=1e-9)


TUMBLING = SLOPE.replace(
    "block.y: 0.0998, block.angle: 0, at_rest: true", "block.y: 0.5, block.angle: 0.3, rates: {block.x: 1.5}"
)


def test_a_ball_on_spring_and_damper_leaves_where_they_cease_to_push():
    """m ÿ = −k y − c ẏ from y = 0, ẏ = −v without gravity: y = −(v/ω) e^(−δ t) sin ω t; it leaves where k y + c ẏ = 0."""
    m, k, c, v = 0.5, 200.0, 3.0, 2.0
    text = f"""
gravity: none
bodies: {{ball: {{shape: particle, mass: {m}}}}}
ground: {{lines: {{floor: {{through: O, angle: 0}}}}}}
contacts: {{floor: {{of: [ball, ground.floor], stiffness: {k}, damping: {c}}}}}
initial: {{ball.x: 0, ball.y: 1, rates: {{ball.y: {-v}}}}}
"""
    run, delta = model(text).simulate(until=1.5, rtol=1e-12), c / (2 * m)
    omega = np.sqrt(k / m - delta**2)
    t = np.linspace(0.01, 0.1, 7)
    y = -v / omega * np.exp(-delta * t) * np.sin(omega * t)
    rate = -v * np.exp(-delta * t) * (np.cos(omega * t) - delta / omega * np.sin(omega * t))
    assert run.evaluate("ball.y", 0.5 + t) == pytest.approx(y, abs=1e-10)
    assert run.evaluate("floor.N", 0.5 + t) == pytest.approx(-k * y - c * rate, abs=1e-7)
    leaves = (np.pi - np.arctan2(2 * omega * delta, omega**2 - delta**2)) / omega  # tan ω t = 2 ω δ/(δ² − ω²)
    (lift,) = [change for change in changes(run) if change.kind == "lift-off"]
    assert lift.t == pytest.approx(0.5 + leaves, abs=1e-9)


@pytest.mark.parametrize("depth", [0.0, 0.02])
@pytest.mark.parametrize("rate", [-2.0, 0.0, 0.5, 2.0])
def test_a_start_in_the_floor_is_pushed_out_but_never_pulled_back(depth, rate):
    """m ÿ = max(0, k δ − c ẏ) at a depth δ, as of the ball above; here for less than it takes to leave."""
    m, k, c = 0.5, 200.0, 3.0
    text = f"""
gravity: none
bodies: {{ball: {{shape: particle, mass: {m}}}}}
contacts: {{floor: {{of: [ball, {{through: ground.O, angle: 0}}], stiffness: {k}, damping: {c}}}}}
initial: {{ball.x: 0, ball.y: {-depth}, rates: {{ball.y: {rate}}}}}
"""
    run, delta, t = model(text).simulate(until=0.01, rtol=1e-12), c / (2 * m), np.linspace(0, 0.01, 11)
    y, push = -depth + rate * t, 0 * t
    if k * depth > c * rate:
        omega = np.sqrt(k / m - delta**2)
        sine, cosine = np.exp(-delta * t) * np.sin(omega * t), np.exp(-delta * t) * np.cos(omega * t)
        y = -depth * cosine + (rate - delta * depth) / omega * sine
        push = -k * y - c * (rate * cosine + (k * depth / m - delta * rate) / omega * sine)
    assert run.evaluate("ball.y", t) == pytest.approx(y, abs=1e-11)
    assert run.evaluate("floor.N", t[1:]) == pytest.approx(push[1:], abs=1e-7)
    assert not changes(run) or depth == 0  # it begins as it is


def test_newtons_laws_hold_while_a_box_comes_to_rest_on_springs():
    # Of a motion with twenty stiff contacts the ledger leaves some 1.5 times the tolerance.
    run = motion(TUMBLING, 2.0, {"rtol": 1e-10}, alpha=0.1)
    assert {"contact", "lift-off", "stick", "slip"} <= {kind for kind, _ in kinds(run)}
    times = within(run, 40, seed=3)
    ax, ay, _ = acceleration(run, "block", times)
    for a, axis, pull in ((ax, "x", math.sin(0.1)), (ay, "y", -math.cos(0.1))):
        assert run.evaluate(f"floor.F{axis}", times) + 3 * G * pull == pytest.approx(3 * a, abs=1e-3)
    assert abs(run.evaluate("rate(block.x)", 2.0)) < 1e-12


BUMP = """
gravity: 9.81
bodies: {wheel: {shape: disk, radius: 0.3 m, mass: 2 kg}}
ground: {points: {A: [-3, 0], B: [0, 0.2], C: [3, 0]}}
contacts: {tyre: {of: [wheel, {polyline: [ground.A, ground.B, ground.C]}], stiffness: 2e4 N/m, damping: 300 N*s/m, friction: 0.5}}
initial: {wheel.x: -2, wheel.y: 0.37, rates: {wheel.x: 3}}
"""


def test_a_tyre_goes_over_a_corner_of_the_road():
    """The spring is pressed by the nearest of both sides and the corner, all the way."""
    run = motion(BUMP, 1.3)
    times = np.linspace(0, 1.3, 600)
    place = np.column_stack([run.evaluate(f"wheel.{c}", times) for c in "xy"])
    corners = np.array([[-3, 0], [0, 0.2], [3, 0]])

    def far(p):
        ways = []
        for a, b in itertools.pairwise(corners):
            s = np.clip((p - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
            ways.append(np.hypot(*(p - a - s * (b - a))))
        return min(ways) - 0.3

    assert place[-1, 0] > 0.2
    assert run.evaluate("tyre.gap", times) == pytest.approx([far(p) for p in place], abs=1e-12)
