"""The worked catalogue: systems as ordinary model files, with questions.

A system is a folder with model files, only what a user could write, and a ``questions.py``. Nothing is typed in:
every answer is computed by freebody when it is asked for, and stands beside a value that came another way.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from freebody.catalogue.answers import Answer, Asked, Question, ask
from freebody.catalogue.case import Case
from freebody.catalogue.checks import free_questions
from freebody.catalogue.processes import shared
from freebody.catalogue.sentences import sentence
from freebody.catalogue.system import System, find, model_file, systems

__all__ = ["Answer", "Asked", "Case", "Question", "System", "ask", "find", "model_file", "rows", "run", "run_all", "systems"]


def run(system: System) -> Iterator[Asked]:
    """Each question of the system with its answers, one after another, then the checks that every system gets."""
    case = Case(system.folder)
    yield from (question.put_to(case) for question in system.questions())
    yield from (question.put_to(case) for question in free_questions(case))


def run_all(systems: Iterable[System]) -> Iterator[tuple[System, list[Asked]]]:
    """The systems, each with what ``run`` gives; several processes share the work."""
    return shared(_run, systems, lambda system: system.folder / "questions.py")


def _run(system: System) -> list[Asked]:
    return list(run(system))


def rows(results: Mapping[str, list[Asked]]) -> list[dict[str, Any]]:
    """What was asked and answered, by system, as data for scripts."""
    made: list[dict[str, Any]] = []
    for identity, asked in results.items():
        for question in asked:
            head = {"system": identity, "question": question.label}
            made += [{**head, "sentence": sentence(answer, full=True), **answer.as_dict()} for answer in question.answers]
            made += [{**head, "failure": question.failure}] if question.failure else []
    return made
