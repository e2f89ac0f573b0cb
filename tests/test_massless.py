"""Legs without mass, with particles at their ends: ``mass: 0`` and ``point_masses``; a foot may be as light as one likes."""

import math

import pytest

import freebody as fb

WALKER = """
freebody: 1
parameters: {beta: BETA, gamma: 0.009}
gravity: [sin(gamma)*(1 m/s^2), -cos(gamma)*(1 m/s^2)]
bodies:
  stance: {mass: 0, points: {foot: [0, 0], hip: [0, 1 m]}, point_masses: [{at: hip, mass: 1 kg}, {at: foot, mass: beta*(1 kg)}]}
  swing:  {mass: 0, points: {hip: origin, foot: [0, -1 m]}, point_masses: [{at: foot, mass: beta*(1 kg)}]}
joints:
  ground: {type: hinge, of: [ground.O, stance.foot], coordinate: theta}
  hip:    {type: hinge, of: [stance.hip, swing.hip], coordinate: {name: phi, sense: clockwise}}
initial: {theta: 0.2, phi: 0.4, rates: {theta: -0.2, phi: -0.1}}
run: {until: 3 s, rtol: 1e-12}
"""


@pytest.mark.parametrize("beta", [1e-6, 1e-12, 1e-100])
def test_light_feet_go_to_the_equations_of_the_simplest_walker(beta):
    """θ̈ = sin(θ − γ), φ̈ = θ̈ + θ̇² sin φ − cos(θ − γ) sin φ (Garcia et al., J. Biomech. Eng. 120, 1998, 281), with an error of the order of β."""
    now = fb.Mechanism.loads(WALKER.replace("BETA", str(beta))).solve()
    theta, phi, spin, gamma = 0.2, 0.4, -0.2, 0.009
    first = math.sin(theta - gamma)
    assert now["accel(theta)"] == pytest.approx(first, abs=3 * beta + 1e-15)
    second = first + spin**2 * math.sin(phi) - math.cos(theta - gamma) * math.sin(phi)
    assert now["accel(phi)"] == pytest.approx(second, abs=3 * beta + 1e-15)


def test_a_motion_with_feet_of_no_account_keeps_its_digits():
    light, lighter = (fb.Mechanism.loads(WALKER.replace("BETA", beta)).simulate() for beta in ("1e-13", "1e-60"))
    assert light.outcome.ok and light.evaluate("phi", 3.0) == pytest.approx(lighter.evaluate("phi", 3.0), abs=1e-10)


def test_a_leg_without_any_mass_is_refused_by_name():
    with pytest.raises(fb.MotionError, match="`swing` can move at `hip` with no inertia"):
        fb.Mechanism.loads(WALKER.replace("BETA", "0")).solve()


def test_what_never_turns_needs_no_inertia():
    text = """
freebody: 1
bodies: {cart: {mass: 2 kg, lines: {axle: {through: origin, angle: 0}}}}
joints: {rail: {type: slider, along: {through: ground.O, angle: 0}, line: cart.axle, coordinate: x}}
forces: {push: {type: force, at: cart.origin, x: 3 N}}
initial: {x: 0}
"""
    assert fb.Mechanism.loads(text).solve()["accel(x)"] == pytest.approx(1.5, abs=1e-15)
