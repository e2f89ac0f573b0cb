"""``freebody equations``: the equations of motion, derived."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from freebody.cli.models import how_far, leading_to, moment, opened, pairs, time_of, written
from freebody.cli.options import After, Before, Model, offering
from freebody.cli.terminal import speaks_unicode, spelt, width
from freebody.cli.user_errors import UserError
from freebody.codegen.languages import LANGUAGES
from freebody.document.rendering import FORMATS, text

if TYPE_CHECKING:
    from freebody.document.document import Document
    from freebody.mechanism import Mechanism

_ENDINGS = ", ".join(f".{ending}" for ending in FORMATS)
SOLVED = "solved"


def listed(asked: bool) -> None:
    """Prints the forms and the topics, and ends."""
    if asked:
        from freebody.equations.derivation.derive import FORMS
        from freebody.equations.topics import TOPICS, described

        typer.echo("\n".join([*FORMS, SOLVED]))
        for name in TOPICS:
            what, options = described(name)
            typer.echo("\n    ".join(filter(None, (name, what, options and f"Options: {options}"))))
        raise typer.Exit


@offering({each.word: each.doc for each in FORMATS.values()})
def equations(
    model: Model,
    form: Annotated[
        str,
        typer.Option(
            metavar="FORM",
            help="minimal: free of reactions; brute: three balances a body; constraints; first-order; solved; or a topic, see --forms.",
        ),
    ] = "minimal",
    forms: Annotated[bool, typer.Option("--forms", help="List all forms and topics.", is_eager=True, callback=listed)] = False,
    want: Annotated[
        list[str] | None,
        typer.Option(
            "--for", metavar="WANTED", help="The fewest equations for this: theta, A.Fx …; with --form solved repeatable."
        ),
    ] = None,
    about: Annotated[
        str | None, typer.Option(metavar="POINTS", help="With --for: the points and directions to take, one an equation: B,B,x.")
    ] = None,
    long: Annotated[
        bool, typer.Option("--long", help="All that there is to say: every load by itself, matrices, what is conserved.")
    ] = False,
    at_rest: Annotated[bool, typer.Option("--at-rest", help="All rates are 0.")] = False,
    at: Annotated[str | None, typer.Option(metavar="TIME", help="As at a time of the motion.")] = None,
    before: Before = None,
    after: After = None,
    fixed: Annotated[
        list[str] | None,
        typer.Option(
            "--set", metavar="NAME=VALUE", help="A symbol as a number, or an option of a topic, point=rod.B; repeatable."
        ),
    ] = None,
    limits: Annotated[
        list[str] | None,
        typer.Option(
            "--limit", metavar="NAME=VALUE", help="Also the equations, or the answer solved, as m2=inf, l=0 …; repeatable."
        ),
    ] = None,
    of: Annotated[
        str | None,
        typer.Option(metavar="POINT", help="Position, velocity and acceleration of a point instead, like rod.B, with --frame."),
    ] = None,
    frame: Annotated[
        str | None,
        typer.Option(
            metavar="BODY", help="With --of: the body through whose frame; several, rod,wheel, are a chain; also by itself."
        ),
    ] = None,
    output: Annotated[Path | None, typer.Option("-o", "--output", help=f"Where it goes: {_ENDINGS}.")] = None,
    **asked: bool,
) -> None:
    """Derive the equations of motion: kinematics, free bodies, balances, matrix form, what is conserved."""
    wanted = [name.strip() for each in want or () for name in each.split(",")]
    if form != SOLVED and len(wanted) > 1:
        raise UserError("several unknowns are wanted", "ask for one, or take --form solved")
    if about and (form == SOLVED or not wanted):
        raise UserError("--about is for --for", "give what is wanted: --for T --about B,B,x")
    mechanism, substituted, when = opened(model), pairs(fixed), moment([at] if at else None, before, after)
    try:
        if form == SOLVED:
            more = {"at_rest": at_rest, "set": substituted, "limits": pairs(limits)}
            found: Document = mechanism.solve_in_letters(wanted or None, **more, **when)
        else:
            asked_for: dict[str, Any] = {"of": of, "frame": frame} if of or frame else {}
            asked_for |= {"about": [name.strip() for name in about.split(",")]} if about else {}
            asked_for |= {"long": True} if long else {}
            asked_for |= {"limits": pairs(limits)} if limits else {}
            found = derived(mechanism, form, wanted[0] if wanted else None, at_rest, substituted, when, asked_for)
    except KeyError as error:
        raise UserError(error.args[0], "freebody equations MODEL --form brute lists all unknowns") from None
    found = found.with_remark(how_far(leading_to(mechanism, time_of(mechanism, when))))
    kinds = [each.ending for each in FORMATS.values() if asked[each.word]]
    if len(kinds) > 1:
        raise UserError(
            "several ways to print are asked for", f"take one of {', '.join(f'--{f.word}' for f in FORMATS.values())}"
        )
    kind = kinds[0] if kinds else output.suffix.removeprefix(".") if output else next(iter(FORMATS))
    if kind in (language.ending for language in LANGUAGES.values()):
        raise UserError("equations are printed, not written as functions", f"freebody code MODEL -o FILE.{kind} does that")
    if kind not in FORMATS:
        raise UserError(f"files that end in .{kind} cannot be written", f"take one of {_ENDINGS}")
    if output:
        written(*found.save(output, kind))
    else:
        if kind == text.FORMAT.ending:
            plain = found.text(ascii=not speaks_unicode(), width=width())
            shown = plain if speaks_unicode() else spelt(plain)
        else:
            shown = found.printed(kind)
        typer.echo(shown.rstrip("\n"))


def derived(
    mechanism: Mechanism,
    form: str,
    want: str | None,
    at_rest: bool,
    fixed: dict[str, str],
    when: dict[str, str],
    more: dict[str, Any],
) -> Document:
    """The equations in a form, or the document of a topic."""
    from freebody.equations.derivation.derive import FORMS
    from freebody.equations.topics import TOPICS, described, topic

    if form in TOPICS:
        if want or at_rest or more.keys() - {"long"}:
            raise UserError(
                f"--for, --at-rest, --limit, --of and --frame are not for --form {form}",
                f"by --set it takes {described(form)[1] or 'no options'}",
            )
        return topic(mechanism, form, mechanism.moment(**when)[0], **fixed)
    if form not in FORMS:
        raise UserError(f"there is no form {form!r}", f"there are {', '.join((*FORMS, SOLVED, *TOPICS))}")
    return mechanism.equations(form, want=want, at_rest=at_rest, fixed=fixed, **more, **when)
