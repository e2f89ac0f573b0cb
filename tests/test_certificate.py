"""The agreement certificate: routes agree on good motions, and the weakest link is named where they do not."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from store import MODELS, WITHOUT_ANSWER, every, run
from typer.testing import CliRunner

import freebody as fb
from freebody import cli
from freebody.run.certificate import Certificate

SENSITIVE = {"GEN-CHAIN/two_bars", "GEN-SLIDER/dead_point"}
"""A chaotic motion, and rest in a singular position, where each route accelerates round-off in its own way."""


@every(sorted(set(MODELS) - WITHOUT_ANSWER - SENSITIVE))
def test_all_routes_agree_on_the_motions_of_the_catalogue(model):
    found = Certificate(run(model))
    assert found.weakest.digits >= 5, found.weakest


def test_the_weakest_link_of_a_chaotic_motion_is_the_motion_itself():
    found = Certificate(run("GEN-CHAIN/two_bars"))
    assert found.weakest.name in ("second integrator", "tolerance halved", "tighter tolerance")
    assert found.weakest.digits < 4 < min(route.digits for route in found.routes[:3])


class Lying:
    """A motion whose rates are by a part in ten thousand not what they are."""

    def __init__(self, motion):
        self.motion = motion

    def __getattr__(self, name):
        return getattr(self.motion, name)

    def state(self, t):
        state = self.motion.state(t)
        return replace(state, u=state.u * (1 + 1e-4))


def test_rates_that_are_not_those_of_the_motion_are_found():
    good = run("examples/new_gun")
    wrong = Certificate(replace(good, motion=Lying(good.motion)))
    digits = {route.name: route.digits for route in wrong.routes}
    assert 3 < digits["finite differences"] < 4.5 and digits["three forms"] > 12


STRIKING = ("19.3.22/model", "19.3.30/model", "19.3.30/slippery", "GEN-STEP/floor", "examples/tossed_box")


@pytest.mark.parametrize("model", STRIKING)
def test_impulses_and_losses_of_impacts_are_routes_of_their_own(model):
    routes = {route.name: route.digits for route in Certificate(run(model)).routes}
    assert run(model).impacts and min(routes["impulses of impacts"], routes["energy of impacts"]) > 12
    assert "impulses of impacts" not in {route.name for route in Certificate(run("examples/new_gun")).routes}


@pytest.mark.parametrize(
    ("field", "of"), [("lost", "energy of impacts"), ("impulses", "impulses of impacts"), ("after", "impulses of impacts")]
)
def test_what_is_not_that_of_the_impact_is_found(field, of):
    good = run("examples/tossed_box")
    hit = next(impact for impact in good.impacts if impact.kind == "impact")
    stated = {
        "lost": 1.01 * hit.lost,
        "impulses": replace(hit.impulses, contacts={name: (x, 1.01 * y) for name, (x, y) in hit.impulses.contacts.items()}),
        "after": replace(hit.after, u={name: rate + 0.01 for name, rate in hit.after.u.items()}),
    }
    motion = Lying(good.motion)
    motion.changes = [replace(hit, **{field: stated[field]}) if change is hit else change for change in good.changes]
    motion.state = good.motion.state
    routes = {route.name: route.digits for route in Certificate(replace(good, motion=motion)).routes}
    assert routes[of] < 3


def test_couples_of_joints_are_compared_too():
    """Two rods welded at an angle, one of which guides a third, fall on the floor."""
    good = fb.Mechanism.loads("""
freebody: 1
ground: {lines: {floor: {through: O, angle: 0}}}
bodies:
  a: {shape: rod, length: 1, mass: 1}
  b: {shape: rod, length: 0.5, mass: 2}
  c: {shape: rod, length: 0.5, mass: 2, lines: {axis: [start, end]}}
joints:
  plane: {type: free, of: [ground.O, a.centre], coordinates: [x, y, turn]}
  w: {type: weld, of: [a.end, b.start], angle: 40 deg}
  s: {type: slider, along: {through: b.centre, angle: 90 deg}, line: c.axis, coordinate: z}
contacts: {f: {of: [b.end, ground.floor], restitution: 0.5, friction: 0.3}}
initial: {x: 0, y: 2, turn: 0.3, z: 0.1, rates: {x: 1, y: 0, turn: 2, z: 0.3}}
""").simulate(1, impacts="newton")
    [hit, *_] = good.impacts
    for joint, part in (("w", 2), ("s", 2), ("w", 0)):
        impulses = {name: list(impulse) for name, impulse in hit.impulses.joints.items()}
        assert abs(impulses[joint][part]) > 1e-3
        impulses[joint][part] *= 1.01
        motion = Lying(good.motion)
        told = replace(hit, impulses=replace(hit.impulses, joints={name: tuple(each) for name, each in impulses.items()}))
        motion.changes = [told if change is hit else change for change in good.changes]
        motion.state = good.motion.state
        routes = {route.name: route.digits for route in Certificate(replace(good, motion=motion))._over_impacts()}
        assert routes["impulses of impacts"] < 4
    assert {route.name: route.digits for route in Certificate(good)._over_impacts()}["impulses of impacts"] > 12


def test_the_command_names_the_weakest_link_and_fails_below_what_is_asked():
    asked = ["certify", str(MODELS["examples/new_gun"])]
    done = CliRunner().invoke(cli.app, asked)
    assert done.exit_code == 0 and "The weakest link: inverse dynamics, 7.2 digits." in done.output
    assert CliRunner().invoke(cli.app, [*asked, "--digits", "14"]).exit_code == 3
    data = json.loads(CliRunner().invoke(cli.app, [*asked, "--json"]).output)
    known = {route["name"]: route["digits"] for route in data["routes"] if route["digits"] is not None}
    assert data["weakest"] == min(known, key=known.get) and data["ok"]
    assert math.isfinite(sum(known.values())) and len(np.unique(list(known))) == len(data["routes"])


THROWN = """
freebody: 1
bodies: {stone: {shape: particle, mass: 2 kg}}
initial: {stone.x: 0, stone.y: 0, rates: {stone.x: 3 m/s, stone.y: 4 m/s}}
run: {until: 1 s}
"""
HELD_TWICE = """
freebody: 1
bodies: {beam: {shape: rod, length: 2 m, mass: 3 kg}}
joints:
  A: {type: hinge, of: [ground.O, beam.start]}
  B: {type: hinge, of: [ground.P, beam.end]}
ground: {points: {P: [2 m, 0]}}
forces: {push: {type: force, at: beam.centre, x: 0, y: -10 N}}
run: {until: 1 s}
"""
LACKING = {
    "thrown": (THROWN, {"work": "no forces, no motions"}),
    "held twice": (HELD_TWICE, dict.fromkeys(("inverse dynamics", "impulse and momentum"), "loads undetermined")),
}


@pytest.mark.parametrize("model", LACKING)
def test_a_route_without_a_figure_says_what_is_lacking(model):
    text, known = LACKING[model]
    routes = Certificate(fb.Mechanism.loads(text).simulate()).own_routes
    assert {route.name: route.stated for route in routes if math.isnan(route.digits)} == known
