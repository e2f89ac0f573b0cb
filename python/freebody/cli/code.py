"""``freebody code``: the equations of a model as functions in Python or C."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from freebody.cli.models import opened
from freebody.cli.options import Changes, Model


def code(
    model: Model,
    c: Annotated[bool, typer.Option("--c", help="C instead of Python; so does an output that ends in .c.")] = False,
    output: Annotated[Path | None, typer.Option("-o", "--output", help="Where it goes, instead of the screen.")] = None,
    changes: Changes = None,
) -> None:
    """Print functions that compute accelerations and all reactions: Python that needs NumPy only, or C99."""
    from freebody.cli.show import written

    text = opened(model, changes).code("c" if c or (output and output.suffix == ".c") else "python")
    if output is None:
        typer.echo(text.rstrip("\n"))
    else:
        output.write_text(text, encoding="utf-8")
        written([output])
