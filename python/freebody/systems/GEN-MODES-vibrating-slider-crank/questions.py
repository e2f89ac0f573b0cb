"""Unwanted vibration of a nominally rigid slider-crank.

About the crank at θ and the straight rod at β the loop leaves δθ and the bend δ free. From the velocities of the mass centres, complex, come
M = Re Σ m v̄ vᵀ + Σ I ω ωᵀ, and K = diag(k_shaft, k_rod). A rotor that turns steadily feels the torque of the shaft.
"""

from cmath import exp
from math import asin, cos, pi, radians, sin, tan, tau

import numpy as np
from scipy.linalg import eigh
from scipy.optimize import minimize_scalar

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import motion
from freebody.inverse import steady

R, L, M1, M2, M3, THETA = 0.1, 0.3, 1.0, 2.0, 1.5, radians(60)
HAND = "closed form: masses and stiffnesses by hand"


def mechanics(theta, bend=0.0, rates=(0.0, 0.0)):
    """Masses by (θ, δ), kg m², and what the velocities take along them. The halves of the rod turn to γ ∓ δ/2 with
    r sin θ + l cos(δ/2) sin γ = 0, the slider's height. Bar by bar, each with its velocities by θ̇ and δ̇ and its centripetal
    acceleration; in single numbers, as a reference solution asks for it 200 000 times."""
    (turn, bending), c, s = rates, cos(bend / 2), sin(bend / 2)
    mean = -asin(R * sin(theta) / (L * c))
    by_theta, by_bend = -R * cos(theta) / (L * c * cos(mean)), tan(mean) * s / c / 2
    spin = by_theta * turn + by_bend * bending
    curved = R * sin(theta) * turn**2 + L * (sin(mean) * c * (spin**2 + bending**2 / 4) + cos(mean) * s * spin * bending)
    curved /= L * c * cos(mean)
    bars = (
        (M1, R, R * exp(1j * theta), 1.0, 0.0, 0.0),
        (M2 / 2, L / 2, L / 2 * exp(1j * (mean - bend / 2)), by_theta, by_bend - 0.5, curved),
        (M2 / 2, L / 2, L / 2 * exp(1j * (mean + bend / 2)), by_theta, by_bend + 0.5, curved),
    )
    points, v, w, a = [], 0j, 0j, 0j  # mass, velocities by θ̇ and δ̇, acceleration; then those of the end of the bars so far
    moved, taken = [0.0, 0.0, 0.0], [0.0, 0.0]
    for m, length, bar, p, q, bent in bars:
        to_v, to_w, to_a = 1j * bar * p, 1j * bar * q, bar * (1j * bent - (p * turn + q * bending) ** 2)
        points.append((m, v + to_v / 2, w + to_w / 2, a + to_a / 2))
        v, w, a, inertia = v + to_v, w + to_w, a + to_a, m * length**2 / 12
        moved = [x + inertia * y for x, y in zip(moved, (p * p, p * q, q * q), strict=True)]
        taken = [x + inertia * bent * y for x, y in zip(taken, (p, q), strict=True)]
    for m, x, y, acceleration in (*points, (M3, v, w, a)):
        products = (abs(x) ** 2, (x.conjugate() * y).real, abs(y) ** 2)
        moved = [old + m * new for old, new in zip(moved, products, strict=True)]
        taken = [old + m * (each.conjugate() * acceleration).real for old, each in zip(taken, (x, y), strict=True)]
    return np.array([moved[:2], moved[1:]]), np.array(taken)


def mass():
    """By (δθ, δ), kg m²."""
    return mechanics(THETA)[0]


@ask("What are the frequencies and shapes?")
def frequencies(case):
    (rest,) = case.mechanism().stability()
    squares, shapes = eigh(np.diag([500.0, 20e3]), mass())
    check = np.sqrt(squares) / (2 * pi)
    yield Answer("frequencies", [mode.frequency for mode in rest.modes], "Hz", check, HAND, 1e-10)
    values = [(mode.shape["bend"] / mode.shape["theta"]).real for mode in rest.modes]
    yield Answer("bend of the rod for each radian of the crank", values, "", shapes[1] / shapes[0], HAND, 1e-9)


@ask("What are the damping ratios with 1 N·m·s/rad across each spring?")
def damping(case):
    (rest,) = case.mechanism(c=1.0).stability()
    inverse = np.linalg.inv(mass())
    a = np.block([[np.zeros((2, 2)), np.eye(2)], [-inverse @ np.diag([500.0, 20e3]), -inverse]])
    values = sorted((x for x in np.linalg.eigvals(a) if x.imag >= 0), key=abs)
    check = [-x.real / abs(x) for x in values]
    yield Answer("damping ratios", [mode.damping for mode in rest.modes], "", check, HAND, 1e-9)


@ask("How does it come near to the rigid machine as the rod grows stiffer?")
def stiffening(case):
    """The frequency of the shaft falls short of that of the rigid machine, √(k/M₁₁)/2π, by a part M₁₂² k/(2 M₁₁² k_rod) to first order."""
    m = mass()
    rigid = np.sqrt(500.0 / m[0, 0]) / (2 * pi)
    short = [case.mechanism(k_rod=k).stability()[0].modes[0].frequency / rigid - 1 for k in (1e5, 1e6, 1e7)]
    check = [np.sqrt(eigh(np.diag([500.0, k]), m)[0][0]) / (2 * pi) / rigid - 1 for k in (1e5, 1e6, 1e7)]
    says = "With 1e5, 1e6, 1e7 N·m/rad the lowest frequency differs from that of a rigid rod by {} of it."
    yield Answer("lowest frequency", short, "", check, HAND, 1e-5, says=says)


@ask("How does its motion come near to that of a rigid rod, and does the solver stay efficient?")
def stiff(case):
    """From 60° at 20 rad/s with 1e-4 s of damping in the rod's spring: what its bending does to θ is inverse to the stiffness."""

    def elastic(t, y):
        moved, taken = mechanics(y[0], y[1], y[2:])
        force = np.array([500 * (THETA + 20 * t - y[0]), -1e5 * y[1] - 10 * y[3]])
        return [*y[2:], *np.linalg.solve(moved, force - taken)]

    rigid = motion(lambda t, y: [y[1], rigid_turn(t, *y)], [THETA, 20.0], [0.1])[0, 0]
    runs = [case.run(parameters={"w": 20, "k_rod": k, "c": 0, "c_rod": k * 1e-4}, rtol=1e-11) for k in (1e5, 1e7, 1e9)]
    apart = [float(run.evaluate("theta", 0.1)) - rigid for run in runs]
    check, against = (
        motion(elastic, [THETA, 0, 20, 0], [0.1])[0, 0] - rigid,
        "other route: Lagrange's equations, integrated by SciPy",
    )
    says = "With 1e5 N·m/rad θ differs by {} after 0.1 s."
    yield Answer("apart", apart[0], "rad", check, against, 1e-5, says=says)
    less, says = (
        [apart[0] / apart[1], apart[1] / apart[2]],
        "A rod a hundred times as stiff makes that {} times less, and another {} times.",
    )
    yield Answer("less", less, "", 100, "closed form: inverse to the stiffness, to first order", 1e-2, says=says)
    efforts = [run.stats["evaluations"] for run in runs]
    says = f"Radau's method evaluates {', '.join(map(str, efforts))} times: stiffness costs it nothing."
    against = "L-stable: what has died out asks for no steps"
    yield Answer("no more", efforts[2] <= efforts[0], check=True, against=against, tolerance=0.0, says=says)


def rigid_turn(t, theta, rate):
    """θ̈ with a rigid rod."""
    moved, taken = mechanics(theta, 0.0, (rate, 0.0))
    return (500 * (THETA + 20 * t - theta) - taken[0]) / moved[0, 0]


def extremes(torque, around, span):
    """The greatest and the least torque, near times of both."""
    found = (
        minimize_scalar(
            lambda t, sign=sign: -sign * torque(t), bounds=(t - span, t + span), method="bounded", options={"xatol": 1e-9}
        )
        for sign, t in zip((1, -1), around, strict=True)
    )
    return [torque(one.x) for one in found]


@ask("How does the torque ripple with the rotor at 20 rad/s, all rigid?")
def rigid_ripple(case):
    """Shaft and rod hold the crank at the rotor's speed: the torque is what the velocities take."""
    given = case.mechanism(k_shaft=0).inverse({"theta": steady("20 rad/s"), "bend": steady(0)}, until=tau / 20)

    def torque(t):
        return mechanics(THETA + 20 * t, 0.0, (20.0, 0.0))[1][0]

    times = np.arange(1, 9) * tau / 160
    value = given.evaluate("'motion of theta'.force", times)
    yield Answer("torque, eighths of a turn on from 60°", value, "N·m", [torque(t) for t in times], HAND, 1e-10)
    said = given.summary("'motion of theta'.force")
    check = extremes(torque, (said.greatest.t, said.least.t), 0.01)
    yield Answer(
        "greatest and least", [said.greatest.value, said.least.value], "N·m", check, HAND, 1e-10, says="It goes from {1} to {0}."
    )


@ask("How does it ripple elastic, with 1 N·m·s/rad across each spring, once it repeats itself?")
def elastic_ripple(case):
    """A turn leaves 3e-4 of a perturbation, by both multipliers: the fifth turn of the other route is steady."""

    def rates(t, y):
        moved, taken = mechanics(y[0], y[1], y[2:])
        twist = THETA + 20 * t - y[0]
        force = np.array([500 * twist + 20 - y[2], -20e3 * y[1] - y[3]])
        return [*y[2:], *np.linalg.solve(moved, force - taken)]

    found = case.mechanism(w=20, c=1).periodic(period="2*pi/w").find()
    torque = found.returned.run.evaluate("drive.force", np.arange(64) * tau / 1280)
    times = 4 * tau / 20 + np.arange(64) * tau / 1280
    states = motion(rates, [THETA, 0, 20, 0], times)
    check = np.array([500 * (THETA + 20 * t - y[0]) + 20 - y[2] for t, y in zip(times, states, strict=True)])
    against = "other route: Lagrange's equations, integrated by SciPy"
    yield Answer("torque from 60° on every eighth of a turn", torque[::8], "N·m", check[::8], against, 1e-8)
    extreme, says = [torque.min(), torque.max()], "Of 64 places in the turn it is {} at least, {} at most."
    yield Answer("extremes", extreme, "N·m", [check.min(), check.max()], against, 1e-8, says=says)
