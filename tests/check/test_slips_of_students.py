"""Slips of students that no single sign, number or letter mends: the correction is that of a tutor, and is said as one."""

from __future__ import annotations

import pytest
from books import Book

from freebody.check.file import judged_alone

SLIPS = {
    "a ratio upside down": ("gears_and_drum", "ω_B = R/r ω", "ω_B = r/R ω", "upside down"),
    "a ratio that counts twice": (
        "gears_and_drum",
        "Q + m g d r/R = (I_A + (I_B + m d²) r/R) α",
        "Q + m g d r/R = (I_A + (I_B + m d²) r²/R²) α",
        "counts twice",
    ),
    "two terms with one factor": (
        "gears_and_drum",
        "Q + m g d r/R = (I_A + I_B + m d²) α",
        "Q + m g d r/R = (I_A + (I_B + m d²) r²/R²) α",
        "a factor is forgotten",
    ),
    "lost before it was differentiated": (
        "rod_on_cart",
        "P ẋ = d/dt(½ (M + m) ẋ² + 1/6 m L² θ̇² − ½ m g L cos θ)",
        "P ẋ = d/dt(½ (M + m) ẋ² + ½ m L ẋ θ̇ cos θ + 1/6 m L² θ̇² − ½ m g L cos θ)",
        "is left out",
    ),
    "work of a couple": (
        "stepped_drum",
        "constant: ½ I ω² + ½ mA vA² + ½ mB vB² + mA g yA − mB g yB",
        "constant: ½ I ω² + ½ mA vA² + ½ mB vB² + mA g yA − mB g yB + C θ",
        "is left out",
    ),
}


@pytest.mark.parametrize("slip", SLIPS)
def test_the_first_correction_is_that_of_a_tutor(slip: str) -> None:
    name, said, right, words = SLIPS[slip]
    book = Book(name)
    first = judged_alone(book.checker, said).mends[0]
    assert book.says_the_same(first.equation, right), first
    assert words in first.why
