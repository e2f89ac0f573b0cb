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


def spelt(multipliers):
    """Real and imaginary parts, one of a pair standing for both, and a sentence with a place for each."""
    parts, told = [], []
    for mu in multipliers:
        if mu.imag >= 0:
            parts += [mu.real, mu.imag] if mu.imag > 0 else [mu.real]
            told.append("{} ± {} i" if mu.imag > 0 else "{}")
    verdict = "stable" if max(abs(mu) for mu in multipliers) < 1 else "not stable"
    return parts, f"Multipliers are {', '.join(told)}: it is {verdict}."


def compared(found, hand, near, within=1e-10, variant=""):
    """A gait beside that of the equations by hand, sought from a start near by."""
    (theta, w, v), (start, time) = found.values.values(), hand.gait(near)
    says, check = "It begins with θ = {} just after a strike.", start[0]
    yield Answer("θ", theta, "rad", check, BY_HAND, within, says=says, variant=variant)
    says = "θ̇ and φ̇ are {} and {} then."
    yield Answer("θ̇, φ̇", [w, v], "rad/s", start[1:], BY_HAND, within, says=says, variant=variant)
    yield Answer("time", found.period, "s", time, BY_HAND, within, says="A step takes {}.", variant=variant)
    parts, says = spelt(found.multipliers)
    yield Answer("μ", parts, "", spelt(hand.multipliers(start))[0], BY_HAND, 1e-7, 1.0, says=says, variant=variant)


@ask("What are the period-one gaits as the feet weigh nothing: start, step time, multipliers?")
def light(case):
    for gamma in (0.004, 0.009, 0.014):
        for gait in NEAR:
            near = rough(gait, gamma)
            found, of = walker(case).limit("beta", 0.004, near, gamma=gamma), f"γ = {gamma}, the {gait} gait"
            yield from compared(found, ByHand(gamma, 0.0), list(near.values()), variant=of)


@ask("How many period-one gaits are there, sought from starts all over (θ, θ̇, φ̇)?")
def number(case):
    for gamma, beta in ((0.004, 0.001), (0.009, 0.001), (0.009, 0.01), (0.014, 0.001)):
        low, high = (rough(gait, gamma)["theta0"] for gait in ("short", "long"))
        within = {"theta0": (0.8 * low, 1.2 * high), "w": (-1.3 * high, -0.7 * low), "v": (-0.15 * high, 0.0)}
        found = walker(case).find_all(within, 16, beta=beta, gamma=gamma)
        light = [ByHand(gamma, 0.0).gait(list(rough(gait, gamma).values()))[0] for gait in NEAR]
        check = sorted(ByHand(gamma, beta).gait(start)[0][0] for start in light)
        value, of = [each.values["theta0"] for each in found], f"γ = {gamma}, β = {beta}"
        says = f"{len(found)}, with θ = {' and '.join(['{}'] * len(found))} just after a strike."
        yield Answer("θ of all gaits", value, "rad", check, BY_HAND, 1e-10, says=says, variant=of)


@ask("What are they with feet of mass, γ = 0.009?")
def heavy(case):
    """Each is sought from the one before, by both routes."""
    for gait in NEAR:
        near = rough(gait, 0.009)
        by_hand = list(near.values())
        for beta in (0.001, 0.01, 0.02, 0.03):
            found, hand = walker(case).find(near, beta=beta), ByHand(0.009, beta)
            yield from compared(found, hand, by_hand, 1e-11, f"β = {beta}, the {gait} gait")
            near, by_hand = found.values, hand.gait(by_hand)[0]


@ask("Are the long and the short gait at γ = 0.009, β → 0 those that were published?")
def published(case):
    against = "Garcia et al. (1998), their table"
    for gait, (theta, w) in (
        ("long", (0.200310900544287, -0.199832473004977)),
        ("short", (0.193937369810184, -0.203866927442010)),
    ):
        found, of = walker(case).limit("beta", 0.004, rough(gait, 0.009)).values, f"the {gait} gait"
        yield Answer("θ", found["theta0"], "rad", theta, against, 1e-9, says="θ is {}.", variant=of)
        yield Answer("θ̇", found["w"], "rad/s", w, against, 1e-9, says="θ̇ is {}.", variant=of)


@ask("How does it walk three steps from the longer gait, θ̇ raised by 2 %, γ = 0.009?")
def three(case):
    """β → 0 is taken as 1e-7."""
    for beta in (1e-7, 0.01):
        hand, gait = ByHand(0.009, beta), walker(case)
        near = rough("long", 0.009)
        start = (gait.find(near, beta=beta) if beta > 1e-6 else gait.limit("beta", 0.004, near)).values
        begun = {**start, "w": 1.02 * start["w"]}
        here, check = np.array(list(begun.values())), []
        for _ in range(3):
            here, time = hand.step(here)
            check.append([*here[:2], time])
        value = np.array([[*values[:2], time] for values, time in gait.steps(3, begun, beta=beta)])
        for (name, unit), found, known in zip(
            (("θ", "rad"), ("θ̇", "rad/s"), ("Times", "s")), value.T, np.transpose(check), strict=True
        ):
            says = f"{name} of the steps: {{}}."
            yield Answer(name, found, unit, known, BY_HAND, 1e-9, says=says, variant=f"β = {beta:g}")


@ask("What is the gait of the compass at 3°, with legs of 5 kg and 1 m and a hip of 10 kg?")
def compass(case):
    found = case.mechanism("compass.yaml").periodic(RETURNS, section="strike", horizon=3).find()
    yield from compared(found, ByHand(radians(3), 5.0, 10.0, 0.5, 9.81), list(found.values.values()), 1e-11)
    theta, w, v = found.values.values()
    against = "Goswami, Thuilot & Espiau (1998), to their four digits"
    value, says = [theta - radians(3), -theta - radians(3)], "The legs are then at {} and {} from the vertical."
    yield Answer("angles", value, "rad", [0.2187, -0.3234], against, 1e-3, says=says)
    yield Answer("rates", [w, w - v], "rad/s", [-1.0918, -0.3772], against, 1e-3, says="They turn at {} and {}.")
