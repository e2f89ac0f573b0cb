"""The command ``check``: is my equation right?"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

import typer

from freebody.cli.models import opened
from freebody.cli.options import AsJson, Changes
from freebody.cli.user_errors import NOT_TRUE

if TYPE_CHECKING:
    from freebody.check import Verdict


def check(
    model: Annotated[Path, typer.Argument(metavar="MODEL", help="Model file, or a file of statements about one.")],
    statements: Annotated[
        list[str] | None, typer.Argument(metavar="EQUATION", help="Equations or claims; see docs/check.md.")
    ] = None,
    where: Annotated[
        list[str] | None,
        typer.Option("--where", metavar="LETTER=MEANING", help="A symbol of your own, like 'phi=theta-alpha'; repeatable."),
    ] = None,
    changes: Changes = None,
    as_json: AsJson = False,
) -> None:
    """Say whether equations and claims are true of every motion of a model, and correct the wrong ones."""
    found, fine = [], True
    for heading, verdict, expected, data in _stated(model, statements, where, changes) if statements else _in_file(model):
        found.append(data)
        fine &= verdict.ok if expected is None else expected
        if not as_json:
            show(heading, verdict, expected is False)
    if as_json:
        typer.echo(json.dumps(found, ensure_ascii=False, indent=1))
    if not fine:
        raise typer.Exit(NOT_TRUE)


_Judged: TypeAlias = "tuple[str, Verdict, bool | None, Any]"
"""What is stated, its verdict, whether that is what the file expects (None where it expects nothing), and all as plain data."""


def _stated(path: Path, texts: list[str], where: list[str] | None, changes: list[str] | None) -> Iterator[_Judged]:
    from freebody.check import Checker
    from freebody.check.file import as_json, judged_alone
    from freebody.check.symbols import declarations

    checker = Checker(opened(path, changes), declarations(where or []))
    for text in texts:
        verdict = checker.check(text) if len(texts) == 1 else judged_alone(checker, text)
        yield text, verdict, None, as_json(verdict)


def _in_file(path: Path) -> Iterator[_Judged]:
    from freebody.check.file import judge

    for judged in judge(path):
        yield f"{judged.statement.id}: {judged.statement.says}", judged.verdict, judged.as_expected, judged.to_json()


def show(text: str, verdict: Verdict, unexpected: bool = False) -> None:
    """Print a verdict with what is behind it."""
    from rich.console import Console
    from rich.text import Text

    console = Console(highlight=False, soft_wrap=True)
    mark = "  (not what the file expects)" if unexpected else ""
    console.print(Text(text.strip()))
    console.print(Text(f"  {verdict.kind.value}{mark}", style=verdict.kind.colour))
    for line in verdict.details:
        console.print(Text(f"  {line}"))
