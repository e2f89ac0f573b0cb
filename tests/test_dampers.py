"""Springs with dampers in all their spellings, beside free vibrations with damping (den Hartog, Mechanical Vibrations, 2.6)."""

import numpy as np
import pytest

import freebody as fb

K, C, M, STRETCH = 40.0, 3.0, 2.0, 0.2
FORCES = {
    "between points": "{type: spring, between: [ground.A, block.P], stiffness: 40, rest_length: 1, damping: 3}",
    "along a coordinate": "{type: spring, along: s, stiffness: 40, damping: 3}",
    "beside each other": "{type: spring, along: s, stiffness: 40}, d: {type: damper, between: [ground.A, block.P], damping: 3}",
    "on the turn": "{type: torsion_spring, on: wheel, stiffness: 40, damping: 3}",
}
MODEL = """
freebody: 1
gravity: none
ground: {points: {A: [-1, 0]}, lines: {way: {through: O, angle: 0}}}
bodies: {block: {mass: 2, inertia: 1, points: {P: [0, 0]}, lines: {axis: {through: P, angle: 0}}}, wheel: {mass: 1, inertia: 2}}
joints:
  guide: {type: slider, along: ground.way, line: block.axis, coordinate: s}
  axle: {type: hinge, of: [ground.O, wheel.origin], coordinate: turn}
forces: {f: FORCE}
initial: {s: 0.2, turn: 0.2, at_rest: true}
"""


@pytest.mark.parametrize("force", FORCES)
def test_what_vibrates_on_a_spring_and_a_damper_dies_out(force):
    run = fb.Mechanism.loads(MODEL.replace("FORCE", FORCES[force])).simulate(3, rtol=1e-12)
    x, t, delta = "turn" if "turn" in force else "s", np.linspace(0, 3, 31), C / (2 * M)
    w = np.sqrt(K / M - delta**2)
    decay = STRETCH * np.exp(-delta * t)
    assert run.evaluate(x, t) == pytest.approx(decay * (np.cos(w * t) + delta / w * np.sin(w * t)), abs=1e-10)
    assert run.evaluate(f"rate({x})", t) == pytest.approx(-decay * K / (M * w) * np.sin(w * t), abs=1e-10)
