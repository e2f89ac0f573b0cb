"""What contacts do: each component of a force is known or not by itself."""

import math

import pytest

import freebody as fb

BOX = """
freebody: 1
gravity: 9.81
ground: {lines: {floor: {through: O, angle: 0}}}
bodies:
  box: {shape: rectangle, width: 1, height: 0.5, mass: 2, points: {a: [-0.5, -0.25], b: [0.5, -0.25]}}
joints:
  place: {type: free, of: [ground.O, box.G], coordinates: [x, y, turn]}
contacts:
  left: {of: [ground.floor, box.a], friction: 0.5}
  right: {of: [ground.floor, box.b], friction: 0.5}
forces:
  push: {type: force, at: box.G, x: 3}
initial: {x: 0, y: 0.25, turn: 0, at_rest: true}
"""


def test_two_feet_that_stick_share_friction_but_not_weight():
    """Moments about a foot: 1 m · N = 0.5 m · 2 kg · g ± 0.25 m · 3 N; only the sum of the friction, 3 N, is in the balances."""
    limits = fb.Mechanism.loads(BOX).solve().limits
    for name, sense in (("left", -1), ("right", 1)):
        normal = 9.81 + sense * 0.75
        assert [limits[name].N, limits[name].Fy] == pytest.approx([normal, -normal], rel=1e-12)
        assert math.isnan(limits[name].T) and math.isnan(limits[name].Fx)
