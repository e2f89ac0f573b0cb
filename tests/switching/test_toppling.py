"""Bodies that fall over while they lean or rock: a ladder leaves its wall, a block rocks to rest (Housner 1963)."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from mpmath import mp
from seen import changes, motion

G = 9.81


def integral(integrand: Callable[[np.ndarray], np.ndarray], end: float) -> float:
    """Of a smooth function from 0, by Gauss and Legendre."""
    x, w = np.polynomial.legendre.leggauss(60)
    return float(w @ integrand(end * (1 + x) / 2) * end / 2)


LADDER = """
parameters: {l: 2 m, th0: 70 deg}
bodies: {ladder: {shape: rod, length: l, mass: 3 kg}}
ground: {points: {P: [0, 0], Q: [1, 0], T: [0, 1]}}
contacts:
  floor: {of: [ladder.start, [ground.P, ground.Q]]}
  wall: {of: [ladder.end, [ground.T, ground.P]]}
initial: {points: {ladder.start: [l*cos(th0), 0], ladder.end: [0, l*sin(th0)]}, at_rest: true}
"""


@pytest.mark.parametrize("degrees", [50, 70, 85])
def test_a_ladder_leaves_the_wall_at_two_thirds_of_its_height(degrees):
    """Between both contacts l θ̇² = 3g (sin θ₀ − sin θ); the wall's push 9mg/4 cos θ (sin θ − ⅔ sin θ₀) ends it."""
    run = motion(LADDER, 1.5, {"rtol": 1e-11}, th0=math.radians(degrees))
    (leaves,) = [change for change in changes(run, "lift-off") if change.of == ["wall"]]
    start, top = math.radians(degrees), math.sin(math.radians(degrees))
    # sin θ₀ − sin(θ₀ − z²) = 2 cos(θ₀ − z²/2) sin(z²/2): θ = θ₀ − z² takes the root at the start out of the integrand.
    pace = lambda z: 2 * z / np.sqrt(3 * G * np.cos(start - z**2 / 2) * np.sin(z**2 / 2))
    known = integral(pace, math.sqrt(start - math.asin(2 * top / 3)))
    assert leaves.t == pytest.approx(known, abs=1e-9)
    height = run.evaluate("y(ladder.end)", leaves.t) / 2
    assert height == pytest.approx(2 * top / 3, abs=1e-9)
    before = leaves.t * np.array([0.3, 0.6, 0.9])
    theta = np.arcsin(run.evaluate("y(ladder.end)", before) / 2)
    push = 9 * 3 * G / 4 * np.cos(theta) * (np.sin(theta) - 2 * top / 3)
    assert run.evaluate("wall.N", before) == pytest.approx(push, rel=1e-8)
    # From there on nothing pushes sideways.
    later = leaves.t + np.array([0.01, 0.05])
    assert np.ptp(run.evaluate("vx(ladder.centre)", later)) < 1e-12
    assert (run.evaluate("wall.gap", later) > 0).all()


BLOCK = """
parameters: {th0: 0.12}
bodies: {block: {shape: rectangle, width: 1 m, height: 4 m, mass: 1 kg, points: {B: [0.5, -2]}}}
ground: {points: {P: [0, 0], Q: [1, 0]}}
contacts: {floor: {of: [block, [ground.P, ground.Q]], rough: true}}
initial: {points: {block.B: [0, 0]}, block.angle: -th0, at_rest: true}
"""
ALPHA, RADIUS = math.atan(0.25), math.sqrt(4.25)
KEPT = 1 - 1.5 * math.sin(ALPHA) ** 2  # of the speed, by the angular momentum about the corner that strikes


def fall(theta: float) -> float:
    """The time from rest at a tilt to upright: θ̇² = 3g/(2R) (cos(α − θ₀) − cos(α − θ)), θ = θ₀ − z²."""
    pace = lambda z: 2 * z / np.sqrt(3 * G / RADIUS * np.sin(ALPHA - theta + z**2 / 2) * np.sin(z**2 / 2))
    return integral(pace, math.sqrt(theta))


def falls(theta: float, count: int = 200) -> np.ndarray:
    """The times to fall after none, one, two … impacts: each leaves KEPT² of the energy, so of cos(α − θ) − cos α."""
    with mp.workdps(60):
        upright = mp.cos(ALPHA)
        drop = mp.cos(ALPHA - mp.mpf(theta)) - upright
        tilts = [float(ALPHA - mp.acos(upright + drop * mp.mpf(KEPT) ** (2 * k))) for k in range(count)]
    return np.array([fall(tilt) for tilt in tilts])


@pytest.mark.parametrize("theta", [0.02, 0.12, 0.22])
def test_a_block_rocks_as_housner_says(theta):
    run = motion(BLOCK, 5, {"rtol": 1e-11}, th0=theta)
    impacts = changes(run, "impact")
    assert [i.after["u"][2] / i.before["u"][2] for i in impacts] == pytest.approx([KEPT] * len(impacts), abs=1e-12)
    quarters = falls(theta)
    known = quarters[0] + 2 * np.concatenate([[0], np.cumsum(quarters[1:])])
    count = min(len(impacts), 40)
    assert count >= 3
    assert [i.t for i in impacts[:count]] == pytest.approx(known[:count], abs=1e-9)


def test_a_rocking_block_comes_to_rest():
    """The impacts come ever closer: their times have a limit, and the block stands from there on, where it was put."""
    run = motion(BLOCK, 15, {"rtol": 1e-11})
    (rest,) = changes(run, "rest")
    quarters = falls(0.12)
    # What is left of small tilts falls in times that shrink as the speed does: a geometric series.
    known = quarters[0] + 2 * quarters[1:].sum() + 2 * quarters[-1] * KEPT / (1 - KEPT)
    # The last intervals, of 4e-6 s, are known to the round-off of the height over the speed, 1e-10 s; their ratio to 3e-5.
    assert rest.t == pytest.approx(known, abs=1e-7)
    assert np.abs(run.q[-1] - [-0.5, 2, 0]).max() < 1e-9
    assert (run.u[-1] == 0).all()
    assert np.abs(rest.after["u"]).max() < 1e-15
    before = np.array(rest.before["u"])
    assert rest.lost == pytest.approx([0.5, 0.5, 17 / 24] @ before**2, rel=1e-9)


PUSHED = """
parameters: {P: 1, h: 0.45 m}
bodies: {box: {shape: rectangle, width: 0.4 m, height: 1 m, mass: 20 kg, points: {A: [-0.2 m, -0.5 m], B: [0.2 m, -0.5 m], H: [-0.2 m, h]}}}
ground: {lines: {floor: {through: O, angle: 0}}}
contacts: {CONTACTS}
forces: {push: {type: force, at: box.H, x: P*60*t, y: 0}}
initial: {box.x: 0, box.y: 0.5 m, box.angle: 0, at_rest: true}
"""
OUTLINE = "floor: {of: [box, ground.floor], friction: 0.4}"
CORNERS = "heel: {of: [box.A, ground.floor], friction: 0.4}, toe: {of: [box.B, ground.floor], friction: 0.4}"


@pytest.mark.parametrize(("contacts", "about"), [(OUTLINE, ""), (CORNERS, " about `toe`")])
@pytest.mark.parametrize("height", [-0.3, 0.45])
def test_a_block_that_is_pushed_tips_or_slides_and_that_is_said(contacts, about, height):
    """Pushed at H above the floor by P it slides at P = μ m g, and tips about its front corner at P H = m g b/2, whichever comes first."""
    made = motion(PUSHED.replace("CONTACTS", contacts), 1.6, h=height)
    high = height + 0.5
    tips, slides = 20 * G * 0.2 / high / 60, 0.4 * 20 * G / 60
    first = next(change for change in made.changes if change.kind in ("slip", "lift-off"))
    assert first.t == pytest.approx(min(tips, slides), rel=1e-6)
    assert first.note.endswith(f"`box` tips{about}" if tips < slides else "`box` slides")
