"""Multipliers of driven motions: against Hill's equation integrated by itself, Liouville's formula, and Mathieu's values."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import mathieu_a, mathieu_b

import freebody as fb
from freebody.model.errors import ModelProblem

BROOM = """
freebody: 1
parameters: {m: 2 kg, l: 0.8 m, a: 0.1 m, Omega: 60 rad/s, c: 0 1/s, g: 9.81 m/s^2}
gravity: g
bodies: {hand: {mass: 0}, broom: {shape: rod, length: l, mass: m}}
joints:
  guide: {type: slider, along: {through: ground.O, angle: 90 deg}, line: {through: hand.origin, angle: 90 deg}, coordinate: y}
  hinge: {type: hinge, of: [hand.origin, broom.start], coordinate: {name: theta, zero: up}}
forces: {damper: {type: torsion_spring, on: broom, from: hand, stiffness: 0, damping: c*m*l^2/3}}
motions: {shaking: {of: y, is: a*cos(Omega*t)}}
initial: {theta: 0, rates: {theta: 0}}
run: {until: 2 s}
"""


def broom(**parameters):
    made = fb.Mechanism.loads(BROOM)
    made.parameters.update(parameters)
    return made


def monodromy(l, a, omega, c, g=9.81):
    """Of θ'' + cθ' = (3/2l)(g − aΩ² cos Ωt) θ."""

    def rates(t, y):
        return [y[1], 1.5 / l * (g - a * omega**2 * math.cos(omega * t)) * y[0] - c * y[1]]

    whole = [solve_ivp(rates, (0, 2 * math.pi / omega), e, method="DOP853", rtol=1e-13, atol=1e-15).y[:, -1] for e in np.eye(2)]
    return np.array(whole).T


@pytest.mark.parametrize(("a", "omega", "c"), [(0.1, 60, 0), (0.05, 60, 0), (0.35, 60, 0), (0.1, 60, 0.5), (0.02, 15, 3.0)])
def test_the_monodromy_matrix_is_that_of_the_linear_equation(a, omega, c):
    found = broom(a=a, Omega=omega, c=c).periodic(period="2*pi/Omega").find()
    known = monodromy(0.8, a, omega, c)
    assert found.slopes.trace() == pytest.approx(known.trace(), rel=1e-11)
    assert found.slopes == pytest.approx(known, rel=1e-10, abs=1e-11)
    assert np.linalg.det(found.slopes) == pytest.approx(math.exp(-c * found.period), rel=1e-11)
    assert max(found.checks.values()) < 1e-10


@pytest.mark.long
def test_the_boundaries_are_at_the_characteristic_values_of_mathieu():
    """θ'' + (A − 2q cos 2τ) θ = 0 with A = −6g/(lΩ²), 2τ = Ωt and |q| = 3a/l: μ = 1 at A = a₀(q), μ = −1 at A = b₁(q)."""
    shaken = broom(a=0.08).periodic(period="2*pi/Omega")
    (lower,) = shaken.boundary("Omega", (20, 400), samples=12)
    assert lower.kind == "at 1"
    assert lower.value == pytest.approx(math.sqrt(6 * 9.81 / 0.8 / -mathieu_a(0, 0.3)), rel=1e-9)
    upper = [each for each in shaken.boundary("a", (0.15, 0.3), samples=6, Omega=60) if each.kind == "at -1"]
    assert pytest.approx(mathieu_b(1, 3 * upper[0].value / 0.8), rel=1e-8) == -6 * 9.81 / (0.8 * 60**2)


DRIVEN = """
freebody: 1
parameters: {g: 9.81 m/s^2, F: 3 N*m, Omega: 4 rad/s, c: 0.4 N*m*s}
gravity: g
bodies: {upper: {shape: rod, length: 0.8 m, mass: 2 kg}, lower: {shape: rod, length: 0.5 m, mass: 1 kg}}
joints:
  A: {type: hinge, of: [ground.O, upper.start], coordinate: {name: alpha, zero: down}}
  B: {type: hinge, of: [upper.end, lower.start], coordinate: {name: beta, zero: down}}
forces:
  motor: {type: torque, on: upper, value: F*cos(Omega*t)}
  knee: {type: torsion_spring, on: lower, from: upper, stiffness: 0, damping: c}
initial: {alpha: 0.1, beta: -0.2, rates: {alpha: 0.5, beta: 0}}
run: {until: 3 s}
"""


def differences(of, values, step=1e-5):
    """Of fourth order."""
    sides = {h: [of.map.value(values + h * step * e)[0] for e in np.eye(len(values))] for h in (-2, -1, 1, 2)}
    return np.array(
        [(sides[-2][i] - 8 * sides[-1][i] + 8 * sides[1][i] - sides[2][i]) / (12 * step) for i in range(len(values))]
    ).T


def test_a_periodic_response_is_found_with_its_multipliers():
    response = fb.Mechanism.loads(DRIVEN).periodic(period="2*pi/Omega")
    assert response.map.unknowns == ("alpha", "beta", "rate(alpha)", "rate(beta)")
    found = response.find()
    values = np.array(list(found.values.values()))
    back, _ = response.map.value(values)
    assert back == pytest.approx(values, abs=1e-11)
    assert found.slopes == pytest.approx(differences(response, values), abs=1e-8)
    assert found.stable and max(found.checks.values()) < 1e-10


ROTOR = """
freebody: 1
parameters: {k: 30 N*m, c: 0.4 N*m*s, w: 9 rad/s}
gravity: 9.81 m/s^2
bodies: {wheel: {mass: 2 kg, inertia: 0.1 kg*m^2, centre: [0.05, 0]}}
joints: {axle: {type: hinge, of: [ground.O, wheel.origin], coordinate: theta}}
forces: {shaft: {type: law, along: theta, value: -k*(theta - w*t) - c*(rate(theta) - w)}}
initial: {theta: 0, rates: {theta: w}}
run: {until: 3 s}
"""


def test_an_angle_that_turns_comes_back_less_its_turn():
    """A wheel with its mass beside the axle, driven through an elastic shaft: Liouville's formula, and that all is as a turn before."""
    wheel = fb.Mechanism.loads(ROTOR)
    driven = wheel.periodic(period="2*pi/w")
    assert driven.map.returns == ("theta - 2*pi", "rate(theta)")
    found = driven.find()
    assert np.prod(found.multipliers) == pytest.approx(math.exp(-0.4 / (0.1 + 2 * 0.05**2) * found.period), rel=1e-9)
    later = wheel.simulate(
        2 * found.period, initial={"theta": found.values["theta"], "rates": {"theta": found.values["rate(theta)"]}}
    )
    theta = later.evaluate("theta", [0.3, 0.3 + found.period])
    assert theta[1] - theta[0] == pytest.approx(2 * math.pi, rel=1e-8)
    with pytest.raises(ValueError, match="differ from those at the start"):  # a turn ahead, which the damper takes back
        wheel.periodic(["theta", "rate(theta)"], period="2*pi/w", c=20).find()


@pytest.mark.long
def test_without_friction_multipliers_come_in_pairs():
    """A Hamiltonian system: with μ also 1/μ (Arnold, *Mathematical Methods of Classical Mechanics*, §42)."""
    hanging = fb.Mechanism.loads(DRIVEN)
    hanging.parameters.update({"c": 0, "F": "1 N*m"})
    multipliers = hanging.periodic(period="2*pi/Omega").find().multipliers
    assert sorted(np.abs(1 / multipliers)) == pytest.approx(sorted(np.abs(multipliers)), rel=1e-9)
    assert np.poly(multipliers) == pytest.approx(np.poly(multipliers)[::-1], rel=1e-9)


def test_a_start_that_never_comes_back_is_refused_with_how_far_it_came():
    with pytest.raises(ValueError, match="does not come to `top` within 3 s"):
        made = fb.Mechanism.loads(DRIVEN.replace("run:", "events: {top: {when: alpha - 3}}\nrun:"))
        made.periodic({"alpha": "alpha"}, section="top").find()
    with pytest.raises(ModelProblem, match="no event, contact, string, stop or joint `tip`"):
        fb.Mechanism.loads(DRIVEN).periodic(section="tip")
    with pytest.raises(ModelProblem, match="do not say the whole start"):
        fb.Mechanism.loads(DRIVEN.replace("beta: -0.2, ", "")).periodic({"alpha": "alpha"}, period=1).step()
