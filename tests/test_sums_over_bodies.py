"""Momenta, energies and mass centre of a mechanism, and the rates of the momenta, against sums over its bodies by vectors."""

from __future__ import annotations

import numpy as np
import pytest

import freebody as fb

M, INERTIA, CENTRE = (1.3, 0.7), (0.11, 0.05), np.array([[0.2, 0.1], [-0.15, 0.25]])
PIN, ABOUT, GRAVITY, COUPLE = np.array([0.6, -0.1]), np.array([0.4, -0.9]), np.array([1.5, -9.0]), 0.8
ARMS = f"""
freebody: 1
gravity: [{GRAVITY[0]}, {GRAVITY[1]}]
ground: {{points: {{S: [{ABOUT[0]}, {ABOUT[1]}]}}}}
bodies:
  a: {{mass: {M[0]}, inertia: {INERTIA[0]}, centre: {CENTRE[0].tolist()}, points: {{B: {PIN.tolist()}}}}}
  b: {{mass: {M[1]}, inertia: {INERTIA[1]}, centre: {CENTRE[1].tolist()}}}
joints:
  O: {{type: hinge, of: [ground.O, a.origin], coordinate: p}}
  B: {{type: hinge, of: [a.B, b.origin], coordinate: q}}
forces: {{motor: {{type: torque, on: a, value: {COUPLE}}}}}
"""
"""Two bodies whose mass centres lie off their pins."""


def cross(a: np.ndarray, b: np.ndarray) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


def left(v: np.ndarray) -> np.ndarray:
    """A quarter turn to the left."""
    return np.array([-v[1], v[0]])


def turned(v: np.ndarray, angle: float) -> np.ndarray:
    return np.cos(angle) * v + np.sin(angle) * left(v)


@pytest.mark.parametrize("seed", range(4))
def test_sums_over_bodies(seed: int) -> None:
    """L = Σ m v, H = Σ (r × m v + I ω), E_k = Σ (m v² + I ω²)/2, E_p = −Σ m g · r; Ḣ about O is the moment of weights and motor."""
    p, q, dp, dq = np.random.default_rng(seed).uniform(-2, 2, 4)
    arm, far = turned(PIN, p), turned(CENTRE[1], p + q)
    place = [turned(CENTRE[0], p), arm + far]
    w = [dp, dp + dq]
    velocity = [dp * left(place[0]), dp * left(arm) + (dp + dq) * left(far)]
    each = list(zip(M, INERTIA, place, velocity, w, strict=True))
    momentum = sum(m * v for m, _, _, v, _ in each)
    expected = {
        "momentum_x()": momentum[0],
        "momentum_y()": momentum[1],
        "angular_momentum(ground.S)": sum(m * cross(r - ABOUT, v) + i * w for m, i, r, v, w in each),
        "kinetic()": sum(m * v @ v + i * w**2 for m, i, _, v, w in each) / 2,
        "potential()": -sum(m * GRAVITY @ r for m, _, r, _, _ in each),
        "centre_x()": sum(m * r[0] for m, _, r, _, _ in each) / sum(M),
        "centre_y()": sum(m * r[1] for m, _, r, _, _ in each) / sum(M),
        "rate(angular_momentum(ground.O))": sum(cross(r, m * GRAVITY) for m, _, r, _, _ in each) + COUPLE,
    }
    mechanism = fb.Mechanism.loads(ARMS)
    state, _ = mechanism.start(initial={"p": p, "q": q, "rates": {"p": dp, "q": dq}})
    found = mechanism.source().evaluate([*expected], state)
    assert found == pytest.approx(np.array([*expected.values()]), abs=1e-12)
