"""What others make of a statement in their words is judged as the statement is."""

from __future__ import annotations

from books import OTHER_WORDS, Book
from store import every

from freebody.check import Kind


@every(OTHER_WORDS["read"] | OTHER_WORDS["missed"], "book", share=12)
def test_it_is_judged_alike_in_other_words(book):
    for said in Book(book).in_other_words("read"):
        assert (said.verdict.kind is Kind.TRUE) == (said.kind is Kind.TRUE), (said.statement, str(said.verdict))
    for said in Book(book).in_other_words("missed"):
        assert said.kind is Kind.TRUE or said.verdict.kind is not Kind.TRUE, said.statement
