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


@ask("What are the acceleration, the angular acceleration and the tension, in letters?")
def symbolically(case):
    below = "(R^2 + 2*r^2)"
    closed = {
        "disk.y": f"-2*g*r^2/{below}",
        "disk.angle": f"-2*g*r/{below}",
        "cable.tension": f"M*g*R^2/{below}",
    }
    yield from case.symbolically(closed, "closed form: moments about the point where the cable leaves", at_rest=True)


@ask("How does it swing, in the tilt φ of the taut cable and its free length l, in letters?")
def swing(case):
    closed = {
        "l": "2*g*r^2/(R^2 + 2*r^2)",
        "cable.tension": "M*g*R^2/(R^2 + 2*r^2)",
        "phi": "0",
    }
    yield from case.symbolically(
        closed, "closed form: moments about the point where the cable leaves", "taut.yaml", at_rest=True, set={"phi": 0}
    )


@ask("What is the acceleration of the mass centre, the tension, the angular acceleration?")
def at_release(case):
    now = case.instant()
    acceleration = [now["ax(disk.centre)"], now["ay(disk.centre)"]]
    says = "The mass centre accelerates at {} along x and {} along y."
    yield Answer("a", acceleration, "m/s²", [0.0, -A], AGAINST, 1e-12, says=says)
    yield Answer("T", now["cable.tension"], "N", T, AGAINST, 1e-12, says="The cable carries {}.")
    yield Answer("α", -now["alpha(disk)"], "rad/s²", A / r, AGAINST, 1e-12, says="Clockwise it gains {}.")
    thick = case.instant(parameters={"R": 0.03, "r": 0.02})
    check = -G / (1 + 0.03**2 / (2 * 0.02**2))
    yield Answer("a_y", thick["ay(disk.centre)"], "m/s²", check, AGAINST, 1e-12, variant="R = 0.03 m, r = 0.02 m")


@ask("How far has it dropped after 0.5 s, how fast, with what spin and energy?")
def half_second(case):
    run, t = case.run(), 0.5
    yield Answer("drop", -run.evaluate("y(disk.centre)", t), "m", A * t**2 / 2, AGAINST, 1e-11, says="It has dropped by {}.")
    yield Answer("v", run.evaluate("speed(disk.centre)", t), "m/s", A * t, AGAINST, 1e-11, says="It falls at {}.")
    says = "It spins clockwise at {}."
    yield Answer("ω", -run.evaluate("omega(disk)", t), "rad/s", A * t / r, AGAINST, 1e-11, says=says)
    energy, says = M * G * A * t**2 / 2, "Its kinetic energy is {}, what the weight has worked."
    yield Answer("E", run.evaluate("kinetic()", t), "J", energy, "conservation: Mg × drop", 1e-11, says=says)


@ask("When is no cable left on the drum, and how does it move then?")
def all_off(case):
    run = case.run()
    event = next(e for e in run.events if e.name == "no cable left")
    says = "The run ends after {}, by the event `no cable left`."
    yield Answer("t", [float(run.edges[-1])], "s", sqrt(2 * WOUND / A), AGAINST, 1e-11, says=says)
    turned, says = -event.q["disk.angle"], "It has turned by {}."
    yield Answer("angle", turned, "rad", WOUND / r, "closed form: wound length/r", 1e-12, says=says)
    place, says = [event.q["disk.x"], event.q["disk.y"]], "It is at x = {}, y = {}."
    yield Answer("place", place, "m", [0.0, -WOUND], "closed form: straight down", 1e-11, says=says)
    yield Answer("v", -event.u["disk.y"], "m/s", sqrt(2 * A * WOUND), AGAINST, 1e-11, says="It falls at {}.")
    says = "It spins clockwise at {}."
    yield Answer("ω", -event.u["disk.angle"], "rad/s", sqrt(2 * A * WOUND) / r, AGAINST, 1e-11, says=says)
    says = "The cable carries {} until then."
    yield Answer("T", run.evaluate("cable.tension", event.t - 1e-6), "N", T, AGAINST, 1e-9, says=says)
