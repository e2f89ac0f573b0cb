"""``freebody code``: the equations of a model as functions of a programming language."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from freebody.cli.models import opened, written
from freebody.cli.options import Changes, Model, offering
from freebody.codegen.languages import LANGUAGES
from freebody.formats import write

_FIRST = next(iter(LANGUAGES))


@offering({each.word: f"{each.doc}; so does an output that ends in .{each.ending}." for each in LANGUAGES.values()})
def code(
    model: Model,
    output: Annotated[Path | None, typer.Option("-o", "--output", help="Where it goes, instead of the screen.")] = None,
    changes: Changes = None,
    **asked: bool,
) -> None:
    """Print functions that compute accelerations and all reactions by themselves."""
    ending = output.suffix.removeprefix(".") if output else ""
    fitting = [word for word, each in LANGUAGES.items() if asked[word] or (ending == each.ending and not any(asked.values()))]
    text = opened(model, changes).code(fitting[0] if fitting else _FIRST)
    if output is None:
        typer.echo(text.rstrip("\n"))
    else:
        written(write(output, text))
