"""What is said of textbooks' mechanisms: nothing wrong is called true, what is right is."""

from __future__ import annotations

from books import CALLED_WRONG, FILES, NOT_FOUND, TRUE_AT_FIRST, Book
from store import every

from freebody.check import Kind


@every(FILES, "book")
def test_no_slip_is_called_true_and_what_is_right_is(book):
    for said in Book(book).verdicts(correcting=False):
        place = (book, said.statement["id"])
        if place in TRUE_AT_FIRST:
            assert "as the model is at first" in str(said.verdict)
        elif said.kind is not Kind.TRUE:
            assert said.verdict.kind is not Kind.TRUE, said.statement
        elif place not in NOT_FOUND | CALLED_WRONG:
            assert said.verdict.kind is Kind.TRUE, (said.statement, str(said.verdict))
        else:
            assert (said.verdict.kind is Kind.WRONG) <= (place in CALLED_WRONG), said.statement
