"""Return maps through impacts: the derivative against differences of the map; closed forms of rimless wheels."""

import math

import pytest
from test_multipliers import differences

import freebody as fb
from freebody.catalogue import find


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
    thrown = fb.Mechanism.loads(BALL.replace("top: {when: rate(ball.y)", "top: {when: (ball.x - 0.5)^3"))
    with pytest.raises(ValueError, match="grazes zero"):
        thrown.periodic({"h": "ball.y"}, section="top").step()
