"""Unwanted vibration of a nominally rigid slider-crank.

About the crank at θ and the straight rod at β the loop leaves δθ and the bend δ free: with y of the slider at 0 the halves of the rod turn by
g δθ ∓ δ/2, g = −r cos θ/(l cos β). From the velocities of the mass centres come M = Re Σ m v̄ vᵀ + Σ I ω ωᵀ, and K = diag(k_shaft, k_rod).
"""

from cmath import exp
from math import asin, cos, pi, radians, sin

import numpy as np
from scipy.linalg import eigh

from freebody.catalogue import Answer, ask

R, L, M1, M2, M3, THETA = 0.1, 0.3, 1.0, 2.0, 1.5, radians(60)
HAND = "closed form: masses and stiffnesses by hand"


def mass():
    """By (δθ, δ), kg m²."""
    beta = -asin(R * sin(THETA) / L)
    g = -R * cos(THETA) / (L * cos(beta))
    turns = np.array([[1, 0], [g, -0.5], [g, 0.5]])
    arm, half = 1j * R * exp(1j * THETA), 1j * L / 2 * exp(1j * beta)
    pin = arm * turns[0]
    middle = pin + half * turns[1]
    end = middle + half * turns[2]
    places = [(M1, pin / 2), (M2 / 2, (pin + middle) / 2), (M2 / 2, (middle + end) / 2), (M3, end)]
    inertias = [M1 * R**2 / 12, *[M2 / 2 * (L / 2) ** 2 / 12] * 2]
    moved = sum(m * (np.outer(v.real, v.real) + np.outer(v.imag, v.imag)) for m, v in places)
    return moved + sum(i * np.outer(w, w) for i, w in zip(inertias, turns, strict=True))


@ask("Frequencies and shapes")
def frequencies(case):
    (rest,) = case.mechanism().stability()
    squares, shapes = eigh(np.diag([500.0, 20e3]), mass())
    check = np.sqrt(squares) / (2 * pi)
    yield Answer("frequencies", [mode.frequency for mode in rest.modes], "Hz", check, HAND, 1e-10)
    values = [(mode.shape["bend"] / mode.shape["theta"]).real for mode in rest.modes]
    yield Answer("bend of the rod for each radian of the crank", values, "", shapes[1] / shapes[0], HAND, 1e-9)


@ask("Damping ratios with 1 N·m·s/rad across each spring")
def damping(case):
    (rest,) = case.mechanism(c=1.0).stability()
    inverse = np.linalg.inv(mass())
    a = np.block([[np.zeros((2, 2)), np.eye(2)], [-inverse @ np.diag([500.0, 20e3]), -inverse]])
    values = sorted((x for x in np.linalg.eigvals(a) if x.imag >= 0), key=abs)
    check = [-x.real / abs(x) for x in values]
    yield Answer("damping ratios", [mode.damping for mode in rest.modes], "", check, HAND, 1e-9)


@ask("Approach to a rigid rod as its stiffness grows")
def stiffening(case):
    """The frequency of the shaft falls short of that of the rigid machine, √(k/M₁₁)/2π, by a part M₁₂² k/(2 M₁₁² k_rod) to first order."""
    m = mass()
    rigid = np.sqrt(500.0 / m[0, 0]) / (2 * pi)
    short = [case.mechanism(k_rod=k).stability()[0].modes[0].frequency / rigid - 1 for k in (1e5, 1e6, 1e7)]
    check = [np.sqrt(eigh(np.diag([500.0, k]), m)[0][0]) / (2 * pi) / rigid - 1 for k in (1e5, 1e6, 1e7)]
    yield Answer("lowest frequency over that of a rigid rod, less 1", short, "", check, HAND, 1e-5)
