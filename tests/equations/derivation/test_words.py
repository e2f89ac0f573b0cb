"""What derivations say of loads, points, freedom and friction: each sentence is held against the mechanics that it tells."""

import numpy as np
import pytest
import store
from evaluated import numbers
from store import ANSWERED, every, subject

import freebody as fb
from freebody.core import GROUND
from freebody.equations.balances.reasons import agree
from freebody.equations.balances.smallest import smallest_set
from freebody.equations.derivation.preamble import degrees, directions
from freebody.solve.perturbed_states import nearby
from freebody.solve.symbolic_state import SymbolicState
from freebody.solve.symbols import load_words
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import Sym, minus, symbols

every_model = every(ANSWERED)
LADDER = """
freebody: 1
name: leaning ladder
parameters: {m: 10 kg, l: 4 m, mu: 0.3}
ground: {lines: {floor: {through: O, angle: 0}, wall: {through: O, angle: -90 deg}}}
bodies:
  ladder: {shape: rod, length: l, mass: m, points: {A: start, B: end}}
joints:
  pos: {type: free, of: [ground.O, ladder.A], coordinates: [x, y, phi]}
contacts:
  foot: {of: [ladder.A, ground.floor], friction: mu}
  top: {of: [ladder.B, ground.wall]}
initial: {x: 2 m, y: 0, phi: 120 deg, at_rest: true}
"""
BLOCK = """
freebody: 1
name: block sliding down a slope
parameters: {m: 2 kg, alpha: 30 deg, mu: 0.2}
ground: {lines: {slope: {through: O, angle: -alpha}}}
bodies:
  block: {shape: rectangle, width: 0.4 m, height: 0.2 m, mass: m, points: {B: [0, -0.1]}, lines: {base: {through: B, angle: 0}}}
joints:
  guide: {type: slider, along: ground.slope, line: block.base, coordinate: s, friction: mu}
initial: {s: 0, rates: {s: 0.1}}
"""
BEARING = """
freebody: 1
name: pendulum in a bearing with friction
parameters: {m: 2 kg, l: 1 m, mu: 0.1, r: 2 cm}
bodies:
  rod: {shape: rod, length: l, mass: m}
joints:
  pin: {type: hinge, of: [ground.O, rod.start], coordinate: {name: theta, zero: down}, friction: mu, bearing_radius: r}
initial: {theta: 60 deg, rates: {theta: 1}}
"""


@pytest.fixture
def written(tmp_path):
    def load(text):
        path = tmp_path / "model.yaml"
        path.write_text(text)
        mechanism = fb.load(path)
        return mechanism, SymbolicState(mechanism.source(), mechanism.start()[0])

    return load


@every_model
def test_a_load_in_a_balance_is_said_for_a_body_of_it(model):
    free = subject(model).free
    for body in free.bodies:
        for load in free.on(body):
            said = load_words(load, [body])
            assert " on " not in said or f" on {body}" in said, said


@every_model
def test_a_push_or_pull_on_the_ground_is_said_for_the_body(model):
    for load in subject(model).free.loads:
        if load.kind in ("contact", "string"):
            assert f"on {GROUND}" not in load_words(load)


@every_model
def test_directions_along_links_are_along_them(model):
    """From the first end to the second: a tension pulls the second body against it; along a line on the ground, across its normal force."""
    at = subject(model)
    for pair in directions(at).pairs:
        if pair.link:
            load = next(load for load in at.free.loads if load.name == pair.link.name and load.kind == "joint")
            force = np.array(next(part.force for part in load.on if part.body != GROUND))
            angle = evaluate(pair.angle, at.values, at.tables) + pair.quarters * np.pi / 2
            along = np.array([np.cos(angle), np.sin(angle)])
            if pair.link.coordinate:
                sense = 1 if pair.link.second != GROUND else -1
                assert along == pytest.approx(-sense * force, abs=1e-12)
            else:
                assert abs(along @ force) < 1e-12


@every_model
def test_degrees_of_freedom_are_the_accelerations_that_what_is_closed_leaves(model):
    """Rows of independent equations take one each: here by the null space, in the code by the rank."""
    at = subject(model)
    rows = [row for row, stated in zip(at.free.rows, at.rows, strict=True) if stated.kind != "motion"]
    table = np.array([list(row.coefficients.values()) for row in rows]).reshape(-1, len(at.coordinates))
    sizes = np.linalg.svd(table, compute_uv=False)
    assert degrees(at) == len(at.coordinates) - int((sizes > 1e-7 * max(1.0, sizes.max(initial=0.0))).sum())


def test_a_ladder_that_stands_has_no_freedom_and_its_foot_none_for_the_positions(written):
    text = " ".join(written(LADDER)[0].equations(long=True).text().split())
    assert "While foot holds and does not slide and top holds, the mechanism has no degrees of freedom." in text
    assert "These are 3 equations among the coordinates. Of these sticking has none for the positions." in text


def test_accelerations_that_are_not_unknown_are_given_with_what_gives_them(written):
    """Balances and closure together give what the full solve gives: nothing is left out."""
    bars = store.mechanism("examples/four_bar"), subject("examples/four_bar")
    for mechanism, at, want in [(*written(LADDER), "top.N"), (*bars, "B.Fx")]:
        found, values = mechanism.equations(want=want), numbers(at)
        moving = {x for part in found.parts for x in symbols(part.residual) if x.dots == 2}
        assert moving <= set(found.unknowns) and found.content.system.is_square
        matrix, right = (
            [[evaluate(x, values) for x in row] for row in rows] for rows in (found.mass_matrix, [found.right_hand_side])
        )
        assert np.linalg.solve(matrix, right[0]) == pytest.approx([values[x] for x in found.unknowns], rel=1e-9, abs=1e-9)


def test_what_slides_has_a_balance_for_its_normal_force(written):
    """N = m g cos α; m s̈ = m g sin α − μ N."""
    found = written(BLOCK)[0].equations()
    assert [part.title for part in found.parts] == [
        "LMB along the normal of the slope for block",
        "LMB along the slope for block",
    ]
    assert "the friction of guide is μ N_guide, against the sliding" in found.text()
    g, alpha, mu = 9.81, np.radians(30), 0.2
    subject = written(BLOCK)[1]
    values = numbers(subject)
    matrix, right = (
        [[evaluate(x, values) for x in row] for row in rows] for rows in (found.mass_matrix, [found.right_hand_side])
    )
    expected = [g * (np.sin(alpha) - mu * np.cos(alpha)), 2 * g * np.cos(alpha)]
    assert np.linalg.solve(matrix, right[0]) == pytest.approx(expected, rel=1e-12)


def test_a_bearing_that_rubs_has_a_couple_and_loses_energy(written):
    text = written(BEARING)[0].equations(long=True).text()
    assert "M_pin = −μ r" in text and "Their sum is not conserved: pin has friction." in text


def test_a_motor_between_two_bodies_is_internal_to_both():
    arm = subject("EX-ARM/held")
    (equation,) = smallest_set("shoulder motor", nearby(arm.source, arm.state), arm.points).equations
    why = {name: item.why for item in equation.dropped for name in item.unknowns}
    assert why["'elbow motor'.force"] == "they are internal to upper + forearm"


def test_reasons_agree_in_number():
    assert (
        agree("it is a couple, which has no part in a force balance", 2)
        == "they are couples, which have no part in a force balance"
    )
    assert agree("its sum with its friction is perpendicular to x", 2) == "their sums with their friction are perpendicular to x"


def test_a_bearing_that_rubs_has_a_balance_for_every_force_of_its_law(written):
    """As many equations and laws as unknowns, and all hold."""
    mechanism, at = written(BEARING)
    found = mechanism.equations(long=True)
    assert len(found.parts) + len(at.laws) == len(found.unknowns) == 4
    values = numbers(at)
    for tree in [*found.equations, *(minus(left, right) for left, right in at.laws)]:
        assert evaluate(tree, values) == pytest.approx(0, abs=1e-9)
    assert "make" in found.text() and "free of joint reactions" in found.text()


GEARS = """
freebody: 1
name: a pair of gears
ground: {points: {B: [0.12 m, 0]}}
bodies: {a: {shape: disk, radius: 3 cm, mass: 1 kg}, b: {shape: disk, radius: 9 cm, mass: 2 kg}}
joints:
  A: {type: hinge, of: [ground.O, a.centre], coordinate: phi}
  B: {type: hinge, of: [ground.B, b.centre], coordinate: psi}
  pair: {type: gear, of: [a.centre, b.centre], radii: [3 cm, 9 cm], pressure_angle: 20 deg}
initial: {phi: 0, rates: {phi: 1}}
"""


def test_gears_turn_as_their_radii_whatever_the_angle_of_their_teeth(written):
    mechanism, _ = written(GEARS)
    for form in ("minimal", "brute"):
        said = mechanism.equations(form).text()
        assert "φ̇ + 3 ψ̇ = 0" in said and "φ̈ + 3 ψ̈ = 0" in said


def test_a_joint_that_closes_a_loop_is_a_point_of_the_body_that_is_cut_free():
    """The slider's pin as the end of the rod: no arm with the way of the slider."""
    moments = [
        part for part in store.mechanism("GEN-SLIDER/model").equations().parts if "rod" in part.title and "AMB" in part.title
    ]
    assert len(moments) == 2 and all(Sym("x") not in symbols(part.left, part.right) for part in moments)
