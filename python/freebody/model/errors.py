"""What can be wrong with a model, and where."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

SHOWN = 4  # of the places of one complaint, beside its first

Path = tuple[str | int, ...]
"""Keys and indices from the top of a model to one of its items, e.g. ``("joints", "pivot", "of", 1)``."""


@dataclass(frozen=True)
class Where:
    """A place in a model file, or the Python call that made the item.

    ``line`` and ``column`` count from 1; 0 when unknown. ``path`` reads like ``joints.pivot.of[1]``.
    """

    file: str = ""
    line: int = 0
    column: int = 0
    path: str = ""
    excerpt: str = ""

    def __str__(self) -> str:
        numbers = [str(n) for n in (self.line, self.column) if n]
        return ":".join([self.file or "model", *numbers])


@dataclass(frozen=True)
class Problem:
    """One thing that is wrong: the first place, a sentence about it, what to try (may be empty), and the other places."""

    where: Where
    what: str
    hint: str = ""
    also: tuple[Where, ...] = ()

    def __str__(self) -> str:
        lines = [f"{self.where}: {self.what}"]
        if self.where.excerpt:
            lines.append(f"    {self.where.excerpt.rstrip()}")
            if self.where.column:
                lines.append("    " + " " * (self.where.column - 1) + "^")
        if self.also:
            rest = f" and {len(self.also) - SHOWN} more" if len(self.also) > SHOWN else ""
            lines.append(f"  the same in {', '.join(map(str, self.also[:SHOWN]))}{rest}")
        if self.hint:
            lines.append(f"  {self.hint}")
        return "\n".join(lines)


class ModelFileError(ValueError):
    """A model that cannot be used. ``problems`` lists all that was found, in the order of the file; what is said of several
    places is one problem."""

    def __init__(self, problems: Sequence[Problem]) -> None:
        found: dict[tuple[str, str], Problem] = {}
        for each in sorted(dict.fromkeys(problems), key=lambda p: (p.where.file, p.where.line, p.where.column)):
            first = found.setdefault((each.what, each.hint), each)
            if first is not each:
                found[each.what, each.hint] = replace(first, also=(*first.also, each.where, *each.also))
        self.problems = list(found.values())
        super().__init__("\n".join(str(problem) for problem in self.problems))


class ModelProblem(Exception):
    """What is wrong and what to try, before the place is known."""

    def __init__(self, what: str, hint: str = "") -> None:
        super().__init__(what, hint)
        self.what = what
        self.hint = hint


class Consequence(ModelProblem):
    """A complaint that only follows from another one, which is reported elsewhere."""


def path_text(path: Path) -> str:
    """The path as a person reads it: ``joints.pivot.of[1]``."""
    text = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in path)
    return text.removeprefix(".")
