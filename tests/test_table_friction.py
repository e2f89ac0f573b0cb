"""A body on three legs that slides and turns on a table, seen from above, with Coulomb friction at each leg."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import freebody as fb

M, MU, G, R, INERTIA = 2.0, 0.3, 9.81, 0.25, 0.08
PLATE = """
freebody: 1
gravity: none
parameters: {m: 2 kg, mu: 0.3, g: 9.81 m/s^2, r: 0.25 m}
bodies:
  plate: {mass: m, inertia: 0.08 kg*m^2, points: {"leg[i = 1 .. 3]": ["r*cos(2*pi*i/3)", "r*sin(2*pi*i/3)"]}}
joints: {plane: {type: free, of: [ground.O, plate.origin], coordinates: [x, y, theta]}}
forces: {rub: {type: table_friction, points: ["plate.leg[1]", "plate.leg[2]", "plate.leg[3]"], friction: mu, load: m*g}}
initial: {x: 0, y: 0, theta: 0}
run: {until: 9 s, rtol: 1e-12}
"""
LEGS = R * np.exp(2j * np.pi * np.arange(1, 4) / 3)


def run(**rates):
    return fb.Mechanism.loads(PLATE).simulate(rates=rates)


def test_what_slides_without_turning_stops_after_v_over_mu_g():
    done, v = run(x=0.6, y=0.8), 1.0
    assert done.events[-1].name == "rub rests" and done.outcome.name == "StoppedByEvent"
    assert done.outcome.t == pytest.approx(v / (MU * G), rel=1e-9)
    x, y = (float(done.evaluate(each, [done.outcome.t])[0]) for each in "xy")
    assert (x, y) == pytest.approx((0.6 * v / (2 * MU * G), 0.8 * v / (2 * MU * G)), rel=1e-10)
    assert done.evaluate("theta", done.t) == pytest.approx(0, abs=1e-12)


def test_what_turns_in_place_stops_by_the_moment_of_its_legs():
    done, spin = run(theta=5.0), MU * M * G * R / INERTIA
    assert done.outcome.t == pytest.approx(5 / spin, rel=1e-9)
    assert float(done.evaluate("theta", [done.outcome.t])[0]) == pytest.approx(25 / (2 * spin), rel=1e-10)


@pytest.mark.long
def test_sliding_and_turning_end_together_about_a_leg_on_a_path_found_by_another_integrator():
    """Written as an own equation of complex places; the slip of every leg is known from v + iω r e^{iθ}."""

    def rate(_, y):
        legs = LEGS * np.exp(1j * y[2])
        speed = y[3] + 1j * y[4] + 1j * y[5] * legs
        force = -MU * M * G / 3 * speed / abs(speed)
        couple = (np.conj(legs) * force).imag.sum()
        return [y[3], y[4], y[5], force.sum().real / M, force.sum().imag / M, couple / INERTIA]

    def held(_, y):
        slips = abs(y[3] + 1j * y[4] + 1j * y[5] * LEGS * np.exp(1j * y[2]))
        return slips.min() - 1e-3 * slips.mean()  # where the run ends: in the end it turns about one leg

    held.terminal = True
    start, ends = [0, 0, 0, 0.5, 0.2, 6.0], []
    found = solve_ivp(rate, (0, 2), start, method="DOP853", rtol=1e-13, atol=1e-15, events=held, dense_output=True)
    done = run(x=0.5, y=0.2, theta=6.0)
    assert done.outcome.t == pytest.approx(found.t[-1], abs=1e-9) and "`rub holds plate.leg[3]`" in done.outcome.sentence
    for t in (0.1, 0.25, 0.95 * found.t[-1]):
        ends = [float(done.evaluate(each, [t])[0]) for each in ("x", "y", "theta", "rate(x)", "rate(y)", "rate(theta)")]
        np.testing.assert_allclose(ends, found.sol(t), atol=1e-10)
    before = done.outcome.t - 1e-4
    speed, spin = (float(done.evaluate(each, [before])[0]) for each in ("speed(plate.G)", "rate(theta)"))
    assert 0 < speed < 1e-3 and 0 < spin < 1e-2, "both vanish together"
    assert abs(done.energy.balance).max() < 1e-10
    assert done.energy.entries["work of rub"][-1] == pytest.approx(-(M * 0.29 + INERTIA * 36) / 2, rel=1e-9)


def test_equations_hold_the_friction_of_every_leg():
    made = fb.Mechanism.loads(PLATE.replace("theta: 0}", "theta: 0, rates: {x: 1, y: 0.2, theta: 1}}"))
    now, other = made.solve(), made.solve(route="constraints")
    assert now["accel(theta)"] == pytest.approx(other["accel(theta)"], abs=1e-13)
    directions = "+".join(f"vx(plate.leg[{i}])/speed(plate.leg[{i}])" for i in (1, 2, 3))
    assert made.check(f"m*accel(x) = -mu*m*g/3*({directions})").ok


def test_at_rest_there_is_no_sliding_friction_and_it_is_said():
    with pytest.raises(fb.MotionError, match="rub"):
        fb.Mechanism.loads(PLATE.replace("theta: 0}", "theta: 0, at_rest: true}")).solve()


@pytest.mark.parametrize("rtol", [1e-4, 1e-5, 1e-7, 1e-8, 1e-9, 1e-11, 1e-13])
@pytest.mark.parametrize(("x", "turn"), [(0.5, 6), (0.5, 20), (0.5, 2), (1.0, 6), (0.1, 12)])
def test_a_leg_that_comes_to_rest_before_the_others_ends_the_run_by_its_name(x, turn, rtol):
    """Coulomb friction draws a leg that is slow to no speed in finite time: the plate would go on about it."""
    done = fb.Mechanism.loads(PLATE).simulate(rates={"x": x, "y": 0.0, "theta": turn}, rtol=rtol)
    leg = done.outcome.sentence.partition("`rub holds plate.")[2].partition("`")[0]
    assert done.outcome.name == "StoppedByEvent" and leg in ("leg[1]", "leg[2]", "leg[3]") and done.stats["accepted"] < 1000
    speeds = [float(done.evaluate(f"hypot(vx(plate.leg[{i}]), vy(plate.leg[{i}]))", [done.outcome.t])[0]) for i in (1, 2, 3)]
    assert min(speeds) == speeds[int(leg[4]) - 1] == pytest.approx(1e-3 * np.mean(speeds), rel=1e-2)
