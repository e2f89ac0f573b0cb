"""Models for the views' tests."""

from __future__ import annotations

import json

import freebody as fb

DOUBLE_PENDULUM = """
freebody: 1
name: NAME
bodies: {UPPER: {shape: rod, length: 1, mass: 2}, lower: {shape: rod, length: 0.8, mass: 1}}
joints:
  pivot: {type: hinge, of: [ground.O, UPPER.start], coordinate: phi1}
  knee: {type: hinge, of: [UPPER.end, lower.start], coordinate: {name: phi2, absolute: true}}
initial: {phi1: 0, phi2: -0.4, at_rest: true}
events: {plumb: {when: phi1 + pi/2, then: record}, leaves: {when: phi1 - 100, then: record}}
report:
  tip speed at the end: speed(lower.end)
  largest pull: max of pivot.F
  mean height: mean of y(lower.end)
  angle when plumb: {value: phi2, at: plumb, unit: deg}
  never: phi2 @ leaves
"""
FOUR_BAR = """
freebody: 1
name: four-bar with a motor
parameters: {T: 2 N*m}
ground: {points: {B: [0.9, 0], S: [1.25, 0.75]}}
bodies:
  crank: {shape: rod, length: 0.3, mass: 1}
  coupler: {shape: rod, length: 0.9, mass: 1, points: {P: [0.1, 0.28]}}
  rocker: {shape: rod, length: 0.6, mass: 1}
joints:
  main bearing: {type: hinge, of: [ground.O, crank.start], coordinate: theta}
  crank pin: {type: hinge, of: [crank.end, coupler.start], coordinate: {name: beta, absolute: true}}
  rocker bearing: {type: hinge, of: [ground.B, rocker.start], coordinate: psi}
  rocker pin: {type: hinge, of: [coupler.end, rocker.end]}
forces:
  motor: {type: torque, on: crank, value: T}
  return spring: {type: spring, between: [rocker.end, ground.S], stiffness: 20}
initial: {theta: 1, guess: {beta: 0.4, psi: 1.4}, at_rest: true}
events: {crank level: {when: sin(theta), then: record}}
report:
  largest bearing load: max of 'main bearing'.F
  rms crank speed: rms of omega(crank)
  work of the motor: motor.work
"""
SHELF = """
freebody: 1
name: a board on two pins of a carriage
bodies: {upper: {shape: rectangle, width: 1, height: 0.2, mass: 2, points: {A: [-0.4, 0.1], B: [0.4, 0.1]}}, lower: {shape: rod, length: 0.8, mass: 1}}
joints:
  pivot: {type: slider, along: {through: ground.O, angle: 0}, line: {through: upper.origin, angle: 0}, coordinate: phi1}
  knee: {type: hinge, of: [upper.A, lower.start]}
  other knee: {type: hinge, of: [upper.B, lower.end]}
initial: {phi1: 0, rates: {phi1: 1}}
"""
"""How much the pins press the board together is open; what they carry is not."""


def run_double_pendulum(until: float = 2.0, upper: str = "upper", name: str = "double pendulum") -> fb.Run:
    return fb.Mechanism.loads(DOUBLE_PENDULUM.replace("UPPER", upper).replace("NAME", json.dumps(name))).simulate(until=until)


def run_four_bar(until: float = 3.0) -> fb.Run:
    return fb.Mechanism.loads(FOUR_BAR).simulate(until=until)


def run_shelf(until: float = 0.5) -> fb.Run:
    return fb.Mechanism.loads(SHELF).simulate(until=until)
