"""Machines with several motors.

With absolute angles a of the links, place k_ij of centre i along link j, and κ_jk = Σ_i m_i k_ij k_ik, Lagrange's equations of a chain
are Σ_k κ_jk (cos(a_j − a_k) ä_k + sin(a_j − a_k) ȧ_k²) + I_j ä_j + g Σ_i m_i k_ij cos a_j = T_j − T_(j+1). The hand gives the wrist,
and the wrist the two other links, by the law of cosines.
"""

import math

import numpy as np
from numpy.polynomial import Polynomial

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import motion
from freebody.inverse import NotRealizable, quintic

L = np.array([0.4, 0.3, 0.2])
MOTORS = ["shoulder motor", "elbow motor", "wrist motor"]
TORQUES = [f"'{motor}'.value" for motor in MOTORS]
GUESS = {1: {"q1": 0, "q2": "90 deg", "q3": "-90 deg"}, -1: {"q1": "90 deg", "q2": "-90 deg", "q3": 0}}
ELBOW = {1: "elbow below", -1: "elbow above"}
HAND = {"x(hand.end)": quintic(0.5, 0.3, 1), "y(hand.end)": quintic(0.2, 0.6, 1), "angle(hand)": 0}
LAGRANGE = "closed form: law of cosines, Lagrange's equations"
TIMES = np.linspace(0, 1, 9)


class Chain:
    """A chain of links: ``places`` (n, n) of the centres along the links, masses, inertias, gravity."""

    def __init__(self, places, masses, inertias, gravity):
        self.masses, self.inertias = np.array(masses), np.diag(inertias)
        self.places, self.gravity = np.array(places), gravity
        self.kappa = self.places.T @ np.diag(self.masses) @ self.places

    def mass(self, a):
        return self.kappa * np.cos(a[:, None] - a) + self.inertias

    def bias(self, a, rates):
        weights = self.gravity * (self.masses @ self.places) * np.cos(a)
        return (self.kappa * np.sin(a[:, None] - a)) @ rates**2 + weights

    def torques(self, a, rates, accelerations):
        """What the motors give, from the first on."""
        return np.cumsum((self.mass(a) @ accelerations + self.bias(a, rates))[::-1])[::-1]

    def accelerations(self, a, rates, torques):
        """Of the absolute angles."""
        return np.linalg.solve(self.mass(a), torques - np.append(torques[1:], 0.0) - self.bias(a, rates))


ARM = Chain([[L[0] / 2, 0, 0], [L[0], L[1] / 2, 0], [L[0], L[1], L[2] / 2]], [4, 3, 1], [4 * L[0]**2 / 12, 3 * L[1]**2 / 12, L[2]**2 / 12], 9.81)  # fmt: skip
TWO = Chain([[0.5, 0], [1, 1]], [1, 1], [0.083, 0.33], 9.8)


def posture(t, side):
    """Absolute angles of the links, their rates and accelerations, on the hand's path; ``side``: the sign of q2."""
    law = Polynomial([0, 0, 0, 10, -15, 6])
    s, ds, dds = law(t), law.deriv()(t), law.deriv(2)(t)
    way = complex(-0.2, 0.4)
    wrist = complex(0.5, 0.2) + way * s - L[2]
    reach, heading = abs(wrist), math.atan2(wrist.imag, wrist.real)
    first = heading - side * math.acos((L[0] ** 2 + reach**2 - L[1] ** 2) / (2 * L[0] * reach))
    rest = wrist - L[0] * np.exp(1j * first)
    e = np.exp(1j * np.array([first, math.atan2(rest.imag, rest.real)]))
    columns = 1j * e * L[:2]
    matrix = np.array([columns.real, columns.imag])
    rates = np.linalg.solve(matrix, [(way * ds).real, (way * ds).imag])
    left = way * dds + (L[:2] * e) @ rates**2
    accelerations = np.linalg.solve(matrix, [left.real, left.imag])
    return np.append(np.angle(e), 0.0), np.append(rates, 0.0), np.append(accelerations, 0.0)


def by_hand(side):
    return np.array([ARM.torques(*posture(t, side)) for t in TIMES])


def found(case, side):
    return case.mechanism().inverse(HAND, MOTORS, initial={"guess": GUESS[side]})


@ask("Which torques take the hand along its path in 1 s, the last link level, with either elbow?")
def torques(case):
    for side, name in ELBOW.items():
        values, check = found(case, side).values(TORQUES, TIMES), by_hand(side)
        for motor, value, closed in zip(MOTORS, values.T, check.T, strict=True):
            label = motor + " at 0, 1/8, … 1 s" * (motor == MOTORS[0])
            yield Answer(label, value, "N·m", closed, LAGRANGE, 1e-10, variant=name)


@ask("What work do the motors do over the path?")
def works(case):
    """The arm begins and ends at rest, so the works together lift it."""
    for side, name in ELBOW.items():
        heights = [np.sum(ARM.masses * (ARM.places @ np.sin(posture(t, side)[0]))) for t in (0, 1)]
        value, done = 9.81 * (heights[1] - heights[0]), found(case, side)
        work = sum(map(done.work, MOTORS))
        yield Answer("all works", work, "J", value, "closed form: weights lifted", 1e-9, variant=name)


@ask("Do those torques return the path?")
def returned(case):
    """Each torque as a table of time; from them alone, without any motion prescribed, forward dynamics finds the hand."""
    from freebody.mechanism import Mechanism

    every = np.linspace(0, 1, 4097)
    for side, name in ELBOW.items():
        given, text = found(case, side), (case.folder / "model.yaml").read_text(encoding="utf-8")
        for i in (1, 2, 3):
            text = text.replace(f"value: T{i}", f"value: torque{i}(t)")
        arm = Mechanism.loads(text)
        for i, torque in enumerate(given.values(TORQUES, every).T, 1):
            arm.table(f"torque{i}", every, torque, "spline")
        start = dict(zip(("q1", "q2", "q3"), given.run.q[0].tolist(), strict=True))
        run = arm.simulate(1, initial=start, rtol=1e-12)
        law = 10 * TIMES**3 - 15 * TIMES**4 + 6 * TIMES**5
        x, y = (run.evaluate(f"{axis}(hand.end)", TIMES) for axis in "xy")
        off, says = np.hypot(x - 0.5 + 0.2 * law, y - 0.2 - 0.4 * law).max(), "Yes: the hand keeps to the path."
        yield Answer("off the path", off, "m", 0.0, "the path that was given", 1e-8, 1.0, says=says, variant=name)


@ask("How does it move under joint feedback with torques of at most 30, 8 and 1.2 N·m?")
def feedback(case):
    """Motors follow angles that go from one posture to the other by the quintic law, T = k (q_ref − q) − c q̇ within their limits."""
    ends = [np.diff(posture(t, -1)[0], prepend=0.0) for t in (0.0, 1.0)]
    most, k, c = np.array([30, 8, 1.2]), 400, 40

    def given(t, q, u):
        return np.clip(k * (ends[0] + (ends[1] - ends[0]) * (10 * t**3 - 15 * t**4 + 6 * t**5) - q) - c * u, -most, most)

    def rates(t, y):
        a, spin = np.cumsum(y[:3]), np.cumsum(y[3:])
        return [*y[3:], *np.diff(ARM.accelerations(a, spin, given(t, y[:3], y[3:])), prepend=0.0)]

    parameters = {f"{word}{i + 1}": float(end[i]) for word, end in zip(("from", "to"), ends, strict=True) for i in range(3)}
    run, times = case.run("feedback.yaml", parameters), TIMES[1:]
    check = motion(rates, [*ends[0], 0, 0, 0], times)
    route = "other route: Lagrange's equations, integrated by SciPy"
    for i, motor in enumerate(MOTORS):
        value = run.evaluate(f"q{i + 1}", times)
        yield Answer(f"q{i + 1}" + " at 1/8, … 1 s" * (i == 0), value, "rad", check[:, i], route, 1e-8)
        torque = [given(t, y[:3], y[3:])[i] for t, y in zip(times, check, strict=True)]
        yield Answer(motor, run.evaluate(TORQUES[i], times), "N·m", torque, route, 1e-6)


@ask("In which postures is it singular, the hand moving level along y = 0 out of reach and back to the shoulder?")
def singular(case):
    """The first two links are stretched where the wrist is l1 + l2 away, and folded where it is l1 − l2 away."""
    for name, x, when in (("stretched", "0.5 + 0.5*t", 0.8), ("folded", "0.5 - 0.4*t", 0.5)):
        try:
            case.mechanism().inverse({"x(hand.end)": x, "y(hand.end)": 0, "angle(hand)": 0}, MOTORS, until=1)
        except NotRealizable as error:
            bend = error.posture["q2"]
            closed = "closed form: wrist at l1 + l2, or l1 − l2, from the shoulder"
            says = f"{name.capitalize()}: the motion cannot be had beyond {{}}."
            yield Answer("t", error.t, "s", when, closed, 1e-6, says=says)
            yield Answer("|sin q2|", abs(math.sin(bend)), "", 0.0, closed, 1e-6, 1, says="There |sin q2| is {}.")


@ask("Underactuated, how does it move for 5 s without elbow torque, and with 2 sin 3t?")
def underactuated(case):
    times, start = np.linspace(1, 5, 5), [-1.2, 0.4, 0.1, -0.3]
    for size in (0, 2):

        def rates(t, y, size=size):
            torque = np.array([0.0, size * math.sin(3 * t)])
            return [*y[2:], *np.diff(TWO.accelerations(np.cumsum(y[:2]), np.cumsum(y[2:]), torque), prepend=0.0)]

        run, check = case.run("underactuated.yaml", {"size": size}), motion(rates, start, times)
        for i in (0, 1):
            route = "other route: Lagrange's equations, integrated by SciPy"
            value, of = run.evaluate(f"q{i + 1}", times), f"{size} sin 3t N·m" if size else ""
            yield Answer(f"q{i + 1} at 1, … 5 s", value, "rad", check[:, i], route, 1e-8, variant=of)


@ask("Underactuated, which torque makes q̈2 = 50 (α (2/π) atan q̇1 − q2) − 5 q̇2, and how does it move then?")
def linearized(case):
    """q̈2 is given, the first balance gives q̈1 without the torque, the second then the torque."""
    swing, times = math.radians(30) * 2 / math.pi, np.linspace(1, 5, 5)

    def accelerations(y):
        a, spin = np.cumsum(y[:2]), np.cumsum(y[2:])
        given = 50 * (swing * math.atan(y[2]) - y[1]) - 5 * y[3]
        mass, bias = TWO.mass(a), TWO.bias(a, spin)
        free = -(mass.sum(axis=0)[1] * given + bias.sum()) / mass.sum()  # both links about the shoulder
        torque = mass[1] @ [free, free + given] + bias[1]
        return free, given, torque

    law = {"q2": {"is": "50*(pi/6*(2/pi)*atan(rate(q1)/(1 rad/s)) - q2) - 5*rate(q2)", "level": "acceleration"}}
    start = {"q1": -math.pi / 2 + 0.1, "q2": 0, "at_rest": True}
    given = case.mechanism("underactuated.yaml").inverse(law, until=5, initial=start)
    check = motion(lambda t, y: [*y[2:], *accelerations(y)[:2]], [start["q1"], 0, 0, 0], times)
    route = "other route: moments about shoulder and elbow, integrated by SciPy"
    for i in (0, 1):
        yield Answer(f"q{i + 1} at 1, … 5 s", given.run.evaluate(f"q{i + 1}", times), "rad", check[:, i], route, 1e-7)
    value = given.evaluate("'motion of q2'.force", times)
    yield Answer("torque at 1, … 5 s", value, "N·m", [accelerations(y)[2] for y in check], route, 1e-6)
