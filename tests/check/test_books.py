"""What is said of textbooks' mechanisms: nothing wrong is called true, nothing right is called wrong."""

from __future__ import annotations

from books import FILES, Book
from store import every

from freebody.check import Kind


@every(FILES, "book")
def test_no_slip_is_called_true_and_nothing_right_wrong(book):
    for said in Book(book).verdicts(correcting=False):
        if said.kind is not Kind.TRUE:
            assert said.verdict.kind is not Kind.TRUE, said.statement
        else:
            assert said.verdict.kind is not Kind.WRONG, said.statement
