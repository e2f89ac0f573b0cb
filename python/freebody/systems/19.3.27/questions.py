"""19.3.27: balancing a broom by vertical shaking.

(a)–(d) The broom is cut free from the hand; in the balance of moments about the point that is at the hinge now, the force of the
hand drops out. With y_h = a cos Ωt:  a_G = ÿ_h j + (ℓ/2)(θ̈ e_θ − θ̇² e_r).
(e) (mℓ²/3)(θ̈ + cθ̇) = (mℓ/2)(g + ÿ_h) sin θ, so θ̈ = (3/2ℓ)(g − aΩ² cos Ωt) sin θ − cθ̇.
Small θ without damping: with 2τ = Ωt this is Mathieu's equation θ'' + (A − 2q cos 2τ) θ = 0, A = −6g/(ℓΩ²), |q| = 3a/ℓ. The broom
stands between A = a₀(q) (a multiplier leaves at 1: it falls slowly) and A = b₁(q) (at −1: it swings at half the shaking).
(g) On the lower boundary a₀ ≈ −q²/2: the speed of the hand counts, aΩ > √(4gℓ/3), not its acceleration, which must be many g.
(h) Without gravity any shaking with |q| < 0.908, b₁ = 0, holds the knife in line with the motion of the hand.
"""

from functools import cache
from math import cos, exp, pi, sin, sqrt

import numpy as np
from scipy.optimize import brentq
from scipy.special import mathieu_a, mathieu_b

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import motion

G, TURN = 9.81, "2*pi/Omega"
SCIPY = "other route: the equation by hand, SciPy"
MATHIEU = "Mathieu's characteristic values, SciPy"
# of what: a, Ω, c, g
DEFAULTS = {
    "a 0.1, Ω 60": (0.1, 60.0, 0.0, G),
    "a 0.05, Ω 60": (0.05, 60.0, 0.0, G),
    "a 0.05, Ω 100": (0.05, 100.0, 0.0, G),
    "a 0.35, Ω 60": (0.35, 60.0, 0.0, G),
    "a 0.1, Ω 60, c 0.5": (0.1, 60.0, 0.5, G),
    "no gravity, a 0.03, Ω 80": (0.03, 80.0, 0.0, 0.0),
}


def parameters(a, omega, c, g):
    return {"a": a, "Omega": omega, "c": c, "g": g}


def shaken(case, *numbers):
    """Motions that come back after one shake, near upright."""
    return case.mechanism(**parameters(*numbers)).periodic(period=TURN, theta=0)


@cache
def monodromy(a, omega, c, g):
    """Of the linear equation, (θ, θ̇) after a shake."""

    def rates(t, s):
        return s[1], 1.5 * (g - a * omega**2 * cos(omega * t)) * s[0] - c * s[1]

    return np.array([motion(rates, start, [2 * pi / omega])[0] for start in np.eye(2)]).T


@ask("(e) In symbols: the equation for θ")
def symbolically(case):
    closed = "3*(g - a*Omega^2*cos(Omega*t))*sin(theta)/(2*l) - c*rate(theta)"
    yield from case.symbolically({"theta": closed}, "closed form: moments about the point at the hinge")


@ask("(f) Simulation: 2 s from θ 0.1 and 0.5, hand at its top")
def runs(case):
    """Shaken too far it tumbles without order, and of a motion of 2 s hold fewer digits."""
    times = [0.5, 1.0, 2.0]
    for of, (a, omega, c, g) in DEFAULTS.items():

        def rates(t, s, a=a, omega=omega, c=c, g=g):
            return s[1], 1.5 * (g - a * omega**2 * cos(omega * t)) * sin(s[0]) - c * s[1]

        for theta in (0.1, 0.5):
            run = case.run(parameters=parameters(a, omega, c, g), theta=theta, rtol=1e-13)
            check = motion(rates, [theta, 0.0], times)
            within = 1e-4 if a > 0.3 else 1e-9
            yield Answer(f"θ at 0.5, 1, 2 s from {theta}, {of}", run.evaluate("theta", times), "rad", check[:, 0], SCIPY, within)


@ask("Floquet multipliers of each, and the slow frequency where it stands")
def multipliers(case):
    for of, numbers in DEFAULTS.items():
        found, check = shaken(case, *numbers).find(), monodromy(*numbers)
        yield Answer(f"trace of the monodromy matrix, {of}", found.slopes.trace(), "", check.trace(), SCIPY, 1e-10)
        known = np.linalg.eigvals(check)
        sizes = sorted(abs(known), reverse=True)
        yield Answer(f"moduli of the multipliers, {of}", abs(found.multipliers), "", sizes, SCIPY, 1e-9)
        lost = exp(-numbers[2] * 2 * pi / numbers[1])
        yield Answer(f"their product, {of}", abs(found.multipliers.prod()), "", lost, "closed form: Liouville, exp(−cT)", 1e-10)
        if abs(known[0].imag) > 0:
            slow = abs(np.angle(known[0])) * numbers[1] / (2 * pi)
            yield Answer(f"slow frequency, {of}", abs(found.exponents[0].imag), "rad/s", slow, SCIPY, 1e-9)
            averaged = sqrt(max(1.125 * (numbers[0] * numbers[1]) ** 2 - 1.5 * numbers[3], 0))
            against = "averaging: √((3aΩ/2ℓ)²/2 − 3g/2ℓ), the first term in a/ℓ"
            yield Answer(f"the same, {of}", abs(found.exponents[0].imag), "rad/s", averaged, against, 2 * numbers[0])


@ask("(g) Lower boundary Ω(a): shaken slower, it falls; the acceleration of the hand there")
def lower(case):
    found = shaken(case, *DEFAULTS["a 0.1, Ω 60"]).boundary_curve(
        "Omega", (15, 3000), "a", [0.2, 0.1, 0.05, 0.02, 0.01, 0.005], 10
    )
    for each in found:
        a = each.others["a"]
        check = sqrt(6 * G / -mathieu_a(0, 3 * a))
        yield Answer(f"Ω at which a multiplier leaves {each.kind}, a = {a}", each.value, "rad/s", check, MATHIEU, 1e-8)
        yield Answer(f"aΩ²/g there, a = {a}", a * each.value**2 / G, "", a * check**2 / G, MATHIEU, 1e-8)
        yield Answer(f"aΩ there, a = {a}", a * each.value, "m/s", sqrt(4 * G / 3), "averaging: √(4gℓ/3), as a → 0", 1.5 * a)


@ask("(g) Upper boundary a(Ω): shaken farther, it swings at half the frequency")
def upper(case):
    for omega in (40, 60, 100, 200, 400, 1000):
        found = shaken(case, *DEFAULTS["a 0.1, Ω 60"]).boundary("a", (0.1, 0.5), 6, Omega=omega)
        check = brentq(lambda a, omega=omega: mathieu_b(1, 3 * a) + 6 * G / omega**2, 0.1, 0.5, xtol=1e-15)
        value = [each.value for each in found if each.kind == "at -1"]
        yield Answer(f"a at which a multiplier leaves at −1, Ω = {omega}", value, "m", [check], MATHIEU, 1e-8)


@ask("(g) What damping changes: c = 3 at a = 0.05")
def damped(case):
    """Within the region the perturbations die out; its lower boundary stays where it is, or nearly."""
    (found,) = shaken(case, *DEFAULTS["a 0.05, Ω 60"]).boundary("Omega", (30, 200), 6, c=3)

    def condition(omega):
        return np.linalg.det(monodromy(0.05, omega, 3.0, G) - np.eye(2))

    yield Answer("Ω on the lower boundary", found.value, "rad/s", brentq(condition, 30, 200, xtol=1e-11), SCIPY, 1e-8)
    without = sqrt(6 * G / -mathieu_a(0, 0.15))
    yield Answer("the same, against that without damping", found.value, "rad/s", without, MATHIEU, 2e-3)


@ask("(h) The knife on a table: no gravity")
def knife(case):
    """Any small amplitude holds it, at any frequency; only a(Ω) = 0.908ℓ/3, where b₁ = 0, is too much."""
    standing = shaken(case, *DEFAULTS["no gravity, a 0.03, Ω 80"])
    for omega in (8, 80, 800):
        found = [each for each in standing.boundary("a", (0.001, 0.5), 8, Omega=omega) if each.kind == "at -1"]
        check = brentq(lambda q: mathieu_b(1, q), 0.5, 1.2, xtol=1e-15) / 3
        yield Answer(f"a at which it begins to swing, Ω = {omega}", [each.value for each in found], "m", [check], MATHIEU, 1e-8)
    for a in (0.001, 0.01):
        moduli = abs(standing.find(a=a).multipliers)
        yield Answer(f"moduli of the multipliers, a = {a}", moduli, "", [1.0, 1.0], "closed form: a₀ < A = 0 < b₁", 1e-9)


@ask("(h) And on a rough table, the knife on five points?")
def rough_table(case):
    """The points slide mostly along the knife, so that what is left of friction across it brakes the swing as a damper would."""
    a, omega, mu, times = 0.03, 80.0, 0.2, [0.25, 0.5, 0.75, 1.0]

    def rates(t, s):
        moment = 0.0
        for at in (0.25, 0.5, 0.75, 1.0):
            across, along = at * s[1], a * omega * cos(omega * t) * cos(s[0])
            slip = -a * omega * cos(omega * t) * sin(s[0])
            moment -= at * mu * G / 5 * (across + slip) / np.hypot(across + slip, along)
        return s[1], -1.5 * a * omega**2 * sin(omega * t) * sin(s[0]) + 3 * moment

    check = motion(rates, [0.1, 0.0], times)
    run = case.run("table.yaml")
    yield Answer("θ at 0.25, 0.5, 0.75, 1 s", run.evaluate("theta", times), "rad", check[:, 0], SCIPY, 1e-7)
    ends = np.linspace(0.9, 1.0, 201)
    swing = [np.abs(run.evaluate("theta", ends)).max(), np.abs(motion(rates, [0.1, 0.0], ends)[:, 0]).max()]
    says = "Friction does not make it fall: it still stands, and of its swing of 0.1 rad {} are left after a second."
    yield Answer("swing", swing[0], "rad", swing[1], SCIPY, 1e-6, 0.1, says=says)
