"""Words of a derivation."""

from __future__ import annotations

from collections.abc import Sequence


def plain(doc: str) -> str:
    """A description without the quotes of code."""
    return doc.replace("`", "")


def joined(words: Sequence[str], last: str = "and") -> str:
    """``a, b and c``."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} {last} {words[-1]}"
