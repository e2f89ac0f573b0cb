"""19.3.6: falling rod on ice.

Tilt θ from the vertical, start θ₀ at rest. All forces are vertical: the mass centre falls straight down, y = (ℓ/2) cos θ.
With the foot on the ice the energy gives θ̇, and the momenta N and (c):
    (1 + 3 sin²θ) θ̇² = (12 g/ℓ)(cos θ₀ − cos θ),
    (1 + 3 sin²θ) θ̈ + 3 sin θ cos θ θ̇² = (6 g/ℓ) sin θ          (m falls out),
    N = mg (3c² − 6 c₀ c + 4)/(4 − 3c²)²,  c = cos θ,  c₀ = cos θ₀.
3c² − 6c₀c + 4 = 3(c − c₀)² + 4 − 3c₀² ≥ 1: the rod never leaves the ice, the assumption is right. N is least where
3c³ − 9c₀c² + 12c − 4c₀ = 0. Flat: θ̇² = 12 g c₀/(4ℓ) → 3g/ℓ for θ₀ → 0. The time to fall grows as ln(1/θ₀).
"""

from math import acos, acosh, cos, cosh, pi, sin, sqrt

from scipy.integrate import quad
from scipy.optimize import brentq

from freebody.catalogue import Answer, ask, reference

L, M, G, TILT = 1.8, 70.0, 9.81, 0.02


def turning(theta, start):
    return sqrt(12 * G / L * (cos(start) - cos(theta)) / (1 + 3 * sin(theta) ** 2))


def bend(theta, rate):
    """θ̈ of (c)."""
    return (6 * G / L - 3 * cos(theta) * rate**2) * sin(theta) / (1 + 3 * sin(theta) ** 2)


def force(c, c0):
    return M * G * (3 * c**2 - 6 * c0 * c + 4) / (4 - 3 * c**2) ** 2


def at_least(start):
    """cos θ where the ice pushes least."""
    c0 = cos(start)
    return brentq(lambda c: 3 * c**3 - 9 * c0 * c**2 + 12 * c - 4 * c0, 0, 1, xtol=1e-15)


def fall_time(start):
    """∫dθ/θ̇ with sin(θ/2) = sin(θ₀/2) cosh v: cos θ₀ − cos θ = 2 sin²(θ₀/2) sinh² v, so nothing is singular at the start."""
    s = sin(start / 2)

    def slope(v):
        sine = min(1.0, s * cosh(v))
        return sqrt((1 + 12 * sine**2 * (1 - sine**2)) / (1 - sine**2))

    return sqrt(L / (6 * G)) * quad(slope, 0, acosh(sin(pi / 4) / s), epsabs=0, epsrel=1e-13, limit=200)[0]


@ask("(c) What is one differential equation in θ, θ̇, θ̈, m, g, ℓ only, θ the tilt?")
def symbolically(case):
    closed = "3*sin(theta)*(2*g - l*rate(theta)^2*cos(theta))/(l*(1 + 3*sin(theta)^2))"
    yield from case.symbolically({"theta": closed}, "closed form: balance of energy, differentiated")
    for tilt, rate in ((0.02, 0.0), (0.5, 1.0), (1.0, 2.0), (1.5, 4.0)):
        now = case.instant(theta=tilt, x=0.0, rates={"theta": rate})
        at = f"at θ = {tilt:g}, θ̇ = {rate:g} rad/s"
        yield Answer("θ̈", now.accelerations["theta"], "rad/s²", bend(tilt, rate), "closed form: (c)", 1e-12, variant=at)


@ask("(a) What path does the mass centre take?")
def path(case):
    run = case.run()
    times = [0.5, 0.8, 1.0, run.events[-1].t]
    x = run.evaluate("x(rod.G)", times)
    says = "It falls straight down: at 0.5, 0.8, 1 s and flat it is {} beside its start."
    yield Answer("x at 0.5, 0.8, 1 s and flat", x, "m", [0.0] * 4, "conservation: no horizontal force", 1e-12, L, says=says)
    y = run.evaluate("y(rod.G) - l/2*cos(theta)", times)
    says = "Its height is (ℓ/2) cos θ, to {}: the foot stays on the ice."
    yield Answer("y − (ℓ/2) cos θ then", y, "m", [0.0] * 4, "geometry", 1e-11, L, says=says)


@ask("(b) How fast does the rod turn just before it lies flat, the contact assumed to last?")
def flat(case):
    event, energy = case.run().events[-1], "conservation of energy"
    says = "The rod falls flat at {}."
    yield Answer("θ̇ when flat", event.u["theta"], "rad/s", sqrt(3 * G * cos(TILT) / L), energy, 1e-10, says=says)
    yield Answer("time of the fall", event.t, "s", fall_time(TILT), "quadrature", 1e-10, says="It has fallen for {}.")
    found = case.mechanism().limit("rate(theta) @ end", vary="tilt", towards=0.0, begin=0.05)
    yield Answer("θ̇ when flat", found.value, "rad/s", sqrt(3 * G / L), "closed form: √(3g/ℓ)", 1e-9, variant="as θ₀ → 0")


@ask("(b) Is the assumption right: is the contact kept, how hard does the ice push, and where least?")
def kept(case):
    """The run would end by the event `lifts off` where the guide had to pull."""
    run, against = case.run(), "closed form: dN/dθ = 0"
    lifts, least = any(event.name == "lifts off" for event in run.events), run.report["least force of the ice"]
    says = "The guide never has to pull: the contact is kept." if not lifts else "The guide has to pull: the rod lifts off."
    yield Answer("lifts off", lifts, check=False, against="closed form: N > 0", says=says, scale=1.0)
    c0, c = cos(TILT), at_least(TILT)
    yield Answer("least force", least.value, "N", force(c, c0), against, 1e-10, says="The ice pushes with {} at least.")
    yield Answer("tilt then", run.evaluate("theta", least.t), "rad", acos(c), against, 1e-6, says="The tilt then is {}.")
    times = [0.0, 0.5, 0.8, 1.0, run.events[-1].t]
    tilts = [TILT, *reference.motion(lambda t, y: [y[1], bend(*y)], [TILT, 0], times[1:])[:, 0]]
    check = [force(cos(tilt), c0) for tilt in tilts]
    against = "closed form: N(θ), with θ by SciPy"
    yield Answer("force at 0, 0.5, 0.8, 1 s and flat", run.evaluate("foot.Fn", times), "N", check, against, 1e-9)
    found = case.mechanism().extremes("least force of the ice", vary="tilt", within=(0.02, 1.4), points=9)
    says, of = "It is {} at least: the contact is kept from all of them.", "all tilts from 0.02 to 1.4 at the start"
    yield Answer("least force", found.least.value, "N", force(c, c0), "closed form: dN/dθ = 0", 1e-9, says=says, variant=of)


@ask("How does the rod lie and move after 1 s?")
def one_second(case):
    ((theta, rate),) = reference.motion(lambda t, y: [y[1], bend(*y)], [TILT, 0], [1.0])
    run, against = case.run(), "other route: (c) integrated by SciPy"
    yield Answer("θ", run.evaluate("theta", 1.0), "rad", theta, against, 1e-10)
    yield Answer("θ̇", run.evaluate("rate(theta)", 1.0), "rad/s", rate, against, 1e-10)
    yield Answer("height of the mass centre", run.evaluate("y(rod.G)", 1.0), "m", L / 2 * cos(theta), against, 1e-10)
