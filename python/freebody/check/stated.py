"""Corrections as a person is told of them."""

from __future__ import annotations

from dataclasses import dataclass

from .edits import Edit
from .language.spelling import spell

_IN_WORDS = ("convention", "exchange", "extension", "components", "momentum")
"""Kinds of edits of more than one part, told in words of their own."""
_LEFT_OUT = ("missing term", "missing factor", "share", "other term", "unit vector")


@dataclass(frozen=True)
class Correction:
    """One way to make a statement true: ``edits`` by kind with what stood there and what should; ``equation`` is the result.
    ``where`` are the characters of each edit in the statement, ``given`` under what it is true, if not always."""

    edits: tuple[tuple[str, str, str], ...]
    equation: str
    size: float
    where: tuple[tuple[int, int], ...] = ()
    given: str = ""
    why: str = ""
    """What was wrong, in a sentence."""

    @property
    def is_slip(self) -> bool:
        """Whether something stands there that is wrong, rather than something left out."""
        return not any(kind in _LEFT_OUT for kind, _, _ in self.edits)

    def __str__(self) -> str:
        def said(kind: str, before: str, after: str) -> str:
            both = f"{kind}: `{before}` should be `{after}`" if before and after else f"{kind} `{before or after}`"
            return after if kind in _IN_WORDS else both

        stated = " and ".join(said(*edit) for edit in self.edits)
        return f"{stated}: {self.equation}" + (f" (with {self.given})" if self.given else "")


def stated(edit: Edit) -> tuple[str, str, str]:
    """The kind of an edit, what stood there and what should."""
    return edit.kind, spell(edit.old) if edit.old else "", edit.words or (spell(edit.new) if edit.new else "")
