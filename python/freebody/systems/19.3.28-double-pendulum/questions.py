"""19.3.28: double pendulum at release.

Absolute angles from the downward vertical, h = ℓ/2, F the force of bar 1 on bar 2 at the elbow E. Balances:
    m a_G2 = F − mg j,   (mℓ²/12)φ̈₂ = (r_E − r_G2) × F,
    (mℓ²/3)φ̈₁ = −mgh sin φ₁ − r_E × F,   and the force at the ceiling F₀ = F + mg j + m a_G1.
At φ₁ = 0, φ₂ = π/2, at rest, a_E = ℓφ̈₁ i and bar 2 lies along x: F_x = mℓφ̈₁ and (mℓ²/3)φ̈₁ = −mℓ²φ̈₁, so φ̈₁ = 0.
Bar 2 then falls as if hinged at a fixed point, φ̈₂ = −3g/2ℓ; the forces are mg/4 at the elbow, 5mg/4 at the ceiling, both up.
"""

from math import cos, pi, sin

import numpy as np

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import motion
from freebody.stability.state_space import state_space

M, L, G = 1.0, 1.0, 9.81
COLUMNS = [("phi1", "φ₁", "rad"), ("phi2", "φ₂", "rad"), ("rate(phi1)", "φ̇₁", "rad/s"), ("rate(phi2)", "φ̇₂", "rad/s")]
HORIZONTAL = "angles from the horizontal"
LETTERS = "closed form: −3g/2ℓ, mg/4, 5mg/4"


def solve(one, two, spin1, spin2):
    """φ̈₁, φ̈₂ and the force on bar 2 at the elbow."""
    h, c1, s1, c2, s2 = L / 2, cos(one), sin(one), cos(two), sin(two)
    matrix = [
        [M * L * c1, M * h * c2, -1.0, 0.0],
        [M * L * s1, M * h * s2, 0.0, -1.0],
        [0.0, M * L**2 / 12, h * c2, h * s2],
        [M * L**2 / 3, 0.0, L * c1, L * s1],
    ]
    right = [
        M * (L * s1 * spin1**2 + h * s2 * spin2**2),
        -M * (L * c1 * spin1**2 + h * c2 * spin2**2) - M * G,
        0.0,
        -M * G * h * s1,
    ]
    return np.linalg.solve(matrix, right)


@ask("What are φ̈₁, φ̈₂ just after release, in symbols, and the forces at both hinges?")
def symbolically(case):
    closed = {"phi1": "0", "phi2": "-3*g/(2*l)", "elbow.Fy": "m*g/4", "ceiling.Fy": "5*m*g/4"}
    yield from case.symbolically(closed, LETTERS, at_rest=True, set={"phi1": 0, "phi2": "90 deg"})


@ask("How large are they?")
def release(case):
    for file in ("model.yaml", "horizontal.yaml"):
        now, of = case.instant(file), "" if file == "model.yaml" else HORIZONTAL
        value = [now.accelerations["phi1"], now.accelerations["phi2"]]
        yield Answer("φ̈₁, φ̈₂", value, "rad/s²", [0.0, -3 * G / (2 * L)], LETTERS, 1e-13, variant=of)
        yield Answer(
            "force of the elbow on bar 2", [now["elbow.Fx"], now["elbow.Fy"]], "N", [0.0, M * G / 4], LETTERS, 1e-13, variant=of
        )
        yield Answer(
            "force of the ceiling on bar 1",
            [now["ceiling.Fx"], now["ceiling.Fy"]],
            "N",
            [0.0, 5 * M * G / 4],
            LETTERS,
            1e-13,
            variant=of,
        )


@ask("And with m = 2.7 kg, ℓ = 0.4 m, g = 3.71 m/s²?")
def letters(case):
    m, length, g = 2.7, 0.4, 3.71
    now = case.instant(parameters={"m": m, "l": length, "g": g})
    value = [now.accelerations["phi1"], now.accelerations["phi2"]]
    yield Answer("φ̈₁, φ̈₂", value, "rad/s²", [0.0, -3 * g / (2 * length)], LETTERS, 1e-13)
    yield Answer("Fy at elbow and ceiling", [now["elbow.Fy"], now["ceiling.Fy"]], "N", [m * g / 4, 5 * m * g / 4], LETTERS, 1e-13)


@ask("How does it move for 3 s, with what forces at both hinges?")
def run(case):
    times = [0.5, 1.0, 2.0, 3.0]
    check = motion(lambda _t, s: (s[2], s[3], *solve(*s)[:2]), [0.0, pi / 2, 0.0, 0.0], times)
    run, against = case.run(), "other route: balances by hand, SciPy"
    for i, (text, name, unit) in enumerate(COLUMNS):
        yield Answer(f"{name} at 0.5…3 s", run.evaluate(text, times), unit, check[:, i], against, 1e-8)
    turned = np.array(case.run("horizontal.yaml").evaluate("phi2", times)) + pi / 2
    yield Answer("φ₂ + π/2 at 0.5…3 s", turned, "rad", check[:, 1], against, 1e-8, variant=HORIZONTAL)
    for i, part in [(2, "Fx"), (3, "Fy")]:
        elbow = [solve(*s)[i] for s in check]
        yield Answer(f"{part} of the elbow on bar 2", run.evaluate(f"elbow.{part}", times), "N", elbow, against, 1e-7)
    ceiling = np.array([ceiling_force(*s) for s in check])
    for i, part in enumerate(("Fx", "Fy")):
        yield Answer(f"{part} of the ceiling on bar 1", run.evaluate(f"ceiling.{part}", times), "N", ceiling[:, i], against, 1e-7)


def ceiling_force(one, two, spin1, spin2):
    alpha, _, Fx, Fy = solve(one, two, spin1, spin2)
    h = L / 2
    ax = h * (cos(one) * alpha - sin(one) * spin1**2)
    ay = h * (sin(one) * alpha + cos(one) * spin1**2)
    return Fx + M * ax, Fy + M * (ay + G)


@ask("And where φ₁ = 0, φ₂ = π/2 are meant from the horizontal, bar 1 along x and bar 2 upright?")
def other_reading(case):
    """Only gravity at rest: with bar 2 above the elbow, m a_G1 and m a_G2 are vertical, φ̈₂ = 0 and (4/3)φ̈₁ = −(3/2) g/ℓ."""
    state = {"phi1": "90 deg", "phi2": "180 deg"}
    closed = {"phi1": "-9*g/(8*l)", "phi2": "0"}
    yield from case.symbolically(closed, "closed form: balances about ceiling and elbow", at_rest=True, set=state)
    now, check = case.instant(**state), solve(pi / 2, pi, 0.0, 0.0)
    yield Answer("φ̈₁, φ̈₂", [now["accel(phi1)"], now["accel(phi2)"]], "rad/s²", check[:2], LETTERS, 1e-13)
    yield Answer(
        "force of the elbow on bar 2", [now["elbow.Fx"], now["elbow.Fy"]], "N", check[2:], "other route: balances by hand", 1e-12
    )


@ask("How does it move from that start, and what are its linear equations there?")
def from_the_other(case):
    """The elbow falls faster than freely, so that bar 2 hangs upward: no small turn of it grows at first."""
    run, times = case.run(initial={"phi1": "90 deg", "phi2": "180 deg", "at_rest": True}), [0.5, 1.0, 2.0, 3.0]
    check = motion(lambda _t, s: (s[2], s[3], *solve(*s)[:2]), [pi / 2, pi, 0.0, 0.0], times)
    against = "other route: balances by hand, SciPy"
    for i, (text, name, _) in enumerate(COLUMNS[:2]):
        digits = run.digits(text, [3.0])[0]
        label = f"{name} at 0.5, 1, 2, 3 s, of which {digits:.0f} digits hold"
        yield Answer(label, run.evaluate(text, times), "rad", check[:, i], against, 1e-7)
    found = state_space(case.mechanism().source(), run.motion.state(0.0)).a
    step = 1e-5
    slopes = np.zeros((4, 4))
    slopes[:2, 2:] = np.eye(2)
    start = np.array([pi / 2, pi, 0.0, 0.0])
    for i, each in enumerate(np.eye(4)):
        near = [solve(*(start + n * step * each))[:2] for n in (-2, -1, 1, 2)]
        slopes[2:, i] = (near[0] - 8 * near[1] + 8 * near[2] - near[3]) / (12 * step)
    value, check = (matrix[2:, :2].ravel() for matrix in (found, slopes))
    label = "derivatives of φ̈₁, then φ̈₂, by φ₁ and φ₂ at the start"
    yield Answer(label, value, "1/s²", check, "other route: differences of the balances by hand", 1e-7)
