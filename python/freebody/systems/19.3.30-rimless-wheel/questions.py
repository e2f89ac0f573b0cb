"""19.3.30: rimless spoked wheel.

φ is the turn of the centre past the tip it stands on, clockwise from the vertical; half an opening α = π/k; a slope γ down to
+x. Between collisions φ goes from −(α − γ) to α + γ. Moments about the tip, J = I + mR²:  φ̈ = c sin φ, c = mgR/J.
(a) With U = 0 at the height of the centre when both tips are on the ground, T_n− = ½J(ω_n−)², and T + U is constant until then.
(b) Moments about the new tip, the impulse at the old one being none:  Jω+ = (I + mR² cos 2α)ω−, so ω+ = ηω−.
(c) Level: the centre comes down as far as it went up, ω− = ω+ of the collision before: ω_(n+1)+ = ηω_n+.
(d) Slope: between two collisions it comes down by d sin γ, d = 2R sin α:  (ω_(n+1)+)² = η²((ω_n+)² + 2(mg/J) d sin γ).
(e) So ω*² = η²·2(mg/J) d sin γ/(1 − η²) repeats itself, if it carries the centre over the top; others come nearer by η² a step.
(f) With k → ∞ a collision takes (2α)²mR²/J of the energy, a turn k times as much, 4π²mR²/kJ: nothing in the end. The floor
then does what it does to a round wheel: ω̇ = mgR sin γ/J. But ω* grows as √k: there is no steady speed.

The foot's force along the spoke and across it: m(g cos φ − Rφ̇²) and m(g sin φ − Rφ̈). A foot that can only push and never slides
comes to the moment where N is 0 and T is not. Without T the tip would be pressed into the floor, with it N would pull: no motion
is possible, and the run says so. A real foot slides before.
"""

from functools import cache, partial
from math import cos, pi, radians, sin, sqrt

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq, minimize_scalar

from freebody import MotionError
from freebody.catalogue import Answer, ask
from freebody.catalogue.answers import formula
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import Sym

M, I, R, G = 1.0, 0.5, 1.0, 9.81
J = I + M * R**2
C = M * G * R / J
MOMENTS = "closed form: moments about the new tip"
MAP = "closed form: return map"


class Steps:
    """Motion on one tip after another, for k spokes on a slope in degrees."""

    def __init__(self, k, slope=0.0, inertia=I):
        self.half, self.slope, J = pi / k, radians(slope), inertia + M * R**2
        self.start, self.end = self.slope - self.half, self.slope + self.half
        self.eta = (inertia + M * R**2 * cos(2 * self.half)) / J
        self.c = M * G * R / J
        self.gain = 4 * M * G * R * sin(self.half) * sin(self.slope) / J
        self.steady = sqrt(self.eta**2 * self.gain / (1 - self.eta**2))
        self.vault = sqrt(2 * self.c * (1 - cos(self.start))) if self.start < 0 else 0.0

    def rate(self, phi, w):
        """φ̇ where φ is, after a start with w."""
        return sqrt(w**2 + 2 * self.c * (cos(self.start) - cos(phi)))

    def time(self, w, end=None):
        """Until it is at ``end``, φ = start + s², which makes the integrand smooth also from rest."""
        last = sqrt((self.end if end is None else end) - self.start)
        return quad(lambda s: 2 * s / self.rate(self.start + s**2, w), 0, last, epsabs=0, epsrel=1e-13)[0]

    def angle(self, w, t):
        return brentq(lambda phi: self.time(w, phi) - t, self.start, self.end, xtol=1e-14) if t else self.start

    def after(self, w):
        """ω+ of the next collision."""
        return self.eta * sqrt(w**2 + self.gain)

    def force(self, phi, w):
        """N and T (along the floor, downhill)."""
        spin = self.rate(phi, w)
        along, across = M * (G * cos(phi) - R * spin**2), M * (G * sin(phi) - R * self.c * sin(phi))
        lean = phi - self.slope
        return along * cos(lean) + across * sin(lean), along * sin(lean) - across * cos(lean)

    def rocking(self, w):
        """Time until the wheel is back on the tip behind: up to −φt and down again, level floor. Where w cannot carry it over.

        φ = φt + δs², δ = α − φt, makes the integrand smooth; x = δ/2 solves 2 sin(α − x) sin x = w²/2c.
        """
        x = 0.0
        for _ in range(60):
            x += (w**2 / (2 * self.c) - 2 * sin(self.half - x) * sin(x)) / (2 * sin(self.half - 2 * x))

        def integrand(s):
            y = x * s**2
            return sqrt(4 * x / (self.c * sin(self.half - 2 * x + y) * (sin(y) / y if y else 1)))

        return 2 * quad(integrand, 0, 1, epsabs=0, epsrel=1e-13)[0]


def collisions(run):
    """Time, rates before and after of each."""
    return [c for c in run.changes if c.kind == "impact"]


def spin(c):
    return -c.after.u["wheel.angle"]


def steady(case, w, file="model.yaml", **parameters):
    """The motion that repeats itself from one tip to the next, found from near w."""
    section = "hit" if file == "hinged.yaml" else "foot"
    rolling = case.mechanism(file, **parameters).periodic({"omega": "-rate(wheel.angle)"}, section=section, horizon=3)
    return rolling.find({"omega": w})


@ask("What is the angular acceleration in a step, in symbols?")
def symbolically(case):
    closed = "m*g*R*sin(wheel.angle)/(I + m*R^2)"
    yield from case.symbolically({"wheel.angle": closed}, "closed form: an upside-down pendulum", "hinged.yaml")


@ask("(a), (b) What are T− before one collision and ω+ after it, and what energy is lost, k = 3, down 10°?")
def collision(case):
    for k in (3, 4, 6, 8, 16):
        steps = Steps(k, 10)
        w = max(1.2 * steps.vault, 1.0)
        run = case.run("hinged.yaml", {"k": k, "n": 1, "slope": "10 deg", "omega": w}, until=3.0)
        (hit,) = collisions(run)
        before = steps.rate(steps.end, w)
        of, scale = "" if k == 3 else f"k = {k}", before
        yield Answer(
            "T−", run.evaluate("kinetic()", hit.t - 1e-12), "J", J / 2 * before**2, "closed form: ½Jω²", 1e-10, variant=of
        )
        yield Answer("ω+", spin(hit), "rad/s", steps.eta * before, MOMENTS, 1e-11, scale, variant=of)
        yield Answer("energy lost", hit.lost, "J", J / 2 * (1 - steps.eta**2) * before**2, MOMENTS, 1e-11, variant=of)
        yield Answer("time", hit.t, "s", steps.time(w), "quadrature", 1e-10, variant=of)


@ask("(c) On a level floor, what is ω+ after one collision after another, from ω+ = 3 rad/s, k = 8?")
def level(case):
    run, steps = case.run(parameters={"k": 8, "slope": 0, "omega": 3.0}, until=4.0), Steps(8)
    check = [3 * steps.eta**n for n in range(1, 6)]
    yield Answer("ω+ of five collisions", [spin(c) for c in collisions(run)[:5]], "rad/s", check, MAP, 1e-10)
    times = np.cumsum([steps.time(w) for w in [3.0, *check[:4]]])
    yield Answer("their times", [c.t for c in collisions(run)[:5]], "s", times, "quadrature", 1e-9)


@ask("(c) How does it come to rest on a level floor, from ω+ = 2.5 rad/s, k = 4, rocking included?")
def rest(case):
    for k, start in ((4, 2.5), (4, 1.0), (8, 3.0), (8, 0.5)):
        run, steps = case.run(parameters={"k": k, "slope": 0, "omega": start}, until=12.0), Steps(k)
        w, t, forward, spins, tips = start, 0.0, 1, [], 0
        while w > 1e-13:
            over = w > steps.vault
            t += steps.time(w) if over else steps.rocking(w)
            forward = forward if over else -forward
            tips, w = tips + forward, w * steps.eta
            spins.append(forward * w)
        of = "" if start == 2.5 else f"k = {k}, ω+ = {start} rad/s"
        n = 8
        yield Answer(f"ω+ of {n} collisions", [spin(c) for c in collisions(run)[:n]], "rad/s", spins[:n], MAP, 1e-8, variant=of)
        yield Answer("at rest from", run.changes[-1].t, "s", t, "quadrature and geometric series", 1e-8, variant=of)
        energy = run.evaluate("kinetic()", 12.0)
        yield Answer("kinetic energy at 12 s", energy, "J", 0.0, "closed form: rest", 1e-20, J / 2 * start**2, variant=of)
        height = run.evaluate("y(wheel.origin)", 12.0)
        yield Answer(
            "height of the centre then, on two tips", height, "m", R * cos(pi / k), "closed form: R cos(π/k)", 1e-9, variant=of
        )
        yield Answer("way forward", run.evaluate("x(wheel.origin)", 12.0) - run.evaluate("x(wheel.origin)", 0.0),
                     "m", way(spins, steps), "closed form: 2R sin(π/k) a step", 1e-9, variant=of)  # fmt: skip


def way(spins, steps):
    """The centre is amid two tips at every collision: whole steps forward, and none by rocking."""
    return 2 * R * sin(steps.half) * sum(1 for w, old in zip(spins, [1.0, *spins], strict=False) if w > 0 and old > 0)


@ask("(d) And down a slope, 5° from ω+ = 1 rad/s?")
def slope(case):
    for degrees, start in ((5, 1.0), (10, 1.5), (10, 2.2)):
        steps, w, t, check = Steps(8, degrees), start, 0.0, []
        for _ in range(5):
            t, w = t + steps.time(w), steps.after(w)
            check.append((t, w))
        for file in ("model.yaml", "hinged.yaml"):
            run = case.run(file, {"slope": f"{degrees} deg", "omega": start}, until=t + 0.1)
            hits = collisions(run)[:5]
            told = ["" if degrees == 5 else f"{degrees}°, ω+ = {start} rad/s", "hinged" if file == "hinged.yaml" else ""]
            of = ", ".join(filter(None, told))
            yield Answer("ω+", [spin(c) for c in hits], "rad/s", [w for _, w in check], MAP, 1e-10, variant=of)
            yield Answer("times", [c.t for c in hits], "s", [t for t, _ in check], "quadrature", 1e-10, variant=of)


@ask("(c), (d) What is ω after the next collision, in letters, and which ω comes back?")
def in_letters(case):
    hinged = case.mechanism("hinged.yaml").periodic({"omega": "-rate(wheel.angle)"}, section="hit", horizon=3)
    found, against = hinged.symbolic(), "closed form: moments about the new tip, energy in between"
    eta = "(I + m*R^2*cos(2*pi/k))/(I + m*R^2)"
    feed = f"({eta})^2*4*m*g*R*sin(pi/k)*sin(slope)/(I + m*R^2)"
    yield formula("η = ω+/ω−", found.factor, eta, against)
    yield formula("(next ω+)² − η²(ω+)²", found.feed, feed, against)
    yield formula("(ω+)² that comes back", found.fixed, f"{feed}/(1 - ({eta})^2)", against)
    yield formula("its multiplier", found.multiplier, f"({eta})^2", against)


@ask("(e) Is ω_n+ = ω_(n+1)+ possible, and about how fast, k = 8 on 5°?")
def gait(case):
    for degrees in (5, 10):
        steps = Steps(8, degrees)
        of, parameters = "" if degrees == 5 else f"{degrees}°", {"slope": f"{degrees} deg"}
        found = steady(case, steps.vault + 0.8, **parameters)
        w, period = found.values["omega"], found.period
        run = case.run(parameters={**parameters, "omega": steps.vault * 1.001}, until=45.0)
        last = spin(collisions(run)[-1])
        yield Answer("ω+ that comes back", w, "rad/s", steps.steady, "closed form: fixed point", 1e-11, variant=of)
        yield Answer(
            f"ω+ of collision {len(collisions(run))} after the push", last, "rad/s", w, "the fixed point found", 1e-9, variant=of
        )
        yield Answer("time of a step", period, "s", steps.time(steps.steady), "quadrature", 1e-10, variant=of)
        yield Answer("multiplier", abs(found.multipliers), "", [steps.eta**2], "closed form: η²", 1e-10, variant=of)


@ask("(e) And at other slopes and numbers of spokes, the tips hinged?")
def gaits(case):
    """With this inertia three spokes have η = 0: they stop at every collision, and stand wherever α > γ; with more of it they go on."""
    slow = [(4, 30), (6, 10), (6, 20), (8, 3), (8, 20), (8, 30), (8, 40), (16, 2), (16, 5), (50, 1)]
    for k, degrees, inertia in [*((*each, I) for each in slow), (3, 78, I), (3, 50, 0.9), (3, 70, 0.9)]:
        steps, of = Steps(k, degrees, inertia), f"k = {k}, {degrees}°{', I = 0.9 kg m²' * (inertia > I)}"
        parameters = {"file": "hinged.yaml", "k": k, "n": 1, "slope": f"{degrees} deg", "I": inertia}
        found = steady(case, max(steps.vault, steps.steady) + 0.3, **parameters)
        value, against = found.values["omega"], "closed form: fixed point"
        yield Answer("ω+", value, "rad/s", steps.steady, against, 1e-11, 1.0, variant=of)
        multiplier, against = abs(found.multipliers), "closed form: η²"
        yield Answer("multiplier", multiplier, "", [steps.eta**2], against, 1e-10, 1.0, variant=of)
        yield Answer("time of a step", found.period, "s", steps.time(steps.steady), "quadrature", 1e-10, variant=of)


@cache
def least_slope(k):
    return brentq(lambda degrees: Steps(k, degrees).steady - Steps(k, degrees).vault, 0.1, 180 / k, xtol=1e-12)


@ask("(e) What is the least slope for a steady speed with any number of spokes, and what the steady speed a little above it?")
def any_number(case):
    """On the least slope a wheel that comes from rest over one tip comes to rest over the next. Three spokes with this inertia have
    η = 0: they stop at every collision, and where no tip holds them fall on from rest; nothing is left of a difference."""
    rest_over_the_next = "kinetic() - m*g*(y(ground.P[1]) + R - y(wheel.origin)) @ hit[1]"
    from_rest = {"pin[0].angle": 0, "rates": {"pin[0].angle": -1e-7}}
    for k in range(3, 17):
        of, bound = f"k = {k}", least_slope(k) if k > 3 else 60.0
        hinged = case.mechanism("hinged.yaml", k=k, n=1)
        within = ("50 deg", "70 deg") if k == 3 else ("0.1 deg", f"{180 / k} deg")
        found = hinged.find(rest_over_the_next, 0, vary="slope", within=within, points=4, initial=from_rest, until=20, rtol=1e-12)
        against = "closed form: ω* just carries the centre over the tip"
        tolerance = 1e-7 if k == 3 else 1e-9  # three spokes only touch it
        yield Answer("least slope", np.degrees(found.values), "°", bound, against, tolerance, variant=of)
        degrees = 1.3 * bound
        steps, parameters = Steps(k, degrees), {"k": k, "n": 1, "slope": f"{degrees!r} deg"}
        gait, of = steady(case, 1.02 * steps.steady, "hinged.yaml", **parameters), f"{of}, {degrees:.3f}°"
        against = "closed form: fixed point"
        yield Answer("ω+", gait.values["omega"], "rad/s", steps.steady, against, 1e-11, float(k == 3), variant=of)
        multiplier, against = abs(gait.multipliers), "closed form: η²"
        yield Answer("multiplier", multiplier, "", [steps.eta**2], against, 1e-10, 1.0, variant=of)
        yield Answer("time of a step", gait.period, "s", steps.time(steps.steady), "quadrature", 1e-10, variant=of)


@ask("(e) What becomes of every start, k = 8 on 10°, the tips hinged?")
def every_start(case):
    """Too slow for the top it falls back; every other comes nearer to the one speed that repeats itself, by η² a step."""
    for k, degrees in ((8, 10), (4, 30), (6, 10), (8, 5), (16, 2)):
        steps, of = Steps(k, degrees), "" if (k, degrees) == (8, 10) else f"k = {k}, {degrees}°"
        hinged = case.mechanism("hinged.yaml", k=k, n=1, slope=f"{degrees} deg")
        over = hinged.find("kinetic() - m*g*(R - y(wheel.origin)) @ start", 0, vary="omega", within=(0, 6)).values
        says, against = (
            "Slower than {} it falls back on the tip behind, and rocks to rest.",
            "closed form: energy of rest over the tip",
        )
        yield Answer("vaults", over, "rad/s", [steps.vault], against, 1e-10, says=says, variant=of)
        rolling = hinged.periodic({"omega": "-rate(wheel.angle)"}, section="hit", horizon=10)
        spins = [gait.values["omega"] for gait in rolling.find_all({"omega": (1.001 * over[0], 6)}, starts=8)]
        says, against = "Of all up to 6 rad/s only {} repeats itself.", "closed form: fixed point"
        yield Answer("steady", spins, "rad/s", [steps.steady], against, 1e-11, says=says, variant=of)
        starts = np.linspace(1.001 * over[0], 6, 12)
        slopes = [rolling.step({"omega": w}).slopes.item() for w in starts]
        check = [steps.eta**2 * w / steps.after(w) for w in starts]
        says, against = (
            "Everywhere a step makes a difference smaller, {} to {} of it stay: all come to it.",
            "closed form: derivative of the map",
        )
        ends = [min(slopes), max(slopes)]
        yield Answer("slope of the map", ends, "", [min(check), max(check)], against, 1e-9, says=says, variant=of)


@ask("(e) Which of these can a foot walk that can only push and never slides?")
def walks(case):
    """Those whose N stays above 0 until the next tip hits."""
    for k, degrees in ((4, 30), (6, 10), (6, 20), (8, 3), (8, 15), (8, 20), (16, 2), (16, 5)):
        steps = Steps(k, degrees)
        least = min(steps.force(phi, steps.steady)[0] for phi in np.linspace(steps.start, steps.end, 2001))
        mechanism = case.mechanism(k=k, slope=f"{degrees} deg")
        mechanism.parameters["omega"] = steps.steady
        run = mechanism.simulate(until=1.5 * steps.time(steps.steady), rtol=1e-12)
        hits = collisions(run)
        walked = bool(hits) and run.outcome.ok and abs(spin(hits[0]) - steps.steady) < 1e-9
        yield Answer("walks", walked, "", least > 0, "closed form: least N of a step", variant=f"k = {k}, {degrees}°")


@ask("(e) Does it go on for ever a little above the least slope, and not a little below?")
def least(case):
    """A little steeper, the wheel goes on for ever from the speed that repeats itself; a little flatter it stops."""
    for k in (6, 8, 16):
        for factor, goes in ((1.001, True), (0.999, False)):
            degrees = least_slope(k) * factor
            w = Steps(k, degrees).steady
            run = case.run(parameters={"k": k, "slope": f"{degrees} deg", "omega": w}, until=30.0)
            moving = bool(run.evaluate("kinetic()", 30.0) > 1e-9)
            of = f"k = {k}, {factor} of {least_slope(k):.6f}°"
            yield Answer("goes on", moving, "", goes, "closed form: ω* just carries the centre over the tip", variant=of)


@ask("What is the force of the ground in a step at steady speed on 5°, hinged or one-sided, and what friction does it need?")
def ground(case):
    for degrees in (5, 10):
        steps = Steps(8, degrees)
        w, a = steps.steady, steps.start
        parameters = {"slope": f"{degrees} deg", "omega": w}
        hinged, pushed = (case.run(file, parameters, until=0.2) for file in ("hinged.yaml", "model.yaml"))
        times, of = [0.0, 0.05, 0.1, 0.15, 0.2], "" if degrees == 5 else f"{degrees}°"
        angles = [steps.angle(w, t) for t in times]
        normal, along = zip(*(steps.force(phi, w) for phi in angles), strict=True)
        N = "'pin[0]'.Fx*sin(slope) + 'pin[0]'.Fy*cos(slope)"
        T = "'pin[0]'.Fx*cos(slope) - 'pin[0]'.Fy*sin(slope)"
        for name, one, other, check in (("N", N, "'foot[1]'.N", normal), ("T", T, "'foot[1]'.T", along)):
            yield Answer(
                f"{name} at five times, hinged",
                hinged.evaluate(one, times),
                "N",
                check,
                "closed form, time by quadrature",
                1e-9,
                variant=of,
            )
            yield Answer(
                f"{name} at five times, one-sided",
                pushed.evaluate(other, times),
                "N",
                check,
                "closed form, time by quadrature",
                1e-9,
                variant=of,
            )
        end = steps.time(w) - 1e-12
        whole = case.run(parameters=parameters, until=1.0)
        ratio = whole.evaluate("abs('foot[1]'.T)/'foot[1]'.N", np.linspace(0, end, 2001))

        def needed(phi, steps=steps, w=w):
            return -abs(steps.force(phi, w)[1]) / steps.force(phi, w)[0]

        check = max(
            -needed(a), -needed(steps.end), -minimize_scalar(needed, bounds=(0.3 * steps.end, steps.end), method="bounded").fun
        )
        yield Answer("friction ratio at most", ratio.max(), "", check, "closed form", 1e-6, variant=of)


@ask("What does the program say where staying and parting are both possible, k = 8, 30°, steady speed?")
def either(case):
    """Held, the floor pushes; let go, the tip rises: no law says which, and the program does not choose."""
    steps = Steps(8, 30)
    w, mechanism = steps.steady, case.mechanism(slope="30 deg")
    mechanism.parameters["omega"] = w
    try:
        named = mechanism.simulate(until=0.1).outcome.name
    except MotionError as error:
        named = error.kind
    rises = R * w**2 * cos(steps.half) > G * cos(steps.slope)
    both = rises and steps.force(steps.start, w)[0] > 0
    says = "The foot may stay or part: the run ends there and says that neither is decided."
    yield Answer("ends", named == "painleve_indeterminate", "", both, "closed form: both are motions", says=says)


def flown(steps, w, t):
    """Height of the next tip over the floor after a flight of t from just after a collision."""
    lean = steps.start
    x, y = R * sin(lean) + w * R * cos(lean) * t, R * cos(lean) - w * R * sin(lean) * t - G * t**2 / 2
    tip = lean + w * t - 2 * steps.half
    return (x - R * sin(tip)) * sin(steps.slope) + (y - R * cos(tip)) * cos(steps.slope)


@ask("Too fast for a foot that can only push, k = 8, 10°, ω+ = 3 rad/s: when does its normal force end, and what then?")
def lifting(case):
    """Without any force a tip is accelerated by Rφ̇² along its spoke and by g down.

    Where the first wins it flies; where g wins it can neither stay nor part. A hinged tip is pulled from then on.
    """
    for k, degrees, w in ((8, 10, 3.0), (8, 20, 2.5), (4, 10, 3.0)):
        steps = Steps(k, degrees)
        phi = brentq(lambda x, s=steps, w=w: s.force(x, w)[0], 0.0, steps.end, xtol=1e-15)
        t, of = steps.time(w, phi), "" if (k, degrees) == (8, 10) else f"k = {k}, {degrees}°, ω+ = {w} rad/s"
        parameters = {"k": k, "slope": f"{degrees} deg", "omega": w}
        outcome = case.mechanism(**parameters).simulate(until=2.0, rtol=1e-12).outcome
        jams = R * steps.rate(phi, w) ** 2 * cos(phi - steps.slope) < G * cos(steps.slope)
        against = "closed form: let go, the tip would press into the floor"
        stuck = outcome.name == "painleve_inconsistent"
        says = (
            "It can neither hold nor part: the run ends there and says so." if stuck else "It can part or hold: the run goes on."
        )
        yield Answer("ends", stuck, "", jams, against, scale=1.0, says=says, variant=of)
        says = "That is at {}."
        yield Answer("time", outcome.t, "s", t, "quadrature up to N = 0", 1e-9, says=says, variant=of)
        hinged = case.run("hinged.yaml", {**parameters, "n": 1}, until=t + 0.01)
        value = hinged.evaluate("'pin[0]'.Fx*sin(slope) + 'pin[0]'.Fy*cos(slope)", t)
        yield Answer("N of a hinged tip then", value, "N", 0.0, "closed form", 1e-9, M * G, variant=of)
    run, steps, w = case.run(parameters={"slope": "40 deg", "omega": 3.0}, until=0.5), Steps(8, 40), 3.0
    high = partial(flown, steps, w)
    check = brentq(high, 0.1, 0.4, xtol=1e-15)
    when, of, says = collisions(run)[0].t, "k = 8, 40°, ω+ = 3 rad/s", "It flies at once and lands on the next tip at {}."
    yield Answer("landing", when, "s", check, "closed form: free flight", 1e-9, says=says, variant=of)


@ask("(f) In what senses does it become an ordinary wheel as k grows?")
def many(case):
    level = case.mechanism("hinged.yaml", n=1, slope=0, omega=1)
    kept = "k^2*(1 - 2*kinetic()/((I + m*R^2)*omega^2)) @ hit[1]"
    found, says = (
        level.limit(kept, vary="k", begin=16).value,
        "On a level floor a turn takes {}/k of its energy, in the end nothing.",
    )
    yield Answer("loss", found, "", 4 * pi**2 * M * R**2 / J, "closed form: 4π²mR²/J, the first term in 1/k", 1e-8, says=says)
    sloping = case.mechanism("hinged.yaml", n=1, omega=1)
    found = sloping.limit("k*(omega(wheel)^2 - omega^2)/(4*pi) @ hit[1]", vary="k", begin=16).value
    says, against = "Down 5° it gains speed as a wheel with a rim, by {}.", "closed form: ω̇ = mgR sin γ/J"
    yield Answer("ω̇", found, "rad/s²", C * sin(radians(5)), against, 1e-7, says=says)
    rolling = case.mechanism("hinged.yaml").periodic({"omega": "-rate(wheel.angle)"}, section="hit", horizon=3).symbolic()
    k, numbers = 1e6, {"m": M, "I": I, "R": R, "g": G, "slope": radians(5)}
    value = float(evaluate(rolling.fixed, {Sym(name): x for name, x in {**numbers, "k": k}.items()})) / k
    says, against = "But its steady speed grows for ever: ω²/k tends to {}.", "closed form: g sin γ/πR, the first term in 1/k"
    yield Answer("ω²/k", value, "1/s²", G * sin(radians(5)) / (pi * R), against, 10 / k, says=says)


@ask("How does it come down 5° in a second from ω = 1 rad/s with many spokes, k = 16?")
def fast(case):
    for k in (16, 64, 256):
        of, steps, w, t = "" if k == 16 else f"k = {k}", Steps(k, 5), 1.0, 0.0
        while t + steps.time(w) < 1:
            t, w = t + steps.time(w), steps.after(w)
        last = collisions(case.run(parameters={"k": k, "omega": 1.0}, until=1.0))[-1]
        yield Answer("ω+ of the last collision", spin(last), "rad/s", w, MAP, 1e-9, variant=of)
        yield Answer("its time", last.t, "s", t, "quadrature", 1e-9, variant=of)


@ask("Does a foot with friction 0.9 slide before, 10°, ω+ = 3 rad/s?")
def slides(case):
    steps, w = Steps(8, 10), 3.0
    phi = brentq(lambda x: -steps.force(x, w)[1] - 0.9 * steps.force(x, w)[0], 0.0, steps.end, xtol=1e-15)
    run = case.run("slippery.yaml", {"omega": w}, until=steps.time(w, phi) + 0.01)
    slip = next(c for c in run.changes if c.kind == "slip")
    says = "It slides from {} on."
    yield Answer("slip", slip.t, "s", steps.time(w, phi), "quadrature up to −T = 0.9 N", 1e-9, says=says)
