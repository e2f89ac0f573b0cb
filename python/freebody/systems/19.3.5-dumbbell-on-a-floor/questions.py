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
MAIN = {45: "", 30: "φ0 = 30°", 60: "φ0 = 60°", 135: "A to the left, φ0 = 135°"}
ENERGY, QUADRATURE = "closed form: energy", "quadrature"


def run(case, degrees):
    return case.run(parameters={"phi0": radians(degrees)})


def push(s, s0):
    """N where sin φ = s."""
    return 2 * MASS * G * (2 - s0**2 + (s - s0) ** 2) / (2 - s**2) ** 2


def least(s0):
    return minimize_scalar(push, bounds=(0, s0), args=(s0,), method="bounded").fun


def time(degrees, until=0.0):
    """From the start, at φ0 ≤ 90°, to the angle ``until``."""
    first = radians(min(degrees, 180 - degrees))

    def share(u):
        phi = first - u**2
        drop = 2 * cos(first - u**2 / 2) * sin(u**2 / 2)  # sin φ0 − sin φ
        return 2 * u * sqrt(L * (1 + cos(phi) ** 2) / (4 * G * drop)) if u else sqrt(L * (1 + cos(phi) ** 2) / (G * cos(first)))

    return quad(share, 0, sqrt(first - until), epsabs=0, epsrel=1e-13)[0]


@ask("(a) What is the acceleration of B just after release, in letters?")
def symbolically(case):
    closed = {"x": "-g*sin(phi)*cos(phi)/(1 + cos(phi)^2)", "phi": "-2*g*cos(phi)/(l*(1 + cos(phi)^2))"}
    yield from case.symbolically(closed, "closed form: three balances", at_rest=True)


@ask("(a) How do B and A accelerate just after release, and how hard does the floor push?")
def release(case):
    against = "closed form: φ̈ from rest"
    for degrees, variant in MAIN.items():
        motion, phi = run(case, degrees), radians(degrees)
        c, s = cos(phi), sin(phi)
        along, down = G * c * s / (1 + c**2), 2 * G * c**2 / (1 + c**2)
        for point, check in (("B", [-along, 0.0]), ("A", [along, -down])):
            value = [motion.evaluate(f"a{axis}({point}.centre)", 0.0) for axis in "xy"]
            says = f"{point} accelerates at {{}} along x and {{}} along y."
            yield Answer(f"a_{point}", value, "m/s²", check, against, 1e-13, says=says * (not variant), variant=variant)
        says = "The floor pushes with {}."
        yield Answer(
            "N", motion.evaluate("floor.N", 0.0), "N", push(s, s), against, 1e-13, says=says * (not variant), variant=variant
        )


@ask("(b) With what velocity does A come to the floor, when and where?")
def hit(case):
    for degrees, variant in MAIN.items():
        motion, phi = run(case, degrees), radians(degrees)
        event, side = motion.events[-1], 1 if degrees < 90 else -1
        value = [motion.evaluate(f"v{axis}(A.centre)", event.t) for axis in "xy"]
        says, check = "A comes down at {} along x and {} along y.", [0.0, -sqrt(2 * G * L * sin(phi))]
        yield Answer("v_A", value, "m/s", check, ENERGY, 1e-11, says=says * (not variant), variant=variant)
        says = "It takes {}."
        yield Answer("t", event.t, "s", time(degrees), QUADRATURE, 1e-11, says=says * (not variant), variant=variant)
        place, check = motion.evaluate("x(A.centre)", event.t), L / 2 * (cos(phi) + side)
        says = "It hits at {} from where B was."
        yield Answer("x", place, "m", check, "closed form: mass centre", 1e-11, says=says * (not variant), variant=variant)
        energy, check = motion.evaluate("kinetic()", motion.end.t), MASS * G * L * sin(phi)
        says = "The run ends before the impact, with the kinetic energy {}."
        yield Answer("E", energy, "J", check, ENERGY, 1e-11, says=says * (not variant), variant=variant)


@ask("How hard does the floor push over time, and how hard at least?")
def floor(case):
    for degrees, variant in MAIN.items():
        motion, s0 = run(case, degrees), sin(radians(degrees))
        first = radians(min(degrees, 180 - degrees))
        angles = np.array([0.9, 0.7, 0.5, 0.3, 0.1]) * first
        value = motion.evaluate("floor.N", [time(degrees, angle) for angle in angles])
        says = "At 0.9, 0.7, 0.5, 0.3, 0.1 of the angle at the start: {}."
        yield Answer("N", value, "N", push(np.sin(angles), s0), QUADRATURE, 1e-10, says=says * (not variant), variant=variant)
        last = motion.evaluate("floor.N", motion.end.t)
        says = "Just before the hit: {}."
        yield Answer("N at the end", last, "N", MASS * G, "closed form: mg", 1e-11, says=says * (not variant), variant=variant)
        value = motion.report["least floor force"].value
        says = "At least: {}."
        yield Answer(
            "least N", value, "N", least(s0), "closed form, minimised by SciPy", 1e-10, says=says * (not variant), variant=variant
        )


@ask("Does B stay on the floor, from any angle?")
def stays(case):
    found = case.mechanism().extremes("least floor force", vary="phi0", within=("1 deg", "89 deg"), points=9)
    says = "It does: of all runs from 1° to 89° the least floor force is {}."
    check = least(sin(radians(89)))
    yield Answer("least N", found.least.value, "N", check, "closed form, minimised by SciPy", 1e-9, says=says)
    for degrees in (1, 10, 20, 45, 70, 80, 89, 89.9, 135):
        motion, variant = run(case, degrees), f"φ0 = {degrees}°"
        stayed = not any(change.kind == "lift-off" for change in motion.changes)
        says = "B stays." if stayed else "B lifts off."
        yield Answer("stays", stayed, check=True, against="closed form: N > 0", says=says * (not variant), variant=variant)
        height = motion.evaluate("y(B.centre)", motion.end.t)
        says = "In the end it is {} above the floor."
        yield Answer("y_B", height, "m", 0.0, "closed form: N > 0", 1e-12, L, says=says * (not variant), variant=variant)
        says = "A hits at {}."
        yield Answer("t", motion.end.t, "s", time(degrees), QUADRATURE, 1e-10, says=says * (not variant), variant=variant)
