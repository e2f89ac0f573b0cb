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
TOPS = {60: "", -30: "γ = −30°", 30: "γ = 30°", 0: "γ = 0°"}
AGAINST = "closed form: balance along and across the top"


def slide(gamma, a0=A0):
    return -G * sin(gamma) - a0 * cos(gamma - BETA)


def normal(gamma, a0=A0):
    return M * (G * cos(gamma) - a0 * sin(gamma - BETA))


@ask("(a) What is the force of the cart on the mass, in terms of g, d₀, v₀, t, a₀, m?")
def symbolically(case):
    closed = "m*(g*cos(gamma) - a0*sin(gamma - ramp))"
    yield from case.symbolically({"top.N": closed}, AGAINST)


@ask("(a) What is it in figures, and how does the mass slide?")
def force(case):
    for degrees, of in TOPS.items():
        gamma = degrees * pi / 180
        run, N = case.run(parameters={"gamma": gamma}), normal(gamma)
        says = "The cart pushes with {}," * (not of)
        yield Answer("N", run.evaluate("top.N", 0.0), "N", N, AGAINST, 1e-12, says=says, variant=of)
        components = [run.evaluate(f"top.{part}", t) for part in ("Fx", "Fy") for t in (0.0, 0.3)]
        check = [-N * sin(gamma)] * 2 + [N * cos(gamma)] * 2
        says = "at 0 and 0.3 s {} and {} along x, {} and {} along y." * (not of)
        yield Answer("Fx and Fy at 0 and 0.3 s", components, "N", check, AGAINST, 1e-12, says=says, variant=of)
        says = "Along the top the mass accelerates at {}." * (not of)
        yield Answer("s̈", run.evaluate("accel(s)", 0.0), "m/s²", slide(gamma), AGAINST, 1e-12, says=says, variant=of)


@ask("(a) What does the force depend on: on d₀, v₀, a₀?")
def depends(case):
    gamma = pi / 3
    for parameters in ({}, {"d0": 2.0}, {"v0": -4.0}, {"d0": 0.1, "v0": 3.0}, {"a0": 0.0}, {"a0": 6.0}, {"a0": 9.0}):
        value = case.instant(parameters=parameters)["top.N"]
        of = ", ".join(f"{name} = {given:g}" for name, given in parameters.items())
        says = "Not on d₀ and v₀: with those given it is {}." * (not of)
        check = normal(gamma, parameters.get("a0", A0))
        yield Answer("N", value, "N", check, "closed form: no d₀, v₀, t in it", 1e-12, says=says, variant=of)


@ask("(b) With which values does the mass accelerate exactly vertically: all a₀ from −50 to 50 m/s², whatever d₀, v₀, t?")
def vertical(case):
    """Where the top is left behind, or barely touched: on one side of a₀ = g cos γ/sin(γ − β), the mass falls freely."""
    for degrees, of in TOPS.items():
        gamma = degrees * pi / 180
        found = case.mechanism().find("ax(mass.centre) @ start", 0.0, vary="a0", within=(-50.0, 50.0), gamma=gamma)
        edge = G * cos(gamma) / sin(gamma - BETA) if degrees in (60, -30) else 0.0
        check = {60: [edge, 50.0], -30: [-50.0, edge], 0: [-50.0, 50.0]}.get(degrees, [])
        limits = [limit for interval in found.throughout for limit in interval]
        how = {60: "where it falls freely", -30: "where it falls freely", 0: "on a level top"}.get(degrees, "")
        says = f"With a₀ from {{}} to {{}}, {how}." if limits else "With none: the top pushes sideways with every a₀."
        values, of_none = (limits, check) if limits else (len(found.throughout), len(check))
        yield Answer(
            "a₀", values, "m/s²" * bool(limits), of_none, "closed form: N ≤ 0, or N vertical", 1e-8, 1.0, says=says, variant=of
        )
        says = "With no single value besides."
        yield Answer("single", len(found.values), "", 0, "closed form: N sin γ = 0", 0.0, 1.0, says=says, variant=of)


@ask("(b) From which a₀ on does it, in letters?")
def vertical_symbolically(case):
    """The horizontal acceleration as long as the top is touched is linear in a₀."""
    found = case.mechanism().solve_in_letters(["mass.x"])
    (slope,), rest = coefficients(found["mass.x"], [Sym("a0")])
    closed = "g*cos(gamma)/sin(gamma - ramp)"
    yield formula("a₀", presented(negative(quotient(rest, slope))), closed, "closed form: N = 0", found.letters)


@ask("Where is the mass at 0.3 s?")
def position(case):
    t = 0.3
    d, against = D0 + V0 * t + A0 * t**2 / 2, "closed form: constant accelerations"
    for degrees, of in TOPS.items():
        gamma = degrees * pi / 180
        s, run = slide(gamma) * t**2 / 2, case.run(parameters={"gamma": gamma})
        place = [run.evaluate(f"{axis}(mass.centre)", t) for axis in "xy"]
        check = [d * cos(BETA) + s * cos(gamma), d * sin(BETA) + s * sin(gamma)]
        says = "At x = {}, y = {}," * (not of)
        yield Answer("x, y", place, "m", check, against, 1e-11, says=says, variant=of)
        says = "{} above the top." * (not of)
        yield Answer("gap", run.evaluate("top.gap", t), "m", 0.0, "closed form: N > 0", 1e-13, d, says=says, variant=of)


@ask("What happens with γ = 60° and a₀ = 12 m/s²?")
def left_behind(case):
    gamma, a0, t = pi / 3, 12.0, 0.3
    run, against = case.run(parameters={"a0": a0}), "closed form: free fall from v₀ along the ramp"
    pushes, says = run.evaluate("top.N", [0.0, t]), "The mass is left behind: the cart pushes with {}."
    yield Answer("N", pushes, "N", [0.0] * 2, "it cannot pull", 0, M, says=says)
    place, along = [run.evaluate(f"{axis}(mass.centre)", t) for axis in "xy"], D0 + V0 * t
    check, says = [along * cos(BETA), along * sin(BETA) - G * t**2 / 2], "At 0.3 s it is at x = {}, y = {},"
    yield Answer("x, y", place, "m", check, against, 1e-11, says=says)
    above = (a0 * sin(gamma - BETA) - G * cos(gamma)) * t**2 / 2
    yield Answer("gap", run.evaluate("top.gap", t), "m", above, against, 1e-11, says="{} above the top,")
    back, check = run.evaluate("s", t), (-G * sin(gamma) - a0 * cos(gamma - BETA)) * t**2 / 2
    yield Answer("s", back, "m", check, against, 1e-11, says="{} along it.")
    limit = "just below the limit of 9.81: a₀ = 9.8 m/s²", "just above it: a₀ = 9.82 m/s²"
    touching = case.run(parameters={"a0": 9.8}).evaluate("top.gap", t)
    yield Answer("gap", touching, "m", 0.0, "closed form: N > 0", 1e-13, 1.0, variant=limit[0])
    check = (9.82 * sin(gamma - BETA) - G * cos(gamma)) * t**2 / 2
    parted = case.run(parameters={"a0": 9.82}).evaluate("top.gap", t)
    yield Answer("gap", parted, "m", check, against, 1e-9, variant=limit[1])
