"""Slips of students that no single sign, number or letter mends: the correction is that of a tutor, and is said as one."""

from __future__ import annotations

from pathlib import Path

from books import Book
from ruamel.yaml import YAML
from store import every

from freebody.check.file import judged_alone

SLIPS = YAML(typ="safe").load((Path(__file__).parent / "slips_of_students.yaml").read_text(encoding="utf-8"))


@every(SLIPS, "slip", share=8)
def test_the_first_correction_is_that_of_a_tutor(slip: str) -> None:
    given = SLIPS[slip]
    book = Book(given["book"])
    first = judged_alone(book.checker, given["says"]).mends[0]
    assert book.says_the_same(first.equation, given["right"]), first
    assert given["why"] in first.why
