"""GEN-STEP: person, one foot on the ground.

Nine unknowns: the back foot's place and the direction of every body, ccw. A point is the back foot plus an arm of every body
on the way to it, so its velocity has a column for every unknown; with the columns of the mass centres, virtual power gives M
z̈ = f, and the columns of the feet hold them or load them. A motor turns one body by τ = K(q0 − q) − cq̇ and the other by
−τ.

A strike without bounce: M(ż+ − ż−) = the columns of the feet that take part, times their impulses. With the back foot hinged
and the other one rough, both are at rest after it. On the floor with friction the striking foot slides on with |T| = μN
where it would take more to stop it, and the old foot is free to leave: it does, for its velocity after the strike is upward.
Standing on both, the loop is closed; a foot slides from |T| = μN on and lifts off at N = 0. Nothing but the feet touches the
floor.
"""

from functools import partial
from math import acos, atan, hypot

import numpy as np
from scipy.optimize import brentq

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import event, motion

G, A, B, MU = 9.81, 0.42, 0.43, 0.6
BODIES = ["back_shank", "back_thigh", "trunk", "front_thigh", "front_shank", "arm[1]", "arm[2]"]
MASSES = np.array([4.0, 8, 35, 8, 4, 4, 4])
INERTIAS = np.array([0.06, 0.12, 1.2, 0.12, 0.06, 0.12, 0.12])
TO_HIP = {0: B, 1: A}  # arms along each body's axis, from the back foot on
CENTRES = [{0: B - 0.19}, {0: B, 1: A - 0.18}, TO_HIP | {2: 0.3}, TO_HIP | {3: -0.18}, TO_HIP | {3: -A, 4: -0.19},
           TO_HIP | {2: 0.6, 5: -0.28}, TO_HIP | {2: 0.6, 6: -0.28}]  # fmt: skip
BACK, FRONT = {}, TO_HIP | {3: -A, 4: -B}
JOINTS = [(1, 0), (2, 1), (3, 2), (4, 3), (5, 2), (6, 2)]
MOTORS = {"": {"K": 300.0, "c": 30.0}, "motors off": {"K": 0.0, "c": 0.0}}
FEET = {"model.yaml": "", "floor.yaml": "on a floor with friction 0.6"}
POWER = "closed form: virtual power"
SCIPY = "other route: virtual power, SciPy"


def posture():
    """The start: knees forward."""

    def leg(x, y):
        way, lean = hypot(x, y), atan(x / y)
        return lean + acos((A**2 + way**2 - B**2) / (2 * A * way)), lean - acos((B**2 + way**2 - A**2) / (2 * B * way))

    (thigh1, shank1), (thigh2, shank2) = leg(-0.15, 0.8), leg(0.15, 0.75)
    return np.array([-0.15, 0, shank1, thigh1, 0, thigh2, shank2, 0, 0])


REST = posture()


def columns(z, arms):
    """Velocity of a point for each unknown, and its acceleration when z̈ = 0."""
    J, bias = np.zeros((2, 9)), np.zeros(2)
    J[:, :2] = np.eye(2)
    for i, arm in arms.items():
        s, c = np.sin(z[2 + i]), np.cos(z[2 + i])
        J[:, 2 + i] = [-arm * c, -arm * s]
        bias -= z[11 + i] ** 2 * arm * np.array([-s, c])
    return J, bias


def place(z, arms):
    return z[:2] + sum((arm * np.array([-np.sin(z[2 + i]), np.cos(z[2 + i])]) for i, arm in arms.items()), np.zeros(2))


class Person:
    """Motion with given motors. ``held``: pairs of a foot and None where it sticks, or the sign of its velocity where it slides."""

    def __init__(self, K, c):
        self.K, self.c = K, c

    def loads(self, z):
        """Mass matrix, and what loads the unknowns beside the feet."""
        mass, f = np.zeros((9, 9)), np.zeros(9)
        mass[range(2, 9), range(2, 9)] = INERTIAS
        for m, arms in zip(MASSES, CENTRES, strict=True):
            J, bias = columns(z, arms)
            mass += m * J.T @ J
            f += m * J.T @ (np.array([0, -G]) - bias)
        for on, other in JOINTS:
            turn, rate = (z[o + on] - z[o + other] for o in (2, 11))
            torque = self.K * (REST[2 + on] - REST[2 + other] - turn) - self.c * rate
            f[2 + on] += torque
            f[2 + other] -= torque
        return mass, f

    def feet(self, z, held):
        """Columns by which the feet load, rows that hold them, and the bias of these."""
        load, rows, biases = [], [], []
        for arms, slides in held:
            J, bias = columns(z, arms)
            if slides is None:
                load += [J[0], J[1]]
                rows += [J[0], J[1]]
                biases += list(bias)
            else:
                load.append(J[1] - MU * slides * J[0])
                rows.append(J[1])
                biases.append(bias[1])
        return np.array(load), np.array(rows), np.array(biases)

    def solve(self, z, held):
        """z̈ and the forces of the feet: (Fx, Fy) of one that is held, N of one that slides."""
        mass, f = self.loads(z)
        load, rows, bias = self.feet(z, held)
        n = len(rows)
        both = np.linalg.solve(np.block([[mass, -load.T], [rows, np.zeros((n, n))]]), np.concatenate([f, -bias]))
        return both[:9], both[9:]

    def rates(self, held):
        return lambda _t, z: np.concatenate([z[9:], self.solve(z, held)[0]])

    def strike(self, z, held):
        """Rates after an impact without bounce, and the impulses."""
        mass, _ = self.loads(z)
        load, rows, _ = self.feet(z, held)
        n = len(rows)
        both = np.linalg.solve(np.block([[mass, -load.T], [rows, np.zeros((n, n))]]), np.concatenate([mass @ z[9:], np.zeros(n)]))
        return both[:9], both[9:], (z[9:] @ mass @ z[9:] - both[:9] @ mass @ both[:9]) / 2

    def strike_front(self, z):
        """The front foot alone: it sticks, or slides on with |T| = μN."""
        after, impulses, lost = self.strike(z, [(FRONT, None)])
        if abs(impulses[0]) > MU * impulses[1]:
            way = -np.sign(impulses[0])
            after, (up,), lost = self.strike(z, [(FRONT, way)])
            impulses = np.array([-MU * way * up, up])
        return after, impulses, lost

    def before_strike(self):
        start = np.concatenate([REST, np.zeros(9)])
        return event(self.rates([(BACK, None)]), start, lambda t, z: place(z, FRONT)[1], before=0.4)


def angles(run, t, text="angle"):
    return [float(run.evaluate(f"{text}({body})", t)) for body in BODIES]


def state(run, t):
    """All unknowns and their rates of a run."""
    foot = [float(run.evaluate(f"{text}(back_shank.F)", t)) for text in ("x", "y", "vx", "vy")]
    return np.array([*foot[:2], *angles(run, t), *foot[2:], *angles(run, t, "omega")])


def first(run, kind, name, after=0.0):
    return next(c for c in run.changes if c.kind == kind and name in c.of and c.t > after)


@ask("What are the accelerations and the force of the foot at rest on the back foot?")
def instant(case):
    for file in ("model.yaml", "floor.yaml"):
        now = case.instant(file)
        turning, force = Person(300, 30).solve(np.concatenate([REST, np.zeros(9)]), [(BACK, None)])
        value = [now[f"alpha({body})"] for body in BODIES]
        yield Answer("angular accelerations", value, "rad/s²", turning[2:], POWER, 1e-11, variant=FEET[file])
        value, says = [now["foot.Fx"], now["foot.Fy"]], "The floor pushes the back foot with ({}, {})."
        yield Answer("floor on the back foot", value, "N", force, POWER, 1e-11, says=says, variant=FEET[file])


@ask("How does it move on the back foot with the joint torques, and when does the other one strike?")
def single(case):
    for of, motors in MOTORS.items():
        person = Person(**motors)
        when, _ = person.before_strike()
        times = [when * n / 4 for n in (1, 2, 3)]
        held = [(BACK, None)]
        check = motion(person.rates(held), np.concatenate([REST, np.zeros(9)]), times)
        force = np.array([person.solve(z, held)[1] for z in check])
        for file in ("model.yaml", "floor.yaml"):
            run, label = case.run(file, motors, until=0.3), ", ".join(filter(None, (of, FEET[file])))
            for i, t in enumerate(times):
                told = f"angles of the bodies at {t:.3f} s"
                yield Answer(told, angles(run, t), "rad", check[i, 2:9], SCIPY, 1e-9, variant=label)
            for i, text in enumerate(("foot.Fx", "foot.Fy")):
                yield Answer(f"{text} then", run.evaluate(text, times), "N", force[:, i], SCIPY, 1e-8, variant=label)
            hit, says = first(run, "impact", "other").t, "The other foot strikes after {}."
            yield Answer("strike", hit, "s", when, SCIPY, 1e-9, says=says, variant=label)


@ask("What does the strike do with the back foot hinged, where it closes the loop?")
def closed(case):
    for of, motors in MOTORS.items():
        person = Person(**motors)
        _, z = person.before_strike()
        both = [(BACK, None), (FRONT, None)]
        after, impulses, lost = person.strike(z, both)
        run = case.run("model.yaml", motors, until=0.3)
        hit = first(run, "impact", "other")
        yield Answer("rates after it", angles(run, hit.t, "omega"), "rad/s", after[2:], POWER, 1e-8, variant=of)
        [(along, up)] = hit.impulses.contacts.values()
        says = "The impulse on the front foot is ({}, {})."
        yield Answer("front foot", [along, up], "N·s", impulses[2:], POWER, 1e-8, says=says, variant=of)
        value, says = hit.impulses.joints["foot"][:2], "That on the back foot is ({}, {})."
        yield Answer("back foot", value, "N·s", impulses[:2], POWER, 1e-8, says=says, variant=of)
        yield Answer("energy lost", hit.lost, "J", lost, POWER, 1e-8, variant=of)
        z[9:] = after
        force = person.solve(z, both)[1]
        value = [run.evaluate(text, hit.t) for text in ("foot.Fx", "foot.Fy", "other.T", "other.N")]
        says = "Just after, the back foot is pushed with ({}, {}), the front foot with ({}, {})."
        yield Answer("forces", value, "N", force, POWER, 1e-7, says=says, variant=of)
        later = motion(person.rates(both), z, [0.02])[0]
        value = angles(run, hit.t + 0.02)
        yield Answer("angles 0.02 s after", value, "rad", later[2:9], SCIPY, 1e-8, variant=of)


@ask("What does the strike do on a floor with friction 0.6, and does the old foot leave?")
def leaves(case):
    for of, motors in MOTORS.items():
        person = Person(**motors)
        _, z = person.before_strike()
        after, impulses, lost = person.strike_front(z)
        run = case.run("floor.yaml", motors, until=0.3)
        hit = first(run, "impact", "other")
        [(along, up)] = hit.impulses.contacts.values()
        yield Answer("rates after it", angles(run, hit.t, "omega"), "rad/s", after[2:], POWER, 1e-8, variant=of)
        says = "The impulse on the front foot is ({}, {})."
        yield Answer("front foot", [along, up], "N·s", impulses, POWER, 1e-8, says=says, variant=of)
        yield Answer("energy lost", hit.lost, "J", lost, POWER, 1e-8, variant=of)
        old = after[:2]
        value, says = [run.evaluate(f"{v}(back_shank.F)", hit.t) for v in ("vx", "vy")], "The old foot moves off at ({}, {})."
        yield Answer("old foot", value, "m/s", old, POWER, 1e-8, says=says, variant=of)
        back = first(run, "impact", "foot", hit.t).t - hit.t
        z[9:] = after
        feet = [(FRONT, None if abs(impulses[0]) < MU * impulses[1] else -np.sign(impulses[0]))]
        height = partial(lambda person, z, feet, t: motion(person.rates(feet), z, [t])[0][1], person, z, feet)
        check, says = brentq(height, 0.5 * back, 2 * back, xtol=1e-16), "It comes down after {}."
        yield Answer("comes down", back, "s", check, SCIPY, 1e-7, says=says, variant=of)
        gone = [c.kind for c in run.changes if c.t == hit.t and c.of == ("foot",)]
        yield Answer("the old foot leaves", gone == ["lift-off"], check=bool(old[1] > 0), against=POWER, variant=of)


def held_until(person, z, held, foot, what):
    """From a state to where a held foot slips or a foot lifts off: time and state. ``foot`` counts in ``held``."""
    place = sum(2 if slides is None else 1 for _, slides in held[:foot])

    def left(_t, z):
        force = person.solve(z, held)[1][place:]
        return MU * force[1] - abs(force[0]) if what == "slip" else force[0] if held[foot][1] is not None else force[1]

    return event(person.rates(held), z, left, before=1.5)


@ask("When do the feet slip and lift off on the floor?")
def slips(case):
    """From the run's own state once both feet stand: what becomes of it, by the other route."""
    plans = {
        "": (0.25, ["slip foot"]),
        "motors off": (0.15, ["slip foot", "lift-off foot", "slip other", "lift-off other"]),
    }
    for of, (t, plan) in plans.items():
        person, run = Person(**MOTORS[of]), case.run("floor.yaml", MOTORS[of], until=0.7)
        z, held = state(run, t), {"foot": None, "other": None}
        arms = {"foot": BACK, "other": FRONT}
        for step in plan:
            what, name = step.split()
            feet = [(arms[n], slides) for n, slides in held.items()]
            span, z = held_until(person, z, feet, list(held).index(name), what)
            begin, t = t, t + span
            label = f"{what} of the {'back' if name == 'foot' else 'front'} foot"
            yield Answer(label, first(run, what, name, begin).t, "s", t, SCIPY, 1e-8, variant=of)
            yield Answer("angles of the bodies then", angles(run, t), "rad", z[2:9], SCIPY, 1e-8, variant=of)
            if what == "slip":
                force = person.solve(z, feet)[1][2 * list(held).index(name) :]
                held[name] = -np.sign(force[0])
            else:
                del held[name]
