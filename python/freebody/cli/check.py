"""The command ``check``: is my equation right?"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from freebody.cli.models import moment, opened
from freebody.cli.options import After, AsJson, At, Before, Changes
from freebody.cli.terminal import print_json
from freebody.cli.user_errors import NOT_TRUE, UserError

if TYPE_CHECKING:
    from freebody.check import Verdict


def check(
    model: Annotated[Path, typer.Argument(metavar="MODEL", help="Model file, or a file of statements about one.")],
    statements: Annotated[
        list[str] | None, typer.Argument(metavar="EQUATION", help="Equations or claims; see docs/check.md.")
    ] = None,
    where: Annotated[
        list[str] | None,
        typer.Option("--where", metavar="SYMBOL=MEANING", help="A symbol of your own, like 'phi=theta-alpha'; repeatable."),
    ] = None,
    at: At = None,
    before: Before = None,
    after: After = None,
    changes: Changes = None,
    as_json: AsJson = False,
) -> None:
    """Say whether equations and claims are true of every motion of a model, as it is at a moment, and correct the wrong ones."""
    from freebody.check import Checker
    from freebody.check import file as stated
    from freebody.check.symbols import declarations
    from freebody.mechanism import Mechanism

    found, fine, asked = [], True, moment(at, before, after)
    if asked and not statements:
        raise UserError("a file of statements is of the start", "give equations: freebody check MODEL EQUATION --after EVENT")
    if statements:
        checker, alone = Checker(opened(model, changes), declarations(where or []), **asked), len(statements) == 1
        for text in statements:
            verdict = checker.check(text) if alone else stated.judged_alone(checker, text)
            found.append(stated.as_json(verdict))
            fine &= verdict.ok
            if not as_json:
                show(text, verdict)
    else:
        for judged in stated.judge(model, Mechanism.load):
            found.append(judged.to_json())
            fine &= judged.verdict.ok if judged.as_expected is None else judged.as_expected
            if not as_json:
                show(f"{judged.statement.id}: {judged.statement.says}", judged.verdict, judged.as_expected is False)
    if as_json:
        print_json(found)
    if not fine:
        raise typer.Exit(NOT_TRUE)


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
