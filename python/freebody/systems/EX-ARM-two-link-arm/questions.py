"""Two-link robot arm.

Moments of both links about the shoulder O and of the forearm about the elbow E hold no reaction. With
e_i = (cos θi, sin θi) and b = m2 l2 l3:

    forearm about E:  C θ̈2 + b cos(θ2 − θ1) θ̈1 + b sin(θ2 − θ1) θ̇1² = M_e − m2 g l2 cos θ2
    both about O, less that:  A θ̈1 + b cos(θ2 − θ1) θ̈2 − b sin(θ2 − θ1) θ̇2² = M_s − M_e − (m1 l1 + m2 l3) g cos θ1

with A = I1 + m1 l1² + m2 l3² and C = I2 + m2 l2². The force at a hinge is what the links beyond it need.
"""

import numpy as np

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import motion

M1, M2, L1, L2, L3, I1, I2 = 2.0, 1.5, 0.25, 0.2, 0.5, 0.05, 0.03
A, B, C = I1 + M1 * L1**2 + M2 * L3**2, M2 * L2 * L3, I2 + M2 * L2**2
DOWN = (0.0, -9.81)
STATES = {"released": (30, 0, -20, 0, 0, 0), "moving": (30, 1.2, 75, -0.8, 6, 2)}


def along(angle):
    return np.array([np.cos(angle), np.sin(angle)])


def across(angle):
    return np.array([-np.sin(angle), np.cos(angle)])


def accelerations(q, u, shoulder, elbow, gravity=DOWN):
    """θ̈1, θ̈2 from the two moment balances."""
    c, s = np.cos(q[1] - q[0]), np.sin(q[1] - q[0])
    weight1, weight2 = (M1 * L1 + M2 * L3) * across(q[0]) @ gravity, M2 * L2 * across(q[1]) @ gravity
    right = [shoulder - elbow + weight1 + B * s * u[1] ** 2, elbow + weight2 - B * s * u[0] ** 2]
    return np.linalg.solve([[A, B * c], [B * c, C]], right)


def hinge_forces(q, u, a, gravity=DOWN):
    """Force on the upper arm at O and on the forearm at E."""
    link = [a[i] * across(q[i]) - u[i] ** 2 * along(q[i]) for i in (0, 1)]
    elbow = M2 * (L3 * link[0] + L2 * link[1] - gravity)
    return M1 * (L1 * link[0] - gravity) + elbow, elbow


def forces(now):
    return [now[text] for text in ("shoulder.Fx", "shoulder.Fy", "elbow.Fx", "elbow.Fy")]


def instant(case, state, gravity=DOWN, variant=""):
    q, u = np.radians([state[0], state[2]]), (state[1], state[3])
    parameters = {"Ms": state[4], "Me": state[5], "gx": gravity[0], "gy": gravity[1]}
    now = case.instant(parameters=parameters, theta1=q[0], theta2=q[1], rates={"theta1": u[0], "theta2": u[1]})
    check = accelerations(q, u, *state[4:], gravity)
    values, against = [now["accel(theta1)"], now["accel(theta2)"]], "closed form: moments about O and E"
    yield Answer("θ̈1, θ̈2", values, "rad/s²", check, against, 1e-12, variant=variant)
    check = np.concatenate(hinge_forces(q, u, check, gravity))
    says, against = "The upper arm gets ({}, {}) at O, the forearm ({}, {}) at E.", "closed form: momentum of the links beyond"
    yield Answer("forces at O and E, x and y", forces(now), "N", check, against, 1e-12, says=says, variant=variant)


@ask("Which two equations hold no reaction?")
def equations(case):
    forearm = "(I2 + m2*l2^2)*accel(theta2) + m2*l2*l3*(cos({0})*accel(theta1) + sin({0})*rate(theta1)^2)".format(
        "theta2 - theta1"
    )
    forearm += " - Me - m2*l2*(gy*cos(theta2) - gx*sin(theta2))"
    rest = "(I1 + m1*l1^2 + m2*l3^2)*accel(theta1) + m2*l2*l3*(cos({0})*accel(theta2) - sin({0})*rate(theta2)^2)".format(
        "theta2 - theta1"
    )
    rest += " - Ms + Me - (m1*l1 + m2*l3)*(gy*cos(theta1) - gx*sin(theta1))"
    yield from case.balances([f"{forearm} + {rest}", forearm], "closed form: moments about O and E")


@ask("Which torques hold the arm straight out?")
def symbolically(case):
    closed = {"elbow motor": "m2*g*l2", "shoulder motor": "g*(m1*l1 + m2*(l3 + l2))"}
    yield from case.symbolically(closed, "statics: moments about elbow and shoulder", "held.yaml")
    now = case.instant("held.yaml")
    check = [9.81 * (M1 * L1 + M2 * (L3 + L2)), 9.81 * M2 * L2]
    values = [now["'shoulder motor'.force"], now["'elbow motor'.force"]]
    yield Answer("M_s, M_e", values, "N·m", check, "statics: moments about elbow and shoulder", 1e-13)


@ask("What are the accelerations and the forces at O and E just released at θ1 = 30°, θ2 = −20°?")
def released(case):
    yield from instant(case, STATES["released"])


@ask("What are they at θ1 = 30°, θ̇1 = 1.2, θ2 = 75°, θ̇2 = −0.8 with M_s = 6, M_e = 2 N·m?")
def moving(case):
    yield from instant(case, STATES["moving"])
    yield from instant(case, STATES["moving"], gravity=(9.81, 0.0), variant="gravity to the right")


@ask("How does it move for 2 s from rest with M_s = 1, M_e = 0.5 N·m, and do the motors do the work that its energy grows by?")
def driven(case):
    run = case.run(parameters={"Ms": 1, "Me": 0.5})
    times = np.array([0.5, 1.0, 1.5, 2.0])
    start = np.radians([-90, -60])
    check = motion(lambda t, y: [*y[2:], *accelerations(y[:2], y[2:], 1, 0.5)], [*start, 0, 0], times)
    for i, name in enumerate(("theta1", "theta2"), 1):
        yield Answer(
            f"θ{i} at 0.5, 1, 1.5, 2 s",
            run.evaluate(name, times),
            "rad",
            check[:, i - 1],
            "other route: moments about O and E, integrated by SciPy",
            1e-10,
        )
    turned = check[:, :2] - start
    work = 1.0 * turned[:, 0] + 0.5 * (turned[:, 1] - turned[:, 0])
    done = run.evaluate("'shoulder motor'.work", times) + run.evaluate("'elbow motor'.work", times)
    yield Answer("work of the motors", done, "J", work, "closed form: torques times angles turned", 1e-10)
    gained = run.evaluate("energy()", times) - run.evaluate("energy()", 0.0)
    yield Answer("energy gained", gained, "J", work, "closed form: torques times angles turned", 1e-10)


@ask("Is the motion the same with the elbow angle measured from the upper arm?")
def relative(case):
    torques = {"Ms": 1, "Me": 0.5}
    times = np.array([0.5, 1.0, 1.5, 2.0])
    one, other = case.run(parameters=torques), case.run("relative.yaml", torques)
    for text, unit in (("x(forearm.G)", "m"), ("y(forearm.G)", "m"), ("elbow.F", "N")):
        value, check = other.evaluate(text, times), one.evaluate(text, times)
        yield Answer(f"{text} at 0.5, 1, 1.5, 2 s", value, unit, check, "other route: absolute angles", 1e-10)
