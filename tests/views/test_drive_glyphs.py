"""Symbols of torsion springs and drives stand where the joint is that they act in."""

import pytest

from freebody import Mechanism
from freebody.views.scene import of_run

MODEL = """
freebody: 1
ground: {points: {A: [0.2, 0], B: [1, 0]}}
bodies:
  crank: {shape: rod, length: 0.3, mass: 1}
  rod: {shape: rod, length: 0.4, mass: 0.5}
  block: {shape: rectangle, width: 0.2, height: 0.1, mass: 1}
joints:
  base: {type: hinge, of: [ground.A, crank.start], coordinate: a}
  knee: {type: hinge, of: [crank.end, rod.start], coordinate: b}
  guide: {type: slider, along: {through: ground.B, angle: 0}, line: {through: block.origin, angle: 0}, coordinate: s}
run: {until: 0.1 s}
"""
COIL, MOTOR, PUSH = (
    "forces: {coil: {type: torsion_spring, on: rod, from: crank, stiffness: 3}}",
    "motions: {motor: {of: a, is: 6*t}}",
    "motions: {push: {of: s, is: 0.1*t}}",
)


@pytest.mark.parametrize(
    ("extra", "body", "place", "count"),
    [("", "", (0, 0), 0), (COIL, "crank", (0.15, 0), 1), (MOTOR, "ground", (0.2, 0), 2), (PUSH, "block", (0, 0), 3)],
)
def test_a_symbol_stands_at_its_joint(extra, body, place, count):
    run = Mechanism.loads(MODEL + extra).simulate()
    found = [(name, stroke) for name, figure in of_run(run, run.t[:2]).figures.items() for stroke in figure.strokes]
    coils = [(name, stroke.about) for name, stroke in found if stroke.style == "coil"]
    assert len(coils) == count and {name for name, _ in coils} <= {body}
    assert all(about == pytest.approx(place) for _, about in coils)
