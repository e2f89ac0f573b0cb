"""Symbolic answers are the closed forms of textbooks, written as shortly, and true at random numbers."""

from __future__ import annotations

import random

import numpy as np
import pytest
from material import LETTERS, cos, half, product, sin, square, sym, values

from freebody.equations import (
    Fn,
    Num,
    Singular,
    TooLarge,
    characteristic,
    coefficients,
    eigenvalues,
    evaluate,
    from_sympy,
    limit,
    solve,
    solve_equations,
    stability,
    substitute,
    text,
    to_sympy,
)
from freebody.symbolic.tree import MINUS_ONE, ONE, ZERO, add, minus, mul, negative, number, over, power

M1, M2, BIG, M, L, G, K, C, MU = map(sym, ("m1", "m2", "M", "m", "l", "g", "k", "c", "mu"))
ALPHA, THETA, W = sym("alpha"), sym("theta"), sym("theta", 1)
INFINITY = float("inf")


def written(trees):
    return [text(tree, LETTERS) for tree in trees]


def solves(matrix, right, found):
    """Whether the answers satisfy the system at random numbers, by NumPy."""
    draw = random.Random(8)
    for _ in range(3):
        at = values(draw) | {C: 0.7}
        a = np.array([[float(evaluate(entry, at)) for entry in row] for row in matrix])
        b = np.array([float(evaluate(entry, at)) for entry in right])
        x = [float(evaluate(entry, at)) for entry in found]
        assert x == pytest.approx(np.linalg.solve(a, b), rel=1e-10)


def test_atwood():
    matrix, right = [[M1, ONE], [M2, MINUS_ONE]], [mul(M1, G), product(-1, M2, G)]
    found = solve(matrix, right, LETTERS)
    assert written(found) == ["(m₁ − m₂) g/(m₁ + m₂)", "2 m₁ m₂ g/(m₁ + m₂)"]
    solves(matrix, right, found)
    assert text(limit(found[0], "m2", 0, LETTERS)) == "g"
    assert written([limit(found[1], "m1", INFINITY, LETTERS)]) == ["2 m₂ g"]
    assert written([substitute(found[0], {"m2": M1}, LETTERS)]) == ["0"]


def test_two_blocks_one_on_an_incline():
    """Block 1 slides up the incline with friction, block 2 hangs: m₁ a = T − m₁ g (sin α + μ cos α), m₂ a = m₂ g − T."""
    a, tension = sym("a"), sym("T")
    first = (mul(M1, a), minus(tension, mul(M1, G, add(sin(ALPHA), mul(MU, cos(ALPHA))))))
    second = (mul(M2, a), minus(mul(M2, G), tension))
    found = solve_equations([first, second], [a, tension], LETTERS)
    expected = over(mul(G, minus(M2, mul(M1, add(sin(ALPHA), mul(MU, cos(ALPHA)))))), add(M1, M2))
    same(found[a], expected)
    same(found[tension], over(mul(M1, M2, G, add(ONE, sin(ALPHA), mul(MU, cos(ALPHA)))), add(M1, M2)))
    assert written([found[tension]]) == ["m₁ m₂ g (1 + sin α + μ cos α)/(m₁ + m₂)"]


def test_block_on_a_movable_wedge():
    """Wedge M, block m: (M+m) A + m a cos α = 0 and m A cos α + m a = m g sin α."""
    matrix = [[add(BIG, M), mul(M, cos(ALPHA))], [mul(M, cos(ALPHA)), M]]
    right = [ZERO, mul(M, G, sin(ALPHA))]
    found = solve(matrix, right, LETTERS)
    assert written(found) == ["−(m g sin α cos α)/(M + m sin²α)", "((M + m) g sin α)/(M + m sin²α)"]
    solves(matrix, right, found)
    assert written([limit(found[1], "M", INFINITY, LETTERS)]) == ["g sin α"]
    same(limit(found[1], "M", 0), over(G, sin(ALPHA)))


def test_cart_and_pendulum():
    """Released at rest with equal masses at θ = π/4 the cart goes off with g/3; of its own it hangs as a pendulum."""
    matrix = [[add(BIG, M), mul(M, L, cos(THETA))], [mul(M, L, cos(THETA)), mul(M, square(L))]]
    right = [mul(M, L, square(W), sin(THETA)), product(-1, M, G, L, sin(THETA))]
    found = solve(matrix, right, LETTERS)
    solves(matrix, right, found)
    assert written(found) == [
        "(m (l θ̇² + g cos θ) sin θ)/(M + m sin²θ)",
        "−((m l θ̇² cos θ + (M + m) g) sin θ)/(l (M + m sin²θ))",
    ]
    rest = solve(matrix, [ZERO, right[1]], LETTERS)
    assert written([substitute(rest[0], {"theta": mul(number("1/4"), sym("pi")), "M": M}, LETTERS)]) == ["⅓ g"]
    assert written([limit(rest[1], "M", INFINITY, LETTERS)]) == ["−(g/l) sin θ"]


def test_three_unknowns_with_a_reaction():
    """The same cart with the force of the pin along x: three equations, the first for the cart alone."""
    matrix = [[BIG, ZERO, ONE], [M, mul(M, L, cos(THETA)), MINUS_ONE], [cos(THETA), L, ZERO]]
    right = [ZERO, ZERO, product(-1, G, sin(THETA))]
    found = solve(matrix, right, LETTERS)
    solves(matrix, right, found)
    same(found[0], over(mul(M, G, sin(THETA), cos(THETA)), add(BIG, mul(M, square(sin(THETA))))))


def test_what_cannot_be_answered_is_said():
    with pytest.raises(TooLarge, match="7 unknowns"):
        solve([[ONE] * 7] * 7, [ONE] * 7)
    with pytest.raises(Singular):
        solve([[M, mul(M, cos(THETA))], [cos(THETA), square(cos(THETA))]], [ONE, ONE])
    with pytest.raises(ValueError, match="as many equations"):
        solve([[M, M]], [ONE])
    with pytest.raises(ValueError, match="not linear in theta"):
        coefficients(mul(M, square(THETA)), [THETA])


def test_coefficients_of_a_linear_expression():
    tree = minus(mul(M, add(sym("x", 2), mul(L, sym("theta", 2)))), mul(K, sym("x")))
    factors, rest = coefficients(tree, [sym("x", 2), sym("theta", 2)])
    assert written([*factors, rest]) == ["m", "m l", "−k x"]


def test_an_angle_of_numbers_is_read_back():
    """SymPy makes atan(15) of atan2(15, 1), and atan(2) + π or so of others."""
    for y, x in ((15, 1), (-15, 1), (2, -3)):
        tree = from_sympy(to_sympy(Fn("atan2", (number(y), number(x)))))
        assert float(evaluate(tree, {})) == pytest.approx(np.arctan2(y, x))


def test_limits():
    assert limit(over(ONE, M), "m", 0) == Num(INFINITY)
    assert written([limit(over(Fn("sin", (mul(K, sym("t")),)), K), "k", 0, LETTERS)]) == ["t"]


def test_eigenvalues_of_an_oscillator():
    """ÿ = −(k/m) y has ±i √(k/m); with a damper (−c ± √(c² − 4 m k))/(2 m)."""
    free = [[ZERO, ONE], [negative(over(K, M)), ZERO]]
    found = eigenvalues(free, LETTERS, positive=["k", "m"])
    assert [written([value.real, value.imaginary]) for value in found] == [["0", "−√(k/m)"], ["0", "√(k/m)"]]
    damped = [[ZERO, ONE], [negative(over(K, M)), negative(over(C, M))]]
    at = {K: 1.0, M: 2.0, C: 5.0}
    roots = sorted(float(evaluate(value.real, at)) for value in eigenvalues(damped, LETTERS, positive=["k", "m", "c"]))
    assert roots == pytest.approx(sorted(np.linalg.eigvals([[0, 1], [-1 / 2, -5 / 2]]).real))


def test_eigenvalues_of_two_equal_pendulums_with_a_spring():
    """ω² = g/l, and g/l + 2 k/m."""
    own = over(G, L)
    pull = over(K, M)
    found = eigenvalues(
        [[add(own, pull), negative(pull)], [negative(pull), add(own, pull)]], LETTERS, positive=["g", "l", "k", "m"]
    )
    assert sorted(written(value.real for value in found)) == ["2 k/m + g/l", "g/l"]
    with pytest.raises(TooLarge, match="at most 4 rows"):
        eigenvalues([[ONE] * 5] * 5)


def test_stability_conditions_are_those_of_routh_and_hurwitz():
    a, b, c, d = map(sym, "abcd")
    assert written(stability([ONE, a, b]).conditions) == ["a", "b"]
    assert written(stability([ONE, a, b, c]).conditions) == ["a", "c", "a b − c"]
    assert written(stability([ONE, a, b, c, d]).conditions) == ["a", "d", "a b − c", "a b c − c² − a² d"]
    assert stability([ONE, ZERO, b, ZERO, d]).kind == "oscillates"
    assert written(stability([ONE, ZERO, b, ZERO, d]).conditions) == ["b", "d", "b² − 4 d"]
    assert stability([ONE, a, negative(square(b))], positive=["b"]).never


@pytest.mark.parametrize("order", [1, 2, 3, 4])
def test_the_conditions_hold_where_all_roots_lie_to_the_left(order):
    names = [sym(name) for name in "abcde"[: order + 1]]
    conditions = stability(names, positive=["a"]).conditions
    draw = random.Random(order)
    seen = set()
    for _ in range(300):
        at = {name: draw.uniform(-0.3, 2) for name in names} | {names[0]: draw.uniform(0.2, 1)}
        stable = max(np.roots([at[name] for name in names]).real) < 0
        assert all(evaluate(condition, at) > 0 for condition in conditions) == stable
        seen.add(stable)
    assert seen == {True, False}


def test_an_inverted_pendulum_is_held_by_a_stiff_spring():
    """m l² θ̈ = (m g l − k) θ is stable if k > m g l."""
    matrix = [[ZERO, ONE], [over(minus(mul(M, G, L), K), mul(M, square(L))), ZERO]]
    found = stability(characteristic(matrix, LETTERS), LETTERS, positive=["m", "l", "g", "k"])
    assert (found.kind, written(found.conditions)) == ("oscillates", ["k − m g l"])


def same(first, second):
    draw = random.Random(10)
    for _ in range(3):
        at = values(draw)
        assert float(evaluate(first, at)) == pytest.approx(float(evaluate(second, at)), rel=1e-10)


@pytest.mark.long
def test_half_angles_of_double_pendulum_are_short():
    """The equations of two rods without mass and two particles: the denominator is the textbook's m₁ + m₂ sin²(θ₁ − θ₂)."""
    one, two = sym("theta1"), sym("theta2")
    turn = minus(one, two)
    matrix = [[add(M1, M2), mul(M2, cos(turn))], [cos(turn), ONE]]
    right = [
        negative(add(mul(M2, square(sym("theta2", 1)), sin(turn)), mul(add(M1, M2), over(G, L), sin(one)))),
        minus(mul(square(sym("theta1", 1)), sin(turn)), mul(over(G, L), sin(two))),
    ]
    found = solve(matrix, right, LETTERS)
    solves(matrix, right, found)
    assert all("m₁ + m₂ sin²(θ₁ − θ₂)" in line for line in written(found))


def test_the_answer_keeps_halves():
    assert written(solve([[half(M)]], [mul(M, G)], LETTERS)) == ["2 g"]
    assert written(solve([[M]], [half(power(M, 2), G)], LETTERS)) == ["½ m g"]
