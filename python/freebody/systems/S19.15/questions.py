"""Sliding wedges with friction.

λ = (cos α, −sin α) down the face, n = (sin α, cos α) off it. While the upper wedge slides, the friction is μN against λ:
    upper:  N n − m1 g j − μN λ = m1 (a2 i + a λ),      lower:  (R − m2 g) j − N n + μN λ = m2 a2 i,
four linear equations for a (relative to the lower wedge), a2, N and R. With M = m1/m2, C = cos α, S = sin α they give
    N = m1 g C/D,  a2 = g M C (μC − S)/D,  a = g S − g C [M C (μC − S) + μ]/D,      D = 1 − M S (μC − S).
a > 0 for μ < tan α only, whatever the masses. From there on nothing moves: the ground is smooth, so that nothing pushes
the whole sideways, and the face carries the weight m1 g alone, with a friction of tan α times N.
"""

from math import cos, radians, sin, tan

import numpy as np

from freebody.catalogue import Answer, ask

G = 9.81
SETS = {
    "the first set": {},
    "no friction": {"mu": 0.0},
    "a base that hardly moves": {"m1": 1.0, "m2": 1e9, "alpha": radians(40), "mu": 0.3},
    "rough faces": {"mu": 0.7},
}
FIRST = {"m1": 2.0, "m2": 5.0, "alpha": radians(30), "mu": 0.2}
LIMIT = tan(radians(30))
SLIDE = "along(top.P, base.face)"
LINEAR = "other route: four balances, solved by NumPy"


def balances(m1, m2, alpha, mu):
    """(a, a2, N, R): along i and j, of the upper and the lower wedge; at rest where friction holds."""
    if mu >= tan(alpha):
        return np.array([0.0, 0.0, m1 * G * cos(alpha), (m1 + m2) * G])
    c, s = cos(alpha), sin(alpha)
    rows = [[m1 * c, m1, mu * c - s, 0], [-m1 * s, 0, -c - mu * s, 0], [0, m2, s - mu * c, 0], [0, 0, -c - mu * s, 1]]
    return np.linalg.solve(rows, [0, -m1 * G, 0, m2 * G])


def formula(m1, m2, alpha, mu):
    """(a, a2, N) of the sliding wedge, as in the docstring."""
    M, c, s = m1 / m2, cos(alpha), sin(alpha)
    push, D = M * c * (mu * c - s), 1 - M * s * (mu * c - s)
    return G * s - G * c * (push + mu) / D, G * push / D, m1 * G * c / D


@ask("In symbols, the angle and the limits among them")
def symbolically(case):
    S, C = "sin(alpha)", "cos(alpha)"
    below = f"(m2 + m1*{S}*({S} - mu*{C}))"
    closed = {
        "x": f"m1*g*{C}*(mu*{C} - {S})/{below}",
        "face.N": f"m1*m2*g*{C}/{below}",
        "wheels.Fn": f"m2*(m1 + m2)*g/{below}",
        "face.N, mu → 0": f"m1*m2*g*{C}/(m2 + m1*{S}^2)",
        "face.N, m2 → inf": f"m1*g*{C}",
    }
    yield from case.symbolically(closed, "closed form: four balances")


@ask("Does it slip, how do both move, and what do they push with")
def instants(case):
    for name, change in SETS.items():
        now, numbers = case.instant(parameters=change), FIRST | change
        a, a2, N, R = balances(**numbers)
        friction = numbers["mu"] * N if a else numbers["m1"] * G * sin(numbers["alpha"])
        yield Answer(f"a of the upper along the face, {name}", now[f"accel({SLIDE})"], "m/s²", a, LINEAR, 1e-12, G)
        yield Answer(f"a2 of the lower, {name}", now["accel(x)"], "m/s²", a2, LINEAR, 1e-12, 1e-8)
        yield Answer(f"N, {name}", now["face.N"], "N", N, LINEAR, 1e-12)
        yield Answer(f"friction against the slope's fall, {name}", -now["face.T"], "N", friction, LINEAR, 1e-12, 1.0)
        yield Answer(f"R, {name}", now["wheels.Fy"], "N", R, LINEAR, 1e-12)


@ask("The symbolic solution")
def letters(case):
    for name in ("the first set", "no friction", "a base that hardly moves"):
        now = case.instant(parameters=SETS[name])
        value = [now[text] for text in (f"accel({SLIDE})", "accel(x)", "face.N")]
        yield Answer(f"a, a2 and N, {name}", value, "SI", formula(**FIRST | SETS[name]), "closed form", 1e-12)


@ask("The friction from which on it stays")
def limit(case):
    held = case.instant(parameters={"mu": 0.7})
    ratio = -held["face.T"] / held["face.N"]
    yield Answer("friction over N where it stays: the limiting μ", ratio, "", LIMIT, "closed form: tan α", 1e-12)
    for off in (-1e-3, -1e-6, -1e-9, 1e-9, 1e-6):
        mu = LIMIT * (1 + off)
        a = case.instant(parameters={"mu": mu})[f"accel({SLIDE})"]
        yield Answer(f"a at μ = {1 + off:.9f} tan α", a, "m/s²", balances(**FIRST | {"mu": mu})[0], LINEAR, 1e-14, G)
    for m2 in (0.5, 1e9):
        a = case.instant(parameters={"mu": LIMIT * (1 - 1e-6), "m2": m2})[f"accel({SLIDE})"]
        check = balances(**FIRST | {"mu": LIMIT * (1 - 1e-6), "m2": m2})[0]
        yield Answer(f"a just below the limit, m2 = {m2:g}", a, "m/s²", check, LINEAR, 1e-14, G)


@ask("μ → 0 and m2 → ∞")
def limits(case):
    alpha, M = FIRST["alpha"], FIRST["m1"] / FIRST["m2"]
    c, s = cos(alpha), sin(alpha)
    smooth = G * s + G * M * c**2 * s / (1 + M * s**2)
    for mu in (1e-3, 1e-6, 0.0):
        a = case.instant(parameters={"mu": mu})[f"accel({SLIDE})"]
        yield Answer(f"a, μ = {mu:g}", a, "m/s²", smooth, "closed form of μ = 0, to first order in μ", 2 * mu + 1e-12)
    for m2 in (1e3, 1e6, 1e9):
        a = case.instant(parameters={"m2": m2})[f"accel({SLIDE})"]
        closed = G * (s - FIRST["mu"] * c)
        yield Answer(f"a, m2 = {m2:g}", a, "m/s²", closed, "closed form of m2 = ∞, to first order in m1/m2", 2 / m2)
    a = case.instant(parameters={"mu": 0.0, "m2": 1e9})[f"accel({SLIDE})"]
    yield Answer("a, μ = 0 and m2 = 1e9", a, "m/s²", G * s, "closed form: g sin α, to first order in m1/m2", 4e-9)


@ask("0.5 s from rest, with the heat of friction in the ledger")
def motion(case):
    t = 0.5
    for name, change in SETS.items():
        run, numbers = case.run(parameters=change), FIRST | change
        a, a2, N, _ = balances(**numbers)
        heat = numbers["mu"] * N * a * t**2 / 2
        closed = "closed form: constant accelerations"
        yield Answer(f"way along the face, {name}", run.evaluate(SLIDE, t) - 0.3, "m", a * t**2 / 2, closed, 1e-12, 1.0)
        yield Answer(f"way of the lower wedge, {name}", run.evaluate("x", t), "m", a2 * t**2 / 2, closed, 1e-12, 1e-3)
        yield Answer(f"speed of sliding, {name}", run.evaluate("face.slip", t), "m/s", a * t, closed, 1e-12, 1.0)
        yield Answer(f"heat, {name}", -run.evaluate("friction_work()", t), "J", heat, "closed form: μN times the way", 1e-12, 1.0)
        energy = run.energy
        lost = energy.potential[0] - energy.potential[-1] - energy.kinetic[-1] + energy.kinetic[0]
        yield Answer(f"energy lost in the ledger, {name}", lost, "J", heat, "closed form: μN times the way", 1e-11, 1.0)
        speeds = [run.evaluate("momentum_x()", at) for at in (0.25, t)]
        yield Answer(f"momentum along the ground, {name}", speeds, "N·s", [0.0, 0.0], "conservation", 1e-12, numbers["m2"] * 1e-3)


@ask("Nothing need keep the upper wedge from turning")
def upright(case):
    """The force of the face passes through its mass centre, and meets the sole between its ends."""
    now = case.instant("free.yaml")
    a, _, N, _ = balances(**FIRST)
    yield Answer("turning", now["alpha(top)"], "rad/s²", 0.0, "closed form: no moment about its mass centre", 1e-12, G)
    yield Answer("a along the face", now[f"accel({SLIDE})"], "m/s²", a, LINEAR, 1e-12)
    yield Answer("N of both ends of the sole", now["face.N"], "N", N, LINEAR, 1e-12)
    alpha, c = FIRST["alpha"], 0.4
    centre = np.array([2 * c * cos(alpha), -c * sin(alpha)]) / 3  # of the triangle, from P
    down, off = np.array([cos(alpha), -sin(alpha)]), np.array([sin(alpha), cos(alpha)])
    from_P = centre @ down + FIRST["mu"] * (centre @ off)
    corner = np.array([0.3 * cos(alpha), 2 * tan(alpha) - 0.3 * sin(alpha)])
    place = [now["face.x"], now["face.y"]]
    yield Answer("where the face carries it", place, "m", corner + from_P * down, "closed form: along the force through G", 1e-12)
    yield Answer("from the upper end of the sole of 0.4 m", (place - corner) @ down, "m", from_P, "closed form: the same", 1e-12)
    run = case.run("free.yaml")
    yield Answer("angle after 0.5 s", run.evaluate("angle(top)", 0.5), "rad", 0.0, "closed form: no moment", 1e-12, 1.0)
    yield Answer("way along the face", run.evaluate(SLIDE, 0.5) - 0.3, "m", a * 0.5**2 / 2, "closed form", 1e-12)
