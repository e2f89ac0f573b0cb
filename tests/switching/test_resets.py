"""Rates that are given at once to driven mechanisms, what contradicts a motion, and tables that are left."""

import pytest
from seen import changes, imbalance, model, motion

CARRIER = """
gravity: none
parameters: {{v: 4 m/s}}
bodies: {{a: {{shape: particle, mass: 3}}, b: {{shape: particle, mass: 2}}}}
joints:
  A: {{type: free, of: [ground.O, a.centre], coordinates: [x, h]}}
  B: {{type: free, of: [ground.O, b.centre], coordinates: [z, k]}}
motions: {{pull: {{of: x, is: "v*t"}}}}
initial: {{z: 1, h: 0, k: 0, rates: {{z: 4, h: 0, k: 0}}}}
{events}
run: {{until: 1}}
"""
GO = "events: {{go: {{at: 0.5 s, then: {{{then}}}}}}}"


def test_a_drive_does_the_work_of_holding_its_rate_in_a_reset():
    """Impulse m w at b, and its opposite at a, that the drive balances at its speed v: work m w v, of which ½ m w² comes from
    what resets."""
    run = motion(CARRIER.format(events=GO.format(then="reset: {'z - x': 1.5 m/s}")), 1)
    [reset] = changes(run, "reset")
    assert reset.lost == pytest.approx(-0.5 * 2 * 1.5**2, rel=1e-12)
    assert run.energy.works["pull"][-1] == pytest.approx(2 * 1.5 * 4, rel=1e-9)
    assert run.evaluate("rate(z)", 1.0) == pytest.approx(5.5, rel=1e-12) and imbalance(run) < 1e-12


@pytest.mark.parametrize(
    ("then", "names", "others"),
    [
        ("lock: x", ["pull", "lock x"], []),
        ("reset: {x: 1 m/s}", ["pull", "rate of x"], []),
        ("reset: {x - z: 1 m/s, z: 1 m/s}", ["pull", "rate of x - z", "rate of z"], []),
        ("reset: {x - z: 1 m/s, z: 1 m/s, h: 1 m/s}", ["pull", "rate of x - z", "rate of z"], ["rate of h"]),
        ("lock: [x, z, k]", ["pull", "lock x"], ["lock z", "lock k"]),
    ],
)
def test_all_that_contradict_each_other_are_named_and_nothing_else(then, names, others):
    run = model(CARRIER.format(events=GO.format(then=then))).simulate()
    assert run.outcome.name.value == "inconsistent_velocities" and run.edges[-1] == pytest.approx(0.5)
    assert all(f"{name} is off by" in run.outcome.sentence for name in names), run.outcome.sentence
    assert not any(f"{name} is off" in run.outcome.sentence for name in others)


@pytest.mark.parametrize(("until", "left"), [(2.0, False), (2.5, True)])
def test_a_table_that_is_left_is_named(until, left):
    text = CARRIER.replace('"v*t"', "ramp(t)").format(events=GO.format(then="reset: {h: 1 m/s}"))
    table = "tables: {ramp: {x: [0 s, 1 s, 2 s], y: [0 m, 2 m, 3 m], interpolation: pchip}}\n"
    run = model(text + table).simulate(until=until)
    assert run.outcome.ok and ("the table `ramp` was left, from t = 2.0" in run.outcome.sentence) == left


READERS = {
    "report: {height: {max: ramp(t)}}": None,
    "events: {late: {when: ramp(t) - 9 m}}": None,
    "events: {late: {when: h - 9 m, if: ramp(t) > 1 m, then: {lock: h}}}": None,
    "events: {late: {at: 0.7 s, then: {set: {v: ramp(t)/(1 s)}}}}": 0.7,
    "events: {late: {at: 0.7 s, then: {reset: {h: ramp(t)/(1 s)}}}}": 0.7,
}
"""Where nothing but this reads a table; when, s, if not all along."""


@pytest.mark.parametrize("reader", READERS)
@pytest.mark.parametrize("end", [0.6, 0.8, 2.0])
def test_a_table_that_no_law_reads_is_named_where_it_is_left(reader, end):
    read = READERS[reader]
    table = f"tables: {{ramp: {{x: [0 s, {end} s], y: [0 m, 2 m]}}}}\n"
    run = model(CARRIER.format(events=reader) + table).simulate()
    assert run.outcome.ok and ("`ramp` was left" in run.outcome.sentence) == ((read or 1) > end)
    assert "left" not in run.outcome.sentence or f"from t = {read or end}" in run.outcome.sentence


CAM = """
parameters: {r0: 30 mm, rr: 8 mm}
tables: {lift: {x: [0, 1, 2, 3], y: [0, 3 mm, 9 mm, 9 mm], interpolation: pchip}}
bodies:
  cam: {mass: 0.5, inertia: 2e-4, curves: {profile: {x: (r0 + lift(s))*cos(s), y: -(r0 + lift(s))*sin(s)}}}
  roller: {shape: disk, radius: rr, mass: 0.02}
joints:
  shaft: {type: hinge, of: [ground.O, cam.origin], coordinate: theta}
  guide: {type: slider, along: {through: ground.O, angle: 90 deg}, line: {through: roller.centre, angle: 90 deg}, coordinate: y}
  touch: {type: cam, along: cam.profile, follower: {centre: roller.centre, radius: rr}}
motions: {motor: {of: theta, is: -t}}
initial: {theta: 0, guess: {y: 40 mm, touch.s: START}}
"""


@pytest.mark.parametrize(("start", "until", "left"), [(-1.57, 1, 0.0), (-1.57, 2, 0.0), (4.71, 2, 0.0)])
def test_a_table_of_a_curve_that_is_left_is_named(start, until, left):
    """The roller above the cam, at s = −90° or 270°, where the table has no points."""
    run = model(CAM.replace("START", str(start))).simulate(until=until)
    assert run.outcome.ok and f"the table `lift` was left, from t = {left:.6f} s on" in run.outcome.sentence
    assert run.outcome.sentence.count("`lift`") == 1


def test_what_stands_on_a_floor_may_be_thrown_off_it():
    run = motion(
        """
bodies: {b: {shape: particle, mass: 2}}
joints: {B: {type: free, of: [ground.O, b.centre], coordinates: [z, k]}}
ground: {lines: {floor: {through: O, angle: 0}}}
contacts: {c: {of: [b.centre, ground.floor], friction: 0.3}}
initial: {z: 0, k: 0, at_rest: true}
events: {go: {at: 0.5 s, then: {reset: {k: 3 m/s}}}}
""",
        0.7,
    )
    assert run.evaluate("k", 0.7) == pytest.approx(3 * 0.2 - 9.81 / 2 * 0.2**2, rel=1e-9)
