"""Where the items of a model were made: in a file, or by calls in Python."""

from __future__ import annotations

import linecache
import sys
from pathlib import Path as FilePath

from .errors import Path, Where, path_text
from .source import Source

_OWN = str(FilePath(__file__).parent.parent)


class SourceLocations:
    """Where items were made: in the file that was loaded, or by a Python call."""

    def __init__(self, source: Source | None = None) -> None:
        self.source = source
        self.made: dict[Path, tuple[str, int]] = {}

    def note(self, path: Path) -> None:
        """Remembers the line outside freebody that is being executed."""
        self.made[path] = caller()

    def where(self, path: Path, at_key: bool = False) -> Where:
        """The place of an item, or of the nearest that holds it."""
        for length in range(len(path), 0 if self.source else -1, -1):
            if path[:length] in self.made:
                return called(*self.made[path[:length]], path)
        return self.source.where(path, at_key) if self.source else Where("", 0, 0, path_text(path))


def called(file: str, line: int, path: Path) -> Where:
    """The place of a Python call."""
    return Where(file, line, 0, path_text(path), linecache.getline(file, line).strip())


def caller() -> tuple[str, int]:
    """The file and line outside freebody that is being executed."""
    frame = sys._getframe(1)
    while frame.f_back and frame.f_code.co_filename.startswith(_OWN):
        frame = frame.f_back
    return frame.f_code.co_filename, frame.f_lineno
