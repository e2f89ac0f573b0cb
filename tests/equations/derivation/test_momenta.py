"""Momenta that are said to be conserved are constant along true motions; those that books know are found, and no broken symmetry is."""

import numpy as np
import pytest
from conftest import FILES, loaded, named, numbers, states

import freebody as fb
from freebody import _core
from freebody.equations.derivation.momenta import momenta
from freebody.equations.derivation.told import Subject
from freebody.equations.tree import Sym, evaluate
from freebody.instant import State

STEP = 1e-5
"""Of time, s; a central difference of a smooth quantity is then good to 1e-9 of its size."""


def subject_of(mechanism):
    return Subject(mechanism.source(), mechanism.start()[0])


def told(text):
    """Bodies, the point or direction, and whether it turns, of all that is told of a model."""
    found = momenta(subject_of(fb.Mechanism.loads(text)))
    return {("+".join(each.found.bodies), each.found.twist.name) for each in found}


def rate(tree, subject):
    """d/dt along the motion, by central difference along the true accelerations; and its size."""
    names, values = [c["name"] for c in subject.coordinates], numbers(subject)

    def at(t):
        moved = {Sym(n): values[Sym(n)] + t * values[Sym(n, 1)] + t * t / 2 * values[Sym(n, 2)] for n in names}
        moved |= {Sym(n, 1): values[Sym(n, 1)] + t * values[Sym(n, 2)] for n in names}
        return evaluate(tree, values | moved, subject.tables)

    return (at(STEP) - at(-STEP)) / (2 * STEP), max(1.0, abs(at(0.0)))


@pytest.mark.parametrize("path", FILES, ids=named)
def test_what_is_told_has_no_rate_in_any_motion(path):
    mechanism, start = loaded(path)
    try:
        mechanism.solve()
    except _core.MotionError:
        pytest.skip("the model has no motion at all")
    found = momenta(Subject(mechanism.source(), start))
    for subject in states(mechanism.source(), start):
        for each in found:
            change, size = rate(each.momentum, subject)
            assert abs(change) < 1e-6 * size, f"{each.found.bodies} {each.found.twist.name}"


@pytest.mark.parametrize("name", ["19.3.15/model.yaml", "19.3.10/model.yaml", "19.3.5/model.yaml", "19.3.3/model.yaml"])
def test_what_is_told_is_constant_along_a_simulated_motion(name):
    path = next(path for path in FILES if str(path).endswith(f"systems/{name}"))
    mechanism, start = loaded(path)
    source = mechanism.source()
    run = mechanism.simulate(until=0.5, rtol=1e-10)
    names = [c["name"] for c in source.about["coordinates"]]
    for each in momenta(Subject(source, start)):
        values = []
        for t, q, u in zip(run.t, run.q, run.u, strict=True):
            at = Subject(source, State(start.p, float(t), q, u))
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
    assert told(PINNED_DISK) == {("disk", "the mass centre of disk")}


def test_friction_in_the_pin_takes_the_spin_away():
    rubbing = "forces:\n  drag: {type: torque, on: disk, from: arm, value: -c*rate(phi)}\n"
    assert told(PINNED_DISK.replace("initial:", rubbing + "initial:")) == set()


def test_a_pin_beside_the_centre_takes_the_spin_away():
    assert told(PINNED_DISK.replace("{C: centre}", "{C: [r/3, 0]}")) == set()


def test_across_a_tilted_gravity_a_momentum_is_kept():
    assert told(TILTED) == {("P+Q", "the direction across gravity"), ("P+Q", "the mass centre of P + Q")}


def test_a_free_chain_keeps_its_momentum_and_its_spin_about_its_mass_centre():
    assert told(FREE_BODIES) == {("one+two", "x"), ("one+two", "y"), ("one+two", "the mass centre of one + two")}


def test_along_a_frictionless_slope_the_momentum_is_kept_without_gravity_and_not_with_it():
    assert told(SLOPE) == {("block+rod", "rail")}
    assert told(SLOPE.replace("gravity: none", "gravity: 9.81 m/s^2")) == set()


def test_a_central_force_keeps_the_moment_of_momentum_about_its_centre_until_there_is_a_wind():
    leash = next(path for path in FILES if str(path).endswith("systems/19.3.1/model.yaml"))
    assert told(leash.read_text()) == {("particle", "ground.O")}


def test_every_reason_is_said_in_the_letters_of_the_equations():
    said = fb.Mechanism.loads(SLOPE).equations().text()
    assert "rail.Fn" not in said and "N_rail" in said
