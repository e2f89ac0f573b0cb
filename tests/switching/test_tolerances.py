"""What switches, and in which order, does not depend on the tolerance at which a motion is followed."""

from collections import defaultdict
from collections.abc import Callable

import numpy as np
import pytest
from random_models import switching
from seen import kinds
from seen import model as loaded
from store import every

import freebody as fb

TOLERANCES = np.logspace(-5, -13, 17)

CLEARANCE = """
parameters: {{l1: 0.153 m, l2: 0.306 m, a: 0.05 m, b: 0.025 m, c: {clearance} m}}
ground: {{points: {{U: [0, b + c], D: [0, -b - c]}}, lines: {{floor: {{through: D, angle: 0}}, roof: {{through: U, angle: 180 deg}}}}}}
bodies:
  crank: {{shape: rod, length: l1, mass: 0.038, inertia: 7.4e-5}}
  rod: {{shape: rod, length: l2, mass: 0.038, inertia: 5.9e-4}}
  slider: {{mass: 0.076, inertia: 2.7e-6, points: {{c1: [-a, b], c2: [a, b], c3: [-a, -b], c4: [a, -b]}}}}
joints:
  O: {{type: hinge, of: [ground.O, crank.start], coordinate: th1}}
  A: {{type: hinge, of: [crank.end, rod.start], coordinate: {{name: th2, absolute: true}}}}
  B: {{type: hinge, of: [rod.end, slider.origin], coordinate: {{name: th3, absolute: true}}}}
contacts:
  c1: {{of: [slider.c1, ground.roof], restitution: {restitution}, friction: {friction}}}
  c2: {{of: [slider.c2, ground.roof], restitution: {restitution}, friction: {friction}}}
  c3: {{of: [slider.c3, ground.floor], restitution: {restitution}, friction: {friction}}}
  c4: {{of: [slider.c4, ground.floor], restitution: {restitution}, friction: {friction}}}
initial: {{th1: 0, th2: 0, th3: 0, rates: {{th1: 150, th2: -75, th3: -0.01}}}}
run: {{until: 0.1, impacts: newton}}
"""
"""A slider-crank whose slider has clearance (Flores, Leine, Glocker 2010, *Multibody System Dynamics* 23): its corners lift off
together, and bounce without end."""

SLOT = """
parameters: {{b: 0.02 m, c: {clearance} m, tilt: {tilt} deg}}
ground: {{points: {{U: [0, b + c], D: [0, -b - c]}}, lines: {{low: {{through: D, angle: 0}}, high: {{through: U, angle: 180 deg}}}}}}
bodies:
  block: {{mass: 0.5, inertia: 2e-4, points: {{p1: [-0.04, -b], p2: [0.04, -b], p3: [-0.04, b], p4: [0.04, b]}}}}
gravity: [9.81*sin(tilt), -9.81*cos(tilt)]
joints: {{J: {{type: free, of: [ground.O, block.origin], coordinates: [x, y, th]}}}}
forces: {{shake: {{type: force, at: block.p2, x: 0, y: "12*sin(40*t)"}}}}
contacts:
  p1: {{of: [block.p1, ground.low], restitution: {restitution}, friction: 0.1}}
  p2: {{of: [block.p2, ground.low], restitution: {restitution}, friction: 0.1}}
  p3: {{of: [block.p3, ground.high], restitution: {restitution}, friction: 0.1}}
  p4: {{of: [block.p4, ground.high], restitution: {restitution}, friction: 0.1}}
initial: {{x: 0, y: -c, th: 0, at_rest: true}}
run: {{until: 0.5, impacts: newton}}
"""
"""A block in a straight slot of some play, that a force at one of its corners rocks."""

FAMILY = {
    **{
        f"clearance {size} of {restitution} and {friction}": CLEARANCE.format(
            clearance=size, restitution=restitution, friction=friction
        )
        for size in (0.0003, 0.001, 0.003, 0.01)
        for restitution, friction in ((0.0, 0.0), (0.4, 0.01), (0.7, 0.2))
    },
    **{
        f"slot {size} at {tilt}°, {restitution}": SLOT.format(clearance=size, tilt=tilt, restitution=restitution)
        for size in (0.0001, 0.001)
        for tilt in (0, 20)
        for restitution in (0.0, 0.3)
    },
}


@every(FAMILY, share=5)
def test_the_sequence_of_mode_changes_does_not_depend_on_the_tolerance(model):
    mechanism = loaded(FAMILY[model])
    runs = [mechanism.simulate(rtol=float(rtol)) for rtol in TOLERANCES]
    assert all(run.outcome.ok for run in runs), [run.outcome.sentence for run in runs]
    assert {tuple(kinds(run)) for run in runs} == {tuple(kinds(runs[-1]))}
    assert len(kinds(runs[-1])) > 3


NEAR_MISS = {
    "spring": """
gravity: none
parameters: {{c: {level}, k: 1 N/m}}
bodies: {{a: {{shape: particle, mass: 1}}, b: {{shape: particle, mass: 1}}}}
joints:
  A: {{type: free, of: [ground.O, a.centre], coordinates: [x, y]}}
  B: {{type: free, of: [a.centre, b.centre], coordinates: [z, w]}}
forces: {{s: {{type: spring, along: x, stiffness: k}}}}
initial: {{x: 1 m, y: 0, z: 0, w: 0, rates: {{x: 0, y: 0.1 m/s, z: 0.2 m/s, w: 0}}}}
events: {{e: {{when: "x + c*(1 m)", direction: any, then: {then}}}}}
run: {{until: 8 s}}
""",
    "pendulum": """
parameters: {{l: 1 m, c: {level}}}
bodies: {{b: {{shape: particle, mass: 1}}, d: {{shape: particle, mass: 1}}}}
joints:
  A: {{type: polar, of: [ground.O, b.centre], coordinates: [r, phi]}}
  B: {{type: free, of: [ground.O, d.centre], coordinates: [z, w]}}
motions: {{length: {{of: r, is: l}}}}
initial: {{phi: -30 deg, z: 0, w: 0, rates: {{phi: 0, z: 1, w: 0}}}}
events: {{e: {{when: "y(b.centre) + c*(0.5 m)", direction: any, then: {then}}}}}
run: {{until: 4 s}}
""",
}
"""The spring comes to −c at t = π; the pendulum comes back to the height of its start at c = 1, which it leaves at once."""
ACTIONS = ("stop", "{lock: w}", "{reset: {w: 1 m/s}}", "{release: B}", "{set: {c: 3}}")
MISSES = [0.0, *(sign * 10.0**-digits for digits in range(3, 10) for sign in (1, -1))]
GRAZING = {f"{name} {then} {miss}": (name, then, miss) for name in NEAR_MISS for then in ACTIONS for miss in MISSES}
UNRESOLVED = "is not resolved at this rtol"
CLEAR = 100.0
"""Tolerances of a motion by which a level is missed, or two events are apart, clearly."""


def resolved(mechanism: fb.Mechanism, apart: float, seen: Callable[[fb.Run], object]) -> list[bool]:
    """Whether runs at every tolerance know what is ``seen``; those that do see the same, and all know what is clearly ``apart``."""
    runs = [mechanism.simulate(rtol=float(rtol)) for rtol in TOLERANCES]
    known = [UNRESOLVED not in run.outcome.sentence for run in runs]
    told = [seen(run) for run, sure in zip(runs, known, strict=True) if sure]
    assert all(each == told[-1] for each in told)
    assert all(sure for sure, rtol in zip(known, TOLERANCES, strict=True) if CLEAR * rtol <= apart)
    return known


@every(GRAZING, "case", share=40)
def test_what_an_event_does_that_nearly_misses_its_level_does_not_depend_on_the_tolerance_or_is_said_to(case):
    name, then, miss = GRAZING[case]
    mechanism = loaded(NEAR_MISS[name].format(level=1 + miss, then=then))

    def seen(run: fb.Run) -> object:
        # An exact touch never acts, but a loose tolerance may pass by it unseen.
        return run.outcome.name, kinds(run), [event.kind for event in run.events if miss or event.kind != "touch"]

    known = resolved(mechanism, abs(miss), seen)
    comes_back = name == "spring" or miss < 0 or not then.startswith(("stop", "{set"))
    assert abs(miss) >= TOLERANCES[0] or known[0] is not comes_back


ORDER = """
gravity: none
parameters: {{level: {level!r} m, first: 0, k: 1 N/m}}
bodies: {{a: {{shape: particle, mass: 1}}, b: {{shape: particle, mass: 1}}}}
joints:
  A: {{type: free, of: [ground.O, a.centre], coordinates: [x, y]}}
  B: {{type: free, of: [ground.O, b.centre], coordinates: [z, w]}}
forces: {{s: {{type: spring, along: x, stiffness: k}}}}
initial: {{x: 1 m, y: 0, z: 0, w: 0, rates: {{x: 0, y: 0.1 m/s, z: 0.2 m/s, w: 0}}}}
events:
  one: {{when: x + 0.5 m, if: first < 1, then: {{set: {{first: 1}}, lock: y}}}}
  two: {{when: z - level, if: first < 1, then: {{set: {{first: 2}}, reset: {{w: 1 m/s}}}}}}
run: {{until: 4 s}}
"""
"""x is −0.5 m at t = 2π/3; only the first of the two events acts."""


@every(map(str, MISSES), "apart", share=8)
def test_which_of_two_events_comes_first_does_not_depend_on_the_tolerance_or_is_said_to(apart):
    instant = 2 * np.pi / 3
    mechanism = loaded(ORDER.format(level=0.2 * instant * (1 + float(apart))))
    first = "two" if float(apart) < 0 else "one"
    known = resolved(mechanism, abs(float(apart)), lambda run: [event.name for event in run.events])
    assert not known[0] or abs(float(apart)) > TOLERANCES[0]
    assert float(apart) == 0 or [event.name for event in mechanism.simulate(rtol=1e-13).events] == [first]


def test_two_events_at_given_times_have_an_order():
    """Time itself is known to round-off."""
    text = ORDER.format(level=1.0).replace("when: x + 0.5 m", "at: 1 s").replace("when: z - level", "at: 1.0000000001 s")
    assert all(resolved(loaded(text), 1.0, lambda run: [event.name for event in run.events]))


SENSITIVITY = 1e4
"""Change of the instants of a second of motion, s, over the tolerance: impacts and swings make errors grow."""


def outcome(mechanism: fb.Mechanism, rtol: float) -> tuple[str, list[tuple[tuple[str, ...], float, float]]]:
    """How a run ends; and what happened when, in s, each impact with its largest impulse over the largest of the run."""
    try:
        run = mechanism.simulate(rtol=rtol)
    except fb.MotionError as error:
        return error.kind.value, []
    largest = max((size for change in run.motion.changes for size in change.sizes.values()), default=0.0)
    happened = [
        ((change.kind, *change.of), change.t, max(change.sizes.values()) / largest if change.sizes else np.inf)
        for change in run.motion.changes
    ]
    return run.outcome.name.value, happened + [((event.name, event.kind), event.t, np.inf) for event in run.events]


def instants(happened: list[tuple[tuple[str, ...], float, float]], rtol: float) -> dict[tuple[str, ...], list[float]]:
    """When each kind of thing happened. Not of a graze: the impulse of an impact is a mass times the speed of approach, and a speed below
    ``rtol`` of the largest is the integrator's error, so that there may as well be none."""
    found = defaultdict(list)
    for name, t, size in happened:
        if size > rtol:
            found[name].append(t)
    return dict(found)


@every(map(str, range(300)), "seed", share=40)
def test_outcome_and_events_do_not_depend_on_the_tolerance(seed):
    mechanism = switching(int(seed))
    try:
        mechanism.start()
    except fb.MotionError as error:
        pytest.skip(error.kind.value)
    *others, known = [(float(rtol), *outcome(mechanism, float(rtol))) for rtol in TOLERANCES]
    for rtol, end, happened in others:
        assert end == known[1], rtol
        seen, true = instants(happened, rtol), instants(known[2], rtol)
        assert {name: len(times) for name, times in seen.items()} == {name: len(times) for name, times in true.items()}, rtol
        for name, times in seen.items():
            assert times == pytest.approx(true[name], rel=0, abs=SENSITIVITY * rtol), (rtol, name)
