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
from freebody.symbolic.printers.text import text
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


ANGLES = (10, 75, 140, 250)
BALANCES = "closed form: one balance after another"


@ask("What is each part's motion as a function of the crank angle, the crank at 80 rad/s?")
def parts(case):
    for degrees in ANGLES:
        theta, rate, at = math.radians(degrees), 80.0, f"at {degrees}°"
        now, engine = case.instant(theta_c=theta), Engine(theta)
        turning = acceleration(theta, rate)
        piston = engine.piston[1] * turning + engine.piston[2] * rate**2
        against, says = "closed form: triangle", "The piston is at {}."
        yield Answer("height of the piston", now["h"], "m", engine.piston[0].imag, against, 1e-13, says=says, variant=at)
        against, says = "closed form: triangle, differentiated", "It moves up at {}."
        yield Answer("its speed", now["rate(h)"], "m/s", engine.piston[1].imag * rate, against, 1e-12, says=says, variant=at)
        says = "Its acceleration is {}."
        yield Answer("its acceleration", now["accel(h)"], "m/s²", piston.imag, against, 1e-12, says=says, variant=at)
        spins = [now[f"omega({body})"] for body in ("rod", "crank", "shaft", "wheel")]
        check = [engine.psi[1] * rate, -rate, rate / 3, -rate / 12]
        against, says = "closed form: triangle, gear ratios", "Rod, crank, shaft and wheel turn at {}, {}, {} and {}."
        yield Answer("spins", spins, "rad/s", check, against, 1e-12, says=says, variant=at)


@ask("What are each part's rate by that of the crank, and the one equation of motion, symbolically?")
def symbolically(case):
    """The rod's centre is at x + r sin θ − l/2 sin ψ, r cos θ + l/2 cos ψ; k are rates for θ̇ = 1, c accelerations for θ̈ = 0."""
    found = case.mechanism().solve_in_letters(["theta_c"])
    across, up = "(R/12 + r*cos(theta_c) - l*cos(psi)*k_psi/2)", "(-r*sin(theta_c) - l*sin(psi)*k_psi/2)"
    aside = "(-r*sin(theta_c)*rate(theta_c)^2 + l*sin(psi)*rate(psi)^2/2 - l*cos(psi)*c_psi/2)"
    down = "(-r*cos(theta_c)*rate(theta_c)^2 - l*cos(psi)*rate(psi)^2/2 - l*sin(psi)*c_psi/2)"
    shift = "whole*(R/12)^2 + J_crank + J_shaft/9 + J_wheel/144"
    rod = f"m_rod*({across}^2 - (R/12)^2 + {up}^2 + l^2*k_psi^2/12)"
    load = (
        f"-resistance*R/12 - (m_piston*(g + c_h) + gas*sin(theta_c))*k_h"
        f" - m_rod*({across}*{aside} + {up}*({down} + g) + l^2*k_psi*c_psi/12)"
    )
    closed = {"k_psi": "r*cos(theta_c)/(l*cos(psi))", "k_h": "-r*sin(theta_c) - l*sin(psi)*k_psi"}
    for name, formed in closed.items():
        label = text(Sym(name), found.letters)
        yield formula(label, found.named[Sym(name)], formed, "closed form: the loop, differentiated", found.letters)
    whole = f"({load})/({shift} + m_piston*k_h^2 + {rod})"
    label = text(Sym("theta_c", 2), found.letters)
    yield formula(label, found["theta_c"], whole, "closed form: power of loads and inertia", found.letters)


@ask("What inertia is felt at the crank, and how does it accelerate at 80 rad/s?")
def equation(case):
    """Kinetic energy is J θ̇²/2."""
    for degrees in ANGLES:
        theta, at = math.radians(degrees), f"at {degrees}°"
        now = case.instant(theta_c=theta)
        value, against = 2 * now["kinetic()"] / 80**2, "closed form: sum over the parts"
        yield Answer("J", value, "kg·m²", Engine(theta).inertia()[1], against, 1e-12, says="J is {}.", variant=at)
        value, check, says = now["accel(theta_c)"], acceleration(theta, 80.0), "θ̈ is {}."
        yield Answer("θ̈", value, "rad/s²", check, "closed form: power balance", 1e-11, says=says, variant=at)


@ask("What do bearings, piston side, teeth and road carry at the start?")
def start(case):
    """The road's and the axle's upward force are not determined: the car is held level as well."""
    now, hand = case.instant(), forces(START, 80.0, acceleration(START, 80.0))
    pushes = {
        "small end": "The rod pushes the piston with ({}, {}).",
        "big end": "The crank pushes the rod with ({}, {}).",
        "main": "The main bearing pushes the crank with ({}, {}).",
        "countershaft": "The shaft's bearing pushes the shaft with ({}, {}).",
    }
    for name, says in pushes.items():
        value = [now[f"'{name}'.Fx"], now[f"'{name}'.Fy"]]
        yield Answer(name, value, "N", [hand[name].real, hand[name].imag], BALANCES, 1e-11, says=says)
    says = "The guide pushes the piston forward with {}."
    yield Answer("guide", now["guide.Fx"], "N", hand["guide"], BALANCES, 1e-11, says=says)
    value = [now["'first gear pair'.F"], now["'second gear pair'.F"]]
    says = "The teeth of the first pair carry {}, those of the second {}."
    yield Answer("teeth", value, "N", hand["teeth"], BALANCES, 1e-11, says=says)
    says = "The car pushes the wheel forward with {}."
    yield Answer("axle", now["axle.Fx"], "N", hand["axle"], BALANCES, 1e-11, says=says)
    road, says = now["road.Fx"], "The road pushes the wheel forward with {}."
    yield Answer("road", road, "N", hand["road"], BALANCES, 1e-11, says=says)
    whole = now["alpha(wheel)"] * -R * WHOLE + 150 + ROD * (now["ax(rod.G)"] - now["ax(car.origin)"])
    says = "That is what the whole takes."
    yield Answer(
        "road and the whole", road, "N", whole, "momentum of the whole with the accelerations found", own=True, says=says
    )
    free = [known for name in ("road", "axle") for known in now.reactions[name].determined[1:2]]
    says = "Whether the upward forces of road and axle are determinate: {}."
    against = "statics: the car held level carries them, too"
    yield Answer("upward forces", free, check=[False, False], against=against, tolerance=0.0, says=says)


@ask("How does it move for 1 s?")
def drive(case):
    run = case.run()
    check = motion(lambda t, y: [y[1], acceleration(*y)], [START, 80.0], TIMES, kink=top_dead_centre)
    against = "other route: power balance, integrated by SciPy"
    yield Answer("θ at 0.1, 0.2, 0.5, 1 s", run.evaluate("theta_c", TIMES), "rad", check[:, 0], against, 1e-10)
    yield Answer("θ̇ then", run.evaluate("rate(theta_c)", TIMES), "rad/s", check[:, 1], against, 1e-10)
    yield Answer("speed of the car then", run.evaluate("rate(x)", TIMES), "m/s", KAPPA * check[:, 1], against, 1e-10)


@ask("What is the energy ledger of that second?")
def ledger(case):
    """The gas gives what the sum takes: its work is integrated along the other route's motion."""
    run = case.run()

    def rates(t, y):
        return [y[1], acceleration(y[0], y[1]), -gas(y[0]) * Engine(y[0]).piston[1].imag * y[1]]

    check = motion(rates, [START, 80.0, 0.0], TIMES, kink=top_dead_centre)
    against = "other route: power balance, integrated by SciPy"
    turned = check[:, 0] - START
    yield Answer("work of the gas until 0.1, 0.2, 0.5, 1 s", run.evaluate("gas.work", TIMES), "J", check[:, 2], against, 1e-9)
    value = run.evaluate("resistance.work", TIMES)
    yield Answer("work of the resistance", value, "J", -150 * KAPPA * turned, against, 1e-10)
    inertias = np.array([Engine(theta).inertia()[1] for theta in check[:, 0]])
    value = run.evaluate("kinetic()", TIMES)
    yield Answer("kinetic energy", value, "J", inertias * check[:, 1] ** 2 / 2, against, 1e-9)


@ask("How does it move for 1 s with an elastic driveshaft of 400 N·m/rad, two degrees of freedom?")
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
    yield Answer("θ at 0.1, 0.2, 0.5, 1 s", run.evaluate("theta_c", TIMES), "rad", check[:, 0], against, 1e-10)
    twist = check[:, 0] - check[:, 1] - START
    yield Answer("twist then", run.evaluate("theta_c - chi", TIMES) - START, "rad", twist, against, 1e-8)
    yield Answer("speed of the car then", run.evaluate("rate(x)", TIMES), "m/s", KAPPA * check[:, 3], against, 1e-10)
    every = np.linspace(0.01, 1, 100)
    lugs = run.evaluate("theta_c - chi", every) - START
    check = motion(rates, [START, 0, 80, 80], every, kink=top_dead_centre)
    twist, says = check[:, 0] - check[:, 1] - START, "Of a hundred instants the twist is {} at least, {} at most: it lugs."
    yield Answer("lugging", [lugs.min(), lugs.max()], "rad", [twist.min(), twist.max()], against, 1e-8, says=says)
