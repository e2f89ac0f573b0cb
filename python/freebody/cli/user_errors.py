"""What the user can correct is said in a line or two, never as a traceback; as JSON where that was asked for."""

from __future__ import annotations

import errno
import os
import sys
from contextlib import suppress
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import typer
from typer.core import TyperGroup

from freebody.cli.terminal import SPELT, print_json

if TYPE_CHECKING:
    from freebody.model.errors import Problem

MISTAKEN, NOT_TRUE = 2, 3
"""Exit codes: the user can correct it; what was asked has the answer that nobody wants: a bad end, an equation that is not true."""


class UserError(Exception):
    """Something wrong on the command line: what, and what to try."""


class Guarded(TyperGroup):
    """Commands whose errors, where the user can correct them, are printed and end with code 2."""

    def invoke(self, context: typer.Context) -> Any:
        as_json = "--json" in context.args
        for stream in (sys.stdout, sys.stderr):
            with suppress(AttributeError):  # a stream of a notebook takes everything
                stream.reconfigure(errors=SPELT)  # type: ignore[union-attr]
        try:
            done = super().invoke(context)
            sys.stdout.flush()
            return done
        except Exception as error:
            found = problems(error)
            if found is None or (hasattr(error, "format_message") and not as_json):
                raise
            if as_json and not _is_of_stdout(error):
                print_json({"problems": [asdict(problem) for problem in found]})
            else:
                print("\n".join(map(_stated, found)), file=sys.stderr)
            if _is_of_stdout(error):
                os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # what is left of it is not tried again
            raise typer.Exit(MISTAKEN) from None


_PACKAGES = {"flint": "python-flint", "ruamel": "ruamel.yaml"}
"""Those of modules that have other names."""


def problems(error: Exception) -> list[Problem] | None:
    """What is wrong, where, and what to try; None for an error that is ours, and for a reader that went away."""
    from freebody.model.errors import Problem, Where

    if isinstance(error, OSError):
        return None if error.errno == errno.EPIPE else [Problem(Where(str(error.filename or "")), error.strerror or str(error))]
    if isinstance(error, ModuleNotFoundError) and error.name and not error.name.startswith("freebody"):
        what = f"this needs {error.name}, which is not installed"
        return [Problem(Where(), what, f"pip install {_PACKAGES.get(module := error.name.partition('.')[0], module)}")]
    if hasattr(error, "format_message"):  # of typer, about the words of the command
        return [Problem(Where(), error.format_message())]

    from freebody.core import ExpressionError, ModelError, MotionError
    from freebody.model.errors import ModelFileError, ModelProblem

    if isinstance(error, ModelFileError):
        return error.problems
    if where := getattr(error, "where", None):
        return [Problem(where, *error.args[-2:])]
    if isinstance(error, (UserError, ModelProblem, ModelError, ExpressionError, MotionError)):
        # The last two are always what is wrong and what to try.
        *_, what, hint = error.args
        hint = hint.replace("; ", "\n  ") if isinstance(error, MotionError) else hint
        return [Problem(Where(path=error.path) if isinstance(error, ModelError) else Where(), what, hint)]
    # A bare KeyError or IndexError says nothing to a user: it is a slip of ours.
    spoken = isinstance(error, (ValueError, LookupError, ImportError)) and not isinstance(error, (KeyError, IndexError))
    return [Problem(Where(), str(error))] if spoken or type(error) is RuntimeError else None


def _stated(problem: Problem) -> str:
    """A problem with its place, unless that is a line of Python: then it came with the command."""
    where = problem.where
    if where.file and not where.file.endswith((".py", ">")):
        return str(problem)
    place = f"{where.path}: " if where.path and not where.file else ""
    return f"{place}{problem.what}\n  {problem.hint}" if problem.hint else f"{place}{problem.what}"


def _is_of_stdout(error: Exception) -> bool:
    return isinstance(error, OSError) and error.filename is None
