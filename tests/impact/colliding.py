"""Models with an impact of every kind, symbolically."""

from __future__ import annotations

from functools import cache

import freebody as fb
from freebody.catalogue import model_file
from freebody.impact.impacts import Impact, impacts

BALL_ON_BAR = """
gravity: none
parameters: {m: 0.5 kg, M: 2 kg, l: 1.2 m, b: 0.9 m, v: 3 m/s, e: 0.4}
bodies:
  bar: {shape: rod, length: l, mass: M, lines: {face: {through: origin, angle: 0}}}
  ball: {shape: particle, mass: m}
ground: {points: {B: [b, 0]}}
joints:
  pin: {type: hinge, of: [ground.O, bar.start], coordinate: phi}
  way: {type: slot, along: {through: ground.B, angle: 90 deg}, point: ball.G, coordinate: y}
contacts: {knock: {of: [ball, bar.face], restitution: e}}
initial: {phi: 0, y: 0.3 m, rates: {phi: 0, y: -v}}
run: {until: 0.2 s}
"""
"""A ball falls on a bar on a pin, b away from it."""

BULLET = """
gravity: 9.81 m/s^2
parameters: {m: 0.02 kg, M: 3 kg, l: 0.8 m, d: 0.6 m, v: 400 m/s}
bodies:
  rod: {shape: rod, length: l, mass: M, lines: {face: {through: origin, angle: 180 deg}}}
  bullet: {shape: particle, mass: m}
ground: {points: {B: [0, -d]}}
joints:
  pivot: {type: hinge, of: [ground.O, rod.start], coordinate: {name: theta, zero: down}}
  barrel: {type: slot, along: {through: ground.B, angle: 0}, point: bullet.G, coordinate: x}
contacts: {target: {of: [bullet, rod.face], restitution: 0}}
initial: {theta: 0, x: -1 m, rates: {theta: 0, x: v}}
run: {until: 5 ms}
"""
"""A bullet stays in a rod that hangs."""

CAUGHT = """
parameters: {m: 2 kg, l: 1 m, s: 0.6 m}
bodies: {rod: {shape: rod, length: l, mass: m}}
strings: {cord: {ends: [ground.O, rod.start], length: s}}
initial: {points: {rod.start: [0, 0]}, rod.angle: 0, rates: {rod.x: 0, rod.y: 0, rod.angle: 0}}
run: {until: 0.4 s}
"""
"""A rod falls level until a string catches its end."""

LINKS = """
gravity: none
parameters: {m: 3 kg, l: 0.7 m, n: 0.4 kg, v: 2 m/s, e: 0.5}
bodies:
  one: {shape: rod, length: l, mass: m, lines: {face: {through: origin, angle: 0}}}
  two: {shape: rod, length: l, mass: m}
  hammer: {shape: particle, mass: n}
joints:
  table: {type: free, of: [ground.O, one.centre], coordinates: [x, y, theta]}
  knee: {type: hinge, of: [one.end, two.start], coordinate: phi}
  way: {type: slot, along: {through: ground.O, angle: 90 deg}, point: hammer.G, coordinate: s}
contacts: {knock: {of: [hammer, one.face], restitution: e}}
initial: {x: l/2, y: 0, theta: 0, phi: 0, s: 0.1 m, rates: {x: 0, y: 0, theta: 0, phi: 0, s: -v}}
run: {until: 0.1 s}
"""
"""Two rods, hinged and in line, are struck at the end of one, across."""

DISK = """
gravity: none
parameters: {R: 0.1 m, m: 1 kg, mu: 0.2, e: 0.8, v: VELOCITY, w: 0 rad/s}
bodies: {disk: {shape: disk, radius: R, mass: m}}
ground: {lines: {floor: {through: ground.O, angle: 0}}}
contacts: {floor: {of: [disk, ground.floor], friction: mu, restitution: e}}
initial: {disk.x: 0, disk.y: 3*R, rates: {disk.x: v, disk.y: -2, disk.angle: -w}}
run: {until: 0.3 s}
"""
SLIDES, ROLLS = DISK.replace("VELOCITY", "5 m/s"), DISK.replace("VELOCITY", "0.5 m/s")

SMOOTH = """
gravity: none
parameters: {b: 0.12 m, e: 0.7, m1: 1 kg, m2: 3 kg}
bodies: {one: {shape: disk, radius: 0.1 m, mass: m1}, two: {shape: disk, radius: 0.15 m, mass: m2}}
contacts: {touch: {of: [one, two], restitution: e}}
initial: {one.x: -1 m, one.y: b, two.x: 0, two.y: 0, rates: {one.x: 2, one.angle: 3}}
run: {until: 1 s}
"""
"""Two smooth disks meet off centre."""

DOOR = """
parameters: {e: 0.6, m: 1 kg, l: 1.5 m, c: 0.1 N*m*s/rad}
bodies: {bob: {shape: rod, length: l, mass: m}}
joints: {pin: {type: hinge, of: [ground.O, bob.start], coordinate: {name: th, zero: down}, friction: 0.2, bearing_radius: 5 mm}}
stops: {wall: {of: th, least: 0 deg, restitution: e}}
forces: {oil: {type: torque, on: bob, value: -c*rate(th)}}
initial: {th: 1, at_rest: true}
run: {until: 1 s}
"""
"""A pendulum knocks against its stop; its pin rubs."""

BUFFER = """
parameters: {m: 2 kg, M: 1 kg, k: 40 N/m, e: 0.3}
bodies: {cart: {shape: rectangle, width: 0.4 m, height: 0.2 m, mass: m, lines: {mid: {through: origin, angle: 0}}}, bob: {shape: particle, mass: M}}
joints:
  rail: {type: slider, along: {through: ground.O, angle: 0}, line: cart.mid, coordinate: x}
  arm: {type: link, of: [cart.G, bob.G], length: 0.5 m, coordinate: phi}
stops: {end: {of: x, most: 0.5 m, restitution: e}}
forces: {spring: {type: spring, between: [ground.O, cart.G], stiffness: k, rest_length: 0.2 m}}
initial: {x: 0.1 m, phi: -70 deg, rates: {x: 3 m/s, phi: 0}}
run: {until: 0.4 s}
"""
"""A cart with a bob on a link runs into the end of its rail."""

FOUR_BAR = """
gravity: none
parameters: {m: 1 kg, n: 0.5 kg, v: 2 m/s, e: 0.2}
bodies:
  crank: {shape: rod, length: 0.4 m, mass: m}
  coupler: {shape: rod, length: 0.9 m, mass: m, lines: {back: {through: origin, angle: 0}}}
  rocker: {shape: rod, length: 0.6 m, mass: m}
  ball: {shape: particle, mass: n}
ground: {points: {E: [0.8 m, 0]}}
joints:
  A: {type: hinge, of: [ground.O, crank.start], coordinate: a}
  B: {type: hinge, of: [crank.end, coupler.start], coordinate: b}
  C: {type: hinge, of: [coupler.end, rocker.end]}
  D: {type: hinge, of: [ground.E, rocker.start], coordinate: d}
contacts: {knock: {of: [ball, coupler.back], restitution: e}}
initial:
  {a: 90 deg, guess: {b: -70 deg, d: 80 deg}, ball.x: 0.4 m, ball.y: 1 m, rates: {ball.x: 0.3, ball.y: -v, a: 0}}
run: {until: 0.4 s}
"""
"""A ball falls on the coupler of a four-bar."""

PLATE = """
parameters: {m: 1 kg, e: 0}
bodies: {plate: {shape: rectangle, width: 0.6 m, height: 0.1 m, mass: m, points: {A: [-0.3, -0.05], B: [0.3, -0.05]}}}
ground: {lines: {floor: {through: ground.O, angle: 0}}}
contacts:
  left: {of: [plate.A, ground.floor], friction: 0.5, restitution: e}
  right: {of: [plate.B, ground.floor], friction: 0.5, restitution: e}
initial: {plate.x: 0, plate.y: 0.3 m, plate.angle: 0, rates: {plate.x: 0.2 m/s, plate.y: 0, plate.angle: 0}}
run: {until: 0.5 s, impacts: newton}
"""
"""A plate lands flat on two feet: friction has more unknowns than it takes."""

PULLEY = """
parameters: {m: 2 kg, M: 3 kg}
bodies: {low: {shape: particle, mass: m}, high: {shape: particle, mass: M}}
ground: {points: {P: [-0.3, 0.5], Q: [0.3, 0.5]}}
joints:
  left: {type: slot, along: {through: ground.P, angle: -90 deg}, point: low.G, coordinate: a}
  right: {type: slot, along: {through: ground.Q, angle: -90 deg}, point: high.G, coordinate: b}
strings: {rope: {ends: [low.G, high.G], over: [ground.P, ground.Q], length: 2.4 m}}
initial: {a: 0.6, b: 0.2, rates: {a: 0, b: 0}}
run: {until: 1 s}
"""
"""Two weights on a slack rope over eyelets: one falls until it is taut, when the other is on the way, too."""

TEXTS = {
    name.lower(): text
    for name, text in list(globals().items())
    if isinstance(text, str) and text.startswith("\n") and name.isupper()
}
CATALOGUE = {"19.3.22/model", "19.3.22/latch", "19.3.30/model", "19.3.30/hinged", "19.3.30/slippery", "GEN-STEP/model", "GEN-WALK/model", "GEN-WALK/compass",
             "GEN-STEP/floor"}  # fmt: skip
"""The models of the catalogue whose runs have an impact."""
ALL = sorted(set(TEXTS) - {"disk"} | CATALOGUE)


@cache
def mechanism(name: str) -> fb.Mechanism:
    """A model of ``ALL``."""
    if name in TEXTS:
        return fb.Mechanism.loads(f"freebody: 1\n{TEXTS[name]}", name)
    return fb.load(model_file(name))


@cache
def first_impacts(name: str, most: int = 3) -> list[Impact]:
    """Its first impacts."""
    return list(impacts(mechanism(name).simulate()))[:most]
