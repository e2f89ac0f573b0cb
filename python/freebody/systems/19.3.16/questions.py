"""19.3.16: block with a pivoted rod: one instant.

Rod from the downward vertical at θ: G = (x + (ℓ/2) sin θ, −(ℓ/2) cos θ). Given at once: ℓ 1, m 2, θ π/2, θ̇ 1, x 1, ẋ 2.
"""

from math import cos, pi, sin

import numpy as np

from freebody.catalogue import Answer, ask

L, M, G = 1.0, 2.0, 9.81
THETA, OMEGA, V = pi / 2, 1.0, 2.0


def momentum(sense=1):
    """m ẋ i + m v_G; for an angle clockwise from the upward vertical G moves down instead of up."""
    return [2 * M * V + M * L / 2 * cos(THETA) * OMEGA, sense * M * L / 2 * sin(THETA) * OMEGA]


def energy():
    """½mẋ² + ½m v_G² + ½(mℓ²/12)θ̇²."""
    vx, vy = V + L / 2 * cos(THETA) * OMEGA, L / 2 * sin(THETA) * OMEGA
    return M / 2 * (V**2 + vx**2 + vy**2) + M * L**2 / 24 * OMEGA**2


def free_accelerations():
    """ẍ, θ̈ from two balances: the whole along x, the rod about the block's mass centre.

    2m ẍ + (mℓ/2)(cos θ θ̈ − sin θ θ̇²) = 0,   (mℓ²/3)θ̈ + (mℓ/2) cos θ ẍ = −(mgℓ/2) sin θ.
    """
    c, s = cos(THETA), sin(THETA)
    matrix = [[2 * M, M * L / 2 * c], [M * L / 2 * c, M * L**2 / 3]]
    return np.linalg.solve(matrix, [M * L / 2 * s * OMEGA**2, -M * G * L / 2 * s])


@ask("(a) Kinetic energy, (b) linear momentum")
def state(case):
    for file, sense in [("model.yaml", 1), ("clockwise.yaml", -1)]:
        now = case.instant(file)
        yield Answer(f"kinetic energy, {file}", now["kinetic()"], "J", energy(), "closed form: ½mẋ² + ½mv² + ½Iω²", 1e-14)
        value = [now["momentum_x()"], now["momentum_y()"]]
        yield Answer(f"momentum, {file}", value, "kg·m/s", momentum(sense), "closed form: mẋ i + m v", 1e-14)


@ask("Rate of change of momentum for ẍ = 3, θ̈ = 2")
def given(case):
    """m ẍ i + m a_G with a_G = (ẍ + (ℓ/2)(cos θ θ̈ − sin θ θ̇²), (ℓ/2)(sin θ θ̈ + cos θ θ̇²))."""
    now, xdd, thetadd = case.instant("driven.yaml"), 3.0, 2.0
    c, s = cos(THETA), sin(THETA)
    check = [2 * M * xdd + M * L / 2 * (c * thetadd - s * OMEGA**2), M * L / 2 * (s * thetadd + c * OMEGA**2)]
    value = [now[f"m*(a{axis}(block.origin) + a{axis}(rod.G))"] for axis in "xy"]
    yield Answer("from the accelerations", value, "N", check, "closed form: sum of m a", 1e-14)
    # the push along x, the floor's force and the weight are all that acts from outside
    outside = [now["push.force"], now["floor.Fn"] - 2 * M * G]
    yield Answer("from the forces of drive, floor and gravity", outside, "N", check, "closed form: sum of m a", 1e-12)


@ask("Do these accelerations belong to a free motion?")
def free(case):
    """They would if they were those of the free system, and no push and no torque were needed."""
    now = case.instant()
    xdd, thetadd = free_accelerations()
    value = [now.accelerations["x"], now.accelerations["theta"]]
    yield Answer("ẍ, θ̈ of the free motion: no", value, "m/s², rad/s²", [xdd, thetadd], "other route: balances by hand", 1e-13)
    turned = case.instant("clockwise.yaml").accelerations["theta"]
    yield Answer("θ̈ clockwise from the upward vertical", turned, "rad/s²", -thetadd, "other route: balances by hand", 1e-13)
    driven = case.instant("driven.yaml")
    c, s = cos(THETA), sin(THETA)
    push = 2 * M * 3 + M * L / 2 * (c * 2 - s * OMEGA**2)
    turn = M * L**2 / 3 * 2 + M * L / 2 * c * 3 + M * G * L / 2 * s
    yield Answer(
        "force and torque it takes",
        [driven["push.force"], driven["turn.force"]],
        "N, N·m",
        [push, turn],
        "other route: balances by hand",
        1e-13,
    )
