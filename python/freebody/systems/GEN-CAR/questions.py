"""A car as one degree of freedom.

Everything follows from the crank angle θ, clockwise from top dead centre. In the car's frame (complex numbers, the
crank's axle 0) the pin is i r e^{−iθ}, the piston l i e^{iψ} further, with l sin ψ = r sin θ; the car moves by
κ θ, κ = R/12. The power balance gives

    J θ̈ + h θ̇² = Q,   J = Σ m |v|² + I w²,   h = Σ m v·v′ + I w w′,   Q = −F y′ − 150 κ − g Σ m y′,

v and w being velocities and spins by θ, a prime d/dθ, y the heights of piston and rod, F the gas force. The forces
follow from the piston down to the road, one unknown at a time.
"""

import cmath
import math
from dataclasses import dataclass

import numpy as np

from freebody.catalogue import Answer, ask
from freebody.catalogue.answers import formula
from freebody.catalogue.reference import motion
from freebody.equations import Sym
from freebody.systems._linkages import cross, dot

G, R, THROW, L = 9.81, 0.3, 0.04, 0.14
WHOLE, PISTON, ROD = 900.0, 0.5, 0.6
CRANK, SHAFT, WHEEL = 0.15, 0.01, 1.2
KAPPA, ROD_INERTIA = R / 12, ROD * L**2 / 12
START = math.radians(10)
TIMES = np.array([0.1, 0.2, 0.5, 1.0])


def gas(theta):
    return 4000 * max(0.0, math.sin(theta))


@dataclass(frozen=True)
class Engine:
    """Of piston and rod, in the car's frame: places, and first and second derivatives by the crank angle."""

    theta: float

    def __post_init__(self):
        s, c = math.sin(self.theta), math.cos(self.theta)
        psi = math.asin(THROW * s / L)
        slope = THROW * c / (L * math.cos(psi))
        bend = (L * math.sin(psi) * slope**2 - THROW * s) / (L * math.cos(psi))
        pin = 1j * THROW * cmath.exp(-1j * self.theta)
        arm = 1j * L * cmath.exp(1j * psi)
        pin1, arm1 = -1j * pin, 1j * slope * arm
        pin2, arm2 = -pin, (1j * bend - slope**2) * arm
        values = {
            "psi": (psi, slope, bend), "pin": pin, "arm": arm,
            "piston": (pin + arm, pin1 + arm1, pin2 + arm2),
            "rod": (pin + arm / 2, pin1 + arm1 / 2, pin2 + arm2 / 2),
        }  # fmt: skip
        for name, value in values.items():
            object.__setattr__(self, name, value)

    def inertia(self):
        """Felt at the crank with the car standing still; without and with the car's motion."""
        own = CRANK + PISTON * abs(self.piston[1]) ** 2 + ROD * abs(self.rod[1]) ** 2 + ROD_INERTIA * self.psi[1] ** 2
        moving = (WHOLE * KAPPA + 2 * ROD * self.rod[1].real) * KAPPA + SHAFT / 9 + WHEEL / 144
        return own, own + moving

    def h(self):
        """Of the engine in its frame; and what the car's motion adds."""
        own = (
            PISTON * dot(self.piston[1], self.piston[2])
            + ROD * dot(self.rod[1], self.rod[2])
            + ROD_INERTIA * self.psi[1] * self.psi[2]
        )
        return own, own + KAPPA * ROD * self.rod[2].real

    def force(self):
        """Q without the resistance."""
        return -gas(self.theta) * self.piston[1].imag - G * (PISTON * self.piston[1].imag + ROD * self.rod[1].imag)


def acceleration(theta, rate):
    engine = Engine(theta)
    return (engine.force() - 150 * KAPPA - engine.h()[1] * rate**2) / engine.inertia()[1]


def top_dead_centre(t, y):
    return math.sin(y[0])


def forces(theta, rate, turning):
    """From the piston down to the road."""
    engine, found = Engine(theta), {}
    car = KAPPA * turning
    piston = car + engine.piston[1] * turning + engine.piston[2] * rate**2
    rod = car + engine.rod[1] * turning + engine.rod[2] * rate**2
    up = PISTON * (piston.imag + G) + gas(theta)
    moment = cross(engine.arm / 2, ROD * (rod + 1j * G)) + ROD_INERTIA * (engine.psi[1] * turning + engine.psi[2] * rate**2)
    side = (moment + engine.arm.real * up) / engine.arm.imag
    found["small end"] = complex(side, up)  # on the piston
    found["guide"] = PISTON * car - side  # car on piston, forward
    found["big end"] = ROD * (rod + 1j * G) + found["small end"]  # on the rod
    first = -CRANK * turning + cross(engine.pin, found["big end"])  # torque of the teeth on the crank
    second = SHAFT * turning / 3 - 3 * first  # of the second pair's teeth on the shaft
    found["teeth"] = [abs(first) / (0.03 * math.cos(math.radians(20))), abs(second) / (0.03 * math.cos(math.radians(20)))]
    # Teeth push across the line of centres by the torque over the pitch radius, and apart by tan 20° of that.
    across = [-first / 0.03, -second / 0.03]
    push = [complex(abs(f) * math.tan(math.radians(20)), f) for f in across]
    found["main"] = found["big end"] - push[0]  # on the crank
    found["countershaft"] = push[0] - push[1]  # on the shaft
    found["road"] = (-WHEEL * turning / 12 - 4 * second) / R  # on the wheel, forward
    found["axle"] = push[1].real - found["road"]  # on the wheel, forward
    return found


@ask("each part's motion as a function of the crank angle")
def parts(case):
    for degrees in (10, 75, 140, 250):
        theta, rate = math.radians(degrees), 80.0
        now, engine = case.instant(thc=theta), Engine(theta)
        turning = acceleration(theta, rate)
        piston = engine.piston[1] * turning + engine.piston[2] * rate**2
        yield Answer(f"height of the piston at {degrees}°", now["h"], "m", engine.piston[0].imag, "closed form: triangle", 1e-13)
        yield Answer(
            f"its speed and acceleration at {degrees}°",
            [now["rate(h)"], now["accel(h)"]],
            "",
            [engine.piston[1].imag * rate, piston.imag],
            "closed form: triangle, differentiated",
            1e-12,
        )
        spins = [now[f"omega({body})"] for body in ("rod", "crank", "shaft", "wheel")]
        yield Answer(
            f"spin of rod, crank, shaft, wheel at {degrees}°",
            spins,
            "rad/s",
            [engine.psi[1] * rate, -rate, rate / 3, -rate / 12],
            "closed form: triangle, gear ratios",
            1e-12,
        )


@ask("symbolically:  each part's rate by that of the crank, and the one equation of motion")
def symbolically(case):
    """The rod's centre is at x + r sin θ − l/2 sin ψ, r cos θ + l/2 cos ψ; k are rates for θ̇ = 1, c accelerations for θ̈ = 0."""
    found = case.mechanism().solve_in_letters(["thc"])
    across, up = "(R/12 + r*cos(thc) - l*cos(psi)*k_psi/2)", "(-r*sin(thc) - l*sin(psi)*k_psi/2)"
    aside = "(-r*sin(thc)*rate(thc)^2 + l*sin(psi)*rate(psi)^2/2 - l*cos(psi)*c_psi/2)"
    down = "(-r*cos(thc)*rate(thc)^2 - l*cos(psi)*rate(psi)^2/2 - l*sin(psi)*c_psi/2)"
    shift = "whole*(R/12)^2 + J_crank + J_shaft/9 + J_wheel/144"
    rod = f"m_rod*({across}^2 - (R/12)^2 + {up}^2 + l^2*k_psi^2/12)"
    load = (
        f"-resistance*R/12 - (m_piston*(g + c_h) + gas*sin(thc))*k_h"
        f" - m_rod*({across}*{aside} + {up}*({down} + g) + l^2*k_psi*c_psi/12)"
    )
    closed = {"k_psi": "r*cos(thc)/(l*cos(psi))", "k_h": "-r*sin(thc) - l*sin(psi)*k_psi"}
    for name, text in closed.items():
        yield formula(name, found.named[Sym(name)], text, "closed form: the loop, differentiated", found.letters)
    whole = f"({load})/({shift} + m_piston*k_h^2 + {rod})"
    yield formula("thc′′", found["thc"], whole, "closed form: power of loads and inertia", found.letters)


@ask("inertia felt at the crank, and the equation of motion")
def equation(case):
    """Kinetic energy is J θ̇²/2."""
    for degrees in (10, 75, 140, 250):
        theta = math.radians(degrees)
        now = case.instant(thc=theta)
        yield Answer(
            f"J at {degrees}°",
            2 * now["kinetic()"] / 80**2,
            "kg·m²",
            Engine(theta).inertia()[1],
            "closed form: sum over the parts",
            1e-12,
        )
        yield Answer(
            f"θ̈ at {degrees}°", now["accel(thc)"], "rad/s²", acceleration(theta, 80.0), "closed form: power balance", 1e-11
        )


@ask("forces at the start: bearings, piston side, teeth, road")
def start(case):
    """The road's and the axle's upward force are not determined: the car is held level as well."""
    now, hand = case.instant(), forces(START, 80.0, acceleration(START, 80.0))
    for name in ("small end", "big end", "main", "countershaft"):
        yield Answer(
            name,
            [now[f"'{name}'.Fx"], now[f"'{name}'.Fy"]],
            "N",
            [hand[name].real, hand[name].imag],
            "closed form: one balance after another",
            1e-11,
        )
    yield Answer("car on piston, forward", now["guide.Fx"], "N", hand["guide"], "closed form: one balance after another", 1e-11)
    yield Answer(
        "tooth forces, first and second pair",
        [now["'first gear pair'.F"], now["'second gear pair'.F"]],
        "N",
        hand["teeth"],
        "closed form: one balance after another",
        1e-11,
    )
    yield Answer("road on wheel, forward", now["road.Fx"], "N", hand["road"], "closed form: one balance after another", 1e-11)
    yield Answer("car on wheel, forward", now["axle.Fx"], "N", hand["axle"], "closed form: one balance after another", 1e-11)
    whole = now["alpha(wheel)"] * -R * WHOLE + 150
    yield Answer(
        "the same, from the whole",
        now["road.Fx"],
        "N",
        whole + ROD * (now["ax(rod.G)"] - now["ax(car.origin)"]),
        "closed form: momentum of the whole",
        1e-11,
    )


@ask("1 s of motion")
def drive(case):
    run = case.run()
    check = motion(lambda t, y: [y[1], acceleration(*y)], [START, 80.0], TIMES, kink=top_dead_centre)
    against = "other route: power balance, integrated by SciPy"
    yield Answer("θ at 0.1, 0.2, 0.5, 1 s", run.evaluate("thc", TIMES), "rad", check[:, 0], against, 1e-10)
    yield Answer("θ̇", run.evaluate("rate(thc)", TIMES), "rad/s", check[:, 1], against, 1e-10)
    yield Answer("speed of the car", run.evaluate("rate(x)", TIMES), "m/s", KAPPA * check[:, 1], against, 1e-10)
    yield Answer(
        "work of the resistance",
        run.evaluate("resistance.work", TIMES),
        "J",
        -150 * KAPPA * (check[:, 0] - START),
        against,
        1e-10,
    )


@ask("variant: elastic driveshaft of 400 N·m/rad, two degrees of freedom")
def elastic(case):
    """The pinion turns by χ; the car moves by κ χ. Lagrange's equations of θ and χ."""

    def rates(t, y):
        theta, chi, u, v = y
        engine = Engine(theta)
        twist = 400 * (theta - chi - START)
        own, _ = engine.inertia()
        mixed = KAPPA * ROD * engine.rod[1].real
        behind = WHOLE * KAPPA**2 + SHAFT / 9 + WHEEL / 144
        h, both = engine.h()
        right = [engine.force() - h * u * u - twist, twist - 150 * KAPPA - (both - h) * u * u]
        return [u, v, *np.linalg.solve([[own, mixed], [mixed, behind]], right)]

    run = case.run("driveshaft.yaml")
    check = motion(rates, [START, 0, 80, 80], TIMES, kink=top_dead_centre)
    against = "other route: Lagrange's equations, integrated by SciPy"
    yield Answer("θ at 0.1, 0.2, 0.5, 1 s", run.evaluate("thc", TIMES), "rad", check[:, 0], against, 1e-10)
    yield Answer(
        "twist of the driveshaft",
        run.evaluate("thc - chi", TIMES) - START,
        "rad",
        check[:, 0] - check[:, 1] - START,
        against,
        1e-8,
    )
    yield Answer("speed of the car", run.evaluate("rate(x)", TIMES), "m/s", KAPPA * check[:, 3], against, 1e-10)
