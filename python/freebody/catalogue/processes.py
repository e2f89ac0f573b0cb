"""Systems worked through by several processes."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import TypeVar

from freebody.catalogue.system import System

Result = TypeVar("Result")


def shared(
    work: Callable[[System], Result], systems: Iterable[System], file: Callable[[System], Path]
) -> Iterator[tuple[System, Result]]:
    """The systems in their order, each with what ``work`` gives. Those with the longest ``file`` are begun first, so that no process
    is left alone with them at the end."""
    every = list(systems)
    workers = min(os.cpu_count() or 1, len(every))
    if workers < 2:
        yield from ((system, work(system)) for system in every)
        return
    with ProcessPoolExecutor(workers) as pool:
        longest = sorted(every, key=lambda system: -file(system).stat().st_size)
        begun = {system.id: pool.submit(work, system) for system in longest}
        yield from ((system, begun[system.id].result()) for system in every)
