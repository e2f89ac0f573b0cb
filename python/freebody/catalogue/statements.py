"""What is stated about systems, judged."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from freebody.catalogue.system import System
from freebody.check.file import Judged, judge
from freebody.mechanism import Mechanism


def statements(systems: Iterable[System]) -> Iterator[tuple[System, list[Judged]]]:
    """The systems of which something is stated, each with its statements and their verdicts; several processes share the work.

    Raises ``ModelProblem``.
    """
    stated = [system for system in systems if system.statements.exists()]
    workers = min(os.cpu_count() or 1, len(stated))
    if workers < 2:
        yield from ((system, _judged(system.statements)) for system in stated)
        return
    with ProcessPoolExecutor(workers) as pool:
        # Those of which most is stated first, so that no process is left alone with them at the end.
        longest = sorted(stated, key=lambda system: -system.statements.stat().st_size)
        found = {system.id: pool.submit(_judged, system.statements) for system in longest}
        yield from ((system, found[system.id].result()) for system in stated)


def _judged(path: Path) -> list[Judged]:
    return list(judge(path, Mechanism.load))
