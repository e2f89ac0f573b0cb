"""What the user can correct is said in a line or two, never as a traceback."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer
from typer.core import TyperGroup

if TYPE_CHECKING:
    from freebody.model.errors import Problem

MISTAKEN, NOT_TRUE = 2, 3
"""Exit codes: the user can correct it; what was asked has the answer that nobody wants: a bad end, an equation that is not true."""


class UserError(Exception):
    """Something wrong on the command line: what, and what to try."""


class Guarded(TyperGroup):
    """Commands whose errors, where the user can correct them, are printed and end with code 2."""

    def invoke(self, context: typer.Context) -> Any:
        try:
            return super().invoke(context)
        except Exception as error:
            stated = explained(error)
            if stated is None:
                raise
            print(stated, file=sys.stderr)
            raise typer.Exit(MISTAKEN) from None


def explained(error: Exception) -> str | None:
    """What is wrong and what to try; None for an error that is ours."""
    from freebody.core import ExpressionError, ModelError, MotionError
    from freebody.model.errors import ModelFileError, ModelProblem, Problem

    if isinstance(error, OSError) and error.filename:
        return f"{error.filename}: {error.strerror}"
    if isinstance(error, ModelFileError):
        return "\n".join(map(_placed, error.problems))
    if where := getattr(error, "where", None):
        return str(Problem(where, *error.args[-2:]))
    if isinstance(error, (UserError, ModelProblem, ModelError, ExpressionError, MotionError)):
        # The last two are always what is wrong and what to try; a place in front of them is a path in the model.
        *_, what, hint = error.args
        if isinstance(error, MotionError):
            hint = hint.replace("; ", "\n  ")
        place = f"{error.args[0]}: " if isinstance(error, ModelError) else ""
        return f"{place}{what}\n  {hint}" if hint else f"{place}{what}"
    # A bare KeyError or IndexError says nothing to a user: it is a slip of ours.
    spoken = isinstance(error, (ValueError, LookupError, ImportError)) and not isinstance(error, (KeyError, IndexError))
    return str(error) if spoken or type(error) is RuntimeError else None


def _placed(problem: Problem) -> str:
    """A problem with its place, unless that is a line of Python: then it came with the command."""
    if Path(problem.where.file).suffix in ("", ".yaml", ".yml", ".json") and not problem.where.file.startswith("<"):
        return str(problem)
    return f"{problem.what}\n  {problem.hint}" if problem.hint else problem.what
