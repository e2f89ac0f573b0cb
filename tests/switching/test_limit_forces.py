"""Forces and gaps of contacts and strings, and when they open, beside equations of motion written down by hand and integrated by SciPy."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from seen import changes, model

G = 9.81
M, H, MU = 2.0, 0.5, 0.3  # mass and half length of the rod, friction
INERTIA = M * (2 * H) ** 2 / 12
ROD = """
parameters: {{mu: {mu}}}
ground: {{lines: {{floor: {{through: O, angle: 0}}}}}}
bodies: {{rod: {{shape: rod, length: 1 m, mass: 2 kg}}}}
contacts: {{floor: {{of: [rod.start, ground.floor], friction: mu}}}}
initial: {{rod.x: 0, rod.y: {y!r}, rod.angle: {angle!r}, rates: {{rod.x: {v!r}, rod.y: {rise!r}, rod.angle: {w!r}}}}}
run: {{until: 0.5 s, rtol: 1e-12}}
"""


def solved(mu: float, sense: float, angle: float, w: float) -> tuple[float, float]:
    """N and the angular acceleration of a rod whose lower end slides on the floor: m (g + ÿ) = N with y = h sin θ, and
    I θ̈ = −N h cos θ + T h sin θ with T = −μ N along the sliding."""
    c, s = np.cos(angle), np.sin(angle)
    lever = -H * c - sense * mu * H * s
    push = M * (G - H * w**2 * s) / (1 - M * H * c * lever / INERTIA)
    return push, push * lever / INERTIA


@pytest.mark.parametrize("mu", [0.0, MU])
@pytest.mark.parametrize("v", [2.0, -3.0])
def test_a_rod_that_spins_up_lifts_off_the_floor(mu, v):
    start, w = float(np.radians(20.0)), 6.0
    slides = v + H * w * np.sin(start)  # of its end
    sense = np.sign(slides)

    def rates(_, state):
        x_rate, angle, turning = state[1:]
        push, alpha = solved(mu, sense, angle, turning)
        return [x_rate, -sense * mu * push / M, turning, alpha]

    def lifts(_, state):
        return solved(mu, sense, *state[2:])[0]

    lifts.terminal = True
    own = solve_ivp(rates, (0, 1), [0, v, start, w], method="DOP853", rtol=1e-12, atol=1e-13, events=lifts, dense_output=True)
    lift, (angle, turning) = own.t[-1], own.y[2:, -1]
    run = model(
        ROD.format(mu=mu, y=float(H * np.sin(start)), angle=start, v=v, rise=float(H * w * np.cos(start)), w=w)
    ).simulate()
    opens = changes(run, "lift-off")[0]
    assert opens.t == pytest.approx(lift, abs=1e-9)
    t = np.linspace(0, 0.999 * lift, 9)
    push = np.array([solved(mu, sense, *own.sol(each)[2:])[0] for each in t])
    assert run.evaluate("floor.N", t) == pytest.approx(push, abs=1e-8)
    assert abs(run.evaluate("floor.T", t)) == pytest.approx(mu * push, abs=1e-8)
    assert run.evaluate("floor.Fx", t) == pytest.approx(-sense * mu * push, abs=1e-8)
    assert run.evaluate("floor.gap", t) == pytest.approx(0, abs=1e-12)
    later = np.linspace(1e-3, 0.03, 7)
    height = H * np.sin(angle) + H * turning * np.cos(angle) * later - G / 2 * later**2
    assert run.evaluate("floor.gap", lift + later) == pytest.approx(height - H * np.sin(angle + turning * later), abs=1e-9)
    assert run.evaluate("floor.N", lift + later) == pytest.approx(0, abs=0)


def test_a_bob_on_a_string_goes_slack_and_taut_again():
    """m (g cos φ + l φ̇²) is the tension; slack, it flies along a parabola until it is as far from the pin again."""
    length, mass, rate = 0.8, 1.5, 6.0
    text = f"""
bodies: {{bob: {{shape: particle, mass: {mass}}}}}
strings: {{cord: {{ends: [ground.O, bob.centre], length: {length}, restitution: 0.3}}}}
initial: {{bob.x: 0, bob.y: {-length}, rates: {{bob.x: {length * rate}, bob.y: 0}}}}
run: {{until: 1.2 s, rtol: 1e-12}}
"""

    def tension(_, state):
        return mass * (G * np.cos(state[0]) + length * state[1] ** 2)

    tension.terminal = True
    own = solve_ivp(
        lambda _, s: [s[1], -G / length * np.sin(s[0])], (0, 2), [0, rate], method="DOP853", rtol=1e-12, atol=1e-13,
        events=tension, dense_output=True,
    )  # fmt: skip
    slack, (phi, w) = own.t[-1], own.y[:, -1]
    out, way = length * np.array([np.sin(phi), -np.cos(phi)]), length * w * np.array([np.cos(phi), np.sin(phi)])

    def gap(t):
        return length - np.hypot(*(out[:, None] + np.outer(way, t) - np.outer([0, G / 2], t**2)))

    run = model(text).simulate()
    opens, taut = changes(run, "slack")[0], next(impact for impact in run.impacts if impact.t > 0)
    assert opens.t == pytest.approx(slack, abs=1e-9)
    t = np.linspace(0, 0.999 * slack, 9)
    assert run.evaluate("cord.tension", t) == pytest.approx(tension(0, own.sol(t)), abs=1e-8)
    assert run.evaluate("cord.gap", t) == pytest.approx(0, abs=1e-12)
    flight = taut.t - slack
    assert gap(np.array([flight])) == pytest.approx(0, abs=1e-9) and gap(flight * np.linspace(0.01, 0.99, 99)).min() > 0
    later = flight * np.linspace(0.01, 0.99, 9)
    assert run.evaluate("cord.gap", slack + later) == pytest.approx(gap(later), abs=1e-9)
    place, fast = out + way * flight - [0, G / 2 * flight**2], way - [0, G * flight]
    pull = mass * 1.3 * (place @ fast) / length  # along the string (1 + e) of what goes away
    assert taut.sizes["cord"] == pytest.approx(pull, rel=1e-8)
