"""Four-bar, inverse dynamics.

The loop A–B–C–D gives β, φ and, differentiated, their rates and accelerations from those of θ. Three balances of
angular momentum hold only T and the force at D: bars BC and DC about B, DC about C, the whole about A. The other
forces follow from linear momentum. See ``_linkages.py``.
"""

from math import pi

import numpy as np

from freebody.catalogue import Answer, ask
from freebody.catalogue.answers import formula
from freebody.document.blocks import Equation
from freebody.equations import Sym
from freebody.equations.topics import topic
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.linear import linear_in
from freebody.symbolic.tree import minus
from freebody.systems._linkages import FourBar, nearest_turn

CASES = {"": (1, 1.1, 4.0, 0.0), "C to the right, θ = 2.6, θ̇ = −3, θ̈ = 5": (-1, 2.6, -3.0, 5.0)}
BALANCES = "closed form: balances, bar by bar"


def by_hand(side):
    return FourBar(0.3, 0.7, 0.6, 0.8, (0.8, 1.5, 1.1), side)


def given(case, name):
    """The driven instant, and the same by hand."""
    side, theta, rate, turning = CASES[name]
    now = case.instant("driven.yaml", {"side": side, "theta0": theta, "w0": rate, "a0": turning})
    return now, by_hand(side), by_hand(side).motion(theta, rate, turning)


@ask("What are β and φ with their rates and accelerations at θ = 1.1, θ̇ = 4, θ̈ = 0, C to the left?")
def kinematics(case):
    for name in CASES:
        now, _, hand = given(case, name)
        angles = [nearest_turn(now[x], hand.angle[i]) for i, x in ((1, "beta"), (2, "phi"))]
        rates, bends = ([now[f"{word}({x})"] for x in ("beta", "phi")] for word in ("rate", "accel"))
        against = "closed form: two circles meet at C, differentiated"
        yield Answer("β, φ", angles, "rad", hand.angle[1:], against, 1e-13, variant=name)
        yield Answer("β̇, φ̇", rates, "rad/s", hand.rate[1:], against, 1e-12, variant=name)
        yield Answer("β̈, φ̈", bends, "rad/s²", hand.turning[1:], against, 1e-12, variant=name)


@ask("Which torque does that ask for, and which forces at A, B, C, D?")
def forces(case):
    for name in CASES:
        now, bars, hand = given(case, name)
        torque, *pins = bars.forces(hand)
        against, power = "closed form: three balances of angular momentum", now["drive.power"] / hand.rate[0]
        yield Answer("T", now["drive.force"], "N·m", torque, against, 1e-12, variant=name)
        says, check = "By virtual power it is {}.", bars.torque_by_power(hand)
        yield Answer("T", power, "N·m", check, "closed form: virtual power", 1e-12, says=says, variant=name)
        # C is the reaction on BC, its second body.
        for pin, force in zip("ABCD", pins, strict=True):
            on = {"A": "AB", "B": "BC", "C": "BC", "D": "DC"}[pin]
            value, says = [now[f"{pin}.Fx"], now[f"{pin}.Fy"]], f"At {pin} the force on {on} is ({{}}, {{}})."
            yield Answer(pin, value, "N", [force.real, force.imag], BALANCES, 1e-11, says=says, variant=name)


@ask("What do three balances give that hold only T and the force at D: whole about A, BCD about B, CD about C?")
def three_balances(case):
    unknown = [Sym(name) for name in ("drive.force", "D.Fx", "D.Fy")]
    for name, (side, theta, rate, turning) in CASES.items():
        now, bars, hand = given(case, name)
        mechanism = case.mechanism("driven.yaml", side=side, theta0=theta, w0=rate, a0=turning)
        values, rows = SymbolicState(mechanism.source(), now.state).values, []
        for about, bodies in (("ground.A", "ab bc dc"), ("bc.start", "bc dc"), ("dc.end", "dc")):
            document = topic(mechanism, "moment", about=about, bodies=bodies.split())
            balance = next(each for each in document.blocks if isinstance(each, Equation) and str(each.name).startswith("So "))
            linear = linear_in(minus(balance.left, balance.right), unknown)
            rest = [evaluate(linear.rest, values)]
            rows.append([evaluate(linear.coefficients[x], values) if x in linear.coefficients else 0.0 for x in unknown] + rest)
        value = np.linalg.solve(np.array(rows)[:, :3], -np.array(rows)[:, 3])
        torque, *_, at_d = bars.forces(hand)
        yield Answer("T", value[0], "N·m", torque, BALANCES, 1e-11, variant=name)
        says, check = "The force at D on DC is ({}, {}).", [at_d.real, at_d.imag]
        yield Answer("D", value[1:], "N", check, BALANCES, 1e-11, says=says, variant=name)


@ask("Which torque, and which forces at the pins, does AB ask for over a whole turn?")
def over_a_turn(case):
    """Both assemblies at a steady speed, by inverse dynamics, beside bar by bar."""
    for side, of in ((1, ""), (-1, "C to the right")):
        found = case.mechanism("driven.yaml", side=side, theta0=0, w0=4).inverse(until=pi / 2)
        times = np.linspace(0, pi / 2, 24, endpoint=False)
        bars = by_hand(side)
        known = [bars.forces(bars.motion(4 * t, 4, 0)) for t in times]
        torque = [each[0] for each in known]
        yield Answer("T every 15°", found.evaluate("drive.force", times), "N·m", torque, BALANCES, 1e-11, variant=of)
        for i, pin in enumerate("ABCD", 1):
            value = np.concatenate([found.evaluate(f"{pin}.{part}", times) for part in ("Fx", "Fy")])
            check = [each[i].real for each in known] + [each[i].imag for each in known]
            yield Answer(f"force at {pin} every 15°, along x, then y", value, "N", check, BALANCES, 1e-11, variant=of)
        work = found.work("drive")
        label = "work over the turn"
        yield Answer(label, work, "J", 0.0, "closed form: the kinetic energy comes back", 1e-9, scale=1.0, variant=of)


@ask("What is T symbolically, with the ratios of rates k = dβ/dθ, dφ/dθ and c = β̈, φ̈ for θ̈ = 0?")
def symbolically(case):
    """Power of inertia for a unit θ̇: the centre of BC has ℓ1 n1 + (ℓ2/2) k n2, and n1·n2 = cos(β − θ), n1·λ2 = sin(β − θ)."""
    C, S, spin = "cos(beta - theta)", "sin(beta - theta)", "(k_beta*accel(theta) + c_beta)"
    first = f"l1*(l1*accel(theta) + l2/2*({spin}*{C} - rate(beta)^2*{S}))"
    second = f"l2/2*k_beta*(l1*(accel(theta)*{C} + rate(theta)^2*{S}) + l2/2*{spin})"
    ends = "m1*l1^2/3*accel(theta) + m3*l3^2/3*k_phi*(k_phi*accel(theta) + c_phi)"
    closed = f"{ends} + m2*({first} + {second} + l2^2/12*k_beta*{spin})"
    found = case.mechanism("driven.yaml").solve_in_letters(["drive.force"])
    yield formula("T", found["drive.force"], closed, "closed form: virtual power", found.letters)
    for name, text in {
        "k_beta": "l1*sin(phi - theta)/(l2*sin(beta - phi))",
        "k_phi": "l1*sin(beta - theta)/(l3*sin(beta - phi))",
    }.items():
        yield formula(name, found.named[Sym(name)], text, "closed form: the loop along and across a bar", found.letters)


@ask("What θ̈ does that torque give put into forward dynamics, and what no torque?")
def forward(case):
    for name, (side, theta, rate, turning) in CASES.items():
        torque = given(case, name)[0]["drive.force"]
        for label, value, check, against in (
            ("With that torque", torque, turning, "other route: the acceleration that was prescribed"),
            ("With none", 0.0, by_hand(side).free(theta, rate), "closed form: power balance"),
        ):
            now = case.instant(parameters={"side": side, "T": value}, theta=theta, rates={"theta": rate})
            found, says = now["accel(theta)"], f"{label} θ̈ is {{}}."
            yield Answer("θ̈", found, "rad/s²", check, against, 1e-11, 1, says=says, variant=name)
