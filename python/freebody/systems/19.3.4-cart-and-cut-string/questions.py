"""Cart and pendulum after a string is cut.

Before the cut BC carries the weight and AB nothing. φ is the angle of AB below the horizontal, M = m_C + m_B. Nothing pushes the
whole sideways, so the cart is at x = (m_B r/M)(1 − cos φ) on the side of B, and
    ½ m_B r² (cos²φ + (m_C/M) sin²φ) φ̇² = m_B g r sin φ.
When AB is vertical, m_C v = m_B v_B and m_C v² + m_B v_B² = 2 m_B g r. The cart does not accelerate then: T − m_B g = m_B (v + v_B)²/r.
The time is a quadrature; with φ = u² the start is no longer singular. To a side the strings pull only: T = m_B(g + ÿ)/sin φ.
Where BC is tied, to the cart or to the ceiling, matters before the cut alone.
"""

from math import cos, pi, sin, sqrt

from scipy.integrate import quad

from freebody.catalogue import Answer, ask, reference

MC, MB, R = 12.0, 6.0, 1.0
M = MC + MB
CASES = {
    "": ("model.yaml", {}),
    "g = 10": ("model.yaml", {"g": 10.0}),
    "tied to the ceiling": ("ceiling.yaml", {}),
    "B to the left": ("model.yaml", {"side": -1}),
    "B to the left, tied to the ceiling, g = 10": ("ceiling.yaml", {"side": -1, "g": 10.0}),
}
CONSERVED, STATICS = "conservation", "statics"


def gravity(parameters):
    return parameters.get("g", 9.81)


def swing(g):
    """Rates of (φ, φ̇): the energy, differentiated."""

    def rates(t, y):
        c, s = cos(y[0]), sin(y[0])
        inertia, slope = c**2 + MC / M * s**2, -2 * c * s * MB / M
        return [y[1], (g / R * c - slope * y[1] ** 2 / 2) / inertia]

    return rates


@ask("What do the strings and the rail carry just before the cut?")
def before(case):
    for variant, (file, parameters) in CASES.items():
        now, g = case.instant(file, parameters, before="start"), gravity(parameters)
        value = [now[text] for text in ("AB.tension", "BC.tension", "rail.Fy")]
        carried = M if file == "model.yaml" else MC
        says = "AB {}, BC {}, the rail {}."
        yield Answer("AB, BC, rail", value, "N", [0, MB * g, carried * g], STATICS, 1e-13, says=says, variant=variant)


@ask("What happens just after the cut?")
def after(case):
    free = "closed form: B falls freely"
    for variant, (file, parameters) in CASES.items():
        run, g = case.run(file, parameters), gravity(parameters)
        value = [run.evaluate(text, 0.0) for text in ("accel(x)", "ax(bob.B)", "ay(bob.B)")]
        says = "The cart accelerates at {}, B at {} along x and {} along y."
        yield Answer(
            "ẍ of the cart, ẍ and ÿ of B", value, "m/s²", [0, 0, -g], free, 1e-13, says=says * (not variant), variant=variant
        )
        value = [run.evaluate(text, 0.0) for text in ("AB.tension", "rail.Fy")]
        says = "AB pulls with {}, the rail pushes with {}."
        yield Answer("AB and rail", value, "N", [0, MC * g], free, 1e-13, says=says * (not variant), variant=variant)


def time_to_vertical(g):
    def share(u):
        phi = u**2
        return 2 * u * sqrt(R * (cos(phi) ** 2 + MC / M * sin(phi) ** 2) / (2 * g * sin(phi)))

    return quad(share, 0, sqrt(pi / 2), epsabs=0, epsrel=1e-13)[0]


@ask("At the moment when AB is first vertical: (a) where is the cart, (b) how fast, (c) what does AB carry, (d) when is it?")
def vertical(case):
    for variant, (file, parameters) in CASES.items():
        run, g, side = case.run(file, parameters), gravity(parameters), parameters.get("side", 1)
        event, speed = run.events[-1], sqrt(2 * g * R * MB**2 / (MC * M))
        pull = MB * g + MB * (speed + MC / MB * speed) ** 2 / R
        says = "(a) The cart has moved by {}."
        yield Answer("x", event.q["x"], "m", side * MB * R / M, CONSERVED, 1e-11, says=says * (not variant), variant=variant)
        says = "(b) Its velocity is {}."
        yield Answer("ẋ", event.u["x"], "m/s", side * speed, CONSERVED, 1e-11, says=says * (not variant), variant=variant)
        says = "(c) AB carries {}."
        yield Answer(
            "T", run.evaluate("AB.tension", event.t), "N", pull, CONSERVED, 1e-11, says=says * (not variant), variant=variant
        )
        says = "(d) It is {} after the cut."
        yield Answer("t", event.t, "s", time_to_vertical(g), "quadrature", 1e-11, says=says * (not variant), variant=variant)


@ask("Where is everything 0.3 s after the cut, how fast, and what does AB carry?")
def later(case):
    other = "other route: one equation in φ, integrated by SciPy"
    for variant, (file, parameters) in CASES.items():
        run, g, side = case.run(file, parameters), gravity(parameters), parameters.get("side", 1)
        rates = swing(g)
        phi, omega = reference.motion(rates, [0, 0], [0.3])[0]
        c, s = cos(phi), sin(phi)
        value = [run.evaluate(text, 0.3) for text in ("x", "bob.x - x", "bob.y")]
        check = [side * MB * R / M * (1 - c), side * R * c, -R * s]
        says = "The cart is at {}, B is {} beside it, at the height {}."
        yield Answer("x, x_B − x, y_B", value, "m", check, other, 1e-11, says=says * (not variant), variant=variant)
        value = [run.evaluate(text, 0.3) for text in ("rate(x)", "rate(bob.x - x)", "vy(bob.B)")]
        check = [side * MB * R / M * s * omega, -side * R * s * omega, -R * c * omega]
        says = "Their rates are {}, {} and {}."
        yield Answer("their rates", value, "m/s", check, other, 1e-11, says=says * (not variant), variant=variant)
        turning = rates(0, [phi, omega])[1]
        pull = MB * (g - R * (c * turning - s * omega**2)) / s
        says = "AB carries {}."
        yield Answer("T", run.evaluate("AB.tension", 0.3), "N", pull, other, 1e-10, says=says * (not variant), variant=variant)
