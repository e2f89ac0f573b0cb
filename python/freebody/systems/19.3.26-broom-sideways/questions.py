"""19.3.26: balancing a broom sideways: laws of the hand.

θ clockwise from the upward vertical, c from the hand to the mass centre, I about it; G = (s + c sin θ, c cos θ).
Moment about the hand:
    (I + mc²)θ̈ = mc(g sin θ − a cos θ),   (I + mc²)/mc = 2ℓ/3 for the uniform rod, ℓ for a particle at the end.
Force of the hand along x: m a_Gx = m(a + c(cos θ θ̈ − sin θ θ̇²)); its power is that times ṡ.
Near the upright, with κ = mc/(I + mc²) and a = K_x s + K_v ṡ + K_p θ + K_d θ̇, hand and broom have the polynomial
    λ⁴ + (κK_d − K_v)λ³ + (κK_p − κg − K_x)λ² + κg K_v λ + κg K_x,
from which the gains for given poles follow, one after another from the last coefficient.
"""

from dataclasses import replace
from math import cos, exp, sin, sqrt

import numpy as np

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import motion
from freebody.stability.modes import gains as placed

L, M, G = 1.5, 1.0, 9.81
C, REDUCED = L / 2, 2 * L / 3
GROWS = 1e-5  # 1/s; the free hand has the eigenvalue 0 twice
COLUMNS = [("s", "s", "m"), ("theta", "θ", "rad"), ("rate(s)", "ṡ", "m/s"), ("rate(theta)", "θ̇", "rad/s")]
GAINS = {"K_x": "1/s²", "K_v": "1/s", "K_p": "m/s²", "K_d": "m/s"}
BROOMS = {"model.yaml": "", "particle.yaml": "a particle at the end"}
DETERMINANT = "closed form: determinant by hand"
EQUATIONS = "other route: balances by hand, SciPy"


def swing(theta, a, reduced=REDUCED):
    return (G * sin(theta) - a * cos(theta)) / reduced


def push(theta, omega, a):
    return M * (a + C * (cos(theta) * swing(theta, a) - sin(theta) * omega**2))


def rates(law):
    """Of (s, θ, ṡ, θ̇)."""

    def f(_t, y):
        a = law(*y)
        return y[2], y[3], a, swing(y[1], a)

    return f


@ask("(a) What is θ̈ symbolically, the hand driven by its law?")
def symbolically(case):
    law = "(a0 + Kx*s + Kv*rate(s) + Kp*theta + Kd*rate(theta))"
    for file, length in (("model.yaml", "(2*l/3)"), ("particle.yaml", "l")):
        closed = {"theta": f"(g*sin(theta) - {law}*cos(theta))/{length}"}
        for answer in case.symbolically(closed, "closed form: moment about the hand", file):
            yield replace(answer, variant=BROOMS[file])


@ask("(a) How large is it at θ = 0.2, θ̇ = 0.5, a = 3, and the force of the hand?")
def instant(case):
    """θ̇ does not enter."""
    theta, omega, a = 0.2, 0.5, 3.0
    given = {"theta0": theta, "omega0": omega, "a0": a, "Kp": 0.0, "Kd": 0.0}
    for file, reduced in (("model.yaml", REDUCED), ("particle.yaml", L)):
        now, of, check = case.instant(file, given), BROOMS[file], swing(theta, a, reduced)
        yield Answer("θ̈", now.accelerations["theta"], "rad/s²", check, "closed form: moment about the hand", 1e-12, variant=of)
    value, says = case.instant(parameters=given)["hold.force"], "The hand pushes with {}."
    yield Answer("force", value, "N", push(theta, omega, a), "closed form: m a_G along x", 1e-12, says=says)


def compared(run, law, start, times):
    check = motion(rates(law), start, times)
    at = f"at {', '.join(f'{t:g}' for t in times)} s"
    for i, (text, name, unit) in enumerate(COLUMNS):
        size = max(float(np.abs(check[:, i]).max()), 1e-3)
        yield Answer(f"{name} {at}", run.evaluate(text, times), unit, check[:, i], EQUATIONS, 1e-8, size)
    forces = [push(y[1], y[3], law(*y)) for y in check]
    powers = [f * y[2] for f, y in zip(forces, check, strict=True)]
    yield Answer("force of the hand then", run.evaluate("hold.force", times), "N", forces, EQUATIONS, 1e-8, 1e-2)
    yield Answer("its power then", run.evaluate("hold.power", times), "W", powers, EQUATIONS, 1e-8, 1e-2)


@ask("(b) Which gains of a = K_p θ + K_d θ̇ keep the broom up?")
def keeping(case):
    """λ² + κK_d λ + κ(K_p − g) has its roots on the left where both coefficients are positive."""
    yield case.eigenvalues_of(
        "lambda^2*(lambda^2 + 3/(2*l)*Kd*lambda + 3/(2*l)*(Kp - g))", DETERMINANT, theta=0, a0=0, Kx=0, Kv=0
    )
    for Kp, Kd in ((1.01 * G, 1), (0.99 * G, 1), (20, 0.01), (20, -0.01)):
        (upright,) = case.mechanism(Kp=Kp, Kd=Kd).stability(theta=0, rates={"theta": 0})
        up, of = bool(np.linalg.eigvals(upright.space.a).real.max() < GROWS), f"K_p = {Kp:.5g} m/s², K_d = {Kd:g} m/s"
        yield Answer("stays up", up, "", Kp > G and Kd > 0, "closed form: positive coefficients", variant=of)


@ask("(b) What are all eigenvalues with a = 20 θ + 6 θ̇, those of the hand included?")
def eigenvalues(case):
    """The hand goes free: 0 twice; λ² + κ 6 λ + κ (20 − g) = 0 of the broom."""
    (upright,) = case.mechanism().stability(theta=0, rates={"theta": 0})
    found = np.linalg.eigvals(upright.space.a)
    check = [0, 0, *np.roots([1, 6 / REDUCED, (20 - G) / REDUCED])]
    for part in ("real", "imag"):
        values, own = ([getattr(x, part) for x in np.sort_complex(np.round(each, 6))] for each in (found, check))
        label = {"real": "their real parts", "imag": "their imaginary parts"}[part]
        yield Answer(label, values, "1/s", own, "closed form: characteristic polynomial", 1e-5, 1.0)


@ask("(b) How does the broom come upright with a = 20 θ + 6 θ̇ from θ = 0.3, and where does the hand go?")
def feedback(case):
    law, start = (lambda s, th, v, w: 20 * th + 6 * w), [0.0, 0.3, 0.0, 0.0]
    yield from compared(case.run(), law, start, [0.5, 1.0, 2.0, 5.0])
    found, late = case.mechanism().limit("rate(s)"), motion(rates(law), start, [30.0])[0, 2]
    says = "Upright, it goes on with the hand at {}."
    yield Answer("speed, t → ∞", float(found.value), "m/s", late, f"{EQUATIONS}, at 30 s", 1e-7, says=says)


@ask("How does a law that makes θ̈ = −9θ − 5θ̇ bring it up from θ = 0.3?")
def exact(case):
    """λ = (−5 ± √(25 − 36))/2, so θ = 0.3 e^(−5t/2) (cos νt + (5/2ν) sin νt), ν = √11/2, large angles or small."""
    nu, times = sqrt(11) / 2, [0.25, 0.5, 1.0, 2.0]
    check = [0.3 * exp(-2.5 * t) * (cos(nu * t) + 2.5 / nu * sin(nu * t)) for t in times]
    value = case.run("exact.yaml").evaluate("theta", times)
    yield Answer("θ at 0.25, 0.5, 1, 2 s", value, "rad", check, "closed form: damped oscillator", 1e-9)


def gains(poles):
    """K_x, K_v, K_p, K_d by comparison of coefficients."""
    _, c3, c2, c1, c0 = np.poly(poles)
    kappa = 1 / REDUCED
    Kx, Kv = c0 / (kappa * G), c1 / (kappa * G)
    return Kx, Kv, (c2 + kappa * G + Kx) / kappa, (c3 + Kv) / kappa


POLES = [-1, -2, -2.5, -3]


@ask("With the hand's position fed back too: what are the eigenvalues λ symbolically?")
def eigenvalues_symbolically(case):
    k = "(3/(2*l))"
    closed = f"lambda^4 + ({k}*Kd - Kv)*lambda^3 + ({k}*Kp - {k}*g - Kx)*lambda^2 + {k}*g*Kv*lambda + {k}*g*Kx"
    yield case.eigenvalues_of(closed, DETERMINANT, theta=0, a0=0)


@ask("Which gains give the poles −1, −2, −2.5, −3?")
def gains_for_poles(case):
    """The gains of x, ẋ, θ, θ̇ from A and B about the upright, with the acceleration a0 of the hand as input."""
    (upright,) = case.mechanism(Kp=0, Kd=0).stability(theta=0, rates={"theta": 0}, inputs=["a0"])
    found = dict(zip(upright.space.states, placed(upright.space, POLES)[0], strict=True))
    for text, (name, unit), check in zip(("s", "rate(s)", "theta", "rate(theta)"), GAINS.items(), gains(POLES), strict=True):
        yield Answer(name, found[text], unit, check, "closed form: comparison of coefficients", 1e-10)


@ask("How do hand and broom move with them for 10 s, from hand 0.1, θ 0.15?")
def position(case):
    Kx, Kv, Kp, Kd = gains(POLES)
    start = {"hand0": 0.1, "theta0": 0.15}
    run = case.run(parameters={"Kx": Kx, "Kv": Kv, "Kp": Kp, "Kd": Kd, **start})
    yield from compared(run, lambda s, th, v, w: Kx * s + Kv * v + Kp * th + Kd * w, [0.1, 0.15, 0.0, 0.0], [1.0, 2.0, 5.0, 10.0])
