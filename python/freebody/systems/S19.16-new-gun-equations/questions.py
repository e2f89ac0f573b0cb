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


@ask("1. What are the equations for θ̈ and R̈?")
def symbolically(case):
    whole = "(m1*l^2/3 + m2*R^2)*accel(theta) + 2*m2*R*rate(R)*rate(theta) - T"
    against = "closed form: moments about A, no force along the rod"
    yield from case.balances([whole, "m2*(accel(R) - R*rate(theta)^2)"], against)
    closed = {"theta": "(T - 2*m2*R*rate(R)*rate(theta))/(m1*l^2/3 + m2*R^2)", "R": "R*rate(theta)^2"}
    yield from case.symbolically(closed, against)


@ask("What are the accelerations and the forces at θ = 0, θ̇ = 0, R = 0.1, Ṙ = 0?")
def instants(case):
    for theta, spin, r, speed in ((0, 0, 0.1, 0), (1, 1.5, 0.6, 0.8)):
        now = case.instant(theta=theta, R=r, rates={"theta": spin, "R": speed})
        _, _, angular, radial = rates(1.0)(0, [theta, r, spin, speed])
        of = f"at θ = {theta}, θ̇ = {spin}, R = {r}, Ṙ = {speed}" if theta else ""
        yield Answer("θ̈", now["accel(theta)"], "rad/s²", angular, "closed form: moments about A", 1e-13, variant=of)
        yield Answer("R̈", now["accel(R)"], "m/s²", radial, "closed form: no force along the rod", 1e-12, 1, variant=of)
        across = M2 * (r * angular + 2 * speed * spin)
        says, against = "The rod pushes the collar with {} along e_θ.", "closed form: momentum of the collar"
        yield Answer("rod on collar", now["track.Fn"], "N", across, against, 1e-12, says=says, variant=of)
        pivot = [now["pivot.Fx*cos(theta) + pivot.Fy*sin(theta)"], now["pivot.Fy*cos(theta) - pivot.Fx*sin(theta)"]]
        check = [-M1 * L / 2 * spin**2, M1 * L / 2 * angular + across]
        says = "The ground pushes the rod at A with {} along it and {} across."
        yield Answer("ground on rod", pivot, "N", check, "closed form: momentum of both", 1e-12, says=says, variant=of)


@ask("2. With T = 0, does the angular momentum about A stay, and the energy, and how does it move?")
def free(case):
    run = case.run(parameters={"T": 0}, initial=START)
    inertia = I1 + M2 * 0.3**2
    spin, says = run.evaluate("angular_momentum(rod.A)", TIMES), "The angular momentum about A is {} at 0.1 … 0.6 s."
    yield Answer("H", spin, "N·m·s", 2 * inertia + 0 * TIMES, "conservation: no moment about A", 1e-12, says=says)
    energy, says = run.evaluate("kinetic()", TIMES), "The kinetic energy is {} at 0.1 … 0.6 s."
    yield Answer("E", energy, "J", (inertia * 4 + M2 * 0.25) / 2 + 0 * TIMES, "conservation: no power", 1e-12, says=says)
    check = motion(rates(0.0), [0, 0.3, 2, 0.5], TIMES)
    against = "other route: two balances, integrated by SciPy"
    yield Answer("R at 0.1 … 0.6 s", run.evaluate("R", TIMES), "m", check[:, 1], against, 1e-11)
    yield Answer("θ at 0.1 … 0.6 s", run.evaluate("theta", TIMES), "rad", check[:, 0], against, 1e-11)
