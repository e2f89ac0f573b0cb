"""Exact derivatives of an instant: against closed forms, and against differences where friction slides."""

import math
from dataclasses import replace

import numpy as np
import pytest
import store
from store import ANSWERED, every

import freebody as fb
from freebody.core import quote

STEP = 1e-3
"""The longest step of differences, of a coordinate of order 1."""

PENDULUM = """
freebody: 1
parameters: {l: 0.8 m, m: 2 kg, g: 9.81 m/s^2}
gravity: [0, -g]
bodies: {bob: {shape: particle, mass: m, points: {P: centre}}}
joints: {rod: {type: link, of: [ground.O, bob.P], length: l, coordinate: {name: theta, zero: down}}}
initial: {theta: 0.7, rates: {theta: 1.3}}
"""


def test_a_pendulum_has_the_derivatives_of_its_closed_forms():
    """θ̈ = −(g/l) sin θ and T = m g cos θ + m l θ̇²."""
    model = fb.Mechanism.loads(PENDULUM)
    now, (l, m, g, theta, w) = model.solve(), (0.8, 2.0, 9.81, 0.7, 1.3)
    acceleration, tension = now.derivatives("accel(theta)"), now.derivatives("rod.tension")
    expected = {"t": 0, "theta": -g / l * math.cos(theta), "rate(theta)": 0, "l": g / l**2 * math.sin(theta), "m": 0}
    assert acceleration == pytest.approx(expected | {"g": -math.sin(theta) / l}, rel=1e-13, abs=1e-14)
    expected = {"t": 0, "theta": -m * g * math.sin(theta), "rate(theta)": 2 * m * l * w, "l": m * w**2}
    assert tension == pytest.approx(
        expected | {"m": g * math.cos(theta) + l * w**2, "g": m * math.cos(theta)}, rel=1e-13, abs=1e-13
    )


BLOCK = """
freebody: 1
parameters: {m: 2 kg, g: 9.81 m/s^2, mu: 0.3, al: 0.5}
gravity: [0, -g]
ground: {lines: {slope: {through: ground.O, angle: -al}}}
bodies: {block: {shape: rectangle, width: 0.4 m, height: 0.2 m, mass: m, lines: {middle: {through: origin, angle: 0}}}}
joints: {guide: {type: slider, along: ground.slope, line: block.middle, coordinate: s, friction: mu}}
initial: {s: 0, rates: {s: 0.4}}
"""


def test_sliding_friction_follows_the_force_that_presses():
    """s̈ = g (sin α − μ cos α), in a joint whose friction is found by iteration."""
    now, (g, mu, al) = fb.Mechanism.loads(BLOCK).solve(), (9.81, 0.3, 0.5)
    found = now.derivatives("accel(s)")
    assert found["mu"] == pytest.approx(-g * math.cos(al), rel=1e-12)
    assert found["g"] == pytest.approx(math.sin(al) - mu * math.cos(al), rel=1e-12)
    assert found["al"] == pytest.approx(g * (math.cos(al) + mu * math.sin(al)), rel=1e-12)
    assert [found[name] for name in ("m", "s", "rate(s)", "t")] == pytest.approx([0, 0, 0, 0], abs=1e-12)


@every(ANSWERED)
def test_derivatives_along_the_motion_are_the_limits_of_differences(model):
    """What is in place, sticks and slides stays as it is in the run; joints with friction, contacts and strings among the models."""
    run = store.run(model)
    now = run.instant(0.37 * run.t[-1])
    state, size = now.state, np.array(now.sizes).max()
    names = [quote(name) for name in now.accelerations]
    texts = [f"accel({name})" for name in names]
    texts += [f"{quote(name)}.{part}" for name, joint in now.reactions.items() if joint.carries for part in ("Fx", "Fy")]
    rates = np.array(list(now.accelerations.values()))
    along = np.concatenate([[1.0], state.u, rates, np.zeros_like(state.p)])
    exact = now.core.derivatives(texts, state) @ along
    fastest = np.abs(np.concatenate([[1.0], state.u, rates])).max()

    def central(h):
        moved = (replace(state, t=state.t + d, q=state.q + d * state.u, u=state.u + d * rates) for d in (h, -h))
        above, below = (now.core.evaluate(texts, there) for there in moved)
        return (above - below) / (2 * h)

    coarse, fine = central(STEP / fastest), central(STEP / 2 / fastest)
    known = ~np.isnan(exact + coarse + fine)
    limit, error = fine + (fine - coarse) / 3, np.abs(fine - coarse)
    most = np.abs(np.concatenate([limit[known], [0.0]])).max()
    assert (np.abs(exact - limit)[known] <= 1e-7 * most + error[known] + 1e-13 * size * fastest / STEP).all()


def test_derivatives_that_are_not_finite_are_named():
    """∂√θ/∂θ = 1/(2 √θ) is infinite at 0, where √θ is 0."""
    now = fb.Mechanism.loads(PENDULUM.replace("theta: 0.7, rates: {theta: 1.3}", "theta: 0")).solve()
    assert now["sqrt(theta)"] == 0
    with pytest.raises(fb.NotFinite, match=r"no finite derivative by theta\b"):
        now.derivatives("sqrt(theta)")
