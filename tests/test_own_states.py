"""States with a rate of their own: integrated with the motion, read by laws, set by events, differentiated by."""

import numpy as np
import pytest
from scipy.linalg import expm

import freebody as fb
from freebody.equations.topics import topic

CART = """
freebody: 1
gravity: none
parameters: {m: 2 kg, kp: 30 N/m, ki: 25 N/(m*s), kd: 8 N*s/m, T: 0.1 s, x0: 0.4 m, wind: 3 N}
bodies: {cart: {shape: particle, mass: m}}
joints: {rail: {type: slot, along: {through: ground.O, angle: 0}, point: cart.centre, coordinate: x}}
states:
  error: {rate: x - x0}
  filtered: {rate: (rate(x) - filtered)/T, start: 0 m/s}
forces:
  motor: {type: force, at: cart.centre, x: -kp*(x - x0) - ki*error - kd*filtered}
  wind: {type: force, at: cart.centre, x: wind}
initial: {x: 0, at_rest: true}
run: {until: 5 s, rtol: 1e-12}
"""
"""x'' = (wind − kp (x − x0) − ki ∫(x − x0) − kd v)/m with v, the rate of x through a low-pass filter of time constant T."""


def matrix():
    """Of d/dt (x, x', error, filtered)."""
    m, kp, ki, kd, T = 2, 30, 25, 8, 0.1
    return np.array([[0, 1, 0, 0], [-kp / m, 0, -ki / m, -kd / m], [1, 0, 0, 0], [0, 1 / T, 0, -1 / T]])


def test_integral_control_with_a_filter_follows_the_matrix_exponential():
    a, rest = matrix(), np.array([0.4, 0, 3 / 25, 0])
    run = fb.Mechanism.loads(CART).simulate()
    for t in (0.3, 1.0, 2.7, 5.0):
        y = rest + expm(a * t) @ (np.array([0, 0, 0, 0]) - rest)
        found = [float(run.evaluate(text, [t])[0]) for text in ("x", "rate(x)", "error", "filtered", "rate(filtered)")]
        np.testing.assert_allclose(found, [*y, (a @ y)[3]], rtol=0, atol=2e-11)
    assert abs(run.energy.balance).max() < 1e-10


def test_derivatives_by_states_are_the_columns_of_the_system_matrix():
    solved = fb.Mechanism.loads(CART).solve(error=0.2, filtered=-0.3, x=0.1)
    by = ("x", "rate(x)", "error", "filtered")
    rows = [solved.derivatives(text) for text in ("rate(x)", "accel(x)", "rate(error)", "rate(filtered)")]
    np.testing.assert_allclose([[row[name] for name in by] for row in rows], matrix(), atol=1e-12)


def test_a_state_drives_a_motion_and_its_rate_is_the_acceleration():
    text = """
freebody: 1
gravity: none
bodies: {cart: {shape: particle, mass: 2 kg}}
joints: {rail: {type: slot, along: {through: ground.O, angle: 0}, point: cart.centre, coordinate: x}}
states: {v: {rate: 6*cos(3*t)*(1 m/s^2)}}
motions: {drive: {of: x, is: v, level: velocity}}
initial: {x: 0}
run: {until: 4 s, rtol: 1e-12}
"""
    run, t = fb.Mechanism.loads(text).simulate(), np.linspace(0, 4, 9)
    np.testing.assert_allclose(run.evaluate("rate(x)", t), 2 * np.sin(3 * t), atol=1e-11)
    np.testing.assert_allclose(run.evaluate("x", t), 2 / 3 * (1 - np.cos(3 * t)), atol=1e-11)
    np.testing.assert_allclose(run.evaluate("drive.force", t), 12 * np.cos(3 * t), atol=1e-9)


def test_an_event_sets_a_state_and_a_switch_in_its_rate_is_met():
    text = (
        CART.replace("rate: x - x0}", "rate: 'if(t < 1 s, 1 m, 0 m)'}")
        + "events: {reset: {at: 2 s, then: {set: {error: 7 m*s}}}}\n"
    )
    run = fb.Mechanism.loads(text).simulate(until=3)
    np.testing.assert_allclose(run.evaluate("error", [0.5, 1.0, 1.9, 2.5]), [0.5, 1.0, 1.0, 7.0], atol=1e-12)


def test_states_go_on_while_friction_holds_all_at_rest_until_they_break_it_loose():
    text = """
freebody: 1
bodies: {box: {shape: rectangle, width: 1 m, height: 0.2 m, mass: 2 kg}}
joints: {floor: {type: slider, along: {through: ground.O, angle: 0}, line: {through: box.centre, angle: 0}, coordinate: x, friction: 0.5}}
states: {pull: {rate: 4 N/s}}
forces: {rope: {type: force, at: box.centre, x: pull}}
initial: {x: 0, at_rest: true}
events: {slides: {when: x - 1 mm, then: stop}}
run: {until: 9 s, rtol: 1e-11}
"""
    run = fb.Mechanism.loads(text).simulate()
    loose, c = 0.5 * 9.81 * 2 / 4, 4 / 2 / 6  # x = c (t − loose)³
    assert run.t[-1] == pytest.approx(loose + (1e-3 / c) ** (1 / 3), abs=1e-8)


def test_a_motion_goes_on_from_a_state_with_its_own_states():
    whole, first = fb.Mechanism.loads(CART).simulate(), fb.Mechanism.loads(CART).simulate(until=2)
    later = fb.Mechanism.loads(CART).simulate(t=2, **{n: float(first.evaluate(n, [2])[0]) for n in ("x", "error", "filtered")},
                                    rates={"x": float(first.evaluate("rate(x)", [2])[0])})  # fmt: skip
    assert float(later.evaluate("error", [5])[0]) == pytest.approx(float(whole.evaluate("error", [5])[0]), abs=1e-11)


def test_equations_say_the_rates_and_a_check_does_not_take_a_state_for_its_value_at_the_start():
    made = fb.Mechanism.loads(CART)
    assert "error′ = x − x₀" in made.equations().text()
    whole = "m*accel(x) = wind - kp*(x - x0) - ki*error - kd*filtered"
    assert made.check(whole).ok and not made.check(whole.replace(" - ki*error", "")).ok
    assert "error, filtered), its rate" in made.equations(long=True).text()
    with pytest.raises(ValueError, match="not among the linear equations"):
        topic(made, "linear")


@pytest.mark.parametrize(
    ("there", "here", "said"),
    [
        ("mass: m", "mass: error", "is a state"),
        ("initial: {x: 0,", "initial: {x: 0, error: 1,", "is a state, not a coordinate"),
        ("rate: x - x0", "rate: kinetic()/(1 N)", "cannot be read here"),
        ("rate: x - x0", "rate: accel(x)*(1 s^2)", "an acceleration stands"),
        ("forces:", "gauges: {twice: 2*error}\nforces:", "state with a rate of its own"),
        ("forces:", "motions: {drive: {of: x, is: error/(1 s)}}\nforces:", "not a position"),
        ("filtered: {rate", "kp: {rate", "has the name of"),
        ("start: 0 m/s", "start: 0 kg", "is a"),
    ],
)
def test_what_a_state_cannot_be_is_refused(there, here, said):
    with pytest.raises(fb.ModelFileError) as refused:
        fb.Mechanism.loads(CART.replace(there, here)).compile()
    assert said in str(refused.value)
