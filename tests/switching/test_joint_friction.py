"""Friction in joints: closed forms, and a bearing whose load depends on its friction against an integration by hand."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from seen import changes, model

G = 9.81


RAIL = """
name: block in a rubbing slider
parameters: {pull: 0 N/s}
gravity: [GX, -9.81]
bodies:
  block: {shape: rectangle, width: 0.2 m, height: 0.1 m, mass: 2 kg, points: {P: [-0.1 m, 0], Q: [0.1 m, 0]}, lines: {mid: [P, Q]}}
ground: {points: {A: [0, 0], B: [1 m, 0]}, lines: {x: [A, B]}}
joints:
  rail: {type: slider, along: ground.x, line: block.mid, coordinate: s, friction: 0.2, static_friction: 0.25}
forces:
  pull: {type: force, at: block.G, x: "pull*t", y: 0 N}
initial: {s: 0, rates: {s: V}}
"""


def rail(gx=0.0, v=0.0, pull=0.0):
    return model(RAIL.replace("GX", str(gx)).replace("V}", f"{v} m/s}}").replace("pull: 0", f"pull: {pull}"))


def test_a_block_slides_until_friction_has_taken_its_energy():
    run = rail(v=2.0).simulate(until=5)
    assert [c.t for c in changes(run, "stick")] == [pytest.approx(2 / (0.2 * G), abs=1e-12)]
    (s,), (u,) = (x[-1] for x in run.motion.sample(np.array([5.0])))
    assert s == pytest.approx(4 / (2 * 0.2 * G), rel=1e-12)
    assert u == 0.0


def test_a_block_that_sticks_stays_for_a_thousand_seconds():
    q, u = rail(gx=0.2499 * G).simulate(until=1000).motion.sample(np.linspace(0, 1000, 5))
    assert np.all(q == 0.0) and np.all(u == 0.0)


def test_a_growing_pull_starts_it_when_static_friction_is_used_up():
    run = rail(pull=3).simulate(until=3)
    (slip,) = (c.t for c in changes(run, "slip"))
    assert slip == pytest.approx(0.25 * 2 * G / 3, abs=1e-12)
    # From then on m a = 3 t − μ m g, with the lower coefficient.
    dt, a0 = 3 - slip, (3 * slip - 0.2 * 2 * G) / 2
    assert run.motion.sample(np.array([3.0]))[1][0, 0] == pytest.approx(a0 * dt + 1.5 * dt**2 / 2, rel=1e-9)


def test_a_flywheel_in_a_rubbing_bearing_slows_down_evenly():
    m = model("""
bodies: {wheel: {shape: disk, radius: 0.5 m, mass: 4 kg}}
joints: {axle: {type: hinge, of: [ground.O, wheel.centre], coordinate: theta, friction: 0.3, bearing_radius: 2 cm}}
initial: {theta: 0, rates: {theta: 10 rad/s}}
""")
    slowing = 0.3 * 0.02 * 4 * G / (0.5 * 4 * 0.25)
    run = m.simulate(until=40)
    assert [c.t for c in changes(run, "stick")] == [pytest.approx(10 / slowing, rel=1e-12)]
    names, ledger = run.motion.ledger(np.array([40.0]))
    assert ledger[0][names.index("friction")] == pytest.approx(-0.5 * 0.5 * 100, rel=1e-9)


def test_a_bead_in_a_rubbing_slot_of_a_turning_rod():
    """R̈ = ω²R − 2μωṘ (Coriolis presses the bead against the slot), R = exp(ω(√(1+μ²) − μ)t) from a fitting start."""
    mu, w = 0.4, 2.0
    grows = w * (math.sqrt(1 + mu * mu) - mu)
    m = model(f"""
gravity: none
bodies:
  rod: {{shape: rod, length: 1 m, mass: 1 kg, lines: {{slot: [start, end]}}}}
  bead: {{shape: particle, mass: 0.3 kg}}
joints:
  pivot: {{type: hinge, of: [ground.O, rod.start], coordinate: theta}}
  track: {{type: slot, along: rod.slot, point: bead.centre, coordinate: R, friction: {mu}}}
motions: {{spin: {{of: theta, is: "{w}*t"}}}}
initial: {{R: 0.1 m, rates: {{R: {0.1 * grows}}}}}
""")
    run = m.simulate(until=2, rtol=1e-11)
    r = run.motion.evaluate(["R"], np.array([1.0, 2.0]))[:, 0]
    assert r == pytest.approx([0.1 * math.exp(grows * t) for t in (1, 2)], rel=1e-9)


def test_a_pendulum_in_a_rubbing_bearing_agrees_with_an_integration_by_hand():
    """The bearing's load holds the friction itself: I θ̈ = −m g (l/2) cosθ − μ ρ |R| sgn θ̇ with R from the mass centre's motion."""
    mu, rho, mass, length = 0.3, 0.05, 1.5, 1.2
    half, inertia = length / 2, mass * length**2 / 3

    def load(theta, w, a):
        x = mass * (-half * math.cos(theta) * w * w - half * math.sin(theta) * a)
        y = mass * (-half * math.sin(theta) * w * w + half * math.cos(theta) * a + G)
        return math.hypot(x, y)

    def rate(_, state):
        theta, w = state
        a = 0.0
        for _ in range(60):  # a contraction by μρ/l
            a = (-mass * G * half * math.cos(theta) + mu * rho * load(theta, w, a)) / inertia
        return [w, a]

    m = model(f"""
bodies: {{rod: {{shape: rod, length: {length} m, mass: {mass} kg}}}}
joints: {{pivot: {{type: hinge, of: [ground.O, rod.start], coordinate: theta, friction: {mu}, bearing_radius: {rho} m}}}}
initial: {{theta: 0, at_rest: true}}
""")
    run = m.simulate(until=0.8, rtol=1e-11)
    wanted = solve_ivp(rate, (0, 0.8), [0, 0], method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    q, u = run.motion.sample(np.array([0.8]))
    assert [q[0, 0], u[0, 0]] == pytest.approx(list(wanted), rel=1e-9)
    names, ledger = run.motion.ledger(np.linspace(0, 0.8, 9))
    # The balance of energy closes to what the tolerance of the motion leaves.
    assert np.abs(ledger[:, names.index("balance")]).max() < 1e-9
