"""19.3.16: block with a pivoted rod: one instant.

Rod from the downward vertical at θ: G = (x + (ℓ/2) sin θ, −(ℓ/2) cos θ). Given at once: ℓ 1, m 2, θ π/2, θ̇ 1, x 1, ẋ 2.
"""

from math import cos, pi, sin

import numpy as np

from freebody.catalogue import Answer, ask

L, M, G = 1.0, 2.0, 9.81
CLOCKWISE = "θ clockwise from the upward vertical"
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


@ask("(a) What is the kinetic energy, (b) the linear momentum?")
def state(case):
    for file, sense, of in [("model.yaml", 1, ""), ("clockwise.yaml", -1, CLOCKWISE)]:
        now = case.instant(file)
        against, says = "closed form: ½mẋ² + ½mv² + ½Iω²", "(a) It is {}."
        yield Answer("E", now["kinetic()"], "J", energy(), against, 1e-14, says=says, variant=of)
        value, says = [now["momentum_x()"], now["momentum_y()"]], "(b) It is {} along x and {} along y."
        yield Answer("L", value, "kg·m/s", momentum(sense), "closed form: mẋ i + m v", 1e-14, says=says, variant=of)


@ask("What is the rate of change of momentum for ẍ = 3 m/s², θ̈ = 2 rad/s²?")
def given(case):
    """m ẍ i + m a_G with a_G = (ẍ + (ℓ/2)(cos θ θ̈ − sin θ θ̇²), (ℓ/2)(sin θ θ̈ + cos θ θ̇²))."""
    now, xdd, thetadd = case.instant("driven.yaml"), 3.0, 2.0
    c, s, against = cos(THETA), sin(THETA), "closed form: sum of m a"
    check = [2 * M * xdd + M * L / 2 * (c * thetadd - s * OMEGA**2), M * L / 2 * (s * thetadd + c * OMEGA**2)]
    value, says = [now[f"m*(a{axis}(block.origin) + a{axis}(rod.G))"] for axis in "xy"], "From the accelerations {} and {}."
    yield Answer("L̇", value, "N", check, against, 1e-14, says=says)
    # the push along x, the floor's force and the weight are all that acts from outside
    outside, says = [now["push.force"], now["floor.Fn"] - 2 * M * G], "From the forces of drive, floor and gravity {} and {}."
    yield Answer("L̇", outside, "N", check, against, 1e-12, says=says)


@ask("Do these accelerations belong to a free motion?")
def free(case):
    """They would if they were those of the free system, and no push and no torque were needed."""
    now, against = case.instant(), "other route: balances by hand"
    xdd, thetadd = free_accelerations()
    value, says = [now.accelerations["x"], now.accelerations["theta"]], "No: in free motion ẍ, θ̈ are {}."
    yield Answer("ẍ, θ̈", value, "m/s², rad/s²", [xdd, thetadd], against, 1e-13, says=says)
    driven, c, s = case.instant("driven.yaml"), cos(THETA), sin(THETA)
    push = 2 * M * 3 + M * L / 2 * (c * 2 - s * OMEGA**2)
    turn = M * L**2 / 3 * 2 + M * L / 2 * c * 3 + M * G * L / 2 * s
    value, says = [driven["push.force"], driven["turn.force"]], "They take a force and a torque: {}."
    yield Answer("force, torque", value, "N, N·m", [push, turn], against, 1e-13, says=says)
    turned = case.instant("clockwise.yaml").accelerations["theta"]
    yield Answer("θ̈", turned, "rad/s²", -thetadd, against, 1e-13, variant=CLOCKWISE)
