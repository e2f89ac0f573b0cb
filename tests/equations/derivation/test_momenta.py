"""Momenta that are said to be conserved are constant along true motions; those that books know are found, and no broken symmetry is."""

import numpy as np
import pytest
from evaluated import numbers, rate
from store import ANSWERED, MODELS, elsewhere, every, mechanism, start, subject

import freebody as fb
from freebody.core import State
from freebody.equations.derivation.conserved import momenta
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import Sym


def conserved(text):
    """Bodies, the point or direction, and whether it turns, of all that is conserved."""
    made = fb.Mechanism.loads(text)
    found = momenta(SymbolicState(made.source(), made.start()[0]))
    return {("+".join(each.found.bodies), each.found.twist.name) for each in found}


@every(ANSWERED)
def test_what_is_said_has_no_rate_in_any_motion(model):
    found = momenta(subject(model))
    for at in elsewhere(model):
        for each in found:
            size = max(1.0, abs(evaluate(each.momentum, numbers(at), at.tables)))
            assert abs(rate(each.momentum, at)) < 1e-9 * size, f"{each.found.bodies} {each.found.twist.name}"


@pytest.mark.parametrize("name", ["19.3.15/model", "19.3.10/model", "19.3.5/model", "19.3.3/model"])
def test_what_is_said_is_constant_along_a_simulated_motion(name):
    source, state = mechanism(name).source(), start(name)[0]
    run = mechanism(name).simulate(until=0.5, rtol=1e-10)
    names = [c["name"] for c in source.metadata["coordinates"]]
    found = momenta(subject(name))
    assert found
    for each in found:
        values = []
        for t, q, u in zip(run.t, run.q, run.u, strict=True):
            at = SymbolicState(source, State(state.p, float(t), q, u))
            letters = at.values | dict(zip(map(Sym, names), q, strict=True))
            values.append(evaluate(each.momentum, letters, at.tables))
        assert np.ptp(values) < 1e-7 * max(1.0, np.abs(values).max())


PINNED_DISK = """
freebody: 1
name: a disk on a frictionless pin at its centre, carried by an arm
parameters: {m: 1 kg, l: 1 m, r: 0.3 m, c: 0.1 N*m*s, g: 9.81 m/s^2}
gravity: g
bodies:
  arm:  {shape: rod, length: l, mass: m, points: {A: start, B: end}}
  disk: {shape: disk, radius: r, mass: m, points: {C: centre}}
joints:
  pivot: {type: hinge, of: [ground.O, arm.A], coordinate: theta}
  axle:  {type: hinge, of: [arm.B, disk.C], coordinate: phi}
initial: {theta: 0.4, phi: 0.1, rates: {theta: 0.3, phi: 2}}
run: {until: 1 s}
"""
TILTED = """
freebody: 1
name: two particles on a spring, falling along a tilted gravity
parameters: {m: 1 kg, k: 20 N/m, gx: 4 m/s^2, gy: 7 m/s^2}
gravity: [gx, -gy]
bodies:
  P: {shape: particle, mass: m}
  Q: {shape: particle, mass: 2*m}
forces:
  spring: {type: spring, between: [P.centre, Q.centre], stiffness: k}
initial: {P.x: 0, P.y: 0, Q.x: 1.2 m, Q.y: 0.3 m, at_rest: true}
run: {until: 1 s}
"""
FREE_BODIES = """
freebody: 1
name: two rods joined by a pin, in space
parameters: {m: 1 kg, l: 1 m}
gravity: none
bodies:
  one: {shape: rod, length: l, mass: m, points: {A: start, B: end}}
  two: {shape: rod, length: l, mass: m, points: {A: start, B: end}}
joints:
  pin: {type: hinge, of: [one.B, two.A], coordinate: phi}
initial: {phi: 0.5, at_rest: true}
run: {until: 1 s}
"""
SLOPE = """
freebody: 1
name: a block with a pendulum on a frictionless slope
parameters: {m: 1 kg, l: 1 m, alpha: 20 deg}
gravity: none
ground: {lines: {slope: {through: O, angle: -alpha}}}
bodies:
  block: {mass: m, inertia: 0.1 kg*m^2, lines: {base: {through: origin, angle: 0}}}
  rod:   {shape: rod, length: l, mass: m, points: {A: start}}
joints:
  rail: {type: slider, along: ground.slope, line: block.base, coordinate: s}
  pin:  {type: hinge, of: [block.origin, rod.A], coordinate: theta}
initial: {s: 0, theta: 0.6, at_rest: true}
run: {until: 1 s}
"""


def test_a_disk_on_a_pin_through_its_centre_keeps_its_own_spin():
    assert conserved(PINNED_DISK) == {("disk", "the mass centre of disk")}


def test_friction_in_the_pin_takes_the_spin_away():
    rubbing = "forces:\n  drag: {type: torque, on: disk, from: arm, value: -c*rate(phi)}\n"
    assert conserved(PINNED_DISK.replace("initial:", rubbing + "initial:")) == set()


def test_a_pin_beside_the_centre_takes_the_spin_away():
    assert conserved(PINNED_DISK.replace("{C: centre}", "{C: [r/3, 0]}")) == set()


def test_across_a_tilted_gravity_a_momentum_is_kept():
    assert conserved(TILTED) == {("P+Q", "the direction across gravity"), ("P+Q", "the mass centre of P + Q")}


def test_a_free_chain_keeps_its_momentum_and_its_spin_about_its_mass_centre():
    assert conserved(FREE_BODIES) == {("one+two", "x"), ("one+two", "y"), ("one+two", "the mass centre of one + two")}


def test_along_a_frictionless_slope_the_momentum_is_kept_without_gravity_and_not_with_it():
    assert conserved(SLOPE) == {("block+rod", "rail")}
    assert conserved(SLOPE.replace("gravity: none", "gravity: 9.81 m/s^2")) == set()


def test_a_central_force_keeps_the_moment_of_momentum_about_its_centre_until_there_is_a_wind():
    assert conserved(MODELS["19.3.1/model"].read_text()) == {("particle", "ground.O")}


def test_every_reason_is_said_in_the_symbols_of_the_equations():
    said = fb.Mechanism.loads(SLOPE).equations(long=True).text()
    assert "rail.Fn" not in said and "N_rail" in said
