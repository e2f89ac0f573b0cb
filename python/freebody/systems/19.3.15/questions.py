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


@ask("In symbols, at release")
def symbolically(case):
    yield from case.symbolically(
        {"theta": "3*g/(2*l)", "x": "0"}, "closed form: the cart feels no force along x", at_rest=True, set={"theta": 0}
    )


@ask("At release")
def release(case):
    """About the hinge, which cannot move sideways yet: θ̈ = mgc/(I + mc²) = 3g/2ℓ."""
    value = case.instant().accelerations["theta"]
    yield Answer("angular acceleration, clockwise", value, "rad/s²", 3 * G / (4 * C), "closed form: 3g/2ℓ", 1e-12)


@ask("(a, b) The rod vertical")
def vertical(case):
    run = case.run()
    event = next(e for e in run.events if e.name == "vertical")
    said = {label: reported.value for label, reported in run.report.items()}
    speed = m * C * OMEGA / (M + m)
    yield Answer("angular speed", said["angular speed when vertical"], "rad/s", OMEGA, "conservation", 1e-10)
    yield Answer("displacement of the cart", said["cart when vertical"], "ft", m / (M + m), "conservation", 1e-10)
    yield Answer("time", event.t, "s", quarter(), "quadrature", 1e-10)
    yield Answer("speed of the cart", said["cart speed when vertical"], "ft/s", speed / FOOT, "conservation", 1e-10)
    force = m * (G + C * OMEGA**2) / LBF
    yield Answer(
        "hinge force on the rod, up", said["hinge force on the rod when vertical"], "lbf", force, "closed form: m(g + cθ̇²)", 1e-10
    )
    sideways = run.evaluate("pin.Fx", event.t) / LBF
    yield Answer("hinge force on the rod, sideways", sideways, "lbf", 0.0, "closed form: symmetry", 1e-9, force)


@ask("(c) The rod level again, on the left, where it only just comes")
def level(case):
    run = case.run()
    event = next(e for e in run.events if e.name == "level")
    yield Answer("displacement of the cart", run.report["cart when level"].value, "ft", 2 * m / (M + m), "conservation", 1e-10)
    yield Answer("time", event.t, "s", 2 * quarter(), "quadrature: twice that to the vertical", 1e-9)
    rest = [event.u["theta"] * FOOT, event.u["x"]]
    yield Answer("ℓθ̇/2, ẋ then", rest, "m/s", [0.0, 0.0], "conservation", 1e-7, OMEGA * C)
