"""One of every joint and force symbol, standing still: what drawings are looked at with."""

from __future__ import annotations

import freebody as fb

ZOO = """
freebody: 1
name: zoo
ground:
  points: {S: [0.2, 0], S2: [1, 0], A: [0, 0.4], R: [1, 0.4], K: [1.8, 0.02], g1: [1.8, 0.7], g2: [2.12, 0.7], b1: [1.8, 1.15],
           b2: [2.3, 1.2], L: [0.2, 1.3], W: [1, 1.1], sun: [2.75, 0.2]}
  curves: {wire: {x: 2.8 + 0.25*cos(s), y: 0.9 + 0.25*sin(s)}}
bodies:
  piston: {mass: 1, inertia: 0.1}
  block: {shape: rectangle, width: 0.3, height: 0.16, mass: 1}
  arm: {shape: rod, length: 0.8, mass: 1}
  collar: {shape: particle, mass: 1}
  wheel: {shape: disk, radius: 0.15, mass: 1}
  cart: {shape: rectangle, width: 0.4, height: 0.1, mass: 1, points: {P: [-0.15, -0.08], Q: [0.15, -0.08]}}
  g1: {shape: disk, radius: 0.12, mass: 1}
  g2: {shape: disk, radius: 0.2, mass: 1}
  b1: {shape: ring, radius: 0.08, mass: 1}
  b2: {shape: disk, radius: 0.16, mass: 1}
  plate: {shape: polygon, corners: [[0, 0], [0.3, 0], [0.1, 0.2]], mass: 1, points: {V: [0.1, 0.2]}}
  bar: {shape: rod, length: 0.4, mass: 1}
  bead: {shape: particle, mass: 1}
  sun: {shape: disk, radius: 0.12, mass: 1}
  planet: {shape: disk, radius: 0.08, mass: 1}
joints:
  guide: {type: slider, along: {through: ground.S, angle: 0}, line: {through: piston.origin, angle: 0}, coordinate: s1}
  slide: {type: slider, along: {through: ground.S2, angle: 0}, line: {through: block.origin, angle: 0}, coordinate: s2}
  pin: {type: hinge, of: [ground.A, arm.start], coordinate: turn}
  track: {type: slot, along: [arm.start, arm.end], point: collar.centre, coordinate: s3}
  roll: {type: rolling, on: {through: ground.R, angle: 0}, circle: {centre: wheel.centre, radius: 0.15}, coordinate: s4}
  rollers: {type: rollers, along: {through: ground.K, angle: 0}, points: [cart.P, cart.Q], coordinate: s5}
  axle 1: {type: hinge, of: [ground.g1, g1.centre]}
  axle 2: {type: hinge, of: [ground.g2, g2.centre]}
  gears: {type: gear, of: [g1.centre, g2.centre], radii: [0.12, 0.2]}
  axle 3: {type: hinge, of: [ground.b1, b1.centre]}
  axle 4: {type: hinge, of: [ground.b2, b2.centre]}
  belt: {type: belt, of: [b1.centre, b2.centre], radii: [0.08, 0.16]}
  tie: {type: link, of: [ground.L, plate.V], length: 0.3}
  clamp: {type: weld, of: [ground.W, bar.start], angle: 0.9}
  wire: {type: curved_slot, along: ground.wire, point: bead.centre, coordinate: sigma}
  sun pin: {type: hinge, of: [ground.sun, sun.centre]}
  planetary: {type: rolling_circles, on: {centre: sun.centre, radius: 0.12}, circle: {centre: planet.centre, radius: 0.08}}
forces:
  strut: {type: spring, between: [bar.end, b1.centre], stiffness: 10, damping: 2}
  damper: {type: damper, between: [g1.centre, cart.G], damping: 2}
  push: {type: force, at: cart.P, value: 3, direction: 0}
  drive: {type: torque, on: g2, value: 3}
initial: {s1: 0.3, s2: 0.2, turn: 0.3, s3: 0.5, s4: 0.3, s5: 0, sigma: 0.9, at_rest: true}
"""


def zoo():
    """Model and state."""
    mechanism = fb.Mechanism.loads(ZOO)
    return mechanism.source(), mechanism.start()[0]
