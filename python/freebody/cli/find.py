"""The command ``find``: with which values is it so, where is it greatest, where does it tend to?"""

from __future__ import annotations

from typing import Annotated, Any

import typer

from freebody.cli.models import opened, ranges
from freebody.cli.options import AsJson, Changes, Model, Units, Until
from freebody.cli.terminal import print_json
from freebody.cli.user_errors import NOT_TRUE, UserError


def find(
    model: Model,
    of: Annotated[
        str, typer.Option(metavar="QUANTITY", help="As in a report: 'theta @ 1 s', 'max of A.Fx', or a label of the report.")
    ],
    target: Annotated[str | None, typer.Option("--is", metavar="VALUE", help="All values for which it is this.")] = None,
    vary: Annotated[
        str | None, typer.Option(metavar="NAME=A..B", help="A parameter, or coordinate or rate(…) of the start.")
    ] = None,
    to_infinity: Annotated[
        bool, typer.Option("--limit", help="What it tends to as t → ∞, or as NAME goes from A towards B (inf).")
    ] = False,
    points: Annotated[int, typer.Option(min=4, help="Of the first grid; intervals are halved where that is too coarse.")] = 33,
    changes: Changes = None,
    until: Until = None,
    rtol: Annotated[float | None, typer.Option(help="Relative tolerance of the runs.")] = None,
    units: Units = None,
    as_json: AsJson = False,
) -> None:
    """All values of a parameter or of the start for which a quantity is what it is asked to be; without --is, its extremes."""
    from freebody.model import user_units

    mechanism = opened(model, changes)
    asked: dict[str, Any] = {name: value for name, value in (("until", until), ("rtol", rtol)) if value is not None}
    ((name, within),) = ranges([vary or ""], "--vary").items() if vary or not to_infinity else (("", ()),)
    user_units.as_asked(target, *within)
    if to_infinity:
        if target:
            raise UserError("--limit says what it tends to, and --is what it shall be", "give one of them")
        asked |= {"vary": name, "begin": within[0], "towards": within[1]} if within else {}
        found, is_answered = mechanism.limit(of, **asked), True
    else:
        asked |= {"vary": name, "within": within, "points": points}
        found = mechanism.extremes(of, **asked) if target is None else mechanism.find(of, target, **asked)
        is_answered = target is None or bool(found.roots or found.throughout)
    if as_json:
        print_json(found.to_json())
    else:
        print(found)
    if not is_answered:
        raise typer.Exit(NOT_TRUE)
