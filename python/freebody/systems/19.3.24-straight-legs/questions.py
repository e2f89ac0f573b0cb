"""19.3.24: walking on straight legs, single stance.

u = (−sin θ1, cos θ1) up the stance leg, w = (sin θ2, −cos θ2) down the swing leg: G1 = A + d1 u, B = A + ℓu, G2 = B + d2 w.
ΣM/A = Ḣ/A for the whole and ΣM/B = Ḣ/B for leg BC (LEGS-1; true) hold no reaction: with a = I1 + m1d1² + (M + m2)ℓ²,
b = I2 + m2d2², c = m2ℓd2, h = m1d1 + (M + m2)ℓ and Δ = θ1 − θ2
    BC about B:                bθ̈2 − c cos Δ θ̈1 + c sin Δ θ̇1² = −m2 g d2 sin θ2
    whole about A, less that:  aθ̈1 − c cos Δ θ̈2 − c sin Δ θ̇2² = h g sin θ1.
The foot carries the rate of change of all momentum and all weight, the hip that of leg BC.

A foot that can only push and does not slip ends where N = 0: friction still acts then. Let go, the foot would press into the
floor; held, the floor would pull. No motion is possible; a foot with friction slides before.
"""

from itertools import product

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import event, motion

G = 9.81
START = [0.25, -0.3, -1.1, 0.8]
TIMES = [0.2, 0.4, 0.6, 0.8, 0.9]
SCIPY = "other route: moments about A and B, SciPy"
MOMENTS = "closed form: moments about A and B"
GIVEN = {"m1": 5.0, "m2": 5.0, "M": 10.0, "l": 1.0, "d1": 0.55, "d2": 0.45, "I1": 0.4, "I2": 0.4}
COLUMNS = [("theta1", "θ1", "rad"), ("theta2", "θ2", "rad"), ("rate(theta1)", "θ̇1", "rad/s"), ("rate(theta2)", "θ̇2", "rad/s")]
FLOORS = {"model.yaml": "", "one_sided.yaml": "a foot that only pushes"}
PUSH = "min of foot.Fy over 0 s .. 1 s"
STARTS = {
    "": (0.25, -0.3, 0.8),
    "θ̇2 = −4 rad/s": (0.25, -0.3, -4.0),
    "θ̇2 = 0": (0.25, -0.3, 0.0),
    "θ̇2 = 2 rad/s": (0.25, -0.3, 2.0),
    "legs together, θ1 = θ2 = 0.1": (0.1, 0.1, 0.8),
    "legs wide apart, θ1 = 0.4, θ2 = −0.5": (0.4, -0.5, 0.8),
}
"""θ1, θ2, θ̇2 of every start."""
SETS = {
    "": {},
    "M = 0": {"M": 0.0},
    "uniform legs": {"d1": 0.5, "d2": 0.5, "I1": 5 / 12, "I2": 5 / 12},
    "mass low in the legs": {"d1": 0.3, "d2": 0.7},
    "unlike legs": {"m1": 6.0, "m2": 4.0, "I1": 0.5, "I2": 0.3},
}


class Legs:
    """The two equations and the forces."""

    def __init__(self, **changes):
        self.__dict__.update(GIVEN | changes)

    def turning(self, y):
        one, two, w1, w2 = y
        a = self.I1 + self.m1 * self.d1**2 + (self.M + self.m2) * self.l**2
        b, c = self.I2 + self.m2 * self.d2**2, self.m2 * self.l * self.d2
        h, cosine, sine = self.m1 * self.d1 + (self.M + self.m2) * self.l, np.cos(one - two), np.sin(one - two)
        right = [h * G * np.sin(one) + c * sine * w2**2, -self.m2 * G * self.d2 * np.sin(two) - c * sine * w1**2]
        return np.linalg.solve([[a, -c * cosine], [-c * cosine, b]], right)

    def rates(self, _t, y):
        return [y[2], y[3], *self.turning(y)]

    def accelerations(self, y):
        """Of G1, B, G2."""
        one, two, w1, w2 = y
        u, w = np.array([-np.sin(one), np.cos(one)]), np.array([np.sin(two), -np.cos(two)])
        t1, t2 = self.turning(y)
        along = t1 * np.array([-u[1], u[0]]) - w1**2 * u
        return self.d1 * along, self.l * along, self.l * along + self.d2 * (t2 * np.array([-w[1], w[0]]) - w2**2 * w)

    def foot(self, y):
        masses, weight = (self.m1, self.M, self.m2), np.array([0, G])
        return sum(m * (a + weight) for m, a in zip(masses, self.accelerations(y), strict=True))

    def hip(self, y):
        """On leg BC."""
        return self.m2 * (self.accelerations(y)[2] + np.array([0, G]))


@ask("Which two equations for θ̈1, θ̈2 hold no reaction?")
def symbolically(case):
    swing = "(I2 + m2*d2^2)*accel(theta2) - m2*l*d2*(cos({0})*accel(theta1) - sin({0})*rate(theta1)^2)".format("theta1 - theta2")
    swing += " + m2*g*d2*sin(theta2)"
    rest = "(I1 + m1*d1^2 + (M + m2)*l^2)*accel(theta1) - (m1*d1 + (M + m2)*l)*g*sin(theta1)"
    rest += " - m2*l*d2*(cos({0})*accel(theta2) + sin({0})*rate(theta2)^2)".format("theta1 - theta2")
    yield from case.balances([f"{swing} + {rest}", swing], MOMENTS)


@ask("Is ΣM/A = Ḣ/A for the whole, ΣM/B = Ḣ/B for leg BC (LEGS-1)?")
def balances(case):
    """Both sides from the solved instant, the rate of angular momentum taken of each part."""
    now, legs = case.instant(), Legs()

    def spin(points, about, turns):
        at = np.array([now[f"x({about})"], now[f"y({about})"]])
        weight, rate = 0.0, sum(turns)
        for mass, point in points:
            r = np.array([now[f"x({point})"], now[f"y({point})"]]) - at
            weight += -mass * G * r[0]
            rate += mass * (r[0] * now[f"ay({point})"] - r[1] * now[f"ax({point})"])
        return weight, rate

    one, two = (0.4 * now[f"alpha({leg})"] for leg in ("stance", "swing"))
    parts = [(legs.m1, "stance.G"), (legs.M, "hip.centre"), (legs.m2, "swing.G")]
    for name, (moment, rate) in (
        ("Of the whole about A", spin(parts, "stance.A", [one, two])),
        ("Of leg BC about B", spin(parts[2:], "stance.B", [two])),
    ):
        says = f"{name} Ḣ is {{}}, as large as the moment of the weights."
        yield Answer("Ḣ", rate, "N·m", moment, "closed form: moment of the weights", 1e-12, says=says)


@ask("What are θ̈1, θ̈2 and the forces of floor and hip at θ1 = 0.25, θ2 = −0.3, θ̇1 = −1.1, θ̇2 = 0.8?")
def instant(case):
    for (of, changes), file in product(SETS.items(), FLOORS):
        legs, now, of = Legs(**changes), case.instant(file, changes), ", ".join(filter(None, (of, FLOORS[file])))
        value = [now["accel(theta1)"], now["accel(theta2)"]]
        yield Answer("θ̈1, θ̈2", value, "rad/s²", legs.turning(START), MOMENTS, 1e-12, variant=of)
        says, against = "The floor's force on the foot is ({}, {}).", "closed form: momentum of the whole"
        foot = [now["foot.Fx"], now["foot.Fy"]]
        yield Answer("foot", foot, "N", legs.foot(START), against, 1e-12, says=says, variant=of)
        says, against = "The hip's force on leg BC is ({}, {}).", "closed form: momentum of leg BC"
        hip = [now["pelvis.Fx"], now["pelvis.Fy"]]
        yield Answer("hip", hip, "N", legs.hip(START), against, 1e-12, says=says, variant=of)


@ask("How do the legs move in 1 s with the foot pinned, and with which force on the foot?")
def pinned(case):
    times = [*TIMES, 1.0]
    for of in ("", "M = 0"):
        legs, run = Legs(**SETS[of]), case.run(parameters=SETS[of])
        check = motion(legs.rates, START, times)
        for i, (text, name, unit) in enumerate(COLUMNS):
            label = f"{name} at 0.2, 0.4, 0.6, 0.8, 0.9, 1 s"
            yield Answer(label, run.evaluate(text, times), unit, check[:, i], SCIPY, 1e-9, variant=of)
        for i, part in enumerate(("Fx", "Fy")):
            forces = [legs.foot(y)[i] for y in check]
            yield Answer(f"{part} of the foot then", run.evaluate(f"foot.{part}", times), "N", forces, SCIPY, 1e-9, variant=of)


@ask("And with a foot that can only push and does not slip?")
def pushed(case):
    legs = Legs()
    run, check = case.run("one_sided.yaml", until=0.9), motion(legs.rates, START, TIMES)
    for i, (text, name, unit) in enumerate(COLUMNS[:2]):
        yield Answer(f"{name} at 0.2, 0.4, 0.6, 0.8, 0.9 s", run.evaluate(text, TIMES), unit, check[:, i], SCIPY, 1e-9)
    for i, part in enumerate("TN"):
        yield Answer(f"{part} then", run.evaluate(f"foot.{part}", TIMES), "N", [legs.foot(y)[i] for y in check], SCIPY, 1e-9)
    when, state = event(legs.rates, START, lambda t, y: legs.foot(y)[1], before=1.0)
    outcome = case.mechanism("one_sided.yaml").simulate(rtol=1e-12).outcome
    yield Answer("end", outcome.t, "s", when, SCIPY, 1e-9, says="The floor's push ends at {}.")
    says = "There the foot can neither hold nor part: the run ends and says so."
    yield Answer("ends", outcome.name == "painleve_inconsistent", "", released(legs, state) < 0,
                 "closed form: let go, the foot presses into the floor", says=says)  # fmt: skip
    forces, last = case.run().evaluate("foot.Fy", [when, 1.0]), legs.foot(motion(legs.rates, START, [1.0])[0])[1]
    says = "The floor pushes the pinned foot with {} then, and with {} at 1 s: it pulls."
    yield Answer("Fy of the pinned foot", forces, "N", [0.0, last], SCIPY, 1e-8, says=says)


@ask("From which starts is the foot pressed on the floor for a whole second?")
def every_start(case):
    """The hinged foot's least push, by the rates and the posture that the legs start with; in all other motions the floor has to pull."""
    for of, (one, two, rate) in STARTS.items():
        start = {"theta1": one, "theta2": two, "rates": {"theta2": rate}}
        within, points = ((-4, 3), 33) if not of else ((-3, 1), 9)
        found = case.mechanism().find(PUSH, 0, vary="rate(theta1)", within=within, points=points, until=1, rtol=1e-11, **start)
        check = [brentq(least_push, x - 0.05, x + 0.05, (one, two, rate), xtol=1e-12) for x in found.values]
        says = "From θ̇1 between {} and {}; from others the floor would have to pull."
        yield Answer("θ̇1", found.values, "rad/s", check, SCIPY, 1e-7, says=says, variant=of)


def least_push(first, one, two, second):
    legs, start = Legs(), [one, two, first, second]
    solution = solve_ivp(legs.rates, (0, 1), start, method="DOP853", rtol=1e-12, atol=1e-13, dense_output=True)
    times = np.linspace(0, 1, 401)
    pushes = [legs.foot(solution.sol(t))[1] for t in times]
    i = int(np.argmin(pushes))
    near = (times[max(i - 1, 0)], times[min(i + 1, 400)])
    return minimize_scalar(lambda t: legs.foot(solution.sol(t))[1], bounds=near, method="bounded", options={"xatol": 1e-10}).fun


def released(legs, y):
    """Acceleration of the foot, upward, without any force from the floor: the foot's place is two unknowns more."""
    one, two, w1, w2 = y
    u, w = np.array([-np.sin(one), np.cos(one)]), np.array([np.sin(two), -np.cos(two)])
    du, dw = np.array([-u[1], u[0]]), np.array([-w[1], w[0]])
    zero = np.zeros(2)
    parts = [(legs.m1, legs.d1 * u, zero), (legs.M, legs.l * u, zero), (legs.m2, legs.l * u, legs.d2 * w)]
    matrix, right = np.zeros((4, 4)), np.zeros(4)
    for mass, one_arm, two_arm in parts:
        columns = np.column_stack([np.eye(2), np.hypot(*one_arm) * du, np.hypot(*two_arm) * dw])
        matrix += mass * columns.T @ columns
        right += mass * columns.T @ (np.array([0, -G]) + w1**2 * one_arm + w2**2 * two_arm)
    matrix[2, 2] += legs.I1
    matrix[3, 3] += legs.I2
    return np.linalg.solve(matrix, right)[1]


@ask("When does the foot slide on a floor with friction 3?")
def slides(case):
    legs = Legs()
    when, _ = event(legs.rates, START, lambda t, y: 3 * legs.foot(y)[1] - abs(legs.foot(y)[0]), before=1.0)
    slip = next(c.t for c in case.run("slippery.yaml", until=0.96).changes if c.kind == "slip")
    yield Answer("slip", slip, "s", when, SCIPY, 1e-9, says="From {} on.")
