"""19.3.8: yo-yo, a disk that unwinds a cable from its drum.

The cable leaves the drum at the side, at r from the centre, and hangs straight: all forces are vertical. With the drop y
and the spin ω = ẏ/r (no slip), I = MR²/2:
    Mg − T = M ÿ,   T r = I ω̇   ⟹   ÿ = g/(1 + R²/(2r²)),   T = Mg − M ÿ.
The cable is free to swing and does not: nothing pushes the centre sideways. Once all of it is off the drum, the disk swings
about the place where it is tied and winds it up again; the run ends before that.
"""

from math import sqrt

from freebody.catalogue import Answer, ask

M, R, r, G, WOUND = 0.2, 0.05, 0.01, 9.81, 0.5
A = G / (1 + R**2 / (2 * r**2))
T = M * (G - A)
AGAINST = "closed form: Mg − T = Mÿ, Tr = Iÿ/r"


@ask("In symbols, just after release")
def symbolically(case):
    below = "(R^2 + 2*r^2)"
    closed = {
        "disk.y": f"-2*g*r^2/{below}",
        "disk.angle": f"-2*g*r/{below}",
        "cable.tension": f"M*g*R^2/{below}",
    }
    yield from case.symbolically(closed, "closed form: moments about the point where the cable leaves", at_rest=True)


@ask("Acceleration of the mass centre, tension, angular acceleration")
def at_release(case):
    now = case.instant()
    acceleration = [now["ax(disk.centre)"], now["ay(disk.centre)"]]
    yield Answer("acceleration x, y", acceleration, "m/s²", [0.0, -A], AGAINST, 1e-12)
    yield Answer("tension", now["cable.tension"], "N", T, AGAINST, 1e-12)
    yield Answer("angular acceleration, clockwise", -now["alpha(disk)"], "rad/s²", A / r, AGAINST, 1e-12)
    thin = case.instant(parameters={"R": 0.03, "r": 0.02})
    check = -G / (1 + 0.03**2 / (2 * 0.02**2))
    yield Answer("acceleration for R = 0.03, r = 0.02", thin["ay(disk.centre)"], "m/s²", check, AGAINST, 1e-12)


@ask("Drop, speed and spin at 0.5 s; energy")
def half_second(case):
    run, t = case.run(), 0.5
    yield Answer("drop", -run.evaluate("y(disk.centre)", t), "m", A * t**2 / 2, AGAINST, 1e-11)
    yield Answer("speed", run.evaluate("speed(disk.centre)", t), "m/s", A * t, AGAINST, 1e-11)
    yield Answer("spin, clockwise", -run.evaluate("omega(disk)", t), "rad/s", A * t / r, AGAINST, 1e-11)
    energy = M * G * A * t**2 / 2
    yield Answer("kinetic energy", run.evaluate("kinetic()", t), "J", energy, "conservation: Mg × drop", 1e-11)


@ask("Until no cable is left")
def all_off(case):
    run = case.run()
    event = next(e for e in run.events if e.name == "no cable left")
    yield Answer("time", event.t, "s", sqrt(2 * WOUND / A), AGAINST, 1e-11)
    yield Answer("turns of the disk", -event.q["disk.angle"], "rad", WOUND / r, "closed form: wound length/r", 1e-12)
    yield Answer("place x, y", [event.q["disk.x"], event.q["disk.y"]], "m", [0.0, -WOUND], "closed form: straight down", 1e-11)
    yield Answer("speed", -event.u["disk.y"], "m/s", sqrt(2 * A * WOUND), AGAINST, 1e-11)
    yield Answer("spin, clockwise", -event.u["disk.angle"], "rad/s", sqrt(2 * A * WOUND) / r, AGAINST, 1e-11)
    yield Answer("tension just before", run.evaluate("cable.tension", event.t - 1e-6), "N", T, AGAINST, 1e-9)
    yield Answer("the run ends there", float(run.edges[-1]), "s", sqrt(2 * WOUND / A), AGAINST, 1e-11)
