"""The page of a book: its length, what is on it and what is not, and that all of it is true."""

import json

import pytest
from evaluated import numbers
from ruamel.yaml import YAML
from store import ANSWERED, ROOT, derived, elsewhere, every

import freebody as fb
from freebody.document.blocks import Equation, is_tree
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import Add, symbols

KNOWN = {each["model"]: each for each in YAML(typ="safe").load((ROOT / "docs/derivations.yaml").read_text(encoding="utf-8"))}
TABLE = [line for line in (ROOT / "docs/derivations.md").read_text(encoding="utf-8").splitlines() if line.startswith("| ")]
LINES = range(10, 41)
"""Lines with words or equations: a page of a book has room for no more."""
HOLDS = 1e-9


def page(model):
    given = YAML(typ="safe").load((ROOT / model).read_text(encoding="utf-8"))
    alone = "model" in given
    mechanism = fb.Mechanism.loads(json.dumps({"freebody": 1, **given["model"]})) if alone else fb.load(ROOT / model)
    return mechanism.equations()


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
def test_every_equation_of_a_page_holds_elsewhere_and_in_motion(model):
    """Closures on two sides, sums of parts, balances with what is closed put in, and the acceleration by itself; places and velocities
    that a motion prescribes are others there."""
    for at in elsewhere(model):
        values, loads = numbers(at), {load.symbol for load in at.free.loads}
        for block in derived(model, "minimal").blocks:
            trees = isinstance(block, Equation) and is_tree(block.left) and is_tree(block.right)
            if trees and any(x.dots == 2 or x.name in loads for x in symbols(block.left, block.right)):
                terms = [t for side in (block.left, block.right) for t in (side.terms if isinstance(side, Add) else (side,))]
                left, right = (evaluate(side, values, at.tables) for side in (block.left, block.right))
                size = max(1.0, *(abs(evaluate(term, values, at.tables)) for term in terms))
                assert abs(left - right) < HOLDS * size, (block.left, block.right)


LADDER = "tests/check/books/ladder.yaml"


def test_a_rod_in_a_corner_has_one_equation_in_its_angle():
    said = page(LADDER).text()
    assert "½ m g L sin φ = ¼ m L² φ̈ + ¹⁄₁₂ m L² φ̈" in said
    assert "⅓ m L² φ̈ = ½ m g L sin φ" in said


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
