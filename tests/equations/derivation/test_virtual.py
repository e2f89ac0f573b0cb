"""Virtual power: equations without reactions where no balance gives any, true in every motion, as many as degrees of freedom."""

import numpy as np
from evaluated import numbers, terms
from store import ROOT, elsewhere, every, subject
from test_every_derivation import CLOSE

import freebody as fb
from freebody.equations.derivation.virtual import virtual_power
from freebody.equations.topics import topic
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import Sym

CLOSED = (
    "19.3.20/cable", "19.3.20/pulleys", "19.3.21/model", "19.3.21/broken", "19.3.21/plumb", "GEN-FOURBAR/model",
    "GEN-FOURBAR/limits", "GEN-FOURBAR/watt", "GEN-SLIDER/model", "GEN-SLIDER/dead_point", "GEN-SLIDER/driven", "S19.21/model",
    "S19.21/driven", "S19.22/model", "S19.22/driven", "S19.22/uneven", "examples/beam_held_twice", "examples/four_bar",
)  # fmt: skip
"""Models in which something is closed, by a joint or a string."""
closed = every(CLOSED)


@closed
def test_every_equation_holds_in_motion_and_the_virtual_rates_keep_closed_what_is_closed(model):
    for at in elsewhere(model):
        values, tables = numbers(at), at.tables
        for power in virtual_power(at):
            size = max([1.0, *(abs(x) for side in (power.left, power.right) for x in terms(side, values, tables))])
            assert abs(evaluate(power.residual, values, tables)) < CLOSE * size
            rates = {name: evaluate(tree, values, tables) for name, tree in power.rates.items()}
            for row, held in zip(at.free.rows, at.rows, strict=True):
                if held.kind != "motion":
                    parts = [row.coefficients[name] * rates[name] for name in rates]
                    assert abs(sum(parts)) < CLOSE * max(1.0, *map(abs, parts))


@closed
def test_the_equations_hold_no_reaction_and_are_as_many_as_the_degrees_of_freedom(model):
    first = subject(model)
    motions = {load.symbol for load in first.free.loads if load.kind == "motion"}
    found = virtual_power(first)
    assert all(set(power.reactions) <= motions for power in found)
    values = numbers(first)
    names = [c["name"] for c in first.coordinates]
    rates = np.array([[evaluate(tree, values, first.tables) for tree in power.rates.values()] for power in found])
    held = [
        [row.coefficients[n] for n in names]
        for row, stated in zip(first.free.rows, first.rows, strict=True)
        if stated.kind != "motion"
    ]
    if np.linalg.matrix_rank(held) == len(names) - len(found):
        assert np.linalg.matrix_rank(rates) == len(found)


def test_the_topic_says_how_coordinates_change_and_what_has_power():
    said = topic(fb.load(ROOT / "examples/four_bar.yaml"), "virtual_power").text(ascii=True)
    assert "Σ (F · δv + M δω) = Σ (m a · δv + I α δω)" in said and "δθ = -b c sin(beta - phi)" in said and "A.Fx" not in said


def test_two_blocks_on_a_cable_have_the_sum_of_their_balances():
    """Of m₁ ẍ₁ = T and m₂ ÿ₂ = T − m₂ g with ẍ₁ = −ÿ₂ the tension drops out: (m₁ + m₂) ẍ₁ = m₂ g."""
    (power,) = virtual_power(subject("19.3.21/model"))
    assert not power.reactions
    assert {symbol.dots for symbol in power.linear.coefficients} == {2}
    assert all(Sym(name) not in power.linear.coefficients for name in ("cable.tension",))
