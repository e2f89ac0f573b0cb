"""Every model of the catalogue is derived in the three forms, and every printed equation holds at random states."""

import re

import numpy as np
import pytest
from conftest import FILES, loaded, named, numbers, states

from freebody import _core
from freebody.equations.derivation import FORMS, derive
from freebody.equations.derivation.told import Subject
from freebody.equations.tree import Add, evaluate

UNDETERMINED = re.compile(r"\b(nan|NaN|None|inf)\b")
CLOSE = 1e-9


@pytest.fixture(params=FILES, ids=named)
def model(request):
    mechanism, start = loaded(request.param)
    try:
        mechanism.solve()
    except _core.MotionError:
        pytest.skip("the model has no motion at all")
    return mechanism.source(), start


@pytest.mark.parametrize("form", FORMS)
def test_every_equation_holds_at_random_states(model, form):
    source, start = model
    found = derive(Subject(source, start), form)
    assert not UNDETERMINED.search(found.text())
    assert "<math" in found.html()  # raises for a formula that MathML lacks
    for subject in states(source, start, count=1):
        values = numbers(subject)
        for part in found.parts:
            assert off(part, values, subject.tables) < CLOSE, part.title
        same_signs(found, dict.fromkeys(found.unknowns, 1.0), values, subject.tables)
    if found.content.system.is_square and found.unknowns:
        agrees(found, values, subject.tables)


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
