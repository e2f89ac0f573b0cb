"""Dumbbell on a floor.

φ is the angle of the rod at B (above 90° with A to the left), c = cos φ, s = sin φ, s0 = sin φ0. No force acts along the floor, so that the
mass centre falls straight down. While B touches:
    φ̇² = 4 g (s0 − s)/(ℓ(1 + c²))                              energy,
    φ̈ = (2g/ℓ) (−c(1 + c²) + 2cs(s0 − s))/(1 + c²)²,
    N = −m ℓ φ̈/c = 2 m g (1 + c² − 2s(s0 − s))/(1 + c²)²        moments about the mass centre.
1 + c² − 2s(s0 − s) = 2 − s0² + (s − s0)² > 0: the floor pushes all the time, from whatever angle it starts, and B stays down.
N begins with 2mg/(2 − s0²), ends with mg, and is least between. A hits with φ̇² = 2 g s0/ℓ, at ℓ φ̇ = √(2gℓ s0), straight down.
Along the floor A and B are ℓ/2 cos φ to both sides of the mass centre. The time is a quadrature, with φ = φ0 − u² from the start.
"""

from math import cos, radians, sin, sqrt

import numpy as np
from scipy.integrate import quad
from scipy.optimize import minimize_scalar

from freebody.catalogue import Answer, ask

MASS, L, G = 1.0, 1.0, 9.81
MAIN = (45, 30, 60, 135)
ENERGY, QUADRATURE = "closed form: energy", "quadrature"


def run(case, degrees):
    return case.run(parameters={"phi0": radians(degrees)})


def push(s, s0):
    """N where sin φ = s."""
    return 2 * MASS * G * (2 - s0**2 + (s - s0) ** 2) / (2 - s**2) ** 2


def time(degrees, until=0.0):
    """From the start, at φ0 ≤ 90°, to the angle ``until``."""
    first = radians(min(degrees, 180 - degrees))

    def share(u):
        phi = first - u**2
        drop = 2 * cos(first - u**2 / 2) * sin(u**2 / 2)  # sin φ0 − sin φ
        return 2 * u * sqrt(L * (1 + cos(phi) ** 2) / (4 * G * drop)) if u else sqrt(L * (1 + cos(phi) ** 2) / (G * cos(first)))

    return quad(share, 0, sqrt(first - until), epsabs=0, epsrel=1e-13)[0]


@ask("(a) In symbols, just after release")
def symbolically(case):
    closed = {"x": "-g*sin(phi)*cos(phi)/(1 + cos(phi)^2)", "phi": "-2*g*cos(phi)/(l*(1 + cos(phi)^2))"}
    yield from case.symbolically(closed, "closed form: three balances", at_rest=True)


@ask("(a) Accelerations just after release")
def release(case):
    for degrees in MAIN:
        motion, phi = run(case, degrees), radians(degrees)
        c, s = cos(phi), sin(phi)
        along, down = G * c * s / (1 + c**2), 2 * G * c**2 / (1 + c**2)
        for point, check in (("B", [-along, 0.0]), ("A", [along, -down])):
            value = [motion.evaluate(f"a{axis}({point}.centre)", 0.0) for axis in "xy"]
            yield Answer(f"of {point}, φ0 = {degrees}°", value, "m/s²", check, "closed form: φ̈ from rest", 1e-13)
        yield Answer(f"floor force, φ0 = {degrees}°", motion.evaluate("floor.N", 0.0), "N", push(s, s), "closed form", 1e-13)


@ask("(b) A just before it hits the floor: velocity, time and place")
def hit(case):
    for degrees in MAIN:
        motion, phi = run(case, degrees), radians(degrees)
        event = motion.events[-1]
        value = [motion.evaluate(f"v{axis}(A.centre)", event.t) for axis in "xy"]
        yield Answer(f"velocity, φ0 = {degrees}°", value, "m/s", [0.0, -sqrt(2 * G * L * sin(phi))], ENERGY, 1e-11)
        yield Answer(f"time, φ0 = {degrees}°", event.t, "s", time(degrees), QUADRATURE, 1e-11)
        side = 1 if degrees < 90 else -1
        place = motion.evaluate("x(A.centre)", event.t)
        yield Answer(f"place, φ0 = {degrees}°", place, "m", L / 2 * (cos(phi) + side), "closed form: mass centre", 1e-11)
        energy = motion.evaluate("kinetic()", motion.end.t)
        yield Answer(f"kinetic energy where the run ends, φ0 = {degrees}°", energy, "J", MASS * G * L * sin(phi), ENERGY, 1e-11)


@ask("Floor force over time, and its least")
def floor(case):
    for degrees in MAIN:
        motion, s0 = run(case, degrees), sin(radians(degrees))
        first = radians(min(degrees, 180 - degrees))
        angles = np.array([0.9, 0.7, 0.5, 0.3, 0.1]) * first
        value = motion.evaluate("floor.N", [time(degrees, angle) for angle in angles])
        yield Answer(f"at 0.9, 0.7 … of the angle, φ0 = {degrees}°", value, "N", push(np.sin(angles), s0), QUADRATURE, 1e-10)
        last = motion.evaluate("floor.N", motion.end.t)
        yield Answer(f"just before the hit, φ0 = {degrees}°", last, "N", MASS * G, "closed form: mg", 1e-11)
        least = minimize_scalar(push, bounds=(0, s0), args=(s0,), method="bounded").fun
        value = motion.report["least floor force"].value
        yield Answer(f"least, φ0 = {degrees}°", value, "N", least, "closed form, minimised by SciPy", 1e-10)


@ask("B stays on the floor, from any angle")
def stays(case):
    found = case.mechanism().extremes("least floor force", vary="phi0", within=("1 deg", "89 deg"), points=9)
    s0 = sin(radians(89))
    check = minimize_scalar(push, bounds=(0, s0), args=(s0,), method="bounded").fun
    yield Answer(
        "least floor force, of all φ0 from 1° to 89°", found.least.value, "N", check, "closed form, minimised by SciPy", 1e-9
    )
    for degrees in (1, 10, 20, 45, 70, 80, 89, 89.9, 135):
        motion = run(case, degrees)
        kinds = [change.kind for change in motion.changes]
        yield Answer(f"times that B lifts off, φ0 = {degrees}°", kinds.count("lift-off"), "", 0, "closed form: N > 0", 0.0)
        height = motion.evaluate("y(B.centre)", motion.end.t)
        yield Answer(f"height of B at the end, φ0 = {degrees}°", height, "m", 0.0, "closed form: N > 0", 1e-12, L)
        yield Answer(f"time of the hit, φ0 = {degrees}°", motion.end.t, "s", time(degrees), QUADRATURE, 1e-10)
