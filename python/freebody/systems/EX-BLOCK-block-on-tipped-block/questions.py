"""Block on a tipped block.

Without friction the slope pushes along its normal n = (−sin θ, cos θ) only, so two balances hold no unknown force:
both blocks along x, and the upper one down the slope, d = (−cos θ, −sin θ):

    (m1 + m2) ẍ − m2 cos θ ÿ = 0,        m2 (ÿ − cos θ ẍ) = m2 g sin θ.

The forces follow one after another. N = F_C + F_D from the upper block along n; its share at C and D from moments
about G2, 0.15 F_C = 0.10 F_D; F_A + F_B from the lower block along y; its share from moments about G1, where N acts
at the foot of the normal through G2, Q + y d.
"""

import numpy as np

from freebody.catalogue import Answer, ask

M1, M2, G, TIP = 10.0, 4.0, 9.81, np.radians(30)
N, D = np.array([-np.sin(TIP), np.cos(TIP)]), np.array([-np.cos(TIP), -np.sin(TIP)])
A_AND_B, C_AND_D = ("wheels.Fn - wheels.M/1.2", "wheels.M/1.2"), ("rollers.Fn - rollers.M/0.25", "rollers.M/0.25")
PLACES = (0.0, 0.1, 0.3)


def accelerations():
    """ẍ and ÿ from the two balances without reactions."""
    matrix = [[M1 + M2, -M2 * np.cos(TIP)], [-M2 * np.cos(TIP), M2]]
    return np.linalg.solve(matrix, [0, M2 * G * np.sin(TIP)])


def forces(y, shares):
    """F_A, F_B, F_C, F_D; ``shares``: the parts of N at C and D."""
    x2, y2 = accelerations()
    normal = M2 * ((np.array([x2, 0]) + y2 * D) @ N + G * np.cos(TIP))
    total = M1 * G + normal * np.cos(TIP)
    foot = np.array([0.3, 0.35]) + y * D
    turning = -normal * (foot[0] * N[1] - foot[1] * N[0])
    difference = -turning / 0.6
    return (total - difference) / 2, (total + difference) / 2, shares[0] * normal, shares[1] * normal


def rollers_below(case):
    """The same with C and D on the lower block."""
    for y in PLACES:
        now, of = case.instant("rollers_on_lower.yaml", y=y), f"rollers fixed to the lower block, y = {y:g}"
        values, against = [now["accel(x)"], now["accel(y)"]], "closed form: two balances without reactions"
        yield Answer("ẍ, ÿ", values, "m/s²", accelerations(), against, 1e-13, variant=of)
        # The reaction is on the second body, here the lower block; across the bottom of the upper one it points down.
        values = [now[text] for text in (*A_AND_B, "-rollers.Fn + rollers.M/0.25", "-rollers.M/0.25")]
        check, against = forces(y, ((0.1 + y) / 0.25, (0.15 - y) / 0.25)), "closed form: one balance after another"
        yield Answer("F_A, F_B, F_C, F_D", values, "N", check, against, 1e-12, variant=of)


@ask("Which two equations hold no reaction, and how many are there of the other forms?")
def equations(case):
    closed = ["(m1 + m2)*accel(x) - m2*cos(tip)*accel(y)", "m2*(accel(y) - cos(tip)*accel(x)) - m2*g*sin(tip)"]
    yield from case.balances(closed, "closed form: momentum along the ground and down the slope")
    for form, says, check in (("brute", "Brute force has {}.", 6), ("constraints", "Most brute force has {}.", 10)):
        count, against = len(case.mechanism().equations(form).equations), "count: 3 a body, 1 a place held along a line or turned"
        yield Answer("equations", count, "", check, against, 0.0, says=says)


@ask("What are the accelerations, symbolically?")
def symbolically(case):
    below = "(m1 + m2*sin(tip)^2)"
    closed = {"x": f"m2*g*sin(tip)*cos(tip)/{below}", "y": f"(m1 + m2)*g*sin(tip)/{below}"}
    yield from case.symbolically(closed, "closed form: two balances without reactions")


@ask("What are ẍ, ÿ and the forces at A, B, C, D at y = 0, and at 0.1 and 0.3 m?")
def instants(case):
    """With the small rollers fixed to the lower block, C and D stay and G2 moves over them: (0.15 − y) F_C = (0.10 + y) F_D."""
    for y in PLACES:
        now, of = case.instant(y=y), f"y = {y:g}" if y else ""
        yield Answer(
            "ẍ, ÿ",
            [now["accel(x)"], now["accel(y)"]],
            "m/s²",
            accelerations(),
            "closed form: two balances without reactions",
            1e-13,
            variant=of,
        )
        values, against = [now[text] for text in (*A_AND_B, *C_AND_D)], "closed form: one balance after another"
        yield Answer("F_A, F_B, F_C, F_D", values, "N", forces(y, (0.4, 0.6)), against, 1e-12, variant=of)
    yield from rollers_below(case)


@ask("How do the blocks move from rest for 0.4 s?")
def motion(case):
    run = case.run()
    times = np.array([0.1, 0.2, 0.3, 0.4])
    for name, acceleration in zip("xy", accelerations(), strict=True):
        yield Answer(
            f"{name} at 0.1, 0.2, 0.3, 0.4 s",
            run.evaluate(name, times),
            "m",
            acceleration * times**2 / 2,
            "closed form: constant acceleration",
            1e-12,
        )
    whole = run.evaluate("momentum_x()", times)
    says = "The momentum of both along x stays {}."
    yield Answer("momentum along x", whole, "N·s", 0 * times, "conservation: no force along x", 1e-12, scale=M1, says=says)
