"""What is at hand but carries nothing at a state: a spring at its anchor stands in the equations, a taut string is said to be missing."""

import numpy as np
import pytest

import freebody as fb
from freebody.equations import Sym, evaluate
from freebody.solve.symbolic_state import SymbolicState

LEASH = """
freebody: 1
name: bob on a spring of no rest length, at its anchor
gravity: {gravity}
bodies: {{P: {{shape: particle, mass: {mass}}}}}
joints: {{plane: {{type: free, of: [ground.O, P.centre], coordinates: [x, y]}}}}
forces: {{leash: {{type: spring, between: [ground.O, P.centre], stiffness: {stiffness}}}}}
initial: {{x: 0, y: 0, at_rest: true}}
"""
ROPE = """
freebody: 1
name: block on a rope that hangs straight and carries nothing
gravity: none
bodies: {block: {shape: particle, mass: 2 kg}}
joints: {plane: {type: free, of: [ground.O, block.centre], coordinates: [x, y]}}
strings: {rope: {ends: [ground.O, block.centre]}}
initial: {x: 0, y: -1, at_rest: true}
"""


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


def test_a_taut_string_without_tension_is_said_to_be_missing() -> None:
    """With a rate along x the rope pulls at once, so its momentum is constant only as long as it carries nothing."""
    mechanism = fb.Mechanism.loads(ROPE)
    said = " ".join(mechanism.equations().text().split())
    assert "At this state rope is closed but carries no load, so that it is in no equation here" in said
    assert "As long as rope carries no load, the momentum of block along x is conserved" in said
    moving = " ".join(mechanism.equations(rates={"x": 1, "y": 0}).text().split())
    assert "T_rope" in moving and "As long as" not in moving
