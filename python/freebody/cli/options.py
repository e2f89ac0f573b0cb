"""Arguments and options that several commands have."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

Model = Annotated[Path, typer.Argument(metavar="MODEL", help="Model file, YAML or JSON.")]
Changes = Annotated[list[str] | None, typer.Option("--set", metavar="NAME=VALUE", help="Change a parameter; repeatable.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON, for scripts.")]
Until = Annotated[str | None, typer.Option(metavar="TIME", help="End of the run, like 5 or '200 ms'.")]
