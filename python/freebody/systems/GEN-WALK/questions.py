"""GEN-WALK: passive walker on a slope.

θ of the stance leg and ψ = θ − φ of the swing leg, both from the normal of the slope; each leg has a mass m at a from its foot and
b = ℓ − a from the hip, the hip M. The simplest walker has its masses in the feet: a = 0, m = βM. Lagrange:
    (Mℓ² + ma² + mℓ²) θ̈ − mℓb (cos(θ−ψ) ψ̈ + sin(θ−ψ) ψ̇²) = (Mℓ + ma + mℓ) g sin(θ−γ),
    bψ̈ − ℓ cos(θ−ψ) θ̈ + ℓ sin(θ−ψ) θ̇² = −g sin(ψ−γ).
Heel strike at ψ = −θ: moments of momentum of all about the new foot, and of the old stance leg about the hip, before = after:
    (Mℓ² + 2maℓ) cos 2θ θ̇ − mab (θ̇ + ψ̇) = (Mℓ² + ma² + mℓ² − mℓb cos 2θ) Θ̇ + mb (b − ℓ cos 2θ) Ψ̇,   bΨ̇ = ℓ cos 2θ Θ̇ − aθ̇;
then the legs change their parts. In the limit β → 0: Garcia, Chatterjee, Ruina & Coleman (1998), *J. Biomech. Eng.* 120, 281. The
compass gait: Goswami, Thuilot & Espiau (1998), *Int. J. Robotics Research* 17, 1282.
"""

from math import cos, radians, sin

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve

from freebody.catalogue import Answer, ask

RETURNS = {"theta0": "theta - phi", "w": "rate(theta) - rate(phi)", "v": "-rate(phi)"}
BY_HAND = "other route: Lagrange and moments of momentum by hand, SciPy"
NEAR = {"long": (0.970956, -0.270837, -0.9976), "short": (0.943976, -0.264561, -1.0512)}
"""Of the two gaits: θ ≈ a γ^⅓ + b γ (Garcia et al.), and θ̇ over θ."""


def walker(case):
    return case.mechanism().periodic(RETURNS, section="strike", horizon=6)


def rough(gait, gamma):
    """A start near a gait."""
    a, b, ratio = NEAR[gait]
    theta = a * gamma ** (1 / 3) + b * gamma
    return {"theta0": theta, "w": ratio * theta, "v": ratio * theta * (1 - cos(2 * theta))}


class ByHand:
    """The map of the equations above for (θ, θ̇, φ̇) just after a heel strike."""

    def __init__(self, gamma, m, M=1.0, a=0.0, g=1.0):
        self.gamma, self.m, self.M, self.a, self.b, self.g = gamma, m, M, a, 1 - a, g

    def rates(self, t, y):
        theta, psi, w, u = y
        m, M, a, b, g, c, s = self.m, self.M, self.a, self.b, self.g, cos(theta - psi), sin(theta - psi)
        swung = -(s * w**2 + g * sin(psi - self.gamma)) / b  # ψ̈ − cos(θ−ψ) θ̈/b
        pushed = (M + m * a + m) * g * sin(theta - self.gamma) + m * b * (c * swung + s * u**2)
        alpha = pushed / (M + m * a**2 + m - m * c**2)
        return w, u, alpha, c * alpha / b + swung

    def swing(self, begin, t):
        return solve_ivp(self.rates, (0, t), begin, method="DOP853", rtol=1e-13, atol=1e-16).y[:, -1]

    def step(self, start):
        """(θ, θ̇, φ̇) after the next heel strike, and when that is."""
        theta, w, v = start

        def struck(t, y):
            return y[0] + y[1]

        struck.direction, begin = -1, [theta, -theta, w, w - v]
        times = solve_ivp(self.rates, (0, 6), begin, method="DOP853", rtol=1e-9, atol=1e-12, events=struck).t_events[0]
        t = times[times > 0.1][0]  # not the strike of the start
        for _ in range(2):  # onto the strike, by steps of the method itself
            y = self.swing(begin, t)
            t -= (y[0] + y[1]) / (y[2] + y[3])
        theta, psi, w, u = self.swing(begin, t)
        m, M, a, b, c = self.m, self.M, self.a, self.b, cos(theta - psi)
        before = [(M + 2 * m * a) * c * w - m * a * b * (w + u), -a * w]
        after = [[M + m * a**2 + m - m * b * c, m * b * (b - c)], [-c, b]]
        new, old = np.linalg.solve(after, before)
        return np.array([psi, new, new - old]), t

    def gait(self, start):
        """The fixed point near a start, and its time."""
        found = fsolve(lambda x: self.step(x)[0] - x, start, xtol=1e-13)
        return found, self.step(found)[1]

    def multipliers(self, start, h=1e-5):
        """By central differences of fourth order, the largest first."""
        ahead = {d: [self.step(start + d * h * e)[0] for e in np.eye(3)] for d in (-2, -1, 1, 2)}
        slopes = [(ahead[-2][i] - 8 * ahead[-1][i] + 8 * ahead[1][i] - ahead[2][i]) / (12 * h) for i in range(3)]
        return sorted(np.linalg.eigvals(np.array(slopes).T).astype(complex), key=lambda mu: (-round(abs(mu), 9), -mu.imag))


def compared(of, found, hand, within=1e-10):
    """A gait beside that of the equations by hand."""
    value = list(found.values.values())
    start, time = hand.gait(value)
    yield Answer(f"θ, θ̇, φ̇ just after a strike, {of}", value, "rad, rad/s", start, BY_HAND, within)
    yield Answer(f"time of a step, {of}", found.period, "s", time, BY_HAND, within)
    parts, known = (
        [part for mu in all_of for part in (mu.real, mu.imag)] for all_of in (found.multipliers, hand.multipliers(start))
    )
    yield Answer(f"multipliers (real, imaginary), {of}", parts, "", known, BY_HAND, 1e-7, 1.0)


@ask("All period-one gaits as the feet weigh nothing: start, step time, multipliers")
def light(case):
    for gamma in (0.004, 0.009, 0.014):
        for gait in NEAR:
            found = walker(case).limit("beta", 0.004, rough(gait, gamma), gamma=gamma)
            of = f"γ = {gamma}, the {gait} gait, β → 0"
            yield from compared(of, found, ByHand(gamma, 0.0))
            yield Answer(f"error of the limit, {of}", found.error, "", 0.0, "extrapolation from β = 0.004 · 2⁻ⁿ", 1e-10, 1.0)


@ask("How many there are: from starts all over (θ, θ̇), γ = 0.009, β = 0.01")
def number(case):
    within = {"theta0": (0.18, 0.21), "w": (-0.215, -0.19), "v": (-0.02, -0.01)}
    found = walker(case).find_all(within, 16, beta=0.01)
    check = sorted(ByHand(0.009, 0.01).gait(list(rough(gait, 0.009).values()))[0][0] for gait in NEAR)
    yield Answer("θ of all gaits", [each.values["theta0"] for each in found], "rad", check, BY_HAND, 1e-10)


@ask("Feet of mass: γ = 0.009")
def heavy(case):
    for beta in (0.001, 0.01, 0.02, 0.03):
        for gait in NEAR:
            found = walker(case).find(rough(gait, 0.009), beta=beta)
            yield from compared(f"β = {beta}, the {gait} gait", found, ByHand(0.009, beta), 1e-11)


@ask("Published: the long and the short gait at γ = 0.009, β → 0")
def published(case):
    against = "Garcia et al. (1998), their table"
    for gait, start in (("long", (0.200310900544287, -0.199832473004977)), ("short", (0.193937369810184, -0.203866927442010))):
        found = walker(case).limit("beta", 0.004, rough(gait, 0.009))
        value = [found.values["theta0"], found.values["w"]]
        yield Answer(f"θ, θ̇, the {gait} gait", value, "rad, rad/s", start, against, 1e-9)


@ask("Three steps from the longer gait, θ̇ raised by 2 %; β → 0 is taken as 1e-7")
def three(case):
    for beta in (1e-7, 0.01):
        hand, gait = ByHand(0.009, beta), walker(case)
        near = rough("long", 0.009)
        start = (gait.find(near, beta=beta) if beta > 1e-6 else gait.limit("beta", 0.004, near)).values
        begun = {**start, "w": 1.02 * start["w"]}
        here, check = np.array(list(begun.values())), []
        for _ in range(3):
            here, time = hand.step(here)
            check += [*here[:2], time]
        value = [x for values, time in gait.steps(3, begun, beta=beta) for x in (*values[:2], time)]
        yield Answer(f"θ, θ̇ and time of each step, β = {beta:g}", value, "rad, rad/s, s", check, BY_HAND, 1e-9)


@ask("Compass gait at 3°: legs of 5 kg, hip of 10 kg, legs of 1 m")
def compass(case):
    found = case.mechanism("compass.yaml").periodic(RETURNS, section="strike", horizon=3).find()
    yield from compared("compass", found, ByHand(radians(3), 5.0, 10.0, 0.5, 9.81), 1e-11)
    theta, w, v = found.values.values()
    value = [theta - radians(3), radians(3) - theta - 2 * radians(3), w, w - v]
    against = "Goswami, Thuilot & Espiau (1998), to their four digits"
    known = [0.2187, -0.3234, -1.0918, -0.3772]
    yield Answer("angles of the legs from the vertical, their rates", value, "rad, rad/s", known, against, 1e-3)
