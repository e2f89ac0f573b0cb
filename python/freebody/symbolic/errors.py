"""What is wrong with a statement, and where in its text."""

from __future__ import annotations

from freebody.symbolic.alphabet import columns
from freebody.symbolic.tree import Span


class StatementError(ValueError):
    """A statement that cannot be read or has no meaning: ``what``, the characters ``span``, what to try (``hint``, may be empty).

    ``text`` is the whole statement, when known; then the message shows the line with a caret under the place.
    """

    def __init__(self, what: str, span: Span, hint: str = "", text: str = "") -> None:
        self.what, self.span, self.hint, self.text = what, span, hint, text
        super().__init__("\n".join([what, *shown(text, span), *([f"  {hint}"] if hint else [])]))

    def __reduce__(self) -> tuple[type[StatementError], tuple[str, Span, str, str]]:
        return type(self), (self.what, self.span, self.hint, self.text)

    def within(self, text: str) -> StatementError:
        """The same error, with the text that it is about."""
        return type(self)(self.what, self.span, self.hint, text)


def shown(text: str, span: Span) -> list[str]:
    """The line of the text in which the place is, and carets under it; empty without a text."""
    if not text:
        return []
    start = text.rfind("\n", 0, span[0]) + 1
    line = text[start:].split("\n", 1)[0]
    width = max(1, columns(line[span[0] - start : span[1] - start]))
    return ["    " + line, "    " + " " * columns(line[: span[0] - start]) + "^" * width]
