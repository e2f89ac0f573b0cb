"""Joints along curves that are released: what ran on the curve flies on."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest
from seen import imbalance, kinds, model, motion

G = 9.81

CHUTE = """
bodies: {bead: {shape: particle, mass: 0.5 kg}}
ground: {points: {C: [0, 0]}, curves: {chute: {arc: {centre: C, radius: 2 m}}}}
joints: {track: {type: curved_slot, along: ground.chute, point: bead.centre, coordinate: s}}
initial: {s: pi, at_rest: true}
events: {off: {when: s - 1.75*pi, direction: rising, then: {release: track}}}
"""


def test_a_bead_leaves_its_chute():
    """From rest level with the centre, it leaves with v² = 2 g R sin 45° along the tangent there; up to then the chute pushes with
    3 m g sin φ, φ below the level, and then with nothing."""
    run = motion(CHUTE, 1.6, {"rtol": 1e-12})
    (off,) = run.events
    assert kinds(run) == [("released", ("track",))]
    place, speed = 2 * np.array([1, -1]) / math.sqrt(2), math.sqrt(2 * G * 2 * math.sqrt(0.5))
    after = 1.6 - off.t
    flown = place + speed * np.array([1, 1]) / math.sqrt(2) * after - np.array([0, G / 2]) * after**2
    assert [run.evaluate(f"bead.{c}", 1.6) for c in "xy"] == pytest.approx(flown, abs=1e-9)
    before = np.linspace(0.1, 0.99, 5) * off.t
    push = run.evaluate("track.F", before)
    assert push == pytest.approx(3 * 0.5 * G * np.sin(run.evaluate("s", before) - math.pi), rel=1e-8)
    assert run.evaluate("track.F", [off.t, 1.6]) == pytest.approx(0, abs=1e-12)
    assert run.evaluate("rate(s)", 1.6) == 0


SLED = """
bodies:
  sled: {shape: rectangle, width: 0.4 m, height: 0.1 m, mass: 3 kg, points: {P: [0.1, 0]}}
ground:
  points: {A: [0, 2], B: [3, 0]}
  curves: {slope: [{line: [A, B]}]}
joints: {runner: {type: curved_slot, along: ground.slope, point: sled.P, coordinate: s}}
initial: {s: 0.1, sled.angle: 0.7, rates: {s: 1, sled.angle: 2}}
events: {end: {when: s - 3, direction: rising, then: {release: runner}}}
"""


def test_a_body_flies_on_without_an_impact():
    """Energy, momentum and spin go on over the release; then the mass centre falls freely and the spin stays."""
    run = motion(SLED, 1.5, {"rtol": 1e-11})
    (end,) = run.events
    for what in ("momentum_x()", "momentum_y()", "omega(sled)", "energy()"):
        assert run.evaluate(what, end.t) == pytest.approx(run.before(what, end.t), rel=1e-9)
    times = np.linspace(end.t, 1.5, 5)
    assert run.evaluate("ax(sled.G)", times) == pytest.approx(0, abs=1e-10)
    assert run.evaluate("ay(sled.G)", times) == pytest.approx(-G, rel=1e-12)
    assert np.ptp(run.evaluate("omega(sled)", times)) < 1e-12
    assert imbalance(run) < 1e-10


def test_the_motion_up_to_the_release_is_that_of_a_track_that_stays():
    text = SLED.replace(", then: {release: runner}", "").replace("coordinate: s}", "coordinates: [s, turn]}").replace(
        "sled.angle: 0.7", "turn: 0.7").replace("sled.angle: 2", "turn: 2")  # fmt: skip
    stays, leaves = model(text).simulate(until=0.6, rtol=1e-12), motion(SLED, 0.6, {"rtol": 1e-12})
    times = np.linspace(0, 0.6, 7)
    for what in ("s", "angle(sled)", "runner.Fx", "runner.Fy"):
        assert leaves.evaluate(what, times) == pytest.approx(stays.evaluate(what, times), rel=1e-7, abs=1e-9)


@pytest.mark.parametrize("word", ["engaged: false"])
def test_what_is_not_there_yet_has_no_place_on_a_curve(word):
    with pytest.raises(Exception, match="has no place on it"):
        model(CHUTE.replace("coordinate: s}", f"coordinate: s, {word}}}")).simulate(until=1.0)


GUN = """
bodies:
  cart: {mass: 100 kg, lines: {axle: {through: origin, angle: 0}}, points: {C: [0, 3.2]}, curves: {tube: {arc: {centre: C, radius: 1.2 m}}}}
  ball: {shape: particle, mass: 5 kg}
ground: {lines: {road: {through: O, angle: 0}}}
joints:
  wheels: {type: slider, along: ground.road, line: cart.axle, coordinate: X}
  tube: {type: curved_slot, along: cart.tube, point: ball.centre, coordinate: {name: phi, zero: 180 deg}}
initial: {X: 0, phi: 0.3, at_rest: true}
events: {exit: {when: phi - 90 deg, direction: rising, then: {release: tube}}}
"""
LEAVING = {"chute": (CHUTE, "bead", "track"), "sled": (SLED, "sled", "runner"), "gun": (GUN, "ball", "tube")}
"""Models with the body that leaves a curve, and the joint."""


@pytest.mark.parametrize("moment", ["before", "after"])
@pytest.mark.parametrize("name", LEAVING)
def test_the_joints_of_the_model_bear_all_and_no_others_are_seen(name, moment):
    """At the release: m (a − g) of the body is the force of its joint, which acts on it and on what carries the curve."""
    text, body, joint = LEAVING[name]
    mechanism = model(text + "run: {until: 1.5 s}\n")
    run = mechanism.simulate()
    instant = mechanism.solve(**{moment: run.events[0].name})
    assert {joint} <= {*instant.reactions} <= {*mechanism.source().model["joints"], f"{body} free"}
    assert not instant.couplings
    mass = mechanism.free_bodies().bodies[body].mass
    ax, ay, _ = instant.bodies[body]
    assert instant.reactions[joint].on(body).values[:2] == pytest.approx([mass * ax, mass * (ay + G)], rel=1e-8, abs=1e-9)
    for form in ("minimal", "brute", "constraints"):
        stated = str(mechanism.equations(form, **{moment: run.events[0].name}))
        assert not re.search(rf"{joint}\.(pin|hold)", stated)
        assert moment == "before" or joint not in stated
