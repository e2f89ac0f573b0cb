"""A driven bat keeps its speed V: a ball at rest leaves with (1 + e) V, and the drive did (1 + e) m V², of which (1 − e²) m V²/2 is lost."""

from pathlib import Path

import pytest
from numpy.testing import assert_allclose

import freebody as fb

BAT = """
freebody: 1
gravity: none
ground: {{lines: {{way: {{through: O, angle: 0}}}}}}
bodies: {{bat: {{mass: 9, inertia: 1, lines: {{face: {{through: origin, angle: -90 deg}}, axis: {{through: origin, angle: 0}}}}}},
  ball: {{shape: particle, mass: 3}}}}
joints:
  g: {{type: slider, along: ground.way, line: bat.axis, coordinate: z}}
  b: {{type: slot, along: ground.way, point: ball.centre, coordinate: x}}
contacts: {{hit: {{of: [ball, bat.face], restitution: {e}}}}}
motions: {{push: {motion}}}
initial: {{x: 0, z: -1, rates: {{x: 0, z: 2}}}}
run: {{until: 0.6}}
"""
MOTIONS = ["{of: z, is: -1 + 2*t}", "{of: z, is: 2, level: velocity}", "{of: z, is: 0, level: acceleration}"]


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("e", [0, 0.4, 1])
def test_a_driven_bat(tmp_path: Path, motion: str, e: float) -> None:
    file = tmp_path / "bat.yaml"
    file.write_text(BAT.format(e=e, motion=motion))
    run = fb.load(file).simulate()
    (hit,) = run.impacts
    work = (1 + e) * 3 * 2**2
    assert_allclose([hit.after.u["x"], hit.impulses.drives["push"], hit.work], [(1 + e) * 2, work / 2, work])
    assert_allclose(hit.lost, (1 - e**2) * 3 * 2**2 / 2, atol=1e-12)
    assert_allclose(run["push.work"][-1], work)
    assert abs(run.energy.balance).max() < 1e-12 * work
