"""What is said of textbooks' mechanisms: nothing wrong is called true, what is right is."""

from __future__ import annotations

from books import CALLED_WRONG, FILES, NOT_FOUND, Book
from store import every

from freebody.check import Kind


@every(FILES, "book")
def test_no_slip_is_called_true_and_what_is_right_is(book):
    for said in Book(book).verdicts(correcting=False):
        if said.kind is not Kind.TRUE:
            assert said.verdict.kind is not Kind.TRUE, said.statement
        elif (place := (book, said.statement["id"])) not in NOT_FOUND | CALLED_WRONG:
            assert said.verdict.kind is Kind.TRUE, (said.statement, str(said.verdict))
        else:
            assert (said.verdict.kind is Kind.WRONG) <= (place in CALLED_WRONG), said.statement
