"""How far a long run is, on the terminal; Ctrl-C ends the run where it is and keeps what there is."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn


@contextmanager
def watched(end: float) -> Iterator[Callable[[float], bool]]:
    """A callback for the core: a bar of the time reached (s) on the way to ``end``; answers False once interrupted."""
    interrupted = threading.Event()
    before = signal.signal(signal.SIGINT, lambda *_: interrupted.set())
    columns = TextColumn("simulating"), BarColumn(), TextColumn("{task.fields[reached]}"), TimeRemainingColumn()
    try:
        console = Console(stderr=True)
        with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as bar:
            task = bar.add_task("", total=end, reached="")

            def progress(t: float) -> bool:
                bar.update(task, completed=t, reached=f"t = {t:.6g} of {end:.6g} s")
                return not interrupted.is_set()

            yield progress
    finally:
        signal.signal(signal.SIGINT, before)
