"""19.3.10: bead and turning rod.

I about O, start R = a, θ̇ = ω₀, Ṙ = 0. No moment acts about O and no force works:
    h = (I + mR²)θ̇ = (I + ma²)ω₀,   2E₀ = mṘ² + h²/(I + mR²).
The force of the rod on the bead along e_θ is m(Rθ̈ + 2Ṙθ̇), with θ̈ = −2mRṘθ̇/(I + mR²) from the first line: 2mṘθ̇ I/(I + mR²).
As R → ∞ all energy is the bead's, moving out: speed √(2E₀/m), θ̇ → 0, R without bound.
With R = a cosh u, dθ/du = √((I + ma²)/(I + mR²)), whose integral to ∞ is the complete elliptic integral K(k²)
with k² = I/(I + ma²) (put sinh u = tan φ): π/2 for I = 0, a straight line, and more for a heavier rod.
"""

from math import acosh, cosh, sqrt

from scipy.integrate import quad
from scipy.special import ellipk

from freebody.catalogue import Answer, ask
from freebody.catalogue.answers import formula
from freebody.equations.solve import coefficients
from freebody.equations.topics.elimination import eliminated
from freebody.find import NoLimit
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.algebra import quotient
from freebody.symbolic.differentiate import rate
from freebody.symbolic.tree import Sym, add

M, A, W = 1.0, 1.0, 1.0
INERTIAS = (2.0, 0.0, 1.0)


@ask("(a) Separate free-body diagrams: what acts on the rod, and on the bead")
def diagrams(case):
    """The weight is across the plane. The hinge holds the rod, and across the slot rod and bead push each other."""
    free = case.mechanism().free_bodies()
    for body, loads in (("rod", ["pivot.Fx", "pivot.Fy", "track.Fn"]), ("bead", ["track.Fn"])):
        found = sorted(load.symbol for load in free.on(body))
        yield Answer(
            f"on the {body}",
            [found.count(load) for load in loads],
            "",
            [1] * len(loads),
            "statics: what each joint prevents",
            0.0,
            said=", ".join(found),
        )
    yield Answer("left of the balances of rod and bead", free.balance_gap("rod", "bead"), "", 0.0, "momentum of both", 1e-12, 1.0)


@ask("(c) Conservation of angular momentum follows from the equations of rod and bead")
def consequence(case):
    line = "follows: d/dt((I_O + m R^2) θ̇) = 0 from I_O θ̈ = −R N and m (R θ̈ + {} Ṙ θ̇) = N"
    for factor, right in (("2", 1), ("1", 0)):
        value = case.mechanism().check(line.format(factor), letters={"N": "track.Fn"}).ok
        said = "yes" if value else "no"
        yield Answer(
            f"with {factor} Ṙ θ̇ in the second", value, "", right, "closed form: derivative of (I_O + m R²) θ̇", 0.0, said=said
        )


@ask("(b) In symbols: the equations, and the force between rod and bead")
def symbolically(case):
    closed = {
        "theta": "-2*m*R*rate(R)*rate(theta)/(I_O + m*R^2)",
        "R": "R*rate(theta)^2",
        "track.Fn": "2*I_O*m*rate(R)*rate(theta)/(I_O + m*R^2)",
    }
    yield from case.symbolically(closed, "closed form: (I_O + m R²) θ̇ is constant, no force along the slot")


@ask("State and force between rod and bead at R = 2")
def at_two(case):
    for inertia in INERTIAS:
        run = case.run(parameters={"I_O": inertia})
        event = next(e for e in run.events if e.name == "far")

        def ratio(u, inertia=inertia):
            return (inertia + M * (A * cosh(u)) ** 2) / (inertia + M * A**2)

        end, k = acosh(2.0), ratio(acosh(2.0))
        omega, Rdot = W / k, W * sqrt((4 - 1) * A**2 / k)
        push = 2 * M * Rdot * omega * inertia / (inertia + 4 * M * A**2)
        of = f"I_O = {inertia:g}"
        time = quad(lambda u: sqrt(ratio(u)) / W, 0, end, epsabs=0, epsrel=1e-13)[0]
        angle = quad(lambda u: 1 / sqrt(ratio(u)), 0, end, epsabs=0, epsrel=1e-13)[0]
        yield Answer(f"time, {of}", event.t, "s", time, "quadrature", 1e-10)
        yield Answer(f"angle, {of}", event.q["theta"], "rad", angle, "quadrature", 1e-10)
        yield Answer(f"θ̇, {of}", event.u["theta"], "rad/s", omega, "conservation", 1e-10)
        yield Answer(f"Ṙ, {of}", event.u["R"], "m/s", Rdot, "conservation", 1e-10)
        force = run.evaluate("track.Fn", event.t)
        yield Answer(f"force of the rod on the bead along e_θ, {of}", force, "N", push, "closed form", 1e-10, M * A * W**2)


@ask("(c, e) Angular momentum and energy, at the start and at 1, 10, 1000 s")
def conserved(case):
    times = [0.0, 1.0, 10.0, 1000.0]
    for inertia in INERTIAS:
        run, whole = case.run(parameters={"I_O": inertia}), inertia + M * A**2
        momentum, energy = run.evaluate("angular_momentum(ground.O)", times), run.evaluate("energy()", times)
        yield Answer(f"h, I_O = {inertia:g}", momentum, "N·m·s", [whole * W] * 4, "conservation", 1e-9)
        yield Answer(f"E₀, I_O = {inertia:g}", energy, "J", [whole * W**2 / 2] * 4, "conservation", 1e-9)


@ask("(d) One equation in R: R̈ at the start and at 1, 10 s")
def one_equation(case):
    """R̈ = Rθ̇² = Rh²/(I + mR²)², with R taken from the run."""
    times = [0.0, 1.0, 10.0]
    for inertia in INERTIAS:
        run = case.run(parameters={"I_O": inertia})
        h = (inertia + M * A**2) * W
        check = [R * h**2 / (inertia + M * R**2) ** 2 for R in run.evaluate("R", times)]
        yield Answer(f"R̈, I_O = {inertia:g}", run.evaluate("accel(R)", times), "m/s²", check, "closed form: Rh²/(I + mR²)²", 1e-9)


@ask("(d) One equation in R in symbols, by both routes: what is left of Lagrange's equations, and (e) the energy, differentiated")
def both_routes(case):
    mechanism = case.mechanism()
    found = eliminated(SymbolicState(mechanism.source(), mechanism.start()[0]))
    energy = "m*rate(R)^2/2 + p_theta^2/(2*(I_O + m*R^2))"
    yield formula("(e) E₀", found.energy, energy, "closed form: ½mṘ² + h²/2(I + mR²)")
    closed, against = "accel(R) - R*p_theta^2/(I_O + m*R^2)^2", "closed form: R̈ = Rh²/(I + mR²)²"
    routes = {
        "momentum of θ put into the balance of R": found.equations["R"],
        "Ė = 0": rate(found.energy, ("p_theta", "I_O", "m")),
    }
    for of, left in routes.items():
        factors, rest = coefficients(left, [Sym("R", 2)])
        bare = add(Sym("R", 2), quotient(rest, factors[0]))
        yield formula(f"0 = R̈ + …, {of}", bare, closed, against)


@ask("(f) As t → ∞: distance, speed, angular velocity, total angle")
def limits(case):
    for inertia in INERTIAS:
        mechanism, whole = case.mechanism(I_O=inertia), inertia + M * A**2
        closed = "closed form: all energy in the bead; K(I/(I + ma²))"
        checks = (("rate(R)", "speed", "m/s", W * sqrt(whole / M)), ("rate(theta)", "angular velocity", "rad/s", 0.0),
                  ("rate(theta)*R^2", "θ̇R²", "m²/s", whole * W / M), ("theta", "total angle", "rad", ellipk(inertia / whole)))  # fmt: skip
        for text, of, unit, check in checks:
            found = mechanism.limit(text)
            yield Answer(f"{of}, I_O = {inertia:g}: {found.tail}", found.value, unit, check, closed, 1e-9, 1.0)
        try:
            said = mechanism.limit("R").sentence
        except NoLimit as error:
            said = str(error)
        yield Answer(f"distance, I_O = {inertia:g}", 1.0, "", 1.0, "closed form: R ≈ v∞ t without bound", said=said)
