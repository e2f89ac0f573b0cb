"""Every model of the catalogue is derived in the three forms, and every printed equation holds in every motion of its mode."""

import re

import numpy as np
import pytest
from evaluated import balanced, numbers, off, other_parameters
from store import ANSWERED, derived, elsewhere, every, subject

from freebody.document.blocks import Equation, is_tree
from freebody.equations.derivation import conserved
from freebody.equations.derivation.derive import FORMS
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import add, minus, mul

UNDETERMINED = re.compile(r"\b(nan|NaN|None|inf)\b")
CLOSE = 1e-9


every_model = every(ANSWERED)


@every_model
@pytest.mark.parametrize("form", FORMS)
def test_every_equation_holds_elsewhere_and_in_motion(model, form):
    """At other places where the same things touch, are taut and slide the same way, at rates and times of their own."""
    found, states = derived(model, form), elsewhere(model)
    assert not UNDETERMINED.search(found.text())
    assert "<math" in found.html()  # raises for a formula that MathML lacks
    assert len(states) > 1
    for at in states:
        values = numbers(at)
        for part in found.parts:
            assert off(part, values, at.tables) < CLOSE, part.title
        same_signs(found, dict.fromkeys(found.unknowns, 1.0), values, at.tables)
    if found.content.system.is_square and found.unknowns:
        agrees(found, values, at.tables)


ONLY_SO = {"19.3.2/model", "19.3.2/with_spin", "19.3.4/model", "19.3.4/ceiling", "19.3.13/model", "GEN-STEP/floor", "S19.15/free"}
"""With other parameters something lets go, has another place to touch, or has no free length there either."""


@every_model
def test_what_drops_out_of_the_minimal_form_does_so_whatever_the_parameters_are(model):
    """A slope that is level, or two lengths that are equal, at the numbers of the model, are no reason."""
    other = other_parameters(subject(model))
    assert (other is None) == (model in ONLY_SO)
    for part in derived(model, "minimal").parts if other else []:
        assert off(part, numbers(other), other.tables) < CLOSE, part.title


@every_model
@pytest.mark.parametrize("form", FORMS)
def test_no_printed_equation_says_nothing(model, form):
    sides = [(block.left, block.right) for block in derived(model, form).blocks if isinstance(block, Equation)]
    assert not [left for left, right in sides if is_tree(left) and is_tree(right) and left == right]


TREES = (
    "19.3.1/model", "19.3.3/finite", "19.3.3/polar", "19.3.6/model", "19.3.7/straight", "19.3.15/model", "19.3.16/clockwise",
    "19.3.17/model", "19.3.20/model", "19.3.23/link", "19.3.24/model", "19.3.28/horizontal", "EX-ARM/model", "EX-ARM/relative",
    "EX-BLOCK/rollers_on_lower", "GEN-CHAIN/model", "GEN-STEP/model", "S19.16/model", "S19.17/flight", "S19.18/model",
    "examples/tossed_box",
)  # fmt: skip


@every(TREES)
def test_the_inertia_of_a_coordinate_to_itself_is_positive_in_its_own_equation(model):
    """In trees of bodies with mass."""
    matrix = derived(model, "minimal").mass_matrix
    assert matrix and all(evaluate(row[i], subject(model).values, subject(model).tables) > 0 for i, row in enumerate(matrix))


@every_model
def test_the_rate_of_energy_is_the_power_of_what_acts(model):
    """What is said follows: the sum of energies is constant, or friction takes from it."""
    kinetic, potential, why = conserved.energy(subject(model))
    for at in elsewhere(model):
        change, rounding = balanced(kinetic, potential, at)
        assert why or abs(change) < rounding
        assert not re.fullmatch(r"[^;]* (has|have) friction", why) or change < rounding


def same_signs(found, moved, values, tables):
    """A row of the matrix form is its printed equation, also in sign: both are off alike where the unknowns are others."""
    for part, row, right in zip(found.parts, found.mass_matrix, found.right_hand_side, strict=True):
        trees = (part.residual, minus(add(*map(mul, row, found.unknowns)), right))
        printed, stated = (evaluate(tree, values | moved, tables) for tree in trees)
        assert stated == pytest.approx(printed, rel=1e-6, abs=1e-6), part.title


def agrees(found, values, tables):
    """What the matrix form gives is what the core gives, where it determines anything."""
    matrix = np.array([[evaluate(x, values, tables) for x in row] for row in found.mass_matrix])
    right = np.array([evaluate(x, values, tables) for x in found.right_hand_side])
    if np.linalg.matrix_rank(matrix) == len(right):
        expected = np.array([values[x] for x in found.unknowns])
        near = 1e-6 * max(1.0, np.abs(expected).max())
        assert np.linalg.solve(matrix, right) == pytest.approx(expected, rel=1e-6, abs=near)
