"""Factorization: products of known factors come back, whatever was multiplied out."""

import itertools

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from freebody.symbolic.algebra import equal
from freebody.symbolic.factoring import factor
from freebody.symbolic.to_sympy import from_sympy

A, B, C, T = sympy.symbols("a b c t")
SUMS = [A - B, A + 2 * B, A * sympy.sin(T) - B, A**2 + B * C + 1, sympy.cos(T) * C - 3, A * B + C * T]


@settings(deadline=None)
@given(st.lists(st.sampled_from(SUMS), min_size=1, max_size=4), st.lists(st.sampled_from(SUMS), max_size=2))
def test_products_come_back_from_their_sums(above, below):
    made = factor(sympy.expand(sympy.Mul(*above)) / sympy.expand(sympy.Mul(*below)))
    assert equal(from_sympy(made), from_sympy(sympy.Mul(*above) / sympy.Mul(*below)))
    parts = [part for each in sympy.Mul.make_args(made) for part in sympy.Mul.make_args(each.as_base_exp()[0])]
    assert all(part in SUMS or -part in SUMS for part in parts if part.is_Add)


@pytest.mark.parametrize("expression", [A / 2 + B / 3, B - A, (A - B) / (B - A), sympy.S.Zero, A, 2 * A + 4 * B, 0.5 * A + B])
def test_what_is_short(expression):
    made = factor(expression)
    assert sympy.expand(made - expression) == 0 and sympy.count_ops(made) <= sympy.count_ops(sympy.factor(expression))


def test_many_variables():
    """SymPy's own may take minutes for it, as it draws."""
    x = sympy.symbols("x:12")
    one, two = (sum((i + k) * a * b for i, (a, b) in enumerate(itertools.pairwise(x), 1)) + x[k] ** 2 for k in (1, 2))
    assert factor(sympy.expand(one * two)) == one * two
