"""19.3.9: collar flung off a rod.

I = m_R ℓ²/3 about the hinge, m = m_C. Nothing turns the whole about the hinge: (I + mR²)θ̇ = (I + ma²)ω₁. With the
energy, ½(I + mR²)θ̇² + ½mṘ² = ½(I + ma²)ω₁², this gives Ṙ² = ω₁²(I + ma²)(R² − a²)/(I + mR²). With R = a cosh u the
start is no longer singular:
    dt/du = √((I + mR²)/(I + ma²))/ω₁,   dθ/du = √((I + ma²)/(I + mR²)),
both plain quadratures up to cosh u = ℓ/a. After the exit no force acts on the collar.
For m_R = 0 the rod cannot push (its moment about the hinge must vanish): the collar goes straight on along x = a.
"""

from math import acosh, cos, cosh, hypot, sin, sqrt

from scipy.integrate import quad

from freebody.catalogue import Answer, ask

MC, A, L, W = 3.0, 1.0, 3.0, 1.0


class Exit:
    """Time, place and speeds at R = ℓ by quadrature, for a rod of mass m_R."""

    def __init__(self, mR):
        inertia = mR * L**2 / 3

        def ratio(u):
            return (inertia + MC * (A * cosh(u)) ** 2) / (inertia + MC * A**2)

        end = acosh(L / A)
        self.t = quad(lambda u: sqrt(ratio(u)) / W, 0, end, epsabs=0, epsrel=1e-13)[0]
        self.theta = quad(lambda u: 1 / sqrt(ratio(u)), 0, end, epsabs=0, epsrel=1e-13)[0]
        self.omega = W / ratio(end)
        self.Rdot = W * sqrt((L**2 - A**2) / ratio(end))
        self.speed = hypot(self.Rdot, L * self.omega)
        c, s = cos(self.theta), sin(self.theta)
        self.place = [L * c, L * s]
        self.velocity = [self.Rdot * c - L * self.omega * s, self.Rdot * s + L * self.omega * c]


@ask("String tension before the cut")
def tension(case):
    """The collar goes around on a circle: T = m_C a ω₁², whatever the rod's mass."""
    for mR in (1.0, 0.0):
        value = case.instant("tied.yaml", {"mR": mR})["string.tension"]
        yield Answer(f"m_R = {mR:g}", value, "N", MC * A * W**2, "closed form: m_C a ω₁²", 1e-12)


@ask("(a) The collar at the end of the rod; its velocity stays as it is then")
def leaves(case):
    for mR in (1.0, 0.0):
        run, exit_ = case.run(parameters={"mR": mR}), Exit(mR)
        event = run.events[-1]
        velocity = [run.evaluate(text, event.t) for text in ("vx(collar.centre)", "vy(collar.centre)")]
        place = [run.evaluate(text, event.t) for text in ("x(collar.centre)", "y(collar.centre)")]
        against, of = "quadrature", f"m_R = {mR:g}"
        yield Answer(f"speed, {of}", hypot(*velocity), "m/s", exit_.speed, "conservation", 1e-10)
        yield Answer(f"Ṙ, {of}", event.u["R"], "m/s", exit_.Rdot, "conservation", 1e-10)
        yield Answer(f"spin of the rod, then and after, {of}", event.u["theta"], "rad/s", exit_.omega, "conservation", 1e-10)
        yield Answer(f"time, {of}", event.t, "s", exit_.t, against, 1e-10)
        yield Answer(f"angle, {of}", event.q["theta"], "rad", exit_.theta, against, 1e-10)
        yield Answer(f"position, {of}", place, "m", exit_.place, against, 1e-10)
        yield Answer(f"velocity, {of}", velocity, "m/s", exit_.velocity, against, 1e-10)


@ask("(b) Path of the collar on a rod without mass")
def straight(case):
    run = case.run(parameters={"mR": 0.0})
    end = run.events[-1].t
    times = [end * i / 4 for i in range(5)]
    against = "closed form: straight on from the cut"
    yield Answer("x at five times up to the exit", run.evaluate("x(collar.centre)", times), "m", [A] * 5, against, 1e-10)
    yield Answer("y at these times", run.evaluate("y(collar.centre)", times), "m", [A * W * t for t in times], against, 1e-10)
    yield Answer("time of the exit", end, "s", sqrt(L**2 - A**2) / (A * W), against, 1e-10)
    pushes = run.evaluate("track.Fn", times)
    yield Answer("force of the rod on the collar", pushes, "N", [0.0] * 5, against, 1e-10, MC * A * W**2)
