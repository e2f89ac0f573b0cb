"""Strings that pull, go slack and taut, wind and unwind: closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from seen import changes, kinds, model, motion

import freebody as fb

G = 9.81

ATWOOD = """
parameters: {R: 0.2 m, mp: 3 kg, m1: 1 kg, m2: 2 kg}
bodies:
  pulley: {shape: disk, radius: R, mass: mp}
  a: {shape: particle, mass: m1}
  b: {shape: particle, mass: m2}
joints: {axle: {type: hinge, of: [ground.O, pulley.centre], coordinate: turn}}
strings:
  left: {ends: [a.centre, {drum: pulley.centre, radius: R, sense: ccw, wound: 2 m}]}
  right: {ends: [b.centre, {drum: pulley.centre, radius: R, sense: clockwise, wound: 2 m}]}
initial: {a.x: -R, a.y: -1.5 m, b.x: R, b.y: -1 m, at_rest: true}
"""


@pytest.mark.parametrize("m2", [2.0, 0.4, 1.0])
def test_atwood_with_a_pulley_of_mass(m2):
    """a = (m₂ − m₁) g/(m₁ + m₂ + M/2) for a disk as pulley; the strings pull with m₁ (g + a) and m₂ (g − a)."""
    run = motion(ATWOOD, 0.5, m2=m2)
    a = (m2 - 1) * G / (1 + m2 + 1.5)
    assert run.evaluate("accel(turn)", 0.3) == pytest.approx(-a / 0.2, abs=1e-12)
    assert run.q[-1] == pytest.approx([-a / 1.6, -0.2, -1.5 + a / 8, 0.2, -1 - a / 8], abs=1e-12)
    pulls = [run.evaluate(f"{s}.tension", 0.3) for s in ("left", "right")]
    assert pulls == pytest.approx([1 * (G + a), m2 * (G - a)], rel=1e-12)
    push = [run.evaluate(f"axle.F{axis}", 0.3) for axis in "xy"]
    assert push == pytest.approx([0, sum(pulls) + 3 * G], abs=1e-11)


LEASH = """
gravity: none
parameters: {m1: 1 kg, m2: 3 kg, e: 0}
bodies: {a: {shape: particle, mass: m1}, b: {shape: particle, mass: m2}}
strings: {leash: {ends: [a.centre, b.centre], length: 1 m, restitution: e}}
initial: {a.x: 0, a.y: 0, b.x: 0.5 m, b.y: 0, rates: {a.y: 0.3, b.x: 2}}
"""


@pytest.mark.parametrize("e", [0, 0.4, 1])
@pytest.mark.parametrize("m1, m2", [(1, 3), (5, 0.2)])
def test_a_leash_goes_taut(m1, m2, e):
    """Slack until |r| = 1; then the speed along it jumps to −e times what it was: ½ μ (1 − e²) v² is lost, μ = m₁m₂/(m₁ + m₂).

    Without restitution the two have a common speed along the leash, and go round each other with the tension μ w²/l.
    """
    run = motion(LEASH, 2, m1=m1, m2=m2, e=e)
    t = (-1 + math.sqrt(1 + 0.75 * 4.09)) / 4.09  # |(0.5 + 2t, −0.3t)| = 1
    taut, *_ = changes(run, "taut")
    assert taut.t == pytest.approx(t, abs=1e-12)
    along = np.array([0.5 + 2 * t, -0.3 * t])
    across = np.array([-along[1], along[0]])
    reduced, jump = m1 * m2 / (m1 + m2), float(along @ [2, -0.3])
    assert taut.lost == pytest.approx(reduced * jump**2 * (1 - e**2) / 2, abs=1e-12)
    before, after = (np.array(u).reshape(2, 2) for u in (taut.before["u"], taut.after["u"]))
    impulse = reduced * jump * (1 + e) * along
    assert m1 * (after[0] - before[0]) == pytest.approx(impulse, abs=1e-12)
    assert m2 * (after[1] - before[1]) == pytest.approx(-impulse, abs=1e-12)
    assert (after[1] - after[0]) @ along == pytest.approx(-e * jump, abs=1e-12)
    momentum = [m2 * 2, m1 * 0.3]
    for end in (t / 2, t, 2.0):
        stated = [run.evaluate(f"momentum_{axis}()", end) for axis in "xy"]
        assert stated == pytest.approx(momentum, abs=1e-11)
    if e == 0:
        swing = float(across @ [2, -0.3])
        assert after[0] @ along == pytest.approx(float(along @ momentum) / (m1 + m2), abs=1e-12)
        assert run.evaluate("leash.tension", [t + 0.2, 1.9]) == pytest.approx([reduced * swing**2] * 2, rel=1e-9)
    else:
        assert run.evaluate("leash.tension", t + 0.01) == 0


REEL = """
gravity: none
parameters: {R: 0.1 m, l: 1 m, v: 3 m/s}
bodies: {bob: {shape: particle, mass: 2 kg}}
strings: {cord: {ends: [bob.centre, {drum: ground.O, radius: R, sense: ccw, wound: 5 m}]}}
initial: {bob.x: R, bob.y: l, rates: {bob.x: v}}
"""


@pytest.mark.parametrize("v, until", [(-3.0, 0.16), (-3.0, 1.6), (3.0, 1.0)])
def test_a_bob_on_a_drum_runs_along_the_involute(v, until):
    """Its speed stays. Wound on by φ, the free length is l − Rφ and its end moves across it: (l − Rφ) φ̇ = v, so
    lφ − Rφ²/2 = vt; the tension is m v²/(l − Rφ)."""
    run = motion(REEL, until, {"rtol": 1e-12}, v=v)
    times = np.linspace(0, until, 41)
    free = np.sqrt(1 + 2 * 0.1 * v * times)  # = l − Rφ, the root of the quadratic
    phi = (1 - free) / 0.1
    known = (0.1 + 1j * free) * np.exp(1j * phi)
    place = run.evaluate("bob.x", times) + 1j * run.evaluate("bob.y", times)
    assert np.abs(place - known).max() < 1e-9
    assert np.abs(np.hypot(run.evaluate("vx(bob.centre)", times), run.evaluate("vy(bob.centre)", times)) - 3).max() < 1e-9
    assert run.evaluate("cord.tension", times) == pytest.approx(2 * 9 / free, rel=1e-8)


SPOOL = """
parameters: {R: 0.05 m, r: 0.01 m, m: 0.2 kg}
bodies: {spool: {shape: SHAPE, radius: R, mass: m}}
ground: {points: {top: [-r, 0.2 m]}}
strings: {cord: {ends: [ground.top, {drum: spool.centre, radius: r, sense: clockwise, wound: 0.5 m}]}}
initial: {spool.x: 0, spool.y: 0, spool.angle: 0, at_rest: true}
"""


@pytest.mark.parametrize("shape, r", [("disk", 0.01), ("disk", 0.03), ("ring", 0.05)])
def test_a_yo_yo_goes_down(shape, r):
    """It falls with g/(1 + I/(mr²)), upright cord; a hoop on its own cord with g/2, and half of its weight hangs on the cord."""
    run = motion(SPOOL.replace("SHAPE", shape), 0.3, r=r)
    share = (0.5 if shape == "disk" else 1) * (0.05 / r) ** 2  # I/(mr²)
    a = G / (1 + share)
    assert run.q[-1] == pytest.approx([0, -a * 0.045, -a * 0.045 / r], abs=1e-12)
    assert run.evaluate("cord.tension", 0.2) == pytest.approx(0.2 * (G - a), rel=1e-12)
    assert run.evaluate("kinetic()", 0.3) == pytest.approx(0.2 * G * a * 0.045, rel=1e-12)


def test_a_yo_yo_turns_over_at_the_end_of_its_cord():
    """At the end the cord swings to the other side of the drum and is wound on again: a turn that takes no energy.

    On its way up it has at each height the energy, and nearly the speed, of its way down.
    """
    run = motion(SPOOL.replace("SHAPE", "disk"), 1.6, {"rtol": 1e-11})
    assert kinds(run) == [("taut", ("cord",))]
    total = run.evaluate("kinetic() + potential()", np.linspace(0, 1.6, 200))
    assert np.ptp(total) < 1e-9
    lowest = run.evaluate("spool.y", np.linspace(1.1, 1.3, 2001)).min()
    # The axle hangs at 0.2 m + 0.5 m and the straight stretch of the start below the top, give or take the drum.
    assert -0.5 - 0.011 < lowest < -0.5
    assert run.evaluate("rate(spool.y)", 1.5) > 0
    assert (run.evaluate("cord.tension", np.linspace(0.01, 1.59, 100)) > 0).all()


SWING = """
bodies: {bob: {shape: particle, mass: 1 kg}}
strings: {cord: {ends: [ground.O, bob.centre], length: 1 m}}
parameters: {v: 6 m/s}
initial: {bob.x: 0, bob.y: -1 m, rates: {bob.x: v}}
"""


@pytest.mark.parametrize("v", [5.0, 6.0, 6.8])
def test_a_bob_that_does_not_reach_the_top(v):
    """Between √(2gl) and √(5gl) the cord goes slack where v² = gl (2 + 3 sin θ), the bob flies a parabola, and the cord
    jerks taut again where the parabola r = e + u t n − ½ g t² j cuts the circle: r² − 1 = ¼ g² t³ (t − 4 u cos θ/g)."""
    run = motion(SWING, 1.5, {"rtol": 1e-11}, v=v)
    slack, taut = changes(run, "slack")[0], next(c for c in changes(run, "taut") if c.t > 0)
    sine = (v**2 / G - 2) / 3
    assert run.evaluate("bob.y", slack.t) == pytest.approx(sine, abs=1e-9)
    assert run.evaluate("speed(bob.centre)", slack.t) == pytest.approx(math.sqrt(G * sine), abs=1e-9)
    flight = 4 * math.sqrt(G * sine) * math.sqrt(1 - sine**2) / G
    assert taut.t - slack.t == pytest.approx(flight, abs=1e-9)
    flying = slack.t + flight * np.array([0.1, 0.5, 0.9])
    assert (run.evaluate("cord.tension", flying) == 0).all() and (run.evaluate("hypot(bob.x, bob.y)", flying) < 1).all()
    # The jerk takes the speed along the cord, all of it.
    u = np.array(taut.before["u"])
    q = np.array(taut.before["q"])
    assert taut.lost == pytest.approx((u @ q) ** 2 / 2, rel=1e-9)
    assert np.array(taut.after["u"]) == pytest.approx(u - (u @ q) * q, abs=1e-9)


def test_beside_a_fast_wheel_a_cord_goes_slack_all_the_same():
    """By the rate of the wheel what parts the bob from its circle at first is too slow to count: the gap tells, when it is 1e-9 of the length."""
    wheel = "{bob: {shape: particle, mass: 1 kg}, wheel: {mass: 1 kg, inertia: 1 kg*m^2}}"
    text = SWING.replace(
        "{bob: {shape: particle, mass: 1 kg}}", wheel + "\njoints: {axle: {type: hinge, of: [ground.O, wheel.origin]}}"
    )
    run = motion(text.replace("bob.x: v", "bob.x: v, axle.angle: 1e4"), 1.0, v=6.0)
    slack = changes(run, "slack")[0]
    assert run.evaluate("bob.y", slack.t) == pytest.approx((36 / G - 2) / 3, abs=0.01)
    assert [each.t for each in changes(run, "slack")] == [slack.t]


EYELET = """
gravity: none
parameters: {b: 0}
bodies: {bead: {shape: particle, mass: 1 kg}, load: {shape: particle, mass: 3 kg}}
ground: {points: {eye: [0, 0]}}
strings: {leash: {ends: [bead.centre, load.centre], over: [ground.eye]}}
initial: {bead.x: -1, bead.y: b, load.x: 0, load.y: -0.5, rates: {bead.x: 1, load.y: -LOAD}}
"""


RAIL = """
bodies: {bead: {shape: particle, mass: 1 kg}, load: {shape: particle, mass: 3 kg}}
ground: {points: {eye: [0, 0], right: [1, 0]}}
joints: {rail: {type: slot, along: [ground.eye, ground.right], point: bead.centre, coordinate: s}}
strings: {leash: {ends: [bead.centre, load.centre], over: [ground.eye]}}
initial: {s: -1, load.x: 0, load.y: -0.5, at_rest: true}
"""


def test_a_bead_drawn_through_its_eyelet_is_a_named_end():
    """Straight into the eyelet, which the load draws it to with M g/(M + m), the taut string loses its direction: the run ends there,
    with the energy that it had."""
    run = model(RAIL).simulate(until=3)
    assert run.outcome.name == "string_zero_length" and run.outcome.path == "strings.leash"
    assert run.outcome.t == pytest.approx(math.sqrt(2 / (0.75 * G)), abs=1e-8)
    assert run.evaluate("energy()", run.outcome.t) == pytest.approx(run.evaluate("energy()", 0.0), rel=1e-10)


HAULED = """
parameters: {L: 1 m, w: 1 rad/s}
gravity: GRAVITY
ground: {points: {eye: [0, L/10]}}
bodies: {load: {shape: particle, mass: 1 kg}, hook: {shape: particle, mass: 1 kg}}
joints: {rail: {type: slot, along: {through: ground.eye, angle: -90 deg}, point: hook.centre, coordinate: s}}
strings: {cable: {ends: [hook.centre, load.centre], over: [ground.eye]}}
motions: {pull: {of: s, is: L/2 + L*w*t/10}}
initial: {load.x: 0, load.y: 0, s: L/2, rates: {load.x: 0, load.y: 0}}
"""


@pytest.mark.parametrize("size", [1e-9, 1e-3, 1.0, 1e6])
@pytest.mark.parametrize("gravity", ["none", "w^2*L/10"])
def test_a_load_that_is_hauled_into_its_eyelet_is_a_named_end(gravity, size):
    """Straight along its string, which carries or only keeps up with it; the end is seen from a thousandth of the mechanism before."""
    run = model(HAULED.replace("GRAVITY", gravity), L=size).simulate(until=30)
    assert run.outcome.name == "string_zero_length" and run.outcome.path == "strings.cable"
    assert 0.95 < run.outcome.t <= 1 + 1e-8


@pytest.mark.parametrize("b", [1e-2, 1e-4])
def test_a_bead_that_passes_beside_swings_round(b):
    """However close it passes, energy and the moment of momentum about the eyelet stay."""
    run = motion(EYELET.replace("LOAD", f"{1 / math.sqrt(1 + b * b)!r}"), 1.8, {"rtol": 1e-12}, b=b)
    assert run.evaluate("energy()", 1.8) == pytest.approx(run.evaluate("energy()", 0.0), rel=1e-8)
    spin = run.evaluate("bead.x*rate(bead.y) - bead.y*rate(bead.x)", [0.0, 1.8])
    assert spin[1] == pytest.approx(spin[0], rel=1e-6)
    assert min(run["distance(ground.eye, bead.centre)"]) > 0


HOIST = """
parameters: {R: 0.1 m, w: 2 rad/s}
bodies: {drum: {shape: disk, radius: R, mass: 2 kg}, load: {shape: particle, mass: 1 kg}}
joints: {axle: {type: hinge, of: [ground.O, drum.centre], coordinate: th}}
motions: {turn: {of: th, is: w*t}}
strings: {cable: {ends: [load.centre, {drum: drum.centre, radius: R, sense: SENSE, wound: 0.5 m}]}}
initial: {load.x: R, load.y: -0.6 m, rates: {load.y: 0}}
"""


@pytest.mark.parametrize("spin", [2, -2, 20, -20])
@pytest.mark.parametrize("sense", ["ccw", "clockwise"])
def test_a_load_that_is_hauled_onto_its_drum_is_a_named_end(sense, spin):
    """Whether it swings, so that its string turns without bound as it comes to the rim, or hangs still."""
    run = model(HOIST.replace("SENSE", sense), w=spin).simulate(until=12)
    assert run.outcome.name == "string_zero_length" and run.outcome.path == "strings.cable", run.outcome
    assert "`cable` is wound up: its free length is zero" in run.outcome.sentence
    assert run.evaluate("hypot(load.x, load.y)", run.outcome.t) == pytest.approx(0.1, abs=1e-4)


UNWINDING = """
parameters: {R: 0.2 m}
bodies: {load: {shape: particle, mass: 1 kg}, drum: {shape: disk, radius: R, mass: 2 kg}}
joints: {axle: {type: hinge, of: [ground.O, drum.centre], coordinate: turn}}
strings: {cable: {ends: [load.centre, {drum: drum.centre, radius: R, sense: ccw, wound: 1 m}]LENGTH}}
initial: {load.x: -R, load.y: 0, turn: 0, at_rest: true}
"""


def test_a_string_without_free_length_is_as_long_as_what_is_wound():
    """The load hangs at the rim, with all of the string on the drum: it falls with g/2 beside a disk of twice its mass, whether the
    length is given or not."""
    runs = [motion(UNWINDING.replace("LENGTH", length), 0.3) for length in ("", ", length: 1 m")]
    for run in runs:
        assert run.evaluate("load.y", 0.3) == pytest.approx(-G / 4 * 0.09, abs=1e-9)
        assert [kind for kind, _ in kinds(run)].count("taut") <= 1
    assert abs(runs[1].evaluate("cable.gap", 0.0)) < 1e-15


def test_an_elastic_cord_of_no_length_pulls_like_a_spring_to_its_hole():
    """Straight through the hole and back: x = x₀ cos ωt. A rigid one of no length is refused."""
    text = """
freebody: 1
gravity: none
bodies: {bob: {shape: particle, mass: 2 kg}}
joints: {plane: {type: free, of: [ground.O, bob.centre], coordinates: [x, y]}}
strings: {cord: {ends: [bob.centre, ground.O], length: 0, stiffness: 8 N/m}}
initial: {x: 0.5 m, y: 0.2 m, at_rest: true}
"""
    run = fb.Mechanism.loads(text).simulate(until=2.5, rtol=1e-12)
    times = [0.4, 1.2, 2.5]
    assert run.evaluate("x", times) == pytest.approx([0.5 * math.cos(2 * t) for t in times], abs=1e-9)
    with pytest.raises(fb.ModelFileError, match="0 stands where a positive length is needed"):
        fb.Mechanism.loads(text.replace(", stiffness: 8 N/m", "")).simulate(until=0.1)


PEG = """
bodies: {bob: {shape: particle, mass: 1 kg}}
ground: {points: {peg: [0, PEG]}}
joints: {free: {type: free, of: [ground.O, bob.centre], coordinates: [x, y]}}
strings: {long: {ends: [ground.O, bob.centre], length: 1 m}STRINGS}
initial: {x: 0, y: -1, rates: {x: SPEED, y: 0}}
"""
"""A bob on a string of 1 m; on another from a peg below, the first is just taut where the bob is lowest."""


@pytest.mark.parametrize("rtol", [1e-3, 1e-6, 1e-8, 1e-10, 1e-13])
@pytest.mark.parametrize("peg", [-0.3, -0.5, -0.8])
def test_a_string_that_is_just_taut_beside_another_takes_no_speed(peg, rtol):
    text = PEG.replace("STRINGS", f", short: {{ends: [ground.peg, bob.centre], length: {1 + peg}}}").replace("SPEED", "1.3")
    run = model(text.replace("PEG", str(peg))).simulate(until=6, rtol=rtol)
    assert run.outcome.ok and all(change.lost < 1e-6 for change in run.changes)
    energy = run.energy["kinetic"] + run.energy["potential"]
    assert np.ptp(energy) < 100 * rtol * 9.81


@pytest.mark.parametrize("rtol", [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13])
def test_a_string_whose_tension_just_vanishes_stays_taut(rtol):
    """At √(5 g l) below, a bob comes to the top with no tension."""
    text = PEG.replace("STRINGS", "").replace("SPEED", repr(math.sqrt(5 * 9.81))).replace("PEG", "0")
    run = model(text).simulate(until=3, rtol=rtol)
    assert run.outcome.ok and not [change for change in run.changes if change.kind == "slack"]
