"""Mass on a wheel on a turning rod.

P = l (cos θ, sin θ) + r (cos ψ, sin ψ) with θ = θ0 + ω1 t and ψ = −θ0 + (ω1 − ω2) t; both rates are constant, so
each term's second derivative is −(its rate)² times itself. Seen from the rod, P circles A clockwise at ω2. The
rod's point Q under P, the motion relative to the rod and Coriolis' term must add up to the same.
"""

import numpy as np

from freebody.catalogue import Answer, ask
from freebody.catalogue.answers import formula
from freebody.document.blocks import Equation
from freebody.equations.topics import topic

L, R, MASS, W1, W2, START = 2.0, 0.5, 0.5, 3.0, 5.0, np.radians(30)
OA, AP = L * np.array([np.cos(START), np.sin(START)]), R * np.array([np.cos(START), -np.sin(START)])
P = OA + AP


def is_whole(block):
    """Whether it is the acceleration of P along directions that turn."""
    is_acceleration = isinstance(block, Equation) and getattr(block.left, "text", "") == "a_P"
    return is_acceleration and "i" not in dict(map(reversed, block.right.components))


def left(v):
    """A quarter turn counter-clockwise: k × v."""
    return np.array([-v[1], v[0]])


VELOCITY = W1 * left(OA) + (W1 - W2) * left(AP)
ACCELERATION = -(W1**2) * OA - (W1 - W2) ** 2 * AP


def pair(now, text):
    return np.array([now[text.format("x")], now[text.format("y")]])


@ask("1. What is the linear momentum of P, through the frame of the rod?")
def momentum(case):
    now = case.instant()
    carried, whole = pair(now, "v{}(rod.Q)"), pair(now, "v{}(wheel.P)")
    yield Answer("velocity of the rod's point under P", carried, "m/s", W1 * left(P), "closed form: ω1 k × r_P", 1e-13)
    yield Answer("velocity relative to the rod", whole - carried, "m/s", -W2 * left(AP), "closed form: −ω2 k × r_P/A", 1e-13)
    yield Answer("velocity of P", whole, "m/s", VELOCITY, "closed form: place differentiated", 1e-13)
    says = "The momentum of P is ({}, {})."
    yield Answer(
        "momentum of P", pair(now, "momentum_{}()"), "N·s", MASS * VELOCITY, "closed form: place differentiated", 1e-13, says=says
    )


@ask("2. What is the net force on P, through the frame of the rod?")
def force(case):
    now = case.instant()
    carried, whole = pair(now, "a{}(rod.Q)"), pair(now, "a{}(particle.centre)")
    relative_velocity = pair(now, "v{}(wheel.P)") - pair(now, "v{}(rod.Q)")
    coriolis = 2 * now["omega(rod)"] * left(relative_velocity)
    yield Answer("acceleration of the rod's point under P", carried, "m/s²", -(W1**2) * P, "closed form: −ω1² r_P", 1e-13)
    yield Answer("Coriolis acceleration", coriolis, "m/s²", 2 * W1 * W2 * AP, "closed form: 2 ω1 k × v_rel", 1e-13)
    yield Answer(
        "acceleration relative to the rod", whole - carried - coriolis, "m/s²", -(W2**2) * AP, "closed form: −ω2² r_P/A", 1e-12
    )
    yield Answer("acceleration of P", whole, "m/s²", ACCELERATION, "closed form: place differentiated twice", 1e-13)
    says, against = "The net force on P is ({}, {}).", "closed form: place differentiated twice"
    yield Answer("net force on P", pair(now, "rim.F{}"), "N", MASS * ACCELERATION, against, 1e-13, says=says)


@ask("Are the named terms those of the place differentiated twice, and by what does the printed acceleration differ?")
def account(case):
    """Along OA only −ω1²; along AP the three parts −ω1² − ω2² + 2 ω1 ω2 are −(ω1 − ω2)²."""
    document = topic(case.mechanism(), "frame", point="wheel.P", body="rod")
    terms = {term.written.text: term.arrow for term in document.terms}
    for word, check in {"a_rel": "-r*rate(phi)^2", "2 ω × v_rel": "2*r*rate(theta)*rate(phi)"}.items():
        [along] = (part.along for part in terms[word].parts)
        yield formula(f"{word} along AP", along, check, "closed form: circle, and 2 ω1 k × v_rel", document.letters)
    [_, prescribed] = (dict(map(reversed, each.right.components)) for each in document.blocks if is_whole(each))
    both = {"λ_rod": "-l*w1^2", "λ_wheel": "-r*(w1 - w2)^2"}
    for unit, check in both.items():
        yield formula(f"a along {unit}", prescribed[unit], check, "closed form: place differentiated twice", document.letters)
    printed = np.array([-17.83, -3.63])
    less = printed - pair(case.instant(), "a{}(wheel.P)")
    says, against = "The printed acceleration of P differs from this by ({}, {}).", "closed form: place differentiated twice"
    yield Answer("printed less this", less, "m/s²", printed - ACCELERATION, against, 1e-12, says=says)


@ask("Which torques do the two drives give?")
def drives(case):
    """Moments of the net force on P about O and, against the wheel's clockwise angle, about A."""
    now, f = case.instant(), MASS * ACCELERATION
    check = [P[0] * f[1] - P[1] * f[0], -(AP[0] * f[1] - AP[1] * f[0])]
    value, says = [now["'rod drive'.force"], now["'wheel drive'.force"]], "The drive of the rod gives {}, that of the wheel {}."
    yield Answer("torques", value, "N·m", check, "closed form: moments of m a", 1e-12, scale=1, says=says)


@ask("Which path does P take for 2 s?")
def path(case):
    run, times = case.run(), np.array([0.5, 1.0, 1.5, 2.0])
    theta, psi = START + W1 * times, -START + (W1 - W2) * times
    for axis, wave in (("x", np.cos), ("y", np.sin)):
        value, check = run.evaluate(f"{axis}(wheel.P)", times), L * wave(theta) + R * wave(psi)
        yield Answer(f"{axis} of P at 0.5, 1, 1.5, 2 s", value, "m", check, "closed form: two circles", 1e-13, scale=L)
