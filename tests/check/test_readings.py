"""Ways of textbooks to write things, each of them in several mechanisms: periods, integrals, limits, moments, sizes of vectors, letters.

``readings.yaml`` holds under each mechanism what is said of it; the verdicts were written down by hand before the program saw them.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest
from books import FILES, Book
from ruamel.yaml import YAML
from store import SYSTEMS, family

from freebody.check import Checker
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
    if name in FILES:
        return Book(name).checker
    statements = _READ.load((SYSTEMS[f"{name}/model"].parent / "statements.yaml").read_text(encoding="utf-8"))
    return Checker(Mechanism.load(SYSTEMS[f"{name}/model"]), statements.get("letters"))


@pytest.mark.parametrize("said", family(SAID, share=60))
def test_it_is_read_as_it_is_meant(said: str) -> None:
    name, word, text = SAID[said]
    checker(name).correcting = word == "if"
    verdict = judged_alone(checker(name), text)
    assert verdict.kind is WORDS[word], str(verdict)


def test_a_doubtful_reading_is_shown() -> None:
    for name, text, note in (
        ("rod", "T = 2π √(2L/3g)", "T is read as: the period of small vibrations about θ = 0°."),
        ("rod", "T = 2π √(2L/3g)", "It is read as: T = 2*pi*sqrt(2*L/(3*g))"),
        ("rod", "T = ½ I_O ω²", "T is read as: kinetic()."),
        ("rod", "v_B = L ω", "v_B is read as: the size of"),
        ("wheel_down_a_slope", "v = R ω", "α"),
    ):
        notes = "\n".join(judged_alone(checker(name), text).notes)
        assert note in notes or (note == "α" and "ω is read as" in notes), notes
