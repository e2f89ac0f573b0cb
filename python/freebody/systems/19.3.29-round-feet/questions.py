"""19.3.29: rocker on round feet.

d = L/2 − R from the arc's centre up to G. Rolling, G is at (Rφ + d sin φ, R + d cos φ); J(φ) = mL²/12 + m(R² + d² + 2Rd cos
φ) about the place of contact. The energy ½Jφ̇² + mgd cos φ is constant; its rate:
    Jφ̈ = mgd sin φ + mRd sin φ φ̇²,  for small φ, φ̇:  φ̈ = g(L/2 − R)φ/(L²/3).
(b) Upright it is stable for R > L/2, unstable for R < L/2, and for R = L/2 it stands in any position; m and g do not matter.
The floor: N = m(g − d(φ̈ sin φ + φ̇² cos φ)), friction m((R + d cos φ)φ̈ − dφ̇² sin φ).
With L measured from the arc's centre, d = L/2 for every R: never stable.
"""

from math import acos, cos, pi, sin, sqrt

import numpy as np
from scipy.integrate import quad

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import event, motion

M, G = 70.0, 9.81
SETS = [(1.2, 1.8, 0.2, 0.0), (1.2, 1.8, 1.0, 0.3), (0.3, 1.8, 0.02, 0.0), (0.9, 1.8, 0.1, 0.25)]
TIMES = [1.0, 2.0, 3.0, 4.0, 5.0]
EQUATIONS = "closed form: moments about the contact"
SCIPY = "other route: moments about the contact, SciPy"


def told(values):
    """What differs from the first set."""
    return "" if values == SETS[0] else "R = {:g} m, L = {:g} m, φ = {:g}, φ̇ = {:g} rad/s".format(*values)


class Rocker:
    """Closed forms for one set of sizes; with ``above``, L is measured from the arc's centre."""

    def __init__(self, R, L, above=False):
        self.R, self.L = R, L
        self.d = L / 2 if above else L / 2 - R

    def inertia(self, phi):
        return M * self.L**2 / 12 + M * (self.R**2 + self.d**2 + 2 * self.R * self.d * cos(phi))

    def turning(self, phi, w):
        return M * self.d * sin(phi) * (G + self.R * w**2) / self.inertia(phi)

    def rates(self, _t, y):
        return y[1], self.turning(*y)

    def floor(self, phi, w):
        a, d = self.turning(phi, w), self.d
        return M * (G - d * (a * sin(phi) + w**2 * cos(phi))), M * ((self.R + d * cos(phi)) * a - d * w**2 * sin(phi))

    def period(self, phi, w):
        """Of the swing through (φ, φ̇), d < 0; φ = a sin s makes it smooth."""
        a = acos(cos(phi) + self.inertia(phi) * w**2 / (2 * M * G * self.d))

        def integrand(s):
            x, y = a * (1 + sin(s)) / 2, a * (1 - sin(s)) / 2
            return sqrt(self.inertia(a * sin(s)) / (-M * G * self.d * np.sinc(x / pi) * np.sinc(y / pi)))

        return 4 * quad(integrand, 0, pi / 2, epsabs=0, epsrel=1e-13)[0]

    def small(self):
        """Rate of growth, or angular frequency, of a small turn."""
        return sqrt(abs(M * G * self.d / self.inertia(0)))


def start(values):
    return dict(zip(("R", "L", "phi0", "omega0"), values, strict=True))


@ask("(a) What is the angular acceleration, the angle π/2 − φ, in symbols?")
def symbolically(case):
    d = "(L/2 - R)"
    closed = f"-{d}*cos(rocker.angle)*(g + R*rate(rocker.angle)^2)/(L^2/12 + R^2 + {d}^2 + 2*R*{d}*sin(rocker.angle))"
    yield from case.symbolically({"rocker.angle": closed}, "closed form: moments about the point of contact")


@ask("(b) What are the eigenvalues s of standing, which is stable where s² < 0?")
def standing_symbolically(case):
    closed = "s^2 + 3*g*(2*R - L)/(2*L^2)"
    yield case.eigenvalues_of(closed, "closed form: (a) for small φ", **{"rocker.angle": "90 deg"})


@ask("(a) How large is it at large angles and small, and what is the force of the floor, (R, L, φ, φ̇) = (1.2, 1.8, 0.2, 0)?")
def instants(case):
    for values in SETS:
        rocker, now, of = Rocker(*values[:2]), case.instant(parameters=start(values)), told(values)
        normal, friction = rocker.floor(*values[2:])
        yield Answer("φ̈", now["accel(phi)"], "rad/s²", rocker.turning(*values[2:]), EQUATIONS, 1e-12, 1.0, variant=of)
        yield Answer("normal force", now["foot.N"], "N", normal, "closed form: momentum", 1e-12, variant=of)
        yield Answer("friction, to +x", now["foot.T"], "N", friction, "closed form: momentum", 1e-12, M * G, variant=of)
        R, L = values[:2]
        small = case.instant(parameters=start((R, L, 1e-5, 0.0)))["accel(phi)"] / 1e-5
        yield Answer(
            "φ̈/φ for small φ", small, "1/s²", G * (L / 2 - R) / (L**2 / 3), "closed form: small φ", 1e-9, 1.0, variant=of
        )


@ask("(b) Where is standing stable: which way is a small turn accelerated, for any m and g?")
def standing(case):
    for R in (0.3, 0.89, 0.91, 1.2):
        for mass, g in ((70.0, 9.81), (1.0, 1.62)):
            now = case.instant(parameters={"m": mass, "g": g, "R": R, "phi0": 0.01})
            back, of = bool(now["accel(phi)"] < 0), f"R = {R} m, m = {mass:g} kg, g = {g} m/s²"
            says = "A small turn is driven back." if back else "A small turn grows."
            yield Answer("stable", back, "", R > 0.9, "closed form: L/2 − R", scale=1.0, says=says, variant=of)


@ask("How does it move for 5 s, with what force of the floor, and does it lift off, (R, L, φ, φ̇) = (1.2, 1.8, 0.2, 0)?")
def run(case):
    for values in SETS:
        rocker, run = Rocker(*values[:2]), case.run(parameters=start(values))
        check, of = motion(rocker.rates, values[2:], TIMES), told(values)
        yield Answer("φ at 1 … 5 s", run.evaluate("phi", TIMES), "rad", check[:, 0], SCIPY, 1e-8, variant=of)
        yield Answer("φ̇", run.evaluate("rate(phi)", TIMES), "rad/s", check[:, 1], SCIPY, 1e-8, variant=of)
        force = np.array([rocker.floor(*y) for y in check])
        yield Answer("normal force", run.evaluate("foot.N", TIMES), "N", force[:, 0], SCIPY, 1e-8, variant=of)
        yield Answer("friction", run.evaluate("foot.T", TIMES), "N", force[:, 1], SCIPY, 1e-8, M * G, variant=of)
        left = any(change.kind == "lift-off" for change in run.changes)
        least = min(rocker.floor(*y)[0] for y in motion(rocker.rates, values[2:], np.linspace(0.01, 5, 400)))
        says = "It lifts off." if left else "It never lifts off."
        yield Answer("lifts off", left, "", bool(least < 0), SCIPY, scale=1.0, says=says, variant=of)


def settled(coarse, fine):
    """The limit of no amplitude, from one and half of it: what is left goes as the square."""
    return (4 * fine - coarse) / 3


def period_of(case, values):
    run = case.run(parameters=start(values), until=10.0)
    first, second = [event.t for event in run.events if event.name == "upright"][:2]
    return second - first


@ask("What is the period at finite and at small amplitude, (R, L, φ, φ̇) = (1.2, 1.8, 0.2, 0)?")
def period(case):
    for values in [*SETS[:2], (1.2, 1.8, 0.05, 0.0)]:
        of = told(values)
        yield Answer(
            "period", period_of(case, values), "s", Rocker(*values[:2]).period(*values[2:]), "quadrature", 1e-8, variant=of
        )
    small = settled(*(period_of(case, (1.2, 1.8, phi, 0.0)) for phi in (0.02, 0.01)))
    yield Answer(
        "period at small amplitude", small, "s", 2 * pi / Rocker(1.2, 1.8).small(), "closed form: 2π√(L²/3g(R − L/2))", 1e-8
    )


def growth(case, file, rocker):
    """From a small φ0 at rest φ = φ0 cosh(λt): λ from the value at 1 s."""

    def rate(phi):
        run = case.run(file, {"R": rocker.R, "L": rocker.L, "phi0": phi}, until=1.0)
        return float(np.arccosh(run.evaluate("phi", 1.0) / phi))

    return settled(rate(8e-3), rate(4e-3))


@ask("How fast does a small turn grow when standing is unstable?")
def grows(case):
    for R in (0.3, 0.6):
        rocker = Rocker(R, 1.8)
        value, against = growth(case, "model.yaml", rocker), "closed form: √(g(L/2 − R)/(L²/3))"
        yield Answer("λ", value, "1/s", rocker.small(), against, 1e-7, variant=f"R = {R} m")


@ask("And with L measured from the arc's centre up?")
def above(case):
    times = [0.4, 0.8, 1.2]
    for R, L in ((1.2, 1.8), (0.3, 1.8), (5.0, 1.8)):
        rocker = Rocker(R, L, above=True)
        of = f"R, L = {R}, {L}"
        value, says = growth(case, "from_centre.yaml", rocker), "It is not stable: a small turn grows at {}."
        yield Answer("λ", value, "1/s", rocker.small(), EQUATIONS, 1e-7, says=says, variant=of)
        run = case.run("from_centre.yaml", {"R": R, "L": L, "phi0": 0.1}, until=1.2)
        check = motion(rocker.rates, [0.1, 0.0], times)
        yield Answer("φ at 0.4, 0.8, 1.2 s from 0.1", run.evaluate("phi", times), "rad", check[:, 0], SCIPY, 1e-9, variant=of)


@ask("Can the floor's force end, L measured from the arc's centre, R = 0.3 m, from φ = 0.1?")
def ends(case):
    """Where N reaches 0 friction still acts; without it the foot would press into the floor, with it the floor would pull."""
    rocker = Rocker(0.3, 1.8, above=True)
    when, (phi, w) = event(rocker.rates, [0.1, 0.0], lambda t, y: rocker.floor(*y)[0], before=2.0)
    outcome = case.mechanism("from_centre.yaml", R=0.3, phi0=0.1).simulate(until=2.0, rtol=1e-12).outcome
    jams = rocker.d * w**2 * cos(phi) < G  # let go, G falls with g, and the arc's centre gains d φ̇² cos φ on it
    yield Answer("end", outcome.t, "s", when, SCIPY, 1e-9, says="It ends at {}.")
    stuck, against = outcome.name == "painleve_inconsistent", "closed form: neither holding nor parting"
    says = "There the foot can neither hold nor part: the run ends and says so." if stuck else "There the foot can go on."
    yield Answer("ends", stuck, "", bool(jams), against, scale=1.0, says=says)
