"""The command ``check``: is my equation right?"""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

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
    stated, fine = _statements(model, statements, where, changes, as_json) if statements else _file(model, as_json)
    if as_json:
        typer.echo(json.dumps(stated, ensure_ascii=False, indent=1))
    if not fine:
        raise typer.Exit(NOT_TRUE)


def _statements(
    path: Path, texts: Iterable[str], where: list[str] | None, changes: list[str] | None, quiet: bool
) -> tuple[list[Any], bool]:
    from freebody.check import Checker
    from freebody.check.file import as_json, judged_alone
    from freebody.check.symbols import declarations

    checker, texts = Checker(opened(path, changes), declarations(where or [])), list(texts)
    verdicts = []
    for text in texts:
        verdicts.append(checker.check(text) if len(texts) == 1 else judged_alone(checker, text))
        if not quiet:
            show(text, verdicts[-1])
    return [as_json(v) for v in verdicts], all(v.ok for v in verdicts)


def _file(path: Path, quiet: bool) -> tuple[list[Any], bool]:
    """All statements of a file; fine where each is what the file expects, or true where it expects nothing."""
    from freebody.check.file import judge

    stated, fine = [], True
    for judged in judge(path):
        stated.append(judged.to_json())
        fine &= judged.verdict.ok if judged.as_expected is None else judged.as_expected
        if not quiet:
            show(f"{judged.statement.id}: {judged.statement.says}", judged.verdict, judged.as_expected is False)
    return stated, fine


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
