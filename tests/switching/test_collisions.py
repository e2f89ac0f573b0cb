"""Single impacts: restitution with friction, and what holds of any of them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from seen import changes, kinds, model, motion

G = 9.81

SUPERBALL = """
gravity: none
parameters: {R: 0.1 m, mu: 0.2, e: 0.8, v: 1 m/s, w: 0 rad/s}
bodies: {disk: {shape: disk, radius: R, mass: 1 kg}}
ground: {lines: {floor: {through: ground.O, angle: 0}}}
contacts: {floor: {of: [disk, ground.floor], friction: mu, restitution: e}}
initial: {disk.x: 0, disk.y: 3*R, rates: {disk.x: v, disk.y: -2, disk.angle: -w}}
"""


@pytest.mark.parametrize("v, w", [(5, 0), (0.5, 0), (1, -80), (1, 40), (-3, 20)])
def test_a_spinning_disk_bounces(v, w):
    """It slides all through the impact if 3 μ (1 + e) vₙ is less than the slip v − ωR; else it rolls off, with (2v + ωR)/3."""
    run = motion(SUPERBALL, 0.5, v=v, w=w)
    slip, push = v - 0.1 * w, 1.8 * 2
    drag = math.copysign(min(0.2 * push, abs(slip) / 3), slip)
    (impact,) = changes(run, "impact")
    assert impact.t == pytest.approx(0.1, abs=1e-14)
    assert impact.after["u"] == pytest.approx([v - drag, 0.8 * 2, -(w + 2 * drag / 0.1)], abs=1e-12)
    before, after = (
        1 / 2 * u[0] ** 2 + 1 / 2 * u[1] ** 2 + 0.005 / 2 * u[2] ** 2 for u in (impact.before["u"], impact.after["u"])
    )
    assert impact.lost == pytest.approx(before - after, abs=1e-12)


DISKS = """
gravity: none
parameters: {b: 0.12 m, e: 0.7, m2: 3 kg}
bodies: {one: {shape: disk, radius: 0.1 m, mass: 1 kg}, two: {shape: disk, radius: 0.15 m, mass: m2}}
contacts: {bump: {of: [one, two], restitution: e}}
initial: {one.x: -1 m, one.y: b, two.x: 0, two.y: 0, rates: {one.x: 2, one.angle: 3}}
"""


@pytest.mark.parametrize("b", [0.0, 0.12, -0.2, 0.2499])
def test_smooth_disks_strike_off_centre(b):
    """Along the line of centres (1 + e) μ v cos β is exchanged, sin β = b/(R + r); across it, and of the spins, nothing."""
    run = motion(DISKS, 1, b=b)
    (impact,) = changes(run, "impact")
    sine = b / 0.25
    cosine = math.sqrt(1 - sine**2)
    assert impact.t == pytest.approx((1 - 0.25 * cosine) / 2, abs=1e-12)
    push = 1.7 * 0.75 * 2 * cosine * np.array([-cosine, sine])
    assert run.u[-1] == pytest.approx([2 + push[0], push[1], 3, -push[0] / 3, -push[1] / 3, 0], abs=1e-12)


def test_disks_that_pass_do_not_strike():
    assert kinds(motion(DISKS, 1, b=0.2501)) == []


STICK = """
gravity: none
parameters: {a: 0.5, mu: 0.3, e: 0.5, vx: 1 m/s, vy: -1 m/s, w: 1 rad/s, h: 0.5 m}
bodies: {stick: {shape: rod, length: 2*h, mass: 1.5 kg}}
ground: {lines: {floor: {through: ground.O, angle: 0}}}
contacts: {tip: {of: [stick.start, ground.floor], friction: mu, restitution: e}}
initial: {points: {stick.start: [0, 0]}, stick.angle: a, rates: {stick.x: vx, stick.y: vy, stick.angle: w}}
"""


@pytest.mark.parametrize("law", ["stop", "newton", "poisson", "sequential"])
def test_what_holds_of_any_impact(law):
    """The impulse is a push within the cone of friction and explains the change of momentum and spin; no energy is made.

    Newton's restitution with friction could make some, where the slip ends or turns during the impact (Kane 1984).
    """
    rng, collided = np.random.default_rng(7), 0
    for _ in range(60):
        a, mu, e = rng.uniform(0.05, math.pi - 0.05), rng.uniform(0, 4), rng.uniform(0, 1)
        vx, vy, w = rng.uniform(-3, 3), rng.uniform(-2, 0.5), rng.uniform(-6, 6)
        arm = -0.5 * np.array([math.cos(a), math.sin(a)])
        if vy + w * arm[0] > -0.05:
            continue
        run = model(STICK, a=a, mu=mu, e=e, vx=vx, vy=vy, w=w).simulate(until=1e-3, impacts=law)
        assert run.outcome.ok, run.outcome.sentence
        impact = changes(run, "impact")[0]
        collided += 1
        px, py = dict(impact.impulses["limits"])["tip"]
        u0, u1 = np.array(impact.before["u"]), np.array(impact.after["u"])
        inertia = 1.5 / 12
        assert u1 - u0 == pytest.approx([px / 1.5, py / 1.5, (arm[0] * py - arm[1] * px) / inertia], abs=1e-11)
        assert py >= 0 and abs(px) <= mu * py * (1 + 1e-9) + 1e-12
        energy = np.array([0.75, 0.75, inertia / 2])
        assert impact.lost == pytest.approx(energy @ (u0**2 - u1**2), abs=1e-11)
        assert impact.lost > -1e-12
        slip, parting = u1[0] - u1[2] * arm[1], u1[1] + u1[2] * arm[0]
        assert parting >= -1e-12
        if law == "poisson":
            continue  # compression and restitution may slide either way each
        if abs(px) < mu * py * (1 - 1e-9):
            assert slip == pytest.approx(0, abs=1e-11)
        elif abs(slip) > 1e-9:
            assert px * slip < 1e-12
    assert collided > 30


HILL = """
parameters: {R: 1 m, r: 0.2 m, v: 0.5 m/s}
bodies: {ball: BODY}
contacts: {hill: {of: [ball, {centre: ground.O, radius: R}], GRIP}}
initial: {ball.x: 0, ball.y: HEIGHT, rates: {ball.x: v SPIN}}
"""
BEAD = (
    HILL.replace("BODY", "{shape: particle, mass: 1 kg}")
    .replace("HEIGHT", "R")
    .replace(" SPIN", "")
    .replace("GRIP", "friction: 0")
)
WHEEL = (
    HILL.replace("BODY", "{shape: disk, radius: r, mass: 1 kg}")
    .replace("HEIGHT", "R + r")
    .replace(" SPIN", ", ball.angle: -v/r")
    .replace("GRIP", "rough: true")
)


@pytest.mark.parametrize("text, kept, reach", [(BEAD, 1.0, 1.0), (WHEEL, 1.5, 1.2)], ids=["bead", "wheel"])
@pytest.mark.parametrize("v", [0.3, 1.0])
def test_a_body_leaves_a_hill(text, kept, reach, v):
    """Nothing presses where v² = gR cos θ; with energy ½ k m v², k = 1 + I/(mr²): cos θ = (2 + k v₀²/(gR))/(2 + k)."""
    run = motion(text, 2, {"rtol": 1e-11}, v=v)
    (leaves,) = changes(run, "lift-off")
    cosine = (2 + kept * v**2 / (G * reach)) / (2 + kept)
    assert run.evaluate("ball.y", leaves.t) / reach == pytest.approx(cosine, abs=1e-9)
    assert run.evaluate("speed(ball.G)", leaves.t) ** 2 == pytest.approx(G * reach * cosine, rel=1e-9)
    # Quadrature of θ̇ = v/R, k v² = k v₀² + 2gR (1 − cos θ).
    x, w = np.polynomial.legendre.leggauss(80)
    end = math.acos(cosine)
    theta = end * (1 + x) / 2
    pace = reach / np.sqrt(v**2 + 2 * G * reach * (1 - np.cos(theta)) / kept)
    assert leaves.t == pytest.approx(float(w @ pace) * end / 2, abs=1e-9)


DOOR = """
parameters: {e: 0.6, th0: 1}
bodies: {bob: {shape: rod, length: 1.5 m, mass: 1 kg}}
joints: {pin: {type: hinge, of: [ground.O, bob.start], coordinate: {name: th, zero: down}}}
stops: {wall: {of: th, least: 0 deg, restitution: e}}
initial: {th: th0, at_rest: true}
"""


def test_a_pendulum_knocks_on_a_wall():
    """A uniform rod swings like a pendulum of two thirds of its length, each impact leaves e of its speed: quarter periods
    K(sin θ/2)/ω each way, where sin² θ/2 is multiplied by e² at every impact."""
    from mpmath import ellipk

    run = motion(DOOR, 6, {"rtol": 1e-11})
    impacts = changes(run, "impact")
    m, omega = math.sin(0.5) ** 2, math.sqrt(G)  # length 1 m of the simple pendulum
    known, t = [], float(ellipk(m)) / omega
    while t < 6:
        known.append(t)
        m *= 0.36
        t += 2 * float(ellipk(m)) / omega
    assert len(impacts) >= 5
    assert [b.t for b in impacts] == pytest.approx(known, abs=1e-9)
    assert [b.after["u"][0] / b.before["u"][0] for b in impacts] == pytest.approx([-0.6] * len(impacts), abs=1e-12)
    energy = [0.5 * 0.75 * b.before["u"][0] ** 2 * 0.64 for b in impacts]
    assert [b.lost for b in impacts] == pytest.approx(energy, rel=1e-9)
