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
    "": {},
    "μ = 0": {"mu": 0.0},
    "m1 = 1, m2 = 1e9, α = 40°, μ = 0.3": {"m1": 1.0, "m2": 1e9, "alpha": radians(40), "mu": 0.3},
    "μ = 0.7": {"mu": 0.7},
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


@ask("What are the accelerations and forces symbolically, and for μ → 0 and m2 → ∞?")
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


@ask("Does the top wedge slip, how do both move, and what do they push with?")
def instants(case):
    for name, change in SETS.items():
        now, numbers = case.instant(parameters=change), FIRST | change
        a, a2, N, R = balances(**numbers)
        friction = numbers["mu"] * N if a else numbers["m1"] * G * sin(numbers["alpha"])
        found = now[f"accel({SLIDE})"]
        says = "It slips: a_rel is {}." if abs(found) > 1e-9 else "It stays: a_rel is {}."
        yield Answer("a_rel", found, "m/s²", a, LINEAR, 1e-12, G, says=says, variant=name)
        yield Answer("a2", now["accel(x)"], "m/s²", a2, LINEAR, 1e-12, 1e-8, variant=name)
        yield Answer("N", now["face.N"], "N", N, LINEAR, 1e-12, variant=name)
        yield Answer("friction up the face", -now["face.T"], "N", friction, LINEAR, 1e-12, 1.0, variant=name)
        yield Answer("R", now["wheels.Fy"], "N", R, LINEAR, 1e-12, variant=name)
        if a:
            value, check = [found, now["accel(x)"], now["face.N"]], formula(**numbers)
            says = "The solution by hand in letters gives the same a_rel, a2 and N."
            yield Answer(
                "a_rel, a2 and N", value, "SI", check, "closed form: elimination by hand", 1e-12, says=says, variant=name
            )


@ask("From which friction on does it stay?")
def limit(case):
    held = case.instant(parameters={"mu": 0.7})
    ratio = -held["face.T"] / held["face.N"]
    says = "It stays from μ = {} on, the friction over N where it rests."
    yield Answer("limiting μ", ratio, "", LIMIT, "closed form: tan α", 1e-12, says=says)
    for off in (-1e-3, -1e-6, -1e-9, 1e-9, 1e-6):
        mu = LIMIT * (1 + off)
        a = case.instant(parameters={"mu": mu})[f"accel({SLIDE})"]
        check, of = balances(**FIRST | {"mu": mu})[0], f"μ = (1 {'−+'[off > 0]} {abs(off):g}) tan α"
        yield Answer("a_rel", a, "m/s²", check, LINEAR, 1e-14, G, variant=of)
    for m2 in (0.5, 1e9):
        a = case.instant(parameters={"mu": LIMIT * (1 - 1e-6), "m2": m2})[f"accel({SLIDE})"]
        check = balances(**FIRST | {"mu": LIMIT * (1 - 1e-6), "m2": m2})[0]
        yield Answer("a_rel", a, "m/s²", check, LINEAR, 1e-14, G, variant=f"μ = (1 − 1e-06) tan α, m2 = {m2:g} kg")


@ask("What does a_rel come near to as μ → 0, as m2 → ∞, and as both do?")
def limits(case):
    alpha, M = FIRST["alpha"], FIRST["m1"] / FIRST["m2"]
    c, s = cos(alpha), sin(alpha)
    smooth = G * s + G * M * c**2 * s / (1 + M * s**2)
    for mu in (1e-3, 1e-6, 0.0):
        a = case.instant(parameters={"mu": mu})[f"accel({SLIDE})"]
        against = "closed form of μ = 0, to first order in μ"
        yield Answer("a_rel", a, "m/s²", smooth, against, 2 * mu + 1e-12, variant=f"μ = {mu:g}")
    for m2 in (1e3, 1e6, 1e9):
        a = case.instant(parameters={"m2": m2})[f"accel({SLIDE})"]
        closed = G * (s - FIRST["mu"] * c)
        against = "closed form of m2 = ∞, to first order in m1/m2"
        yield Answer("a_rel", a, "m/s²", closed, against, 2 / m2, variant=f"m2 = {m2:g}")
    a = case.instant(parameters={"mu": 0.0, "m2": 1e9})[f"accel({SLIDE})"]
    says = "Without friction on a base of 1e9 kg it is {}: g sin α."
    yield Answer("a_rel", a, "m/s²", G * s, "closed form: g sin α, to first order in m1/m2", 4e-9, says=says)


@ask("How do both move for 0.5 s from rest, and what heat does friction make?")
def motion(case):
    t = 0.5
    for name, change in SETS.items():
        run, numbers = case.run(parameters=change), FIRST | change
        a, a2, N, _ = balances(**numbers)
        heat = numbers["mu"] * N * a * t**2 / 2
        closed = "closed form: constant accelerations"
        yield Answer("way along the face", run.evaluate(SLIDE, t) - 0.3, "m", a * t**2 / 2, closed, 1e-12, 1.0, variant=name)
        yield Answer("way of the lower wedge", run.evaluate("x", t), "m", a2 * t**2 / 2, closed, 1e-12, 1e-3, variant=name)
        yield Answer("speed of sliding", run.evaluate("face.slip", t), "m/s", a * t, closed, 1e-12, 1.0, variant=name)
        against = "closed form: μN times the way"
        yield Answer("heat", -run.evaluate("friction_work()", t), "J", heat, against, 1e-12, 1.0, variant=name)
        energy = run.energy
        lost = energy.potential[0] - energy.potential[-1] - energy.kinetic[-1] + energy.kinetic[0]
        yield Answer("energy lost", lost, "J", heat, against, 1e-11, 1.0, variant=name)
        speeds = [run.evaluate("momentum_x()", at) for at in (0.25, t)]
        scale, against = numbers["m2"] * 1e-3, "conservation: nothing pushes along the ground"
        yield Answer("momentum along the ground", speeds, "N·s", [0.0, 0.0], against, 1e-12, scale, variant=name)


@ask("Need anything keep the top wedge from turning, and where does the face carry it?")
def upright(case):
    """The force of the face passes through its mass centre, and meets the sole between its ends."""
    now = case.instant("free.yaml")
    a, _, N, _ = balances(**FIRST)
    says, through = (
        "Nothing: free to turn, it has an angular acceleration of {}.",
        "closed form: the force passes through its mass centre",
    )
    yield Answer("turning", now["alpha(top)"], "rad/s²", 0.0, through, 1e-12, G, says=says)
    yield Answer("a_rel", now[f"accel({SLIDE})"], "m/s²", a, LINEAR, 1e-12)
    yield Answer("N of both ends of the sole", now["face.N"], "N", N, LINEAR, 1e-12)
    alpha, c = FIRST["alpha"], 0.4
    centre = np.array([2 * c * cos(alpha), -c * sin(alpha)]) / 3  # of the triangle, from P
    down, off = np.array([cos(alpha), -sin(alpha)]), np.array([sin(alpha), cos(alpha)])
    from_P = centre @ down + FIRST["mu"] * (centre @ off)
    corner = np.array([0.3 * cos(alpha), 2 * tan(alpha) - 0.3 * sin(alpha)])
    place = [now["face.x"], now["face.y"]]
    says = "The face carries it at ({}, {})."
    yield Answer("place", place, "m", corner + from_P * down, through, 1e-12, says=says)
    says = "That is {} from the upper end of its sole of 0.4 m."
    yield Answer("from the end", (place - corner) @ down, "m", from_P, through, 1e-12, says=says)
    run = case.run("free.yaml")
    says = "After 0.5 s it has turned by {}."
    yield Answer("angle", run.evaluate("angle(top)", 0.5), "rad", 0.0, through, 1e-12, 1.0, says=says)
    closed = "closed form: constant acceleration"
    yield Answer("way along the face", run.evaluate(SLIDE, 0.5) - 0.3, "m", a * 0.5**2 / 2, closed, 1e-12)
