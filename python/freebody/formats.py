"""Files that are written, whole or not at all. Their kinds by their endings: a table for each thing that is written, which errors and the
command line's help read."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TypeVar

T = TypeVar("T")


@contextmanager
def replacing(path: str | Path) -> Iterator[Path]:
    """A file to write, which takes the place of ``path`` once it is whole: what fails midway leaves the old file as it was. A
    device is written itself. Raises ``OSError`` with the name ``path``."""
    target = Path(path).resolve()  # what a link leads to is replaced, not the link
    device = target.exists() and not target.is_file()
    beside = target if device else target.with_name(f".{target.stem}.part{target.suffix}")
    try:
        yield beside
        if not device:
            beside.replace(target)
    except OSError as error:
        raise OSError(error.errno, error.strerror or str(error), str(path)) from None
    finally:
        if not device:
            with suppress(OSError):
                beside.unlink()


def write(path: str | Path, text: str) -> Path:
    """Writes a text. Raises ``OSError``."""
    with replacing(path) as beside:
        beside.write_bytes(text.encode())
    return Path(path)


def check_writable(path: Path) -> None:
    """Raises ``OSError`` for a file that cannot be written, before anything is computed for it."""
    target = path.resolve()
    try:
        if target.is_dir():
            target.open("ab")
        elif not target.exists():
            tempfile.TemporaryFile(dir=target.parent).close()
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from None


class Formats(dict[str, T]):
    """What writes each kind of file, by its ending; ``what`` begins the sentence that refuses any other."""

    def __init__(self, what: str, kinds: Mapping[str, T]) -> None:
        super().__init__(kinds)
        self.what = what

    def __str__(self) -> str:
        *others, last = self
        return f"{', '.join(others)} or {last}" if others else last

    def of(self, path: Path) -> T:
        """That of a file. Raises ``ValueError``."""
        ending = path.suffix.lower()
        if ending not in self:
            raise ValueError(f"{self.what} {self}, not {path.suffix or 'without a suffix'!r}")
        return self[ending]
