"""A string wound on a drum, always straight: its direction and its free length are coordinates."""

import numpy as np
import pytest

import freebody as fb

YOYO = """
freebody: 1
parameters: {M: 0.2 kg, R: 5 cm, r: 1 cm, free: 0.2 m, spin: 0}
ground: {points: {top: [SIDE, free]}}
bodies: {disk: {shape: disk, radius: R, mass: M}}
joints: {cable: {type: wound_string, from: ground.top, drum: {centre: disk.centre, radius: r}, RIGHT START}}
"""
NAMED = (
    "coordinates: [{name: phi, zero: down}, l]}}\ninitial: {phi: 0, l: free, rates: {phi: 0, l: spin}}\nrun: {until: 0.5 s}\n#"
)
LATER = """engaged: false}}
initial: {disk.x: 0, disk.y: 0, disk.angle: 0, at_rest: true}
events: {grab: {at: 0.1 s, then: {engage: cable}}}
run: {until: 0.4 s}
#"""
A, PULL = 9.81 / 13.5, 0.2 * (9.81 - 9.81 / 13.5)  # g/(1 + R²/(2r²)) and M (g − a)
SIDES = {"left": ("-r", ""), "right": ("r", "right: true,")}


def yoyo(start, side="left"):
    at, right = SIDES[side]
    return fb.Mechanism.loads(YOYO.replace("SIDE", at).replace("RIGHT", right).replace("START", start))


@pytest.mark.parametrize("side", SIDES)
def test_a_yoyo_falls_straight_and_its_tension_is_the_closed_form(side):
    run, t = yoyo(NAMED, side).simulate(), np.linspace(0, 0.5, 6)
    np.testing.assert_allclose(run.evaluate("l", t), 0.2 + A * t**2 / 2, rtol=1e-12)
    np.testing.assert_allclose(run.evaluate("phi", t), 0, atol=1e-12)
    np.testing.assert_allclose(run.evaluate("cable.tension", t), PULL, rtol=1e-10)


def test_wound_up_the_motion_ends_by_that_name():
    outcome = yoyo(NAMED).simulate(spin=-4).outcome
    assert outcome.t == pytest.approx((4 - np.sqrt(16 - 0.4 * A)) / A, abs=1e-6) and "cable is wound up" in str(outcome)


def test_held_later_it_takes_the_speed_by_an_impact():
    """m v r of the centre about the string becomes (I + m r²) ω: v is g t (r²/(r² + R²/2)) at once."""
    run, t = yoyo(LATER).simulate(), np.array([0.2, 0.4])
    fall, speed = 9.81 * 0.1**2 / 2, 9.81 * 0.1 * 2 / 27
    np.testing.assert_allclose(run.evaluate("y(disk.centre)", t), -fall - speed * (t - 0.1) - A * (t - 0.1) ** 2 / 2, rtol=1e-9)
    np.testing.assert_allclose(run.evaluate("cable.tension", [0.05, *t]), [0, PULL, PULL], rtol=1e-9)


WITHIN = [
    "cable: {type: wound_string, from: ground.origin, drum: {centre: disk.centre, radius: 1 cm}, coordinates: [phi, l]}}\n"
    "initial: {l: -0.1}",
    "place: {type: free, of: [ground.origin, disk.centre], coordinates: [x, y, theta]}, "
    "cable: {type: wound_string, from: ground.origin, drum: {centre: disk.centre, radius: 1 cm}}}\ninitial: {x: 4 mm, y: 5 mm}",
]


@pytest.mark.parametrize("call", ["solve", "simulate"])
@pytest.mark.parametrize("joints", WITHIN, ids=["coordinate", "loop"])
def test_a_start_within_the_drum_is_refused(joints, call):
    """There the rows have solutions that are no motions."""
    disk = "freebody: 1\nbodies: {disk: {shape: disk, radius: 5 cm, mass: 1}}\nrun: {until: 1 s}\n"
    with pytest.raises(fb.MotionError, match="the free length of `cable` would be -0"):
        getattr(fb.Mechanism.loads(f"{disk}joints: {{{joints}\n"), call)()
