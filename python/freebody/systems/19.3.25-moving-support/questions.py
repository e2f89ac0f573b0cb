"""19.3.25: pendulum on a moving support.

θ clockwise from the downward vertical, mass centre at c from the support (c = ℓ for the particle, ℓ/2 for the uniform
rod), I about it: G = (r − c sin θ, −c cos θ). Moment about the support, which carries no couple:
    (I + mc²)θ̈ = mc(r̈ cos θ − g sin θ),
so ℓθ̈ = r̈ cos θ − g sin θ for the particle, and 3/2 of that for the rod. Support force F = m a_G + mg j; its power is F_x ṙ.
"""

from math import cos, sin

import numpy as np

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import motion

L, M, G, B, NU = 1.0, 1.0, 9.81, 0.2, 3.0
SCIPY = "other route: balances by hand, SciPy"
START = [0.3, 0.1]
# file, gravity, distance to the mass centre, (I + mc²)/mc
CASES = {
    "(a) particle, no gravity": ("model.yaml", 0.0, L, L),
    "(b) particle": ("model.yaml", G, L, L),
    "(c) uniform rod": ("rod.yaml", G, L / 2, 2 * L / 3),
    "(c) uniform rod, no gravity": ("rod.yaml", 0.0, L / 2, 2 * L / 3),
}


def swing(t, theta, g, reduced):
    """θ̈."""
    return (-B * NU**2 * sin(NU * t) * cos(theta) - g * sin(theta)) / reduced


def force(t, theta, omega, g, c, reduced):
    """m a_G + mg j."""
    alpha = swing(t, theta, g, reduced)
    ax = -B * NU**2 * sin(NU * t) - c * (cos(theta) * alpha - sin(theta) * omega**2)
    ay = c * (sin(theta) * alpha + cos(theta) * omega**2)
    return [M * ax, M * (ay + g)]


def reference(times, g, reduced):
    return motion(lambda t, s: (s[1], swing(t, s[0], g, reduced)), START, times)


@ask("What is θ̈ in terms of θ, r(t), in symbols?")
def symbolically(case):
    pull = "b*nu^2*sin(nu*t)*cos(theta)"
    against = "closed form: moments about the support, r̈ = −b ν² sin νt"
    bob = "model.yaml"
    yield from case.symbolically({"theta": f"-{pull}/l"}, against, bob, "(a) particle, no gravity", set={"g": 0})
    yield from case.symbolically({"theta": f"-(g*sin(theta) + {pull})/l"}, against, bob, "(b) particle")
    yield from case.symbolically({"theta": f"-3*(g*sin(theta) + {pull})/(2*l)"}, against, "rod.yaml", "(c) rod")


@ask("How large is it at 0.4 s?")
def acceleration(case):
    """At t = 0.4, with θ from the run."""
    for of, (file, g, _, reduced) in CASES.items():
        run = case.run(file, parameters={"g": g})
        check = swing(0.4, run.evaluate("theta", 0.4), g, reduced)
        yield Answer(
            "θ̈", run.evaluate("accel(theta)", 0.4), "rad/s²", check, "closed form: moment about the support", 1e-11, variant=of
        )


@ask("What are force and power of the support at 0.4 s, and the state at 1, 2, 5 s, (a) without gravity?")
def run(case):
    times = [0.4, 1.0, 2.0, 5.0]
    against = SCIPY
    for name, (file, g, c, reduced) in CASES.items():
        of = "" if (file, g) == ("model.yaml", 0.0) else name
        run, check = case.run(file, parameters={"g": g}), reference(times, g, reduced)
        F = force(0.4, *check[0], g, c, reduced)
        joint = "rod" if file == "model.yaml" else "pin"
        value = [run.evaluate(f"{joint}.{part}", 0.4) for part in ("Fx", "Fy")]
        yield Answer("Fx, Fy on the pendulum", value, "N", F, against, 1e-9, variant=of)
        power = F[0] * B * NU * cos(NU * 0.4)
        yield Answer("power of the support", run.evaluate("shake.power", 0.4), "W", power, against, 1e-9, variant=of)
        yield Answer("θ at 1, 2, 5 s", run.evaluate("theta", times[1:]), "rad", check[1:, 0], against, 1e-8, variant=of)
        yield Answer("θ̇ at 1, 2, 5 s", run.evaluate("rate(theta)", times[1:]), "rad/s", check[1:, 1], against, 1e-8, variant=of)


@ask("And with θ counter-clockwise?")
def variant(case):
    """The same start on the other side: with θ → −θ the equation reads ℓθ̈ = −r̈ cos θ − g sin θ."""
    times = [1.0, 2.0, 5.0]

    def rates(t, s):
        return s[1], (B * NU**2 * sin(NU * t) * cos(s[0]) - G * sin(s[0])) / L

    check = motion(rates, START, times)
    run = case.run("counterclockwise.yaml")
    yield Answer("θ at 1, 2, 5 s", run.evaluate("theta", times), "rad", check[:, 0], SCIPY, 1e-8)
    mirrored = case.run(parameters={"theta0": -0.3, "omega0": -0.1})
    yield Answer(
        "θ of the same motion, measured clockwise", -np.array(mirrored.evaluate("theta", times)), "rad", check[:, 0], SCIPY, 1e-8
    )
