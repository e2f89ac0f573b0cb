"""Ways of writing and those into which they are put."""

from __future__ import annotations

import pytest

from freebody.check.idioms import usual
from freebody.check.prose import plainly

PUT = {
    "si T = 0 : E = const": "if T = 0 : E = const",
    "nach dem Stoß: v = 0": "after Stoß: v = 0",
    "constant, if d = 0: E + V": "if d = 0: constant: E + V",
    "N = 0 where cos θ = 2/3": "N = 0 when cos θ = 2/3",
    "d²u/dθ² + u = p": "((u'' θ' − u' θ'')/(θ')^3) + u = p",
}
AS_WRITTEN = ("(N_1 - N_2) b = mu N h", "(M + m) a = F", "d²x/dt² = −g", "at the top (θ' = 0): N = m g", "sin θ = 0")


@pytest.mark.parametrize("text", PUT)
def test_what_is_written_otherwise(text):
    assert usual(text) == PUT[text]


@pytest.mark.parametrize("text", AS_WRITTEN)
def test_what_stays_as_it_is_written(text):
    assert usual(text) == text


@pytest.mark.parametrize("text", ["F s = m (v² − v₀²)", "E = ½ k (x₂² − x₁²)", "M = m g (h₁ - h₀)"])
def test_a_bracket_of_symbols_is_no_remark(text):
    assert plainly(text) == (text, ())
