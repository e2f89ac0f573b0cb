"""A crank that is driven where its linkage does not reach: the run ends in a moment, by name, and at the angle of the closed form."""

import math
from pathlib import Path

import numpy as np
import pytest

import freebody as fb
from freebody.run.peaks import peak_reactions

FOUR_BAR = """
freebody: 1
parameters: {{a: {a} m, b: {b} m, c: {c} m, d: 1 m}}
ground: {{points: {{D: [d, 0]}}}}
bodies:
  crank: {{shape: rod, length: a, mass: 0.2 kg}}
  coupler: {{shape: rod, length: b, mass: 0.5 kg}}
  rocker: {{shape: rod, length: c, mass: 0.4 kg}}
joints:
  A: {{type: hinge, of: [ground.O, crank.start], coordinate: theta}}
  B: {{type: hinge, of: [crank.end, coupler.start], coordinate: {{name: beta, absolute: true}}}}
  D: {{type: hinge, of: [ground.D, rocker.start], coordinate: phi}}
  C: {{type: hinge, of: [coupler.end, rocker.end]}}
motions: {{motor: {{of: theta, {motion}}}}}
initial: {{theta: 1 rad, {rates}guess: {{beta: 0.5 rad, phi: 1.7 rad}}}}
run: {{until: 3 s}}
"""


FORWARD = {
    "is: 1 + 2*t": "",
    "is: 2, level: velocity": "",
    "is: 1 + t, level: velocity": "",
    "is: 0.5, level: acceleration": "rates: {theta: 1}, ",
}
BACKWARD = {
    "is: 1 - 2*t": "",
    "is: -2, level: velocity": "",
    "is: -0.5, level: acceleration": "rates: {theta: -1}, ",
}
"""Motions of an angle from 1 rad on, at the level of positions, velocities and accelerations, with rates that start them."""


def refused(tmp_path: Path, text: str, until: float = 3.0) -> fb.Run:
    """The run of a mechanism that is driven where it does not reach."""
    file = tmp_path / "model.yaml"
    file.write_text(text)
    steps = iter(range(400))
    run = fb.load(file).simulate(until=until, progress=lambda t: next(steps, None) is not None)
    assert run.outcome.name == "dead_position" and run.outcome.path == "motions.motor", run.outcome
    return run


@pytest.mark.parametrize(("motion", "rates"), FORWARD.items())
@pytest.mark.parametrize(("a", "b", "c"), [(0.4, 0.5, 0.8), (0.6, 0.6, 0.7), (0.5, 0.9, 0.3), (0.7, 0.4, 0.8)])
def test_the_four_bar_stops_where_coupler_and_rocker_are_in_line(tmp_path, a, b, c, motion, rates):
    """There |BD| = b + c: cos θ = (a² + d² − (b + c)²)/(2 a d)."""
    run = refused(tmp_path, FOUR_BAR.format(a=a, b=b, c=c, motion=motion, rates=rates))
    theta = math.acos((a * a + 1 - (b + c) ** 2) / (2 * a))
    assert f"the loop at `C` cannot close beyond theta = {math.degrees(theta):.1f}°" in run.outcome.sentence
    assert theta - 1e-3 < run.q[-1, 0] < theta


@pytest.mark.parametrize(("motion", "rates"), BACKWARD.items())
@pytest.mark.parametrize(("a", "b", "c"), [(0.5, 0.9, 0.3), (0.4, 0.2, 0.9), (0.6, 0.3, 0.95)])
def test_the_four_bar_stops_where_coupler_and_rocker_are_folded(tmp_path, a, b, c, motion, rates):
    """There |BD| = |b − c|."""
    run = refused(tmp_path, FOUR_BAR.format(a=a, b=b, c=c, motion=motion, rates=rates))
    theta = math.acos((a * a + 1 - (b - c) ** 2) / (2 * a))
    assert f"beyond theta = {math.degrees(theta):.1f}°" in run.outcome.sentence
    assert theta < run.q[-1, 0] < theta + 5e-3


SLIDER_CRANK = """
freebody: 1
parameters: {{r: 0.1 m, l: {l} m}}
bodies:
  crank: {{shape: rod, length: r, mass: 0.2 kg}}
  rod: {{shape: rod, length: l, mass: 0.3 kg}}
  piston: {{mass: 0.5 kg, inertia: 1e-3}}
joints:
  O: {{type: hinge, of: [ground.O, crank.start], coordinate: theta}}
  A: {{type: hinge, of: [crank.end, rod.start]}}
  track: {{type: slider, along: {{through: ground.O, angle: 0}}, line: {{through: piston.origin, angle: 0}}, coordinate: x}}
  B: {{type: hinge, of: [rod.end, piston.origin]}}
motions: {{motor: {{of: x, {motion}}}}}
initial: {{x: l, {rates}guess: {{theta: 80 deg}}}}
"""


STROKES = ["is: l + {v}*t", "is: {v}, level: velocity", "is: {v}*(1 + t), level: velocity", "is: {v}/10, level: acceleration"]


@pytest.mark.parametrize("motion", STROKES)
@pytest.mark.parametrize(("l", "v"), [(l, v) for l in (0.15, 0.25, 0.4) for v in (-0.2, 0.2)])
def test_a_driven_piston_stops_at_the_end_of_its_stroke(tmp_path, l, v, motion):
    """At x = l ± r, where crank and rod are in line."""
    rates = f"rates: {{x: {v}}}, " if "acceleration" in motion else ""
    run = refused(tmp_path, SLIDER_CRANK.format(l=l, motion=motion.format(v=v), rates=rates))
    end = l + math.copysign(0.1, v)
    assert f"beyond x = {end:.4f} m" in run.outcome.sentence
    assert 0 < (end - run.evaluate("x", run.edges[-1])) * math.copysign(1, v) < 1e-3


LADDER = """
freebody: 1
parameters: {N: 2, l: 1 m}
ground: {points: {"A[i = 0 .. N]": [i*l, 0]}}
bodies:
  post[i = 0 .. N]: {shape: rod, length: l, mass: 1 kg}
  coupler[i = 1 .. N]: {shape: rod, length: l, mass: 1 kg}
joints:
  foot[i = 0 .. N]: {type: hinge, of: ["ground.A[i]", "post[i].start"], coordinate: "theta[i]"}
  left[i = 1 .. N]: {type: hinge, of: ["post[i-1].end", "coupler[i].start"], coordinate: {name: "phi[i]", absolute: true}}
  right[i = 1 .. N]: {type: hinge, of: ["coupler[i].end", "post[i].end"]}
initial: {"theta[0]": 90 deg, rates: {"theta[0]": -1}, guess: {"theta[i = 0 .. N]": 90 deg}}
"""


LONGEST_STEPS = [None, *(0.047 + 0.0026 * k for k in range(12))]


@pytest.mark.parametrize(("n", "longest_steps"), [(12, LONGEST_STEPS), (24, LONGEST_STEPS), (100, [None])])
def test_a_row_of_four_bars_passes_its_flat_position_wherever_a_step_lands(
    tmp_path: Path, n: int, longest_steps: list[float | None]
) -> None:
    """There all loops lose their independence: 2.5 s take some 80 steps, and not thousands of small ones near it."""
    file = tmp_path / "ladder.yaml"
    file.write_text(LADDER)
    mechanism = fb.load(file)
    mechanism.parameters["N"] = n
    for longest in longest_steps:
        steps = iter(range(250))
        run = mechanism.simulate(
            until=2.5, rtol=1e-11, max_step=longest, progress=lambda t, steps=steps: next(steps, None) is not None
        )
        assert run.outcome.ok, (longest, run.outcome)


def test_reactions_of_a_run_that_touches_a_singular_place_are_indeterminate_there():
    """A slider driven to the axle of its crank, which is as long as the rod, and back: there the rod may turn by itself."""
    model = fb.Mechanism.loads("""
freebody: 1
bodies: {crank: {shape: rod, length: 0.2, mass: 1}, rod: {shape: rod, length: 0.2, mass: 1}, p: {shape: particle, mass: 1}}
joints:
  A: {type: hinge, of: [ground.O, crank.start], coordinate: theta}
  B: {type: hinge, of: [crank.end, rod.start], coordinate: beta}
  C: {type: hinge, of: [rod.end, p.centre]}
  g: {type: slot, along: {through: ground.O, angle: 0}, point: p.centre, coordinate: x}
motions: {m: {of: x, is: "0.15*(1 + cos(t))"}}
initial: {guess: {theta: 0.7, beta: -1.4, x: 0.3}}
""")
    run = model.simulate(7)
    forces = run.motion.evaluate(["A.F", "m.force"], math.pi + 10.0 ** -np.arange(3, 13))
    assert run.outcome.ok and np.isfinite(forces[0]).all() and np.isnan(forces).any()
    assert all(peak.joint for peak in peak_reactions(run))


EQUAL_RODS = """
freebody: 1
parameters: {l: 0.3 m}
ground: {lines: {rail: {through: O, angle: 0}}}
bodies: {crank: {shape: rod, length: l, mass: 1 kg}, rod: {shape: rod, length: l, mass: 1 kg}}
joints:
  A: {type: hinge, of: [ground.O, crank.start], coordinate: theta}
  B: {type: hinge, of: [crank.end, rod.start], coordinate: {name: psi, absolute: true}}
  C: {type: slot, along: ground.rail, point: rod.end, coordinate: x}
motions: {motor: {of: x, is: LAW}}
initial: {guess: {theta: 60 deg, psi: -60 deg, x: l}}
"""


def test_where_a_mechanism_only_comes_nearer_to_a_singular_position_it_ends_by_name(tmp_path):
    """Crank and rod of one length fold on one another where x = 2 l cos θ is 0: there nothing of the accelerations is known."""
    run = refused(tmp_path, EQUAL_RODS.replace("LAW", "l*exp(-t/(1 s))"), 60.0)
    assert "stays next to it" in run.outcome.sentence
    np.testing.assert_allclose(np.cos(run.evaluate("theta", [1.0, 5.0])), np.exp([-1.0, -5.0]) / 2, rtol=1e-6)
    assert run.outcome.t > 15


def test_a_singular_position_that_is_passed_is_no_end(tmp_path):
    (tmp_path / "model.yaml").write_text(EQUAL_RODS.replace("LAW", "l*cos(t/(1 s))"))
    run = fb.load(tmp_path / "model.yaml").simulate(until=3.0)
    assert run.outcome.ok, run.outcome
