"""Dry friction: sticking and slipping on a belt, sliding that becomes rolling, and the rod of Painlevé."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest
from seen import changes, kinds, model, motion

import freebody as fb

G = 9.81

BELT = """
parameters: {v: 0.1 m/s, k: 100 N/m, mu: 0.2, mu_s: 0.4}
bodies: {block: {shape: particle, mass: 1 kg}, belt: {shape: rod, length: 1 m, mass: 1 kg}}
ground: {points: {P: [-1, 0], Q: [1, 0]}}
joints: {guide: {type: slider, along: [ground.P, ground.Q], line: [belt.start, belt.end], coordinate: s}}
motions: {drive: {of: s, is: v*t}}
forces: {spring: {type: spring, along: block.x, stiffness: k}}
contacts: {grip: {of: [block, [belt.start, belt.end]], friction: mu, static_friction: mu_s}}
initial: {block.x: 0, block.y: 0, s: 0, rates: {block.x: v}}
"""


@pytest.mark.parametrize("v", [0.05, 0.1, 0.4])
def test_stick_and_slip_on_a_belt(v):
    """A mass on a spring rides with the belt up to k x = μₛ m g. Then it swings about μ m g/k, with the amplitude and phase
    of x − μmg/k = a, ẋ = v, a = (μₛ − μ) m g/k, until it has the belt's speed again, at −a; there it sticks for 2a/v."""
    omega, a = 10.0, 0.2 * G / 100
    slip, stick = 2 * (math.pi - math.atan(a * omega / v)) / omega, 2 * a / v
    first = 0.4 * G / 100 / v
    run = motion(BELT, first + 4 * (slip + stick), {"rtol": 1e-11}, v=v)
    starts = [first + i * (slip + stick) for i in range(4)]  # of slipping; the fifth is the end of the run
    known = [pair for t in starts for pair in ((t, "slip"), (t + slip, "stick"))]
    seen = [change for change in changes(run) if 0 < change.t < run.outcome.t - 1e-6]
    assert [change.kind for change in seen] == [kind for _, kind in known]
    assert [change.t for change in seen] == pytest.approx([t for t, _ in known], abs=1e-9)
    middle = first + slip + stick / 2  # as the block sticks, the spring passes μ m g
    assert run.evaluate("grip.slip", middle) == pytest.approx(0, abs=1e-14)
    assert run.evaluate("abs(grip.T)", middle) == pytest.approx(0.2 * G, abs=1e-8)
    sliding = first + slip * np.array([0.1, 0.5, 0.9])
    assert np.abs(run.evaluate("grip.T", sliding)) == pytest.approx(0.2 * G, rel=1e-12)


SLED = """
bodies: {box: {shape: rectangle, width: 1 m, height: 0.5 m, mass: 2 kg}}
ground: {lines: {floor: {through: O, angle: 0}}}
contacts: {floor: {of: [box, ground.floor], friction: 0.3}}
initial: {box.x: 0.2, box.y: 0.25, box.angle: 0, rates: {box.x: SPEED}}
"""


@pytest.mark.parametrize("speed", [3.0, -3.0])
def test_a_box_that_slides_is_borne_ahead_of_its_centre(speed):
    """T is along the normal turned clockwise, x here, and so −μ N sgn v; its moment μ N h/2 is that of N, μ h/2 ahead of the centre."""
    mechanism, ahead = model(SLED.replace("SPEED", str(speed))), math.copysign(1, speed)
    texts = ["floor.N", "floor.T", "floor.Fx", "floor.Fy", "floor.x", "floor.y", "floor.slip"]
    weight = 2 * G
    expected = [weight, -0.3 * weight * ahead, -0.3 * weight * ahead, weight, 0.2 + 0.3 * 0.25 * ahead, 0, speed]
    assert mechanism.source().evaluate(texts, mechanism.solve().state) == pytest.approx(np.array(expected), abs=1e-12)


def test_a_belt_does_the_work_that_friction_takes():
    """Over a period the block's energy is as before: the drive gives what friction loses, μ m g times the way slid."""
    omega, a, v = 10.0, 0.2 * G / 100, 0.1
    slip, stick = 2 * (math.pi - math.atan(a * omega / v)) / omega, 2 * a / v
    start = 0.4 * G / 100 / v
    run = motion(BELT, start + slip + stick, {"rtol": 1e-11})
    drive, friction = (np.diff(run.evaluate(e, [start, start + slip + stick]))[0] for e in ("drive.work", "friction_work()"))
    slid = v * slip + 2 * a  # the belt goes on by v·slip, and the block falls back by 2a
    assert friction == pytest.approx(-0.2 * G * slid, rel=1e-9)
    assert drive == pytest.approx(-friction, rel=1e-9)


DISK = """
parameters: {v: 0 m/s, w: 0 rad/s, R: 0.5 m, mu: 0.2}
bodies: {disk: {shape: disk, radius: R, mass: 2 kg}}
ground: {points: {P: [0, 0], Q: [1, 0]}}
contacts: {floor: {of: [disk, [ground.P, ground.Q]], friction: mu}}
initial: {disk.x: 0, disk.y: R, rates: {disk.x: v, disk.angle: -w}}
"""


@pytest.mark.parametrize("v, w", [(3, 0), (0, 6), (2, -3), (1, 9), (-4, 5)])
def test_sliding_becomes_rolling(v, w):
    """Friction μ m g changes the slip v − ωR by 3 μ g a second; angular momentum about the floor is kept: (2v + ωR)/3 rolls."""
    run = motion(DISK, 2, v=v, w=w)
    (stick,) = changes(run, "stick")
    assert stick.t == pytest.approx(abs(v - w * 0.5) / (3 * 0.2 * G), abs=1e-9)
    rolls = (2 * v + w * 0.5) / 3
    assert run.u[-1] == pytest.approx([rolls, 0, -rolls / 0.5], abs=1e-9)
    assert run.evaluate("floor.T", 1.9) == pytest.approx(0, abs=1e-12)
    assert run.evaluate("friction_work()", 2.0) == pytest.approx(-((v - w * 0.5) ** 2) / 3, rel=1e-9)  # ½ (m/3) slip²


def test_a_disk_with_backspin_turns_round():
    """2v < −ωR: it comes back, and passes standing still at v/(μ g) without a change of any kind."""
    run = motion(DISK, 3, v=1, w=-12)
    assert kinds(run) == [("contact", ("floor",)), ("stick", ("floor",))]
    assert run.evaluate("vx(disk.centre)", 1 / (0.2 * G)) == pytest.approx(0, abs=1e-12)
    assert run.u[-1, 0] == pytest.approx((2 - 6) / 3, abs=1e-12)


ROD = """
parameters: {h: 1 m, th: 1, mu: 0.5, w: 0 rad/s, slip: 1 m/s}
bodies: {rod: {shape: rod, length: 2*h, mass: 1 kg}}
ground: {points: {P: [0, 0], Q: [1, 0]}}
contacts: {tip: {of: [rod.start, [ground.P, ground.Q]], friction: mu}}
initial:
  rod.x: h*cos(th)
  rod.y: h*sin(th)
  rod.angle: th
  rates: {rod.x: -slip - w*h*sin(th), rod.y: w*h*cos(th), rod.angle: w}
"""


def painleve(angle: float, mu: float, w: float) -> tuple[float, float]:
    """m A and b of a uniform rod of half-length 1 m whose lower tip slides towards the side away from which it leans.

    Génot and Brogliato (1999): p̈ = A N + b for the height p of the tip, N its normal force.
    """
    return 1 + 3 * math.cos(angle) * (math.cos(angle) - mu * math.sin(angle)), w**2 * math.sin(angle) - G


def critical(angle: float) -> float:
    """The friction at which A = 0."""
    return (4 + math.tan(angle) ** 2) / (3 * math.tan(angle))


GRID = [(math.radians(a), mu, w) for a in range(10, 90, 8) for mu in (0.3, 1.0, 1.4, 1.9, 2.7, 4.0) for w in (0.0, 2.5, 5.0, 9.0)]


def outcome(angle: float, mu: float, w: float, slip: float = 1.0) -> tuple[str, float | None]:
    """What the rod does at this instant: the name of the refusal with the friction it tells, or what the contact does."""
    try:
        solved = model(ROD).solve(th=angle, mu=mu, w=w, slip=slip)
    except fb.MotionError as error:
        return error.args[0], float(re.search(r"friction of ([\d.]+)", error.args[3])[1])
    normal = solved["tip.N"]
    a, b = painleve(angle, mu if slip > 0 else -mu, w)
    assert normal == pytest.approx(max(0.0, -b / a), rel=1e-11 + 1e-14 / abs(a), abs=1e-11)  # near A = 0 its round-off counts
    return ("slides" if normal > 0 else "lifts off"), None


def test_the_four_classes_of_the_rod():
    """A, b > 0 lifts off; A > 0 > b slides with N = −b/A; A < 0 < b has two answers; A, b < 0 has none."""
    seen = set()
    classes = {(1, -1): "slides", (1, 1): "lifts off", (-1, 1): "painleve_indeterminate", (-1, -1): "painleve_inconsistent"}
    for angle, mu, w in GRID:
        a, b = painleve(angle, mu, w)
        assert min(abs(a), abs(b)) > 1e-3, "the grid keeps off the borders"
        name, friction = outcome(angle, mu, w)
        assert name == classes[np.sign(a), np.sign(b)], (math.degrees(angle), mu, w)
        if friction is not None:
            assert friction == pytest.approx(critical(angle), rel=1e-6)
        seen.add(name)
    assert len(seen) == 4


def test_the_other_way_there_is_no_paradox():
    """A rod that is dragged, rather than pushed, has A > 0 for any friction."""
    for angle, mu, w in GRID:
        assert outcome(angle, mu, w, slip=-1)[0] in ("slides", "lifts off")


@pytest.mark.parametrize("past", [1e-4, 1e-7, 1e-9])
def test_the_paradox_begins_at_the_critical_friction(past):
    """At tan θ = 2 it is at its least, 4/3."""
    angle = math.atan(2)
    assert critical(angle) == pytest.approx(4 / 3, rel=1e-15)
    assert outcome(angle, 4 / 3 - past, 0)[0] == "slides"
    assert outcome(angle, 4 / 3 + past, 0) == ("painleve_inconsistent", pytest.approx(4 / 3, abs=1e-6))


def test_a_run_into_the_paradox_is_refused_by_name():
    with pytest.raises(fb.MotionError, match="jams") as refused:
        model(ROD, th=math.atan(2), mu=1.5).simulate(until=0.1)
    assert refused.value.args[0] == "painleve_inconsistent"
