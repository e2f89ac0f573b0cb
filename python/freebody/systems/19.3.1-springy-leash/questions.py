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
from freebody.check.api import Checker

M, K = 2.0, 8.0
W = np.sqrt(K / M)
R0 = np.array([0.5, 0.2])
STARTS = {"ellipse": (-0.3, 0.9), "straight": (-0.75, -0.3), "circle": (-0.4, 1.0)}
PATHS = {"ellipse": "", "straight": "a straight path through the hole", "circle": "a circle"}
PERIOD = 2 * np.pi / W
TIMES = np.linspace(0, 0.9, 10) * PERIOD
SWING = "closed form: two harmonic motions"
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

    def at(self, t):
        """Itself with places, velocities, accelerations (2, n) and distances at the times."""
        self.places, self.r = self.place(t).T, self.distance(t)
        self.velocities = (np.outer(np.cos(W * t), self.v0) - np.outer(W * np.sin(W * t), R0)).T
        self.accelerations = -(W**2) * self.places
        return self


def path(case, name, file="model.yaml"):
    """The run from a start."""
    vx, vy = STARTS[name]
    return case.run(file, {"vx": vx, "vy": vy})


@ask("What are the equations of motion?")
def symbolically(case):
    yield from case.symbolically({"x": "-k*x/m", "y": "-k*y/m"}, "Newton's law")


@ask("How does it move, what does the string carry, and how far and near does it come?")
def motion(case):
    for name, variant in PATHS.items():
        run, closed, times = path(case, name), Closed(name), np.linspace(0.7, 10, 10)
        greatest, least = (run.report[f"{which} r"].value for which in ("greatest", "least"))
        axes = "closed form: half the axes"
        yield Answer("greatest r", greatest, "m", closed.a, axes, 1e-11, variant=variant)
        yield Answer("least r", least, "m", closed.b, axes, 1e-10, 1.0, variant=variant)
        place = closed.place(times)
        yield Answer("x at 0.7 … 10 s", run.evaluate("x", times), "m", place[:, 0], SWING, 1e-11, variant=variant)
        yield Answer("y at 0.7 … 10 s", run.evaluate("y", times), "m", place[:, 1], SWING, 1e-11, variant=variant)
        pull = -run.evaluate("leash.value", times)
        yield Answer("tension at 0.7 … 10 s", pull, "N", K * closed.distance(times), SWING, 1e-11, variant=variant)


STATED = {
    "ẍ + (k/m) x = 0": lambda s: s.accelerations[0] + W**2 * s.places[0],
    "ÿ + (k/m) y = 0": lambda s: s.accelerations[1] + W**2 * s.places[1],
    "a_P + (k/m) r_P = 0": lambda s: (s.accelerations + W**2 * s.places)[0],
    "r̈ + (k/m) r = 0": lambda s: s.h**2 / s.r**3,
    "constant: r": lambda s: s.r,
    "constant: θ̇": lambda s: s.h / s.r**2,
    "constant: r^2 θ̇": lambda s: np.cross(s.places.T, s.velocities.T),
    "constant: m (ẋ^2 + ẏ^2) + k r^2": lambda s: M * np.sum(s.velocities**2, axis=0) + K * s.r**2,
    "constant: y/x": lambda s: s.places[1] / s.places[0],
}
"""What is stated, each with its left side, or what is to be constant, on the closed form."""
LETTERS = {
    "r": DISTANCE,
    "θ": DIRECTION,
    "ω": "sqrt(k/m)",
    "a_P": "acceleration of particle.P",
    "r_P": "position of particle.P",
}
STARTS_IN_LETTERS = {"on a straight path": ("straight", "x ẏ = y ẋ"), "on a circle": ("circle", "ẋ = −ω y, ẏ = ω x")}


@ask("When is each statement true: always, never, or on which paths?")
def stated(case):
    """By ``check`` on random motions: of any start, and under the conditions for a straight path (r0 along v0) and for a circle (r0 across
    v0 = ω r0). Beside it, on the closed form of three starts: is the left side 0, or the quantity constant?"""
    checker = Checker(case.mechanism(), LETTERS)
    for says, of in STATED.items():
        found = [checker.check(says, correcting=False).ok]
        found += [checker.check(f"if {premise}: {says}", correcting=False).ok for _, premise in STARTS_IN_LETTERS.values()]
        where = [name for name, true in zip(STARTS_IN_LETTERS, found[1:], strict=True) if true]
        when = "always" if found[0] else f"only {' and '.join(where)}" if where else "never"
        check = []
        for start in ("ellipse", *(name for name, _ in STARTS_IN_LETTERS.values())):
            value = of(Closed(start).at(TIMES))
            check.append((np.ptp(value) if says.startswith("constant") else np.abs(value).max()) < 1e-12)
        label = f"{says.removeprefix('constant: ')} = constant" if says.startswith("constant") else says
        against = "closed form at ten times of three starts"
        yield Answer(label, found, check=check, against=against, scale=1.0, says=f"{label}: {when}.")


@ask("Which run shows it, and which breaks it: an ellipse, a straight path, a circle?")
def shown(case):
    """The greatest left side, or the range of what is to be constant, on an ellipse, a straight path and a circle."""
    texts = {
        "ẍ + (k/m) x": ("accel(x) + k/m*x", "m/s²"),
        "r̈ + (k/m) r": (f"accel({DISTANCE}) + k/m*{DISTANCE}", "m/s²"),
        "range of r": (DISTANCE, "m"),
        "range of θ̇": (f"rate({DIRECTION})", "rad/s"),
        "range of r²θ̇": ("angular_momentum(ground.O)/m", "m²/s"),
        "range of m(ẋ² + ẏ²) + k r²": ("m*speed(particle.P)^2 + k*(x^2 + y^2)", "J"),
        "range of y/x": ("y/x", ""),
    }
    closed = dict(zip(texts, [of for says, of in STATED.items() if says[0] not in "ÿa"], strict=True))
    for label, (text, unit) in texts.items():
        size = np.ptp if label.startswith("range") else lambda value: np.abs(value).max()
        value = [size(path(case, name).evaluate(text, TIMES)) for name in STARTS]
        check = [size(closed[label](Closed(name).at(TIMES))) for name in STARTS]
        yield Answer(
            f"greatest {label}" if " " in label and "range" not in label else label, value, unit, check, SWING, 1e-9, 1.0
        )


@ask("Is there a path that does not close, and what is the period?")
def period(case):
    """The derivative of the return map by the start: all starts come back after 2π √(m/k), and are opposite after half of that."""
    where = {
        "2*pi*sqrt(m/k)": (1.0, "No: after 2π √(m/k) the state is that of the start, by the unit matrix, whatever the start."),
        "pi*sqrt(m/k)": (-1.0, "Not earlier: after half of that all of it has changed its sign."),
    }
    for after, (sign, says) in where.items():
        back = case.mechanism().periodic(period=after).step()
        yield Answer(f"after {after}", np.ravel(back.slopes), "", np.ravel(sign * np.eye(4)), SWING, 1e-11, says=says)


@ask("With ẏ = 0.9 m/s at the start, from which ẋ is the path a segment?")
def segment(case):
    found = case.mechanism().find("angular_momentum(ground.O) @ 1", 0, vary="vx", within=(-5, 5))
    yield Answer("ẋ", found.values, "m/s", R0[0] / R0[1] * 0.9, "closed form: v along r", 1e-8, says="Only from {}.")


@ask("Is the force of the plane mg?")
def plane(case):
    """Across the plane nothing moves, and the string lies in it. Seen from the side of a straight path."""
    run = case.run("side.yaml")
    value = run.evaluate("plane.Fn", np.linspace(0, 3, 7))
    says = "Always: at 0 … 3 s, three times through the hole, it is {}."
    yield Answer("N", value, "N", np.full(7, M * 9.81), "statics: M g", 1e-13, says=says)
    check = 0.5 * np.cos(W * 3.0) - 0.8 / W * np.sin(W * 3.0)
    yield Answer("x at 3 s on this path", run.evaluate("x", 3.0), "m", check, SWING, 1e-11)


@ask("And with the string itself, through the hole to a spring below?")
def string(case):
    """The straight path leads through the hole."""
    for name, variant in PATHS.items():
        run, closed, times = path(case, name, "string.yaml"), Closed(name), np.array([0.4, 1.0, 2.0, 3.0])
        value = [run.evaluate(axis, times) for axis in "xy"]
        yield Answer(
            "x, then y, at 0.4, 1, 2, 3 s", np.ravel(value), "m", np.ravel(closed.place(times).T), SWING, 1e-9, variant=variant
        )
        pull = run.evaluate("leash.tension", times)
        yield Answer("tension", pull, "N", K * closed.distance(times), SWING, 1e-9, variant=variant)
