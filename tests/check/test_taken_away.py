"""A correction neither brings in what takes itself away, nor says what was said."""

from __future__ import annotations

import pytest

from freebody.check.language.parser import parse
from freebody.check.language.statements import Equation
from freebody.check.taken_away import cancels, says_the_same


def read(text: str) -> Equation:
    (found,) = parse(text, ("N", "m", "r", "a", "θ")).equations
    return found


@pytest.mark.parametrize(
    ("text", "so"),
    [
        ("N + m (1 + cos(θ)) (r + a) = (m (r + a)) (1 + cos(θ))", True),
        ("N - m r/2 + r m/2 = a", True),
        ("N + m r = m r/2", False),
        ("N = m a + r", False),
    ],
)
def test_what_stands_beside_its_opposite_cancels(text: str, so: bool) -> None:
    assert cancels(read(text)) is so


@pytest.mark.parametrize(("text", "so"), [("N = m r (1 - cos(θ))/(1 - cos(θ))", True), ("N = r m", True), ("N = 2 m r", False)])
def test_a_factor_above_and_below_says_nothing(text: str, so: bool) -> None:
    assert says_the_same(read(text), read("N = m r")) is so
