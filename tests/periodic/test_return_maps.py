"""Return maps through impacts: the derivative against differences of the map; closed forms of rimless wheels."""

import math

import numpy as np
import pytest
from test_multipliers import differences

import freebody as fb
from freebody.catalogue import find
from freebody.model.errors import ModelProblem


def wheel(file, **parameters):
    made = fb.Mechanism.load(find("19.3.30").folder / file)
    made.parameters.update(parameters)
    section = "hit" if file == "hinged.yaml" else "foot"
    return made.periodic({"omega": "-rate(wheel.angle)"}, section=section, horizon=3)


@pytest.mark.parametrize("file", ["model.yaml", "hinged.yaml"])
@pytest.mark.parametrize(("k", "slope"), [(8, 5), (8, 10), (6, 12), (16, 3)])
def test_a_rimless_wheel_has_the_gait_and_multiplier_of_its_map(file, k, slope):
    """ω⁺ = η √(ω⁺² + 4 (mg/J) R sin α sin γ), whose derivative at the fixed point is η²."""
    found = wheel(file, k=k, slope=f"{slope} deg").find()
    eta = (0.5 + math.cos(2 * math.pi / k)) / 1.5
    gain = 4 * 9.81 / 1.5 * math.sin(math.pi / k) * math.sin(math.radians(slope))
    assert found.values["omega"] == pytest.approx(math.sqrt(eta**2 * gain / (1 - eta**2)), rel=1e-11)
    assert found.multipliers == pytest.approx([eta**2], rel=1e-10)
    assert max(found.checks.values()) < 1e-9


BALL = """
freebody: 1
parameters: {e: 0.7, mu: 0.25, v: 3 m/s, spin: -20 rad/s, h: 0.4 m, x0: 0 m}
gravity: 9.81 m/s^2
ground: {lines: {floor: {through: O, angle: -3 deg}}}
bodies: {ball: {shape: disk, radius: 0.1 m, mass: 0.6 kg}}
contacts: {bounce: {of: [{centre: ball.G, radius: 0.1 m}, ground.floor], restitution: e, friction: mu}}
initial: {ball.x: x0, ball.y: h, ball.angle: 0, rates: {ball.x: v, ball.y: 0, ball.angle: spin}}
events: {top: {when: rate(ball.y), direction: falling}}
run: {until: 2 s}
"""


@pytest.mark.parametrize("mu", [0.02, 0.25, 2.0])
def test_a_bounce_with_friction_that_slides_or_holds_has_the_derivative_of_its_map(mu):
    thrown = fb.Mechanism.loads(BALL)
    thrown.parameters["mu"] = mu
    names = {"x0": "ball.x", "h": "ball.y", "v": "rate(ball.x)", "spin": "rate(ball.angle)"}
    bounced = thrown.periodic(names, section="top")
    assert bounced.step().slopes == pytest.approx(differences(bounced, bounced.start), abs=1e-8)
    struck = thrown.periodic(names | {"e": "rate(ball.y)"}, section="bounce")
    assert struck.step().slopes == pytest.approx(differences(struck, struck.start), abs=1e-8)


def test_what_grazes_has_no_derivative_and_says_so():
    thrown = fb.Mechanism.loads(BALL.replace("top: {when: rate(ball.y)", "top: {when: (0.5 - ball.x)^3"))
    with pytest.raises(ValueError, match="grazes zero"):
        thrown.periodic({"h": "ball.y"}, section="top").step()


SETTING = """
freebody: 1
parameters: {k: 4 N/m, c: 0.3 N*s/m, stiffness: 2*k, F: 0.1 N, v: 0 m/s, l: 1 m, s: 1 s, b: 0.1 N*s^3/m^3, m: 1 kg}
gravity: none
bodies: {cart: {shape: particle, mass: m}}
joints: {rail: {type: slot, along: {through: ground.O, angle: 0 deg}, point: cart.centre, coordinate: x}}
forces: {spring: {type: law, along: x, value: F - stiffness*x - c*rate(x)}}
initial: {x: 1, rates: {x: v}}
events:
  middle: {when: x - 0.3, direction: falling, then: {set: {k: k*(1 + x/l - 0.5*rate(x)*s/l + t/s), F: 0.05*F*t/s}}}
  late: {when: x + 0.2, direction: falling, then: {set: {c: b*rate(x)^2}}}
  top: {when: rate(x), direction: rising, then: {set: {v: k*x*s/m}}}
run: {until: 5}
"""


def test_parameters_that_events_set_are_carried_into_the_derivative():
    """From the place, rate and time of an event, and from what they were; what follows from them follows; also at the section."""
    cart = fb.Mechanism.loads(SETTING)
    returns = {"k": "k", "c": "c", "F": "F", "x": "x", "v": "v"}
    back = cart.periodic(returns, section="top")
    slopes = back.step().slopes
    assert slopes == pytest.approx(differences(back, back.start, 1e-4), abs=1e-8)
    assert np.abs(slopes).max(axis=1).min() > 1e-3


def test_starts_that_come_to_nothing_are_counted_and_bounds_are_read_with_their_units():
    """Below ω² = 2 (mg/J) R (1 − cos (α − γ)) no spoke comes over the top: ω = 0.8 rad/s here."""
    rolling = wheel("model.yaml", k=6, slope="12 deg")
    found = rolling.find_all({"omega": ("1 deg/s", 1.6)}, 4)
    assert len(found) == 1 and 0 < found.lost < found.starts
    assert f"at {found.lost} of the places the motion does not come back" in found.sentence
    for bounds, said in (({"omega": (3, 1)}, "from 3 to 1"), ({"omga": (1, 3)}, "`omga` is not among the unknowns")):
        with pytest.raises(ModelProblem, match=said):
            rolling.find_all(bounds)
    with pytest.raises(ModelProblem, match="there is no parameter `slop`"):
        rolling.boundary("slop", (0.1, 0.2))


CUBIC = """
freebody: 1
parameters: {x0: 0.1 m, gain: 1 1/m^2}
gravity: none
bodies: {cart: {shape: particle, mass: 1 kg}}
joints: {rail: {type: slot, along: {through: ground.O, angle: 0 deg}, point: cart.centre, coordinate: x}}
initial: {x: x0, rates: {x: 0}}
"""


def test_a_small_miss_alone_is_no_motion_that_repeats_itself():
    """Of x − x³ a start of 1e-5 misses itself by no more than round-off; steps of Newton's method go on to less."""
    cart = fb.Mechanism.loads(CUBIC)
    found = cart.periodic({"x": "x - gain*x^3"}, period=1).find({"x": 1e-5})
    assert abs(found.values["x"]) < 7e-6
    every = cart.periodic({"x0": "x"}, period=1).find({"x0": 0.2})
    assert every.values["x0"] == 0.2 and every.multipliers == pytest.approx([1], abs=1e-12)


def test_of_one_unknown_every_motion_within_bounds_is_found():
    """x + 0.3 sin 20x repeats itself at the multiples of π/20, from which Newton's method goes far astray between them."""
    cart = fb.Mechanism.loads(CUBIC).periodic({"x0": "x + 0.3*sin(20*x)"}, period=1)
    found = cart.find_all({"x0": (0.1, 1.6)})
    assert [each.values["x0"] for each in found] == pytest.approx([math.pi * n / 20 for n in range(1, 11)], rel=1e-10)
    assert "at most" in found.sentence
