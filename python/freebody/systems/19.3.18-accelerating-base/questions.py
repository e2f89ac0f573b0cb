"""19.3.18: pendulum with accelerating base.

The bob has a_A i + ℓθ̈ e_θ − ℓθ̇² e_R; only the tension acts, −T e_R. Across the rod: ℓθ̈ = a_A sin θ. Along it:
T = M(ℓθ̇² − a_A cos θ). θ̈ depends on a_A, ℓ and θ, not on M and θ̇. The hinge pulls the bob with −T e_R; the base,
without mass, is driven with F = −T cos θ; the power is F ẋ_A. With a_A constant,
½ℓθ̇² + a_A cos θ stays: the base's frame has a gravity of a_A toward −x.
"""

from math import cos, sin

from freebody.catalogue import Answer, ask
from freebody.catalogue.answers import formula
from freebody.catalogue.reference import motion

L, M, THETA, OMEGA, A = 0.8, 2.0, 0.7, 1.3, 3.1
SYMBOLS = {"aA": "a_A", "l": "ℓ", "M": "M", "theta0": "θ", "omega0": "θ̇"}
AGAINST = "closed form: balance along and across the rod"


def tension(theta, omega, a=A, mass=M):
    return mass * (L * omega**2 - a * cos(theta))


@ask("What is θ̈ in terms of a_A, ℓ, M, θ, θ̇?")
def symbolically(case):
    yield from case.symbolically({"theta": "aA*sin(theta)/l"}, "closed form: balance across the rod")


@ask("How large is it, what force does the hinge pass, and what force drives A?")
def instant(case):
    now, T = case.instant(), tension(THETA, OMEGA)
    yield Answer("θ̈", now.accelerations["theta"], "rad/s²", A * sin(THETA) / L, AGAINST, 1e-13)
    yield Answer("tension", now["rod.tension"], "N", T, AGAINST, 1e-12)
    force = [now["rod.Fx"], now["rod.Fy"]]
    yield Answer("force of the hinge on the pendulum", force, "N", [-T * cos(THETA), -T * sin(THETA)], AGAINST, 1e-12)
    yield Answer("force that drives A", now["drive.force"], "N", -T * cos(THETA), AGAINST, 1e-12)


@ask("On which of a_A, ℓ, M, θ, θ̇ does it depend?")
def depends(case):
    other = {"aA": 5.0, "l": 1.1, "M": 7.0, "theta0": -0.4, "omega0": -2.0}
    known = {"aA": A, "l": L, "theta0": THETA}
    before, depends = A * sin(THETA) / L, []
    for name, value in other.items():
        now = {**known, name: value}
        check = now["aA"] * sin(now["theta0"]) / now["l"]
        result = case.instant(parameters={name: value}).accelerations["theta"]
        depends.append(abs(result - before) > 1e-12)
        yield Answer("θ̈", result, "rad/s²", check, AGAINST, 1e-12, variant=f"{SYMBOLS[name]} = {value:g}")
    on, not_on = (
        ", ".join(SYMBOLS[name] for name, is_so in zip(other, depends, strict=True) if is_so is so) for so in (True, False)
    )
    says = f"It depends on {on}, not on {not_on}."
    yield Answer("depends", depends, "", [name in known for name in other], AGAINST, scale=1.0, says=says)


@ask("How does it move for 2 s from a base at rest, a_A constant, and what force and power drive A?")
def run(case):
    times = [0.5, 1.0, 1.5, 2.0]
    check = motion(lambda _t, s: (s[1], A * sin(s[0]) / L), [THETA, OMEGA], times)
    run = case.run()
    against = "other route: balances by hand, SciPy"
    yield Answer("θ at 0.5…2 s", run.evaluate("theta", times), "rad", check[:, 0], against, 1e-9)
    yield Answer("θ̇ at 0.5…2 s", run.evaluate("rate(theta)", times), "rad/s", check[:, 1], against, 1e-9)
    drive = [-tension(*s) * cos(s[0]) for s in check]
    yield Answer("force that drives A then", run.evaluate("drive.force", times), "N", drive, against, 1e-8)
    power = [f * A * t for f, t in zip(drive, times, strict=True)]
    yield Answer("its power then", run.evaluate("drive.power", times), "W", power, against, 1e-8)


@ask("What is a first integral of that motion?")
def integral(case):
    (found,) = case.mechanism().first_integrals()
    closed = "M*l*(l*rate(theta)^2/2 + aA*cos(theta))"
    yield formula(f"{found.words}: {found.reason}", found.quantity, closed, "closed form: energy in the base's frame, times Mℓ")
    along = found.along(case.run())
    start = M * L * (L / 2 * OMEGA**2 + A * cos(THETA))
    ends, says = [along.min(), along.max()], "In these 2 s it stays {}."
    yield Answer("its value", ends, "J", [start] * 2, "its value at the start", 1e-10, says=says)
