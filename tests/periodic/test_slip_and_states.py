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
parameters: {mu: 0.3, above: 1.4, k: 40 N/m, c: 0.5 N*s/m, v: 0.3 m/s, x0: 0.2 m, u0: -0.1 m/s}
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
    there = back.step()
    assert [change.kind for change in there.run.changes if 0 < change.t < there.time] == ["stick", "slip"]
    assert there.slopes == pytest.approx(differences(back, back.start), abs=1e-7)


@pytest.mark.parametrize("above", [1.0, 1.4])
def test_a_ring_that_sticks_and_slides_on_its_rod_has_the_map_of_the_box_on_the_belt(above):
    """What carries the box is a slot with friction, in place of the contact."""
    ring = "  ring: {type: slot, along: belt.top, point: box.centre, coordinate: way, friction: mu, static_friction: above*mu}\n"
    contact = "contacts: {lie: {of: [box.centre, belt.top], friction: mu, static_friction: above*mu}}\n"
    text = STICK_SLIP.replace("motions:", ring + "motions:").replace(contact, "").replace("joints: {drive", "joints:\n  drive")
    text = text.replace("coordinate: s}}", "coordinate: s}").replace(
        "box.x: x0, box.y: 0, rates: {box.x: u0, box.y: 0}", "way: x0, rates: {way: u0 - v}"
    )
    text = text.replace("rate(box.x)", "vx(box.centre)").replace("box.x", "x(box.centre)")
    returns = {"x0": "x(box.centre)", "u0": "t*v", "k": "k", "mu": "mu", "v": "v"}
    held = fb.Mechanism.loads(text).periodic(returns, section="back", above=above).step()
    lain = fb.Mechanism.loads(STICK_SLIP).periodic({**returns, "x0": "box.x"}, section="back", above=above).step()
    assert held.time == pytest.approx(lain.time, rel=1e-12)
    assert held.slopes == pytest.approx(lain.slopes, abs=1e-10)


ELBOW = """
freebody: 1
parameters: {mu: 0.3, above: 1.5, r: 0.15 m, a0: 0.5, w0: 1.2 rad/s}
gravity: 9.81 m/s^2
bodies: {arm: {shape: rod, length: 0.8 m, mass: 2 kg}, fore: {shape: rod, length: 0.5 m, mass: 1 kg}}
joints:
  A: {type: hinge, of: [ground.O, arm.start], coordinate: {name: alpha, zero: down}}
  B: {type: hinge, of: [arm.end, fore.start], coordinate: {name: beta, zero: down, absolute: true}, friction: mu, static_friction: above*mu, bearing_radius: r}
initial: {alpha: a0, beta: 0.2, rates: {alpha: w0, beta: 0}}
run: {until: 4 s}
"""


def test_a_bearing_that_sticks_turns_back_and_slides_has_the_derivative_of_its_map():
    back = fb.Mechanism.loads(ELBOW).periodic({"a0": "alpha", "w0": "rate(alpha)", "mu": "beta", "r": "rate(beta)"}, period=1.5)
    there = back.step()
    assert [change.kind for change in there.run.changes] == ["reversal", "stick", "slip", "stick"]
    assert there.slopes == pytest.approx(differences(back, back.start), abs=1e-8)


def test_sticking_forgets_how_far_it_slid():
    """The multiplier of stick-slip oscillations is 0."""
    found = fb.Mechanism.loads(STICK_SLIP).periodic({"x0": "box.x"}, section="back", u0=0, c=0.1).find({"x0": 0.13})
    assert found.multipliers == pytest.approx([0], abs=1e-9)
    assert found.values["x0"] > 1.4 * 0.3 * 9.81 / 40  # where the spring tears it loose
