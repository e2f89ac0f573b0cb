"""Which events a run tells: those of its start, those of its end, and what a reset sets."""

from __future__ import annotations

import pytest
from seen import changes, kinds, model

FALL = """
gravity: 10
bodies: {ball: {shape: particle, mass: 1}}
initial: {ball.x: 0, ball.y: 1, at_rest: true}
events:
  level: {when: ball.x - 0.5}
  clock: {at: 0.5 s, then: {reset: {ball.x: 1 m/s}}}
"""


def test_an_event_at_the_end_belongs_to_the_run_that_ends_there():
    """One motion in two runs tells the same events, each once, as in one; what the event does is done."""
    whole = model(FALL).simulate(until=1.5)
    first = model(FALL).simulate(until=0.5)
    then = first.continue_(until=1.5)
    stated = [(event.name, event.t) for event in whole.events]
    assert stated == [("clock", 0.5), ("level", pytest.approx(1.0, abs=1e-12))]
    assert [(event.name, event.t) for run in (first, then) for event in run.events] == stated
    assert first.end.u[0] == 1 and first["rate(ball.x)"][-1] == 1
    assert then.evaluate("ball.x", 1.5) == pytest.approx(1.0, abs=1e-12)
    assert abs(first.energy.balance).max() < 1e-12 and first.energy["impacts"][-1] == pytest.approx(0.5)


def test_a_reset_tells_what_it_sets():
    run = model(FALL).simulate(until=1.0)
    assert kinds(run) == [("reset", ("ball.x",))]


HANGING = """
bodies: {bob: {shape: particle, mass: 2 kg}}
strings: {cord: {ends: [ground.O, bob.centre]}}
parameters: {cut_it: 1}
initial: {bob.x: 0, bob.y: -1, at_rest: true}
events:
  snip: {at: start, if: cut_it > 0, then: {cut: cord}}
  fallen: {when: bob.y + 2, then: record}
report: {fall: bob.y @ snip, pull: tension(cord) @ before snip}
"""


def test_events_of_the_start_are_reported():
    run = model(HANGING).simulate(until=1.0)
    assert [(event.name, event.t, event.kind) for event in run.events][:1] == [("snip", 0.0, "start")]
    assert run.report["fall"].value == -1 and run.report["pull"].value == pytest.approx(2 * 9.81)
    later = run.continue_(until=1.2)
    assert [event.name for event in later.events] == []


def test_an_event_of_the_start_keeps_its_condition():
    run = model(HANGING, cut_it=0).simulate(until=1.0)
    assert run.events == [] and [c.kind for c in changes(run)] == ["taut"]
    assert run.evaluate("bob.y", 1.0) == pytest.approx(-1, abs=1e-12)
    assert run.report["fall"].note == "snip did not happen"
