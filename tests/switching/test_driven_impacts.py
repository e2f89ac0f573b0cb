"""A driven bat keeps its speed V: a ball at rest leaves with (1 + e) V, and the drive did (1 + e) m V², of which (1 − e²) m V²/2 is lost.
Where the drive pushes the ball too, by a part a of its force, the ball still leaves so, and (1 − e²) m V²/(2 (1 + a)) is lost."""

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
MOTIONS = ["{{of: z, is: -1 + 2*t{}}}", "{{of: z, is: 2, level: velocity{}}}", "{{of: z, is: 0, level: acceleration{}}}"]
V, M = 2, 3


def bat(motion: str, e: float = 0) -> fb.Run:
    return fb.Mechanism.loads(BAT.format(e=e, motion=motion)).simulate()


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("e", [0, 0.4, 1])
@pytest.mark.parametrize("a", [0, 0.5])
def test_a_driven_bat(motion: str, e: float, a: float) -> None:
    run = bat(motion.format(f", by: z + {a}*x" if a else ""), e)
    (hit,) = run.impacts
    impulse = (1 + e) * M * V / (1 + a)
    work = impulse * (V + a * (1 + e) * V / 2)  # at the mean of its rates before and after
    assert_allclose([hit.after.u["x"], hit.impulses.drives["push"], hit.work], [(1 + e) * V, impulse, work])
    assert_allclose(hit.lost, (1 - e**2) * M * V**2 / (2 * (1 + a)), atol=1e-12)
    assert_allclose(run["push.work"][-1], work)
    assert abs(run.energy.balance).max() < 1e-12 * work


def test_a_drive_that_is_engaged_has_its_own_rate_from_the_first() -> None:
    events = "events: {on: {at: 0.1, then: {engage: push}}}\n"
    run = fb.Mechanism.loads(BAT.format(e=0, motion="{of: z, is: 5, level: velocity, engaged: false}") + events).simulate(0.2)
    (jerk,) = run.impacts
    assert_allclose([jerk.impulses.drives["push"], jerk.work, jerk.lost], [9 * 3, 9 * 3 * 5, 9 * 3**2 / 2])
