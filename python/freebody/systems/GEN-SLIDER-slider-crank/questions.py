"""Slider-crank, a closed chain.

r sin θ + l sin β = 0 gives the rod's angle, its rate and acceleration; the slider along x, the rod about B and so
on backwards give every force, one unknown at a time. See ``_linkages.py``.
"""

import math

import numpy as np

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import motion
from freebody.inverse import NotRealizable
from freebody.systems._linkages import CrankSlider

BY_HAND = CrankSlider(0.1, 0.3, (1.0, 2.0, 1.5))
ANGLES = [math.radians(30 * k) for k in range(12)]
HAND = "closed form: one balance after another"


@ask("What are the torque and every reaction at 0°, 30°, … 330° with the crank at 20 rad/s?")
def steady(case):
    states = [case.instant("driven.yaml", {"theta0": theta}) for theta in ANGLES]
    hand = [BY_HAND.motion(theta, 20.0, 0.0) for theta in ANGLES]
    forces = [BY_HAND.forces(m) for m in hand]
    yield Answer(
        "x of the slider", [now["x"] for now in states], "m", [m.centre[2].real for m in hand], "closed form: loop", 1e-13
    )
    yield Answer(
        "acceleration of the slider",
        [now["accel(x)"] for now in states],
        "m/s²",
        [m.acceleration[2].real for m in hand],
        "closed form: loop differentiated twice",
        1e-12,
    )
    yield Answer("torque on the crank", [now["drive.force"] for now in states], "N·m", [f[0] for f in forces], HAND, 1e-12)
    for i, (pin, on) in enumerate((("O", "crank"), ("B", "rod"), ("C", "slider")), start=1):
        for axis, part in (("x", "real"), ("y", "imag")):
            yield Answer(
                f"force at {pin} on the {on} along {axis}",
                [now[f"{pin}.F{axis}"] for now in states],
                "N",
                [getattr(f[i], part) for f in forces],
                HAND,
                1e-12,
            )
    yield Answer("guide on the slider", [now["guide.Fn"] for now in states], "N", [f[4] for f in forces], HAND, 1e-12)
    yield Answer(
        "couple of the guide",
        [now["guide.M"] for now in states],
        "N·m",
        0.0,
        "closed form: all forces on the slider meet in C",
        1e-12,
        scale=1,
    )


@ask("How does it move for 2 s from rest at 60°, without torque?")
def falling(case):
    run, times = case.run(), np.linspace(0.2, 2, 10)
    check = motion(lambda t, y: [y[1], BY_HAND.free(*y)], [math.pi / 3, 0], times)
    yield Answer(
        "θ at 0.2 … 2 s",
        run.evaluate("theta", times),
        "rad",
        check[:, 0],
        "other route: power balance, integrated by SciPy",
        1e-10,
    )
    places = [BY_HAND.motion(theta, 0, 0).centre[2].real for theta in check[:, 0]]
    yield Answer(
        "x at 0.2 … 2 s", run.evaluate("x", times), "m", places, "other route: power balance, integrated by SciPy", 1e-10
    )
    start = 9.81 * 3 * 0.05 * math.sin(math.pi / 3)
    energy, says = run.evaluate("energy()", times), "The energy stays {}."
    yield Answer("energy", energy, "J", start + 0 * times, "conservation: no work but of the weights", 1e-10, says=says)


@ask("Where are the dead points, beyond which the slider cannot be driven?")
def beyond(case):
    """Crank and rod in one line, stretched at l + r or folded at l − r."""
    for file, law, check, of in (
        ("model.yaml", "0.3 + 0.2*t", 0.4, "stretched"),
        ("model.yaml", "0.3 - 0.2*t", 0.2, "folded"),
        ("dead_point.yaml", "0.1 + 0.2*t", 0.2, "stretched, the rod as long as the crank"),
    ):
        try:
            case.mechanism(file).inverse({"x": law}, until=1, initial={"guess": {"theta": 1, "beta": -0.5}})
        except NotRealizable as error:
            says, name = "x = {}, by its name: a dead position.", str(error).partition("dead position")[1]
            against = "closed form: crank and rod in one line"
            yield Answer(name, error.posture["x"], "m", check, against, 1e-7, says=says, variant=of)


@ask("With a rod as long as the crank, what is undetermined at the dead point, and which ways lead on?")
def dead_point(case):
    """Crank and rod upright hold the slider's height between guide and axle twice; nothing holds it sideways.

    From there the slider stands still, with the rod on the crank (β̇ = θ̇), or moves (β̇ = −θ̇): ẋ = r (β̇ − θ̇).
    """
    now, upright = case.instant("dead_point.yaml"), "closed form: crank, rod and guide along one line"
    yield Answer("freedom", now.freedom, "", 2, upright, 0.0, says="There it has {} degrees of freedom.")
    for name in ("O", "B", "C", "guide"):
        for part, known, check in zip(("Fx", "Fy"), now.reactions[name].determined, (True, False), strict=False):
            yield Answer(f"{part} of {name} is determinate", known, check=check, against=upright, tolerance=0.0)
    for rate in (1.0, -1.0):
        way = case.instant("dead_point.yaml", rates={"theta": 1.0, "beta": rate})
        says = f"With θ̇ = 1, β̇ = {rate:g} rad/s the slider goes on at {{}}."
        yield Answer("ẋ", way["rate(x)"], "m/s", 0.1 * (rate - 1), "closed form: loop", 1e-13, scale=0.1, says=says)


@ask("What do torque, reactions and work of a turn at 20 rad/s come to by inverse dynamics?")
def turned(case):
    given = case.mechanism().inverse({"theta": {"is": "20 rad/s", "level": "velocity"}}, until=math.tau / 20, theta=0)
    times, hand = np.array(ANGLES) / 20, [BY_HAND.forces(BY_HAND.motion(theta, 20.0, 0.0)) for theta in ANGLES]
    value = given.evaluate("'motion of theta'.force", times)
    yield Answer("torque at 0°, 30°, … 330°", value, "N·m", [f[0] for f in hand], HAND, 1e-10)
    for i, pin in enumerate("OBC", start=1):
        value = np.concatenate([given.evaluate(f"{pin}.F{axis}", times) for axis in "xy"])
        check = np.array([f[i] for f in hand])
        yield Answer(f"force at {pin}, along x, then y", value, "N", np.concatenate([check.real, check.imag]), HAND, 1e-10)
    yield Answer("guide on the slider", given.evaluate("guide.Fn", times), "N", [f[4] for f in hand], HAND, 1e-10)
    size = given.summary("'motion of theta'.power").greatest.value
    yield Answer("work of the turn", given.work("motion of theta"), "J", 0.0, "conservation: energy comes back", 1e-10, size)
