"""Random trees come back from their spelling, and no text is answered by anything but a tree or an error with a place."""

from __future__ import annotations

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from typeset import latex

from freebody.check.language.parser import parse
from freebody.check.language.spelling import spell
from freebody.check.language.statements import Equation
from freebody.symbolic.errors import StatementError
from freebody.symbolic.tree import Add, Column, Cross, Dot, Fn, Matrix, Mul, Negative, Num, Pow, Quotient, Sym, walk

NAMES = ("m", "theta", "omega_1", "y'", "r_G1/O", "H/E", "pivot.Fx", "link[2].angle", "x1")
letters = st.builds(Sym, st.sampled_from(NAMES), st.integers(0, 2))
atoms = st.one_of(
    letters,
    st.integers(0, 99).map(lambda n: Num(float(n), str(n))),
    st.sampled_from(["2.50", "0.1", "1e3"]).map(lambda text: Num(float(text), text)),
)


def several(inner, least=2):
    return st.lists(inner, min_size=least, max_size=3).map(tuple)


def nodes(inner):
    """All kinds of nodes with these inside."""
    pair = st.tuples(inner, inner)
    return st.one_of(
        several(inner).map(Add),
        several(inner).map(Mul),
        pair.map(lambda p: Quotient(*p)),
        pair.map(lambda p: Pow(*p)),
        inner.map(Negative),
        inner.map(lambda x: Fn("sin", (x,))),
        pair.map(lambda p: Fn("atan2", p)),
        pair.map(lambda p: Cross(*p)),
        pair.map(lambda p: Dot(*p)),
        several(inner).map(Column),
        st.tuples(pair, pair).map(Matrix),
    )


trees = st.recursive(atoms, nodes, max_leaves=12)
# In LaTeX a figure behind a factor has a dot before it, which reads as the sign that it is.
without_figures = st.recursive(letters, nodes, max_leaves=12)


@settings(max_examples=200, deadline=None)
@given(trees, trees)
@example(Sym("m"), Negative(Negative(Sym("y'", 2))))
def test_spelling_reads_back(left, right):
    equation = Equation(left, right)
    assert parse(spell(equation), NAMES).lines == (equation,)


@settings(max_examples=200, deadline=None)
@given(without_figures, without_figures)
def test_latex_reads_back(left, right):
    equation = Equation(left, right)
    assert spell(parse(latex(equation), NAMES)) == spell(equation)


PIECES = [
    *"+-*/^=·×()[]{}|,;. \n'_²₁θẍ½√°≤?@\\&",
    "theta",
    "x",
    "m2",
    "sin",
    "d",
    "dt",
    "diff",
    "1",
    "2.5",
    "\\frac",
    "\\dot",
    "\\ddot",
    "\\begin{pmatrix}",
]


@settings(max_examples=800, deadline=None)
@given(st.lists(st.sampled_from(PIECES), max_size=14).map("".join), st.sampled_from([(), ("theta", "x", "m", "y'", "r_G/O")]))
def test_a_tree_or_an_error_with_a_place(text, names):
    try:
        program = parse(text, names)
    except StatementError as error:
        start, end = error.span
        assert 0 <= start <= end <= max(len(text), 1)
        assert error.text == text
        return
    for node in walk(program):
        assert 0 <= node.span[0] <= node.span[1] <= len(text)


@pytest.mark.parametrize("text", ["", "   ", "# only a comment", "\n\n"])
def test_nothing(text):
    with pytest.raises(StatementError, match="there is no equation"):
        parse(text)
