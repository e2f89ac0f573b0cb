"""Limits t → ∞ and integrals to infinity, beside closed forms; what has none is refused."""

import math

import pytest
from scipy.integrate import quad

import freebody as fb
from freebody.find import NoLimit

BEAD = """
freebody: 1
gravity: none
bodies:
  rod: {shape: general, mass: 1, inertia: 2, points: {A: [1, 0]}}
  bead: {shape: particle, mass: 1}
joints:
  pivot: {type: hinge, of: [ground.O, rod.origin], coordinate: theta}
  track: {type: slot, point: bead.centre, along: [rod.origin, rod.A], coordinate: R}
initial: {R: 1, theta: 0, rates: {theta: 1, R: 0}}
run: {until: 10}
"""
DAMPED = """
freebody: 1
gravity: none
bodies: {b: {shape: particle, mass: 1}}
joints: {J: {type: slot, along: {through: ground.O, angle: 0 deg}, point: b.centre, coordinate: x}}
forces: {k: {type: law, along: x, value: 3 - 4*x - C*rate(x)}}
initial: {x: 0, rates: {x: 1}}
run: {until: 10}
"""


def test_a_bead_on_a_turning_rod():
    """L = (2 + R²)θ̇ = 3, ½Ṙ² + ½L²/(2 + R²) = 3/2."""
    bead = fb.Mechanism.loads(BEAD)
    speed = bead.limit("rate(R)")
    assert speed.value == pytest.approx(math.sqrt(3), abs=speed.value.error) and speed.value.error < 1e-8
    assert "falls as t^-2.00" in speed.tail
    # dθ = L/(2 + R²)/Ṙ dR with Ṙ² = 3 (R² − 1)/(2 + R²), and R = 1/cos w.
    turned = quad(lambda w: math.sqrt(3 / (2 * math.cos(w) ** 2 + 1)), 0, math.pi / 2, epsabs=1e-13)[0]
    angle = bead.limit("theta")
    assert (
        not angle.rests
        and angle.value == pytest.approx(turned, abs=1e-7)
        and "t^-1.00" in angle.tail
        and angle.value.error < 1e-8
    )
    summed = bead.limit("integral of rate(theta)")
    assert summed.value == pytest.approx(float(angle.value), abs=1e-8) and summed.unit == "rad"


@pytest.mark.parametrize("c", [0.4, 1.0, 4.0, 5.0])
def test_damped_oscillations_and_creep(c):
    """Under-damped, critical and over-damped: x → 3/4; ∫ ẋ² dt is the energy lost over the damping."""
    damped = fb.Mechanism.loads(DAMPED.replace("C", str(c)))
    place = damped.limit("x")
    assert place.rests and place.value == pytest.approx(0.75, abs=place.value.error) and place.value.error < 1e-13
    assert "asymptotically stable" in place.sentence and "estimated" not in place.sentence
    lost = damped.limit("integral of rate(x)^2")
    assert lost.value == pytest.approx((0.5 + 2 * 0.75**2) / c, rel=1e-8)


def test_what_a_law_of_time_leads_to_is_an_estimate():
    """x'' = e^(-t) + 3 − 4x − x' comes to 3/4 with the law, not by itself."""
    led = fb.Mechanism.loads(DAMPED.replace("3 - 4*x", "3 + exp(-t/(1 s)) - 4*x").replace("C", "1")).limit("x")
    assert not led.rests and "an estimated" in led.sentence
    assert led.value == pytest.approx(0.75, abs=led.value.error)


def test_what_has_no_limit_is_refused_with_what_was_seen():
    swinging = fb.Mechanism.loads(DAMPED.replace("C", "0"))
    with pytest.raises(NoLimit, match=r"no limit of x is seen until 64 s: it was .* at 32 s and is"):
        swinging.limit("x", until=64)
    with pytest.raises(NoLimit, match="no limit of R"):
        fb.Mechanism.loads(BEAD).limit("R", until=2000)
    with pytest.raises(NoLimit, match="no limit of ln"):
        fb.Mechanism.loads(BEAD).limit("ln(R)")


def test_a_limit_of_a_parameter():
    """The speed at which a rod that is tipped falls flat tends to √(3g/l) as it stands upright."""
    rod = fb.Mechanism.load("python/freebody/systems/19.3.6-falling-rod-on-ice/model.yaml")
    found = rod.limit("omega(rod) @ flat", vary="tilt", begin=0.05, towards=0)
    assert found.value == pytest.approx(-math.sqrt(3 * 9.81 / 1.8), abs=max(found.value.error, 1e-9)) and found.value.error < 1e-7
    with pytest.raises(NoLimit, match="no limit of t @ flat is seen as tilt tends to 0"):
        rod.limit("t @ flat", vary="tilt", begin=0.05, towards=0)
