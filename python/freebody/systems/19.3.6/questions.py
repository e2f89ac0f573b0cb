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
MODELS = {"": "assumed.yaml", "the contact checked": "model.yaml"}
"""Main: the contact is assumed."""


def turning(theta, start):
    return sqrt(12 * G / L * (cos(start) - cos(theta)) / (1 + 3 * sin(theta) ** 2))


def bend(theta, rate):
    """θ̈ of (c)."""
    return (6 * G / L - 3 * cos(theta) * rate**2) * sin(theta) / (1 + 3 * sin(theta) ** 2)


def force(c, c0):
    return M * G * (3 * c**2 - 6 * c0 * c + 4) / (4 - 3 * c**2) ** 2


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
    yield from case.symbolically({"theta": closed}, "closed form: balance of energy, differentiated", "assumed.yaml")


@ask("(a) What path does the mass centre take?")
def path(case):
    run = case.run()
    times = [0.5, 0.8, 1.0, run.events[-1].t]
    x = run.evaluate("x(rod.G)", times)
    says = "It falls straight down: at 0.5, 0.8, 1 s and flat it is {} beside its start."
    yield Answer("x at 0.5, 0.8, 1 s and flat", x, "m", [0.0] * 4, "conservation: no horizontal force", 1e-13, L, says=says)
    y = run.evaluate("y(rod.G) - l/2*sin(angle(rod))", times)
    says = "Its height is (ℓ/2) cos θ, to {}: the foot stays on the ice."
    yield Answer("y − (ℓ/2) cos θ then", y, "m", [0.0] * 4, "geometry", 1e-11, L, says=says)


@ask("(b) How fast does the rod turn just before it lies flat, the contact assumed, then checked?")
def flat(case):
    check = sqrt(3 * G * cos(TILT) / L)
    for of, file in MODELS.items():
        event = case.run(file).events[-1]
        spin = -case.run(file).evaluate("omega(rod)", event.t)
        says = "The rod falls flat at {}."
        yield Answer("θ̇ when flat", spin, "rad/s", check, "conservation of energy", 1e-10, says=says, variant=of)
        says = "It has fallen for {}."
        yield Answer("time of the fall", event.t, "s", fall_time(TILT), "quadrature", 1e-10, says=says, variant=of)
    found = case.mechanism().limit("-omega(rod) @ end", vary="tilt", towards=0.0, begin=0.05)
    yield Answer("θ̇ when flat", found.value, "rad/s", sqrt(3 * G / L), "closed form: √(3g/ℓ)", 1e-9, variant="as θ₀ → 0")


@ask("(b) Is the contact kept, how hard does the ice push, and where least?")
def kept(case):
    run = case.run()
    least = run.report["least force of the ice"]
    c0 = cos(TILT)
    c = brentq(lambda c: 3 * c**3 - 9 * c0 * c**2 + 12 * c - 4 * c0, 0, 1, xtol=1e-15)
    against = "closed form: dN/dθ = 0"
    says = "The contact is kept: the ice pushes with {} at least."
    yield Answer("least force of the ice", least.value, "N", force(c, c0), against, 1e-10, says=says)
    tilt = pi / 2 - run.evaluate("angle(rod)", least.t)
    yield Answer("tilt then", tilt, "rad", acos(c), against, 1e-6, says="The tilt then is {}.")
    times = [0.0, 0.5, 0.8, 1.0, run.events[-1].t]
    yield Answer(
        "gap over the ice at 0, 0.5, 0.8, 1 s and flat", run.evaluate("foot.gap", times), "m", [0.0] * 5, "N > 0", 1e-13, L
    )
    tilts = pi / 2 - run.evaluate("angle(rod)", times)
    check = [force(cos(tilt), c0) for tilt in tilts]
    yield Answer("force at 0, 0.5, 0.8, 1 s and flat", run.evaluate("foot.N", times), "N", check, "closed form: N(θ)", 1e-9)


@ask("(c) What does that equation give at four states?")
def one_equation(case):
    for tilt, rate in ((0.02, 0.0), (0.5, 1.0), (1.0, 2.0), (1.5, 4.0)):
        now = case.instant("assumed.yaml", theta=tilt, x=0.0, rates={"theta": rate})
        yield Answer(
            f"θ̈ at θ = {tilt:g}, θ̇ = {rate:g}", -now["alpha(rod)"], "rad/s²", bend(tilt, rate), "closed form: (c)", 1e-12
        )


@ask("How does the rod lie and move after 1 s?")
def one_second(case):
    ((theta, rate),) = reference.motion(lambda t, y: [y[1], bend(*y)], [TILT, 0], [1.0])
    against = "other route: (c) integrated by SciPy"
    for of, file in MODELS.items():
        run = case.run(file)
        tilt, spin = pi / 2 - run.evaluate("angle(rod)", 1.0), -run.evaluate("omega(rod)", 1.0)
        height = run.evaluate("y(rod.G)", 1.0)
        yield Answer("θ", tilt, "rad", theta, against, 1e-10, variant=of)
        yield Answer("θ̇", spin, "rad/s", rate, against, 1e-10, variant=of)
        yield Answer("height of the mass centre", height, "m", L / 2 * cos(theta), against, 1e-10, variant=of)
