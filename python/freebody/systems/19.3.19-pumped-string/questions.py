"""19.3.19: pumping a whirling string.

Only the tension acts on the bob. Across the string: ℓθ̈ = ẍ_s sin θ; along it: T = m(ℓθ̇² − ẍ_s cos θ).
The hand, itself without mass, pushes with −T cos θ along x; its work is the bob's gain of energy.

With x_s = p sin θ + q cos θ, ẍ_s = (p cos θ − q sin θ)θ̈ − (p sin θ + q cos θ)θ̇², so d(ln θ̇)/dθ = f(θ) with
    f = −sin θ (p sin θ + q cos θ)/(ℓ − p sin θ cos θ + q sin²θ).
Spin and time after any angle are quadratures. Over one turn the sine gives ln θ̇ a gain of about −πp/ℓ, every turn;
p = −b speeds the mass up, p = +b slows it down. The cosine gives none: there θ̇ √(ℓ + q sin²θ) is constant.

A hand that sweeps, x_s = b cos ψ with ψ̈ = α, is followed where the mean of −(b/ℓ)ψ̇² cos ψ sin θ can reach α. With
θ = ψ + δ that mean is −(b/2ℓ)ψ̇² sin δ: the mass swings about a lag with sin δ = −2αℓ/bψ̇².

Hanging under gravity, θ from the downward vertical, from a hand at height y: ℓθ̈ = −(g + ÿ) sin θ. With y = b cos νt, ν = 2ω,
ω² = g/ℓ, a small swing obeys Mathieu's equation θ̈ = −ω²(1 − (4b/ℓ) cos 2ωt)θ; over a period of the hand it grows by the larger
multiplier of its two basic solutions. The swing θ = A cos ωt + B sin ωt has on average Ȧ = (bω/ℓ)B and Ḃ = (bω/ℓ)A,
up to b²: A + B grows at the rate bω/ℓ.

A string that only pulls goes slack where T = 0; the bob flies straight on until it is ℓ from the hand again, and there loses
its speed along the string relative to the hand, whatever the hand spends on that. All four laws of the angle keep it taut,
and so does a sweep that the bob follows.
"""

from functools import cache
from math import cos, exp, hypot, pi, sin, sqrt

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq, minimize_scalar

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import event, motion

L, M, W, B, G = 1.0, 1.0, 2 * pi, 0.1, 9.81
LAWS = {"": (-B, 0.0), "x_s = +b sin θ": (B, 0.0), "x_s = +b cos θ": (0.0, B), "x_s = −b cos θ": (0.0, -B)}
EQUATIONS = "other route: balances by hand, SciPy"


class Pumped:
    """The motion with x_s = p sin θ + q cos θ, by quadrature over the angle."""

    def __init__(self, p, q):
        self.p, self.q = p, q
        self.gain = self._log(2 * pi)
        self._log = cache(self._log)

    def growth(self, a):
        return -sin(a) * (self.p * sin(a) + self.q * cos(a)) / (L - self.p * sin(a) * cos(a) + self.q * sin(a) ** 2)

    def _log(self, a):
        return quad(self.growth, 0, a, epsabs=1e-14, epsrel=1e-13)[0]

    def spin(self, a):
        turns, rest = divmod(a, 2 * pi)
        return W * exp(turns * self.gain + self._log(rest))

    def time(self, turns):
        one = quad(lambda a: 1 / self.spin(a), 0, 2 * pi, epsabs=0, epsrel=1e-13)[0]
        return sum(one * exp(-n * self.gain) for n in range(turns))

    def energy(self, turns):
        """Where θ = 2πn the bob has θ̇(p, ℓ)."""
        return M / 2 * self.spin(2 * pi * turns) ** 2 * (self.p**2 + L**2)

    def tension(self, a):
        f = self.growth(a)
        push = (self.p * cos(a) - self.q * sin(a)) * f - (self.p * sin(a) + self.q * cos(a))
        return M * self.spin(a) ** 2 * (L - push * cos(a))

    def least_tension(self, turns):
        """It scales with θ̇² from turn to turn: it is in the first or the last turn."""
        first = 0.0 if self.gain >= 0 else 2 * pi * (turns - 1)
        angles = first + np.linspace(0, 2 * pi, 400)
        values = [self.tension(min(a, 2 * pi * turns)) for a in angles]
        i = int(np.argmin(values))
        near = (angles[max(i - 1, 0)], angles[min(i + 1, 399)])
        return min(min(values), minimize_scalar(self.tension, bounds=near, method="bounded", options={"xatol": 1e-9}).fun)


@ask("What does an acceleration of the hand do to the angle?")
def symbolically(case):
    yield from case.symbolically({"theta": "xsdd*sin(theta)/l"}, "closed form: balance across the string", "push.yaml")


@ask("How does the mass turn at one instant, how taut is the string, and how hard does the hand push?")
def instant(case):
    length, mass, theta, omega, push = 1.2, 0.5, 0.9, 2.5, 7.0
    now, T = case.instant("push.yaml"), mass * (length * omega**2 - push * cos(theta))
    against = "closed form: balance along and across the string"
    yield Answer("θ̈", now.accelerations["theta"], "rad/s²", push * sin(theta) / length, against, 1e-13)
    yield Answer("tension", now["string.tension"], "N", T, against, 1e-12)
    yield Answer("force of the hand along x", now["pump.force"], "N", -T * cos(theta), against, 1e-12)


@ask("Can the mass be sped up by moving the hand, and how? The hand follows the angle, x_s = −b sin θ")
def follows(case):
    for of, (p, q) in LAWS.items():
        run, exact = case.run(parameters={"bs": p, "bc": q}), Pumped(p, q)
        numbers, times = range(1, 6), [event.t for event in run.events]
        spins, check = [event.u["theta"] for event in run.events], [exact.spin(2 * pi * n) for n in numbers]
        does = "keeps its spin" if abs(spins[-1] - W) < 1e-6 else "is sped up" if spins[-1] > W else "is slowed down"
        says = f"The mass {does}: after each of five turns it turns at {{}}."
        yield Answer("spin after each turn", spins, "rad/s", check, "quadrature", 1e-9, says=says, variant=of)
        check = [exact.time(n) for n in numbers]
        yield Answer("times of these turns", times, "s", check, "quadrature", 1e-9, variant=of)
        energies = [exact.energy(n) for n in numbers]
        yield Answer("energy then", run.evaluate("kinetic()", times), "J", energies, "quadrature", 1e-9, variant=of)
        start, done = exact.energy(0), run.evaluate("pump.work", times)
        works = [energy - start for energy in energies]
        yield Answer("work of the hand by then", done, "J", works, "quadrature", 1e-8, start, variant=of)
        least, says = run.report["least tension"].value, "The string is always taut, with at least {}."
        says = says if least > 0 else "The string would have to push, with {}."
        yield Answer("least tension", least, "N", exact.least_tension(5), "quadrature", 1e-8, says=says, variant=of)


@ask("By what factor does the spin grow in a turn, from any spin, and by how much for a small stroke?")
def factor(case):
    """The return map from one turn to the next: it has one slope for every spin."""
    for of, (p, q) in LAWS.items():
        turning = case.mechanism(bs=p, bc=q).periodic({"omega0": "rate(theta)"}, section="turn")
        slopes = [turning.step({"omega0": spin}).slopes.item() for spin in (1.0, W)]
        says = "A turn multiplies the spin by {}, whether it is 1 rad/s or 2π rad/s." if not of else ""
        check = [exp(Pumped(p, q).gain)] * 2
        yield Answer("factor", slopes, "", check, "quadrature", 1e-9, says=says, variant=of)
    limit = case.mechanism().limit("ln(rate(theta)/omega0)/(5*bs) @ last", vary="bs", begin=-0.1, towards=0)
    says = "For a small stroke x_s = p sin θ the logarithm of the spin grows by {} × p in a turn: p < 0 speeds the mass up."
    yield Answer("growth", limit.value, "1/m", -pi / L, "closed form: −π/ℓ", 1e-7, says=says)


def swept(length, alpha, b=0.2):
    def rates(t, s):
        phase, speed = W * t + alpha * t**2 / 2, W + alpha * t
        return s[1], -b * (alpha * sin(phase) + speed**2 * cos(phase)) * sin(s[0]) / length

    return rates


@ask("Does the mass follow a hand that sweeps its frequency, x_s = b cos(2πt + αt²/2), α = 1 rad/s²?")
def sweeps(case):
    """It does where θ stays within half a turn of ψ.

    Where it falls behind, the string would have to push before long: from then on the run is that of a rod.
    """
    times = [1.25, 2.5, 3.75, 5.0]
    for alpha, start in [(1.0, -0.2560930469), *((a, 0.0) for a in (2.0, 3.0, 4.0, 6.0, 10.0, 20.0, 40.0, 60.0))]:
        run = case.run("chirp.yaml", parameters={"alpha": alpha, "theta0": start})
        phase = np.array([W * t + alpha * t**2 / 2 for t in times])
        lag = np.array(run.evaluate("theta", times)) - phase
        check = motion(swept(L, alpha), [start, W], times)[:, 0] - phase
        of = "" if alpha == 1 else f"α = {alpha:g}"
        follows, check_follows = (bool(np.abs(values).max() < pi) for values in (lag, check))
        says = "The mass follows." if follows else "The mass falls behind."
        yield Answer("follows", follows, "", check_follows, EQUATIONS, scale=1.0, says=says, variant=of)
        taut = bool(run.report["least tension"].value > 0)
        says = "The string is taut all the time." if taut else "The string would have to push."
        against = "closed form: T ≈ mψ̇²(ℓ + b cos²ψ) while it follows"
        yield Answer("taut", taut, "", check_follows, against, scale=1.0, says=says, variant=of)
        yield Answer("θ − ψ at 1.25, 2.5, 3.75, 5 s", lag, "rad", check, EQUATIONS, 1e-7, 1.0, variant=of)


@ask("How does it move at constant frequency, b cos 2πt, from a spin 5 % too low?")
def constant(case):
    times = [1.25, 2.5, 3.75, 5.0]
    run = case.run("chirp.yaml", parameters={"alpha": 0.0, "omega0": 0.95 * W})
    check = motion(swept(L, 0.0), [0.0, 0.95 * W], times)
    phase = np.array([W * t for t in times])
    lag = np.array(run.evaluate("theta", times)) - phase
    yield Answer("θ − 2πt at 1.25, 2.5, 3.75, 5 s", lag, "rad", check[:, 0] - phase, EQUATIONS, 1e-8, 1.0)
    yield Answer("θ̇ then", run.evaluate("rate(theta)", times), "rad/s", check[:, 1], EQUATIONS, 1e-9)
    tension = [M * (L * s[1] ** 2 + 0.2 * W**2 * cos(W * t) * cos(s[0])) for t, s in zip(times, check, strict=True)]
    yield Answer("tension then", run.evaluate("string.tension", times), "N", tension, EQUATIONS, 1e-8)


@ask("Hanging under gravity, the support moving by b cos(2√(g/ℓ) t), b = 0.05 m: how fast does a small swing grow?")
def grows(case):
    """The larger multiplier of the hanging string over a period of the hand, and of two swings of Mathieu's equation."""
    omega = sqrt(G / L)
    period = pi / omega
    for b in (0.05, 0.1):
        hanging = case.mechanism("shaken.yaml").periodic(period="2*pi/nu", theta=0, b=b).find()
        rate = float(np.log(np.abs(hanging.multipliers).max()) / hanging.period)
        check = [motion(mathieu(b), start, [period])[0] for start in ([1.0, 0.0], [0.0, 1.0])]
        mathieus, of = "other route: Mathieu's equation, SciPy", "" if b == 0.05 else f"b = {b:g} m"
        yield Answer("growth rate", rate, "1/s", growth_rate(check, period), mathieus, 1e-9, says="It grows at {}.", variant=of)
        against, says = "closed form: bω/ℓ for small b", "That is {} × b."
        yield Answer("growth rate/b", rate / b, "1/(m·s)", omega / L, against, b**2, says=says, variant=of)
        least, check = case.run("shaken.yaml", {"b": b}).report["least tension"].value, M * G * (1 - 4 * b / L)
        yield Answer("least tension", least, "N", check, "closed form: m(g − bν²), no swing", 1e-8, variant=of)


def mathieu(b):
    omega = sqrt(G / L)
    return lambda t, s: (s[1], -(G - 4 * omega**2 * b * cos(2 * omega * t)) / L * s[0])


def growth_rate(ends, period):
    return float(np.log(np.abs(np.linalg.eigvals(ends)).max()) / period)


@ask("And on a string that only pulls, the hand following the angle: is it taut throughout?")
def real(case):
    for of, (p, q) in LAWS.items():
        exact = Pumped(p, q)
        times = [exact.time(n) for n in range(1, 6)]
        run = case.run("string.yaml", {"bs": p, "bc": q}, until=times[-1] + 1e-3)
        turns = [event.t for event in run.events]
        least = run.report["least tension"].value
        slack = any(change.kind == "slack" for change in run.changes)
        says = "It goes slack: the tension comes down to {}." if slack else "It is never slack: the tension is at least {}."
        yield Answer("least tension", least, "N", exact.least_tension(5), "quadrature", 1e-8, says=says, variant=of)
        yield Answer("times of five turns", turns, "s", times, "quadrature", 1e-9, variant=of)
        spin = [run.evaluate("rate(direction(hand.origin, bob.centre))", t) for t in turns]
        check = [exact.spin(2 * pi * n) for n in range(1, 6)]
        yield Answer("spin then", spin, "rad/s", check, "quadrature", 1e-9, variant=of)
        tension = [exact.tension(2 * pi * n) for n in range(1, 6)]
        yield Answer("tension then", run.evaluate("leash.tension", turns), "N", tension, "quadrature", 1e-8, variant=of)


class Leash:
    """The bob on a string that only pulls, from a hand that sweeps: taut, or flying straight on."""

    def __init__(self, alpha, b=0.2):
        self.alpha, self.b = alpha, b
        self.rates = swept(L, alpha, b)

    def hand(self, t):
        """Place, velocity, acceleration."""
        phase, speed = W * t + self.alpha * t**2 / 2, W + self.alpha * t
        b = self.b
        return b * cos(phase), -b * speed * sin(phase), -b * (self.alpha * sin(phase) + speed**2 * cos(phase))

    def tension(self, t, y):
        return M * (L * y[1] ** 2 - self.hand(t)[2] * cos(y[0]))

    def switches(self, count):
        """Times of going slack, and of going taut with the tension just after it."""
        t, y, found = 0.0, [0.0, W], []
        while len(found) < count:
            base = t

            def rates(s, y, base=base):
                return self.rates(base + s, y)

            span, y = event(rates, y, lambda s, y, base=base: self.tension(base + s, y), before=5.0)
            t += span
            found.append((t, 0.0))
            t, y = self.fly(t, y)
            found.append((t, self.tension(t, y)))
            if self.tension(t, y) < 0:
                break
        return found

    def fly(self, t, y):
        """Until it is taut again: time, angle and spin just after."""
        x, v, _ = self.hand(t)
        place = np.array([x + L * cos(y[0]), L * sin(y[0])])
        speed = np.array([v - L * y[1] * sin(y[0]), L * y[1] * cos(y[0])])

        def stretch(s):
            px, py = place + s * speed
            return hypot(px - self.hand(t + s)[0], py) - L

        grid = np.linspace(1e-4, 1.0, 4000)
        late = next(i for i, s in enumerate(grid) if stretch(s) > 0)
        s = brentq(stretch, grid[late - 1], grid[late], xtol=1e-15)
        x, v, _ = self.hand(t + s)
        px, py = place + s * speed
        spin = ((px - x) * speed[1] - py * (speed[0] - v)) / L**2
        return t + s, [float(np.arctan2(py, px - x)), spin]


@ask("Does it stay taut where the hand sweeps its frequency, α = 1 rad/s²?")
def slackens(case):
    for alpha, start in [(1.0, -0.2560930469), *((a, 0.0) for a in (2.0, 3.0, 4.0, 6.0, 10.0))]:
        run, times = case.run("sweep.yaml", {"alpha": alpha, "theta0": start}), [1.25, 2.5, 3.75, 5.0]
        leash, check = Leash(alpha), motion(swept(L, alpha), [start, W], times)
        of = "" if alpha == 1 else f"α = {alpha:g}"
        rod = motion(swept(L, alpha), [start, W], np.linspace(0.01, 5, 500))
        least = min(leash.tension(t, y) for t, y in zip(np.linspace(0.01, 5, 500), rod, strict=True))
        slack = any(change.kind == "slack" for change in run.changes)
        says = "It goes slack." if slack else "It stays taut."
        yield Answer("slack", slack, "", bool(least < 0), EQUATIONS, scale=1.0, says=says, variant=of)
        tension = [leash.tension(t, y) for t, y in zip(times, check, strict=True)]
        found = run.evaluate("leash.tension", times)
        yield Answer("tension at 1.25, 2.5, 3.75, 5 s", found, "N", tension, EQUATIONS, 1e-7, variant=of)
    against = f"{EQUATIONS}, straight flights between"
    for alpha in (20.0, 40.0, 60.0):
        check = Leash(alpha).switches(4)
        run, of = case.run("sweep.yaml", {"alpha": alpha}, until=check[-1][0] + 0.01), f"α = {alpha:g}"
        found = [c.t for c in run.changes if c.kind in ("slack", "taut") and c.t > 0][: len(check)]
        says = "It goes slack, and taut again, in turn at {}."
        yield Answer("slack, taut, …", found, "s", [t for t, _ in check], against, 1e-8, says=says, variant=of)
        tension, told = [max(T, 0.0) for _, T in check], run.evaluate("leash.tension", found)
        yield Answer("tension just after", told, "N", tension, against, 1e-6, variant=of)
