"""19.3.11: gun on a cart, a ball that rolls the cart back as it leaves.

φ from the top of the tube, w = Rφ̇ the ball's speed in the tube, V the cart's (to the right). No horizontal force from
outside: (M + m)V + m w sin φ = 0; with the energy, ½m w²(1 − μ sin²φ) = mgR sin φ, μ = m/(M + m). At the exit
    w = √(2gR(M + m)/M),   V = −m w/(M + m),   ball: V + w = M w/(M + m),
time ∫√(R(1 − μ sin²φ)/(2g sin φ)) dφ, way of the cart −μR. There the cart does not accelerate, so the tube carries mg + m w²/R.
Two balls at once are one of 2m: the cart gets −2m √(2gR(M + 2m)/M)/(M + 2m). One after another: the second one rides along, at
rest on the cart, while the first goes, so that is a cart of M + m; its own shot, of a cart of M, starts from that speed. Not the
same: −m √(2gR(M + 2m)/(M + m))/(M + 2m) − m √(2gR(M + m)/M)/(M + m) is less. The ball lies against the outer wall all the way.
"""

from math import pi, sin, sqrt

from scipy.integrate import quad

from freebody.catalogue import Answer, ask

G, R, H = 9.81, 1.2, 2.0
MASSES = ((100.0, 5.0, ""), (1.0, 1.0, "M = m = 1 kg"))
FILES = {"model.yaml": "", "wall.yaml": "the ball against the outer wall"}
CONSERVED = "conservation: energy, momentum"


def shot(M, m, drop=R):
    """Speed of a ball relative to the cart at the exit, and what the cart's speed grows by."""
    w = sqrt(2 * G * drop * (M + m) / M)
    return w, -m * w / (M + m)


def tube_time(M, m):
    mu = m / (M + m)

    def slope(z):  # φ = z² takes the root out of the start
        s = sin(z * z)
        return sqrt(R * (1 - mu * s**2) / (2 * G * s)) * 2 * z if z else sqrt(2 * R / G)

    return quad(slope, 0, sqrt(pi / 2), epsabs=0, epsrel=1e-13)[0]


def leaving(run, name="exit"):
    return next(event.t for event in run.events if event.name == name)


@ask("(a) How fast are ball and cart at the exit, and (b) the ball relative to the cart?")
def speeds(case):
    for M, m, masses in MASSES:
        w, V = shot(M, m)
        for file, how in FILES.items():
            run, of = case.run(file, {"M": M, "m": m}), ", ".join(filter(None, (masses, how)))
            t = leaving(run)
            ball, cart = (run.evaluate(f"vx({point})", t) for point in ("ball.centre", "cart.C"))
            says = "(a) The ball flies at {}," * (not of)
            yield Answer("ball", ball, "m/s", V + w, CONSERVED, 1e-10, says=says, variant=of)
            says = "the cart rolls at {}." * (not of)
            yield Answer("cart", cart, "m/s", V, CONSERVED, 1e-10, says=says, variant=of)
            says = "(b) Relative to the cart the ball has {} forwards" * (not of)
            yield Answer("relative", ball - cart, "m/s", w, CONSERVED, 1e-10, says=says, variant=of)
            rise, says = run.evaluate("vy(ball.centre)", t), "and {} upwards." * (not of)
            yield Answer("upwards", rise, "m/s", 0.0, CONSERVED, 1e-10, w, says=says, variant=of)
        w, V = shot(M, m, H)
        run, of = case.run(parameters={"M": M, "m": m, "R": H}), ", ".join(filter(None, (masses, "the drop is H")))
        ball, cart = (run.evaluate(f"vx({point})", leaving(run)) for point in ("ball.centre", "cart.C"))
        yield Answer("ball, cart", [ball, cart], "m/s", [V + w, V], CONSERVED, 1e-10, variant=of)
        yield Answer("relative", ball - cart, "m/s", w, CONSERVED, 1e-10, variant=of)


@ask("(c) How fast is the cart when two balls go together, and when one goes after the other? Is it the same?")
def two_balls(case):
    for M, m, of in MASSES:
        _, both = shot(M, 2 * m)
        run = case.run(parameters={"M": M, "m": 2 * m})
        together, says = run.evaluate("vx(cart.C)", leaving(run)), "Together: {}." * (not of)
        yield Answer("together", together, "m/s", both, CONSERVED, 1e-10, says=says, variant=of)
        run, (w, first), (more, recoil) = case.run("two.yaml", {"M": M, "m": m}), shot(M + m, m), shot(M, m)
        one, two = leaving(run, "exit 1"), leaving(run, "exit 2")
        says = "One by one: {} when the first has left," * (not of)
        yield Answer("one left", run.evaluate("vx(cart.C)", one), "m/s", first, CONSERVED, 1e-10, says=says, variant=of)
        cart, second = (run.evaluate(f"vx({point})", two) for point in ("cart.C", "second.centre"))
        says = "and {} when both have." * (not of)
        yield Answer("both left", cart, "m/s", first + recoil, CONSERVED, 1e-10, says=says, variant=of)
        says = "Not the same: one by one the cart gets {} less." * (not of)
        yield Answer("less", cart - together, "m/s", first + recoil - both, CONSERVED, 1e-8, says=says, variant=of)
        says = "The second leaves the cart at {}," * (not of)
        yield Answer("second, relative", second - cart, "m/s", more, CONSERVED, 1e-10, says=says, variant=of)
        speed, says = run.evaluate("vx(first.centre)", two), "the first flies at {}." * (not of)
        yield Answer("first ball", speed, "m/s", first + w, CONSERVED, 1e-10, says=says, variant=of)
        held = run.evaluate("x(second.centre) - x(cart.C)", one)
        says = "Until the first has left the second is held at {} from the exit." * (not of)
        yield Answer("held at", held, "m", -R, "it is held", 1e-10, says=says, variant=of)


@ask("(c) Why is it not the same?")
def why(case):
    """The momentum is 0 and the energy the same in both. Two balls that leave one after the other have different speeds, and what is in
    their motion against each other, m(v₁ − v₂)²/4, the cart does not get."""
    balls = {"V": "rate(X)", "v_1": "vx(first.centre)", "v_2": "vx(second.centre)"}
    for M, m, of in MASSES:
        run = case.run("two.yaml", {"M": M, "m": m})
        apart = run.evaluate("m*(vx(first.centre) - vx(second.centre))^2/4", leaving(run, "exit 2"))
        first, (second, recoil) = shot(M + m, m)[0], shot(M, m)
        says = "The balls leave at different speeds: {} go into their motion against each other, and not into the cart's."
        check = m * (first - recoil - second) ** 2 / 4
        yield Answer("energy", apart, "J", check, CONSERVED, 1e-10, says=says, variant=of)
        for words, file, mass, letters, claim in (
            ("Together", "model.yaml", 2 * m, {"V": "rate(X)"}, "at exit: M V^2/2 + (M V)^2/(2 m) = m g R"),
            ("One by one", "two.yaml", m, balls, "at exit 2: M V^2/2 + (M V)^2/(4 m) + m (v_1 − v_2)^2/4 = 2 m g R"),
        ):
            holds = case.mechanism(file, M=M, m=mass).check(claim, letters=letters).ok
            yield Answer(words, holds, "", True, CONSERVED, 0.0, says=f"{words}, {claim}.", variant=of)


@ask(
    "How long is the ball in the tube, how far does the cart go, how hard does the tube push at the exit, how far does the ball fly?"
)
def tube(case):
    for M, m, masses in MASSES:
        w, V = shot(M, m)
        force, flight = m * G + m * w**2 / R, sqrt(2 * H / G)
        for file, how in FILES.items():
            run, of = case.run(file, {"M": M, "m": m}), ", ".join(filter(None, (masses, how)))
            t, push = leaving(run), "tube.F" if file == "model.yaml" else "wall.N"
            says = "It is in the tube for {}." * (not of)
            yield Answer("t", t, "s", tube_time(M, m), "quadrature", 1e-10, says=says, variant=of)
            way, says = run.evaluate("x(cart.C)", t), "The cart has moved by {}." * (not of)
            yield Answer("X", way, "m", -m * R / (M + m), "conservation: mass centre", 1e-10, says=says, variant=of)
            closed, says = "closed form: m(g + w²/R)", "The tube pushes with {}." * (not of)
            yield Answer("N", run.evaluate(push, t - 1e-8), "N", force, closed, 1e-7, says=says, variant=of)
            landing, closed = run.events[-1].t, "closed form: parabola"
            flown = run.evaluate("x(ball.centre)", landing) - run.evaluate("x(ball.centre)", t)
            says = "The ball flies {} far," * (not of)
            yield Answer("range", flown, "m", (V + w) * flight, closed, 1e-10, says=says, variant=of)
            ahead = run.evaluate("x(ball.centre) - x(cart.exit)", landing)
            says = "to {} before the exit of the moving cart." * (not of)
            yield Answer("ahead", ahead, "m", w * flight, closed, 1e-10, says=says, variant=of)
