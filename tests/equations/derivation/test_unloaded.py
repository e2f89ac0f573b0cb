"""What is at hand but carries nothing at a state stands in the equations: a spring at its anchor, a taut string, a contact."""

import numpy as np
import pytest

import freebody as fb
from freebody.equations import Sym, evaluate
from freebody.solve.symbolic_state import Motion, SymbolicState

LEASH = """
freebody: 1
name: bob on a spring of no rest length, at its anchor
gravity: {gravity}
bodies: {{P: {{shape: particle, mass: {mass}}}}}
joints: {{plane: {{type: free, of: [ground.O, P.centre], coordinates: [x, y]}}}}
forces: {{leash: {{type: spring, between: [ground.O, P.centre], stiffness: {stiffness}}}}}
initial: {{x: 0, y: 0, at_rest: true}}
"""
UNLOADED = {
    "rope": """
name: block that goes round on a rope, as it starts from rest by a force that grows from nothing
gravity: none
bodies: {{block: {{shape: particle, mass: {a} kg}}}}
joints: {{plane: {{type: free, of: [ground.O, block.centre], coordinates: [x, y]}}}}
strings: {{rope: {{ends: [ground.O, block.centre]}}}}
forces: {{push: {{type: force, at: block.centre, x: "{b} N/s * t"}}}}
initial: {{x: 0, y: -{c}, at_rest: true}}
""",
    "cable": """
name: two blocks on one slope, the cable between them
bodies: {{one: {{shape: particle, mass: {a} kg}}, other: {{shape: particle, mass: {b} kg}}}}
ground: {{lines: {{slope: {{through: O, angle: "-{c}"}}}}}}
joints:
  slot 1: {{type: slot, along: ground.slope, point: one.centre, coordinate: x}}
  slot 2: {{type: slot, along: ground.slope, point: other.centre, coordinate: y}}
strings: {{cable: {{ends: [one.centre, other.centre]}}}}
initial: {{x: 0, y: 1, at_rest: true}}
""",
    "wall": """
name: ball in a hollow on a cart
bodies:
  cart: {{mass: {a} kg, lines: {{axle: {{through: origin, angle: 0}}}}, points: {{C: [0, {c}]}}}}
  ball: {{shape: particle, mass: {b} kg}}
ground: {{lines: {{road: {{through: O, angle: 0}}}}}}
joints: {{wheels: {{type: slider, along: ground.road, line: cart.axle, coordinate: s}}}}
contacts: {{wall: {{of: [ball, {{centre: cart.C, radius: {c}, hollow: true}}]}}}}
initial: {{s: 0, ball.x: "-{c}", ball.y: {c}, at_rest: true}}
""",
    "wound": """
name: particle on a string that is wound whole on a drum that turns
gravity: none
bodies: {{drum: {{shape: disk, radius: {c}, mass: {a} kg}}, P: {{shape: particle, mass: {b} kg}}}}
joints: {{axle: {{type: hinge, of: [ground.O, drum.centre], coordinate: theta}}}}
strings: {{wound: {{ends: [P.centre, {{drum: drum.centre, radius: {c}, sense: clockwise, wound: 5}}]}}}}
initial: {{theta: 0, P.x: {c}, P.y: 0, rates: {{theta: 2, P.x: 0, P.y: "2*{c}"}}}}
""",
}


def unloaded(kind: str, seed: int) -> fb.Mechanism:
    """One of the models above, with random masses and sizes."""
    a, b, c = np.random.default_rng(seed).uniform(0.3, 1.4, 3).tolist()
    return fb.Mechanism.loads("freebody: 1" + UNLOADED[kind].format(a=a, b=b, c=c))


@pytest.mark.parametrize(("mass", "stiffness", "gravity"), [(2, 8, "none"), (0.3, 50, 9.81)])
@pytest.mark.parametrize("form", ["minimal", "brute", "constraints"])
def test_the_equations_at_an_anchor_hold_beside_it(mass: float, stiffness: float, gravity: object, form: str) -> None:
    """m a = m g − k r holds at the anchor and everywhere: the equations asked there are satisfied by the core's motion elsewhere."""
    mechanism = fb.Mechanism.loads(LEASH.format(mass=mass, stiffness=stiffness, gravity=gravity))
    equations = mechanism.equations(form)
    state, _ = mechanism.start(x=0.4, y=-0.7)
    there = SymbolicState(mechanism.source(), state)
    values = there.values
    values |= {
        Sym(f"{name}_P", dots): values[Sym(name, dots)] for name in "xy" for dots in range(3)
    }  # the places of the body by itself
    assert [float(evaluate(tree, values)) for tree in equations.equations] == pytest.approx([0, 0], abs=1e-12)
    answers = mechanism.solve_in_letters()
    expected = -stiffness / mass * np.array([0.4, -0.7]) - [0, 0 if gravity == "none" else gravity]
    assert [float(evaluate(answers[name], there.values)) for name in "xy"] == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("kind", UNLOADED)
@pytest.mark.parametrize("seed", range(3))
def test_what_could_carry_stands_in_the_free_bodies_with_no_force(kind: str, seed: int) -> None:
    """It has its line of action, is exactly 0, and all balances close with it."""
    mechanism = unloaded(kind, seed)
    free = mechanism.solve().free_bodies()
    [load] = [load for load in free.loads if load.name == kind]
    assert load.value == 0.0 and load.unknown and load.determinate
    assert all(np.hypot(*part.force) == pytest.approx(1, abs=1e-7) for part in load.on)
    assert all(free.balance_gap(body) < 1e-12 for body in free.bodies)


@pytest.mark.parametrize("form", ["minimal", "brute", "constraints"])
@pytest.mark.parametrize("kind", UNLOADED)
@pytest.mark.parametrize("seed", range(2))
def test_equations_at_a_state_without_load_hold_in_the_motion(kind: str, seed: int, form: str) -> None:
    """They were derived where nothing is carried, and are satisfied where much is, by states of the core's own run."""
    mechanism = unloaded(kind, seed)
    equations, run = mechanism.equations(form).equations, mechanism.simulate(until=0.4)
    for t in (0.1, 0.25, 0.4):
        there = SymbolicState(mechanism.source(), run.motion.state(t))
        assert any(load.name == kind and (load.value > 0 or kind == "cable") for load in there.free.loads)
        values = there.values | {x: v for motion in there.motions for x, v in placed(motion, there).items()}
        scale = max(abs(v) for v in values.values())
        assert [float(evaluate(tree, values)) for tree in equations] == pytest.approx([0] * len(equations), abs=1e-8 * scale)


def placed(motion: Motion, there: SymbolicState) -> dict[Sym, float]:
    """Place, angle and rates of a body by itself: the coordinates of the form with constraints."""
    vectors = {"x": 0, "y": 1}
    found = {
        Sym(f"{name}_{motion.body}", dots): float(evaluate(vector.xy[i], there.values))
        for name, i in vectors.items()
        for dots, vector in enumerate((motion.r, motion.v, motion.a))
    }
    turning = enumerate((motion.angle, motion.omega, motion.alpha))
    return found | {Sym(f"phi_{motion.body}", dots): float(evaluate(tree, there.values)) for dots, tree in turning}


def test_no_momentum_is_conserved_that_an_unloaded_string_would_change() -> None:
    """A rope at rest pulls as soon as the block moves: its angular momentum about the anchor is constant, no other."""
    mechanism = fb.Mechanism.loads("freebody: 1" + UNLOADED["rope"].format(a=2.0, b=0.0, c=1.0))
    said = " ".join(mechanism.equations(long=True).text().split())
    assert "While rope is taut, the mechanism has one degree of freedom" in said
    assert "angular momentum of block about ground.O is conserved" in said and "momentum of block along" not in said


def test_what_others_hold_closed_carries_nothing() -> None:
    """Three strings from a block to three points on a line above it: two, or one, suffice, and how three share is not determined."""
    text = """
name: block on three strings
bodies: {block: {shape: particle, mass: 2 kg}}
joints: {plane: {type: free, of: [ground.O, block.centre], coordinates: [x, y]}}
ground: {points: {A: [-1, 1], B: [0, 1], C: [1, 1]}}
strings: {a: {ends: [ground.A, block.centre]}, b: {ends: [ground.B, block.centre]}, c: {ends: [ground.C, block.centre]}}
initial: {x: 0, y: 0, at_rest: true}
"""
    free = fb.Mechanism.loads("freebody: 1" + text).solve().free_bodies()
    assert len([load for load in free.loads if load.kind == "string"]) == 2
