"""What cannot be read is reported with the place, and what to try."""

from __future__ import annotations

import numpy as np
import pytest
from both_sides import sides

from freebody.check.language.dimensions import DimensionError, check_dimensions
from freebody.check.language.parser import parse
from freebody.check.language.spelling import spell
from freebody.symbolic.errors import StatementError

KNOWN = ["m", "g", "l", "theta", "x", "F", "i", "j", "k", "t"]

MISTAKES = [
    ("F = (m g", "       ^", "it ends where a `)` is missing"),
    ("F = m g)", "       ^", "never opened"),
    ("1e400 m = F", "^^^^^", "beyond the range"),
    ("F = m^1e-400", "      ^^^^^^", "beyond the range"),
    ("F = [m g)", "        ^", "`]` is expected"),
    ("F = = 3", "    ^", "something is missing before `=`"),
    ("F = m ? g", "      ^", "`?` stands where"),
    ("F = m g +", "        ^", "something is missing at the end"),
    ("F - m g", "^^^^^^^", "it has no `=`"),
    ("sin = 3", "^^^", "`sin` of what?"),
    ("F = sin^-2 x", "    ^^^^^^", "two meanings"),
    ("F = atan2(x)", "    ^^^^^^^^", "takes 2"),
    ("θ̈ = \\thetta x", "    ^^^^^^^", "did you mean `\\theta`?"),
    ("[m 0; 0 m] (x, F) = 0", "   ^", "between the entries of a matrix"),
    ("[m, 0; 1] (x, F) = 0", "^^^^^^^^^", "different lengths"),
    ("x = 1\nF = m g)", "       ^", "never opened"),
    (r"F = \frac{m}{", "            ^", "never closed"),
    ("d/dt(m^x) = F", "     ^^^", "an exponent that changes"),
    ("d/dt(max(x, m)) = F", "     ^^^^^^^^^", "no derivative"),
    ("∂Q/∂x = F", " ^", "what `Q` is made of is not said"),
    ("L = x; ∂L/∂3 = F", "           ^", "where a symbol is expected"),
    ("diff(m x, m) = 0", "^^^^^^^^^^^^", "by t alone"),
    ("m" * 500 + " = 0", "^" * 500, "500 letters without a sign"),
    ("(" * 400 + "m" + ")" * 400 + " = 0", "^" * 805, "brackets in brackets"),
]


@pytest.mark.parametrize(("text", "carets", "said"), MISTAKES)
def test_the_place_is_shown(text, carets, said):
    with pytest.raises(StatementError) as error:
        parse(text, KNOWN)
    assert said in str(error.value)
    assert "    " + carets in str(error.value).split("\n")


def test_letters_that_run_together_in_two_ways():
    with pytest.raises(StatementError, match="`a bc` or `ab c`"):
        parse("abc = 0", ["a", "bc", "ab", "c"])


K = 3
VALUES = {name: np.ones(K) for name in ("m", "g", "x", "l")}
VALUES |= {"i": np.tile([1.0, 0, 0], (K, 1)), "j": np.tile([0, 1.0, 0], (K, 1)), "k": np.tile([0, 0, 1.0], (K, 1))}

KINDS = [
    ("m g j + m g = 0", "        ^^^", "a number is added to a vector"),
    ("m g j = m g", "^^^^^^^^^^^", "the left side is a vector, the right side a number"),
    ("i j = 0", "  ^", "write `×` or `·` between them"),
    ("m × i = 0", "^", "a cross product of a number and a vector"),
    ("m/i = 0", "  ^", "a number is divided by a vector"),
    ("sin(i) = 0", "    ^", "`sin` of a vector"),
    ("i² = 0", "^", "a power of a vector"),
    ("(m, i) = 0", "    ^", "an entry that is a vector"),
    ("[m, g; x, l] (m, g, x) = 0", "             ^^^^^^^^^", "a matrix 2 × 2 cannot multiply a matrix 3 × 1"),
    ("m = F", "    ^", "`F` has no meaning here"),
]


@pytest.mark.parametrize(("text", "carets", "said"), KINDS)
def test_kinds_do_not_mix(text, carets, said):
    with pytest.raises(StatementError) as error:
        sides(parse(text, KNOWN), VALUES)
    assert said in str(error.value)
    assert "    " + carets in str(error.value).split("\n")


UNITS = {"m": "kg", "g": "m/s^2", "l": "m", "theta": "rad", "x": "m", "F": "N", "i": "", "j": "", "k": "", "t": "s"}

FITTING = [
    "m l thetaddot = -m g sin(theta)",
    "l thetaddot + g sin(theta) = 0",
    "xdot^2 = 2 g l",
    "F i = m xddot i - m g j",
    "x = 3",
    "F = 2.5 x",
    "xddot = 9.81 m/s^2",
    "[l, cos(theta); m l, m] (thetaddot, xddot) = (g, F)",
    "sqrt(g/l) t = theta",
    "w = g/l\nthetaddot = -w sin(theta)",
    "|x| = l",
]
NOT_FITTING = [
    ("m l thetaddot = -m g l sin(theta)", "m*g*l*sin(theta)", "m*l*thetaddot"),
    ("F = m xdot", "m*xdot", "F"),
    ("m xddot + m g = F l", "F*l", "m*xddot"),
    ("F i = m xddot i - m g x j", "m*g*x*j", "F*i"),
    ("xddot = g + (x + theta)", "theta", "xddot"),
    ("xddot = 9.81 m/s", "9.81 m/s", "xddot"),
    ("[l, cos(theta); m l, m] (thetaddot, xddot) = (g, g)", None, None),
]


@pytest.mark.parametrize("text", FITTING)
def test_dimensions_that_fit(text):
    check_dimensions(parse(text, KNOWN), UNITS)


@pytest.mark.parametrize(("text", "term", "other"), NOT_FITTING)
def test_the_two_terms_that_do_not_fit_are_named(text, term, other):
    with pytest.raises(DimensionError) as error:
        check_dimensions(parse(text, KNOWN), UNITS)
    if term is not None:
        assert (spell(error.value.term), spell(error.value.other)) == (term, other)


def test_a_sine_of_a_length():
    with pytest.raises(StatementError, match="`sin` of `x`, a length"):
        check_dimensions(parse("theta = sin(x)", KNOWN), UNITS)
