"""Values beside the same formulas written with NumPy."""

from __future__ import annotations

import numpy as np
import pytest
from both_sides import sides

from freebody.check.language.parser import parse

K = 5
RNG = np.random.default_rng(7)
V = {
    name: RNG.uniform(0.5, 2, K) for name in ("m", "l", "g", "theta", "thetadot", "thetaddot", "F", "I1", "m2", "R", "Rdot", "T")
}
UNIT = {n: np.tile(np.eye(3)[i], (K, 1)) for i, n in enumerate("ijk")}
R, A = RNG.normal(size=(2, K, 3)) * [1, 1, 0]
VALUES = {**V, **UNIT, "r_G/O": R, "a_G": A}
NAMES = ["m", "l", "g", "theta", "F", "I1", "m2", "R", "T", "i", "j", "k", "r_G/O", "a_G", "t"]

m, l, g, th, w, al, F = (V[n] for n in ("m", "l", "g", "theta", "thetadot", "thetaddot", "F"))
I1, m2, RR, Rd, T = (V[n] for n in ("I1", "m2", "R", "Rdot", "T"))
ZERO = np.zeros(K)

LEFT_SIDES = [
    ("m l² θ̈ + m g l sin θ = 0", m * l**2 * al + m * g * l * np.sin(th)),
    ("−θ̇² sin²θ/2 l = 0", -(w**2) * np.sin(th) ** 2 / 2 * l),
    ("2 m2 R Ṙ θ̇/(I1+m2R²) = 0", 2 * m2 * RR * Rd * w / (I1 + m2 * RR**2)),
    ("√(g/l) = 0", np.sqrt(g / l)),
    ("2^−2 l = 0", l / 4),
    ("atan2(l, m) = 0", np.arctan2(l, m)),
    ("2 × m = 0", 2 * m),
    ("30° l = 0", np.pi / 6 * l),
    ("F i − m g j = 0", np.stack([F, -m * g, ZERO], axis=-1)),
    ("r_G/O × m a_G + θ̈ k = 0", np.stack([ZERO, ZERO, m * (R[:, 0] * A[:, 1] - R[:, 1] * A[:, 0]) + al], axis=-1)),
    ("r_G/O · a_G = 0", (R * A).sum(axis=1)),
    ("k · r_G/O × a_G = 0", R[:, 0] * A[:, 1] - R[:, 1] * A[:, 0]),
    ("(i × r_G/O)/(i × a_G) l = 0", R[:, 1] / A[:, 1] * l),
    ("|r_G/O| = 0", np.hypot(R[:, 0], R[:, 1])),
    ("m·(F·i) = 0", np.stack([m * F, ZERO, ZERO], axis=-1)),
    ("[m, F; 0, l] (g, T) = 0", np.stack([m * g + F * T, l * T], axis=-1)),
    ("T [m, F; 0, l] [g, 0; 0, 1] = 0", np.stack([T * m * g, T * F, ZERO, T * l], axis=-1)),
    ("(r_G/O × a_G, F) = 0", np.stack([R[:, 0] * A[:, 1] - R[:, 1] * A[:, 0], F], axis=-1)),
    ("b/2 + c = 0, b = m l, c = b²", m * l / 2 + (m * l) ** 2),
]


@pytest.mark.parametrize(("text", "value"), LEFT_SIDES)
def test_left_sides(text, value):
    (found,) = sides(parse(text, NAMES), VALUES)
    assert found.residual == pytest.approx(value.reshape(K, -1), rel=1e-13)


def test_a_row_and_a_column_are_compared_entry_by_entry():
    (found,) = sides(parse("[m, l] = (F, g)", NAMES), VALUES)
    assert found.residual == pytest.approx(np.stack([m - F, l - g], axis=-1))


def test_components_of_a_vector_equation():
    (found,) = sides(parse("F i = m a_G", NAMES), VALUES)
    assert found.residual == pytest.approx(np.stack([F - m * A[:, 0], -m * A[:, 1], ZERO], axis=-1))


RATES = [
    "m l² θ̇ + m g l sin θ",
    "(m l²/3 + m2 R²) θ̇",
    "θ̇²/(1 + R²) − cos²θ/R",
    "√(R² + l²) tan(θ/4) + exp(R) ln R",
    "|R| sinh θ + cosh(2 θ) − t R",
    "R cos θ i + R sin θ j",
    "(R cos θ i) × (θ̇ k) + (R·(i·i)) j",
    "[R, θ; 0, l] (θ, R²)",
]


@pytest.mark.parametrize("text", RATES)
def test_rates_are_differences_over_a_moment(text):
    """Of x(t) = x + ẋ t + ẍ t²/2, by central differences, whose error is of second order in the moment."""
    step, moving = 1e-5, ("theta", "R")
    now = VALUES | {f"{n}ddot": RNG.normal(size=K) for n in moving} | {"Rdot": Rd, "thetadot": w, "t": ZERO + 0.3}

    def at(time):
        """The letters a moment later."""
        moved = {n: now[n] + time * now[f"{n}dot"] + time**2 / 2 * now[f"{n}ddot"] for n in moving}
        rates = {f"{n}dot": now[f"{n}dot"] + time * now[f"{n}ddot"] for n in moving}
        return now | moved | rates | {"t": now["t"] + time}

    def value(statement, letters):
        (found,) = sides(parse(statement, NAMES, ["m", "l", "g", "F", "m2", "i", "j", "k"]), letters)
        return found.residual

    change = (value(f"{text} = 0", at(step)) - value(f"{text} = 0", at(-step))) / (2 * step)
    for spelled in (
        f"d/dt({text}) = 0",
        rf"\frac{{d}}{{dt}}\left({text}\right) = 0",
        f"y = {text}; y' = 0",
        f"diff({text}, t) = 0",
    ):
        assert value(spelled, now) == pytest.approx(change, rel=1e-8, abs=1e-8)


PROGRAMS = [
    ("θ' = ω; ω' = −g/l sin θ", "θ̈ = −g/l sin θ"),
    ("ω = θ'\nα = ω'\nl α = −g sin θ", "l θ̈ = −g sin θ"),
    ("theta_dd == -g/l*sin(theta) - 2*theta_d", "θ̈ = −g/l sin θ − 2 θ̇"),
    ("ddtheta := -g/l*sin(theta) - dR*dtheta", "θ̈ = −g/l sin θ − Ṙ θ̇"),
    ("y = [R; θ]; y'' = (0, m)", "(R'', θ'') = (0, m)"),
]


@pytest.mark.parametrize(("text", "same"), PROGRAMS)
def test_programs_say_what_equations_say(text, same):
    letters = VALUES | {"Rddot": F}
    found, wanted = ([s.residual for s in sides(parse(t, NAMES, ["m", "l", "g"]), letters)] for t in (text, same))
    assert np.hstack(found) == pytest.approx(np.hstack(wanted), rel=1e-13)


def test_a_prime_is_a_derivative_beside_names_that_end_with_one():
    names = ["x", "i'", "m"]
    letters = {"xddot": F, "m": m, "i'": A, "i'dot": R}
    (found,) = sides(parse("m x'' + i''·i' = 0", names), letters)
    assert found.residual[:, 0] == pytest.approx(m * F + (R * A).sum(axis=1))
