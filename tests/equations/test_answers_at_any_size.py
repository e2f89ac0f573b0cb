"""What is said of a mechanism does not depend on its size, mass or pace: equations, answers, impacts, verdicts, diagrams.

Each number of a model is one of lengths L, masses M and times T, as in ``tests/switching/test_sizes.py``.
"""

from __future__ import annotations

import numpy as np
import pytest
from store import but_long

import freebody as fb
from freebody.check import Checker
from freebody.equations.topics.common import Asked
from freebody.equations.topics.impact_equations import Impact
from freebody.equations.topics.impulse_momentum import jumps
from freebody.equations.topics.linear import linear

SCALES = [
    (1e-9, 1e-18, 1e-6),
    (1e6, 1e20, 1e-3),
    *(pytest.param(s, marks=pytest.mark.long) for s in ((1e-3, 1.0, 1e3), (1e6, 1.0, 1e6))),
]
CART = """
bodies: {cart: {shape: particle, mass: 2*M}, bob: {shape: particle, mass: M}}
joints:
  track: {type: slot, along: ground.floor, point: cart.centre, coordinate: x}
  arm: {type: link, of: [cart.centre, bob.centre], length: L, coordinate: phi}
ground: {lines: {floor: {through: O, angle: 0}}}
forces: {spring: {type: spring, along: x, stiffness: 3*M/T^2}}
initial: {x: 0.1*L, phi: -1, rates: {phi: 0.3/T}}
"""
FOUR_BAR = """
ground: {points: {D: [1.2*L, 0]}}
bodies: {crank: {shape: rod, length: 0.4*L, mass: M}, coupler: {shape: rod, length: 0.6*L, mass: M}, rocker: {shape: rod, length: 1.1*L, mass: M}}
joints:
  A: {type: hinge, of: [ground.O, crank.start], coordinate: theta}
  B: {type: hinge, of: [crank.end, coupler.start], coordinate: beta}
  C: {type: hinge, of: [coupler.end, rocker.end]}
  D: {type: hinge, of: [ground.D, rocker.start], coordinate: phi}
initial: {theta: 90 deg, guess: {phi: 130 deg}, rates: {theta: 0.7/T}}
"""
STOPPED = """
bodies: {rod: {shape: rod, length: L, mass: M}}
joints: {pivot: {type: hinge, of: [ground.O, rod.start], coordinate: theta}}
stops: {stop: {of: theta, least: -2.2, restitution: 0.6}}
initial: {theta: -0.4, at_rest: true}
run: {until: 6*T}
"""
DROPPED = """
ground: {lines: {floor: {through: O, angle: 0}}}
bodies: {rod: {shape: rectangle, width: L, height: 0.2*L, mass: M}}
contacts: {floor: {of: [rod, ground.floor], restitution: 0.5}}
initial: {rod.x: 0, rod.y: L, rod.angle: -0.4, at_rest: true}
run: {until: 6*T}
"""


def mechanism(text: str, scales: tuple[float, float, float] = (1.0, 1.0, 1.0)) -> fb.Mechanism:
    """A model under the gravity L/T²."""
    made = fb.Mechanism.loads("freebody: 1\nparameters: {L: 1 m, M: 1 kg, T: 1 s}\ngravity: [0, -L/T^2]\n" + text)
    made.parameters.update(dict(zip("LMT", scales, strict=True)))
    return made


@pytest.mark.parametrize("scales", but_long(SCALES, SCALES[1]))
@pytest.mark.parametrize("text", [CART, FOUR_BAR])
def test_equations_and_diagrams_are_the_same(text, scales):
    known, found = mechanism(text), mechanism(text, scales)
    for form in ("minimal", "brute", "constraints"):
        assert str(found.equations(form)) == str(known.equations(form))
    assert found.diagram().description == known.diagram().description


@pytest.mark.parametrize("scales", but_long(SCALES, SCALES[1]))
@pytest.mark.parametrize(("text", "asked"), [(CART, "x"), (FOUR_BAR, "theta")])
def test_answers_are_the_same(text, asked, scales):
    """Each is held against numbers beside the state, at rates of the mechanism's own."""
    known, found = (m.solve_in_letters([asked], at_rest=True) for m in (mechanism(text), mechanism(text, scales)))
    assert found[asked] == known[asked]


@pytest.mark.parametrize("scales", but_long(SCALES, SCALES[1]))
@pytest.mark.parametrize("text", [STOPPED, DROPPED])
def test_impacts_are_the_same(text, scales):
    known, found = (jumps(Impact.of(m.blow())).spelt() for m in (mechanism(text), mechanism(text, scales)))
    assert found == known


@pytest.mark.parametrize("scales", but_long(SCALES, SCALES[1]))
def test_small_perturbations_grow_with_the_pace(scales):
    known, found = (linear(Asked(m, m.start()[0]), x=0, phi=-np.pi / 2) for m in (mechanism(CART), mechanism(CART, scales)))
    assert found.stability == known.stability
    roots = [[root.value for root in each.eigenvalues] for each in (found, known)]
    np.testing.assert_allclose(np.multiply(roots[0], scales[2]), roots[1], rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("scales", but_long(SCALES, SCALES[1]))
def test_verdicts_are_the_same(scales):
    said = ["3 M x'' = -3*M/T^2*x + M L (phi'' sin(phi) + phi'^2 cos(phi))", "3 M x'' = -3*M/T^2*x", "constant: energy()"]
    said += ["if phi = -pi/2, phi' = 0, x = 0: T_arm = M*L/T^2", "limit: phi'' = -L/T^2*cos(phi)/L as x -> 0"]
    for text in said:
        known, found = (Checker(m).check(text, correcting=False) for m in (mechanism(CART), mechanism(CART, scales)))
        assert found.kind is known.kind, text
