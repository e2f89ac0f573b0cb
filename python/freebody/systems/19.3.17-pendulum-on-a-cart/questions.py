"""19.3.17: pendulum on a free cart.

Bob at x + ℓ sin θ, −ℓ cos θ; tension T. Cart along x: m_c ẍ = T sin θ. Bob along the rod and across it:
    m_p(ℓθ̇² − ẍ sin θ) = T − m_p g cos θ,   ℓθ̈ + ẍ cos θ = −g sin θ.
So T = m_c m_p(g cos θ + ℓθ̇²)/(m_c + m_p sin²θ), ẍ = T sin θ/m_c, and the floor pushes with m_c g + T cos θ.
Nothing acts along x from outside: the mass centre moves on a vertical line.
"""

from math import cos, pi, sin

import numpy as np

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import motion

G, L = 9.81, 0.7
# cart, bob, angle at release
CASES = {"": (2.0, 3.0, 0.6), "m_c = m_p, θ = 45°": (2.0, 2.0, pi / 4), "θ = 110°": (2.0, 3.0, 110 * pi / 180)}
COLUMNS = [("x", "x", "m"), ("theta", "θ", "rad"), ("rate(x)", "ẋ", "m/s"), ("rate(theta)", "θ̇", "rad/s")]


def parameters(mc, mp, theta):
    return {"mc": mc, "mp": mp, "theta0": theta}


def tension(mc, mp, theta, omega=0.0):
    return mc * mp * (G * cos(theta) + L * omega**2) / (mc + mp * sin(theta) ** 2)


def accelerations(mc, mp, theta, omega=0.0):
    xdd = tension(mc, mp, theta, omega) * sin(theta) / mc
    return xdd, -(G * sin(theta) + xdd * cos(theta)) / L


@ask("What is the acceleration of the cart just after release, in symbols, and what θ̈ and the tension of the rod?")
def symbolically(case):
    below = "(mc + mp*sin(theta)^2)"
    closed = {
        "x": f"mp*g*sin(theta)*cos(theta)/{below}",
        "theta": f"-(mc + mp)*g*sin(theta)/(l*{below})",
        "rod.tension": f"mc*mp*g*cos(theta)/{below}",
        "theta, mc → inf": "-g*sin(theta)/l",
    }
    against = "closed form: three balances"
    yield from case.symbolically(closed, against, at_rest=True)
    alike = {"theta": "45 deg", "mp": "mc"}
    yield from case.symbolically({"x": "g/3"}, against, of="m_c = m_p, θ = 45°", at_rest=True, set=alike)


@ask("How large are they, and how hard does the floor push?")
def release(case):
    against = "closed form: three balances"
    for of, (mc, mp, theta) in CASES.items():
        now = case.instant(parameters=parameters(mc, mp, theta))
        xdd, thetadd = accelerations(mc, mp, theta)
        T = tension(mc, mp, theta)
        yield Answer("ẍ", now.accelerations["x"], "m/s²", xdd, against, 1e-12, variant=of)
        yield Answer("θ̈", now.accelerations["theta"], "rad/s²", thetadd, against, 1e-12, variant=of)
        yield Answer("tension of the rod", now["rod.tension"], "N", T, against, 1e-12, variant=of)
        yield Answer("force of the floor", now["wheels.Fn"], "N", mc * G + T * cos(theta), against, 1e-12, variant=of)


@ask("At 110°, may the rod be a string?")
def string(case):
    """Above the level of the hinge the rod has to push, T < 0."""
    pulls = case.instant(parameters=parameters(*CASES["θ = 110°"]))["rod.tension"] >= 0
    says = "Yes: the rod pulls there." if pulls else "No: above the level of the hinge the rod has to push."
    yield Answer("pulls", pulls, "", cos(110 * pi / 180) >= 0, "closed form: sign of cos θ", scale=1.0, says=says)


@ask("How does it move for 5 s, and along what path its mass centre?")
def run(case):
    times, by_hand = [1.0, 2.0, 3.0, 4.0, 5.0], "other route: balances by hand, SciPy"
    for of, (mc, mp, theta) in CASES.items():

        def rates(_t, s, mc=mc, mp=mp):
            return s[2], s[3], *accelerations(mc, mp, s[1], s[3])

        check = motion(rates, [0.0, theta, 0.0, 0.0], times)
        run = case.run(parameters=parameters(mc, mp, theta))
        for i, (text, name, unit) in enumerate(COLUMNS):
            yield Answer(f"{name} at 1…5 s", run.evaluate(text, times), unit, check[:, i], by_hand, 1e-8, variant=of)
        height, says = -mp * L * np.cos(check[:, 1]) / (mc + mp), "Its mass centre is then at a height of {}."
        yield Answer("y_G", run.evaluate("centre_y()", times), "m", height, by_hand, 1e-8, says=says, variant=of)
        path, says = [mp * L * sin(theta) / (mc + mp)] * 5, "It stays on the vertical line at {}."
        yield Answer("x_G", run.evaluate("centre_x()", times), "m", path, "conservation", 1e-10, says=says, variant=of)
