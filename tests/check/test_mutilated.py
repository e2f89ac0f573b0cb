"""A statement that a slip of the hand has spoilt is judged, or refused in a sentence with its place; nothing else ever comes out."""

from __future__ import annotations

import random
from functools import cache
from pathlib import Path

import pytest
from store import every

import freebody as fb
from freebody.catalogue import model_file, systems
from freebody.check import Checker, Verdict, file
from freebody.symbolic.errors import StatementError

SIGNS = "=+-*/^()[]{}|,;:'′\"\\_·×∂√½²₁θφλΣdt .0123456789xyzabmgijk<>≤&$%#@!?~`\n\t\x00\u0307∞π°ẋ"
STATEMENTS = 40  # of each seed


@cache
def stated() -> list[tuple[Path, dict, str]]:
    """Model, symbols and text of every statement of the catalogue."""
    read = [(system.statements, file.read(system.statements)) for system in systems() if system.statements.exists()]
    return [
        (path.parent / (each.model or all_.model), all_.letters | each.letters, each.says)
        for path, all_ in read
        for each in all_.statements
    ]


def mutilated(text: str, rng: random.Random) -> str:
    """With one to three characters taken away, put in or exchanged, or a part said twice or left out."""
    for _ in range(rng.choice((1, 1, 1, 2, 3))):
        i, j = sorted(rng.randrange(len(text) + 1) for _ in range(2))
        text = rng.choice(
            (
                text[:i] + text[i + 1 :],
                text[:i] + rng.choice(SIGNS) + text[i:],
                text[:i] + text[i + 1 : i + 2] + text[i : i + 1] + text[i + 2 :],
                text[:j] + text[i:],
            )
        )
    return text


@every(map(str, range(50)), "seed", share=25)
def test_it_is_judged_or_refused_with_a_place(seed: str) -> None:
    rng, checkers = random.Random(seed), {}
    for _ in range(STATEMENTS):
        model, letters, says = rng.choice(stated())
        text = mutilated(says, rng)
        letters = letters | ({mutilated("q", rng): mutilated("2*t", rng)} if rng.random() < 0.2 else {})
        letters = {
            n: mutilated(said, rng) if isinstance(said, str) and rng.random() < 0.1 else said for n, said in letters.items()
        }
        checker = checkers.get(model) or checkers.setdefault(model, Checker(fb.Mechanism.load(model)))
        try:
            assert isinstance(checker.check(text, letters, correcting=False), Verdict)
        except StatementError as error:
            assert error.what and not error.what.startswith("(") and "\n" not in error.what, text
            assert error.span is not None and 0 <= error.span[0] <= error.span[1] <= len(text), text


@pytest.mark.parametrize("text", ["", " ", "=", "\\", "θ", "if : x = 1", "x = ", "(" * 300 + "x"])
def test_so_is_what_says_nothing(text: str) -> None:
    with pytest.raises(StatementError):
        Checker(fb.Mechanism.load(model_file("19.3.16/model"))).check(text)
