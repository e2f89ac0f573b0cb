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
LINE, TAUT = "the string on a vertical line", "a string that is always taut"
MODELS = {"": "model.yaml", LINE: "straight.yaml"}


def swinging(t, y):
    """Rates of (λ, φ, λ̇, φ̇)."""
    length, tilt, speed, turning = y
    bend = (R * turning**2 - 2 * speed * turning - G * sin(tilt)) / length
    return [speed, turning, R * bend + (length * turning**2 + G * cos(tilt)) / 2, bend]


@ask("(a) How does it accelerate, in letters?")
def symbolically(case):
    closed = {"hoop.y": "-g/2", "hoop.x": "0", "hoop.angle": "-g/(2*R)"}
    against = "closed form: moments about the point where the string leaves"
    yield from case.symbolically(closed, against, at_rest=True, set={"tilt": 0})


@ask("(a) Where is G at time t?")
def height(case):
    for variant, file in MODELS.items():
        y = case.run(file).evaluate("y(hoop.centre)", TIMES)
        says = "At 0.2, 0.5 and 0.8 s: y_G = {}."
        yield Answer("y_G", y, "m", [-G * t**2 / 4 for t in TIMES], AGAINST, 1e-12, says=says, variant=variant)


@ask("(b) Does G move sideways?")
def sideways(case):
    against = "closed form: vertical forces"
    for variant, file in MODELS.items():
        x = case.run(file).evaluate("x(hoop.centre)", TIMES)
        says = "No: at 0.2, 0.5 and 0.8 s it is {} beside its line, although the string may swing."
        says = "It is {} beside its line." if variant else says
        yield Answer("x_G", x, "m", [0.0] * 3, against, 1e-12, R, says=says, variant=variant)
    push = case.run("straight.yaml").evaluate("string.Fn", TIMES)
    says = "The line pushes with {}: it is not needed."
    yield Answer("push", push, "N", [0.0] * 3, against, 1e-12, M * G, says=says, variant=LINE)


@ask("What does the string carry, and how fast does the hoop spin?")
def tension(case):
    for variant, file in MODELS.items():
        run = case.run(file)
        pull = "string.tension" if file == "model.yaml" else "-string.Fs"
        says = "The string carries {}."
        yield Answer("T", run.evaluate(pull, TIMES), "N", [M * G / 2] * 3, AGAINST, 1e-12, says=says, variant=variant)
        spin, check = -run.evaluate("omega(hoop)", TIMES), [G * t / (2 * R) for t in TIMES]
        says = "At 0.2, 0.5 and 0.8 s it spins clockwise at {}."
        yield Answer("ω", spin, "rad/s", check, AGAINST, 1e-12, says=says, variant=variant)


@ask("(b) How does it swing off plumb, in the tilt φ of the taut string and its free length l, in letters?")
def swing(case):
    closed = {
        "phi": "(R*rate(phi)^2 - 2*rate(l)*rate(phi) - g*sin(phi))/l",
        "string.tension": "m*(l*rate(phi)^2 + g*cos(phi))/2",
    }
    yield from case.symbolically(closed, "closed form: Lagrange's equations", "taut.yaml")


@ask("(b) What if the string is 0.1 rad off plumb at the start?")
def off_plumb(case):
    tilt = 0.1
    states = reference.motion(swinging, [FREE, tilt, 0, 0], TIMES)
    against = "other route: Lagrange's equations, integrated by SciPy"
    x0, y0 = R * cos(tilt) + FREE * sin(tilt), R * sin(tilt) - FREE * cos(tilt)
    x = [R * cos(p) + n * sin(p) - x0 for n, p, _, _ in states]
    y = [R * sin(p) - n * cos(p) - y0 for n, p, _, _ in states]
    pull = [M * (n * w**2 + G * cos(p)) / 2 for n, p, _, w in states]
    spin = [w - v / R for _, _, v, w in states]
    for variant, file in {"": "model.yaml", TAUT: "taut.yaml"}.items():
        run = case.run(file, parameters={"tilt": tilt})
        says = "It swings, and G with it: at 0.2, 0.5 and 0.8 s x_G = {}."
        yield Answer("x_G", run.evaluate("x(hoop.centre)", TIMES), "m", x, against, 1e-10, says=says, variant=variant)
        yield Answer("y_G", run.evaluate("y(hoop.centre)", TIMES), "m", y, against, 1e-10, variant=variant)
        yield Answer("ω", run.evaluate("omega(hoop)", TIMES), "rad/s", spin, against, 1e-10, variant=variant)
        yield Answer("T", run.evaluate("string.tension", TIMES), "N", pull, against, 1e-10, variant=variant)
    says, check = "The free part is then {} long, of which its coordinate tells.", [n for n, _, _, _ in states]
    yield Answer("l", run.evaluate("l", TIMES), "m", check, against, 1e-10, says=says, variant=TAUT)
    yield Answer("φ", run.evaluate("phi", TIMES), "rad", [p for _, p, _, _ in states], against, 1e-10, variant=TAUT)
