"""What is right stays right in whichever manner it is written, as do its parts of speech."""

from __future__ import annotations

import random

from books import CALLED_WRONG, FILES, NOT_FOUND, UNSEEN, Book
from manners import rewritten
from store import every

from freebody.check import Kind
from freebody.check.file import judged_alone

BOTH = FILES | UNSEEN
TIMES = 2  # that each statement is written otherwise


@every(BOTH, "book", share=36)
def test_a_right_statement_is_right_in_every_manner(book: str) -> None:
    rng, checker = random.Random(book), Book(book).checker
    checker.correcting = False
    said = Book(book).data["statements"]
    right = [each["says"] for each in said if each["verdict"] == "right" and (book, each["id"]) not in NOT_FOUND | CALLED_WRONG]
    if book in UNSEEN:  # what is not found to be right there as it stands is told by the score of benchmarks/books.py
        right = [says for says in right if judged_alone(checker, says).kind is Kind.TRUE]
    for says in right:
        for text in filter(None, (rewritten(rng, checker, says) for _ in range(TIMES))):
            verdict = judged_alone(checker, text)
            assert verdict.kind is Kind.TRUE, (says, text, str(verdict))
