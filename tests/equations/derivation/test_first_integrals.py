"""First integrals that are found, constant along motions; none where there is none."""

import numpy as np
import pytest

import freebody as fb
from freebody.catalogue import model_file
from freebody.equations.language import read_text
from freebody.symbolic.algebra import equal

SLOT = """
freebody: 1
gravity: GRAVITY
parameters: {W: 2 rad/s, l: 1 m, k: 3 N/m, L0: 0.2 m, m: 2 kg, g: 9.81 m/s^2}
bodies: {rod: {shape: rod, length: l, mass: 1}, bead: {shape: particle, mass: m}}
joints:
  pivot: {type: hinge, of: [ground.O, rod.start], coordinate: phi}
  track: {type: slot, point: bead.centre, along: [rod.start, rod.end], coordinate: R}
forces: {s: {type: spring, along: R, stiffness: k, rest_length: L0DAMPING}}
motions: {motor: {of: phi, is: LAW}}
initial: {phi: 0, R: 0.5, rates: {R: 0.3}}
run: {until: 2}
"""


def slot(law="W*t", damping="", gravity="none"):
    return fb.Mechanism.loads(SLOT.replace("LAW", law).replace("DAMPING", damping).replace("GRAVITY", gravity))


def test_jacobis_integral_in_a_slot_that_turns_evenly():
    (found,) = slot().first_integrals()
    closed = read_text("m/2*(rate(R)^2 - rate(phi)^2*R^2) + k/2*(R - L0)^2")
    shift = read_text("m/2*(rate(R)^2 - rate(phi)^2*R^2) + k/2*R^2 - k*L0*R")  # a constant is free
    assert equal(found.quantity, closed) or equal(found.quantity, shift)
    along = found.along(slot().simulate(rtol=1e-12))
    assert np.ptp(along) < 1e-10 and found.words == "energy of the motion relative to φ (Jacobi's integral)"


@pytest.mark.parametrize(
    "changed", [{"law": "W*t + 0.3*sin(t)"}, {"law": "W*t^2"}, {"damping": ", damping: 0.1"}, {"gravity": "g"}]
)
def test_none_where_the_motion_is_uneven_or_damped_or_time_is_in_gravity(changed):
    assert slot(**changed).first_integrals() == []


def test_they_stand_in_the_derivation():
    fallen = fb.Mechanism.load("python/freebody/systems/19.3.20-guide-and-pendulum/free_fall.yaml")
    text = " ".join(fallen.equations(long=True).text().split())
    assert "momentum of y, less what its force gives it is conserved" in text
    assert "The energy of the motion relative to y is conserved: neither time nor y is in the equations of θ." in text


@pytest.mark.parametrize("system", ["S19.18", "19.3.17", "19.3.15", "19.3.18"])
def test_they_are_constant_along_motions_of_the_catalogue(system):
    model = fb.Mechanism.load(model_file(f"{system}/model"))
    run = model.simulate(rtol=1e-12, until=1)
    for found in model.first_integrals():
        along = found.along(run)
        assert np.ptp(along) < 1e-9 * max(1.0, np.abs(along).max()), found.words
