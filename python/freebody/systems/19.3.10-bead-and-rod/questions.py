"""19.3.10: bead and turning rod.

I about O, start R = a, θ̇ = ω₀, Ṙ = 0. No moment acts about O and no force works:
    h = (I + mR²)θ̇ = (I + ma²)ω₀,   2E₀ = mṘ² + h²/(I + mR²).
The force of the rod on the bead along e_θ is m(Rθ̈ + 2Ṙθ̇), with θ̈ = −2mRṘθ̇/(I + mR²) from the first line: 2mṘθ̇ I/(I + mR²).
As R → ∞ all energy is the bead's, moving out: speed √(2E₀/m), θ̇ → 0, R without bound.
With R = a cosh u, dθ/du = √((I + ma²)/(I + mR²)), whose integral to ∞ is the complete elliptic integral K(k²)
with k² = I/(I + ma²) (put sinh u = tan φ): π/2 for I = 0, a straight line, and more for a heavier rod.
"""

from dataclasses import replace
from math import acosh, cosh, sqrt

from scipy.integrate import quad
from scipy.special import ellipk

from freebody.catalogue import Answer, ask, reference
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
VARIANTS = {2.0: "", 0.0: "I_O = 0", 1.0: "I_O = 1 kg m²"}


@ask("(a) What acts on the rod and on the bead, on separate free-body diagrams?")
def diagrams(case):
    """The weight is across the plane. The hinge holds the rod, and across the slot rod and bead push each other."""
    free, against = case.mechanism().free_bodies(), "statics: what each joint prevents"
    for body, loads in (("rod", ["pivot.Fx", "pivot.Fy", "track.Fn"]), ("bead", ["track.Fn"])):
        found = sorted(load.symbol for load in free.on(body))
        says = f"On the {body} act {', '.join(found)}."
        yield Answer(body, [found.count(load) for load in loads], "", [1] * len(loads), against, 0.0, says=says)
    gap, says = free.balance_gap("rod", "bead"), "Of the balances of rod and bead {} is left."
    yield Answer("left", gap, "", 0.0, "momentum of both", 1e-12, 1.0, says=says)


@ask("(c) Does conservation of angular momentum follow from the equations of rod and bead?")
def consequence(case):
    line = "follows: d/dt((I_O + m R^2) θ̇) = 0 from I_O θ̈ = −R N and m (R θ̈ + {} Ṙ θ̇) = N"
    for factor, right, variant in (("2", True, ""), ("1", False, "with Ṙ θ̇ instead of 2 Ṙ θ̇")):
        value = case.mechanism().check(line.format(factor), letters={"N": "track.Fn"}).ok
        says = "Yes: " + line.format(factor).removeprefix("follows: ") + "." if value else "It does not."
        yield Answer(
            "follows", value, "", right, "closed form: derivative of (I_O + m R²) θ̇", 0.0, 1.0, says=says, variant=variant
        )


@ask("(b) What are the equations of motion, and the force between rod and bead?")
def symbolically(case):
    closed = {
        "theta": "-2*m*R*rate(R)*rate(theta)/(I_O + m*R^2)",
        "R": "R*rate(theta)^2",
        "track.Fn": "2*I_O*m*rate(R)*rate(theta)/(I_O + m*R^2)",
    }
    yield from case.symbolically(closed, "closed form: (I_O + m R²) θ̇ is constant, no force along the slot")


@ask("What are the state and the force between rod and bead at R = 2 m?")
def at_two(case):
    for inertia in INERTIAS:
        run = case.run(parameters={"I_O": inertia})
        event = next(e for e in run.events if e.name == "far")

        def ratio(u, inertia=inertia):
            return (inertia + M * (A * cosh(u)) ** 2) / (inertia + M * A**2)

        end, k = acosh(2.0), ratio(acosh(2.0))
        omega, Rdot = W / k, W * sqrt((4 - 1) * A**2 / k)
        push = 2 * M * Rdot * omega * inertia / (inertia + 4 * M * A**2)
        of = VARIANTS[inertia]
        time = quad(lambda u: sqrt(ratio(u)) / W, 0, end, epsabs=0, epsrel=1e-13)[0]
        angle = quad(lambda u: 1 / sqrt(ratio(u)), 0, end, epsabs=0, epsrel=1e-13)[0]
        yield Answer("t", event.t, "s", time, "quadrature", 1e-10, variant=of)
        yield Answer("θ", event.q["theta"], "rad", angle, "quadrature", 1e-10, variant=of)
        yield Answer("θ̇", event.u["theta"], "rad/s", omega, "conservation", 1e-10, variant=of)
        yield Answer("Ṙ", event.u["R"], "m/s", Rdot, "conservation", 1e-10, variant=of)
        force = run.evaluate("track.Fn", event.t)
        says = "The rod pushes the bead with {} along e_θ."
        yield Answer("N", force, "N", push, "closed form: 2mṘθ̇ I/(I + mR²)", 1e-10, M * A * W**2, says=says, variant=of)


@ask("(c, e) What are angular momentum and energy, at the start and at 1, 10, 1000 s?")
def conserved(case):
    times = [0.0, 1.0, 10.0, 1000.0]
    for inertia in INERTIAS:
        run, whole = case.run(parameters={"I_O": inertia}), inertia + M * A**2
        momentum, energy = run.evaluate("angular_momentum(ground.O)", times), run.evaluate("energy()", times)
        yield Answer("h", momentum, "N·m·s", [whole * W] * 4, "conservation", 1e-9, variant=VARIANTS[inertia])
        yield Answer("E₀", energy, "J", [whole * W**2 / 2] * 4, "conservation", 1e-9, variant=VARIANTS[inertia])


@ask("(d, e) What is one equation in R, by both routes, and the energy?")
def both_routes(case):
    """The momentum of θ put into the balance of R, and the energy, differentiated."""
    mechanism = case.mechanism()
    found = eliminated(SymbolicState(mechanism.source(), mechanism.start()[0]))
    closed, against = "accel(R) - R*p_theta^2/(I_O + m*R^2)^2", "closed form: R̈ = Rh²/(I + mR²)²"
    routes = {
        "with the momentum of θ in the balance of R: 0": found.equations["R"],
        "from Ė = 0: 0": rate(found.energy, ("p_theta", "I_O", "m")),
    }
    for of, left in routes.items():
        factors, rest = coefficients(left, [Sym("R", 2)])
        answer = formula(of, add(Sym("R", 2), quotient(rest, factors[0])), closed, against)
        yield replace(answer, says=f"{of[0].upper()}{of[1:]} = {{}}.")
    energy = "m*rate(R)^2/2 + p_theta^2/(2*(I_O + m*R^2))"
    yield formula("E₀", found.energy, energy, "closed form: ½mṘ² + h²/2(I + mR²)")


@ask("(d) What R̈ does that equation give at the start and at 1, 10 s?")
def one_equation(case):
    for inertia in INERTIAS:
        run, h = case.run(parameters={"I_O": inertia}), (inertia + M * A**2) * W

        def bend(R, inertia=inertia, h=h):
            return R * h**2 / (inertia + M * R**2) ** 2

        states = reference.motion(lambda t, y, bend=bend: [y[1], bend(y[0])], [A, 0.0], [1.0, 10.0])
        check, against = [bend(A), *(bend(R) for R in states[:, 0])], "closed form: Rh²/(I + mR²)², integrated by SciPy"
        yield Answer("R̈", run.evaluate("accel(R)", [0.0, 1.0, 10.0]), "m/s²", check, against, 1e-9, variant=VARIANTS[inertia])


@ask("(f) As t → ∞, what are distance, speed, angular velocity and total angle?")
def limits(case):
    closed = "closed form: all energy in the bead; K(I/(I + ma²))"
    for inertia in INERTIAS:
        mechanism, whole, of = case.mechanism(I_O=inertia), inertia + M * A**2, VARIANTS[inertia]
        try:
            bounded, says = True, mechanism.limit("R").sentence
        except NoLimit:
            bounded, says = False, "The distance grows without bound."
        yield Answer("bounded", bounded, "", False, "closed form: R ≈ v∞ t", 0.0, 1.0, says=says, variant=of)
        checks = (
            ("rate(R)", "The speed", "m/s", W * sqrt(whole / M)),
            ("rate(theta)", "The angular velocity", "rad/s", 0.0),
            ("rate(theta)*R^2", "θ̇R²", "m²/s", whole * W / M),
            ("theta", "The total angle", "rad", ellipk(inertia / whole)),
        )
        for text, words, unit, check in checks:
            found = mechanism.limit(text)
            says = f"{words} tends to {{}}, to {found.value.error:.0e}: {found.tail}."
            yield Answer(text, found.value, unit, check, closed, 1e-9, 1.0, says=says, variant=of)
