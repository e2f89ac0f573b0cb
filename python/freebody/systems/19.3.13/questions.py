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
READINGS = {"a, b widths": ({}, 1.0, 0.4), "a, b heights": (HEIGHTS, HEIGHTS["a"], HEIGHTS["b"])}


def resultants(a, b, slid):
    """Where N acts along the upper face (from its thin edge, horizontally), and the floor's force along the base."""
    from_edge = 2 * b / 3 - b / 3 * sin(ALPHA) ** 2
    x = slid + from_edge
    y = (a - x) * tan(ALPHA)
    moment = cos(ALPHA) * (x - a / 3) - sin(ALPHA) * (y - a * tan(ALPHA) / 3)
    return from_edge, a / 3 + FORCE * moment / FLOOR


@ask("In symbols: accelerations from rest")
def symbolically(case):
    below = "(n + sin(alpha)^2)"
    closed = {
        "lower.x": f"-g*sin(alpha)*cos(alpha)/{below}",
        "upper.x": f"n*g*sin(alpha)*cos(alpha)/{below}",
        "upper.y": f"-(1 + n)*g*sin(alpha)^2/{below}",
    }
    yield from case.symbolically(closed, "closed form: momentum along x, the slope's direction, the prism's balance along it")


@ask("Velocities just before touch-down, time and displacements")
def touch_down(case):
    for of, (parameters, a, b) in READINGS.items():
        event = case.run(parameters=parameters).events[-1]
        drop = (a - b) * tan(ALPHA)
        V = sqrt(2 * G * drop / (N_RATIO**2 + N_RATIO + (1 + N_RATIO) ** 2 * tan(ALPHA) ** 2))
        lower, upper = ([event.u[f"{body}.{axis}"] for axis in "xy"] for body in ("lower", "upper"))
        check = [N_RATIO * V, -(1 + N_RATIO) * V * tan(ALPHA)]
        yield Answer(f"lower prism, x and y, {of}", lower, "m/s", [-V, 0.0], "conservation: energy, momentum", 1e-11)
        yield Answer(f"upper prism, x and y, {of}", upper, "m/s", check, "conservation: energy, momentum", 1e-11)
        time = sqrt(2 * (a - b) / (UPPER - LOWER))
        yield Answer(f"time, {of}", event.t, "s", time, BALANCE, 1e-11)
        ways = [event.q["lower.x"], event.q["upper.x"], event.q["upper.y"] - a * tan(ALPHA)]
        share = (a - b) / (1 + N_RATIO)
        check = [-share, N_RATIO * share, -drop]
        yield Answer(f"lower x, upper x and y, {of}", ways, "m", check, "conservation: mass centre stays over its place", 1e-11)


@ask("Contact and floor forces, at the start, half the time and just before touch-down")
def forces(case):
    run = case.run()
    times = [run.events[-1].t * part for part in (0, 0.5, 0.999)]
    yield Answer("between the prisms", run.evaluate("slope.N", times), "N", [FORCE] * 3, BALANCE, 1e-12)
    yield Answer("floor", run.evaluate("floor.N", times), "N", [FLOOR] * 3, BALANCE, 1e-12)
    yield Answer("acceleration of the lower prism", run.evaluate("ax(lower.G)", times), "m/s²", [LOWER] * 3, BALANCE, 1e-12)
    across, down = run.evaluate("ax(upper.G)", times), run.evaluate("ay(upper.G)", times)
    fall = FORCE * cos(ALPHA) / M - G
    yield Answer("acceleration of the upper prism, x", across, "m/s²", [UPPER] * 3, BALANCE, 1e-12)
    yield Answer("acceleration of the upper prism, y", down, "m/s²", [fall] * 3, BALANCE, 1e-12)


@ask("Where the forces act within the faces: does either prism tip?")
def tipping(case):
    for of, (parameters, a, b) in READINGS.items():
        run = case.run(parameters=parameters)
        end, against = run.events[-1].t, "closed form: moments about each mass centre"
        for name, part in (("start", 0.0), ("half the time", 0.5), ("touch-down", 0.999)):
            t = end * part
            face, base = resultants(a, b, (UPPER - LOWER) * t**2 / 2)
            at_face = run.evaluate("slope.x - x(upper.origin)", t)
            at_base = run.evaluate("floor.x - x(lower.origin)", t)
            yield Answer(f"from the thin edge, of {b:.4g} m: {name}, {of}", at_face, "m", face, against, 1e-11)
            yield Answer(f"from the vertical face, of {a:.4g} m: {name}, {of}", at_base, "m", base, against, 1e-11)
        turned = [run.evaluate(f"angle({body})", end) for body in ("lower", "upper")]
        yield Answer(f"turned in the end, {of}", turned, "rad", [0.0, 0.0], "both forces within the faces", 1e-12, 1.0)
