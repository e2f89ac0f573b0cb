"""What the command ``systems`` says of the statements about systems."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import typer

from freebody.cli.user_errors import UserError

if TYPE_CHECKING:
    from freebody.catalogue import System

NOT_AS_EXPECTED = 3


def judged(systems: list[System], as_json: bool) -> None:
    """The verdicts about what is stated, in tables or as JSON. Ends with an error where one is not as expected."""
    from freebody.catalogue import show
    from freebody.catalogue.statements import statements, statements_json
    from freebody.model.errors import ModelProblem

    results = []
    try:
        for system, found in statements(systems):
            results.append((system, found))
            if not as_json:
                show.show_statements(system, found)
    except ModelProblem as complaint:
        raise UserError(complaint.what, complaint.hint) from None
    every = [one for _, found in results for one in found]
    if as_json:
        typer.echo(json.dumps(statements_json(results), ensure_ascii=False, indent=1))
    else:
        show.show_totals(every)
    if any(one.as_expected is False for one in every):
        raise typer.Exit(NOT_AS_EXPECTED)


def verdicts(systems: list[System]) -> None:
    """In short, which of the statements about systems are true."""
    from freebody.catalogue import show
    from freebody.catalogue.statements import statements

    for system, found in statements(systems):
        show.show_verdicts(system, found)
