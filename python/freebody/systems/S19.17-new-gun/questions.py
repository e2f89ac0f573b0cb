"""New gun, its numbers.

The motion of S19.16 from rest, until R = l. Independent values: the two equations integrated by SciPy. Started from
rest, a torque c times as large gives the same motion at √c times the speed; so the angle at exit and Ṙ/θ̇ there are
the same for every torque. The power T θ̇ makes the energy T θ.
"""

import mpmath
import numpy as np

from freebody.catalogue import Answer, ask, reference

M1, M2, L = 1 / 3, 1.0, 1.0
I1 = M1 * L**2 / 3
SCIPY = "other route: two balances, integrated by SciPy"


def rates(torque):
    """First-order form for (θ, R, θ̇, Ṙ)."""
    return lambda t, y: [y[2], y[3], (torque - 2 * M2 * y[1] * y[3] * y[2]) / (I1 + M2 * y[1] ** 2), y[1] * y[2] ** 2]


def exit_of(torque, r=0.1, spin=0.0):
    return reference.event(rates(torque), [0, r, spin, 0], lambda t, y: y[1] - L, before=60 / max(torque, spin))


def shot(case, torque=1.0, r=0.1, spin=0.0):
    """The run and its exit."""
    run = case.run(parameters={"T": torque}, initial={"theta": 0, "R": r, "rates": {"theta": spin, "R": 0}})
    return run, next(event.t for event in run.events if event.name == "leaves")


@ask("What is the first-order form, with v = Ṙ, ω = θ̇ beside v̇ = R̈, ω̇ = θ̈?")
def first_order(case):
    closed = {"R": "R*rate(theta)^2", "theta": "(T - 2*m2*R*rate(R)*rate(theta))/(m1*l^2/3 + m2*R^2)"}
    yield from case.symbolically(closed, "closed form: moments about A, no force along the rod")


@ask("1. What are R(t), θ(t) and the polar path R(θ) for 0–1 s?")
def path(case):
    run, _ = shot(case)
    times = np.linspace(0.1, 1, 10)
    check = reference.motion(rates(1.0), [0, 0.1, 0, 0], times)
    yield Answer("R at 0.1 … 1 s", run.evaluate("R", times), "m", check[:, 1], SCIPY, 1e-11)
    yield Answer("θ at 0.1 … 1 s", run.evaluate("theta", times), "rad", check[:, 0], SCIPY, 1e-11)
    place = [run.evaluate(f"{axis}(collar.centre)", times) for axis in "xy"]
    polar = [check[:, 1] * np.cos(check[:, 0]), check[:, 1] * np.sin(check[:, 0])]
    for name, value, other in zip("xy", place, polar, strict=True):
        yield Answer(f"{name} of the collar at 0.1 … 1 s", value, "m", other, SCIPY, 1e-11)


@ask("2. When does the collar leave the rod, and how does it move then?")
def leaving(case):
    run, t = shot(case)
    when, (theta, _, spin, speed) = exit_of(1.0)
    yield Answer("t", t, "s", when, SCIPY, 1e-12, says="It leaves after {}.")
    yield Answer("R", run.evaluate("R", t), "m", L, "closed form: the length of the rod", 1e-14)
    yield Answer("θ", run.evaluate("theta", t), "rad", theta, SCIPY, 1e-11)
    yield Answer("Ṙ", run.evaluate("rate(R)", t), "m/s", speed, SCIPY, 1e-11)
    yield Answer("θ̇", run.evaluate("rate(theta)", t), "rad/s", spin, SCIPY, 1e-11)
    yield Answer("speed", run.evaluate("speed(collar.centre)", t), "m/s", np.hypot(speed, L * spin), SCIPY, 1e-11)


@ask("3. Is the energy the work of T all the time?")
def energy(case):
    """The power T θ̇ makes the energy T θ."""
    run, end = shot(case)
    times = np.linspace(0.2, 1, 5)
    turned = [*reference.motion(rates(1.0), [0, 0.1, 0, 0], times)[:, 0], exit_of(1.0)[1][0]]
    work, times, against = 1.0 * np.array(turned), [*times, end], "conservation: T θ, θ by SciPy"
    yield Answer("kinetic energy at 0.2 … 1 s and at exit", run.evaluate("kinetic()", times), "J", work, against, 1e-11)
    yield Answer("work of the motor in the ledger", run.evaluate("motor.work", times), "J", work, against, 1e-11)


@ask("4. What is θ at exit for T = 0.1, 0.5, 1, 1.5, 2, 2.5, 3, and Ṙ/θ̇ there?")
def torques(case):
    _, (theta, _, spin, speed) = exit_of(1.0)
    angles, ratios = [], []
    for torque in (0.1, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0):
        run, t = shot(case, torque)
        angles.append(run.evaluate("theta", t))
        ratios.append(run.evaluate("rate(R)", t) / run.evaluate("rate(theta)", t))
    scaled, says = "closed form: that of T = 1, by scaling time", "From rest θ at exit is {} for all of them."
    yield Answer("θ at exit", angles, "rad", [theta] * 7, scaled, 1e-11, says=says)
    says = "Ṙ/θ̇ there is {}: all follow one path, at other speeds."
    yield Answer("Ṙ/θ̇ at exit", ratios, "m", [speed / spin] * 7, scaled, 1e-11, says=says)
    for spin in (0.5, 1.0):
        for torque in (0.5, 1.0, 3.0):
            run, t = shot(case, torque, spin=spin)
            check, of = exit_of(torque, spin=spin)[1][0], f"θ̇0 = {spin:g}, T = {torque:g}"
            yield Answer("θ at exit", run.evaluate("theta", t), "rad", check, SCIPY, 1e-11, variant=of)
    for r in (0.05, 0.2, 0.5):
        run, t = shot(case, r=r)
        check = exit_of(1.0, r=r)[1][0]
        yield Answer("θ at exit", run.evaluate("theta", t), "rad", check, SCIPY, 1e-11, variant=f"R0 = {r:g}")


@ask("Is the moment of leaving located to the last digits?")
def last_digits(case):
    """The state near SciPy's moment in 30 digits, and from there the rest of the way at the speed it has."""
    near, _ = exit_of(1.0)

    def exact(t, y):
        _, r, spin, speed = y
        return [spin, speed, (1 - 2 * r * speed * spin) / (mpmath.mpf(1) / 9 + r**2), r * spin**2]

    with mpmath.workdps(40):
        ((theta, r, spin, speed),) = reference.many_digits(exact, [0, mpmath.mpf("0.1"), 0, 0], [near], step=0.05)
        rest = (1 - r) / speed
        check, angle = float(near + rest), float(theta + rest * spin)
    digits = "other route: two balances in 30 digits"
    run, t = shot(case)
    ends = case.run("free_end.yaml").events[0]
    yield Answer("t", t, "s", check, digits, 1e-13)
    yield Answer("θ", run.evaluate("theta", t), "rad", angle, digits, 1e-13)
    of = "by the free end of the slot"
    yield Answer("t", ends.t, "s", check, digits, 1e-13, variant=of)
    yield Answer("θ", ends.q["theta"], "rad", angle, digits, 1e-13, variant=of)


@ask("Does the collar fly straight on after the exit, while the rod goes on?")
def flight(case):
    """Once handed over to another model, and once in one, where the slot ends free."""
    run, t = shot(case)
    _, (theta, _, spin, speed) = exit_of(1.0)
    along, across = np.array([np.cos(theta), np.sin(theta)]), np.array([-np.sin(theta), np.cos(theta)])
    velocity = speed * along + L * spin * across
    straight, alone = "closed form: straight on from SciPy's exit", "closed form: constant torque on the rod alone"
    for how, later in (("", run.next), ("by the free end of the slot", case.run("free_end.yaml"))):
        for dt in (0.25, 0.5):
            place = [later.evaluate(f"{name}(collar.centre)", t + dt) for name in "xy"]
            check, says = L * along + dt * velocity, f"{dt} s after the exit the collar is at ({{}}, {{}})."
            yield Answer("place", place, "m", check, straight, 1e-11, says=says, variant=how)
            turned = theta + spin * dt + dt**2 / 2 / I1
            angle, says = later.evaluate("theta", t + dt), "The rod is at {} then."
            yield Answer("θ", angle, "rad", turned, alone, 1e-11, says=says, variant=how)
        moving = [later.evaluate(f"v{name}(collar.centre)", t + 0.5) for name in "xy"]
        says = "The collar's velocity is ({}, {}) then."
        yield Answer("velocity", moving, "m/s", velocity, straight, 1e-11, says=says, variant=how)
        work = theta + spin * 0.5 + 0.5**2 / 2 / I1
        moved = later.evaluate("kinetic()", t + 0.5)
        yield Answer("kinetic energy then", moved, "J", work, "conservation: T θ", 1e-11, variant=how)
    push = case.run("free_end.yaml").evaluate("track.Fn", t + 0.5)
    yield Answer("force of the rod on the collar", push, "N", 0.0, "closed form: they are apart", 1e-14, 1.0, variant=how)
