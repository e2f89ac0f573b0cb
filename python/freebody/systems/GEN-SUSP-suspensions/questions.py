"""Suspensions: quarter car, half car, washing machine.

Half car: with G at (x, y), the body turned by θ and a wheel s below a place c ahead of G, its centre is at

    X = x + c cos θ + s sin θ,   Y = y + c sin θ − s cos θ,

it turns by −X/R, and so moves along x with the mass m_w + J/R². Coordinates x, y, θ, s_f, s_r, rows of derivatives by hand:

    M = diag(m, m, I, 0, 0) + Σ (m_w + J/R²) X′ᵀX′ + m_w Y′ᵀY′,   C = diag(0, 0, 0, c_f, c_r),
    K = Σ k_t Y′ᵀY′ + (m_w g + k_t (Y − R)) Y″ + diag(0, 0, 0, k_f, k_r).

The tyres stand on treads that keep below the wheel's centre: the road is as high there as it is. The motor's torque T, from the body,
has the generalized force −T (X′_r/R + θ′).

The washing machine's springs at ±45° are together as stiff along x as along y: with z = x + iy from where its weight rests,
(M + m) z̈ + c ż + k z = m e (θ̇² − iθ̈) exp iφ, φ being the direction of the unbalance; what turns the drum is not felt there.
"""

from functools import cache
from math import cos, pi, sin, sqrt

import numpy as np
from scipy.linalg import eigvals
from scipy.optimize import fsolve, minimize_scalar

from freebody.catalogue import Answer, ask
from freebody.catalogue.reference import event, motion

G = 9.81
M, K, C, M_W, K_T = 300.0, 20e3, 1.5e3, 40.0, 180e3
SCIPY = "other route: own equations, integrated by SciPy"
MATRICES = "eigenvalues of matrices by hand"
STATICS = "closed form: statics"
PLACES = ("y", "theta", "s_f", "s_r")
SAMPLES = [0.05, 0.1, 0.2, 0.5, 1.0, 2.0]


def first_order(m, c, k):
    """The eigenvalues of M q̈ + C q̇ + K q = 0."""
    n, inverse = len(m), np.linalg.inv(m)
    return eigvals(np.block([[np.zeros((n, n)), np.eye(n)], [-inverse @ k, -inverse @ c]]))


def modes(rest, values, of, tolerance=1e-9):
    """Frequencies and damping ratios of the oscillations, beside eigenvalues."""
    check = sorted((x for x in values if x.imag > 1e-6), key=abs)
    found = sorted((mode for mode in rest.modes if mode.eigenvalue.imag > 1e-6), key=lambda mode: abs(mode.eigenvalue))
    frequencies, ratios = [x.imag / (2 * pi) for x in check], [-x.real / abs(x) for x in check]
    yield Answer("frequencies", [mode.frequency for mode in found], "Hz", frequencies, MATRICES, 1e-9, variant=of)
    yield Answer("damping ratios", [mode.damping for mode in found], "", ratios, MATRICES, tolerance, variant=of)


def quarter(h=0.0, one_sided=False):
    """Rates of heights and speeds of wheel and body on a road of height h."""

    def rates(t, y):
        wheel, body, v, w = y
        tyre, strut = K_T * (h - wheel), K * (body - wheel) + C * (w - v)
        return [v, w, ((max(0.0, tyre) if one_sided else tyre) + strut) / M_W - G, -strut / M - G]

    return rates


STANDING = [-(M + M_W) * G / K_T, -(M + M_W) * G / K_T - M * G / K, 0.0, 0.0]


def highest(rates, start, of, bounds):
    """The greatest of a quantity of the states, and when."""
    found = minimize_scalar(lambda t: -of(motion(rates, start, [t])[0]), bounds=bounds, method="bounded", options={"xatol": 1e-7})
    return -found.fun, found.x


class HalfCar:
    """The half car by hand, with relaxed springs of the given lengths."""

    m, inertia, m_w, J, R, k_t = 1200.0, 1800.0, 80.0, 1.2, 0.3, 360e3
    ahead, k, c = (1.2, -1.4), (40e3, 36e3), (3e3, 2.8e3)

    def __init__(self, relaxed=(0.5, 0.5), only_pushes=False):
        self.relaxed, self.only_pushes = relaxed, only_pushes
        self.J = 0.0 if only_pushes else HalfCar.J  # smooth tyres do not turn the wheels

    def wheel(self, q, i):
        """X, Y of a wheel, their rows of derivatives, and Y″."""
        s, turn, a = q[3 + i], q[2], self.ahead[i]
        x, y, curved = np.zeros(5), np.zeros(5), np.zeros((5, 5))
        x[[0, 2, 3 + i]] = 1, -a * sin(turn) + s * cos(turn), sin(turn)
        y[[1, 2, 3 + i]] = 1, a * cos(turn) + s * sin(turn), -cos(turn)
        curved[2, 2] = -a * sin(turn) + s * cos(turn)
        curved[2, 3 + i] = curved[3 + i, 2] = sin(turn)
        return q[0] + a * cos(turn) + s * sin(turn), q[1] + a * sin(turn) - s * cos(turn), x, y, curved

    def matrices(self, q, road=(0.0, 0.0)):
        """M, C, K and the force of weights and springs."""
        mass, damping = np.diag([self.m, self.m, self.inertia, 0, 0]), np.diag([0, 0, 0, *self.c])
        stiffness, force = np.diag([0, 0, 0, *self.k]), np.array([0, -self.m * G, 0, 0, 0])
        for i in range(2):
            _, height, x, y, curved = self.wheel(q, i)
            press = self.k_t * (height - self.R - road[i])
            press = min(press, 0.0) if self.only_pushes else press
            mass = mass + (self.m_w + self.J / self.R**2) * np.outer(x, x) + self.m_w * np.outer(y, y)
            stiffness = stiffness + self.k_t * np.outer(y, y) + (self.m_w * G + press) * curved
            force = force - (self.m_w * G + press) * y
            force[3 + i] -= self.k[i] * (q[3 + i] - self.relaxed[i])
        return mass, damping, stiffness, force

    def coriolis(self, q, u):
        """Generalized force of what the wheels' centres accelerate without q̈."""
        total = np.zeros(5)
        for i in range(2):
            _, _, x, y, curved = self.wheel(q, i)
            s, turn, a = q[3 + i], q[2], self.ahead[i]
            along = -(a * cos(turn) + s * sin(turn)) * u[2] ** 2 + 2 * cos(turn) * u[2] * u[3 + i]
            total += (self.m_w + self.J / self.R**2) * along * x + self.m_w * (u @ curved @ u) * y
        return total

    @cache  # noqa: B019 - two cars
    def rest(self):
        q = np.array([0, 0.3 + self.relaxed[0], 0, *self.relaxed])
        for _ in range(12):
            _, _, stiffness, force = self.matrices(q)
            q[1:] += np.linalg.solve(stiffness[1:, 1:], force[1:])
        return q

    def rates(self, step=0.0, edge=2.2):
        """Of a car that rolls freely over a step."""

        def of(t, state):
            q, u = state[:5], state[5:]
            road = [step if self.wheel(q, i)[0] > edge else 0.0 for i in range(2)]
            mass, damping, _, force = self.matrices(q, road)
            return [*u, *np.linalg.solve(mass, force - damping @ u - self.coriolis(q, u))]

        def over(t, state):
            return (self.wheel(state[:5], 0)[0] - edge) * (self.wheel(state[:5], 1)[0] - edge)

        return of, over

    def driven(self, q, u, pull):
        """ÿ, θ̈, s̈_f, s̈_r and the torque of the motor with ẍ given."""
        mass, damping, _, force = self.matrices(q)
        torque = self.wheel(q, 1)[2] / self.R + np.array([0, 0, 1.0, 0, 0])
        right = force - damping @ u - self.coriolis(q, u) - mass[:, 0] * pull
        return np.linalg.solve(np.column_stack([mass[:, 1:], torque]), right)


NEAR = "G 0.5 m over the wheels' centres with relaxed springs"
READINGS = {
    NEAR: HalfCar((0.5, 0.5)),
    "G there as the car stands": HalfCar((0.5 + 1200 * G * 1.4 / 2.6 / 40e3, 0.5 + 1200 * G * 1.2 / 2.6 / 36e3)),
}


def half(case, car, **more):
    """The mechanism of one reading."""
    front, rear = car.relaxed
    return case.mechanism("half.yaml", d_f=front, d_r=rear, **more)


def standing(case, car):
    """Where the program finds the car at rest, to start from."""
    (rest,) = half(case, car).stability()
    return {"x": 0.0, **{name: rest.coordinates[name] for name in PLACES}}


@ask("Where do they stand in equilibrium?")
def equilibrium(case):
    (rest,) = case.mechanism().stability(z=0, z_w=0)
    yield Answer("quarter car, wheel and body", [rest.coordinates[n] for n in ("z_w", "z")], "m", STANDING[:2], STATICS, 1e-11)
    for of, car in READINGS.items():
        rest = standing(case, car)
        against, name = "statics by hand, by Newton's method", f"half car, {of}"
        yield Answer("height of G", rest["y"], "m", car.rest()[1], against, 1e-11, variant=name)
        yield Answer("pitch", rest["theta"], "rad", car.rest()[2], against, 1e-9, variant=name)
        value = [rest["s_f"], rest["s_r"]]
        yield Answer("struts", value, "m", car.rest()[3:], against, 1e-11, variant=name)
    (rest,) = case.mechanism("washer.yaml").stability(x="1 cm", theta="10 deg")
    value = [rest.coordinates[n] for n in ("x", "y", "theta")]
    yield Answer("washing machine, the unbalance below", value, "", [0, -40.5 * G / 4e3, 0], STATICS, 1e-11)


@ask("What are the modes and the damping ratios?")
def vibrations(case):
    (rest,) = case.mechanism().stability()
    values = first_order(np.diag([M_W, M]), C * np.array([[1, -1], [-1, 1]]), np.array([[K_T + K, -K], [-K, K]]))
    yield from modes(rest, values, "quarter car")
    for of, car in READINGS.items():
        (rest,) = half(case, car).stability()
        yield from modes(rest, first_order(*car.matrices(car.rest())[:3]), f"half car, {of}")
    (rest,) = case.mechanism("washer.yaml").stability()
    m, e, whole = 0.5, 0.2, 40.5
    mass = np.array([[whole, 0, m * e], [0, whole, 0], [m * e, 0, 40 * 0.25**2 / 2 + m * e**2]])
    values = first_order(mass, np.diag([40, 40, 0]), np.diag([4e3, 4e3, m * G * e]))
    yield from modes(rest, values, "washing machine", 1e-6)  # the drum's swing, of ratio 7e-9, counts as undamped


@ask("How do the cars go over a step of 0.05 m at 10 m/s?")
def step(case):
    """The quarter car is over it at t = 0; the half car's front wheel at 0.1 s, the rear wheel at 0.36 s."""
    run, check = case.run(parameters={"h": 0.05}), motion(quarter(0.05), STANDING, SAMPLES)
    heights = np.concatenate([run.evaluate("z_w", SAMPLES), run.evaluate("z", SAMPLES)])
    yield Answer("quarter car, heights of wheel, then body", heights, "m", check[:, :2].T.ravel(), SCIPY, 1e-9)
    for of, car in READINGS.items():
        start, rolling = standing(case, car), {"x": "10 m/s", **dict.fromkeys(PLACES, 0)}
        front, rear = car.relaxed
        run = case.run("half.yaml", {"d_f": front, "d_r": rear, "step": "0.05 m"}, initial={**start, "rates": rolling})
        times = [0.2, 0.3, 0.5, 1.0, 2.0]
        rates, over = car.rates(0.05)
        check = motion(rates, [*car.rest(), 10, 0, 0, 0, 0], times, kink=over)
        for i, (name, unit) in enumerate(zip(PLACES, ("m", "rad", "m", "m"), strict=True), start=1):
            label = f"{name} at 0.2, 0.3, 0.5, 1, 2 s"
            yield Answer(label, run.evaluate(name, times), unit, check[:, i], SCIPY, 1e-8, variant=f"half car, {of}")
        speed = run.evaluate("rate(x)", times)
        yield Answer("speed", speed, "m/s", check[:, 5], SCIPY, 1e-9, variant=f"half car, {of}")


@ask("How far does the half car tip back under 3 m/s² of rear traction, from rest?")
def traction(case):
    """The law of time of x acts by the turn of the rear wheel against the body."""
    for of, car in READINGS.items():
        law = {"x": {"is": "3 m/s^2", "level": "acceleration", "by": "phi_r"}}
        found = half(case, car).inverse(law, until=15.0, initial={**standing(case, car), "at_rest": True})

        def rates(t, state, car=car):
            u = np.array([3 * t, *state[4:]])
            return [*state[4:], *car.driven(np.array([0, *state[:4]]), u, 3.0)[:4]]

        rest = car.rest()[1:]
        times = [0.1, 0.3, 0.6, 1.0, 2.0]
        check = motion(rates, [*rest, 0, 0, 0, 0], times)
        name = "" if of == NEAR else of
        yield Answer("pitch at 0.1 … 2 s", found.evaluate("theta", times), "rad", check[:, 1], SCIPY, 1e-8, variant=name)
        greatest, _ = highest(rates, [*rest, 0, 0, 0, 0], lambda y: y[1], (0.3, 0.5))
        peak = found.summary("theta").greatest.value
        yield Answer("greatest pitch", peak, "rad", greatest, SCIPY, 1e-9, variant=name)
        q = np.array([0, *fsolve(lambda q, car=car: car.driven(np.array([0, *q]), np.zeros(5), 3.0)[:4], rest, xtol=1e-13)])
        balance = "statics in the frame of the car"
        yield Answer("pitch in the end", found.evaluate("theta", 15.0), "rad", q[2], balance, 1e-8, variant=name)
        torque = car.driven(q, np.zeros(5), 3.0)[4]
        given = found.evaluate("'motion of x'.force", 15.0)
        yield Answer("torque in the end", given, "N·m", torque, balance, 1e-8, variant=name)
        loads = [car.k_t * (car.R - car.wheel(q, i)[1]) for i in range(2)]
        value = [found.evaluate(f"'{end} road'.Fn", 15.0) for end in ("front", "rear")]
        says = "The road carries the front with {} then, the rear with {}."
        yield Answer("loads of the road", value, "N", loads, balance, 1e-8, says=says, variant=name)


@ask("Does the quarter car on a one-sided tyre lift off over a step of 0.15 m, and when does it come down?")
def one_sided(case):
    run, rates = case.run("one_sided.yaml"), quarter(0.15, True)
    lifts, lands = (next(c.t for c in run.changes if c.kind == kind) for kind in ("lift-off", "contact"))
    up, there = event(rates, STANDING, lambda t, y: y[0] - 0.15, 0.06)
    flight, _ = event(rates, there, lambda t, y: y[0] - 0.15 + 1e-9 * (t < 1e-3), 0.2)
    yield Answer("lift-off", lifts, "s", up, SCIPY, 1e-8, says="The wheel lifts off at {}.")
    yield Answer("landing", lands, "s", up + flight, SCIPY, 1e-6, says="It comes down at {}.")
    yield Answer(
        "greatest force", run.report["greatest force of the tyre"].value, "N", K_T * 0.15 + (M + M_W) * G, STATICS, 1e-10
    )
    top, _ = highest(rates, STANDING, lambda y: y[0], (0.04, 0.08))
    yield Answer("greatest height of the wheel", run.report["greatest height of the wheel"].value, "m", top, SCIPY, 1e-9)
    check = motion(rates, STANDING, SAMPLES, kink=lambda t, y: y[0] - 0.15)
    yield Answer("height of the body", run.evaluate("z", SAMPLES), "m", check[:, 1], SCIPY, 1e-8)


@ask("The half car on one-sided tyres over a step of 0.15 m at 10 m/s: which wheel lifts off, and when?")
def half_one_sided(case):
    """Coasting on smooth tyres, from where it stands."""
    start, times = standing(case, READINGS[NEAR]), [0.05, 0.2, 0.3, 0.5, 1.0, 2.0]
    run = case.run("half_one_sided.yaml", initial={**start, "rates": {"x": "10 m/s", **dict.fromkeys(PLACES, 0)}})
    car = HalfCar((0.5, 0.5), only_pushes=True)
    rates, edges = car.rates(0.15)

    def free(state, i):
        """Height of a tyre, not pressed in, over the road."""
        x, y = car.wheel(state[:5], i)[:2]
        return y - car.R - (0.15 if x > 2.2 else 0.0)

    def kink(t, state):
        return edges(t, state) * free(state, 0) * free(state, 1)

    begin = [*car.rest(), 10, 0, 0, 0, 0]
    check = motion(rates, begin, times, kink=kink)
    for i, (name, unit) in enumerate(zip(PLACES, ("m", "rad", "m", "m"), strict=True), start=1):
        yield Answer(f"{name} at 0.05 … 2 s", run.evaluate(name, times), unit, check[:, i], SCIPY, 1e-7)
    for i, end in enumerate(("front", "rear")):
        lifts = [c.t for c in run.changes if c.kind == "lift-off" and f"{end} tyre" in c.of]
        left = [free(motion(rates, begin, [t], kink=kink)[0], i) for t in lifts]
        says = f"The {end} wheel lifts off at {', '.join(f'{t:.6g} s' for t in lifts)}: its tyre is not pressed in then, to {{}}."
        yield Answer(end, left, "m", 0.0, SCIPY, 1e-9, 0.15, says=says)


@ask("How far does the washing machine swing through resonance, and when?")
def resonance(case):
    """It runs up through 9.9 rad/s within some turns, and swings less far than at a steady speed."""
    m, e, whole, k, c, alpha = 0.5, 0.2, 40.5, 4e3, 40.0, 10.0

    def rates(t, y):
        push = m * e * ((alpha * t) ** 2 - 1j * alpha) * np.exp(1j * (alpha * t**2 / 2 - pi / 2))
        pull = (push - c * complex(y[2], y[3]) - k * complex(y[0], y[1])) / whole
        return [y[2], y[3], pull.real, pull.imag]

    peak = case.run("washer.yaml").report["peak"]
    greatest, when = highest(rates, [0, 0, 0, 0], lambda y: abs(complex(y[0], y[1])), (1.3, 2.0))
    says = "The axle goes {} from rest at most."
    yield Answer("peak", peak.value, "m", greatest, SCIPY, 1e-9, says=says)
    yield Answer("when", peak.t, "s", when, SCIPY, 1e-5, says="That is at {}.")
    run, times = case.run("washer.yaml"), [1.0, 2.0, 5.0, 10.0]
    check = motion(rates, [0, 0, 0, 0], times)
    value = np.concatenate([run.evaluate("x", times), run.evaluate("y + (M + m)*g/k", times)])
    yield Answer("x and y from rest at 1, 2, 5, 10 s", value, "m", check[:, :2].T.ravel(), SCIPY, 1e-8)
    torque = run.evaluate("'run up'.force", times)
    lever = [m * e * np.exp(1j * (alpha * t**2 / 2 - pi / 2)) for t in times]
    pushes = [complex(*rates(t, y)[2:]) + 1j * G for t, y in zip(times, check, strict=True)]
    inertia = 40 * 0.25**2 / 2 + m * e**2
    wanted = [inertia * alpha + (arm.conjugate() * a).imag for arm, a in zip(lever, pushes, strict=True)]
    yield Answer("torque of the drive then", torque, "N·m", wanted, SCIPY, 1e-8)
    ratio = c / 2 / sqrt(k * whole)
    closed = m * e / whole / (2 * ratio * sqrt(1 - ratio**2))
    less, against = peak.value < closed, "closed form: me/(M + m)/(2ζ√(1 − ζ²))"
    yield Answer("less than at a steady speed", less, check=True, against=against, tolerance=0.0)
