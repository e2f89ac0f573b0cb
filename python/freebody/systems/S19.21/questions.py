"""Four-bar, inverse dynamics.

The loop A–B–C–D gives β, φ and, differentiated, their rates and accelerations from those of θ. Three balances of
angular momentum hold only T and the force at D: bars BC and DC about B, DC about C, the whole about A. The other
forces follow from linear momentum. See ``_linkages.py``.
"""

from freebody.catalogue import Answer, ask
from freebody.systems._linkages import FourBar, nearest_turn

CASES = {"first case": (1, 1.1, 4.0, 0.0), "second case": (-1, 2.6, -3.0, 5.0)}


def by_hand(side):
    return FourBar(0.3, 0.7, 0.6, 0.8, (0.8, 1.5, 1.1), side)


def given(case, name):
    """The driven instant, and the same by hand."""
    side, theta, rate, turning = CASES[name]
    now = case.instant("driven.yaml", {"side": side, "theta0": theta, "w0": rate, "a0": turning})
    return now, by_hand(side), by_hand(side).motion(theta, rate, turning)


@ask("β, φ with rates and accelerations")
def kinematics(case):
    for name in CASES:
        now, _, hand = given(case, name)
        angles = [nearest_turn(now[x], hand.angle[i]) for i, x in ((1, "beta"), (2, "phi"))]
        yield Answer(f"β, φ, {name}", angles, "rad", hand.angle[1:], "closed form: two circles meet at C", 1e-13)
        yield Answer(
            f"β̇, φ̇, {name}",
            [now["rate(beta)"], now["rate(phi)"]],
            "rad/s",
            hand.rate[1:],
            "closed form: loop differentiated",
            1e-12,
        )
        yield Answer(
            f"β̈, φ̈, {name}",
            [now["accel(beta)"], now["accel(phi)"]],
            "rad/s²",
            hand.turning[1:],
            "closed form: loop differentiated twice",
            1e-12,
        )


@ask("torque, and the forces at the four hinges")
def forces(case):
    for name in CASES:
        now, bars, hand = given(case, name)
        torque, *pins = bars.forces(hand)
        yield Answer(f"T, {name}", now["drive.force"], "N·m", torque, "closed form: three balances of angular momentum", 1e-12)
        yield Answer(
            f"T, {name}",
            now["drive.power"] / hand.rate[0],
            "N·m",
            bars.torque_by_power(hand),
            "closed form: virtual power",
            1e-12,
        )
        # C is the reaction on BC, its second body.
        for pin, force in zip("ABCD", pins, strict=True):
            on = {"A": "AB", "B": "BC", "C": "BC", "D": "DC"}[pin]
            yield Answer(
                f"force at {pin} on {on}, {name}",
                [now[f"{pin}.Fx"], now[f"{pin}.Fy"]],
                "N",
                [force.real, force.imag],
                "closed form: balances, bar by bar",
                1e-11,
            )


@ask("that torque put into forward dynamics; no torque")
def forward(case):
    for name, (side, theta, rate, turning) in CASES.items():
        torque = given(case, name)[0]["drive.force"]
        for label, value, check, against in (
            ("with that torque", torque, turning, "other route: the acceleration that was prescribed"),
            ("with no torque", 0.0, by_hand(side).free(theta, rate), "closed form: power balance"),
        ):
            now = case.instant(parameters={"side": side, "T": value}, theta=theta, rates={"theta": rate})
            yield Answer(f"θ̈ {label}, {name}", now["accel(theta)"], "rad/s²", check, against, 1e-11, scale=1)
