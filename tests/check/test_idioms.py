"""Ways of writing and those into which they are put."""

from __future__ import annotations

import pytest

from freebody.check.idioms import usual
from freebody.check.prose import plainly

PUT = {
    "si T = 0 : E = const": "if T = 0 : E = const",
    "nach dem Stoß: v = 0": "after Stoß: v = 0",
    "(shoe B, about the pin)  F c = N b": "shoe B, about the pin: F c = N b",
    "jaws together (after the blow): θ = φ": "after the blow: θ = φ",
    "after the first blow, before the second: E = 0": "after the first blow: E = 0",
    "right after the release (θ = θ_0, θ' = 0): R = 0": "right after the release: R = 0",
    "constant, if d = 0: E + V": "if d = 0: constant: E + V",
    "link locked (θ = 0, d = 0): F = 0": "link locked (θ = 0), d = 0: F = 0",
    "natural frequency of the rotor with θ = 0: ω = 1": "natural frequency with θ = 0: ω = 1",
    "recovery (handle free): E = const": "during recovery: E = const",
    "\\text{plank + spool: } P = M a": "plank + spool: P = M a",
    "small, from equilibrium: m a = F": "for small motions: m a = F",
    "N = 0 where cos θ = 2/3": "N = 0 when cos θ = 2/3",
    "in equilibrium, ΣM_A = 0: F a = W b": "in equilibrium, ΣM_A : F a = W b",
    "v_B has no part along PB, so x = y": "x = y",
    "right after the impact \\dot x = v": "right after the impact: \\dot x = v",
    "bolt in flight, ΣF_r: F = m a": "while bolt is in flight, ΣF_r: F = m a",
    "cord still whole, left leg: F = m g": "before the cord is cut, left leg: F = m g",
    "at the highest point after the jerk: x = y": "after the jerk, at the highest point: x = y",
    "Special case m_1 = m_2: a = b": "if m_1 = m_2: a = b",
    "Solving both equations, after the blow: v = u": "after the blow: v = u",
    "skidding: the friction eats energy, T' = P": "skidding: T' = P",
    "While they move together $N = k x$": "while they move together: $N = k x$",
    "natural frequencies for $c = 0$: m ω² = k": "if $c = 0$: natural frequencies: m ω² = k",
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
