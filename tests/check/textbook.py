"""Models with the equations of motion that every textbook has of them, in the symbols of the model."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Book:
    """A model, its symbols beyond coordinates and parameters, and equations that are true of it."""

    name: str
    model: str
    equations: tuple[str, ...]
    letters: tuple[tuple[str, str], ...] = ()


ROD = """
parameters: {m: 2 kg, l: 0.8 m, g: 9.81 m/s^2}
gravity: g
bodies: {rod: {shape: rod, length: l, mass: m}}
joints: {pin: {type: hinge, of: [ground.O, rod.start], coordinate: {name: theta, zero: down}}}
initial: {theta: 0.4}
"""

DOUBLE = """
parameters: {m1: 2 kg, m2: 1.2 kg, l1: 0.8 m, l2: 0.5 m, g: 9.81 m/s^2}
gravity: g
bodies: {upper: {shape: particle, mass: m1}, lower: {shape: particle, mass: m2}}
joints:
  first: {type: link, of: [ground.O, upper.centre], length: l1, coordinate: {name: theta1, zero: down}}
  second: {type: link, of: [upper.centre, lower.centre], length: l2, coordinate: {name: theta2, zero: down}}
initial: {theta1: 0.4, theta2: 0.9}
"""

CART = """
parameters: {M: 2 kg, m: 1 kg, l: 0.5 m, g: 9.81 m/s^2, F: 3 N}
gravity: g
bodies: {cart: {mass: M}, bob: {shape: particle, mass: m}}
joints:
  rail: {type: slider, along: {through: ground.O, angle: 0}, line: {through: cart.origin, angle: 0}, coordinate: x}
  rod: {type: link, of: [cart.origin, bob.centre], length: l, coordinate: {name: theta, zero: down}}
forces: {push: {type: force, at: cart.origin, x: F, y: 0}}
initial: {x: 0, theta: 0.5}
"""

BEAD = """
parameters: {m1: 1 kg, m2: 2 kg, l: 1 m, T: 1 N*m}
gravity: none
bodies: {rod: {shape: rod, length: l, mass: m1}, bead: {shape: particle, mass: m2}}
joints:
  pin: {type: hinge, of: [ground.O, rod.start], coordinate: theta}
  track: {type: slot, along: [rod.start, rod.end], point: bead.centre, coordinate: R}
forces: {motor: {type: torque, on: rod, from: ground, value: T}}
initial: {theta: 0, R: 0.3 m}
"""

ATWOOD = """
parameters: {m1: 2 kg, m2: 3 kg, r: 0.1 m, g: 9.81 m/s^2}
gravity: g
ground: {points: {P: [0, 2]}}
bodies: {left: {mass: m1}, right: {mass: m2}}
joints:
  a: {type: slider, along: {through: ground.A, angle: 90 deg}, line: {through: left.origin, angle: 90 deg}, coordinate: y1}
  b: {type: slider, along: {through: ground.B, angle: 90 deg}, line: {through: right.origin, angle: 90 deg}, coordinate: y2}
strings: {rope: {ends: [left.origin, right.origin], over: [{pulley: ground.P, radius: r, sense: clockwise}]}}
initial: {y1: 0, y2: 0, at_rest: true}
""".replace("P: [0, 2]", "P: [0, 2], A: [-r, 0], B: [r, 0]")

SLOPE = """
parameters: {m: 2 kg, mu: 0.2, a: 35 deg, g: 9.81 m/s^2}
gravity: g
bodies: {block: {mass: m}}
joints:
  ramp: {type: slider, along: {through: ground.O, angle: -a}, line: {through: block.origin, angle: 0}, coordinate: s, friction: mu}
initial: {s: 0, rates: {s: 1}}
"""

SPRING = """
parameters: {m: 2 kg, k: 80 N/m, c: 3 N*s/m, F: 5 N}
gravity: none
bodies: {block: {mass: m}}
joints: {rail: {type: slider, along: {through: ground.O, angle: 0}, line: {through: block.origin, angle: 0}, coordinate: x}}
forces:
  spring: {type: spring, along: x, stiffness: k, damping: c}
  push: {type: force, at: block.origin, x: F, y: 0}
initial: {x: 0.2}
"""

DISK = """
parameters: {m: 2 kg, r: 0.3 m, a: 25 deg, g: 9.81 m/s^2}
gravity: g
bodies: {disk: {shape: disk, radius: r, mass: m}}
joints: {contact: {type: rolling, circle: {centre: disk.centre, radius: r}, on: {through: ground.O, angle: -a}}}
initial: {at_rest: true, guess: {contact.s: 0}}
"""

ARM = """
parameters: {m1: 2 kg, m2: 1.5 kg, l1: 0.25 m, l2: 0.2 m, l3: 0.5 m, I1: 0.05 kg*m^2, I2: 0.03 kg*m^2, Ms: 2 N*m, Me: 1 N*m, g: 9.81 m/s^2}
gravity: g
bodies:
  upper: {mass: m1, inertia: I1, centre: [l1, 0], points: {E: [l3, 0]}}
  fore: {mass: m2, inertia: I2, centre: [l2, 0]}
joints:
  shoulder: {type: hinge, of: [ground.O, upper.origin], coordinate: theta1}
  elbow: {type: hinge, of: [upper.E, fore.origin], coordinate: {name: theta2, absolute: true}}
forces:
  s: {type: torque, on: upper, from: ground, value: Ms}
  e: {type: torque, on: fore, from: upper, value: Me}
initial: {theta1: -1, theta2: 0.5}
"""

WEDGE = """
parameters: {m1: 10 kg, m2: 4 kg, alpha: 30 deg, g: 9.81 m/s^2}
gravity: g
bodies: {base: {mass: m1}, top: {mass: m2}}
joints:
  floor: {type: slider, along: {through: ground.O, angle: 0}, line: {through: base.origin, angle: 0}, coordinate: x}
  face: {type: slider, along: {through: base.origin, angle: -alpha}, line: {through: top.origin, angle: 0}, coordinate: s}
initial: {x: 0, s: 0}
"""

POLAR = """
parameters: {m: 1 kg, k: 60 N/m, r0: 0.4 m, g: 9.81 m/s^2}
gravity: g
bodies: {bob: {shape: particle, mass: m}}
joints: {arm: {type: polar, of: [ground.O, bob.centre], coordinates: [r, {name: theta, zero: down}]}}
forces: {spring: {type: spring, between: [ground.O, bob.centre], stiffness: k, rest_length: r0}}
initial: {r: 0.7, theta: 0.5}
"""

MOTOR = """
parameters: {M: 3 kg, m: 1 kg, k: 50 N/m, T: 0.5 N*m, e: 0.2 m}
gravity: none
bodies: {motor: {mass: M}, arm: {shape: rod, length: e, mass: 0}, load: {shape: particle, mass: m}}
joints:
  guide: {type: slider, along: {through: ground.O, angle: 0}, line: {through: motor.origin, angle: 0}, coordinate: x}
  shaft: {type: hinge, of: [motor.origin, arm.start], coordinate: {name: theta, absolute: true}}
  tip: {type: hinge, of: [arm.end, load.centre]}
forces:
  spring: {type: spring, along: x, stiffness: k}
  drive: {type: torque, on: arm, from: motor, value: T}
initial: {x: 0.1, theta: 0.3}
"""

BOOKS = [
    Book("rod as a pendulum", ROD, ("m*l^2/3*theta'' + m*g*l/2*sin(theta) = 0",)),
    Book(
        "double pendulum",
        DOUBLE,
        (
            "(m1+m2)*l1*theta1'' + m2*l2*theta2''*cos(theta1-theta2) + m2*l2*theta2'^2*sin(theta1-theta2)"
            " + (m1+m2)*g*sin(theta1) = 0",
            "l2*theta2'' + l1*theta1''*cos(theta1-theta2) - l1*theta1'^2*sin(theta1-theta2) + g*sin(theta2) = 0",
        ),
    ),
    Book(
        "pendulum on a cart",
        CART,
        ("(M+m)*x'' + m*l*theta''*cos(theta) - m*l*theta'^2*sin(theta) = F", "l*theta'' + x''*cos(theta) + g*sin(theta) = 0"),
    ),
    Book("bead on a turning rod", BEAD, ("R'' = R*theta'^2", "(m1*l^2/3 + m2*R^2)*theta'' + 2*m2*R*R'*theta' = T")),
    Book(
        "two weights over a pulley",
        ATWOOD,
        ("(m1+m2)*y1'' = (m2-m1)*g", "m1*y1'' = S - m1*g", "m2*y2'' = S - m2*g", "S = 2*m1*m2*g/(m1+m2)"),
        (("S", "tension(rope)"),),
    ),
    Book(
        "block that slides down a slope",
        SLOPE,
        ("s'' = g*sin(a) - mu*g*cos(a)", "m*s'' = m*g*sin(a) - mu*N", "N = m*g*cos(a)"),
        (("N", "ramp.Fn"),),
    ),
    Book("mass on a spring", SPRING, ("m*x'' + c*x' + k*x = F",)),
    Book(
        "disk that rolls down a slope",
        DISK,
        ("3/2*m*s'' = m*g*sin(a)", "m*s'' = m*g*sin(a) - P", "P = m*s''/2"),
        (("s", "x(disk.centre)*cos(a) - y(disk.centre)*sin(a)"), ("P", "-contact.Fs")),
    ),
    Book(
        "two-link arm",
        ARM,
        (
            "(I1+m1*l1^2+m2*l3^2)*theta1'' + m2*l2*l3*cos(theta1-theta2)*theta2'' + m2*l2*l3*sin(theta1-theta2)*theta2'^2"
            " + (m1*l1+m2*l3)*g*cos(theta1) = Ms - Me",
            "(I2+m2*l2^2)*theta2'' + m2*l2*l3*cos(theta1-theta2)*theta1'' - m2*l2*l3*sin(theta1-theta2)*theta1'^2"
            " + m2*g*l2*cos(theta2) = Me",
        ),
    ),
    Book("block on a sliding wedge", WEDGE, ("(m1+m2)*x'' + m2*cos(alpha)*s'' = 0", "cos(alpha)*x'' + s'' = g*sin(alpha)")),
    Book(
        "bob on a spring",
        POLAR,
        ("m*r'' - m*r*theta'^2 + k*(r-r0) - m*g*cos(theta) = 0", "r*theta'' + 2*r'*theta' + g*sin(theta) = 0"),
    ),
    Book(
        "unbalanced motor",
        MOTOR,
        (
            "(M+m)*x'' - m*e*theta''*sin(theta) - m*e*theta'^2*cos(theta) = -k*x",
            "e*theta'' - x''*sin(theta) = T/(m*e)",
        ),
    ),
]
"""At least one equation of each."""
