"""Constraints on rates: the edge of a skate, and ideal wheels seen from above."""

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

import freebody as fb

SLEIGH = """
freebody: 1
name: Chaplygin sleigh
gravity: none
parameters: {m: 2 kg, I: 0.3 kg*m^2, a: 0.4 m}
bodies:
  sleigh: {mass: m, inertia: I, centre: [a, 0], points: {A: origin}, lines: {edge: {through: A, angle: 0}}}
joints:
  plane: {type: free, of: [ground.O, sleigh.A], coordinates: [x, y, theta]}
  skate: {type: skate, on: ground.O, line: sleigh.edge}
initial: {x: 0, y: 0, theta: 0, rates: {x: 0.3 m/s, theta: 2 rad/s}}
run: {until: 6 s, rtol: 1e-12}
"""
"""Its edge is behind the mass centre by a."""

CAR = """
freebody: 1
name: car with ideal wheels, the front one steered
gravity: none
parameters: {m: 900 kg, I: 1200 kg*m^2, b: 1.1 m, L: 2.6 m, F: 500 N, turn: 0.4 rad, w: 0.7 rad/s}
bodies:
  car: {mass: m, inertia: I, centre: [b, 0], points: {rear: origin, front: [L, 0]}, lines: {axis: {through: rear, angle: 0}}}
  fork: {mass: 0, points: {hub: origin}, lines: {rim: {through: hub, angle: 0}}}
joints:
  road: {type: free, of: [ground.O, car.rear], coordinates: [x, y, theta]}
  steering: {type: hinge, of: [car.front, fork.hub], coordinate: delta}
  rear: {type: skate, on: ground.O, line: car.axis}
  front: {type: skate, on: ground.O, line: fork.rim}
forces: {drive: {type: force, at: car.rear, value: F, direction: 0, frame: body}}
motions: {steer: {of: delta, is: turn*sin(w*t)}}
initial: {x: 0, y: 0, theta: 0, rates: {x: 3 m/s}}
run: {until: 6 s, rtol: 1e-12}
"""


def test_the_sleigh_moves_as_chaplygin_found():
    """u̇ = a ω², J ω̇ = −m a u ω with J = I + m a²: u = c tanh τ, ω = c √(m/J) / cosh τ, τ = τ₀ + a c m t / J, c² = 2E/m; the edge carries
    m (u ω + a ω̇) (Neimark & Fufaev 1972, ch. II; Ruina, Am. J. Phys. 66, 1998)."""
    m, inertia, a, u0, spin0 = 2, 0.3, 0.4, 0.3, 2
    j = inertia + m * a**2
    c = np.sqrt(u0**2 + j * spin0**2 / m)
    tau = lambda t: np.arctanh(u0 / c) + a * c * m * t / j
    u, spin = lambda t: c * np.tanh(tau(t)), lambda t: c * np.sqrt(m / j) / np.cosh(tau(t))
    angle = lambda t: np.sqrt(j / m) / a * (2 * np.arctan(np.tanh(tau(t) / 2)) - 2 * np.arctan(np.tanh(tau(0) / 2)))
    run = fb.Mechanism.loads(SLEIGH).simulate()
    for t in (0.4, 1.0, 2.5, 6.0):
        x, y = (quad(lambda s, f=f: u(s) * f(angle(s)), 0, t, epsabs=1e-13, epsrel=1e-13)[0] for f in (np.cos, np.sin))
        side = m * u(t) * spin(t) * (1 - m * a**2 / j)
        found = [float(run.evaluate(each, [t])[0]) for each in ("x", "y", "theta", "rate(theta)", "skate.Fn")]
        np.testing.assert_allclose(found, [x, y, angle(t), spin(t), side], atol=1e-10)
    assert abs(run.energy.balance).max() < 1e-11
    assert abs(run.evaluate("vy(sleigh.A)*cos(theta) - vx(sleigh.A)*sin(theta)", run.t)).max() < 1e-13


def test_a_car_on_ideal_wheels_goes_as_its_kinematics_and_power_say():
    """ω = v tan δ / L; with T = M v²/2, M = m + (m b² + I) tan²δ / L², the power of the drive is F v, and steering takes none."""
    m, inertia, b, length, force, turn, w = 900, 1200, 1.1, 2.6, 500, 0.4, 0.7

    def rate(t, y):
        tan, dot = np.tan(turn * np.sin(w * t)), turn * w * np.cos(w * t)
        mass = m + (m * b**2 + inertia) * tan**2 / length**2
        slope = (m * b**2 + inertia) * 2 * tan * (1 + tan**2) * dot / length**2
        return [y[3] * np.cos(y[2]), y[3] * np.sin(y[2]), y[3] * tan / length, (force - slope * y[3] / 2) / mass]

    times = np.array([1.0, 3.0, 4.5, 6.0])
    found = solve_ivp(rate, (0, 6), [0, 0, 0, 3], method="DOP853", t_eval=times, rtol=3e-14, atol=1e-13).y
    run = fb.Mechanism.loads(CAR).simulate()
    speed = run.evaluate("hypot(vx(car.rear), vy(car.rear))", times)
    np.testing.assert_allclose(
        [*(run.evaluate(each, times) for each in ("x", "y", "theta")), speed], found, rtol=1e-10, atol=1e-10
    )
    np.testing.assert_allclose(run.evaluate("steer.force", times), 0, atol=1e-9)


def test_three_routes_and_free_bodies_agree_on_a_turntable():
    """The edge on a body that turns itself: it slides along itself as seen from there."""
    text = SLEIGH.replace("  sleigh:", "  table: {mass: 5 kg, inertia: 2 kg*m^2, points: {P: [0.2 m, 0]}}\n  sleigh:").replace(
        "  plane:", "  pivot: {type: hinge, of: [ground.O, table.origin], coordinate: phi}\n  plane:"
    )
    made = fb.Mechanism.loads(text.replace("on: ground.O", "on: table.P").replace("rates: {", "phi: 0.3, rates: {phi: 1.5, "))
    now, others = made.solve(), [made.solve(route=route) for route in ("newton_euler", "constraints")]
    for other in others:
        assert other["skate.Fn"] == pytest.approx(now["skate.Fn"], abs=1e-13)
        assert other["alpha(table)"] == pytest.approx(now["alpha(table)"], abs=1e-13)
    run = made.simulate(until=3)
    assert abs(run.energy.balance).max() < 1e-10
    momentum = run.evaluate("angular_momentum(ground.O)", run.t)
    assert np.ptp(momentum) < 1e-10


def test_equations_and_checks_know_it():
    made = fb.Mechanism.loads(SLEIGH)
    for form in ("minimal", "brute", "constraints"):
        assert "For the velocities" in (text := made.equations(form, long=True).text()) and "For the positions" not in text
    assert "onstraints on rates" in made.equations(long=True).text()
    true = "(I + m*a^2)*accel(theta) = -m*a*rate(theta)*(vx(sleigh.A)*cos(theta) + vy(sleigh.A)*sin(theta))"
    assert made.check(true).ok and not made.check(true.replace("= -", "= ")).ok
    assert made.check("I*accel(theta) = -a*skate.Fn").ok
    assert made.check("constant: energy()").ok and made.check("vx(sleigh.A)*sin(theta) = vy(sleigh.A)*cos(theta)").ok


def test_it_counts_as_a_constraint_and_holds_no_place():
    now = fb.Mechanism.loads(SLEIGH).solve(x=3, y=-1, theta=1, rates={"x": 0.3, "theta": 2})
    assert now.freedom == 2
    rates = now["rate(y)"], now["rate(x)"]
    assert rates[0] == pytest.approx(np.tan(1) * rates[1], abs=1e-14)
