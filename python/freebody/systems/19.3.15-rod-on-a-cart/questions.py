"""19.3.15: rod pinned to a cart.

θ clockwise from +x, half length c = ℓ/2, I = mℓ²/12. No horizontal force from outside, all at rest at first: the mass
centre stays over its place, (M + m)x + mc cos θ = mc, so ẋ = mc sin θ θ̇/(M + m). The energy is then
    ½J(θ)θ̇² = mgc sin θ,   J = I + mc² − m²c² sin²θ/(M + m).
The rod comes to rest again just when it is level on the left. By symmetry θ̈ = 0 and ẍ = 0 when it is vertical, where the hinge
carries the weight and mcθ̇². Times are quadratures of √(J/(2mgc sin θ)); with θ = w² they are smooth.
"""

from math import pi, sin, sqrt

from scipy.integrate import quad

from freebody.catalogue import Answer, ask

FOOT, POUND = 0.3048, 0.45359237
G, M, m, C = 9.80665, 10 * POUND, 10 * POUND, FOOT
I = m * (2 * C) ** 2 / 12
LBF = POUND * G


def J(theta):
    return I + m * C**2 - (m * C * sin(theta)) ** 2 / (M + m)


OMEGA = sqrt(2 * m * G * C / J(pi / 2))


def quarter():
    """Time from level to vertical: dt = √(J/(2mgc sin θ)) dθ."""

    def integrand(w):
        theta = w * w
        return 2 * sqrt(J(theta) / (2 * m * G * C)) * (sqrt(theta / sin(theta)) if w else 1.0)

    return quad(integrand, 0, sqrt(pi / 2), epsabs=0, epsrel=1e-13)[0]


@ask("How do rod and cart accelerate at release?")
def release(case):
    """About the hinge, which cannot move sideways yet: θ̈ = mgc/(I + mc²) = 3g/2ℓ."""
    closed = {"theta": "3*g/(2*l)", "x": "0"}
    yield from case.symbolically(closed, "closed form: the cart feels no force along x", at_rest=True, set={"theta": 0})
    value, says = case.instant().accelerations["theta"], "That is {}, clockwise."
    yield Answer("θ̈", value, "rad/s²", 3 * G / (4 * C), "closed form: 3g/2ℓ", 1e-12, says=says)


@ask(
    "With the rod vertical: (a) how fast does it turn, (b) how far and fast has the cart moved, what does the hinge carry, when is it?"
)
def vertical(case):
    run, conserved = case.run(), "conservation: energy, momentum"
    event = next(e for e in run.events if e.name == "vertical")
    said = {label.removesuffix(" when vertical"): reported.value for label, reported in run.report.items()}
    yield Answer("ω", said["angular speed"], "rad/s", OMEGA, conserved, 1e-10, says="(a) It turns at {}.")
    yield Answer("x", said["cart"], "ft", m / (M + m), conserved, 1e-10, says="(b) The cart has moved by {},")
    yield Answer("v", said["cart speed"], "ft/s", m * C * OMEGA / (M + m) / FOOT, conserved, 1e-10, says="at {}.")
    yield Answer("t", event.t, "s", quarter(), "quadrature", 1e-10, says="It is {} after release.")
    force, against = m * (G + C * OMEGA**2) / LBF, "closed form: m(g + cθ̇²), by symmetry nothing sideways"
    says = "The hinge pulls the rod with {} upwards"
    yield Answer("Fy", said["hinge force on the rod"], "lbf", force, against, 1e-10, says=says)
    sideways = run.evaluate("pin.Fx", event.t) / LBF
    yield Answer("Fx", sideways, "lbf", 0.0, against, 1e-9, force, says="and {} sideways.")


@ask("(c) Where is the cart when the rod is next horizontal, on the left, and does the rod pass there?")
def level(case):
    run = case.run()
    event = next(e for e in run.events if e.name == "level")
    moved, says = run.report["cart when level"].value, "The cart has moved by {}."
    yield Answer("x", moved, "ft", 2 * m / (M + m), "conservation", 1e-10, says=says)
    against = "quadrature: twice that to the vertical"
    yield Answer("t", event.t, "s", 2 * quarter(), against, 1e-9, says="It is {} after release.")
    rest, says = (
        [event.u["theta"] * FOOT, event.u["x"]],
        "The rod only just comes there: its middle has {} against the cart, and the cart {}.",
    )
    yield Answer("ℓθ̇/2, ẋ", rest, "m/s", [0.0, 0.0], "conservation", 1e-7, OMEGA * C, says=says)
