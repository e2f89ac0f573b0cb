"""19.3.13: prism on prism, everything frictionless.

Neither turns. The contact force N acts along the slope's normal (sin α, cos α), on the upper prism, backwards on the lower:
    N = mg cos α/(1 + sin²α/n),   floor: n mg + N cos α,   lower: −N sin α/(nm),   upper: (N sin α/m, N cos α/m − g).
The upper one does not turn, so N passes through its mass centre: from the thin edge, 2b/3 − (b/3) sin²α to the right, always
within its face. The floor's force balances the moments about the lower prism's mass centre; both forces keep inside the faces
with these numbers, so neither prism tips. Touch-down after a slide a − b against each other, a drop (a − b) tan α. Energy
and horizontal momentum (upper u = n V to the right, lower V to the left, relative to each other along the slope):
    V² (n² + n + (1 + n)² tan²α) = 2g × drop.
"""

from math import cos, pi, sin, sqrt, tan

from freebody.catalogue import Answer, ask

N_RATIO, M, G, ALPHA = 3.0, 2.0, 9.81, pi / 6
FORCE = M * G * cos(ALPHA) / (1 + sin(ALPHA) ** 2 / N_RATIO)
FLOOR = N_RATIO * M * G + FORCE * cos(ALPHA)
LOWER, UPPER = -FORCE * sin(ALPHA) / (N_RATIO * M), FORCE * sin(ALPHA) / M
BALANCE = "closed form: momentum of each prism"
HEIGHTS = {"a": 1 / tan(ALPHA), "b": 0.4 / tan(ALPHA)}
READINGS = {"": ({}, 1.0, 0.4), "a, b taken as heights": (HEIGHTS, HEIGHTS["a"], HEIGHTS["b"])}


def resultants(a, b, slid):
    """Where N acts along the upper face (from its thin edge, horizontally), and the floor's force along the base."""
    from_edge = 2 * b / 3 - b / 3 * sin(ALPHA) ** 2
    x = slid + from_edge
    y = (a - x) * tan(ALPHA)
    moment = cos(ALPHA) * (x - a / 3) - sin(ALPHA) * (y - a * tan(ALPHA) / 3)
    return from_edge, a / 3 + FORCE * moment / FLOOR


@ask("How do the prisms accelerate, in letters?")
def symbolically(case):
    below = "(n + sin(alpha)^2)"
    closed = {
        "lower.x": f"-g*sin(alpha)*cos(alpha)/{below}",
        "upper.x": f"n*g*sin(alpha)*cos(alpha)/{below}",
        "upper.y": f"-(1 + n)*g*sin(alpha)^2/{below}",
    }
    yield from case.symbolically(closed, "closed form: momentum along x, the slope's direction, the prism's balance along it")


@ask("How fast are both just before touch-down, when is it, and where are they?")
def touch_down(case):
    conserved, centre = "conservation: energy, momentum", "conservation: mass centre stays over its place"
    for of, (parameters, a, b) in READINGS.items():
        event = case.run(parameters=parameters).events[-1]
        drop = (a - b) * tan(ALPHA)
        V = sqrt(2 * G * drop / (N_RATIO**2 + N_RATIO + (1 + N_RATIO) ** 2 * tan(ALPHA) ** 2))
        lower, upper = ([event.u[f"{body}.{axis}"] for axis in "xy"] for body in ("lower", "upper"))
        says = "The lower one has {} along x and {} along y,"
        yield Answer("lower", lower, "m/s", [-V, 0.0], conserved, 1e-11, says=says, variant=of)
        check, says = [N_RATIO * V, -(1 + N_RATIO) * V * tan(ALPHA)], "the upper one {} and {}."
        yield Answer("upper", upper, "m/s", check, conserved, 1e-11, says=says, variant=of)
        time, says = sqrt(2 * (a - b) / (UPPER - LOWER)), "It takes {}."
        yield Answer("t", event.t, "s", time, BALANCE, 1e-11, says=says, variant=of)
        ways = [event.q["lower.x"], event.q["upper.x"], event.q["upper.y"] - a * tan(ALPHA)]
        share = (a - b) / (1 + N_RATIO)
        says = "The lower one has moved by {} along x, the upper one by {} along x and {} along y."
        yield Answer("ways", ways, "m", [-share, N_RATIO * share, -drop], centre, 1e-11, says=says, variant=of)


@ask("What forces act between them and from the floor, and what accelerations do they give?")
def forces(case):
    """At the start, half the time and just before touch-down."""
    run, fall = case.run(), FORCE * cos(ALPHA) / M - G
    times = [run.events[-1].t * part for part in (0, 0.5, 0.999)]
    for text, unit, check, says in (
        ("slope.N", "N", FORCE, "Between the prisms {}, at all times,"),
        ("floor.N", "N", FLOOR, "from the floor {}."),
        ("ax(lower.G)", "m/s²", LOWER, "The lower one accelerates at {},"),
        ("ax(upper.G)", "m/s²", UPPER, "the upper one at {} along x"),
        ("ay(upper.G)", "m/s²", fall, "and {} along y."),
    ):
        yield Answer(text, run.evaluate(text, times), unit, [check] * 3, BALANCE, 1e-12, says=says)


@ask("Where within the faces do the forces act: does either prism tip?")
def tipping(case):
    for of, (parameters, a, b) in READINGS.items():
        run = case.run(parameters=parameters)
        end, against = run.events[-1].t, "closed form: moments about each mass centre"
        turned = [run.evaluate(f"angle({body})", end) for body in ("lower", "upper")]
        says = "Neither tips: in the end they have turned by {}."
        yield Answer("turned", turned, "rad", [0.0, 0.0], "both forces within the faces", 1e-12, 1.0, says=says, variant=of)
        times = [end * part for part in (0.0, 0.5, 0.999)]
        check = [resultants(a, b, (UPPER - LOWER) * t**2 / 2) for t in times]
        face, base = run.evaluate("slope.x - x(upper.origin)", times), run.evaluate("floor.x - x(lower.origin)", times)
        when = "at the start, half the time and touch-down"
        says = f"From the thin edge, of {b:.4g} m in all, {when}: {{}}."
        yield Answer("slope", face, "m", [x for x, _ in check], against, 1e-11, says=says, variant=of)
        says = f"From the vertical face, of {a:.4g} m in all: {{}}."
        yield Answer("floor", base, "m", [x for _, x in check], against, 1e-11, says=says, variant=of)
