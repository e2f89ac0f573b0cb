"""What the core refuses, each with its place, what is wrong and what to try."""

from __future__ import annotations


class ModelError(ValueError):
    """A model that cannot be compiled: ``path`` is like ``joints.pivot.of[1]``."""

    def __init__(self, path: str, what: str, hint: str) -> None:
        super().__init__(path, what, hint)
        self.path, self.what, self.hint = path, what, hint


class ExpressionError(ValueError):
    """Text that is no expression: from ``start`` to ``end``, counted in characters."""

    def __init__(self, start: int, end: int, what: str, hint: str) -> None:
        super().__init__(start, end, what, hint)
        self.start, self.end, self.what, self.hint = start, end, what, hint


class MotionError(RuntimeError):
    """A state that has no answer: ``kind`` is ``singular_mass``, ``cannot_assemble`` and the like; ``path`` the item of the
    model that it is about (``joints.pivot``), or empty."""

    def __init__(self, kind: str, path: str, what: str, hint: str) -> None:
        super().__init__(kind, path, what, hint)
        self.kind, self.path, self.what, self.hint = kind, path, what, hint


class Indeterminate(LookupError):
    """A reaction that the balance equations do not determine was asked for as if they did."""
