"""A law with cases takes the case of the motion as it is: from a start where it stands between two, and after every jump of the speeds."""

from __future__ import annotations

import numpy as np
import pytest
from seen import model

TOLERANCES = (1e-3, 1e-5, 1e-7, 1e-8, 1e-9, 1e-11, 1e-13)
LAWS = (
    "-(1 N)*sign(rate(b.y))",
    "if(rate(b.y) > 0, -1 N, 1 N)",
    "if(rate(b.y) < 0, 1 N, -1 N)",
    "-(1 N)*rate(b.y)/max(abs(rate(b.y)), 1e-6 m/s)",
)
MOTIONS = {
    "falls from rest": ("", "initial: {b.x: 0, b.y: 10 m, at_rest: true}", ""),
    "bounces": (
        "contacts: {c: {of: [b.centre, ground.floor], restitution: 0.8}}",
        "initial: {b.x: 0, b.y: 1 m, rates: {b.x: 0, b.y: -1 m/s}}",
        "",
    ),
    "is thrown back": (
        "",
        "initial: {b.x: 0, b.y: 0, rates: {b.x: 0, b.y: -1 m/s}}",
        "events: {hit: {at: 0.2 s, then: {reset: {b.y: 20 m/s}}}}",
    ),
    "is stopped": (
        "",
        "initial: {b.x: 0, b.y: 0, rates: {b.x: 0, b.y: 20 m/s}}",
        "events: {hit: {at: 0.2 s, then: {reset: {b.y: 0}}}}",
    ),
}


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("name", MOTIONS)
def test_dry_friction_takes_energy_out_however_the_speed_came_about(name, law):
    """Gravity is stronger than it: its power is −1 N · |v| at every time."""
    contacts, initial, events = MOTIONS[name]
    mechanism = model(f"""
bodies: {{b: {{shape: particle, mass: 1}}}}
ground: {{lines: {{floor: {{through: O, angle: 0}}}}}}
forces: {{d: {{type: force, at: b.centre, x: 0, y: "{law}"}}}}
{contacts}
{initial}
{events}
run: {{until: 1 s}}
""")
    for rtol in TOLERANCES:
        run = mechanism.simulate(rtol=rtol)
        assert run.outcome.ok, run.outcome.sentence
        t = np.linspace(0.013, 0.997, 77)
        speed = np.abs(run.evaluate("rate(b.y)", t))
        assert run.evaluate("d.power", t) == pytest.approx(-speed, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("law", LAWS[:3])
def test_dry_friction_that_holds_from_the_start_is_named_as_a_law_that_cannot(law):
    """Gravity is weaker than it: nothing moves, which a jump of a law does not say."""
    mechanism = model(f"""
gravity: 0.5
bodies: {{b: {{shape: particle, mass: 1}}}}
forces: {{d: {{type: force, at: b.centre, x: 0, y: "{law}"}}}}
initial: {{b.x: 0, b.y: 0, at_rest: true}}
run: {{until: 1 s}}
""")
    for rtol in TOLERANCES:
        outcome = mechanism.simulate(rtol=rtol).outcome
        assert (outcome.name, outcome.path) == ("Chatter", "forces.d"), rtol
        assert outcome.t < 1e-6
