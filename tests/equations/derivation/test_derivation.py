"""What a derivation says: known textbook equations, what is conserved, the smallest sets, and every way of printing."""

import json

import numpy as np
import pytest
from evaluated import numbers, rate
from store import ROOT
from typer.testing import CliRunner

import freebody as fb
from freebody.cli import app
from freebody.equations.derivation import conserved
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.algebra import quotient
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.presentation import presented
from freebody.symbolic.tree import Sym, mul, power, read, symbols

GUN = "examples/new_gun.yaml"


def of(path, *args, **words):
    return fb.load(ROOT / path).equations(*args, **words)


def test_the_minimal_form_of_a_tree_is_stated_as_a_person_states_it():
    found = of(GUN, long=True)
    assert [part.title for part in found.parts] == [
        "AMB about pivot for rod + collar",
        "LMB along the slot track for collar",
    ]
    text = " ".join(found.text().split())
    assert "pivot_x and pivot_y (they act at pivot)" in text
    assert "N_track (it is internal to rod + collar)" in text
    assert [x.name for x in found.unknowns] == ["theta", "R"]


def test_no_reaction_is_in_the_minimal_form_of_a_tree():
    for path in (
        GUN,
        "systems/EX-ARM-two-link-arm/relative.yaml",
        "systems/S19.18-pendulum-on-an-incline/model.yaml",
        "systems/19.3.5-dumbbell-on-a-floor/model.yaml",
    ):
        assert of(path).content.reactions == ()


def test_a_four_bar_says_which_reactions_stay():
    found = of("examples/four_bar.yaml", long=True)
    assert found.content.reactions == ("C.Fx", "C.Fy")
    text = " ".join(found.text().split())
    assert "at least two reactions stay in every set of balances" in text
    assert "Here C_x and C_y stay" in text


def test_forms_count_their_equations():
    brute, most = of(GUN, "brute"), of(GUN, "constraints")
    assert len(brute.parts) == 3 + 2 and len(brute.unknowns) == 2 + 3
    assert len(most.parts) == 3 + 2 + 3 and most.content.system.is_square


def test_symbols_set_to_numbers_are_gone():
    found = of(GUN, at_rest=True, fixed={"l": "2 m"})
    assert {symbol.dots for tree in found.equations for symbol in symbols(tree)} == {0, 2}
    assert "l" not in {symbol.name for tree in found.equations for symbol in symbols(tree)}


@pytest.mark.parametrize("wanted", ["pivot.Fx", "track.Fn", "theta"])
def test_the_smallest_set_gives_what_the_full_solve_gives(wanted):
    mechanism = fb.load(ROOT / GUN)
    found = mechanism.equations(want=wanted)
    values = numbers(SymbolicState(mechanism.source(), mechanism.start()[0]))
    matrix, right = (
        [[evaluate(x, values) for x in row] for row in rows] for rows in (found.mass_matrix, [found.right_hand_side])
    )
    assert np.linalg.solve(matrix, right[0]) == pytest.approx([values[x] for x in found.unknowns], abs=1e-12)
    assert len(found.parts) == len(mechanism.smallest(wanted).equations)


def test_what_is_not_unknown_is_reported():
    result = CliRunner().invoke(app, ["equations", str(ROOT / GUN), "--for", "nosuch"])
    assert result.exit_code == 2 and "nosuch" in result.output


@pytest.mark.parametrize(
    "path",
    [
        "examples/four_bar.yaml",
        "systems/19.3.5-dumbbell-on-a-floor/model.yaml",
        "systems/S19.18-pendulum-on-an-incline/model.yaml",
    ],
)
def test_energy_that_is_said_to_be_conserved_has_no_rate(path):
    mechanism = fb.load(ROOT / path)
    subject = SymbolicState(mechanism.source(), mechanism.start()[0])
    assert abs(rate(conserved.total(subject), subject)) < 1e-9


def test_momentum_that_is_conserved_is_said_to_be():
    assert "The momentum along x is conserved" in of("systems/19.3.5-dumbbell-on-a-floor/model.yaml", long=True).text()
    assert "No momentum" in of("examples/four_bar.yaml", long=True).text()


@pytest.mark.parametrize("form", ["minimal", "brute", "constraints"])
def test_every_way_of_printing(form):
    found = of(GUN, form, long=True)
    assert found.latex().count(r"\begin{equation}") == found.latex().count(r"\end{equation}") > 3
    assert "$$" in found.markdown() and "<h2>" in found.html() and json.loads(found.json())["blocks"]
    a, x, b = found.sympy()
    assert a.shape == (len(b), len(x))


def test_the_command_writes_files_by_their_ending(tmp_path):
    for ending in ("txt", "tex", "md", "json"):
        file = tmp_path / f"gun.{ending}"
        result = CliRunner().invoke(app, ["equations", str(ROOT / GUN), "-o", str(file)])
        assert result.exit_code == 0 and file.read_text()
    refused = CliRunner().invoke(app, ["equations", str(ROOT / GUN), "-o", str(tmp_path / "gun.py")])
    assert refused.exit_code != 0


SUMS = [
    {"add": [{"mul": [{"num": "-2"}, {"sym": "l"}, {"sym": "a"}]}, {"mul": [{"num": "-4"}, {"sym": "l"}, {"sym": "b"}]}]},
    {"add": [{"pow": [{"sym": "a"}, "2"]}, {"mul": [{"num": "-2"}, {"sym": "a"}, {"sym": "b"}]}, {"pow": [{"sym": "b"}, "2"]}]},
    {"add": [{"mul": [{"num": "1/2"}, {"sym": "a"}, {"pow": [{"sym": "b"}, "2"]}]}, {"mul": [{"num": 0.3}, {"sym": "a"}]}]},
    {"add": [{"mul": [{"sym": "a"}, {"sym": "x", "dots": 2}]}, {"mul": [{"sym": "b"}, {"sym": "x", "dots": 2}]}, {"sym": "l"}]},
]


@pytest.mark.parametrize("data", SUMS)
def test_factors_in_front_leave_the_value(data):
    tree, rng = read(data), np.random.default_rng(1)
    values = {symbol: rng.uniform(0.5, 2) for symbol in (Sym("a"), Sym("b"), Sym("l"), Sym("x", 2))}
    for made in (presented(tree), presented(tree, unknowns=[Sym("x", 2)])):
        assert evaluate(made, values) == pytest.approx(evaluate(tree, values), rel=1e-14)


@pytest.mark.parametrize("data", SUMS)
def test_what_stands_above_and_below_cancels(data):
    tree, rng = read(data), np.random.default_rng(1)
    values = {symbol: rng.uniform(0.5, 2) for symbol in (Sym("a"), Sym("b"), Sym("l"), Sym("x", 2))}
    below = mul(Sym("a"), power(Sym("l"), 2))
    made = quotient(mul(Sym("a"), tree), below)
    assert evaluate(made, values) == pytest.approx(evaluate(tree, values) / evaluate(Sym("l"), values) ** 2, rel=1e-14)
    assert Sym("a") not in symbols(quotient(below, mul(Sym("a"), Sym("b"))))


def test_a_damper_of_no_length_has_no_direction():
    m = fb.Mechanism("block on a damper", gravity="none")
    block = m.particle("block", mass=1)
    m.free(m.ground.O, block.centre, coordinates=["x", "y"], name="place")
    m.damper(between=[m.ground.O, block.centre], damping=2, name="damper")
    with pytest.raises(fb.MotionError, match="line of no length"):
        m.free_bodies()
