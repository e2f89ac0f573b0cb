"""What is stated about systems, judged."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from freebody.catalogue.processes import shared
from freebody.catalogue.system import System
from freebody.check.file import Judged, judge
from freebody.mechanism import Mechanism


def statements(systems: Iterable[System]) -> Iterator[tuple[System, list[Judged]]]:
    """The systems of which something is stated, each with its statements and their verdicts; several processes share the work.

    Raises ``ModelProblem``.
    """
    stated = [system for system in systems if system.statements.exists()]
    return shared(_judged, stated, lambda system: system.statements)


def _judged(system: System) -> list[Judged]:
    return list(judge(system.statements, Mechanism.load))
