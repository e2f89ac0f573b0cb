"""Perturbations through sliding that begins, ceases and turns back, and of states with a rate of their own."""

import numpy as np
import pytest
from scipy.linalg import expm
from test_multipliers import differences

import freebody as fb

HEATED = """
freebody: 1
gravity: none
parameters: {kp: 3 N/m, ki: 2.5 N/(m*s), kd: 0.8 N*s/m, T: 0.1 s, x0: 0.4 m, F: 2 N, Omega: 3 rad/s}
bodies: {cart: {shape: particle, mass: 1 kg}}
joints: {rail: {type: slot, along: {through: ground.O, angle: 0}, point: cart.centre, coordinate: x}}
states: {error: {rate: x - x0}, filtered: {rate: (rate(x) - filtered)/T, start: 0 m/s}}
forces: {motor: {type: force, at: cart.centre, x: F*cos(Omega*t) - kp*(x - x0) - ki*error - kd*filtered}}
initial: {x: 0, rates: {x: 0}}
run: {until: 5 s}
"""


def test_integral_control_has_the_multipliers_of_its_matrix():
    """exp(A 2π/Ω) of (x, x', ∫(x − x₀), filtered x')."""
    back = fb.Mechanism.loads(HEATED).periodic(period="2*pi/Omega")
    a = np.array([[0, 1, 0, 0], [-3, 0, -2.5, -0.8], [1, 0, 0, 0], [0, 10, 0, -10]])
    assert back.step().slopes == pytest.approx(expm(a * 2 * np.pi / 3), abs=1e-10)
    assert list(back.map.unknowns) == ["x", "rate(x)", "error", "filtered"]


def test_a_state_that_an_event_sets_is_carried_into_the_derivative():
    text = (
        HEATED
        + "events:\n  pass: {when: x - 0.3, then: {set: {error: error/2 + rate(x)*(0.1 s^2)}}}\n  top: {when: rate(x), direction: falling}\n"
    )
    names = {"kp": "kp", "x": "x", "error": "error", "filtered": "filtered"}
    back = fb.Mechanism.loads(text).periodic(names, section="top")
    assert len(back.step().run.events) > 1
    assert back.step().slopes == pytest.approx(differences(back, back.start), abs=1e-8)


STICK_SLIP = """
freebody: 1
parameters: {mu: 0.3, above: 1.4, k: 40 N/m, c: 0.5 N*s/m, v: 0.3 m/s, x0: 0.2 m, u0: 0.1 m/s}
gravity: 9.81 m/s^2
bodies:
  belt: {mass: 1 kg, points: {A: [0, 0]}, lines: {top: {through: A, angle: 0 deg}}}
  box: {shape: particle, mass: 1 kg}
joints: {drive: {type: slider, along: {through: ground.O, angle: 0 deg}, line: {through: belt.A, angle: 0 deg}, coordinate: s}}
motions: {turn: {of: s, is: v*t}}
contacts: {lie: {of: [box.centre, belt.top], friction: mu, static_friction: above*mu}}
forces: {spring: {type: law, along: box.x, value: -k*box.x - c*rate(box.x)}}
initial: {s: 0, box.x: x0, box.y: 0, rates: {box.x: u0, box.y: 0}}
events: {back: {when: rate(box.x), direction: falling}}
run: {until: 5 s}
"""


@pytest.mark.parametrize("above", [1.0, 1.4])
def test_sliding_that_begins_and_ceases_has_the_derivative_of_its_map(above):
    """A box on a moving belt, held by a spring: it sticks, is carried until the spring tears it loose, and slides back."""
    box = fb.Mechanism.loads(STICK_SLIP)
    box.parameters["above"] = above
    back = box.periodic({"x0": "box.x", "u0": "t*v", "k": "k", "mu": "mu", "v": "v"}, section="back")
    kinds = {change.kind for change in back.step().run.changes}
    assert {"stick", "slip"} <= kinds
    assert back.step().slopes == pytest.approx(differences(back, back.start), abs=1e-7)


def test_sticking_forgets_how_far_it_slid():
    """The multiplier of stick-slip oscillations is 0."""
    found = fb.Mechanism.loads(STICK_SLIP).periodic({"x0": "box.x"}, section="back", u0=0, c=0.1).find({"x0": 0.13})
    assert found.multipliers == pytest.approx([0], abs=1e-9)
    assert found.values["x0"] > 1.4 * 0.3 * 9.81 / 40  # where the spring tears it loose
