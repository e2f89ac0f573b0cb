"""19.3.3: particle on two long springs.

Springs so long that each pulls along its own axis only: m a = −k r, for each component and for the vector. So the
motion is r(t) = r₀ cos ωt + (v₀/ω) sin ωt with ω = √(k/m): an ellipse about the origin, once around in 2π/ω.
Its half axes are the singular values of the matrix with columns r₀ and v₀/ω. It is a segment where r₀ ∥ v₀,
a circle where r₀ ⟂ v₀ and |v₀| = ω|r₀|.
"""

from math import atan2, cos, hypot, pi, sin, sqrt

import numpy as np

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import motion

M, K = 1.0, 4.0
R0, V0 = np.array([0.1, 0.05]), np.array([-0.1, 0.25])
W = sqrt(K / M)
TIMES = [1.0, 2.0, 5.0, 10.0]
VARIANTS = {"model.yaml": "", "polar.yaml": "in polar coordinates"}


def place(t):
    return R0 * cos(W * t) + V0 / W * sin(W * t)


def speeds(t):
    return V0 * cos(W * t) - W * R0 * sin(W * t)


@ask("What are the equations of motion in (a) Cartesian, (b) polar form?")
def symbolically(case):
    against = "Newton's law; a_r = r̈ − r φ̇², a_φ = r φ̈ + 2 ṙ φ̇"
    yield from case.symbolically({"x": "-k*x/m", "y": "-k*y/m"}, against)
    polar = {"r": "r*rate(phi)^2 - k*r/m", "phi": "-2*rate(r)*rate(phi)/r"}
    yield from case.symbolically(polar, against, "polar.yaml")


@ask("(a, b) What accelerations do they give at the start?")
def accelerations(case):
    """Polar: r̈ − rφ̇² = −kr/m and rφ̈ + 2ṙφ̇ = 0, with r, ṙ, φ̇ from the start."""
    flat, polar = case.instant(), case.instant("polar.yaml")
    r = hypot(*R0)
    rdot, phidot = R0 @ V0 / r, (R0[0] * V0[1] - R0[1] * V0[0]) / r**2
    against = "closed form: m a = −k r"
    yield Answer("ẍ, ÿ", [flat.accelerations["x"], flat.accelerations["y"]], "m/s²", -K / M * R0, against, 1e-13)
    yield Answer("r̈", polar.accelerations["r"], "m/s²", r * phidot**2 - K / M * r, against, 1e-12)
    yield Answer("φ̈", polar.accelerations["phi"], "rad/s²", -2 * rdot * phidot / r, against, 1e-12)


@ask("(c, d) Is the angular momentum about the origin conserved?")
def angular_momentum(case):
    """The force points at the origin: m(xẏ − yẋ) = mr²φ̇ keeps its first value."""
    start = M * (R0[0] * V0[1] - R0[1] * V0[0])
    for file, text, words in (
        ("model.yaml", "m*(x*rate(y) - y*rate(x))", "(c) m (x ẏ − y ẋ)"),
        ("polar.yaml", "m*r^2*rate(phi)", "(d) m r² φ̇"),
        ("model.yaml", "angular_momentum(ground.O)", "Of the bodies it"),
    ):
        values, says = case.run(file).evaluate(text, TIMES), f"{words} is {{}} at 1, 2, 5, 10 s."
        yield Answer(text, values, "N·m·s", [start] * len(TIMES), "its value at the start", 1e-10, says=says)


@ask("(e, h) Does conservation follow from the equations of motion: (c, f) from (a), (d, g) from (b)?")
def consequences(case):
    """Each rate is a sum of the equations of motion times lengths or speeds, whatever the motion: the two sides are
    the same by themselves. With a wrong sign they are so in the true motion only, or not at all."""
    lines = {
        "(a) ⇒ (c)": ("model.yaml", "d/dt (m (x ẏ − y ẋ)) = x (m ÿ + k y) {} y (m ẍ + k x)", "−+"),
        "(b) ⇒ (d)": ("polar.yaml", "d/dt (m r^2 φ̇) = m r (r φ̈ {} 2 ṙ φ̇)", "+−"),
        "(a) ⇒ (f)": ("model.yaml", "d/dt (m (ẋ^2 + ẏ^2)/2 + k (x^2 + y^2)/2) = ẋ (m ẍ + k x) {} ẏ (m ÿ + k y)", "+−"),
        "(b) ⇒ (g)": (
            "polar.yaml",
            "d/dt (m (ṙ^2 + r^2 φ̇^2)/2 + k r^2/2) = ṙ (m (r̈ − r φ̇^2) + k r) {} m r φ̇ (r φ̈ + 2 ṙ φ̇)",
            "+−",
        ),
    }
    for label, (file, line, signs) in lines.items():
        verdicts = [case.mechanism(file).check(line.format(sign)) for sign in signs]
        value = [verdict.ok and "the same by themselves" in verdict.reason for verdict in verdicts]
        says = f"{label}: {line.format(signs[0])}." if value[0] else f"{label} does not follow."
        yield Answer(label, value, "", [True, False], "closed form: derivative of a product", 0.0, says=says)


@ask("(f, g) Is the energy conserved?")
def energy(case):
    """½m v² + ½k r² keeps its first value."""
    start = M / 2 * V0 @ V0 + K / 2 * R0 @ R0
    for file, part in (("model.yaml", "(f)"), ("polar.yaml", "(g)")):
        values, says = case.run(file).evaluate("energy()", TIMES), f"{part} At 1, 2, 5, 10 s it is {{}}."
        yield Answer(part, values, "J", [start] * len(TIMES), "its value at the start", 1e-10, says=says)


@ask("(i) What is the general motion, and what are all possible paths, as consequences of the equations of motion?")
def general(case):
    """By `check`, from any start: the motion; that the path A x² − 2B xy + C y² = h² keeps its A, B, C and h, and that it is closed,
    AC − B² ≥ 0: an ellipse, or with h = 0 a segment; a circle where ẋ = −ωy, ẏ = ωx. Each beside the same with another sign."""
    letters = {
        "ω": "sqrt(k/m)",
        "A": "rate(y)^2 + k/m*y^2",
        "B": "rate(x)*rate(y) + k/m*x*y",
        "C": "rate(x)^2 + k/m*x^2",
        "h": "x*rate(y) - y*rate(x)",
    }
    lines = {
        "if from the start: x = x0 cos(ω t) {} vx0/ω sin(ω t)": ("+−", "The motion is x = x0 cos ωt + (vx0/ω) sin ωt,"),
        "if from the start: y = y0 cos(ω t) {} vy0/ω sin(ω t)": ("+−", "y = y0 cos ωt + (vy0/ω) sin ωt."),
        "A x^2 {} 2 B x y + C y^2 = h^2": ("−+", "Its path is A x² − 2B xy + C y² = h²,"),
        "constant: ẏ^2 {} ω^2 y^2": ("+−", "of which A = ẏ² + ω²y² is constant,"),
        "constant: ẋ ẏ {} ω^2 x y": ("+−", "B = ẋẏ + ω²xy,"),
        "constant: ẋ^2 {} ω^2 x^2": ("+−", "C = ẋ² + ω²x²"),
        "constant: x ẏ {} y ẋ": ("−+", "and h = xẏ − yẋ, too."),
        "A C {} B^2 = ω^2 h^2": ("−+", "AC − B² = ω²h² is never below 0: it is an ellipse;"),
        "if x ẏ {} y ẋ = 0: constant: y/x": ("−+", "where h = 0, a segment, y/x constant;"),
        "if ẋ = {}ω y, ẏ = ω x: constant: x^2 + y^2": ("−+", "where ẋ = −ωy, ẏ = ωx, a circle."),
    }
    for line, (signs, says) in lines.items():
        value = [case.mechanism().check(line.format(sign), letters=letters).ok for sign in signs]
        yield Answer(line, value, "", [True, False], "closed form: two harmonic motions", 0.0, says=says)


@ask("(i) What are this motion and the axes of its path?")
def paths(case):
    against = "closed form: r₀ cos ωt + (v₀/ω) sin ωt"
    for file in ("model.yaml", "polar.yaml"):
        run = case.run(file)
        for text, i in [("x(P.centre)", 0), ("y(P.centre)", 1)]:
            yield Answer(
                f"{'xy'[i]} at 1, 2, 5, 10 s",
                run.evaluate(text, TIMES),
                "m",
                [place(t)[i] for t in TIMES],
                against,
                1e-9,
                variant=VARIANTS[file],
            )

    longer, shorter = np.linalg.svd(np.column_stack([R0, V0 / W]), compute_uv=False)
    run = case.run()
    against = "closed form: singular values of [r₀, v₀/ω]"
    yield Answer("long half axis", run.report["greatest distance"].value, "m", longer, against, 1e-9)
    yield Answer("short half axis", run.report["least distance"].value, "m", shorter, against, 1e-9)
    once = [run.evaluate(text, 2 * pi / W) for text in ("x", "y", "rate(x)", "rate(y)")]
    yield Answer("x, y, ẋ, ẏ after 2π/ω", once, "m, m/s", [*R0, *V0], "closed form: every path closes after 2π/ω", 1e-9)

    circle = case.run(parameters={"vx0": -W * R0[1], "vy0": W * R0[0]})
    extremes = [circle.report[f"{which} distance"].value for which in ("least", "greatest")]
    yield Answer(
        "distance", extremes, "m", [hypot(*R0)] * 2, "closed form: |v₀| = ω|r₀|", 1e-9, variant="r₀ ⟂ v₀, |v₀| = ω|r₀|: a circle"
    )


@ask("(j) Can it go back and forth on an oblique line?")
def oblique(case):
    """With v₀ = λ r₀ the motion is r₀ (cos ωt + (λ/ω) sin ωt): both components keep their ratio."""
    lam = 0.7
    run = case.run(parameters={"vx0": lam * R0[0], "vy0": lam * R0[1]})
    along = [cos(W * t) + lam / W * sin(W * t) for t in TIMES]
    size, across = hypot(*R0), atan2(R0[1], R0[0])
    u, v = f"x*{cos(across)!r} + y*{sin(across)!r}", f"y*{cos(across)!r} - x*{sin(across)!r}"
    against = "closed form: r₀ (cos ωt + (λ/ω) sin ωt)"
    says = "Yes, with v₀ along r₀: at 1, 2, 5, 10 s it is {} off the line."
    yield Answer("off the line", run.evaluate(v, TIMES), "m", [0.0] * len(TIMES), against, 1e-12, size, says=says)
    yield Answer("along the line", run.evaluate(u, TIMES), "m", [size * a for a in along], against, 1e-9)


def finite(D):
    """Rates of (x, y, ẋ, ẏ) with springs of rest length D from (−D, 0) and (0, −D)."""

    def rates(_t, s):
        x, y, vx, vy = s
        ax, ay = 0.0, 0.0
        for dx, dy in [(x + D, y), (x, y + D)]:
            size = hypot(dx, dy)
            pull = K / M * (size - D) / size
            ax, ay = ax - pull * dx, ay - pull * dy
        return vx, vy, ax, ay

    return rates


def first_order():
    """Limit of D (r_D − r) at 2 s as D → ∞, by quadrature.

    A spring from (−D, 0) is longer by x + y²/2D and tilted by y/D, up to 1/D²: its pull is −k(x + y²/2D) along x
    and −kxy/D along y; the other one likewise. The deviation D(r_D − r) = δ obeys δ̈ + ω²δ = −ω²(y²/2 + xy, x²/2 + xy)
    on the ideal motion, from rest at 0, so δ(T) = ∫₀ᵀ sin ω(T − t)/ω · (right side) dt.
    """
    from scipy.integrate import quad

    def part(i):
        def integrand(t):
            own, other = place(t)[i], place(t)[1 - i]
            return -W * sin(W * (2 - t)) * (other**2 / 2 + own * other)

        return quad(integrand, 0, 2, epsabs=0, epsrel=1e-10)[0]

    return np.array([part(0), part(1)])


@ask("Where is it at 2 s, with springs of finite length, too, and how fast do these approach the ideal?")
def long_springs(case):
    texts = ("x", "y", "rate(x)", "rate(y)")
    ideal = np.array([case.run().evaluate(text, 2.0) for text in texts])
    yield Answer("x, y, ẋ, ẏ", ideal, "m, m/s", [*place(2), *speeds(2)], "closed form", 1e-10)
    gaps = {}
    for D in (50.0, 5000.0):
        run = case.run("finite.yaml", parameters={"D": D})
        state = np.array([run.evaluate(text, 2.0) for text in texts])
        gaps[D] = state[:2] - ideal[:2]
        check = motion(finite(D), [*R0, *V0], [2.0])[0]
        against = "other route: balances by hand, SciPy"
        yield Answer("x, y, ẋ, ẏ", state, "m, m/s", check, against, 1e-9, variant=f"D = {D:g} m")
    order = np.log(np.linalg.norm(gaps[50.0]) / np.linalg.norm(gaps[5000.0])) / np.log(100)
    yield Answer("order", order, "", 1.0, "closed form: first order", 1e-2, says="The difference falls with the power {} of 1/D.")
    yield Answer("difference in x and y times D", 5000 * gaps[5000.0], "m²", first_order(), "quadrature", 1e-3)
