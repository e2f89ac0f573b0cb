"""Virtual power: equations without reactions where no balance gives any, true in every motion, as many as degrees of freedom."""

import numpy as np
import pytest
from conftest import FILES, loaded, named, numbers, states
from test_every_derivation import CLOSE, terms

from freebody import _core
from freebody.equations.derivation.told import Subject
from freebody.equations.derivation.virtual import virtual_power
from freebody.equations.tree import Sym, evaluate

CLOSED = [
    path
    for path in FILES
    if path.parent.name in ("GEN-FOURBAR", "GEN-SLIDER", "S19.21", "S19.22", "19.3.20", "19.3.21", "examples")
]


@pytest.fixture(params=CLOSED, ids=named)
def closed(request):
    mechanism, start = loaded(request.param)
    source = mechanism.source()
    subject = Subject(source, start)
    if not any(row.kind != "motion" for row in subject.rows):
        pytest.skip("nothing is closed")
    try:
        virtual_power(subject)
    except _core.MotionError:
        pytest.skip("too long in letters")
    return source, start


def test_every_equation_holds_in_motion_and_the_virtual_rates_keep_closed_what_is_closed(closed):
    source, start = closed
    for subject in states(source, start):
        values, tables = numbers(subject), subject.tables
        for power in virtual_power(subject):
            size = max([1.0, *(abs(x) for side in (power.left, power.right) for x in terms(side, values, tables))])
            assert abs(evaluate(power.residual, values, tables)) < CLOSE * size
            rates = {name: evaluate(tree, values, tables) for name, tree in power.rates.items()}
            for row, held in zip(subject.free.rows, subject.rows, strict=True):
                if held.kind != "motion":
                    parts = [row.coefficients[name] * rates[name] for name in rates]
                    assert abs(sum(parts)) < CLOSE * max(1.0, *map(abs, parts))


def test_the_equations_hold_no_reaction_and_are_as_many_as_the_degrees_of_freedom(closed):
    source, start = closed
    subject = Subject(source, start)
    motions = {load.symbol for load in subject.free.loads if load.kind == "motion"}
    found = virtual_power(subject)
    assert all(set(power.reactions) <= motions for power in found)
    values = numbers(subject)
    names = [c["name"] for c in subject.coordinates]
    rates = np.array([[evaluate(tree, values, subject.tables) for tree in power.rates.values()] for power in found])
    held = [
        [row.coefficients[n] for n in names]
        for row, told in zip(subject.free.rows, subject.rows, strict=True)
        if told.kind != "motion"
    ]
    if np.linalg.matrix_rank(held) == len(names) - len(found):
        assert np.linalg.matrix_rank(rates) == len(found)


def test_two_blocks_on_a_cable_have_the_sum_of_their_balances():
    """Of m₁ ẍ₁ = T and m₂ ÿ₂ = T − m₂ g with ẍ₁ = −ÿ₂ the tension drops out: (m₁ + m₂) ẍ₁ = m₂ g."""
    path = next(path for path in FILES if str(path).endswith("19.3.21/model.yaml"))
    mechanism, start = loaded(path)
    subject = Subject(mechanism.source(), start)
    (power,) = virtual_power(subject)
    assert not power.reactions
    assert {letter.dots for letter in power.linear.coefficients} == {2}
    assert all(Sym(name) not in power.linear.coefficients for name in ("cable.tension",))
