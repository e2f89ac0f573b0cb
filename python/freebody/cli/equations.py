"""``freebody equations``: the equations of motion, derived."""

from __future__ import annotations

from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from freebody.cli.mistakes import Mistake

if TYPE_CHECKING:
    from freebody.equations.derivation import Equations
    from freebody.equations.document import Document
    from freebody.model import Mechanism


class Form(str, Enum):
    """Forms of the equations of motion, and further derivations."""

    minimal = "minimal"
    brute = "brute"
    constraints = "constraints"
    lagrange = "lagrange"
    linear = "linear"
    frame = "frame"
    particle = "particle"
    moment = "moment"
    elimination = "elimination"
    impact = "impact"
    out_of_plane = "out_of_plane"


class Language(str, Enum):
    """Languages of generated functions."""

    python = "python"
    c = "c"


def equations(
    model: Annotated[Path, typer.Argument(metavar="MODEL", help="Model file, YAML or JSON.")],
    form: Annotated[
        Form, typer.Option(help="Free of reactions, three balances a body, all constraints; or a further derivation.")
    ] = Form.minimal,
    want: Annotated[
        str | None, typer.Option("--for", metavar="WANTED", help="The fewest equations for this: theta, A.Fx …")
    ] = None,
    at_rest: Annotated[bool, typer.Option("--at-rest", help="All rates are 0.")] = False,
    fixed: Annotated[
        list[str] | None,
        typer.Option(
            "--set", metavar="NAME=VALUE", help="A letter as a number, or an option of a derivation, point=rod.B; repeatable."
        ),
    ] = None,
    latex: Annotated[bool, typer.Option("--latex", help="A fragment of LaTeX.")] = False,
    markdown: Annotated[bool, typer.Option("--markdown", help="Markdown.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON, for scripts.")] = False,
    code: Annotated[Language | None, typer.Option(help="Functions for the matrix form: python (NumPy) or c.")] = None,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="Where it goes: .txt, .tex, .md, .html, .json, .py, .c.")
    ] = None,
) -> None:
    """Derive the equations of motion: kinematics, free bodies, balances, matrix form, what is conserved."""
    from freebody.cli import opened, pairs

    found = derived(opened(model), form.value, want, at_rest, pairs(fixed))
    asked = [word for word, given in (("tex", latex), ("md", markdown), ("json", as_json), (_ending(code), code)) if given]
    if len(asked) > 1:
        raise Mistake("several ways to print are asked for", "take one of --latex, --markdown, --json, --code")
    kind = asked[0] if asked else output.suffix.removeprefix(".") if output else "txt"
    _refuse(found, kind)
    if output:
        from freebody.cli import show

        show.written(found.save(output, kind))
    else:
        typer.echo(found.printed(kind).rstrip("\n"))


def derived(mechanism: Mechanism, form: str, want: str | None, at_rest: bool, fixed: dict[str, str]) -> Equations | Document:
    """The equations in a form, or a further derivation."""
    from freebody.equations.topics import TOPICS, topic

    if form in TOPICS:
        if want or at_rest:
            raise Mistake(f"--for and --at-rest are not for --form {form}", f"it takes options by --set: {TOPICS[form].doc}")
        return topic(mechanism, form, **fixed)
    try:
        return mechanism.equations(form, want=want, at_rest=at_rest, fixed=fixed)
    except KeyError as error:
        raise Mistake(error.args[0], "freebody equations MODEL --form brute lists all unknowns") from None


def _refuse(found: Equations | Document, kind: str) -> None:
    """Raises ``Mistake`` for what cannot be printed in a way, by the ending of its file."""
    ways = ("txt", "tex", "md", "html", "json", "py", "c")
    if kind not in ways:
        raise Mistake(f"files that end in .{kind} cannot be written", f"take one of {', '.join('.' + way for way in ways)}")
    if kind in ("py", "c") and not hasattr(found, "code"):
        raise Mistake("functions are made of the forms minimal, brute and constraints", "take one of these, or print text")


def _ending(code: Language | None) -> str:
    return "c" if code is Language.c else "py"
