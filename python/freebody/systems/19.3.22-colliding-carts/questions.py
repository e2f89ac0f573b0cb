"""19.3.22: plastic collision of carts, the second with a bob on a cord.

The cord is plumb as A runs into B and takes no part in the impulse, P = m_A m_B v0/(m_A + m_B): both carts have v1 = m_A
v0/(m_A + m_B), the bob none. From then on the momentum m_A v0 goes along the track with v2 = m_A v0/(m_A + m_B + m_C) on the
mean. With M the mass of what moves with B, m that of the bob, μ = m/(M + m), θ the cord's angle, the energy seen from the
mass centre is ½mℓ²(1 − μ cos²θ)θ̇² − mgℓ cos θ: the time is a quadrature, and at the top, where all have v2, m g h = ½(1 −
μ)m v1². This h holds for every ℓ ≥ h; a shorter cord goes slack past the horizontal.

The cord pulls B back while the bob is behind, and A presses on with m_A T sin θ/M. Where the cord is plumb again, carts and
bob have exchanged their speeds about v2, as after an elastic collision; from then on the cord pulls B away from A. The
second swing is that of B and the bob alone, with the same relative speed v1: lower. A latch holds A: then both swings are
alike.
"""

from math import acos, cos, pi, sin, sqrt

import numpy as np
from scipy.integrate import quad

from freebody.catalogue import Answer, ask

G = 9.81
SETS = {"": (10.0, 10.0, 10.0, 1.0), "4, 7, 2.5 kg": (4.0, 7.0, 2.5, 3.0)}
BALANCE = "closed form: momentum and energy"


def variant(of, file):
    """What differs from carts of 10 kg each that only touch."""
    return ", ".join(filter(None, [of, "A and B latch" if file == "latch.yaml" else ""]))


class Swing:
    """From plumb to plumb: M on the track, m on the cord, relative speed v1 at the start."""

    def __init__(self, M, m, v1, length):
        self.M, self.m, self.length = M, m, length
        self.mu = m / (M + m)
        self.height = (1 - self.mu) * v1**2 / (2 * G)
        self.top = acos(1 - self.height / length)
        self.tension = m * G * cos(self.top) / (1 + m * sin(self.top) ** 2 / M)

    def quarter(self):
        """Time from plumb to the top. With θ = θt sin s, x = (θt + θ)/2 and y = (θt − θ)/2, dt/ds is smooth."""

        def integrand(s):
            x, y = self.top * (1 + sin(s)) / 2, self.top * (1 - sin(s)) / 2
            slow = 1 - self.mu * cos(self.top * sin(s)) ** 2
            return sqrt(slow * self.length / G / (np.sinc(x / pi) * np.sinc(y / pi)))

        return quad(integrand, 0, pi / 2, epsabs=0, epsrel=1e-13)[0]


def parameters(masses, length=1.0):
    return dict(zip(("mA", "mB", "mC", "v0"), masses, strict=True), l=length)


def named(run, name, n=0):
    return [event for event in run.events if event.name == name][n]


def height(run, event, length=1.0):
    return event.q["C.y"] + length


@ask("What does the impact do: velocities and impulses after it, energy lost?")
def impact(case):
    for of, masses in SETS.items():
        mA, mB, _, v0 = masses
        both, P = mA * v0 / (mA + mB), mA * mB * v0 / (mA + mB)
        for file in ("model.yaml", "latch.yaml"):
            run = case.run(file, parameters(masses))
            (hit,) = (c for c in run.changes if c.kind == "impact")
            rates = hit.after.u
            label = variant(of, file)
            yield Answer("velocities of A, B", [rates["xA"], rates["xB"]], "m/s", [-both, -both], BALANCE, 1e-12, variant=label)
            yield Answer(
                "velocity of C",
                [rates["C.x"], rates["C.y"]],
                "m/s",
                0.0,
                "closed form: a plumb cord takes no part",
                1e-12,
                both,
                variant=label,
            )
            yield Answer("energy lost", hit.lost, "J", P * v0 / 2, BALANCE, 1e-12, variant=label)
            if file == "model.yaml":
                ((name, impulse),) = hit.impulses.contacts.items()
                yield Answer("impulse of B on A", impulse[0], "N·s", P, BALANCE, 1e-12, variant=label)
                yield Answer(
                    "impulse of the cord",
                    float(name != "bump"),
                    "N·s",
                    0.0,
                    "closed form: a plumb cord takes no part",
                    0.0,
                    1.0,
                    variant=label,
                )
            else:
                impulse = abs(hit.impulses.joints["meet weld"][0])
                yield Answer("impulse of the latch on B", impulse, "N·s", P, BALANCE, 1e-12, variant=label)


@ask("What is the greatest height of C above its lowest point, and how do things stand there?")
def top(case):
    for of, masses in SETS.items():
        mA, mB, mC, v0 = masses
        swing = Swing(mA + mB, mC, mA * v0 / (mA + mB), 1.0)
        meets = 0.2 / v0
        for file in ("model.yaml", "latch.yaml"):
            run = case.run(file, parameters(masses))
            first, label = named(run, "top"), variant(of, file)
            yield Answer("height", height(run, first), "m", swing.height, BALANCE, 1e-10, variant=label)
            late = max(height(run, e) for e in run.events if "top" in e.name)
            yield Answer("greatest height of all swings", late, "m", swing.height, BALANCE, 1e-10, variant=label)
            yield Answer("velocities of A, B, C", [first.u[n] for n in ("xA", "xB", "C.x")], "m/s",
                         -mA * v0 / (mA + mB + mC), BALANCE, 1e-9, variant=label)  # fmt: skip
            yield Answer("time since the impact", first.t - meets, "s", swing.quarter(), "quadrature", 1e-9, variant=label)
            angle = run.evaluate("pi/2 + direction(B.origin, C.centre)", first.t)
            yield Answer("angle", angle, "rad", swing.top, BALANCE, 1e-9, variant=label)
            yield Answer(
                "tension",
                run.evaluate("cord.tension", first.t),
                "N",
                swing.tension,
                "closed form: balances at the top",
                1e-9,
                variant=label,
            )
            if file == "model.yaml":
                push = run.evaluate("bump.N", first.t)
                check = mA * swing.tension * sin(swing.top) / (mA + mB)
                yield Answer("A pushes B with", push, "N", check, "closed form: balances at the top", 1e-9, variant=label)


@ask("How do they move when the cord is plumb again, and how high is the second swing?")
def second(case):
    for of, masses in SETS.items():
        mA, mB, mC, v0 = masses
        v1, v2 = mA * v0 / (mA + mB), mA * v0 / (mA + mB + mC)
        for file in ("model.yaml", "latch.yaml"):
            run, label = case.run(file, parameters(masses)), variant(of, file)
            plumb, again = named(run, "vertical"), named(run, "second top")
            swing = Swing(mA + mB, mC, v1, 1.0)
            yield Answer("time since the impact", plumb.t - 0.2 / v0, "s", 2 * swing.quarter(), "quadrature", 1e-9, variant=label)
            carts = v1 - 2 * v2
            check = [carts, carts, -2 * v2]
            yield Answer(
                "velocities of A, B, C then",
                [plumb.u[n] for n in ("xA", "xB", "C.x")],
                "m/s",
                check,
                BALANCE,
                1e-9,
                variant=label,
            )
            M = mB if file == "model.yaml" else mA + mB
            alone = Swing(M, mC, v1, 1.0)
            yield Answer("height of the second swing", height(run, again), "m", alone.height, BALANCE, 1e-9, variant=label)
            yield Answer(
                "its time from plumb to the top", again.t - plumb.t, "s", alone.quarter(), "quadrature", 1e-8, variant=label
            )
            if file == "model.yaml":
                part = next(c.t for c in run.changes if c.kind == "lift-off")
                yield Answer(
                    "A and B part, since the impact", part - 0.2 / v0, "s", 2 * swing.quarter(), "quadrature", 1e-8, variant=label
                )


@ask("What is the effect of ℓ on the height h, and what the least ℓ for which it holds?")
def lengths(case):
    for of, masses in SETS.items():
        mA, mB, mC, v0 = masses
        h = Swing(mA + mB, mC, mA * v0 / (mA + mB), 1e3).height
        for ratio in (100.0, 3.0, 1.01):
            run = case.run(parameters=parameters(masses, ratio * h), until=0.2 / v0 + 2 * sqrt(ratio * h))
            told, value = ", ".join(filter(None, [of, f"ℓ = {ratio:g} h"])), height(run, named(run, "top"), ratio * h)
            yield Answer("height", value, "m", h, BALANCE, 1e-9, variant=told)
        for ratio, slack in ((1.01, False), (0.99, True)):
            run = case.run(parameters=parameters(masses, ratio * h), until=0.2 / v0 + 1.5 * sqrt(h))
            found = [c for c in run.changes if c.kind == "slack"]
            told = ", ".join(filter(None, [of, f"ℓ = {ratio:g} h"]))
            says = "The cord goes slack before the top." if found else "The cord stays taut."
            yield Answer("slack", bool(found), "", slack, "closed form: past the horizontal", scale=1.0, says=says, variant=told)
