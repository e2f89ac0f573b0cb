"""Pendulum hung from a cart on an incline.

λ points down the slope, n out of it; the bob is at s λ + l (sin θ λ − cos θ n). Two balances without reactions,
both bodies along λ and the bob about the hinge:

    (M + m) s̈ + m l (θ̈ cos θ − θ̇² sin θ) = (M + m) g sin α,        l θ̈ + s̈ cos θ = −g sin(θ − α).

Elimination of s̈ leaves θ̈ (M + m sin²θ) l = −(M + m) g cos α sin θ − m l θ̇² sin θ cos θ. Then the slope's force
from both along n, the rod's tension from the bob along the rod.
"""

import numpy as np

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import motion

G = 9.81
MAIN = {"M": 2.0, "m": 1.0, "l": 0.5, "slope": np.radians(20)}
SCIPY = "other route: two balances, integrated by SciPy"


def accelerations(theta, spin, M, m, l, slope):
    """s̈, θ̈."""
    c, s = np.cos(theta), np.sin(theta)
    turn = -(((M + m) * G * np.cos(slope) + m * l * spin**2 * c) * s) / ((M + m * s * s) * l)
    return G * np.sin(slope) - m * l * (turn * c - spin**2 * s) / (M + m), turn


def coupled(theta, spin, M, m, l, slope):
    """The same from the pair of equations as a matrix."""
    c, s = np.cos(theta), np.sin(theta)
    matrix = [[M + m, m * l * c], [c, l]]
    return np.linalg.solve(matrix, [(M + m) * G * np.sin(slope) + m * l * spin**2 * s, -G * np.sin(theta - slope)])


def forces(theta, spin, M, m, l, slope):
    """Force of the slope on the cart along n; tension of the rod."""
    along, turn = accelerations(theta, spin, M, m, l, slope)
    normal = (M + m) * G * np.cos(slope) + m * l * (turn * np.sin(theta) + spin**2 * np.cos(theta))
    return normal, m * (G * np.cos(theta - slope) - along * np.sin(theta) + l * spin**2)


@ask("What is the equation for θ̈ alone, and its limits for α = 0 and M → ∞?")
def symbolically(case):
    below = "(M + m*sin(theta)^2)"
    closed = {
        "theta": f"-(m*l*rate(theta)^2*cos(theta) + (M + m)*g*cos(slope))*sin(theta)/(l*{below})",
        "theta, M → inf": "-g*cos(slope)*sin(theta)/l",
        "theta, slope → 0": f"-(m*l*rate(theta)^2*cos(theta) + (M + m)*g)*sin(theta)/(l*{below})",
    }
    yield from case.symbolically(closed, "closed form: elimination of s̈ by hand")


@ask("What is the coupled pair?")
def pair(case):
    along = "(M + m)*accel(s) + m*l*(accel(theta)*cos(theta) - rate(theta)^2*sin(theta)) - (M + m)*g*sin(slope)"
    across = "m*(accel(s)*cos(theta) + l*accel(theta)) - m*g*sin(slope - theta)"
    yield from case.balances([along, across], "closed form: momentum along the slope, and of the bob across the rod")


@ask("What are s̈, θ̈, the force of the incline and the tension of the rod at θ = 0.6, θ̇ = 0?")
def instants(case):
    for spin in (0, 3):
        now = case.instant(theta=0.6, rates={"theta": spin, "s": 0})
        found, of = [now["accel(s)"], now["accel(theta)"]], f"θ̇ = {spin}" if spin else ""
        alone, pair = accelerations(0.6, spin, **MAIN), coupled(0.6, spin, **MAIN)
        against = "closed form: equation for θ̈ alone"
        for name, unit, value, check in zip(("s̈", "θ̈"), ("m/s²", "rad/s²"), found, alone, strict=True):
            yield Answer(name, value, unit, check, against, 1e-12, variant=of)
        says = "The coupled pair as a matrix gives the same."
        yield Answer("s̈, θ̈", found, "", pair, "closed form: coupled pair", 1e-12, says=says, variant=of)
        values, check = [now["wheels.Fn"], now["rod.tension"]], forces(0.6, spin, **MAIN)
        says, against = "The incline pushes with {}, the rod pulls with {}.", "closed form: balances along n and along the rod"
        yield Answer("incline, rod", values, "N", check, against, 1e-12, says=says, variant=of)


@ask("How does it move for 5 s, and how does the momentum along the slope grow?")
def motions(case):
    times = np.array([1.0, 2.0, 3.0, 4.0, 5.0])
    sets = [(2, 1, 0.5, 20, 0.6, 0), (1, 1, 1, 30, np.radians(30), 0), (1, 3, 0.8, 15, 1.2, 2.5)]
    for M, m, l, slope, theta, spin in sets:
        figures = {"M": M, "m": m, "l": l, "slope": np.radians(slope)}
        run = case.run(parameters=figures, initial={"s": 0, "theta": theta, "rates": {"s": 0, "theta": spin}})
        check = motion(lambda t, y, f=figures: [y[2], y[3], *accelerations(y[1], y[3], **f)], [0, theta, 0, spin], times)
        of = "" if spin == 0 and M == 2 else f"M = {M}, m = {m}, l = {l}, α = {slope}°, θ0 = {theta:.3g}, θ̇0 = {spin}"
        yield Answer("s at 1 … 5 s", run.evaluate("s", times), "m", check[:, 0], SCIPY, 1e-10, variant=of)
        yield Answer("θ at 1 … 5 s", run.evaluate("theta", times), "rad", check[:, 1], SCIPY, 1e-10, variant=of)
        slide = run.evaluate("momentum_x()*cos(slope) - momentum_y()*sin(slope)", times)
        check = m * l * spin * np.cos(theta) + (M + m) * G * np.sin(np.radians(slope)) * times
        against = "closed form: only weight acts along the slope"
        yield Answer("momentum along the slope then", slide, "N·s", check, against, 1e-11, variant=of)


@ask("Is it a pendulum with a fixed pivot on level ground, under a cart of 1e12 kg?")
def limit(case):
    now = case.instant(parameters={"slope": 0, "M": 1e12}, theta=0.6, rates={"theta": 3, "s": 0})
    yield Answer("θ̈", now["accel(theta)"], "rad/s²", -G / 0.5 * np.sin(0.6), "closed form: pendulum with a fixed pivot", 1e-11)


@ask("Is all of it the same with the rod as a massless body instead of a link?")
def as_body(case):
    now = case.instant("rod_as_body.yaml", theta=0.6, rates={"theta": 3, "s": 0})
    values, says = [now["accel(s)"], now["accel(theta)"]], "At θ = 0.6, θ̇ = 3 it has the same s̈ and θ̈."
    check = accelerations(0.6, 3, **MAIN)
    yield Answer("s̈, θ̈", values, "", check, "closed form: equation for θ̈ alone", 1e-12, says=says)
    says = "The rod pulls with {} then."
    check = forces(0.6, 3, **MAIN)[1]
    yield Answer("force in the rod", now["end.F"], "N", check, "closed form: balance along the rod", 1e-12, says=says)
    run, times = case.run("rod_as_body.yaml"), np.array([1.0, 3.0, 5.0])
    check = case.run().evaluate("theta", times)
    yield Answer("θ at 1, 3, 5 s", run.evaluate("theta", times), "rad", check, "other route: rod as a link", 1e-10)
