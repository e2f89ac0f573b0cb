"""19.3.9: collar flung off a rod.

I = m_R ℓ²/3 about the hinge, m = m_C. Nothing turns the whole about the hinge: (I + mR²)θ̇ = (I + ma²)ω₁. With the
energy, ½(I + mR²)θ̇² + ½mṘ² = ½(I + ma²)ω₁², this gives Ṙ² = ω₁²(I + ma²)(R² − a²)/(I + mR²). With R = a cosh u the
start is no longer singular:
    dt/du = √((I + mR²)/(I + ma²))/ω₁,   dθ/du = √((I + ma²)/(I + mR²)),
both plain quadratures up to cosh u = ℓ/a. After the exit no force acts on the collar, no moment on the rod.
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


LEAVES = {1.0: "track leaves end", 0.0: "leaves"}
VARIANTS = {1.0: "", 0.0: "m_R = 0"}


def flung(case, mR):
    """The run from the cut on, and its exit. A rod without mass is held once the collar has left it."""
    run = case.run("model.yaml", {"mR": mR}) if mR else case.run("massless.yaml")
    return run, next(event for event in run.events if event.name == LEAVES[mR])


@ask("What does the string carry before the cut?")
def tension(case):
    """The collar goes around on a circle: T = m_C a ω₁², whatever the rod's mass. Afterwards there is none."""
    for mR in LEAVES:
        now = case.instant("model.yaml", {"mR": mR}, before="start")
        pull, says = now["string.tension"], "It carries {}."
        yield Answer("before", pull, "N", MC * A * W**2, "closed form: m_C a ω₁²", 1e-12, says=says, variant=VARIANTS[mR])
        after, says = flung(case, mR)[0].evaluate("string.tension", 0.0), "Just after it: {}."
        yield Answer("after", after, "N", 0.0, "the string is gone", 0.0, 1.0, says=says, variant=VARIANTS[mR])


@ask("(a) How fast is the collar after it has left the end, when and where is that?")
def leaves(case):
    for mR in LEAVES:
        (run, event), exit_ = flung(case, mR), Exit(mR)
        place, velocity = ([run.evaluate(f"{v}{axis}(collar.centre)", event.t) for axis in "xy"] for v in ("", "v"))
        before = event.t - 1e-9  # at the event itself the joint is gone, and its coordinate is only measured
        against, of = "quadrature", VARIANTS[mR]
        says = "Its speed is {}." if not of else ""
        yield Answer("v", hypot(*velocity), "m/s", exit_.speed, "conservation", 1e-10, says=says, variant=of)
        yield Answer("Ṙ", run.evaluate("rate(R)", before), "m/s", exit_.Rdot, "conservation", 1e-8, variant=of)
        yield Answer("θ̇", run.evaluate("omega(rod)", before), "rad/s", exit_.omega, "conservation", 1e-8, variant=of)
        yield Answer("t", event.t, "s", exit_.t, against, 1e-10, variant=of)
        yield Answer("θ", run.evaluate("theta", event.t), "rad", exit_.theta, against, 1e-10, variant=of)
        says = "It is at x = {}, y = {}."
        yield Answer("x, y", place, "m", exit_.place, against, 1e-10, says=says, variant=of)
        says = "Its velocity is {} along x and {} along y."
        yield Answer("ẋ, ẏ", velocity, "m/s", exit_.velocity, against, 1e-10, says=says, variant=of)


@ask("What happens within a second after the exit?")
def later(case):
    for mR in LEAVES:
        (run, event), exit_ = flung(case, mR), Exit(mR)
        t, against, of = event.t + 1, "closed form: straight on from the exit", VARIANTS[mR]
        place, velocity = ([run.evaluate(f"{v}{axis}(collar.centre)", t) for axis in "xy"] for v in ("", "v"))
        check = [x + v for x, v in zip(exit_.place, exit_.velocity, strict=True)]
        says = "The collar flies straight on, to x = {}, y = {}."
        yield Answer("x, y", place, "m", check, against, 1e-10, says=says, variant=of)
        yield Answer("v", hypot(*velocity), "m/s", exit_.speed, against, 1e-10, says="Its speed is {}.", variant=of)
        if mR:
            spin = run.evaluate("omega(rod)", t)
            says = "The rod turns as it did, at {}."
            yield Answer("θ̇", spin, "rad/s", exit_.omega, "conservation: no moment on it", 1e-10, says=says, variant=of)
        else:
            says = "The rod is held at {}: nothing tells it how to turn."
            yield Answer("θ", run.evaluate("theta", t), "rad", exit_.theta, "quadrature", 1e-10, says=says, variant=of)


@ask("(b) On a rod without mass, what is the path of the collar from the cut until it has left?")
def straight(case):
    run, event = flung(case, 0.0)
    times = [event.t * i / 4 for i in range(4)] + [event.t + 1, 5.0]
    against = "closed form: straight on from the cut"
    says = "A straight line: at six times, before and after it has left, x = {}."
    yield Answer("x", run.evaluate("x(collar.centre)", times), "m", [A] * 6, against, 1e-10, says=says)
    yield Answer("y at these times", run.evaluate("y(collar.centre)", times), "m", [A * W * t for t in times], against, 1e-10)
    yield Answer("t", event.t, "s", sqrt(L**2 - A**2) / (A * W), against, 1e-10, says="It leaves the rod after {}.")
    pushes = run.evaluate("track.Fn", times)
    yield Answer("force of the rod on the collar at these times", pushes, "N", [0.0] * 6, against, 1e-10, MC * A * W**2)
