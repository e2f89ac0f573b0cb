"""What sentences around an equation claim, and the conditions that they name."""

from __future__ import annotations

import pytest

from freebody.check.sentences import sentence
from freebody.check.tried_sentences import says_all

KNOWN = {*"mgkrabcFNMTIJLvωθφx", "θ_0"}
FIXED = {*"mgkrabcLMI", *"θφx"}
SAID: dict[str, tuple[list[str], list[str], list[str]]] = {
    # claims, relations that are conditions, words that say when
    "While the crate does not slip it gets its acceleration from friction, so that F = m a.": (
        ["F = m a"],
        [],
        ["While the crate does not slip"],
    ),
    "Just after the impact the rod pulls with T = m g": (["T = m g"], [], ["Just after the impact"]),
    "Once the lid has left the head only its weight acts on it, and θ'' = −g/L": (
        ["θ'' = −g/L"],
        [],
        ["Once the lid has left the head"],
    ),
    "Put ω = 0, and you get $L^2 = I/m$.": (["L^2 = I/m"], ["ω = 0"], []),
    "Linearise, and let the moments cancel (a m = b M). What is left is I θ'' + k θ = 0.": (
        ["I θ'' + k θ = 0"],
        ["a m = b M"],
        [],
    ),
    "a M = b m ⇒ I θ'' = −k θ": (["I θ'' = −k θ"], ["a M = b m"], []),
    "Differentiating x = r θ gives x'' = r θ''": (["x'' = r θ''"], [], []),
    "ΣM_O = 0 gives F a = T b": (["F a = T b"], [], []),
    "x = a (start): N = m θ'';  M x'' + F = 0": (["N = m θ''", "M x'' + F = 0"], ["x = a"], []),
    "F = k x, provided that the block moves": (["F = k x"], [], ["provided that the block moves"]),
    "If it sticks then F = k x, and N = m g": (["F = k x", "N = m g"], [], ["If it sticks"]),
    "it swings at ω = k/m": (["ω = k/m"], [], []),
    "The period is then $2 π \\sqrt{m/k}$.": (["period = 2 π \\sqrt{m/k}"], [], []),
    "Because of the gears the speed L θ' + r ω is zero": (["L θ' + r ω = 0"], [], []),
    "lost energy = gained energy, so m g x = I ω²": (["m g x = I ω²"], [], []),
}


@pytest.mark.parametrize("text", SAID)
def test_a_sentence_claims_under_conditions(text: str) -> None:
    found = sentence(text, KNOWN, FIXED)
    assert found is not None
    assert (found.claims, found.conditions, found.when) == SAID[text]


@pytest.mark.parametrize("text", ["the ball flies", "L φ' (after) = v (before)"])
def test_what_is_no_sentence_with_a_claim_is_none(text: str) -> None:
    assert sentence(text, KNOWN, FIXED) is None


def test_other_words_may_say_when() -> None:
    said = {
        words: says_all(sentence(f"{words}: F = k x", KNOWN, FIXED)) for words in ("thrown back", "block", "carried without slip")
    }
    assert said == {"thrown back": False, "block": True, "carried without slip": True}
