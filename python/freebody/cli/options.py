"""Arguments and options that several commands have."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path
from typing import Annotated, Any

import typer
from typer.core import TyperCommand

from freebody.formats import Formats, check_writable

Model = Annotated[Path, typer.Argument(metavar="MODEL", help="Model file, YAML or JSON.")]
Changes = Annotated[list[str] | None, typer.Option("--set", metavar="NAME=VALUE", help="Change a parameter; repeatable.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON, for scripts.")]
At = Annotated[
    list[str] | None, typer.Option(metavar="TIME|NAME=VALUE", help="A time of the motion, or a coordinate of the start.")
]
Before = Annotated[
    str | None, typer.Option(metavar="EVENT", help="Just before an event or mode change; start: what happens there.")
]
After = Annotated[str | None, typer.Option(metavar="EVENT", help="Just after an event or mode change; start is the default.")]
Until = Annotated[str | None, typer.Option(metavar="TIME", help="End of the run, like 5 or '200 ms'.")]


def _in_units(context: typer.Context, text: str | None) -> str | None:
    """The command shows its figures in these units."""
    from freebody.model.user_units import units

    context.with_resource(units(text or ""))
    return text


Units = Annotated[
    str | None,
    typer.Option(
        "--units",
        metavar="UNITS",
        callback=_in_units,
        help="Of tables: lb-ft, lb-in, N-mm, SI, or a list like 'mm, deg, rpm'.",
    ),
]


def offering(choices: Mapping[str, str]) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """A command that takes ``**asked``, with an option ``--word`` for every word, and what it says of itself."""

    def with_options(command: Callable[..., None]) -> Callable[..., None]:
        signature = inspect.signature(command, eval_str=True)
        own = [each for each in signature.parameters.values() if each.kind is not each.VAR_KEYWORD]
        kinds: dict[str, Any] = {word: Annotated[bool, typer.Option(f"--{word}", help=doc)] for word, doc in choices.items()}
        added = [inspect.Parameter(word, own[0].KEYWORD_ONLY, default=False, annotation=kinds[word]) for word in choices]
        command.__signature__ = signature.replace(parameters=[*own, *added])  # type: ignore[attr-defined]
        return command

    return with_options


class Command(TyperCommand):
    """A command in whose help ``{run.storage}`` stands for the kinds of files there, read only when they are asked for. What it
    writes is held against them before it begins, against those of ``--column`` where only columns are written."""

    def format_help(self, *where: Any) -> None:
        for option in self.params:
            for home, formats in _formats(option):
                option.help = option.help.replace(f"{{{home}}}", str(formats))  # type: ignore[attr-defined]
        super().format_help(*where)

    def invoke(self, context: typer.Context) -> Any:
        if output := context.params.get("output"):
            says = "column" if context.params.get("column") else "output"
            for option in self.params:
                for _, formats in _formats(option) if option.name == says else ():
                    formats.of(output)
            check_writable(output)
        return super().invoke(context)


def _formats(option: Any) -> list[tuple[str, Formats[Any]]]:
    """The kinds of files that the help of an option names, and where they are listed."""
    homes = re.findall(r"\{([a-z.]+)\}", getattr(option, "help", None) or "")
    return [(home, import_module(f"freebody.{home}").FORMATS) for home in homes]
