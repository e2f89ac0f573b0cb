"""What happens where a run ends, and in one that goes on from there, is the same at every tolerance, or the run says that it may not be."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from seen import model
from store import every

from freebody.run.simulation import simulate

TOLERANCES = (1e-3, 1e-5, 1e-7, 1e-8, 1e-9, 1e-11, 1e-13)
CLEAR = 100.0
"""Tolerances of a motion by which its end and an event are apart clearly."""
UNRESOLVED = "whether `e` comes before the end of the run"

SPRING = """
gravity: none
bodies: {{b: {{shape: particle, mass: 1}}}}
parameters: {{n: 0}}
forces: {{k: {{type: force, at: b.centre, x: "-b.x*(1 N/m)", y: 0}}}}
initial: {{b.x: 1 m, b.y: 0, rates: {{b.x: 0, b.y: 0}}}}
events: {{e: {{when: b.x + 0.5 m, direction: falling, then: {then}}}}}
"""
FALL = """
gravity: 10
bodies: {{b: {{shape: particle, mass: 1}}}}
parameters: {{n: 0}}
initial: {{b.x: 0, b.y: 5 m, at_rest: true}}
events: {{e: {{when: b.y, direction: falling, then: {then}}}}}
"""
TURN = """
gravity: none
bodies: {{b: {{shape: rod, length: 1 m, mass: 1}}}}
joints: {{O: {{type: hinge, of: [ground.O, b.start], coordinate: th}}}}
parameters: {{n: 0}}
initial: {{th: 0, rates: {{th: 2}}}}
events: {{e: {{when: th - 3, direction: rising, then: {then}}}}}
"""
MOTIONS = {"spring": (SPRING, 2 * np.pi / 3), "fall": (FALL, 1.0), "turn": (TURN, 1.5)}
"""Each with when its event comes, s; it comes once within twice that time."""
ACTIONS = ("stop", "{set: {n: n + 1}}", "[{set: {n: n + 1}}, stop]", "record")
APART = (0.0, *(sign * 10.0**-digits for digits in (2, 4, 6, 8, 10) for sign in (1, -1)))
ENDS = {f"{name} {then} {apart}": (name, then, apart) for name in MOTIONS for then in ACTIONS for apart in APART}


@every(ENDS, "case", share=12)
def test_an_event_about_the_end_comes_once_in_two_runs_and_before_the_end_at_every_tolerance_or_is_said_to(case):
    name, then, apart = ENDS[case]
    text, instant = MOTIONS[name]
    mechanism, end = model(text.format(then=then)), instant * (1 + apart)
    for rtol in TOLERANCES:
        first = mechanism.simulate(until=end, rtol=rtol)
        whole = [*first.events, *first.continue_(until=2 * instant).events]
        assert [event.name for event in whole] == ["e"], rtol
        assert whole[0].t == pytest.approx(instant, abs=CLEAR * rtol)
        if UNRESOLVED in first.outcome.sentence:
            assert abs(apart) < CLEAR * rtol
        else:
            assert bool(first.events) is (apart > 0), rtol
            assert apart


@pytest.mark.parametrize("late", range(-3, 4))
@pytest.mark.parametrize("then", ACTIONS)
def test_an_event_at_a_given_time_by_round_off_from_the_end_comes_once(late, then):
    """Time itself is known to round-off: what is nearer to the end is on it, and no run says that it is not sure."""
    mechanism = model(FALL.format(then=then).replace("when: b.y, direction: falling", "at: 0.3 s"))
    until = 0.3 + late * np.spacing(0.3)
    for rtol in TOLERANCES:
        first = mechanism.simulate(until=until, rtol=rtol)
        then_on = first.continue_(until=0.5)
        assert len(first.events) + len(then_on.events) == 1
        assert UNRESOLVED not in first.outcome.sentence + then_on.outcome.sentence
        assert late or first.events


def test_what_goes_on_from_another_state_than_the_end_sees_its_events():
    """Where a run has stopped at an event, a start that is put back before it comes to it again."""
    mechanism = model(FALL.format(then="stop"))
    first = mechanism.simulate(until=2.0)
    back = replace(first.end, q=np.array([0.0, 5.0]), u=np.zeros(2))
    again = simulate(first.source, back, replace(first.settings, until=4.0))
    assert [event.t for event in again.events] == [pytest.approx(first.end.t + 1.0, abs=1e-9)]


JUMPS = {
    "mod": ("mod(b.x, 0.5 m) - 0.1 m", [0.1, 0.5, 0.6, 1.0, 1.1, 1.5, 1.6, 2.0]),
    "sign": ("sign(b.x - 0.7 m)", [0.7]),
    "if": ("if(b.x > 1.3 m, 1, if(b.x > 0.4 m, -2, 3))", [0.4, 1.3]),
    "steps": ("if(mod(b.x, 1 m) > 0.25 m, 2, -1)", [0.25, 1.0, 1.25, 2.0]),
}
"""Functions that change their sign by a jump too, and where they do for x from 0 to 2.05 m."""


@pytest.mark.parametrize("then", ["record", "{set: {n: n + 1}}", "{reset: {b.y: 1 m/s}}"])
@pytest.mark.parametrize("name", JUMPS)
def test_a_jump_past_zero_is_one_event_where_it_is(name, then):
    """x = t + t²/10: nothing is corrected by a slope where there is no zero."""
    when, places = JUMPS[name]
    known, counts = [np.sqrt(25 + 10 * x) - 5 for x in places], "n + 1" in then
    mechanism = model(f"""
gravity: none
bodies: {{b: {{shape: particle, mass: 1}}}}
parameters: {{n: 0}}
forces: {{k: {{type: force, at: b.centre, x: 0.2 N, y: 0}}}}
initial: {{b.x: 0, b.y: 0, rates: {{b.x: 1 m/s, b.y: 0}}}}
events: {{e: {{when: "{when}", then: {then}}}}}
""")
    for rtol in TOLERANCES:
        run = mechanism.simulate(until=np.sqrt(25 + 10 * 2.05) - 5, rtol=rtol)
        assert run.outcome.sentence == "the end time was reached", rtol
        assert [event.t for event in run.events] == pytest.approx(known, abs=10 * rtol + 1e-12)
        assert run.end.p[0] == counts * len(known)


TOUCHES = ("hypot(b.x - 1 m, b.y) - 0.5 m", "abs(b.x - 1 m)", "sqrt((b.x - 1 m)^2 + b.y^2) - b.y", "1 - cos(b.x*(1 rad/m) - 1)")


@pytest.mark.parametrize("push", [0.0, 0.2, 3.0])
@pytest.mark.parametrize("when", TOUCHES)
def test_what_touches_zero_without_a_polynomial_that_follows_it_is_one_touch(when, push):
    """At x = 1 m, which x = t + a t²/2 is once; the time of an extremum is known to the root of the tolerance."""
    mechanism = model(f"""
gravity: none
bodies: {{b: {{shape: particle, mass: 1}}}}
forces: {{k: {{type: force, at: b.centre, x: {push} N, y: 0}}}}
initial: {{b.x: 0, b.y: 0.5 m, rates: {{b.x: 1 m/s, b.y: 0}}}}
events: {{e: {{when: "{when}"}}}}
run: {{until: 1.8}}
""")
    known = (np.sqrt(1 + 2 * push) - 1) / push if push else 1.0
    for rtol in TOLERANCES:
        events = mechanism.simulate(rtol=rtol).events
        assert [(event.kind, event.t) for event in events] == [("touch", pytest.approx(known, abs=10 * np.sqrt(rtol)))], rtol


RELAYS = {
    "dry friction": ("forces.s", "forces: {s: {type: force, at: b.centre, x: '-sign(rate(b.x))*(1 N)', y: 0}}"),
    "relay": ("forces.s", "forces: {s: {type: force, at: b.centre, x: '-sign(b.x + rate(b.x)*(1 s))*(1 N)', y: 0}}"),
    "cases": (
        "forces.s",
        "forces: {s: {type: force, at: b.centre, x: 'if(b.x + 0.3*rate(b.x)*(1 s) > 0.2 m, -1 N, 1 N)', y: 0}}",
    ),
    "state": ("states.z", "states: {z: {start: 1, rate: '-sign(z)*(1/s)'}}"),
    "pushed": ("states.z", "states: {z: {start: 1, rate: '(0.5*sin(t/(1 s)) - sign(z))*(1/s)'}}"),
}


@pytest.mark.parametrize("name", RELAYS)
def test_a_law_that_jumps_to_and_fro_is_named_at_every_tolerance(name):
    path, laws = RELAYS[name]
    mechanism = model(f"""
gravity: none
bodies: {{b: {{shape: particle, mass: 1}}}}
{laws}
initial: {{b.x: 1 m, b.y: 0, rates: {{b.x: 1 m/s, b.y: 0}}}}
run: {{until: 9}}
""")
    ends = [mechanism.simulate(rtol=rtol).outcome for rtol in TOLERANCES]
    assert {(end.name, end.path) for end in ends} == {("Chatter", path)}
    word, _, own = path.partition(".")
    assert all(f"the law of the {word[:-1]} `{own}`" in end.sentence and "`friction`" in end.sentence for end in ends)
    assert [end.t for end in ends] == pytest.approx([ends[-1].t] * len(ends), abs=1e-2)


@pytest.mark.parametrize(("angle", "is_behind"), [(-90, False), (90, True)])
def test_a_line_that_goes_the_wrong_way_round_is_told(angle, is_behind):
    """The top of a ladder is just on the wall, on either side of which no gap tells that the ladder is."""
    made = model(f"""
parameters: {{l: 4 m, start: 70 deg}}
ground: {{lines: {{floor: {{through: O, angle: 0}}, wall: {{through: O, angle: {angle} deg}}}}}}
bodies: {{ladder: {{shape: rod, length: l, mass: 10 kg, points: {{A: start, B: end}}}}}}
contacts: {{floor: {{of: [ladder.A, ground.floor]}}, wall: {{of: [ladder.B, ground.wall]}}}}
initial: {{points: {{ladder.A: [l*cos(start), 0], ladder.B: [0, l*sin(start)]}}, at_rest: true}}
""")
    _, notes = made.start()
    assert any("wall: `ladder` touches the line, and its mass centre is behind it" in note for note in notes) is is_behind


FALLING = """
ground: {points: {P: [1, 0]}, lines: {floor: LINE}}
bodies: {rod: {shape: rod, length: 4 m, mass: 10 kg, points: {A: start, B: end}}, ball: {shape: disk, radius: 0.1 m, mass: 1 kg}}
contacts: {heel: {of: [rod.A, ground.floor], rough: true}, roll: {of: [ball, ground.floor]} MORE}
initial: {points: {rod.A: [0, 0], rod.B: [2*sqrt(3), UP], ball.centre: [6 m, 0.1 m]}, at_rest: true}
run: {until: 1.5}
"""


@pytest.mark.parametrize("line", ["{through: O, angle: 0}", "[O, P]", "{through: P, angle: 720 deg}"])
@pytest.mark.parametrize(
    ("more", "up", "said"),
    [
        ("", "2", "passes, at t = "),
        ("", "-2", "starts behind the line of the contact `heel`"),
        (", toe: {of: [rod.B, ground.floor]}", "2", None),
        (", middle: {of: [{centre: rod.A, radius: 0.3 m}, ground.floor], engaged: false}", "2", "passes, at t = "),
        (", toe: {of: [{centre: rod.B, radius: 1 mm}, ground.floor]}", "2", None),
    ],
)
def test_a_point_that_goes_through_a_line_without_a_contact_is_told(line, more, up, said):
    """A rod falls about its heel; energy 1/3 l ω² = g (sin 30° − sin θ) says how long until its end is at the floor."""
    done = model(FALLING.replace("LINE", line).replace("MORE", more).replace("UP", up)).simulate()
    assert len(done.passages) == (said is not None) and all(said in each and "`rod.B`" in each for each in done.passages)
    if said and "t =" in said:
        when = quad(lambda s: 1 / math.sqrt(3 * 9.81 / 4 * (0.5 - math.sin(s))), 0, math.pi / 6)[0]
        assert float(done.passages[0].split("t = ")[1].split()[0]) == pytest.approx(when, rel=1e-3)
