"""Five steps: free-body diagrams, configuration, balances, solved, integrated; three systems taken through all of them.

``freebody equations systems/EX-ARM-two-link-arm/model.yaml`` prints the derivation. By hand every mass centre is a sum of circular
motions and of one along a line, Σ c e^(i (b + q)), so its velocity is Σ J_k q̇_k; virtual power of all bodies gives
M = Re Σ m J̄ Jᵀ + Σ I, and the rest likewise of weights, couples and of −c q̇² e^(i (b + q)).
"""

from cmath import exp
from math import pi

import numpy as np

from freebody.catalogue import Answer, ask
from freebody.catalogue.answers import formula
from freebody.catalogue.reference import motion
from freebody.document.blocks import Equation, Written
from freebody.equations.topics import topic

SLOPE = np.radians(20)
POWER = "other route: virtual power of sums of circular motions"


class ByHand:
    """Two coordinates; bodies by mass, inertia about the centre, and the circles (c, b) about which each coordinate turns them."""

    def __init__(self, names, bodies, start, slide=None, until=2.0):
        self.names, self.bodies, self.start, self.slide = names, bodies, start, slide
        self.times = np.linspace(0.2, until, 5)

    def circles(self, q, circles):
        """J of each coordinate, and what J̇ q̇ is for a unit of q̇²."""
        turning = [c * exp(1j * (b + x)) for (c, b), x in zip(circles, q, strict=True)]
        if self.slide is None:
            return np.array([1j * z for z in turning]), -np.array(turning)
        return np.array([circles[0][0] * exp(-1j * self.slide), 1j * turning[1]]), np.array([0, -turning[1]])

    def system(self, q, u):
        matrix, right = np.zeros((2, 2)), np.zeros(2)
        for mass, inertia, circles in self.bodies:
            J, bent = self.circles(q, circles)
            matrix += mass * (J.conj()[:, None] * J).real + np.diag(inertia)
            right -= mass * (J.conj() * (bent @ np.square(u) + 9.81j)).real
        return matrix, right

    def accelerations(self, q, u):
        return np.linalg.solve(*self.system(q, u))

    def inertia(self, q, u):
        """m a of every body, x and y."""
        a = self.accelerations(q, u)
        found = [(m, *self.circles(q, circles)) for m, _, circles in self.bodies]
        return [m * (J @ a + bent @ np.square(u)) for m, J, bent in found]


ROD = 1 / 12
SYSTEMS = {
    "EX-ARM": ByHand(("theta1", "theta2"), [(2, (0.05, 0), [(0.25, 0), (0, 0)]), (1.5, (0, 0.03), [(0.5, 0), (0.2, 0)])],
                     (-pi / 2, -pi / 3)),
    "S19.18": ByHand(("s", "theta"), [(2, (0, 0), [(1, 0), (0, 0)]), (1, (0, 0), [(1, 0), (0.5, -pi / 2 - SLOPE)])], (0, 0.6),
                     slide=SLOPE),
    "19.3.28": ByHand(("phi1", "phi2"), [(1, (ROD, 0), [(0.5, -pi / 2), (0, 0)]),
                                         (1, (0, ROD), [(1, -pi / 2), (0.5, -pi / 2)])], (0, pi / 2)),
}  # fmt: skip
STATE = ((0.4, 1.1), (0.7, -1.3))


def model(name):
    return f"{name}/model"


def moving(case, name):
    """An instant on the way."""
    (q, u), names = STATE, SYSTEMS[name].names
    return dict(zip(names, q, strict=True)) | {"rates": dict(zip(names, u, strict=True))}


@ask("1. On the free-body diagram of each object, what do its forces come to?")
def diagrams(case):
    for name, hand in SYSTEMS.items():
        free = case.mechanism(model(name)).free_bodies(**moving(case, name))
        for body, check in zip(free.bodies.values(), hand.inertia(*STATE), strict=True):
            parts = [load.value * part.wrench(body.G) for load in free.loads for part in load.on if part.body == body.name]
            says = f"The forces on {body.name} come to ({{}}, {{}}), its m a."
            yield Answer(body.name, sum(parts)[:2], "N", [check.real, check.imag], POWER, 1e-11, says=says, variant=name)


@ask("2. Are there as many configuration variables as degrees of freedom?")
def configuration(case):
    for name, hand in SYSTEMS.items():
        now = case.instant(model(name), **moving(case, name))
        value, says = [now.freedom, len(now.accelerations)], "{} degrees of freedom, {} variables"
        yield Answer(name, value, "", [2, len(hand.names)], "closed form: two circles or lines", 0.0, says=says, variant=name)


@ask("2. What are the named terms of the acceleration of a point, seen from a moving body?")
def terms(case):
    """v_rel = c (q̇₂ − q̇₁) across the second arm; 2 ω × v_rel lies along it; seen from the cart there is none."""
    arm, bar = "rate(theta2) - rate(theta1)", "rate(phi2) - rate(phi1)"
    closed = {
        "EX-ARM": {"a_rel": [f"-l2*({arm})^2", "l2*(accel(theta2) - accel(theta1))"],
                   "2 ω × v_rel": [f"-2*l2*rate(theta1)*({arm})"]},
        "S19.18": {"a_O′": ["accel(s)"], "a_rel": ["-l*rate(theta)^2", "l*accel(theta)"]},
        "19.3.28": {"a_rel": [f"-l/2*({bar})^2", "l/2*(accel(phi2) - accel(phi1))"],
                    "2 ω × v_rel": [f"-l*rate(phi1)*({bar})"]},
    }  # fmt: skip
    for name, parts in closed.items():
        document = topic(case.mechanism(model(name)), "frame")
        told = {
            each.left.text: each.right
            for each in reversed(document.blocks)  # first along the directions that turn
            if isinstance(each, Equation) and isinstance(each.left, Written)
        }
        for word, trees in parts.items():
            for (tree, unit), text in zip(told[word].components, trees, strict=True):
                yield formula(
                    f"{name}: {word} along {unit}", tree, text, "closed form: 2 ω × v_rel and circles", document.letters
                )


@ask("3. How many momentum balances without reactions are there, with how many unknowns?")
def balances(case):
    for name in SYSTEMS:
        found = case.mechanism(model(name)).equations()
        value = [len(found.equations), len(found.unknowns), sum(1 for x in found.unknowns if not x.dots)]
        says = "{} equations, {} unknowns, {} of them reactions"
        yield Answer(name, value, "", [2, 2, 0], "count: degrees of freedom", 0.0, says=says, variant=name)


@ask("3. Is a line of a derivation by hand marked as right, and with a sign changed as wrong?")
def marked(case):
    lines = {
        "EX-ARM": "(I2 + m2*l2^2) θ̈2 + m2*l2*l3 θ̈1 cos(θ2 - θ1) {} m2*l2*l3 θ̇1^2 sin(θ2 - θ1) = Me + m2*l2 (gy cosθ2 - gx sinθ2)",
        "S19.18": "l θ̈ {} s̈ cosθ = -g sin(θ - slope)",
        "19.3.28": "l φ̈2/3 + l/2 (φ̈1 cos(φ2 - φ1) {} φ̇1^2 sin(φ2 - φ1)) = -g/2 sinφ2",
    }
    for name, line in lines.items():
        mechanism = case.mechanism(model(name))
        for label, sign, right in (("as derived", "+", True), ("with the sign changed", "-", False)):
            value, against = mechanism.check(line.format(sign)).ok, "angular momentum of the last body"
            yield Answer(label, value, check=right, against=against, tolerance=0.0, variant=name)


@ask("4. What are the second derivatives symbolically, and in limits?")
def solved(case):
    swing = "m*sin(theta)*(l*rate(theta)^2 + g*cos(theta)*{})/(M + m*sin(theta)^2)"
    closed = {
        "s": "g*sin(slope) + " + swing.format("cos(slope)"),
        "s, M → inf": "g*sin(slope)",
        "s, slope → 0": swing.format("1"),
    }
    yield from case.symbolically(closed, "closed form: elimination of θ̈ by hand", model("S19.18"), of="S19.18")
    alone = {"theta1, m2 → 0": "(Ms - Me + gy*m1*l1*cos(theta1) - gx*m1*l1*sin(theta1))/(I1 + m1*l1^2)"}
    yield from case.symbolically(alone, "closed form: the upper arm alone", model("EX-ARM"), of="EX-ARM")
    released = {"phi1": "0", "phi2": "-3*g/(2*l)", "elbow.Fy": "m*g/4", "ceiling.Fy": "5*m*g/4"}
    state = {"phi1": 0, "phi2": "90 deg"}
    yield from case.symbolically(released, "closed form", model("19.3.28"), of="19.3.28", at_rest=True, set=state)


@ask("4. What are they in numbers, on the way?")
def numbers(case):
    for name, hand in SYSTEMS.items():
        now = case.instant(model(name), **moving(case, name))
        value = [now.accelerations[each] for each in hand.names]
        label, check = f"second derivatives of {' and '.join(hand.names)}", hand.accelerations(*STATE)
        yield Answer(label, value, "SI", check, POWER, 1e-12, variant=name)


@ask("5. What is the motion, set up and integrated?")
def integrated(case):
    for name, hand in SYSTEMS.items():
        run = case.run(model(name))
        start = [*hand.start, 0.0, 0.0]
        check = motion(lambda _t, y, by=hand: (y[2], y[3], *by.accelerations(y[:2], y[2:])), start, hand.times)
        for k, each in enumerate(hand.names):
            label = f"{each} at 0.2 … {hand.times[-1]:g} s"
            yield Answer(label, run.evaluate(each, hand.times), "SI", check[:, k], f"{POWER}, SciPy", 1e-8, variant=name)
