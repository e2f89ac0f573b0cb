"""New gun, its equations.

No force acts on the collar along the rod: R̈ = R θ̇². Moments of rod and collar about A, with I1 = m1 l²/3:
d/dt[(I1 + m2 R²) θ̇] = T. What the rod does to the collar is m2 (R θ̈ + 2 Ṙ θ̇) across the rod; the force at A is
the rate of change of the momentum of both.
"""

import numpy as np

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import motion

M1, M2, L = 1 / 3, 1.0, 1.0
I1 = M1 * L**2 / 3
START = {"theta": 0, "R": 0.3, "rates": {"theta": 2, "R": 0.5}}
TIMES = np.array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6])


def rates(torque):
    """First-order form for (θ, R, θ̇, Ṙ)."""
    return lambda t, y: [y[2], y[3], (torque - 2 * M2 * y[1] * y[3] * y[2]) / (I1 + M2 * y[1] ** 2), y[1] * y[2] ** 2]


@ask("symbolically:  the two equations")
def symbolically(case):
    closed = {"theta": "(T - 2*m2*R*rate(R)*rate(theta))/(m1*l^2/3 + m2*R^2)", "R": "R*rate(theta)^2"}
    yield from case.symbolically(closed, "closed form: moments about A, no force along the rod")


@ask("accelerations and forces at two states")
def instants(case):
    for theta, spin, r, speed in ((0, 0, 0.1, 0), (1, 1.5, 0.6, 0.8)):
        now = case.instant(theta=theta, R=r, rates={"theta": spin, "R": speed})
        _, _, angular, radial = rates(1.0)(0, [theta, r, spin, speed])
        where = f"at θ = {theta}, R = {r}"
        yield Answer(f"θ̈ {where}", now["accel(theta)"], "rad/s²", angular, "closed form: moments about A", 1e-13)
        yield Answer(f"R̈ {where}", now["accel(R)"], "m/s²", radial, "closed form: no force along the rod", 1e-12, scale=1)
        across = M2 * (r * angular + 2 * speed * spin)
        yield Answer(
            f"rod on collar, across the rod, {where}", now["track.Fn"], "N", across, "closed form: momentum of the collar", 1e-12
        )
        pivot = [now["pivot.Fx*cos(theta) + pivot.Fy*sin(theta)"], now["pivot.Fy*cos(theta) - pivot.Fx*sin(theta)"]]
        check = [-M1 * L / 2 * spin**2, M1 * L / 2 * angular + across]
        yield Answer(
            f"ground on rod at A, along and across it, {where}", pivot, "N", check, "closed form: momentum of both", 1e-12
        )


@ask("no torque: angular momentum about A and energy over time")
def free(case):
    run = case.run(parameters={"T": 0}, initial=START)
    inertia = I1 + M2 * 0.3**2
    yield Answer(
        "angular momentum about A at 0.1 … 0.6 s",
        run.evaluate("angular_momentum(rod.A)", TIMES),
        "N·m·s",
        2 * inertia + 0 * TIMES,
        "conservation: no moment about A",
        1e-12,
    )
    yield Answer(
        "kinetic energy at 0.1 … 0.6 s",
        run.evaluate("kinetic()", TIMES),
        "J",
        (inertia * 4 + M2 * 0.25) / 2 + 0 * TIMES,
        "conservation: no power",
        1e-12,
    )
    check = motion(rates(0.0), [0, 0.3, 2, 0.5], TIMES)
    yield Answer(
        "R at 0.1 … 0.6 s", run.evaluate("R", TIMES), "m", check[:, 1], "other route: moments about A, integrated by SciPy", 1e-11
    )
    yield Answer(
        "θ at 0.1 … 0.6 s",
        run.evaluate("theta", TIMES),
        "rad",
        check[:, 0],
        "other route: moments about A, integrated by SciPy",
        1e-11,
    )
