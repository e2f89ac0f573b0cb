"""Positions of a four-bar.

A usable formula exists, two circles that meet: with P the vector from B to D,
φ = arg P ± arccos((l2² − l3² − |P|²)/(2 l3 |P|)) and β = arg(P + l3 e^{iφ}). freebody iterates on the closed loop;
the formula is evaluated in 30 digits, and so are its derivatives, by differences in 30 digits.
"""

import cmath
import math
from functools import partial

import mpmath as mp
import numpy as np

from freebody.catalogue import Answer, ask
from freebody.systems._linkages import nearest_turn

ANGLES = [math.radians(15 * k) for k in range(24)]
BARS = (0.4, 0.4 * math.sqrt(2), 0.8 * math.sqrt(2), 1.2)


def phi(theta, side, bars=BARS):
    l1, l2, l3, d = bars
    p = d - l1 * mp.expj(theta)
    return mp.arg(p) + side * mp.acos((l2**2 - l3**2 - abs(p) ** 2) / (2 * l3 * abs(p)))


def beta(theta, side, bars=BARS):
    l1, _, l3, d = bars
    return mp.arg(d - l1 * mp.expj(theta) + l3 * mp.expj(phi(theta, side, bars)))


def over_a_turn(case, side, variant=""):
    states = [case.instant(parameters={"side": side, "theta0": theta}) for theta in ANGLES]
    with mp.workdps(30):
        for name, letter, formula in (("beta", "β", beta), ("phi", "φ", phi)):
            exact = [[float(mp.diff(partial(formula, side=side), theta, n)) for theta in ANGLES] for n in range(3)]
            angle = [nearest_turn(now[name], check) for now, check in zip(states, exact[0], strict=True)]
            yield Answer(f"{letter} every 15°", angle, "rad", exact[0], "closed form: two circles meet", 1e-13, variant=variant)
            slopes, bends = ([now[f"{word}({name})"] for now in states] for word in ("rate", "accel"))
            against = "closed form, differentiated in 30 digits"
            yield Answer(f"d{letter}/dθ", slopes, "", exact[1], against, 1e-12, variant=variant)
            yield Answer(f"d²{letter}/dθ²", bends, "", exact[2], against, 1e-12, variant=variant)


@ask("What are β and φ with their first two derivatives by θ over a turn, C to the left of B→D?")
def turns(case):
    yield from over_a_turn(case, 1)
    yield from over_a_turn(case, -1, "the other assembly")


@ask("Does the closed chain have fewer degrees of freedom than joints?")
def freedom(case):
    """S19.22's bars, which nothing drives."""
    now = case.instant("S19.22/model")
    says, against = (
        "It has {} degree of freedom and {} joints.",
        "count: three bodies, two constraints a hinge; freedom 3·3 − 2·4",
    )
    yield Answer("freedom and joints", [now.freedom, len(now.reactions)], "", [1, 4], against, 0.0, says=says)


@ask("What are the limits of θ with bars 0.4, 0.3, 0.35, AD 0.5?")
def limits(case):
    """θ turns back where BC and DC are in one line, BD = l2 + l3: the law of cosines in ABD."""
    check = math.acos((0.4**2 + 0.5**2 - 0.65**2) / (2 * 0.4 * 0.5))
    for way in (1, -1):
        run = case.run("limits.yaml", {"way": way})
        back = next(event for event in run.events if event.name == "turns back")
        against, says = "closed form: BC and DC in line", "θ turns back at {}."
        yield Answer("θ", back.q["theta"], "rad", way * check, against, 1e-13, says=says)
        says = "That is at {}, the bend being 2 + t."
        yield Answer("when", back.t, "s", math.pi - 2, against, 1e-12, says=says)


@ask("What are the angles of EF and GF of the Watt six-bar over a turn?")
def watt(case):
    """F from two circles about E and G, as C from those about B and D."""
    states = [case.instant("watt.yaml", {"theta0": theta}) for theta in ANGLES]
    exact = []
    for theta in ANGLES:
        e = 1.2 + 0.5 * cmath.exp(1j * (float(phi(theta, 1)) - math.pi / 3))
        reach, heading = cmath.polar(2.1 - e)
        ef = heading + math.acos((0.8**2 + reach**2 - 0.6**2) / (2 * 0.8 * reach))
        exact.append((ef, cmath.phase(e + 0.8 * cmath.exp(1j * ef) - 2.1)))
    for i, (name, bar) in enumerate((("epsilon", "E→F"), ("gamma", "G→F"))):
        check = np.array(exact)[:, i]
        value = [nearest_turn(now[name], c) for now, c in zip(states, check, strict=True)]
        yield Answer(f"angle of {bar} every 15°", value, "rad", check, "closed form: two circles meet", 1e-13)
