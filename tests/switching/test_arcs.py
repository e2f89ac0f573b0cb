"""Arcs with ends as surfaces: what slides over them, off them and past them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from seen import changes, kinds, motion

G = 9.81

HILL = """
parameters: {v: 0.5 m/s, R: 2 m}
bodies: {bead: {shape: particle, mass: 2 kg}}
ground: {points: {C: [0, 0]}}
contacts: {hill: {of: [bead, {centre: ground.C, radius: R, ends: [ENDS]}]}}
initial: {bead.x: 0, bead.y: R, rates: {bead.x: v}}
"""


def test_a_bead_leaves_a_hill_where_nothing_presses_it_any_more():
    """At the angle φ from the top at which v² = g R cos φ: cos φ = 2/3 + v₀²/(3 g R)."""
    run = motion(HILL.replace("ENDS", "10 deg, 150 deg"), 1.5)
    (off,) = changes(run, "lift-off")
    phi = math.acos(2 / 3 + 0.25 / (3 * G * 2))
    x, y = (run.evaluate(f"bead.{c}", off.t) for c in "xy")
    assert math.atan2(x, y) == pytest.approx(phi, abs=1e-8)


@pytest.mark.parametrize("shape, r", [("particle", 0.0), ("disk, radius: 0.1 m", 0.1)])
def test_what_passes_the_end_of_an_arc_falls_from_there(shape, r):
    """A bead flies off along the tangent. A disk goes on round the end, as round a pin, until nothing presses it: its centre then
    has the speed √(g r cos φ), or it has been faster than that when it came."""
    text = HILL.replace("ENDS", "60 deg, 120 deg").replace("shape: particle", f"shape: {shape}")
    text += f"events: {{passes: {{when: bead.x - (R + {r})/2, direction: rising}}}}\n"
    run = motion(text.replace("bead.y: R", f"bead.y: R + {r}"), 1.3, {"rtol": 1e-11})
    (off,) = run.events
    high = 2 + r
    speed = math.sqrt(0.25 + 2 * G * high * (1 - math.cos(math.pi / 6)))
    assert speed**2 > G * r  # too fast for the pin
    place, along = high * np.array([0.5, math.sqrt(0.75)]), np.array([math.sqrt(0.75), -0.5])
    after = 1.3 - off.t
    flown = place + speed * along * after - np.array([0, G / 2]) * after**2
    assert [run.evaluate(f"bead.{c}", 1.3) for c in "xy"] == pytest.approx(flown, abs=1e-8)
    assert run.evaluate("hill.N", 0.9 * off.t) > 0 and run.evaluate("hill.N", 1.3) == 0


def test_a_disk_falls_past_the_end_of_an_arc_and_may_hit_it():
    """Dropped just beside the end it misses; dropped over it, it is struck aside by the corner."""
    text = HILL.replace("ENDS", "60 deg, 120 deg").replace("shape: particle", "shape: disk, radius: 0.1 m")
    drop = text.replace("bead.x: 0, bead.y: R, rates: {bead.x: v}", "bead.x: BESIDE, bead.y: 3, at_rest: true")
    misses = motion(drop.replace("BESIDE", "1.101"), 1.5)
    hits = motion(drop.replace("BESIDE", "1.05"), 0.8)
    assert kinds(misses) == []
    impact = changes(hits, "impact")[0]
    assert impact.before["q"][1] - math.sqrt(3) == pytest.approx(math.sqrt(0.01 - 0.05**2), abs=1e-9)
    assert impact.after["u"][0] > 0
