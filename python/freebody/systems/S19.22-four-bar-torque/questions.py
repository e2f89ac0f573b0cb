"""Four-bar, torque over a cycle.

The linkage of S19.21 with other bars, AB turning steadily. At every angle the loop is solved anew: positions, then
rates, then accelerations, then three balances of angular momentum; see ``_linkages.py``. Over a whole turn the
kinetic energy comes back, so the torque's integral over the angle is 0; and as the turn is steady, so is that over
time, which is the former divided by the rate.
"""

import math

import numpy as np

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import motion
from freebody.systems._linkages import FourBar, nearest_turn

RATE, START = math.tau, math.pi / 2
TURN = np.arange(24) / 24  # times of every 15°
HAND = "closed form: loop, then three balances of angular momentum"


def by_hand(side=1, gravity=0.0):
    root = math.sqrt(2)
    return FourBar(0.4, 0.4 * root, 0.8 * root, 1.2, (1, 1, 1), side, gravity)


def at(bars, t):
    return bars.motion(START + RATE * t, RATE, 0.0)


def torque(bars, t):
    return bars.forces(at(bars, t))[0]


def zeros(function, step=1 / 720):
    """Zeros over one turn, by bisection."""
    from scipy.optimize import brentq

    times = np.arange(0, 1 + step / 2, step)
    values = [function(t) for t in times]
    return [
        brentq(function, a, b, xtol=1e-15, rtol=1e-14)
        for a, b, f, g in zip(times, times[1:], values, values[1:], strict=False)
        if f * g < 0
    ]


def extremes(bars):
    """Greatest and least torque of a turn, refined from a fine grid: (t, T) each."""
    from scipy.optimize import minimize_scalar

    grid = np.arange(720) / 720
    values = np.array([torque(bars, t) for t in grid])
    for sign, i in ((-1, values.argmax()), (1, values.argmin())):
        found = minimize_scalar(
            lambda t, s=sign: s * torque(bars, t), bracket=(grid[i] - 1 / 720, grid[i], grid[i] + 1 / 720), tol=1e-12
        )
        yield found.x, sign * found.fun


@ask("What are the angles, rates and accelerations every 15°, step by step?")
def kinematics(case):
    run, hand = case.run("driven.yaml"), [at(by_hand(), t) for t in TURN]
    for i, name, letter in ((1, "beta", "β"), (2, "phi", "φ")):
        angles = [nearest_turn(a, m.angle[i]) for a, m in zip(run.evaluate(name, TURN), hand, strict=True)]
        rates, bends = (run.evaluate(f"{word}({name})", TURN) for word in ("rate", "accel"))
        against = "closed form: two circles meet at C, differentiated"
        yield Answer(letter, angles, "rad", [m.angle[i] for m in hand], against, 1e-12)
        yield Answer(f"{letter}̇", rates, "rad/s", [m.rate[i] for m in hand], against, 1e-11)
        yield Answer(f"{letter}̈", bends, "rad/s²", [m.turning[i] for m in hand], against, 1e-11)


@ask("What is T against θ and against t, every 15°, which is every 1/24 s?")
def torques(case):
    run = case.run("driven.yaml")
    value = run.evaluate("drive.force", TURN)
    yield Answer("T from θ = 90° on", value, "N·m", [torque(by_hand(), t) for t in TURN], HAND, 1e-11)
    check, says = [by_hand().torque_by_power(at(by_hand(), t)) for t in TURN], "Virtual power gives the same."
    yield Answer("T", value, "N·m", check, "closed form: virtual power", 1e-11, says=says)
    for name, side, gravity in (("the other assembly", -1, 0.0), ("gravity", 1, 9.81), ("the other assembly, gravity", -1, 9.81)):
        run, bars = case.run("driven.yaml", {"side": side, "g": gravity}), by_hand(side, gravity)
        check = [torque(bars, t) for t in TURN]
        yield Answer("T", run.evaluate("drive.force", TURN), "N·m", check, HAND, 1e-11, variant=name)


@ask("What is the area under T, over θ and over t?")
def areas(case):
    run = case.run("driven.yaml")
    size = run.report["greatest torque"].value
    yield Answer(
        "∫ T dθ over a turn",
        run.report["torque over angle"].value,
        "J",
        0.0,
        "conservation: kinetic energy comes back",
        1e-9,
        scale=size * math.tau,
    )
    yield Answer(
        "∫ T dt over a turn", run.report["torque over time"].value, "N·m·s", 0.0, "conservation: ∫ T dθ / θ̇", 1e-9, scale=size
    )


@ask("Where is T greatest, least and zero?")
def turning_points(case):
    run = case.run("driven.yaml")
    for name, (when, value) in zip(("greatest", "least"), extremes(by_hand()), strict=True):
        item = run.report[f"{name} torque"]
        yield Answer(f"{name} T", item.value, "N·m", value, HAND, 1e-10)
        says = "There θ − 90° is {}."
        yield Answer("θ − 90°", (item.t % 1) * RATE, "rad", (when % 1) * RATE, HAND, 1e-6, says=says)
    found = [event.t for event in run.events if event.name == "no torque"]
    value, check = np.multiply(found, RATE), np.multiply(zeros(lambda t: torque(by_hand(), t)), RATE)
    yield Answer("θ − 90°", value, "rad", check, HAND, 1e-10, says="T is zero at θ − 90° = {}.")


@ask("What are the forces at the four pins every 15°?")
def pins(case):
    run = case.run("driven.yaml")
    hand = [by_hand().forces(at(by_hand(), t))[1:] for t in TURN]
    for i, pin in enumerate("ABCD"):
        for axis, part in (("x", "real"), ("y", "imag")):
            check = [getattr(row[i], part) for row in hand]
            yield Answer(f"force at {pin} along {axis}", run.evaluate(f"{pin}.F{axis}", TURN), "N", check, HAND, 1e-11)


@ask("What is the range of φ, and the kinetic energy?")
def range_of_phi(case):
    """The rocker turns back where A, B, C are in line: AC = l1 + l2 or l2 − l1; the law of cosines in ACD."""
    run = case.run("driven.yaml")
    at_d = [
        math.acos((bars.l3**2 + bars.d**2 - reach**2) / (2 * bars.l3 * bars.d))
        for bars in [by_hand()]
        for reach in (bars.l1 + bars.l2, bars.l2 - bars.l1)
    ]
    turned_back = [math.pi - angle for angle in at_d]
    value = [run.report["least phi"].value, run.report["greatest phi"].value]
    value = [nearest_turn(v, c) for v, c in zip(value, turned_back, strict=True)]
    says = "φ goes from {} to {}."
    yield Answer("φ", value, "rad", turned_back, "closed form: A, B, C in line", 1e-11, says=says)
    check, against = [by_hand().kinetic(at(by_hand(), t)) for t in TURN], "closed form: loop, then rates"
    yield Answer("kinetic energy every 15°", run.evaluate("kinetic()", TURN), "J", check, against, 1e-12)


@ask("How does it move for 10 s under gravity, released from rest at θ = 90°?")
def falling(case):
    run, times, bars = case.run(), np.arange(1.0, 10.5), by_hand(1, 9.81)
    check = motion(lambda t, y: [y[1], bars.free(*y)], [START, 0], times)
    yield Answer(
        "θ at 1 … 10 s", run.evaluate("theta", times), "rad", check[:, 0], "other route: power balance, integrated by SciPy", 1e-9
    )
    fine = np.linspace(0, 10, 1001)
    gap = np.hypot(*(run.evaluate(f"{axis}(bc.end) - {axis}(dc.end)", fine) for axis in "xy")).max()
    says = "The loop stays closed: the gap at C is {} at most."
    yield Answer("gap", gap, "m", 0.0, "closed form: the loop is closed", 1e-12, scale=1, says=says)
    start = bars.potential(bars.motion(START, 0, 0))
    energy, says = run.evaluate("energy()", times), "The energy stays {}."
    yield Answer("energy", energy, "J", start + 0 * times, "conservation: no work but of the weights", 1e-10, says=says)


@ask("What do T, the pin forces, the shaking force and the work of a turn come to by inverse dynamics?")
def inverse(case):
    """The ground feels what A and D exert on it."""
    for side, name in ((1, ""), (-1, "the other assembly")):
        found, bars = case.mechanism("driven.yaml", side=side).inverse(), by_hand(side)
        torques, *pins = zip(*(bars.forces(at(bars, t)) for t in TURN), strict=True)
        yield Answer("T every 15°", found.evaluate("drive.force", TURN), "N·m", torques, HAND, 1e-10, variant=name)
        for pin, force in zip("ABCD", np.array(pins), strict=True):
            value = found.evaluate(f"{pin}.Fx", TURN) + 1j * found.evaluate(f"{pin}.Fy", TURN)
            parts = [np.concatenate([z.real, z.imag]) for z in (value, force)]
            yield Answer(f"force at {pin}, along x, then y", parts[0], "N", parts[1], HAND, 1e-10, variant=name)
        x = found.values([found.shaking[0]], TURN)[:, 0]
        check = -(np.array(pins[0]) + np.array(pins[3])).real
        yield Answer("shaking force along x", x, "N", check, HAND, 1e-10, variant=name)
        size = found.summary("drive.power").greatest.value
        against = "conservation: kinetic energy comes back"
        yield Answer("work of a turn", found.work("drive"), "J", 0.0, against, 1e-10, size, variant=name)
