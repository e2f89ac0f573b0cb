"""19.3.27: balancing a broom by vertical shaking.

(a)–(d) The broom is cut free from the hand; in the balance of moments about the point that is at the hinge now, the force of the
hand drops out. With y_h = a cos Ωt:  a_G = ÿ_h j + (ℓ/2)(θ̈ e_θ − θ̇² e_r).
(e) (mℓ²/3)(θ̈ + cθ̇) = (mℓ/2)(g + ÿ_h) sin θ, so θ̈ = (3/2ℓ)(g − aΩ² cos Ωt) sin θ − cθ̇.
Small θ without damping: with 2τ = Ωt this is Mathieu's equation θ'' + (A − 2q cos 2τ) θ = 0, A = −6g/(ℓΩ²), |q| = 3a/ℓ. The broom
stands between A = a₀(q) (a multiplier leaves at 1: it falls slowly) and A = b₁(q) (at −1: it swings at half the shaking).
(g) On the lower boundary a₀ ≈ −q²/2: the speed of the hand counts, aΩ > √(4gℓ/3), not its acceleration, which must be many g.
(h) Without gravity any shaking with |q| < 0.908, b₁ = 0, holds the knife in line with the motion of the hand. On a rough table points of
it slide along their velocities V = v + ω k × r; so do those of an area, where with r from the instantaneous centre the force is
−∫ V/|V| dA = −sign ω ∮ |r| dr, its moment about that centre −sign ω ∫ |r| dA.
"""

from functools import cache
from itertools import product
from math import asinh, cos, exp, hypot, pi, sin, sqrt

import numpy as np
from numpy.polynomial.legendre import leggauss
from scipy.interpolate import BarycentricInterpolator
from scipy.optimize import brentq
from scipy.special import mathieu_a, mathieu_b

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import motion

G, TURN = 9.81, "2*pi/Omega"
SCIPY = "other route: the equation by hand, SciPy"
MATHIEU = "Mathieu's characteristic values, SciPy"
DEFAULTS = {
    "": (0.1, 60.0, 0.0, G),
    "a 0.05, Ω 60": (0.05, 60.0, 0.0, G),
    "a 0.05, Ω 100": (0.05, 100.0, 0.0, G),
    "a 0.35, Ω 60": (0.35, 60.0, 0.0, G),
    "a 0.1, Ω 60, c 0.5": (0.1, 60.0, 0.5, G),
    "no gravity, a 0.03, Ω 80": (0.03, 80.0, 0.0, 0.0),
}
"""Of what: a (m), Ω (rad/s), c (1/s), g (m/s²)."""
A, OMEGA, MU = 0.03, 80.0, 0.2
"""Of the knife on a rough table."""


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


@ask("(a)–(e) What are the balances, one about the point that is at the hinge, and the equation for θ?")
def symbolically(case):
    about = "closed form: moments about the point at the hinge"
    momentum = "m*(accel(y) - l/2*(sin(theta)*accel(theta) + cos(theta)*rate(theta)^2)) - shaking.force + m*g"
    moment = "m*l^2/3*(accel(theta) + c*rate(theta)) - m*l/2*(g + accel(y))*sin(theta)"
    yield from case.balances([momentum, moment, "accel(y) + a*Omega^2*cos(Omega*t)"], about)
    closed = "3*(g - a*Omega^2*cos(Omega*t))*sin(theta)/(2*l) - c*rate(theta)"
    yield from case.symbolically({"theta": closed}, about)


@ask("(f) How does it move for 2 s from θ = 0.1, hand at its top, a = 0.1 m, Ω = 60 rad/s?")
def runs(case):
    """Shaken too far it tumbles without order, and of a motion of 2 s hold fewer digits."""
    times = [0.5, 1.0, 2.0]
    for (of, (a, omega, c, g)), theta in product(DEFAULTS.items(), (0.1, 0.5)):

        def rates(t, s, a=a, omega=omega, c=c, g=g):
            return s[1], 1.5 * (g - a * omega**2 * cos(omega * t)) * sin(s[0]) - c * s[1]

        run = case.run(parameters=parameters(a, omega, c, g), theta=theta, rtol=1e-13)
        check, within = motion(rates, [theta, 0.0], times)[:, 0], 1e-4 if a > 0.3 else 1e-9
        of = ", ".join(filter(None, (of, "from 0.5" if theta == 0.5 else "")))
        yield Answer("θ at 0.5, 1, 2 s", run.evaluate("theta", times), "rad", check, SCIPY, within, variant=of)


@ask("(g) What are its Floquet multipliers with a = 0.1 m, Ω = 60 rad/s, and how slowly does it swing?")
def multipliers(case):
    for of, numbers in DEFAULTS.items():
        found, check = shaken(case, *numbers).find(), monodromy(*numbers)
        trace = found.slopes.trace()
        yield Answer("trace of the monodromy matrix", trace, "", check.trace(), SCIPY, 1e-10, variant=of)
        known = np.linalg.eigvals(check)
        sizes = sorted(abs(known), reverse=True)
        yield Answer("moduli of the multipliers", abs(found.multipliers), "", sizes, SCIPY, 1e-9, variant=of)
        lost, against = exp(-numbers[2] * 2 * pi / numbers[1]), "closed form: Liouville, exp(−cT)"
        yield Answer("their product", abs(found.multipliers.prod()), "", lost, against, 1e-10, variant=of)
        stands = sizes[0] < 1 + 1e-9
        says = "It stands." if stands else "It falls." if known[0].real > 0 else "It swings farther and farther."
        yield Answer("stands", bool(abs(found.multipliers).max() < 1 + 1e-9), "", stands, SCIPY, says=says, variant=of)
        if abs(known[0].imag) > 0:
            slow, says = abs(np.angle(known[0])) * numbers[1] / (2 * pi), "It swings slowly, with {}."
            yield Answer("frequency", abs(found.exponents[0].imag), "rad/s", slow, SCIPY, 1e-9, says=says, variant=of)


@ask(
    "(g) How fast must it be shaken with a = 0.2 m so that it does not fall, and how large is the acceleration of the hand then?"
)
def lower(case):
    amplitudes = [0.2, 0.1, 0.05, 0.02, 0.01, 0.005]
    found = shaken(case, *DEFAULTS[""]).boundary_curve("Omega", (15, 3000), "a", amplitudes, 10)
    for each in found:
        a = each.others["a"]
        check, of = sqrt(6 * G / -mathieu_a(0, 3 * a)), "" if a == 0.2 else f"a = {a} m"
        says = "From Ω = {} on: slower, a multiplier is greater than 1."
        yield Answer("least Ω", each.value, "rad/s", check, MATHIEU, 1e-8, says=says, variant=of)
        says = "The hand is accelerated by {} g."
        yield Answer("aΩ²/g", a * each.value**2 / G, "", a * check**2 / G, MATHIEU, 1e-8, says=says, variant=of)
    squares, speeds = ([f(each) for each in found] for f in (lambda x: x.others["a"] ** 2, lambda x: x.others["a"] * x.value))
    speed, says = float(BarycentricInterpolator(squares, speeds)(0.0)), "As a → 0 its greatest speed aΩ tends to {}."
    yield Answer("aΩ", speed, "m/s", sqrt(4 * G / 3), "averaging: √(4gℓ/3)", 1e-8, says=says)


@ask("(g) How far may it be shaken at Ω = 40 rad/s?")
def upper(case):
    for omega in (40, 60, 100, 200, 400, 1000):
        found = shaken(case, *DEFAULTS[""]).boundary("a", (0.1, 0.5), 6, Omega=omega)
        check = brentq(lambda a, omega=omega: mathieu_b(1, 3 * a) + 6 * G / omega**2, 0.1, 0.5, xtol=1e-15)
        value = [each.value for each in found if each.kind == "at -1"]
        says, of = "Up to a = {}: farther, it swings at half the frequency.", "" if omega == 40 else f"Ω = {omega} rad/s"
        yield Answer("greatest a", value, "m", [check], MATHIEU, 1e-8, says=says, variant=of)


@ask("(g) What does damping change, c = 3 1/s?")
def damped(case):
    """Within the region the perturbations die out; its lower boundary stays where it is, or nearly."""
    broom = shaken(case, *DEFAULTS["a 0.05, Ω 60"])
    for sign, name, of, low, high, says in (
        (-1, "Omega", 0.05, 30.0, 200.0, "With a = 0.05 m it stands from Ω = {} on; without damping from {} on."),
        (1, "a", 60.0, 0.1, 0.5, "With Ω = 60 rad/s it stands up to a = {}; without damping up to {}."),
    ):
        held, unit = ("Omega", "m") if name == "a" else ("a", "rad/s")
        values, checks = [], []
        for c in (3.0, 0.0):
            found = broom.boundary(name, (low, high), 6, c=c, **{held: of})
            values.append(next(each.value for each in found if each.kind == f"at {-sign}"))

            def left(x, c=c, held=held, of=of, sign=sign):
                numbers = (x, of) if held == "Omega" else (of, x)
                return np.linalg.det(monodromy(*numbers, c, G) + sign * np.eye(2))

            checks.append(brentq(left, low, high, xtol=1e-11))
        yield Answer(name, values, unit, checks, SCIPY, 1e-8, says=says)


@ask("(h) Does the knife on a smooth table stand in line with the motion of the hand?")
def knife(case):
    """Any small amplitude holds it, at any frequency; only a(Ω) = 0.908ℓ/3, where b₁ = 0, is too much."""
    standing = shaken(case, *DEFAULTS["no gravity, a 0.03, Ω 80"])
    moduli = np.concatenate([abs(standing.find(a=a).multipliers) for a in (0.001, 0.01)])
    says = "It does with any small amplitude: with 1 mm and with 1 cm the moduli of its multipliers are {}."
    yield Answer("moduli", moduli, "", np.ones(4), "closed form: a₀ < A = 0 < b₁", 1e-9, says=says)
    check = brentq(lambda q: mathieu_b(1, q), 0.5, 1.2, xtol=1e-15) / 3
    for omega in (8, 80, 800):
        found = [each for each in standing.boundary("a", (0.001, 0.5), 8, Omega=omega) if each.kind == "at -1"]
        says, of = "From a = {} on it swings farther and farther.", "" if omega == 8 else f"Ω = {omega} rad/s"
        yield Answer("a", [each.value for each in found], "m", [check], MATHIEU, 1e-8, says=says, variant=of)


def of_points(slip, spin):
    """The moment about the hinge of the friction on five points, evenly pressed, over its greatest force (m); x along the knife."""
    ways = [(at, slip + 1j * spin * at) for at in (0.0, 0.25, 0.5, 0.75, 1.0)]
    return -sum(at * way.imag / abs(way) for at, way in ways) / 5


def of_area(slip, spin, width=0.04):
    """The same of an even pressure: by rays from the instantaneous centre, summed side by side; where that is far, by Gauss's rule."""
    if abs(slip) > 50 * abs(spin):
        x, weights = leggauss(8)
        at = np.add.outer((1 + x) / 2, 0.5j * width * x)
        way = slip + 1j * spin * at
        return -weights @ (np.conj(at) * way / abs(way)).imag @ weights / 4
    centre, area = 1j * slip / spin, width
    corners = np.array([-0.5j * width, 1 - 0.5j * width, 1 + 0.5j * width, 0.5j * width]) - centre
    force, moment = 0j, 0.0
    for start, end in zip(corners, np.roll(corners, -1), strict=True):
        along = (end - start) / abs(end - start)
        away = (np.conj(start) * along).imag
        ends = [(x * hypot(x, away) + away**2 * asinh(x / abs(away))) / 2 for x in (np.conj(along) * np.array([end, start])).real]
        force += along * (ends[0] - ends[1])
        moment += away / 3 * (ends[0] - ends[1])
    return -np.sign(spin) * (moment + (np.conj(centre) * force).imag) / area


KNIVES = {
    "table.yaml": ("", of_points, 1 / 3),
    "plate.yaml": ("flat on the table, 4 cm wide", of_area, 1 / 3 + 0.04**2 / 12),
}


@ask("(h) And on a rough table, μ = 0.2, the knife on five points, from θ = 0.1 with a = 0.03 m, Ω = 80 rad/s?")
def rough_table(case):
    """It slides mostly along itself, so that what is left of friction across it brakes the swing as a damper would."""
    times, ends = [0.25, 0.5, 0.75, 1.0], np.linspace(0.9, 1.0, 201)
    for file, (of, rubbing, inertia) in KNIVES.items():

        def rates(t, s, rubbing=rubbing, inertia=inertia):
            slip = A * OMEGA * cos(OMEGA * t) * np.exp(1j * s[0])
            pull = -A * OMEGA**2 * sin(OMEGA * t) * sin(s[0]) / 2
            return s[1], (pull - MU * G * rubbing(slip, -s[1])) / inertia

        run, check = case.run(file), motion(rates, [0.1, 0.0], [*times[:3], *ends])[:, 0]
        yield Answer(
            "θ at 0.25, 0.5, 0.75, 1 s", run.evaluate("theta", times), "rad", check[[0, 1, 2, -1]], SCIPY, 1e-7, variant=of
        )
        left, says = np.abs(run.evaluate("theta", ends)).max(), "It stands all the same; after a second it swings by {}."
        yield Answer("swing", left, "rad", np.abs(check[3:]).max(), SCIPY, 1e-6, 0.1, says=says, variant=of)
