"""Small models for the command line."""

DOOR = """\
freebody: 1
bodies:
  door[1]: {shape: rod, length: 1 m, mass: 2 kg}
joints:
  upper: {type: hinge, of: [ground.O, "door[1].start"]}
  lower: {type: hinge, of: [ground.O, "door[1].start"]}
run: {until: 0.2 s}
"""
BURSTING = """\
freebody: 1
parameters: {k: 1 N/m^2}
gravity: none
bodies:
  ball: {shape: particle, mass: 1 kg}
forces:
  blow: {type: force, at: ball.centre, x: k*ball.x^2, y: 0}
initial: {ball.x: 1 m}
run: {until: 100 s}
"""
FALLING = """\
freebody: 1
bodies:
  ball: {shape: particle, mass: 1 kg}
joints:
  fall: {type: slot, along: {through: ground.O, angle: 90 deg}, point: ball.centre, coordinate: h}
initial: {h: 1 m}
run: {until: 1 s}
"""
