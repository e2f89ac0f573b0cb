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
    ", g = 10": ("model.yaml", {"g": 10.0}),
    ", tied to the ceiling": ("ceiling.yaml", {}),
    ", B to the left": ("model.yaml", {"side": -1}),
    ", to the left and the ceiling, g = 10": ("ceiling.yaml", {"side": -1, "g": 10.0}),
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


@ask("Just before the cut")
def before(case):
    for name, (file, parameters) in CASES.items():
        now, g = case.instant(file, parameters, before="start"), gravity(parameters)
        value = [now[text] for text in ("AB.tension", "BC.tension", "rail.Fy")]
        carried = M if file == "model.yaml" else MC
        yield Answer(f"tensions of AB and BC, force of the rail{name}", value, "N", [0, MB * g, carried * g], STATICS, 1e-13)


@ask("Just after the cut")
def after(case):
    for name, (file, parameters) in CASES.items():
        run, g = case.run(file, parameters), gravity(parameters)
        value = [run.evaluate(text, 0.0) for text in ("AB.tension", "rail.Fy")]
        free = "closed form: B falls freely"
        yield Answer(f"tension of AB, force of the rail{name}", value, "N", [0, MC * g], free, 1e-13)
        value = [run.evaluate(text, 0.0) for text in ("accel(x)", "ax(bob.B)", "ay(bob.B)")]
        yield Answer(f"acceleration of the cart and of B{name}", value, "m/s²", [0, 0, -g], free, 1e-13)


@ask("(a–d) AB is vertical for the first time")
def vertical(case):
    for name, (file, parameters) in CASES.items():
        run, g, side = case.run(file, parameters), gravity(parameters), parameters.get("side", 1)
        event = run.events[-1]
        yield Answer(f"(a) displacement of the cart{name}", event.q["x"], "m", side * MB * R / M, CONSERVED, 1e-11)
        speed = sqrt(2 * g * R * MB**2 / (MC * M))
        yield Answer(f"(b) its velocity{name}", event.u["x"], "m/s", side * speed, CONSERVED, 1e-11)
        pull = MB * g + MB * (speed + MC / MB * speed) ** 2 / R
        yield Answer(f"(c) tension{name}", run.evaluate("AB.tension", event.t), "N", pull, CONSERVED, 1e-11)

        def share(u, g=g):
            phi = u**2
            return 2 * u * sqrt(R * (cos(phi) ** 2 + MC / M * sin(phi) ** 2) / (2 * g * sin(phi)))

        time = quad(share, 0, sqrt(pi / 2), epsabs=0, epsrel=1e-13)[0]
        yield Answer(f"(d) time{name}", event.t, "s", time, "quadrature", 1e-11)


@ask("State and tension 0.3 s after the cut")
def later(case):
    for name, (file, parameters) in CASES.items():
        run, g, side = case.run(file, parameters), gravity(parameters), parameters.get("side", 1)
        rates, other = swing(g), "other route: one equation in φ, integrated by SciPy"
        phi, omega = reference.motion(rates, [0, 0], [0.3])[0]
        c, s = cos(phi), sin(phi)
        value = [run.evaluate(text, 0.3) for text in ("x", "bob.x - x", "bob.y")]
        check = [side * MB * R / M * (1 - c), side * R * c, -R * s]
        yield Answer(f"place of the cart, of B from it, height of B{name}", value, "m", check, other, 1e-11)
        value = [run.evaluate(text, 0.3) for text in ("rate(x)", "rate(bob.x - x)", "vy(bob.B)")]
        check = [side * MB * R / M * s * omega, -side * R * s * omega, -R * c * omega]
        yield Answer(f"their rates{name}", value, "m/s", check, other, 1e-11)
        turning = rates(0, [phi, omega])[1]
        pull = MB * (g - R * (c * turning - s * omega**2)) / s
        yield Answer(f"tension{name}", run.evaluate("AB.tension", 0.3), "N", pull, other, 1e-10)
