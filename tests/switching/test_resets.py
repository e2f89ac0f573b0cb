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
events: {{go: {{at: 0.5 s, then: {{{then}}}}}}}
run: {{until: 1}}
"""


def test_a_drive_does_the_work_of_holding_its_rate_in_a_reset():
    """Impulse m w at b, and its opposite at a, that the drive balances at its speed v: work m w v, of which ½ m w² comes from
    what resets."""
    run = motion(CARRIER.format(then="reset: {'z - x': 1.5 m/s}"), 1)
    [reset] = changes(run, "reset")
    assert reset.lost == pytest.approx(-0.5 * 2 * 1.5**2, rel=1e-12)
    assert run.energy.works["pull"][-1] == pytest.approx(2 * 1.5 * 4, rel=1e-9)
    assert run.evaluate("rate(z)", 1.0) == pytest.approx(5.5, rel=1e-12) and imbalance(run) < 1e-12


@pytest.mark.parametrize(("then", "name"), [("lock: x", "lock x"), ("reset: {x: 1 m/s}", "x")])
def test_what_contradicts_a_motion_is_named(then, name):
    run = model(CARRIER.format(then=then)).simulate()
    assert run.outcome.name.value == "inconsistent_velocities" and run.edges[-1] == pytest.approx(0.5)
    assert name in run.outcome.sentence and "contradict" in run.outcome.sentence


@pytest.mark.parametrize(("until", "left"), [(2.0, False), (2.5, True)])
def test_a_table_that_is_left_is_named(until, left):
    text = CARRIER.replace('"v*t"', "ramp(t)").format(then="reset: {h: 1 m/s}")
    table = "tables: {ramp: {x: [0 s, 1 s, 2 s], y: [0 m, 2 m, 3 m], interpolation: pchip}}\n"
    run = model(text + table).simulate(until=until)
    assert run.outcome.ok and ("the table `ramp` was left, from t = 2.0" in run.outcome.sentence) == left


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
