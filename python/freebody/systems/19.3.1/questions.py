"""Particle on a springy leash.

The string pulls with k r towards the hole, whatever the direction: m r̈ = −k r for the vector r. So x and y swing with
ω = √(k/m), each for itself: r = r0 cos ωt + v0/ω sin ωt, an ellipse about the hole with period 2π/ω. In polar form
r̈ − r θ̇² = −ω² r and r²θ̇ = h. Half the axes a ≥ b of the ellipse follow from a² + b² = r0² + (v0/ω)² and ab = |h|/ω.

Always: the plane carries mg; the equations in x, in y, and for the vector; r²θ̇ and m v² + k r² constant; closed paths.
Never: a path that does not close. r̈ + (k/m) r = 0 for the distance: on a straight path (h = 0, r0 along v0) only, up to the
hole. r constant, a circle: if r0 is across v0 and v0 = ω r0. θ̇ constant: there too, and θ̇ = 0 on a straight path between
two passages of the hole. A segment: if h = 0.
"""

import numpy as np

from freebody.catalogue import Answer, ask

M, K = 2.0, 8.0
W = np.sqrt(K / M)
R0 = np.array([0.5, 0.2])
STARTS = {"ellipse": (-0.3, 0.9), "straight": (-0.75, -0.3), "circle": (-0.4, 1.0)}
PERIOD = 2 * np.pi / W
TIMES = np.linspace(0, 0.9, 10) * PERIOD
SWING, CONSERVED = "closed form: two harmonic motions", "conservation"
DISTANCE, DIRECTION = "distance(ground.O, particle.P)", "direction(ground.O, particle.P)"


class Closed:
    """The motion from a start, by the docstring."""

    def __init__(self, name):
        self.v0 = np.array(STARTS[name])
        self.h = R0[0] * self.v0[1] - R0[1] * self.v0[0]
        plus, times = R0 @ R0 + self.v0 @ self.v0 / W**2, 2 * abs(self.h) / W
        big, small = np.sqrt(plus + times), np.sqrt(max(plus - times, 0.0))
        self.a, self.b = (big + small) / 2, (big - small) / 2

    def place(self, t):
        return np.outer(np.cos(W * t), R0) + np.outer(np.sin(W * t) / W, self.v0)

    def distance(self, t):
        return np.linalg.norm(self.place(t), axis=1)


def path(case, name, file="model.yaml"):
    """The run from a start."""
    vx, vy = STARTS[name]
    return case.run(file, {"vx": vx, "vy": vy})


@ask("In symbols: the equations in x and y")
def symbolically(case):
    yield from case.symbolically({"x": "-k*x/m", "y": "-k*y/m"}, "Newton's law")


@ask("Motion from three starts; the second goes through the hole")
def motion(case):
    for name in STARTS:
        run, closed, times = path(case, name), Closed(name), np.linspace(0.7, 10, 10)
        place = closed.place(times)
        yield Answer(f"x at 0.7 … 10 s, {name}", run.evaluate("x", times), "m", place[:, 0], SWING, 1e-11)
        yield Answer(f"y at 0.7 … 10 s, {name}", run.evaluate("y", times), "m", place[:, 1], SWING, 1e-11)
        pull = -run.evaluate("leash.value", times)
        yield Answer(f"tension at 0.7 … 10 s, {name}", pull, "N", K * closed.distance(times), SWING, 1e-11)
        greatest, least = (run.report[f"{which} r"].value for which in ("greatest", "least"))
        yield Answer(f"greatest r, {name}", greatest, "m", closed.a, "closed form: half the long axis", 1e-11)
        yield Answer(f"least r, {name}", least, "m", closed.b, "closed form: half the short axis", 1e-10, 1.0)


@ask("The equations in x and y, and of the vector: always")
def equations(case):
    for name in STARTS:
        run = path(case, name)
        for axis in "xy":
            value = run.evaluate(f"accel({axis}) + k/m*{axis}", TIMES)
            yield Answer(f"{axis}'' + (k/m) {axis}, {name}", value, "m/s²", 0 * TIMES, "Newton's law", 1e-13, W**2 * 0.5)


@ask("r'' + (k/m) r of the distance: only on a straight path")
def radial(case):
    for name in STARTS:
        run, closed = path(case, name), Closed(name)
        value = run.evaluate(f"accel({DISTANCE}) + k/m*{DISTANCE}", TIMES)
        check = closed.h**2 / closed.distance(TIMES) ** 3
        yield Answer(f"over a period, {name}", value, "m/s²", check, "closed form: r θ̇² = h²/r³", 1e-10, 1.0)


@ask("r constant, a circle: only if r is across v and v = ω r")
def circle(case):
    for name in STARTS:
        run, closed = path(case, name), Closed(name)
        spread = run.report["greatest r"].value - run.report["least r"].value
        yield Answer(f"greatest less least r, {name}", spread, "m", closed.a - closed.b, "closed form: axes", 1e-10, 1.0)


@ask("θ' constant: only on a circle, and (0) on a straight path")
def turning(case):
    for name in STARTS:
        run, closed = path(case, name), Closed(name)
        value = run.evaluate(f"rate({DIRECTION})", TIMES)
        yield Answer(f"θ', {name}", value, "rad/s", closed.h / closed.distance(TIMES) ** 2, "closed form: h/r²", 1e-10, 1.0)


@ask("r²θ' and m(x'² + y'²) + k r² constant: always")
def conserved(case):
    for name in STARTS:
        run, closed = path(case, name), Closed(name)
        spin = run.evaluate("angular_momentum(ground.O)/m", TIMES)
        yield Answer(f"r²θ', {name}", spin, "m²/s", closed.h + 0 * TIMES, CONSERVED, 1e-11, 1.0)
        twice = M * closed.v0 @ closed.v0 + K * R0 @ R0
        energy = run.evaluate("m*speed(particle.P)^2 + k*(x^2 + y^2)", TIMES)
        yield Answer(f"m(x'² + y'²) + k r², {name}", energy, "J", twice + 0 * TIMES, CONSERVED, 1e-11)


@ask("A segment: only with h = 0. A path that does not close: never")
def shapes(case):
    found = case.mechanism().find("angular_momentum(ground.O) @ 1", 0, vary="vx", within=(-5, 5))
    yield Answer("every start with h = 0, ẏ = 0.9 m/s", found.values, "m/s", R0[0] / R0[1] * 0.9, "closed form: v along r", 1e-8)
    for name in STARTS:
        run, closed = path(case, name), Closed(name)
        aside = np.array([-R0[1], R0[0]]) / np.hypot(*R0)
        value = run.evaluate(f"x*({aside[0]}) + y*({aside[1]})", PERIOD / 4)
        far = "closed form: h/(ω r0)"
        yield Answer(f"off the line of the start, greatest, {name}", value, "m", closed.h / W / np.hypot(*R0), far, 1e-11, 1.0)
        now = [run.evaluate(text, PERIOD) for text in ("x", "y", "rate(x)", "rate(y)")]
        yield Answer(f"state after 2π/ω, {name}", now, "", [*R0, *closed.v0], "closed form: the start", 1e-11)


@ask("The plane's force is mg: always")
def plane(case):
    """Across the plane nothing moves, and the string lies in it. Seen from the side of a straight path."""
    run = case.run("side.yaml")
    value = run.evaluate("plane.Fn", np.linspace(0, 3, 7))
    yield Answer("at 0 … 3 s, three times through the hole", value, "N", np.full(7, M * 9.81), "statics: M g", 1e-13)
    check = 0.5 * np.cos(W * 3.0) - 0.8 / W * np.sin(W * 3.0)
    yield Answer("x at 3 s", run.evaluate("x", 3.0), "m", check, SWING, 1e-11)


@ask("The string itself, over the edge of the hole to a spring below")
def string(case):
    """String and spring are one elastic string, without an end that would need a mass. The straight path leads through the hole."""
    for name in STARTS:
        run, closed, times = path(case, name, "string.yaml"), Closed(name), np.array([0.4, 1.0, 2.0, 3.0])
        value = [run.evaluate(axis, times) for axis in "xy"]
        yield Answer(f"x and y at 0.4 … 3 s, {name}", np.ravel(value), "m", np.ravel(closed.place(times).T), "closed form", 1e-9)
        pull = run.evaluate("leash.tension", times)
        yield Answer(f"tension at 0.4 … 3 s, {name}", pull, "N", K * closed.distance(times), "closed form", 1e-9)
