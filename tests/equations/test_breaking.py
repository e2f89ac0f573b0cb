"""Formulas of LaTeX over several lines: nothing is lost, no line is too wide, and widths are those of Computer Modern."""

import random
import re

import matplotlib
import pytest
from material import LETTERS, cos, half, product, sin, square, sym
from store import but_long

from freebody.check.language.glyphs import glyphs
from freebody.document.blocks import Equation
from freebody.document.document import Document
from freebody.symbolic.formula import typed
from freebody.symbolic.printers.latex import aligned, latex
from freebody.symbolic.printers.line_breaking import equation, lines, width
from freebody.symbolic.printers.typeset import formula
from freebody.symbolic.tree import ZERO, add, minus, mul, power

TH1, TH2, X, M1, M2, L, G = map(sym, ("theta1", "theta2", "x", "m1", "m2", "l", "g"))
A1, W1, W2 = sym("theta1", 2), sym("theta1", 1), sym("theta2", 1)
SIZE = 10.0


def sums(draw):
    """A sum of products, some of them sums in brackets."""
    letters = [M1, M2, L, G, W1, W2, X, sin(TH1), cos(minus(TH1, TH2)), half(A1), square(W2)]

    def some(depth):
        pick = [draw.choice(letters) for _ in range(draw.randint(1, 3))]
        return mul(*pick, add(*(some(depth - 1) for _ in range(3)))) if depth else mul(*pick)

    return add(*(some(draw.randint(0, 2)) for _ in range(draw.randint(2, 6))))


def plain(math):
    return re.sub(r"\\(left|right|[bB]ig[lr])(?![a-z])|\s", "", math)


def test_lines_are_the_formula_and_none_is_too_wide():
    draw = random.Random(2)
    for _ in range(100):
        math, room = formula(sums(draw), LETTERS), draw.uniform(14, 30)
        made = lines(math, room)
        shown = list(map(latex, made))
        assert plain("".join(shown)) == plain(latex(math))
        assert max(map(width, made)) <= room
        assert all(line[0] in "+-" for line in shown[1:])
        torn = any(line.count(r"\left") != line.count(r"\right") for line in shown)
        assert not torn and (len(made) > 1) == (width(math) > room)


def test_a_fraction_that_is_too_wide_is_broken_above_its_line():
    math = formula(
        mul(add(*(product(M1, L, G), mul(M2, X, sin(TH1)), half(W1, W2, L), mul(G, X, L))), power(add(L, X), -1)), LETTERS
    )
    made = lines(math, 9)
    assert len(made) > 1 and max(map(width, made)) <= 9 and latex(made[0]).startswith(r"\frac{1}{")


def test_a_short_left_side_stands_beside_the_first_line():
    draw = random.Random(3)
    right = formula(add(*(sums(draw) for _ in range(4))), LETTERS)
    assert aligned(equation(typed("E"), right)).startswith("\\begin{aligned}\nE &= ")


@pytest.mark.parametrize("seed", but_long(range(3), 1, 2))
def test_widths_are_those_of_computer_modern(seed):
    """Against the typesetting of another program, with the same symbols."""
    from matplotlib.mathtext import MathTextParser

    draw = random.Random(seed)
    with matplotlib.rc_context({"mathtext.fontset": "cm"}):
        parser = MathTextParser("path")
        for tree in [sums(draw) for _ in range(30)]:
            math = formula(tree, LETTERS)
            set_in_type = parser.parse(f"${latex(math).replace('tfrac', 'frac')}$", dpi=72).width / SIZE
            assert width(math) == pytest.approx(set_in_type, rel=0.1), math


def test_an_equation_of_many_rows_may_go_on_over_the_page_and_can_be_read():
    tree = add(*(product(M1, f"x{i}") for i in range(200)))
    printed = Document((Equation(tree, ZERO),)).latex()
    assert r"\begin{align}" in printed and printed.count(r"\notag") > 12
    assert len(glyphs(printed)) > 400
