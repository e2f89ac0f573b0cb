"""19.3.12: bead and rod: a long simulation.

The system of 19.3.10 with I = 2, m = 1, a = 1, ω₀ = 1. With R = a cosh u,
    t = ∫₀ᵘ √((I + mR²)/(I + ma²)) du/ω₀,   θ = ∫₀ᵘ √((I + ma²)/(I + mR²)) du,
and θ̇ = ω₀(I + ma²)/(I + mR²), Ṙ = ω₀√((I + ma²)(R² − a²)/(I + mR²)). The angle from u to ∞ is the same integral there;
from 0 it is the complete elliptic integral K(I/(I + ma²)).
"""

from itertools import pairwise
from math import acosh, cosh, exp, sinh, sqrt

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import ellipk

from freebody.catalogue import Answer, ask

I, M, A, W = 2.0, 1.0, 1.0, 1.0
WHOLE = I + M * A**2
TIMES = [1.0, 2.0, 5.0, 10.0, 100.0, 1000.0]


def growth(u):
    return sqrt((I + M * (A * cosh(u)) ** 2) / WHOLE)


def integral(f, start, end):
    """By pieces of length 1, each exact to round-off."""
    edges = [*np.arange(start, end), end]
    return sum(quad(f, a, b, epsabs=0, epsrel=2e-14)[0] for a, b in pairwise(edges))


def at(t):
    """R, θ, Ṙ, θ̇ at a time, and u."""
    u = brentq(lambda u: integral(growth, 0.0, u) / W - t, 1e-9, acosh(2 + 4 * W * t), xtol=1e-15, rtol=1e-15)
    k = growth(u)
    return A * cosh(u), integral(lambda u: 1 / growth(u), 0.0, u), W * A * sinh(u) / k, W / k**2, u


def rest(u):
    """Angle from u to the end of time; with w = exp(−u) the range is finite."""
    return quad(lambda w: 1 / growth(-np.log(w)) / w if w > 0 else 2 * sqrt(WHOLE / M) / A, 0, exp(-u), epsabs=0, epsrel=1e-13)[0]


@ask("What are R, θ, Ṙ, θ̇ at 1, 2, 5, 10, 100, 1000 s?")
def states(case):
    run = case.run()
    for t in TIMES:
        *check, _ = at(t)
        quantities = (("R", "R", "m"), ("θ", "theta", "rad"), ("Ṙ", "rate(R)", "m/s"), ("θ̇", "rate(theta)", "rad/s"))
        for (label, text, unit), expected in zip(quantities, check, strict=True):
            yield Answer(label, run.evaluate(text, t), unit, expected, "quadrature", 1e-9, variant=f"at {t:g} s")


@ask("(a) What is the first-order form, with v = Ṙ, ω = θ̇ beside v̇ = R̈, ω̇ = θ̈?")
def first_order(case):
    """Ṙ = v, θ̇ = ω by definition; v̇ and ω̇ are the equations of motion, solved."""
    closed = {"R": "R*rate(theta)^2", "theta": "-2*m*R*rate(R)*rate(theta)/(I_O + m*R^2)"}
    yield from case.symbolically(closed, "closed form: (I_O + m R²) θ̇ is constant, no force along the slot")


@ask("(a) What does the program give that `freebody code` writes of it: dy/dt of y = (θ, R, ω, v)?")
def as_code(case):
    written = {}
    exec(case.mechanism().code(), written)
    for theta, R, omega, v in ((0.0, 1.0, 1.0, 0.0), (1.3, 2.0, 0.6, -0.4), (2.0, 30.0, 0.003, 1.7)):
        check = [omega, v, -2 * M * R * v * omega / (I + M * R**2), R * omega**2]
        value = written["derivative"](0.0, [theta, R, omega, v])
        at_state, against = f"at R = {R:g}, ω = {omega:g}, v = {v:g}", "closed form: the two equations solved"
        yield Answer(at_state, value, "", check, against, 1e-14)


@ask("(b) Is the net angle finite, how large, with what error, and how much of it remains at 1000 s?")
def net_angle(case):
    found, passed = case.mechanism().limit("theta"), case.run().evaluate("theta", 1000.0)
    exact, closed = ellipk(I / WHOLE), "closed form: K(I/(I + ma²))"
    yield Answer("θ", found.value, "rad", exact, closed, 1e-9, says=f"It is: θ tends to {{}}; {found.tail}.")
    within = bool(abs(found.value - exact) <= found.value.error)
    says = f"From the run alone that is known to {found.value.error:.0e} rad."
    yield Answer("within", within, "", True, closed, 0.0, says=says)
    says = "At 1000 s {} remain."
    yield Answer("rest", found.value - passed, "rad", rest(at(1000.0)[-1]), "quadrature", 1e-5, says=says)
    yield Answer("θ", found.value, "rad", rest(0.0), "quadrature", 1e-9, says="By quadrature the whole is the same, {}.")
