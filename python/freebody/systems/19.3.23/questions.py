"""19.3.23: double pendulum, first rod massless.

θ₁, θ₂ from the downward vertical, e = (sin θ₁, −cos θ₁). Without mass, rod 1 carries a force along itself only: it pulls
the upper end B = ℓe of rod 2 with −T e. With h = ℓ/2, G = ℓe + h(sin θ₂, −cos θ₂):
    m a_G = −T e − mg j,   (mℓ²/12)θ̈₂ = (r_B − r_G) × (−T e) = −T h sin(θ₂ − θ₁),
three equations for θ̈₁, θ̈₂ and T.
"""

from math import cos, log10, sin

import numpy as np

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import motion

M, L, G = 1.0, 1.0, 9.81
START = [0.5, 1.2, 0.3, -0.4]  # θ₁, θ₂, θ̇₁, θ̇₂
COLUMNS = [("theta1", "rad"), ("theta2", "rad"), ("rate(theta1)", "rad/s"), ("rate(theta2)", "rad/s")]
EQUATIONS = "other route: balances by hand"


def solve(one, two, spin1, spin2):
    """θ̈₁, θ̈₂, T."""
    h = L / 2
    matrix = [
        [M * L * cos(one), M * h * cos(two), sin(one)],
        [M * L * sin(one), M * h * sin(two), -cos(one)],
        [0.0, M * L**2 / 12, h * sin(two - one)],
    ]
    across = M * (L * sin(one) * spin1**2 + h * sin(two) * spin2**2)
    up = -M * (L * cos(one) * spin1**2 + h * cos(two) * spin2**2) - M * G
    return np.linalg.solve(matrix, [across, up, 0.0])


@ask("In symbols: the two equations")
def symbolically(case):
    force1 = "(-sin(theta1 - theta2)*rate(theta2)^2/2 - g*sin(theta1)/l)"
    force2 = "(sin(theta1 - theta2)*rate(theta1)^2/2 - g*sin(theta2)/(2*l))"
    half, below = "cos(theta1 - theta2)/2", "(1/3 - cos(theta1 - theta2)^2/4)"
    closed = {
        "theta1": f"({force1}/3 - {half}*{force2})/{below}",
        "theta2": f"({force2} - {half}*{force1})/{below}",
    }
    yield from case.symbolically(closed, "other route: Lagrange's equations by hand", "link.yaml")


@ask("One instant, with the force in rod 1")
def instant(case):
    one, two, T = solve(*START)
    body, link = case.instant(), case.instant("link.yaml")
    for of, now in [("a body of zero mass", body), ("a distance", link)]:
        value = [now.accelerations["theta1"], now.accelerations["theta2"]]
        yield Answer(f"θ̈₁, θ̈₂, rod 1 as {of}", value, "rad/s²", [one, two], EQUATIONS, 1e-12)
    yield Answer("tension of rod 1 as a distance", link["rod1.tension"], "N", T, EQUATIONS, 1e-12)
    pull = [-T * sin(START[0]), T * cos(START[0])]
    yield Answer("ceiling on rod 1 as a body", [body["ceiling.Fx"], body["ceiling.Fy"]], "N", pull, EQUATIONS, 1e-12)
    yield Answer("rod 1 on rod 2", [body["elbow.Fx"], body["elbow.Fy"]], "N", pull, EQUATIONS, 1e-12)


@ask("Motion for 5 s")
def run(case):
    times = [1.0, 2.0, 3.0, 4.0, 5.0]
    check = motion(lambda _t, s: (s[2], s[3], *solve(*s)[:2]), START, times)
    for file in ("model.yaml", "link.yaml"):
        run = case.run(file)
        for i, (text, unit) in enumerate(COLUMNS):
            yield Answer(f"{text} at 1…5 s, {file}", run.evaluate(text, times), unit, check[:, i], f"{EQUATIONS}, SciPy", 1e-8)


@ask("A small mass of rod 1 approaches none")
def small_mass(case):
    """To first order in m₁, as the equations are regular at m₁ = 0: a thousandth of the mass, a thousandth of the difference."""
    exact = solve(*START)[:2]
    gaps = []
    for mass in (1e-3, 1e-6):
        now = case.instant(parameters={"m1": mass})
        gaps.append(np.linalg.norm([now.accelerations["theta1"] - exact[0], now.accelerations["theta2"] - exact[1]]))
    yield Answer("order in m₁", log10(gaps[0] / gaps[1]) / 3, "", 1.0, "closed form: first order", 1e-2)


@ask("A rod whose motion is undetermined is named")
def idle(case):
    """A rod without mass at the free end of rod 2: nothing says how it turns."""
    try:
        case.instant("idle.yaml")
        said = "nothing"
    except (RuntimeError, ValueError) as error:
        said = str(error)
    yield Answer("the refusal names it: 1", float("idle" in said), "", 1.0, "closed form: no inertia, no moment")
