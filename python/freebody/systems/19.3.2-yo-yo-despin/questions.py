"""Yo-yo de-spin of a satellite.

σ is the sense of the strings, followed from where they are fixed to the particles: +1 with the spin (a), −1 against it (b).
With the labels exchanged, as seen from the particles, (a) and (b) only change names.

ω is the spin, ℓ the free length, ψ the direction in which the string touches the rim: ℓ̇ = σR(ω − ψ̇). A particle at
R e_r + σℓ e_θ has the velocity Rω e_θ − σℓψ̇ e_r. With κ = (I + 2mR²)/2m and both strings alike,
    angular momentum  κω + ℓ²ψ̇ = κω0,      energy  κω² + ℓ²ψ̇² = κω0².
They have two solutions. ψ̇ = ω0 + ω with ω = ω0 (κ − ℓ²)/(κ + ℓ²), so ℓ̇ = −σRω0; this unwinds a string of σ = −1. And ω = ω0 with
ψ̇ = 0, so ℓ̇ = σRω0: a string of σ = +1 is given off just as fast as the particle flies straight on, with no tension.
Both are unwound at L/(Rω0). Tension of (b), from I ω̇ = −2RN: N = 2Iω0² κℓ/(κ + ℓ²)².

Then the string swings about its attachment, from across the radius over the radius to across again. In the directions θ
of the attachment and γ of the string: T = ½(I + 2mR²)θ̇² + mL²γ̇² + 2mRLθ̇γ̇ cos(γ − θ), integrated by SciPy. When radial, with the
speed v of the particles: Iω + 2m(R + L)v = 2mκω0 and Iω² + 2mv² = 2mκω0², a quadratic of two roots; (a) has the greater ω.
The swing is its own mirror image in time, and so is all that follows: the strings wind on in the other sense until the
particles are back on the rim after twice the time to the radius, and the spin is ω0 again. Then they unwind in that sense.
ω = 0 in (b): ℓ² = κ when tangential, (R + L)² = κ when radial; in (a) for no length. For L → ∞ the spin of (b) becomes −ω0 when
tangential. When radial, v → 0 and all energy is the satellite's: ω → σω0 √(1 + 2mR²/I).
"""

import numpy as np

from freebody.catalogue import Answer, ask, reference

M, R, m, L, W = 200.0, 0.8, 2.0, 3.0, 5.0
I = M * R**2 / 2
KAPPA = (I + 2 * m * R**2) / (2 * m)
UNWOUND = L / (R * W)
SENSES = {"(a)": 1, "(b)": -1}
CONSERVED, SCIPY = "closed form: angular momentum and energy", "other route: two directions, integrated by SciPy"
OFF = 1e-7
"""Tolerance once the strings have come off the drum. A particle on the rim has a free length that is the root of a rounding,
1e-8 m, and a string that is just taut there is wrong by so much."""


def run(case, sense, until=2.0, **parameters):
    return case.run("with_spin.yaml" if sense == "(a)" else "model.yaml", parameters, until=until)


def spin(sense, free):
    """ω while the string lies on the rim."""
    return W if sense == "(a)" else W * (KAPPA - free**2) / (KAPPA + free**2)


def tension(sense, free):
    return 0.0 if sense == "(a)" else 2 * I * W**2 * KAPPA * free / (KAPPA + free**2) ** 2


def radial(sense, length=L):
    """ω when the strings are radial: the root of the quadratic that belongs to the sense."""
    far = 2 * m * (R + length) ** 2
    momentum, energy = 2 * m * KAPPA * W, 2 * m * KAPPA * W**2
    roots = np.roots([I + I**2 / far, -2 * momentum * I / far, momentum**2 / far - energy])
    return max(roots) if sense == "(a)" else min(roots)


def swing(t, y):
    """Rates of (θ, γ, θ̇, γ̇), and what follows from p_θ' = ∂T/∂θ and p_γ' = ∂T/∂γ."""
    theta, gamma, a, b = y
    c, s = np.cos(gamma - theta), np.sin(gamma - theta)
    mixed = 2 * m * R * L
    mass = [[I + 2 * m * R**2, mixed * c], [mixed * c, 2 * m * L**2]]
    return [a, b, *np.linalg.solve(mass, [mixed * s * b**2, -mixed * s * a**2])]


def start_of_swing(sense):
    sigma = SENSES[sense]
    omega = spin(sense, L)
    return [0.0, sigma * np.pi / 2, omega, 0.0 if sigma > 0 else W + omega]


def to_radius(sense):
    """Time from across the radius to the radius."""
    return reference.event(swing, start_of_swing(sense), lambda t, y: y[1] - y[0], before=5)[0]


def moment(motion, name):
    return next(event.t for event in motion.events if event.name == name)


@ask("While the strings unwind, what are spin, free length and tension?")
def unwinding(case):
    times = np.array([0.05, 0.2, 0.4, 0.6, 0.74])
    free = R * W * times
    for sense in SENSES:
        motion = run(case, sense)
        value = motion.evaluate("rate(theta)", times)
        yield Answer(f"{sense} spin at 0.05 … 0.74 s", value, "rad/s", [spin(sense, x) for x in free], CONSERVED, 1e-9)
        value = motion.evaluate("sqrt(r^2 - R^2)", times)
        yield Answer(f"{sense} free length at 0.05 … 0.74 s", value, "m", free, CONSERVED, 1e-8)
        check = [tension(sense, x) for x in free]
        for name in "pq":
            value = motion.evaluate(f"{name}.tension", times)
            yield Answer(f"{sense} tension of {name} at 0.05 … 0.74 s", value, "N", check, CONSERVED, 1e-8, 1.0)


@ask("When are they unwound, with what spin and tension, and with what spin is the satellite left if they are released then?")
def unwound(case):
    for sense in SENSES:
        motion = run(case, sense)
        t = moment(motion, "unwound")
        yield Answer(f"{sense} time", t, "s", UNWOUND, CONSERVED, 1e-8)
        yield Answer(f"{sense} spin", motion.evaluate("rate(theta)", t), "rad/s", spin(sense, L), CONSERVED, 1e-8)
        pull = motion.evaluate("p.tension", t)
        yield Answer(f"{sense} tension", pull, "N", tension(sense, L), CONSERVED, 1e-8, 1.0)
        after = run(case, sense, release=1).evaluate("rate(theta)", 1.5)
        yield Answer(f"{sense} spin long after release", after, "rad/s", spin(sense, L), CONSERVED, 1e-8)


@ask("While they swing about their attachments, what is the spin, and what when they are radial?")
def swinging(case):
    for sense in SENSES:
        motion, tau = run(case, sense), to_radius(sense)
        times = np.array([0.1, 0.2, 0.4, 0.5])
        check = reference.motion(swing, start_of_swing(sense), times)[:, 2]
        value = motion.evaluate("rate(theta)", UNWOUND + times)
        yield Answer(f"{sense} spin 0.1 … 0.5 s after unwinding", value, "rad/s", check, SCIPY, OFF)
        t = moment(motion, "radial")
        yield Answer(f"{sense} time when radial", t, "s", UNWOUND + tau, SCIPY, 1e-8)
        yield Answer(f"{sense} spin when radial", motion.evaluate("rate(theta)", t), "rad/s", radial(sense), CONSERVED, OFF)
        omega = radial(sense)
        turning = ((KAPPA * W - I / (2 * m) * omega) / (R + L) - R * omega) / L
        pull = m * (R * omega**2 + L * turning**2)
        value = motion.evaluate("p.tension", t)
        yield Answer(f"{sense} tension when radial", value, "N", pull, "closed form: acceleration towards the centre", OFF)
        after = run(case, sense, release=2).evaluate("rate(theta)", 1.5)
        yield Answer(f"{sense} spin long after release", after, "rad/s", radial(sense), CONSERVED, OFF)


@ask("Never released, how do the strings wind on in the other sense?")
def rewinding(case):
    for sense in SENSES:
        motion, tau = run(case, sense), to_radius(sense)
        yield Answer(f"{sense} time of the first touch", moment(motion, "winds on"), "s", UNWOUND + 2 * tau, SCIPY, 1e-8)
        end = 2 * (UNWOUND + tau)
        times = np.array([1.4, 1.7, 1.9, 2.0])
        free = R * W * (end - times)
        value = motion.evaluate("sqrt(r^2 - R^2)", times)
        yield Answer(f"{sense} free length at 1.4 … 2 s", value, "m", free, "closed form: unwinding backwards", OFF)
        value = motion.evaluate("rate(theta)", times)
        yield Answer(f"{sense} spin at 1.4 … 2 s", value, "rad/s", [spin(sense, x) for x in free], CONSERVED, OFF)
        back = 2.0 + motion.evaluate("sqrt(r^2 - R^2)", 2.0) / (R * W)
        yield Answer(
            f"{sense} when the particles are back on the rim",
            back,
            "s",
            end,
            "closed form: unwinding backwards",
            OFF,
        )


@ask("And once the particles are back on the rim, the strings in the other sense: does (a) go on as (b) and (b) as (a)?")
def again(case):
    """At the rim the particles are as they were at the start."""
    for sense, other in (("(a)", "(b)"), ("(b)", "(a)")):
        motion = run(case, sense, until=3.3)
        back = 2 * (UNWOUND + to_radius(sense))
        after = np.array([0.2, 0.4, 0.6, 0.74])
        value = motion.evaluate("rate(theta)", back + after)
        check = [spin(other, R * W * dt) for dt in after]
        yield Answer(f"{sense} spin 0.2 … 0.74 s after", value, "rad/s", check, CONSERVED, OFF)
        value = motion.evaluate("sqrt(r^2 - R^2)", back + after)
        yield Answer(f"{sense} free length 0.2 … 0.74 s after", value, "m", R * W * after, CONSERVED, OFF)
        t = [event.t for event in motion.events if event.name == "radial"][1]
        value = motion.evaluate("rate(theta)", t)
        yield Answer(f"{sense} spin when radial again", value, "rad/s", radial(other), CONSERVED, OFF, W)


@ask("Which lengths of strings, from 0.5 to 8 m, leave no spin?")
def none(case):
    """Tangential: ℓ² = κ; radial: (R + L)² = κ; in (a) none."""
    bounds, words = (0.5, 8.0), {"until": 4.0, "points": 9, "rtol": 1e-12}
    for sense, file in (("(a)", "with_spin.yaml"), ("(b)", "model.yaml")):
        for how, event, length in (("tangential", "unwound", np.sqrt(KAPPA)), ("radial", "radial", np.sqrt(KAPPA) - R)):
            found = case.mechanism(file).find(f"rate(theta) @ {event}", 0.0, vary="L", within=bounds, **words)
            if sense == "(a)":
                says = f"(a) Released when {how}: {len(found.values) or 'none'}."
                yield Answer("how many", len(found.values), "", 0, CONSERVED, 0.0, 1.0, says=says)
            else:
                says = f"(b) Released when {how}: only {{}}."
                yield Answer("L", found.values, "m", [length], CONSERVED, OFF, says=says)


@ask("What spin is left as L → ∞?")
def long(case):
    for sense, sigma in SENSES.items():
        file = "with_spin.yaml" if sense == "(a)" else "model.yaml"
        for how, release, check in (("tangential", 1, sigma * W), ("radial", 2, sigma * W * np.sqrt(1 + 2 * m * R**2 / I))):
            words = {"begin": 8.0, "release": release, "until": 1100.0, "rtol": 1e-12}
            found = case.mechanism(file).limit("rate(theta) @ end", vary="L", **words)
            says = f"{sense} Released when {how}: {{}}; {found.tail}."
            yield Answer("spin", found.value, "rad/s", check, CONSERVED, 1e-6, says=says)
