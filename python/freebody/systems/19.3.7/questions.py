"""19.3.7: falling hoop, a string wound on it.

All forces on the hoop are vertical while the string is: mg and the tension T, at R from G. With I = mR² and ω = v/R,
    mg − T = m v̇,   T R = mR² v̇/R   ⟹   v̇ = g/2,   T = mg/2,   y_G = −gt²/4, straight down.
This needs no guide: with vertical forces G does not move sideways, and while G does not, a string that hangs straight does so on.
A string that starts off plumb swings. With its free length λ, its tilt φ from straight up, counter-clockwise, and
e = (−cos φ, −sin φ) from G to where it leaves, τ = (−sin φ, cos φ) along it: G = C − R e − λ τ, C on the ceiling. No slip is
ω = φ̇ − λ̇/R, so that ½mv² + ½mR²ω² = m(Rφ̇ − λ̇)² + ½mλ²φ̇², and Lagrange's equations are
    λφ̈ = Rφ̇² − 2λ̇φ̇ − g sin φ,   λ̈ = Rφ̈ + (λφ̇² + g cos φ)/2,   T = m(λφ̇² + g cos φ)/2.
"""

from math import cos, sin

from freebody.catalogue import Answer, ask, reference

M, R, G, FREE = 1.5, 0.35, 9.81, 1.0
AGAINST = "closed form: mg − T = mv̇, T = mv̇"
TIMES = [0.2, 0.5, 0.8]
MODELS = {"free to swing": "model.yaml", "on a vertical line": "straight.yaml"}


def swinging(t, y):
    """Rates of (λ, φ, λ̇, φ̇)."""
    length, tilt, speed, turning = y
    bend = (R * turning**2 - 2 * speed * turning - G * sin(tilt)) / length
    return [speed, turning, R * bend + (length * turning**2 + G * cos(tilt)) / 2, bend]


@ask("(a) In symbols, just after release")
def symbolically(case):
    closed = {"hoop.y": "-g/2", "hoop.x": "0", "hoop.angle": "-g/(2*R)"}
    yield from case.symbolically(
        closed, "closed form: moments about the point where the string leaves", at_rest=True, set={"tilt": 0}
    )


@ask("(a) y_G at time t")
def height(case):
    for of, file in MODELS.items():
        y = case.run(file).evaluate("y(hoop.centre)", TIMES)
        yield Answer(f"at 0.2, 0.5, 0.8 s, string {of}", y, "m", [-G * t**2 / 4 for t in TIMES], AGAINST, 1e-12)


@ask("(b) Whether G moves sideways")
def sideways(case):
    for of, file in MODELS.items():
        x = case.run(file).evaluate("x(hoop.centre)", TIMES)
        yield Answer(f"x_G at 0.2, 0.5, 0.8 s, string {of}", x, "m", [0.0] * 3, "closed form: vertical forces", 1e-12, R)
    push = case.run("straight.yaml").evaluate("string.Fn", TIMES)
    yield Answer("push of the line on the hoop, not needed", push, "N", [0.0] * 3, "closed form: vertical forces", 1e-12, M * G)


@ask("Tension and spin")
def tension(case):
    for of, file in MODELS.items():
        run = case.run(file)
        pull = "string.tension" if file == "model.yaml" else "-string.Fs"
        yield Answer(f"tension, string {of}", run.evaluate(pull, TIMES), "N", [M * G / 2] * 3, AGAINST, 1e-12)
        spin = -run.evaluate("omega(hoop)", TIMES)
        yield Answer(f"spin, clockwise, string {of}", spin, "rad/s", [G * t / (2 * R) for t in TIMES], AGAINST, 1e-12)


@ask("(b) The string 0.1 rad off plumb at the start: it swings, and G with it")
def off_plumb(case):
    tilt = 0.1
    run = case.run(parameters={"tilt": tilt})
    states = reference.motion(swinging, [FREE, tilt, 0, 0], TIMES)
    against = "other route: Lagrange's equations, integrated by SciPy"
    x0, y0 = R * cos(tilt) + FREE * sin(tilt), R * sin(tilt) - FREE * cos(tilt)
    x = [R * cos(p) + n * sin(p) - x0 for n, p, _, _ in states]
    y = [R * sin(p) - n * cos(p) - y0 for n, p, _, _ in states]
    pull = [M * (n * w**2 + G * cos(p)) / 2 for n, p, _, w in states]
    spin = [w - v / R for _, _, v, w in states]
    yield Answer("x_G at 0.2, 0.5, 0.8 s", run.evaluate("x(hoop.centre)", TIMES), "m", x, against, 1e-10)
    yield Answer("y_G", run.evaluate("y(hoop.centre)", TIMES), "m", y, against, 1e-10)
    yield Answer("spin", run.evaluate("omega(hoop)", TIMES), "rad/s", spin, against, 1e-10)
    yield Answer("tension", run.evaluate("string.tension", TIMES), "N", pull, against, 1e-10)
