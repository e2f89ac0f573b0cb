"""A flat follower on a round cam that turns about a point beside its centre: a pure sine, whatever route is taken."""

from __future__ import annotations

import numpy as np
import pytest

import freebody as fb

CAM = """
freebody: 1
parameters: {w: 3 rad/s, e: 0.05 m, R: 0.2 m}
bodies:
  cam:
    mass: 1 kg
    inertia: 0.02 kg*m^2
    curves: {rim: {x: e + R*cos(s), y: -R*sin(s)}}
  plate:
    mass: 2 kg
    inertia: 1 kg*m^2
    lines: {face: {through: origin, angle: 0}, stem: {through: origin, angle: 90 deg}}
ground: {lines: {up: {through: O, angle: 90 deg}}}
joints:
  axle: {type: hinge, of: [ground.O, cam.origin], coordinate: theta}
  guide: {type: slider, along: ground.up, line: plate.stem, coordinate: h}
  touch: {type: flat_follower, along: cam.rim, face: plate.face, coordinates: [s, slide]}
motions: {drive: {of: theta, is: w*t}}
initial: {theta: 0, guess: {h: R, s: -pi/2}}
"""
G, E, R, M = 9.81, 0.05, 0.2, 2.0


def test_the_follower_goes_up_and_down_by_a_sine():
    """h = R + e sin θ over three turns; the cam pushes with m (g + ḧ), at e cos θ from the axle, and the drive takes that."""
    run = fb.Mechanism.loads(CAM).simulate(until=2 * np.pi, rtol=1e-11)
    assert run.outcome.ok, run.outcome.sentence
    t = np.linspace(0.01, 2 * np.pi - 0.01, 60)
    sine, cosine = np.sin(3 * t), np.cos(3 * t)
    assert run.evaluate("h", t) == pytest.approx(R + E * sine, abs=1e-9)
    push = M * (G - 9 * E * sine)
    assert run.evaluate("touch.Fy", t) == pytest.approx(push, rel=1e-8)
    assert run.evaluate("touch.Fx", t) == pytest.approx(0, abs=1e-7)
    assert run.evaluate("drive.force", t) == pytest.approx(push * E * cosine, abs=1e-6)
    assert abs(run.energy.balance).max() < 1e-8


@pytest.mark.parametrize("theta", [0.3, 2.0, -1.1])
def test_all_routes_agree(theta):
    m = fb.Mechanism.loads(CAM.replace("motions: {drive: {of: theta, is: w*t}}\n", ""))
    found = [m.solve(route=route, theta=theta, rates={"theta": 2.0}) for route in ("minimal", "newton_euler", "constraints")]
    for name in ("theta", "s", "slide"):
        values = [instant.accelerations[name] for instant in found]
        assert values == pytest.approx([values[0]] * 3, rel=1e-9, abs=1e-9)
    for instant in found:
        assert max(abs(x) for row in instant.residuals.values() for x in row) < 1e-9
