"""Every model of the catalogue is derived in the three forms, and every printed equation holds in every motion of its mode."""

import re

import numpy as np
import pytest
from conftest import numbers, other_parameters

from freebody.balances.states import RATES, others
from freebody.equations.derivation import FORMS, conserved, derive
from freebody.equations.derivation.told import Subject
from freebody.equations.document import Equation, is_tree
from freebody.equations.tree import ZERO, Add, Sym, evaluate

UNDETERMINED = re.compile(r"\b(nan|NaN|None|inf)\b")
CLOSE = 1e-9


@pytest.mark.parametrize("form", FORMS)
def test_every_equation_holds_elsewhere_and_in_motion(model, form):
    """At other places where the same things touch, are taut and slide the same way, at rates and times of their own."""
    source, start = model.source, model.state
    found = derive(Subject(source, start), form)
    assert not UNDETERMINED.search(found.text())
    assert "<math" in found.html()  # raises for a formula that MathML lacks
    for subject in elsewhere(source, start):
        values = numbers(subject)
        for part in found.parts:
            assert off(part, values, subject.tables) < CLOSE, part.title
        same_signs(found, dict.fromkeys(found.unknowns, 1.0), values, subject.tables)
    if found.content.system.is_square and found.unknowns:
        agrees(found, values, subject.tables)


def test_what_drops_out_of_the_minimal_form_does_so_whatever_the_parameters_are(model):
    """A slope that is level, or two lengths that are equal, at the numbers of the model, are no reason."""
    other = other_parameters(model)
    if other is None:
        pytest.skip("with other parameters other things act")
    values = numbers(other)
    for part in derive(model, "minimal").parts:
        assert off(part, values, other.tables) < CLOSE, part.title


@pytest.mark.parametrize("form", FORMS)
def test_no_printed_equation_says_nothing(model, form):
    sides = [(block.left, block.right) for block in derive(model, form).document.blocks if isinstance(block, Equation)]
    assert not [left for left, right in sides if is_tree(left) and is_tree(right) and left == right]


def test_the_inertia_of_a_coordinate_to_itself_is_positive_in_its_own_equation(model):
    if model.rows or any(body.mass == ZERO for body in model.motions):
        pytest.skip("for trees of bodies with mass")
    matrix = derive(model, "minimal").mass_matrix
    assert all(evaluate(matrix[i][i], model.values, model.tables) > 0 for i in range(len(matrix)))


def elsewhere(source, start):
    """The start, and one of the other states at about each place."""
    return [Subject(source, state) for state in (start, *others(source, start)[::RATES])]


LOST = 1e-6
"""Part of the power in the energy's rate that a central difference may leave."""


def test_energy_is_constant_or_lost_as_is_said(model):
    """Its rate, by a central difference along the true motion, is 0 where it is said to be conserved, and below it where all that is
    said is that something rubs."""
    source, start = model.source, model.state
    kinetic, potential, why = conserved.energy(Subject(source, start))
    rubs_only = re.fullmatch(r"[^;]* rubs?", why)
    if why and not rubs_only:
        pytest.skip(why)
    names = [c["name"] for c in source.about["coordinates"]]
    for state in others(source, start):
        subject = Subject(source, state)
        powers = [power(tree, numbers(subject), names, subject.tables) for tree in (kinetic, potential)]
        size = max(1.0, *map(abs, powers))
        assert sum(powers) < LOST * size
        assert rubs_only or sum(powers) > -LOST * size


def power(tree, values, names, tables, h=1e-5):
    """d/dt of an energy along the motion."""

    def at(t):
        moved = {Sym(n): values[Sym(n)] + t * values[Sym(n, 1)] + t * t / 2 * values[Sym(n, 2)] for n in names}
        moved |= {Sym(n, 1): values[Sym(n, 1)] + t * values[Sym(n, 2)] for n in names}
        return evaluate(tree, values | moved, tables)

    return (at(h) - at(-h)) / (2 * h)


def same_signs(found, moved, values, tables):
    """A row of the matrix form is its printed equation, also in sign: both are off alike where the unknowns are others."""
    for part, row in zip(found.parts, found.content.system.residuals, strict=True):
        printed, told = (evaluate(tree, values | moved, tables) for tree in (part.residual, row))
        assert told == pytest.approx(printed, rel=1e-6, abs=1e-6), part.title


def agrees(found, values, tables):
    """What the matrix form gives is what the core gives, where it determines anything."""
    matrix = np.array([[evaluate(x, values, tables) for x in row] for row in found.mass_matrix])
    right = np.array([evaluate(x, values, tables) for x in found.right_hand_side])
    if np.linalg.matrix_rank(matrix) == len(right):
        expected = np.array([values[x] for x in found.unknowns])
        near = 1e-6 * max(1.0, np.abs(expected).max())
        assert np.linalg.solve(matrix, right) == pytest.approx(expected, rel=1e-6, abs=near)


def off(part, values, tables):
    """What is left of an equation, relative to the largest of its terms, or to 1."""
    size = max([1.0, *(abs(x) for side in (part.left, part.right) for x in terms(side, values, tables))])
    return abs(evaluate(part.residual, values, tables)) / size


def terms(tree, values, tables):
    return [evaluate(term, values, tables) for term in (tree.terms if isinstance(tree, Add) else (tree,))]
