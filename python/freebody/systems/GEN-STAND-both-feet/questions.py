"""Person with both feet on the ground, a closed chain.

Moments of the whole about the feet give the vertical forces; a horizontal force H, forward on the back foot and backward on the front
one, is free. With it the torque at a knee is that of the foot's force and the shank's weight about it, that at a hip follows from the
whole leg: four torques, each affine in H, of which the sum of squares is least at one H. The falling motion comes from five free bars
with twelve constraints of position, differentiated twice, integrated by SciPy.
"""

import math

import numpy as np

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import motion

A, B, D, HIGH, G = 0.42, 0.43, 0.15, 0.8, 9.81
MOTORS = ["back knee motor", "back hip motor", "front hip motor", "front knee motor"]
STATICS = "statics: the whole about the feet, a shank about its knee, a leg about the hip"
MASS, INERTIA = np.array([4, 8, 35, 8, 4.0]), np.array([0.06, 0.12, 1.2, 0.12, 0.06])
WEIGHT = MASS.sum() * G


def along(angle):
    """The direction of an angle from straight down, counter-clockwise."""
    return np.array([math.sin(angle), -math.cos(angle)])


def leg(side):
    """Angles of thigh and shank from straight down: the triangle of hip, knee and foot, knee forward."""
    reach = math.hypot(D, HIGH)
    line = side * math.atan(D / HIGH)
    thigh = line + math.acos((A**2 + reach**2 - B**2) / (2 * A * reach))
    return thigh, line - math.acos((B**2 + reach**2 - A**2) / (2 * B * reach))


def turn(arm, force):
    return arm[0] * force[1] - arm[1] * force[0]


def foot_forces():
    """Vertical forces on the back and front foot: moments of all weights about each."""
    moment = 0.0  # of the trunk none: it stands over the middle
    for side in (-1, 1):
        thigh, shank = leg(side)
        knee = A * along(thigh)
        moment += 8 * 0.18 * along(thigh)[0] + 4 * (knee + 0.19 * along(shank))[0]
    front = WEIGHT / 2 + G * moment / (2 * D)
    return WEIGHT - front, front


def torques(horizontal):
    """The motors' torques, in their order, where the ground pushes the back foot forward by ``horizontal``, the front foot back."""
    found = {}
    for side, vertical, push in ((-1, foot_forces()[0], horizontal), (1, foot_forces()[1], -horizontal)):
        thigh, shank = leg(side)
        foot = np.array([push, vertical])
        shank_weight, thigh_weight = np.array([0, -4 * G]), np.array([0, -8 * G])
        knee = A * along(thigh)
        on_shank = -turn(B * along(shank), foot) - turn(0.19 * along(shank), shank_weight)  # about the knee, by the thigh
        arms = knee + B * along(shank), knee + 0.19 * along(shank), 0.18 * along(thigh)
        on_leg = -sum(turn(arm, f) for arm, f in zip(arms, (foot, shank_weight, thigh_weight), strict=True))  # about the hip
        found[side] = on_shank, on_leg
    # The back motors turn the thigh against the shank and the trunk against the thigh; the front ones thigh and shank themselves.
    return np.array([-found[-1][0], -found[-1][1], found[1][1], found[1][0]])


def least():
    """The horizontal force and the torques of least sum of squares."""
    start, slope = torques(0.0), torques(1.0) - torques(0.0)
    push = -(start @ slope) / (slope @ slope)
    return push, start + push * slope


# Five bars (back shank, back thigh, trunk, front thigh, front shank), angles from straight down; of the trunk, points lie upwards.
PINS = [  # bar and place along it, and the bar or the ground to which it is pinned
    ((0, B), (-D, 0.0)), ((0, 0.0), (1, A)), ((1, 0.0), (2, 0.0)), ((1, 0.0), (3, 0.0)), ((3, A), (4, 0.0)), ((4, B), (D, 0.0)),
]  # fmt: skip
CENTRE = [0.19, 0.18, -0.3, 0.18, 0.19]


def constrained(q, u):
    """Accelerations (15,) and multipliers (12,) of the five bars from their places and rates: x, y of the centre and angle each."""
    rows, right = np.zeros((12, 15)), np.zeros(12)
    for k, (one, other) in enumerate(PINS):
        for sign, (bar, place) in ((1, one), (-1, other)) if isinstance(other[0], int) else ((1, one),):
            angle, rate, arm = q[3 * bar + 2], u[3 * bar + 2], place - CENTRE[bar]
            rows[2 * k : 2 * k + 2, 3 * bar : 3 * bar + 2] += sign * np.eye(2)
            rows[2 * k : 2 * k + 2, 3 * bar + 2] += sign * arm * np.array([math.cos(angle), math.sin(angle)])
            right[2 * k : 2 * k + 2] += sign * arm * rate**2 * along(angle)
    mass = np.diag(np.column_stack([MASS, MASS, INERTIA]).ravel())
    load = np.column_stack([0 * MASS, -G * MASS, 0 * MASS]).ravel()
    solved = np.linalg.solve(np.block([[mass, rows.T], [rows, np.zeros((12, 12))]]), np.concatenate([load, right]))
    return solved[:15], solved[15:]


def standing():
    """The places of the five bars at the start."""
    hip, q = np.array([0, HIGH]), []
    (back_thigh, back_shank), (front_thigh, front_shank) = leg(-1), leg(1)
    knees = hip + A * along(back_thigh), hip + A * along(front_thigh)
    for angle, top, place in zip(
        (back_shank, back_thigh, 0.0, front_thigh, front_shank), (knees[0], hip, hip, hip, knees[1]), CENTRE, strict=True
    ):
        q += [*(top + place * along(angle)), angle]
    return np.array(q)


@ask("How many degrees of freedom are there?")
def freedoms(case):
    found, says = case.instant().freedom, "There are {} degrees of freedom."
    yield Answer("freedom", found, "", 5 * 3 - 6 * 2, "count: five bodies, six pins", 0.0, says=says)


@ask("Are the holding torques unique?")
def unique(case):
    """They are not: one combination of them changes the horizontal forces on the feet and nothing else."""
    holding = case.mechanism().inverse("rest", MOTORS, least=True)
    free = holding.found(0.0).free
    slope = torques(1.0) - torques(0.0)
    count = free.shape[1]
    says = "They are not: {} combination of them is free." if count else "They are: {} combinations are free."
    yield Answer("combinations", count, "", 1, STATICS, 0.0, says=says)
    way = free[:, 0] / free[0, 0]
    says = "At back knee, back hip, front hip and front knee a multiple of {}, {}, {}, {} can be added."
    yield Answer("what can be added", way, "", slope / slope[0], STATICS, 1e-10, says=says)


@ask("Which holding torques have the least sum of squares, and what do the feet carry then?")
def holding(case):
    found = case.mechanism().inverse("rest", MOTORS, least=True)
    push, check = least()
    yield Answer("torques at back knee, back hip, front hip, front knee", found.found(0.0).forces, "N·m", check, STATICS, 1e-10)
    back, front = foot_forces()
    texts = ["back_foot.Fx", "back_foot.Fy", "front_foot.Fx", "front_foot.Fy"]
    value = found.values(texts, np.array([0.0]))[0]
    says = "The ground pushes the back foot with ({}, {}) then, the front foot with ({}, {})."
    yield Answer("forces on the feet", value, "N", [push, back, -push, front], STATICS, 1e-10, says=says)


@ask("How does the person collapse with no torques?")
def collapse(case):
    start = standing()
    now, (accelerations, forces) = case.instant(), constrained(start, np.zeros(15))
    value = [now[f"alpha({bar})"] for bar in ("back_shank", "back_thigh", "trunk", "front_thigh", "front_shank")]
    route = "other route: five free bars with twelve constraints"
    yield Answer("angular accelerations at release, back foot to front foot", value, "rad/s²", accelerations[2::3], route, 1e-11)
    value = [now[text] for text in ("back_foot.Fx", "back_foot.Fy", "front_foot.Fx", "front_foot.Fy")]
    says = "The ground pushes the back foot with ({}, {}), the front foot with ({}, {})."
    yield Answer("forces on the feet", value, "N", -forces[[0, 1, 10, 11]], route, 1e-11, says=says)
    times = np.array([0.1, 0.2])
    run = case.run(until=0.2)
    check = motion(lambda t, y: [*y[15:], *constrained(y[:15], y[15:])[0]], [*start, *np.zeros(15)], times)
    value = np.concatenate([run.evaluate("x(trunk.G)", times), run.evaluate("y(trunk.G)", times)])
    yield Answer("x, then y of the trunk's centre at 0.1, 0.2 s", value, "m", check[:, [6, 7]].T.ravel(), f"{route}, SciPy", 1e-9)


@ask("With all joints locked, which components of the foot forces are determinate?")
def locked(case):
    now, text = case.instant("locked.yaml"), "statics: two pins under one rigid body leave the force along their line open"
    for foot, vertical in zip(("back_foot", "front_foot"), foot_forces(), strict=True):
        for part, known, check in zip(("Fx", "Fy"), now.reactions[foot].determined, (False, True), strict=False):
            says = f"{part} of the {foot.replace('_', ' ')} is {'' if known else 'not '}determinate."
            yield Answer(part, known, check=check, against=text, tolerance=0.0, says=says)
        yield Answer("Fy", now[f"{foot}.Fy"], "N", vertical, STATICS, 1e-12, says="Fy is {}.")
