"""The integrator ``taylor``: the motions of other integrators, in fewer steps, and refusals where it has no series."""

import pytest

import freebody as fb

BARS = """
freebody: 1
gravity: 9.81 m/s^2
parameters: {k: 40, pull: 0}
bodies: {one: {shape: rod, mass: 1, length: 1}, two: {shape: rod, mass: 2, length: 0.7}}
joints:
  a: {type: hinge, of: [ground.O, one.start], coordinate: p}
  b: {type: hinge, of: [one.end, two.start], coordinate: q}
initial: {p: 0.3, q: -1.1, at_rest: true}
run: {until: 5}
"""
FREE = """
freebody: 1
bodies: {plate: {shape: disk, mass: 1, radius: 0.2}}
joints: {go: {type: free, of: [ground.O, plate.centre], coordinates: [x, y, turn]}}
forces: {hold: {type: spring, between: [ground.O, plate.centre], stiffness: 3, rest_length: 0}}
initial: {x: 1, y: 0.2, rates: {x: 0, y: 1.5, turn: 2}}
run: {until: 5}
"""
LAWS = {
    "gravity alone": "",
    "spring, damper": "{s: {type: spring, between: [ground.O, two.end], stiffness: k, rest_length: 0.5}, "
    "d: {type: damper, between: [ground.O, two.end], damping: 0.4}}",
    "laws of time and rate": "{m: {type: torque, on: one, value: '2*exp(-0.3*t)*sin(3*t) - 0.1*rate(p)^3/sqrt(1 + rate(p)^2)'}}",
}


def both(text, rtol=1e-11):
    times = [0.25 * i for i in range(21)]
    runs = [fb.Mechanism.loads(text).simulate(rtol=rtol, method=method, t_eval=times) for method in ("dop853", "taylor")]
    assert all(run.outcome.ok for run in runs)
    return runs


@pytest.mark.parametrize("laws", LAWS.values(), ids=LAWS.keys())
def test_it_has_the_motion_of_dop853_in_a_third_of_the_steps(laws):
    other, run = both(BARS + (f"forces: {laws}\n" if laws else ""))
    for quantity in ("p", "q", "rate(p)", "rate(q)", "energy()"):
        assert run[quantity] == pytest.approx(other[quantity], abs=1e-7), quantity
    assert run.stats["accepted"] < other.stats["accepted"] / 3
    assert run.stats["rejected"] == 0


def test_it_carries_joints_of_any_freedom():
    other, run = both(FREE)
    for quantity in ("x", "y", "turn", "energy()"):
        assert run[quantity] == pytest.approx(other[quantity], abs=1e-7), quantity


def test_events_are_met_on_the_series_and_what_they_set_holds():
    text = BARS + "forces: {m: {type: torque, on: one, value: pull}}\n"
    text += "events: {low: {when: p + 1.2, then: {set: {pull: 3}}}}\n"
    other, run = both(text)
    assert [event.t for event in run.events] == pytest.approx([event.t for event in other.events], abs=1e-9)
    assert len(run.events) > 0
    assert run["p"] == pytest.approx(other["p"], abs=1e-7)


WITHOUT_SERIES = {
    "there are contacts, stops": "stops: {stop: {of: q, most: 1}}",
    "a law switches": "forces: {m: {type: torque, on: one, value: 'sign(p) * 1 N*m'}}",
    "prescribed": "motions: {motor: {of: p, is: 0.3 + t^3}}",
}


def test_a_loop_is_refused():
    bar = BARS.replace("  a: {", "  c: {type: link, of: [two.end, ground.O], length: 1.2}\n  a: {").replace(", q: -1.1", "")
    outcome = fb.Mechanism.loads(bar).simulate(method="taylor").outcome
    assert "joints close a loop" in outcome.sentence


@pytest.mark.parametrize(("why", "more"), WITHOUT_SERIES.items())
def test_what_has_no_series_is_refused_by_name_with_the_way_out(why, more):
    outcome = fb.Mechanism.loads(f"{BARS}{more}\n").simulate(method="taylor").outcome
    assert not outcome.ok
    assert why in outcome.sentence
    assert "dop853" in outcome.sentence
