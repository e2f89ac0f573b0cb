"""How far a long run is, on the terminal; Ctrl-C ends the run where it is and keeps what there is."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console


@contextmanager
def watched() -> Iterator[Callable[[float], bool]]:
    """A callback for the core: shows the time reached, and answers False once interrupted."""
    interrupted = threading.Event()
    before = signal.signal(signal.SIGINT, lambda *_: interrupted.set())
    try:
        with Console(stderr=True).status("simulating") as status:

            def progress(t: float) -> bool:
                status.update(f"simulating, t = {t:.4g} s")
                return not interrupted.is_set()

            yield progress
    finally:
        signal.signal(signal.SIGINT, before)
