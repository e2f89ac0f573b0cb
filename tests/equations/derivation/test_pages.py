"""The page of a book: its length, what is on it and what is not, and that all of it is true."""

import json

import numpy as np
import pytest
from evaluated import numbers
from ruamel.yaml import YAML
from store import ANSWERED, ROOT, derived, elsewhere, every

import freebody as fb
from freebody.document.blocks import Equation, Figure, is_tree
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import Add, Sym, symbols

KNOWN = {each["model"]: each for each in YAML(typ="safe").load((ROOT / "docs/derivations.yaml").read_text(encoding="utf-8"))}
TABLE = [line for line in (ROOT / "docs/derivations.md").read_text(encoding="utf-8").splitlines() if line.startswith("| ")]
LINES = range(10, 41)
"""Lines with words or equations: a page of a book has room for no more."""
HOLDS = 1e-9


def described(model):
    given = YAML(typ="safe").load((ROOT / model).read_text(encoding="utf-8"))
    alone = "model" in given
    return fb.Mechanism.loads(json.dumps({"freebody": 1, **given["model"]})) if alone else fb.load(ROOT / model)


def page(model):
    return described(model).equations()


@every(KNOWN)
def test_a_textbooks_mechanism_fits_a_textbooks_page(model):
    """And is in the table as it is: else `.venv/bin/python docs/tables.py`."""
    found = page(model)
    text = found.text(width=100)
    lines = sum(1 for line in text.splitlines() if line)
    assert lines in LINES
    assert "atan2" not in text and "too long" not in text
    titles = [part.title for part in found.parts if part.title.startswith(("AMB", "LMB"))]
    same = set(titles) == set(KNOWN[model]["takes"])
    row = next(
        row for row in TABLE if f"| {'; '.join(KNOWN[model]['takes']) or '–'} |" in row and f"| {KNOWN[model]['book']} |" in row
    )
    assert row.endswith(f"| {lines} |") and (same == ("| the same |" in row))
    assert same or "; ".join(titles) in row


@every(ANSWERED)
def test_a_page_has_forty_lines_at_most(model):
    said = derived(model, "minimal").text(width=100)
    assert sum(1 for line in said.splitlines() if line) < LINES.stop and "too long" not in said


SPOOL = "tests/check/books/spool.yaml"


def test_the_law_stands_in_vectors_before_its_scalar_equation():
    """And how what rolls turns. With forces that are not in the scalar equation; once for the same bodies."""
    said = page(SPOOL).text()
    assert "α_spool = −x\u0308/R" in said and "R j × P i + P r e_z = R j × m x\u0308 i − (m k² x\u0308/R) e_z" in said
    said = page("tests/check/books/braking_car.yaml").text()
    assert "−P i + (N_wheels₁ − m g + N_wheels₂) j = m s̈ i" in said
    said = page("python/freebody/systems/19.3.1-springy-leash/model.yaml").text()
    assert said.count("−k x i − k y j = m a_particle") == 1


def test_a_law_in_vectors_has_only_directions_that_the_page_introduces():
    """Not that of a crank whose mass centre rests."""
    said = page("tests/check/books/scotch_yoke.yaml").text()
    assert "λ_" not in said and "N_pin" in said


def test_a_long_chain_goes_on_from_its_pins_and_says_once_what_is_alike():
    said = page("python/freebody/systems/GEN-STEP-one-foot/model.yaml").text()
    assert "a_back_thigh = a_back_knee − " in said and said.count("`--long` has it") == 1
    assert "AMB about shoulder[2] for arm[2]\nWhat acts at the point" in said


@every(ANSWERED)
def test_every_equation_of_a_page_holds_elsewhere_and_in_motion(model):
    """Closures on two sides, sums of parts, balances with what is closed put in, and the acceleration by itself; places and velocities
    that a motion prescribes are others there."""
    for at in elsewhere(model):
        values, loads = numbers(at), {load.symbol for load in at.free.loads}
        given = (x for x in derived(model, "minimal").letters.values() if x.kind == "constant" and Sym(x.name) not in values)
        values |= {Sym(x.name): float(x.doc.split()[0]) for x in given}  # numbers of laws, 2 rad/s
        for block in derived(model, "minimal").blocks:
            trees = isinstance(block, Equation) and is_tree(block.left) and is_tree(block.right)
            if trees and isinstance(block.left, Sym) and block.left not in values:  # what a root is called
                values[block.left] = evaluate(block.right, values, at.tables)
            if trees and any(x.dots == 2 or x.name in loads for x in symbols(block.left, block.right)):
                terms = [t for side in (block.left, block.right) for t in (side.terms if isinstance(side, Add) else (side,))]
                left, right = (evaluate(side, values, at.tables) for side in (block.left, block.right))
                size = max(1.0, *(abs(evaluate(term, values, at.tables)) for term in terms))
                assert abs(left - right) < HOLDS * size, (block.left, block.right)


DRAWN = "tests/check/books/drawn_up_a_slope.yaml"


@every([*KNOWN, DRAWN])
def test_the_equations_of_a_page_are_independent(model):
    """Also where at the start points lie on each other, so that moments about one of them say nothing."""
    mechanism = described(model)
    at = SymbolicState(mechanism.source(), mechanism.moment()[0])
    table = np.array([[evaluate(x, at.values, at.tables) for x in row] for row in mechanism.equations().mass_matrix], float)
    table /= np.linalg.norm(table, axis=1, keepdims=True)
    assert np.linalg.matrix_rank(table, tol=1e-9) == len(table)


def test_a_block_on_a_slope_has_balances_along_it_and_across():
    said = page(DRAWN).text()
    assert "N_slope = mA g cos β" in said and "mA s̈ = F_ropeA − mA g sin β − μ N_slope" in said


def test_a_string_has_its_length_squared_and_no_roots():
    said = fb.load(ROOT / "systems/19.3.22-colliding-carts/latch.yaml").equations().text(ascii=True)
    assert "(xB - C.x)^2 + C.y^2 = l^2" in said and "(xB - C.x) (xB' - C.x') + C.y C.y' = 0" in said and "sqrt" not in said


def test_a_root_that_is_there_again_and_again_has_a_symbol():
    """Of a string over two eyelets the lengths beyond them."""
    said = fb.load(ROOT / "systems/19.3.20-guide-and-pendulum/cable.yaml").equations().text()
    assert "s₂ = √(bob.x² + bob.y²)" in said and "s₁ + s₂ = l" in said and said.count("√") == 2
    for form in ({"form": "brute"}, {"want": "bob.x"}):
        said = fb.load(ROOT / "systems/19.3.20-guide-and-pendulum/cable.yaml").equations(**form).text()
        assert "s₂ = √(bob.x² + bob.y²)" in said and "s₂" in said.partition("s₂ =")[2]


def test_what_touches_where_a_coordinate_is_0_holds_it_there():
    """A brake on a drum: N (a − μ c) = P b, as a book has it."""
    said = page("tests/check/books/block_brake.yaml").text()
    assert "φ = 0" in said and "(a − μ c) N_brake − P b = 0" in said


def test_polar_coordinates_have_their_directions():
    said = fb.load(ROOT / "systems/19.3.3-two-long-springs/polar.yaml").equations().text(ascii=True)
    assert "a_P = (r'' - r (phi')^2) e_r + (r phi'' + 2 r' phi') e_φ" in said and "LMB along e_r for P" in said


def test_every_balance_has_its_free_body():
    figures = [block.drawing for block in page(DRAWN).blocks if isinstance(block, Figure)]
    assert [drawing.bodies for drawing in figures[1:]] == [("A",), ("pulley",), ("B",)]


@pytest.mark.parametrize(
    ("limits", "says"), [({"m2": 0}, "m1 l^2 theta''/3 = T"), ({"l": "0"}, "m2 R (R theta'' + 2 theta' R') = T")]
)
def test_equations_have_limits(limits, says):
    """Of a collar on a rod: without the collar, and without the rod's length."""
    gun = fb.load(ROOT / "examples/new_gun.yaml")
    assert says in gun.equations(limits=limits).text(ascii=True).partition("Limits")[2]
    with pytest.raises(ValueError, match="'theta' has no limit, as it is no parameter"):
        gun.equations(limits={"theta": 0})
    with pytest.raises(ValueError, match="m1 cannot go to 'soon'"):
        gun.equations(limits={"m1": "soon"})


FOUR_BAR = ROOT / "examples/four_bar.yaml"


def test_tenths_and_fifths_are_decimal_numbers_beside_others_and_as_lengths():
    said = page("python/freebody/systems/GEN-STEP-one-foot/model.yaml").text()
    assert "0.6 (ankle′′" in said and "⅗" not in said
    assert (
        "1.2 + c cos φ" in fb.load(FOUR_BAR).equations().text()
        and "⅖ m r²" in page("tests/check/books/skidding_ball.yaml").text()
    )


def test_a_rope_keeps_a_sum_and_no_length_that_nobody_wrote():
    assert "x + R φ − y = const" in page("tests/check/books/disk_drawn_by_block.yaml").text()


def test_balances_for_one_unknown_have_the_accelerations_of_their_bodies():
    said = fb.load(FOUR_BAR).equations(want="theta", about=["B", "D", "A"]).text()
    assert "λ_crank at θ, λ_coupler at β" in said and "a_coupler = −a θ̇² λ_crank" in said


def test_a_point_may_be_a_hinge_and_in_a_loop_its_closure_is_there():
    said = fb.load(FOUR_BAR).equations(of="C", frame="crank").text()
    assert "coupler.end through the frame of crank" in said and "a sin θ + b sin β = c sin φ" in said


LADDER = "tests/check/books/ladder.yaml"


def test_a_rod_in_a_corner_has_one_equation_in_its_angle():
    said = page(LADDER).text()
    assert "½ m g L sin φ = ¼ m L² φ̈ + ¹⁄₁₂ m L² φ̈" in said
    assert "⅓ m L² φ̈ = ½ m g L sin φ" in said


def test_a_number_of_a_law_has_a_symbol():
    said = fb.load(ROOT / "systems/GEN-FOURBAR-four-bar-positions/model.yaml").equations().text()
    assert "θ = θ₀ + ω t" in said and "ω (1 rad/s)" in said


@pytest.mark.parametrize("written", ["w*t", "w*t + 20 deg"])
def test_a_prescribed_angle_is_no_time_and_its_acceleration_no_unknown(written):
    text = """
parameters: {m: 2 kg, l: 1 m, w: 1 rad/s, g: 9.81 m/s^2}
gravity: g
bodies: {rod: {shape: rod, length: l, mass: m}}
joints: {pin: {type: hinge, of: [ground.O, rod.start], coordinate: theta}}
motions: {drive: {of: theta, is: LAW}}
"""
    said = fb.Mechanism.loads("freebody: 1\nname: driven" + text.replace("LAW", written)).equations().text()
    assert "θ = t" not in said and "θ̈ = 0" in said and "M_drive = ½ m g l cos θ" in said


def test_what_is_long_has_all_that_is_printed_at_length():
    found = fb.load(ROOT / "examples/four_bar.yaml").equations(long=True).text()
    for head in ("Configuration", "Symbols", "Kinematics", "Loop closure", "Balance equations", "Virtual power", "Matrix form"):
        assert f"\n{head}\n" in found
    assert "First-order form" in found and "Conserved quantities" in found and "Rotating unit vectors" in found


def test_the_first_order_form_is_explicit_where_that_is_short():
    said = fb.load(ROOT / "examples/new_gun.yaml").equations("first-order").text(ascii=True)
    assert "R'' = R (theta')^2" in said and "theta'' = (3 T - 6 m2 R theta' R')/(m1 l^2 + 3 m2 R^2)" in said
    assert "⎡" in fb.load(ROOT / "examples/four_bar.yaml").equations("first-order").text()
