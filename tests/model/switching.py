"""A model in which everything switches, for the tests of it."""

from __future__ import annotations

from freebody.model import lower, reading

MODEL = """\
freebody: 1
parameters: {r: 0.1 m, e: 0.7, T: 1 N*m}
ground: {points: {A: [-1, 0], B: [1, 0], P: [0, 1]}, lines: {floor: [A, B]}, curves: {bow: {x: s, y: s^2}}}
bodies:
  ball:   {shape: disk, radius: r, mass: 1}
  hoop:   {shape: ring, radius: 2*r, mass: 1}
  box:    {shape: rectangle, width: 1 m, height: 0.5 m, mass: 1, points: {C: [0.5, 0.25]}}
  wedge:  {shape: triangle, corners: [[0, 0], [1, 0], [0, 1]], mass: 1}
  bob:    {shape: particle, mass: 1}
  tilted: {pieces: [{shape: rectangle, width: 2 m, height: 1 m, mass: 1, at: [1, 0], angle: 90 deg}]}
  moved:  {pieces: {rim: {shape: disk, radius: r, mass: 1, at: [0, 1]}}}
  rod:    {shape: rod, length: 1 m, mass: 1}
  lump:   {mass: 1}
  two:    {pieces: [{shape: disk, radius: 1, mass: 1}, {shape: disk, radius: 1, mass: 1, at: [1, 0]}]}
gauges: {h: y(ball.centre), h2: 2*h}
joints:
  pivot: {type: hinge, of: [ground.O, rod.start], coordinate: theta}
  track: {type: slot, point: bob.centre, along: [rod.start, rod.end], coordinate: R}
  axle:  {type: hinge, of: [rod.end, ball.centre], coordinate: spin}
forces:
  pull: {type: force, at: box.G, x: 1}
  lift: {type: law, along: h2, value: 3}
  coil: {type: torsion_spring, on: rod, stiffness: 2}
motions:
  turn: {of: theta, is: t}
contacts:
  floor: {of: [ball, ground.floor]}
strings:
  leash: {ends: [ground.P, ball.centre], length: 1 m}
stops:
  knee: {of: theta, least: 0 deg, most: 150 deg}
  low:  {of: h, least: r}
events:
  e: {when: theta}
"""


def lowered(*changes: tuple[str, str], text: str = MODEL) -> lower.Lowered:
    """The model with some places changed."""
    for before, after in changes:
        assert text.count(before) == 1, f"{before!r} must stand in one place"
        text = text.replace(before, after)
    model, source = reading.reads(text)
    return lower.lower(model, source)
