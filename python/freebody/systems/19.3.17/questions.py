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
CASES = {"m_c 2, m_p 3, θ 0.6": (2.0, 3.0, 0.6), "m_c = m_p, θ 45°": (2.0, 2.0, pi / 4), "θ 110°": (2.0, 3.0, 110 * pi / 180)}


def parameters(mc, mp, theta):
    return {"mc": mc, "mp": mp, "theta0": theta}


def tension(mc, mp, theta, omega=0.0):
    return mc * mp * (G * cos(theta) + L * omega**2) / (mc + mp * sin(theta) ** 2)


def accelerations(mc, mp, theta, omega=0.0):
    xdd = tension(mc, mp, theta, omega) * sin(theta) / mc
    return xdd, -(G * sin(theta) + xdd * cos(theta)) / L


@ask("In symbols, just after release")
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
    yield from case.symbolically({"x": "g/3"}, against, of="m_c = m_p, θ 45°", at_rest=True, set=alike)


@ask("Just after release")
def release(case):
    against = "closed form: three balances"
    for of, (mc, mp, theta) in CASES.items():
        now = case.instant(parameters=parameters(mc, mp, theta))
        xdd, thetadd = accelerations(mc, mp, theta)
        T = tension(mc, mp, theta)
        yield Answer(f"ẍ of the cart, {of}", now.accelerations["x"], "m/s²", xdd, against, 1e-12)
        yield Answer(f"θ̈, {of}", now.accelerations["theta"], "rad/s²", thetadd, against, 1e-12)
        yield Answer(f"tension of the rod, {of}", now["rod.tension"], "N", T, against, 1e-12)
        yield Answer(f"floor force, {of}", now["wheels.Fn"], "N", mc * G + T * cos(theta), against, 1e-12)


@ask("May the rod be a string at 110°?")
def string(case):
    """No: above the level of the hinge the rod has to push, T < 0."""
    now = case.instant(parameters=parameters(*CASES["θ 110°"]))
    yield Answer(
        "sign of the tension: −1 is a push",
        np.sign(now["rod.tension"]),
        "",
        np.sign(cos(110 * pi / 180)),
        "closed form: sign of cos θ",
    )


@ask("Motion for 5 s")
def run(case):
    times = [1.0, 2.0, 3.0, 4.0, 5.0]
    for of, (mc, mp, theta) in CASES.items():

        def rates(_t, s, mc=mc, mp=mp):
            return s[2], s[3], *accelerations(mc, mp, s[1], s[3])

        check = motion(rates, [0.0, theta, 0.0, 0.0], times)
        run = case.run(parameters=parameters(mc, mp, theta))
        for i, (text, unit) in enumerate([("x", "m"), ("theta", "rad"), ("rate(x)", "m/s"), ("rate(theta)", "rad/s")]):
            yield Answer(
                f"{text} at 1…5 s, {of}",
                run.evaluate(text, times),
                unit,
                check[:, i],
                "other route: balances by hand, SciPy",
                1e-8,
            )
        path = [mp * L * sin(theta) / (mc + mp)] * 5
        yield Answer(f"mass centre along x, {of}", run.evaluate("centre_x()", times), "m", path, "conservation", 1e-10)
        height = -mp * L * np.cos(check[:, 1]) / (mc + mp)
        yield Answer(
            f"mass centre along y, {of}",
            run.evaluate("centre_y()", times),
            "m",
            height,
            "other route: balances by hand, SciPy",
            1e-8,
        )
