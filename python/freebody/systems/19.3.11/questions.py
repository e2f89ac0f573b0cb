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
MASSES = ((100.0, 5.0), (1.0, 1.0))
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


@ask("(a, b) Speeds at the exit, of ball and cart and of the ball relative to the cart")
def speeds(case):
    for M, m in MASSES:
        w, V = shot(M, m)
        for of, file in (("guided", "model.yaml"), ("against the wall", "wall.yaml")):
            run = case.run(file, {"M": M, "m": m})
            t = leaving(run)
            ball, cart = (run.evaluate(f"vx({point})", t) for point in ("ball.centre", "cart.C"))
            of = f"M = {M:g}, m = {m:g}, {of}"
            yield Answer(f"ball, {of}", ball, "m/s", V + w, CONSERVED, 1e-10)
            yield Answer(f"cart, {of}", cart, "m/s", V, CONSERVED, 1e-10)
            yield Answer(f"relative, {of}", ball - cart, "m/s", w, CONSERVED, 1e-10)
            rise = run.evaluate("vy(ball.centre)", t)
            yield Answer(f"ball upwards, {of}", rise, "m/s", 0.0, "closed form: the exit is level", 1e-10, w)


@ask("(a, b) The same, where the drop is H")
def deep(case):
    for M, m in MASSES:
        w, V = shot(M, m, H)
        run, of = case.run(parameters={"M": M, "m": m, "R": H}), f"M = {M:g}, m = {m:g}"
        ball, cart = (run.evaluate(f"vx({point})", leaving(run)) for point in ("ball.centre", "cart.C"))
        yield Answer(f"ball, cart, {of}", [ball, cart], "m/s", [V + w, V], CONSERVED, 1e-10)
        yield Answer(f"relative, {of}", ball - cart, "m/s", w, CONSERVED, 1e-10)


@ask("(c) Two balls: at once, and one after the other")
def two_balls(case):
    for M, m in MASSES:
        _, together = shot(M, 2 * m)
        run, of = case.run(parameters={"M": M, "m": 2 * m}), f"M = {M:g}, m = {m:g}"
        value = run.evaluate("vx(cart.C)", leaving(run))
        yield Answer(f"cart, both at once, {of}", value, "m/s", together, CONSERVED, 1e-10)
        run = case.run("two.yaml", {"M": M, "m": m})
        w, first = shot(M + m, m)
        yield Answer(
            f"cart, one has left, {of}", run.evaluate("vx(cart.C)", leaving(run, "exit 1")), "m/s", first, CONSERVED, 1e-10
        )
        held = run.evaluate("x(second.centre) - x(cart.C)", leaving(run, "exit 1"))
        yield Answer(f"the second held at, from the middle, {of}", held, "m", -R, "it is held", 1e-10)
        end = leaving(run, "exit 2")
        cart, second = (run.evaluate(f"vx({point})", end) for point in ("cart.C", "second.centre"))
        more, recoil = shot(M, m)
        yield Answer(f"cart, both have left, {of}", cart, "m/s", first + recoil, CONSERVED, 1e-10)
        yield Answer(f"difference to both at once, {of}", cart - value, "m/s", first + recoil - together, CONSERVED, 1e-8)
        yield Answer(f"second ball relative to the cart, {of}", second - cart, "m/s", more, CONSERVED, 1e-10)
        yield Answer(f"first ball, {of}", run.evaluate("vx(first.centre)", end), "m/s", first + w, CONSERVED, 1e-10)


@ask("(c) Why: at the end of both, where is the energy 2mgR that both balls gave?")
def why(case):
    """The momentum is 0 and the energy the same in both. Two balls that leave one after the other have different speeds, and what is in their
    motion against each other, m(v₁ − v₂)²/4, the cart does not get."""
    claim = "at {}: M V^2/2 + (M V)^2/({}) {} = {} m g R"
    for M, m in MASSES:
        of = f"M = {M:g}, m = {m:g}"
        run = case.run("two.yaml", {"M": M, "m": m})
        end = leaving(run, "exit 2")
        first, (second, recoil) = shot(M + m, m)[0], shot(M, m)
        apart = run.evaluate("m*(vx(first.centre) - vx(second.centre))^2/4", end)
        check = m * (first - recoil - second) ** 2 / 4
        yield Answer(f"energy of the balls against each other, {of}", apart, "J", check, CONSERVED, 1e-10)
        for parameters, file, letters, event, twice, count, apart_said in (
            ({"M": M, "m": 2 * m}, "model.yaml", {"V": "rate(X)"}, "exit", "2 m", "1", ""),
            (
                {"M": M, "m": m},
                "two.yaml",
                {"V": "rate(X)", "v_1": "vx(first.centre)", "v_2": "vx(second.centre)"},
                "exit 2",
                "4 m",
                "2",
                "+ m (v_1 − v_2)^2/4",
            ),
        ):
            says = claim.format(event, twice, apart_said, count)
            value = case.mechanism(file, **parameters).check(says, letters=letters).ok
            yield Answer(f"{file}, {of}", value, "", 1, CONSERVED, 0.0, said=says)


@ask("Time in the tube, way of the cart, tube force, range")
def tube(case):
    for M, m in MASSES:
        w, V = shot(M, m)
        force, flight = m * G + m * w**2 / R, sqrt(2 * H / G)
        for of, file, push in (("guided", "model.yaml", "tube.F"), ("against the wall", "wall.yaml", "wall.N")):
            run = case.run(file, {"M": M, "m": m})
            t, of = leaving(run), f"M = {M:g}, m = {m:g}, {of}"
            yield Answer(f"time in the tube, {of}", t, "s", tube_time(M, m), "quadrature", 1e-10)
            way = run.evaluate("x(cart.C)", t)
            yield Answer(f"cart has moved, {of}", way, "m", -m * R / (M + m), "conservation: mass centre", 1e-10)
            closed = "closed form: m(g + w²/R)"
            yield Answer(f"tube force at the exit, {of}", run.evaluate(push, t - 1e-8), "N", force, closed, 1e-7)
            landing = run.events[-1].t
            flown = run.evaluate("x(ball.centre)", landing) - run.evaluate("x(ball.centre)", t)
            yield Answer(f"range from the exit, {of}", flown, "m", (V + w) * flight, "closed form: parabola", 1e-10)
            ahead = run.evaluate("x(ball.centre) - x(cart.exit)", landing)
            yield Answer(f"from the exit of the moving cart, {of}", ahead, "m", w * flight, "closed form: parabola", 1e-10)
