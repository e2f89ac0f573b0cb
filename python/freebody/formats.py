"""Kinds of files by their endings: one table for each thing that is written, which its errors and the command line's help read."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TypeVar

T = TypeVar("T")


class Formats(dict[str, T]):
    """What writes each kind of file, by its ending; ``what`` begins the sentence that refuses any other."""

    def __init__(self, what: str, kinds: Mapping[str, T]) -> None:
        super().__init__(kinds)
        self.what = what

    def __str__(self) -> str:
        *others, last = self
        return f"{', '.join(others)} or {last}"

    def of(self, path: Path) -> T:
        """That of a file. Raises ``ValueError``."""
        ending = path.suffix.lower()
        if ending not in self:
            raise ValueError(f"{self.what} {self}, not {path.suffix or 'without a suffix'!r}")
        return self[ending]
