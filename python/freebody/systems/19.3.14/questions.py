"""19.3.14: mass on a driven cart on a ramp, and when it lifts off.

The cart does not turn, so every point of it has the acceleration a₀ e, e along the ramp at β = 30°. The mass has
a₀ e + s̈ τ with τ = (cos γ, sin γ) along the top. Balance along τ and along the normal n = (−sin γ, cos γ):
    s̈ = −g sin γ − a₀ cos(γ − β),   N = m (g cos γ − a₀ sin(γ − β)),
whatever d₀, v₀ and t. The force on the mass is N n. Its acceleration is vertical exactly when N sin γ = 0: for any a₀ on
a level top, else only where N = 0, a₀ = g cos γ/sin(γ − β): the mass then falls freely, barely touching. For γ = β no a₀ will do.
The cart pushes and cannot pull: beyond that a₀ the mass is left behind at once and falls freely, from the velocity v₀ e, while the
top runs away below it: with N = 0 its height over the top grows as (a₀ sin(γ − β) − g cos γ) t²/2.
"""

from math import cos, pi, sin

from freebody.catalogue import Answer, ask
from freebody.catalogue.answers import formula
from freebody.equations.solve import coefficients
from freebody.symbolic.algebra import quotient
from freebody.symbolic.presentation import presented
from freebody.symbolic.tree import Sym, negative

M, D0, V0, A0, G, BETA = 2.0, 0.5, 1.0, 3.0, 9.81, pi / 6
TOPS = (60, -30, 30, 0)
AGAINST = "closed form: balance along and across the top"


def slide(gamma, a0=A0):
    return -G * sin(gamma) - a0 * cos(gamma - BETA)


def normal(gamma, a0=A0):
    return M * (G * cos(gamma) - a0 * sin(gamma - BETA))


@ask("(a) In symbols: the force does not depend on d₀, v₀, t")
def symbolically(case):
    closed = "m*(g*cos(gamma) - a0*sin(gamma - ramp))"
    yield from case.symbolically({"top.N": closed}, AGAINST)


@ask("(a) Force of the cart on the mass, and how the mass slides")
def force(case):
    for degrees in TOPS:
        gamma, of = degrees * pi / 180, f"γ = {degrees}°"
        run = case.run(parameters={"gamma": gamma})
        N = normal(gamma)
        for t in (0.0, 0.3):
            components = [run.evaluate(f"top.{part}", t) for part in ("Fx", "Fy")]
            yield Answer(f"Fx, Fy at {t:g} s, {of}", components, "N", [-N * sin(gamma), N * cos(gamma)], AGAINST, 1e-12)
        yield Answer(f"normal force, {of}", run.evaluate("top.N", 0.0), "N", N, AGAINST, 1e-12)
        yield Answer(
            f"sliding acceleration along the top, {of}", run.evaluate("accel(s)", 0.0), "m/s²", slide(gamma), AGAINST, 1e-12
        )


@ask("(a) What the force depends on")
def depends(case):
    gamma = pi / 3
    for parameters in ({"d0": 2.0}, {"v0": -4.0}, {"d0": 0.1, "v0": 3.0}):
        value = case.instant(parameters=parameters)["top.N"]
        of = ", ".join(f"{name} = {given:g}" for name, given in parameters.items())
        yield Answer(f"normal force with {of}", value, "N", normal(gamma), "closed form: no d₀, v₀, t in it", 1e-12)
    for a0 in (0.0, 6.0, 9.0):
        value = case.instant(parameters={"a0": a0})["top.N"]
        yield Answer(f"normal force with a0 = {a0:g}", value, "N", normal(gamma, a0), AGAINST, 1e-12)


@ask("(b) When the mass accelerates exactly vertically: all a₀ from −50 to 50 m/s², whatever d₀, v₀, t")
def vertical(case):
    """Where the top is left behind, or barely touched: on one side of a₀ = g cos γ/sin(γ − β), the mass falls freely."""
    for degrees in TOPS:
        gamma, of = degrees * pi / 180, f"γ = {degrees}°"
        found = case.mechanism().find("ax(mass.centre) @ start", 0.0, vary="a0", within=(-50.0, 50.0), gamma=gamma)
        yield Answer(f"single values, {of}", len(found.values), "", 0, "closed form: N sin γ = 0", 1e-15, said=found.sentence)
        edge = G * cos(gamma) / sin(gamma - BETA) if degrees in (60, -30) else 0.0
        check = {60: [edge, 50.0], -30: [-50.0, edge], 0: [-50.0, 50.0]}.get(degrees)
        if check is None:
            yield Answer(f"intervals, {of}", len(found.throughout), "", 0, "closed form: N = mg cos γ for every a₀", 1e-15)
        else:
            ((low, high),) = found.throughout
            yield Answer(f"from … to, {of}", [low, high], "m/s²", check, "closed form: N ≤ 0, or N vertical", 1e-8)


@ask("(b) The a₀ in symbols, from where on it does")
def vertical_symbolically(case):
    """The horizontal acceleration as long as the top is touched is linear in a₀."""
    found = case.mechanism().solve_in_letters(["mass.x"])
    (slope,), rest = coefficients(found["mass.x"], [Sym("a0")])
    closed = "g*cos(gamma)/sin(gamma - ramp)"
    yield formula("a₀", presented(negative(quotient(rest, slope))), closed, "closed form: N = 0", found.letters)


@ask("Position at 0.3 s")
def position(case):
    t = 0.3
    d = D0 + V0 * t + A0 * t**2 / 2
    for degrees in TOPS:
        gamma = degrees * pi / 180
        s = slide(gamma) * t**2 / 2
        run = case.run(parameters={"gamma": gamma})
        place = [run.evaluate(f"{axis}(mass.centre)", t) for axis in "xy"]
        check = [d * cos(BETA) + s * cos(gamma), d * sin(BETA) + s * sin(gamma)]
        yield Answer(f"x, y, γ = {degrees}°", place, "m", check, "closed form: constant accelerations", 1e-11)
        gap = run.evaluate("top.gap", t)
        yield Answer(f"gap to the top, γ = {degrees}°", gap, "m", 0.0, "closed form: N > 0", 1e-13, d)


@ask("The run with γ = 60°, a₀ = 12: the mass is left behind")
def left_behind(case):
    gamma, a0, t = pi / 3, 12.0, 0.3
    run = case.run(parameters={"a0": a0})
    against = "closed form: free fall from v₀ along the ramp"
    yield Answer(
        "force of the cart on the mass at 0, 0.3 s", run.evaluate("top.N", [0.0, t]), "N", [0.0] * 2, "it cannot pull", 0, M
    )
    place = [run.evaluate(f"{axis}(mass.centre)", t) for axis in "xy"]
    along = D0 + V0 * t
    check = [along * cos(BETA), along * sin(BETA) - G * t**2 / 2]
    yield Answer("x, y at 0.3 s", place, "m", check, against, 1e-11)
    above = (a0 * sin(gamma - BETA) - G * cos(gamma)) * t**2 / 2
    yield Answer("gap to the top at 0.3 s", run.evaluate("top.gap", t), "m", above, against, 1e-11)
    back = run.evaluate("s", t)
    check = (-G * sin(gamma) - a0 * cos(gamma - BETA)) * t**2 / 2
    yield Answer("where it is along the top", back, "m", check, against, 1e-11)
    touching = case.run(parameters={"a0": 9.8}).evaluate("top.gap", t)
    yield Answer("gap for a₀ = 9.8, just below the limit of 9.81", touching, "m", 0.0, "closed form: N > 0", 1e-13, 1.0)
    check = (9.82 * sin(gamma - BETA) - G * cos(gamma)) * t**2 / 2
    parted = case.run(parameters={"a0": 9.82}).evaluate("top.gap", t)
    yield Answer("gap for a₀ = 9.82, just above it", parted, "m", check, against, 1e-9)
