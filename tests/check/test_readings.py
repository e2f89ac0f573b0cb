"""Ways of textbooks to write things, each of them in several mechanisms: periods, integrals, limits, moments, sizes of vectors, letters.

``readings.yaml`` holds under each mechanism what is said of it; the verdicts were written down by hand before the program saw them.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest
from books import FILES, UNSEEN, Book
from ruamel.yaml import YAML
from store import SYSTEMS, family

from freebody.check import Checker, Kind
from freebody.check.file import WORDS, judged_alone
from freebody.mechanism import Mechanism

_READ = YAML(typ="safe")
DATA = _READ.load((Path(__file__).parent / "readings.yaml").read_text(encoding="utf-8"))
SAID = {
    f"{name}: {text}": (name, word, text)
    for name, words in DATA["said"].items()
    for word, texts in words.items()
    for text in texts
}


@cache
def checker(name: str) -> Checker:
    if name in DATA["models"]:
        return Checker(Mechanism.loads(DATA["models"][name]))
    if name in FILES | UNSEEN:
        return Book(name).checker
    statements = _READ.load((SYSTEMS[f"{name}/model"].parent / "statements.yaml").read_text(encoding="utf-8"))
    return Checker(Mechanism.load(SYSTEMS[f"{name}/model"]), statements.get("letters"))


@pytest.mark.parametrize("said", family(SAID, share=60))
def test_it_is_read_as_it_is_meant(said: str) -> None:
    name, word, text = SAID[said]
    checker(name).correcting = word == "if"
    verdict = judged_alone(checker(name), text)
    assumed = word == "if" and verdict.ok and verdict.assumption  # told, and not held against it
    assert verdict.kind is WORDS[word] or assumed, str(verdict)


def test_a_doubtful_reading_is_shown() -> None:
    for name, text, note in (
        ("rod", "T = 2π √(2L/3g)", "T is read as: the period of small vibrations about θ = 0°."),
        ("rod", "T = 2π √(2L/3g)", "It is read as: T = 2*pi*sqrt(2*L/(3*g))"),
        ("rod", "T = ½ I_O ω²", "T is read as: kinetic()."),
        ("rod", "v_B = L ω", "v_B is read as: the size of"),
        ("wheel_down_a_slope", "v = R ω", "α"),
        ("rod", "ω = θ' (of the rod)", "`(of the rod)` is read as a remark, and not judged."),
        ("rod", "at the pin O: ω = θ'", "`the pin O` is read as a label, and not judged."),
    ):
        notes = "\n".join(judged_alone(checker(name), text).notes)
        assert note in notes or (note == "α" and "ω is read as" in notes), notes


@pytest.mark.parametrize("turned", [0.0, 0.5])
def test_the_angles_of_what_rolls_within_a_loop_are_measured_from_the_start(turned: float) -> None:
    """A planet in a ring, its arm started at θ = 0: r φ = −(R − r) θ but for what it was turned there."""
    planet = Checker(Mechanism.loads(DATA["models"]["planet"].replace("φ: 0", f"φ: {turned}")))
    kinds = [planet.check(f"r φ = {sign}(R - r) θ", correcting=False).kind for sign in "-+"]
    assert kinds == [Kind.TRUE_IF if turned else Kind.TRUE, Kind.WRONG]


def test_what_is_printed_is_what_was_written() -> None:
    for text in ("(m + m) g L = m", "(g/L) = 2 ω²", r"\left(g/L\right) = (m) g"):
        assert checker("rod").check(text, correcting=False).text == text
