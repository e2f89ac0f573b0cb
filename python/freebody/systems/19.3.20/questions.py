"""19.3.20: the θ–y system: a mass on a vertical guide, on a spring (A) or free (B), with a pendulum; or both on a cable (C).

y down from the unstretched spring, θ from the downward vertical. The bob has (ℓ cos θ θ̈ − ℓ sin θ θ̇²) along x and
ÿ − ℓ sin θ θ̈ − ℓ cos θ θ̇² down. Whole system down, bob across the rod, bob along the rod:
    (M + m)ÿ − mℓ(sin θ θ̈ + cos θ θ̇²) = (M + m)g − ky,   ℓθ̈ = (ÿ − g) sin θ,   T = m(ℓθ̇² − (ÿ − g) cos θ).
Eliminating θ̈: (ÿ − g)(M + m cos²θ) = mℓ cos θ θ̇² − ky. The guide pushes M with −T sin θ.
With y = (M + m)g/k + η the constant terms go: ky − (M + m)g = kη.

Without spring (B) the mass centre falls freely, and seen from a frame that falls with it no force works: with
w = y − ½gt², both P = (M + m)ẇ − mℓ sin θ θ̇ and ½mℓ²(1 − m sin²θ/(M + m))θ̇² are constant. So θ(t) is a quadrature.

C: M hangs at depth y on one end of a cable, m swings on the other; both are hung over small pulleys on one level, y and r =
ℓ − y below them. M down, m along and across its part of the cable:
    Mÿ = Mg − T,   m(r̈ − rθ̇²) = mg cos θ − T,   rθ̈ + 2ṙθ̇ = −g sin θ,   with ṙ = −ẏ:
    (M + m)ÿ = Mg − m(g cos θ + rθ̇²),   rθ̈ = 2ẏθ̇ − g sin θ.
Over pulleys of radius ρ the bob is at ρn + re, e along the cable and n across it, and the cable winds on and off: ṙ = −ẏ + ρθ̇. Its
velocity is −ẏe + rθ̇n, and only the last equation changes: rθ̈ = (2ẏ − ρθ̇)θ̇ − g sin θ.
"""

from math import cos, pi, sin, sqrt

from scipy.integrate import quad

from freebody.catalogue import Answer, ask
from freebody.catalogue.answers import formula
from freebody.catalogue.reference import motion

M, m, L, K, G = 2.0, 1.0, 0.5, 100.0, 9.81
START = [0.1, 0.8, -0.3, 1.7]  # y, θ, ẏ, θ̇
COLUMNS = [("y", "m"), ("theta", "rad"), ("rate(y)", "m/s"), ("rate(theta)", "rad/s")]
EQUATIONS = "other route: balances by hand"


def relative(y, theta, omega, k):
    """ÿ − g."""
    return (m * L * cos(theta) * omega**2 - k * y) / (M + m * cos(theta) ** 2)


def rates(k):
    def f(_t, s):
        y, theta, v, omega = s
        down = relative(y, theta, omega, k)
        return v, omega, G + down, down * sin(theta) / L

    return f


def tension(y, theta, omega, k):
    return m * (L * omega**2 - relative(y, theta, omega, k) * cos(theta))


@ask("In symbols: the two equations, with the spring and without")
def symbolically(case):
    below = "(M + m*cos(theta)^2)"
    for file, spring in [("model.yaml", " - k*y"), ("free_fall.yaml", "")]:
        down = f"(m*l*rate(theta)^2*cos(theta){spring})/{below}"
        yield from case.symbolically({"y": f"g + {down}", "theta": f"{down}*sin(theta)/l"}, EQUATIONS, file)


@ask("One instant, with the forces of guide and rod")
def instant(case):
    y, theta, _, omega = START
    for file, k in [("model.yaml", K), ("equilibrium.yaml", K), ("free_fall.yaml", 0.0)]:
        now, down, T = case.instant(file), relative(y, theta, omega, k), tension(y, theta, omega, k)
        yield Answer(f"ÿ, {file}", now.accelerations["y"], "m/s²", G + down, EQUATIONS, 1e-12)
        yield Answer(f"θ̈, {file}", now.accelerations["theta"], "rad/s²", down * sin(theta) / L, EQUATIONS, 1e-12)
        yield Answer(f"tension of the rod, {file}", now["rod.tension"], "N", T, EQUATIONS, 1e-12)
        yield Answer(f"force of the guide along x, {file}", now["guide.Fx"], "N", -T * sin(theta), EQUATIONS, 1e-12)


@ask("Motion for 5 s")
def run(case):
    times = [1.0, 2.0, 3.0, 4.0, 5.0]
    for file, k in [("model.yaml", K), ("free_fall.yaml", 0.0)]:
        run, check = case.run(file), motion(rates(k), START, times)
        for i, (text, unit) in enumerate(COLUMNS):
            yield Answer(f"{text} at 1…5 s, {file}", run.evaluate(text, times), unit, check[:, i], f"{EQUATIONS}, SciPy", 1e-8)
    check = motion(rates(K), START, times)[:, 0] - (M + m) * G / K
    value = case.run("equilibrium.yaml").evaluate("y", times)
    yield Answer("y from static equilibrium", value, "m", check, f"{EQUATIONS}, SciPy, shifted by (M + m)g/k", 1e-8)


@ask("What is conserved besides energy, without spring: found")
def conserved(case):
    """The weight is the only vertical force from outside: the momentum downward is P + (M + m)gt. And the swing, seen
    from a frame that falls freely, has an energy of its own.
    """
    closed = {
        "p": "(M + m)*rate(y) - m*l*sin(theta)*rate(theta) - (M + m)*g*t",
        "h": "m/2*l^2*(1 - m*sin(theta)^2/(M + m))*rate(theta)^2",
    }
    _, theta, v, omega = START
    start = {"p": (M + m) * v - m * L * sin(theta) * omega, "h": m / 2 * L**2 * (1 - m * sin(theta) ** 2 / (M + m)) * omega**2}
    for found in case.mechanism("free_fall.yaml").first_integrals():
        of, along = found.letter, found.along(case.run("free_fall.yaml"))
        yield formula(f"{found.words}: {found.reason}", found.quantity, closed[of], "closed form: weight alone acts from outside")
        unit, check = "N·s" if of == "p" else "J", [start[of]] * 2
        yield Answer(f"the {found.words}: least and greatest in 5 s", [along.min(), along.max()], unit, check, "its start", 1e-8)


@ask("How long the bob takes for one turn, without spring")
def turn(case):
    """θ̇ never changes sign: t = ∫ √(1 − m sin²θ/(M + m))/√(2E/mℓ²) dθ; the angle after that time is one turn on."""
    _, theta, _, omega = START

    def slow(angle):
        return sqrt(1 - m * sin(angle) ** 2 / (M + m))

    period = quad(slow, theta, theta + 2 * pi, epsabs=0, epsrel=1e-13)[0] / (slow(theta) * omega)
    run = case.run("free_fall.yaml")
    yield Answer("θ after that time, less 2π", run.evaluate("theta - 2*pi", period), "rad", theta, "quadrature", 1e-9)


SWING = [1.0, 1.3, 0.0, 0.0]


def on_cable(_t, s, rho=0.0):
    y, theta, v, omega = s
    r = free_part(y, theta, rho)
    return v, omega, G - cable_tension(s, rho) / M, ((2 * v - rho * omega) * omega - G * sin(theta)) / r


def free_part(y, theta, rho):
    """Of the cable, from the right pulley to the bob."""
    return 3.0 - y + rho * (theta - SWING[1])


def cable_tension(s, rho=0.0):
    y, theta, _, omega = s
    return M * m * (G + G * cos(theta) + free_part(y, theta, rho) * omega**2) / (M + m)


@ask("C, on a cable over two pulleys: one instant, motion for 1.5 s, tension")
def cable(case):
    """The cable only pulls: it stays taut, because T = Mm(g + g cos θ + rθ̇²)/(M + m) does not reach 0."""
    for state in (SWING, [1.4, 0.7, 0.6, -2.0]):
        y, theta, v, omega = state
        r, c, s = 3.0 - y, cos(theta), sin(theta)
        rates = {"block.x": 0, "block.y": -v, "bob.x": -v * s + r * omega * c, "bob.y": v * c + r * omega * s}
        now = case.instant("cable.yaml", **{"block.y": -y, "bob.x": r * s, "bob.y": -r * c, "rates": rates})
        check, of = on_cable(0, state), f"(y, θ, ẏ, θ̇) = {tuple(state)}"
        yield Answer(f"ÿ, {of}", now["accel(y)"], "m/s²", check[2], "closed form: balances of M and m", 1e-12)
        yield Answer(f"θ̈, {of}", now["accel(theta)"], "rad/s²", check[3], "closed form: balances of M and m", 1e-12)
        yield Answer(f"tension, {of}", now["cable.tension"], "N", cable_tension(state), "closed form: balances of M and m", 1e-12)
    run, times = case.run("cable.yaml"), [0.3, 0.6, 0.9, 1.2, 1.5]
    check = motion(on_cable, SWING, times)
    for i, (text, unit) in enumerate(COLUMNS):
        yield Answer(f"{text} at 0.3 … 1.5 s", run.evaluate(text, times), unit, check[:, i], f"{EQUATIONS}, SciPy", 1e-9)
    yield Answer(
        "tension then", run.evaluate("cable.tension", times), "N", [cable_tension(s) for s in check], f"{EQUATIONS}, SciPy", 1e-9
    )
    many = [0.01 * n for n in range(1, 151)]
    least = min(cable_tension(s) for s in motion(on_cable, SWING, many))
    yield Answer("least tension", min(run.evaluate("cable.tension", many)), "N", least, f"{EQUATIONS}, SciPy", 1e-9)


@ask("C, over pulleys of radius 0.1 m, 0.01 m, 1 mm")
def pulleys(case):
    """They come near the small ones as the radius does."""
    times, small = [0.3, 0.6, 0.9, 1.2, 1.5], case.run("cable.yaml")
    for rho in (0.1, 0.01, 0.001):
        run, check = case.run("pulleys.yaml", {"rho": rho}), motion(lambda t, s, rho=rho: on_cable(t, s, rho), SWING, times)
        for i, (text, unit) in enumerate(COLUMNS[:2]):
            yield Answer(
                f"{text} at 0.3 … 1.5 s, ρ = {rho}", run.evaluate(text, times), unit, check[:, i], f"{EQUATIONS}, SciPy", 1e-9
            )
        tension = [cable_tension(s, rho) for s in check]
        yield Answer(f"tension then, ρ = {rho}", run.evaluate("cable.tension", times), "N", tension, f"{EQUATIONS}, SciPy", 1e-8)
    limit = "other route: eyelets; the difference goes as ρ"
    yield Answer("y, the last against small pulleys", run.evaluate("y", times), "m", small.evaluate("y", times), limit, 10 * rho)
