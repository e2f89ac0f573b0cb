"""The command ``periodic``: motions that come back, their multipliers, and boundaries of stability."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from freebody.cli.models import opened, pairs, ranges
from freebody.cli.options import AsJson, Changes, Model
from freebody.cli.terminal import print_json

if TYPE_CHECKING:
    from collections.abc import Sequence

    from freebody.periodic.boundary import Crossing
    from freebody.periodic.limit import Limit
    from freebody.periodic.motion import PeriodicMotion


def periodic(
    model: Model,
    section: Annotated[str | None, typer.Option(metavar="NAME", help="An event, contact or stop at which it comes back.")] = None,
    period: Annotated[str | None, typer.Option(metavar="TIME", help="After which it comes back, like '2*pi/Omega'.")] = None,
    returns: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME=EXPRESSION", help="What it starts with, and what that is when it comes back; repeatable."),
    ] = None,
    horizon: Annotated[str | None, typer.Option(metavar="TIME", help="The longest time to come back in.")] = None,
    within: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME=A..B", help="All within these bounds of what it starts with; repeatable."),
    ] = None,
    starts: Annotated[int, typer.Option(min=1, help="Places within the bounds from which it is looked for them.")] = 32,
    boundary: Annotated[
        str | None, typer.Option(metavar="NAME=A..B", help="Where multipliers reach the unit circle as a parameter changes.")
    ] = None,
    limit: Annotated[
        str | None,
        typer.Option(metavar="NAME=FIRST", help="What it tends to as a parameter goes to 0, halved from a first value."),
    ] = None,
    symbolic: Annotated[bool, typer.Option("--symbolic", help="The map in symbols, where it is short.")] = False,
    changes: Changes = None,
    as_json: AsJson = False,
) -> None:
    """Find periodic motions by Newton's method from the start of the model, with the multipliers of perturbations."""
    asked = opened(model, changes).periodic(
        pairs(returns) or None, section=section, period=period, **({"horizon": horizon} if horizon else {})
    )
    if symbolic:
        found = asked.symbolic()
        print(found.json() if as_json else found.text())
    elif limit:
        ((name, first),) = pairs([limit]).items()
        _show_limit(name, asked.limit(name, first), as_json)
    elif boundary:
        ((name, bounds),) = ranges([boundary], "--boundary").items()
        _show_crossings(name, asked.boundary(name, bounds), as_json)
    else:
        _show_motions(asked.find_all(ranges(within, "--within"), starts) if within else [asked.find()], as_json)


def _show_motions(found: Sequence[PeriodicMotion], as_json: bool) -> None:
    from rich.console import Console

    from freebody.periodic.motion import PeriodicMotions
    from freebody.solve.figures import figure
    from freebody.solve.rich_tables import table

    sought = found.sentence if isinstance(found, PeriodicMotions) else "Newton's method from the start of the model"
    if as_json:
        print_json({"looked": sought, "motions": [_motion(each) for each in found]})
        return
    console = Console(highlight=False, soft_wrap=True)
    console.print(f"{sought}\n")
    for each in found:
        starts = [(name, figure(value, 12)) for name, value in each.values.items()]
        console.print(table("starts with", ["name", "value [SI]"], starts))
        console.print(f"comes back after {figure(each.period, 12)} s, {'stable' if each.stable else 'not stable'}\n")
        rows = [[f"{mu:.10g}" if abs(mu.imag) else f"{mu.real:.10g}", float(abs(mu))] for mu in each.multipliers.tolist()]
        console.print(table("multipliers", ["multiplier", "modulus"], rows))
        console.print(table("checked", ["", "differs by"], [[name, float(value)] for name, value in each.checks.items()]))


def _show_limit(name: str, found: Limit, as_json: bool) -> None:
    from rich.console import Console

    from freebody.solve.figures import figure
    from freebody.solve.rich_tables import table

    if as_json:
        multipliers = [[mu.real, mu.imag] for mu in found.multipliers.tolist()]
        print_json({"values": dict(found.values), "period": found.period, "multipliers": multipliers, "estimate": found.error})
        return
    console = Console(highlight=False, soft_wrap=True)
    rows = [(name, figure(value, 12)) for name, value in [*found.values.items(), ("period", found.period)]]
    console.print(table(f"as {name} → 0", ["name", "value [SI]"], rows))
    console.print(
        table("multipliers", ["multiplier", "modulus"], [[f"{x:.8g}", float(abs(x))] for x in found.multipliers.tolist()])
    )
    console.print(f"estimate of the error, from the last two extrapolations: {found.error:.0e}")


def _motion(found: PeriodicMotion) -> dict[str, Any]:
    multipliers = [[mu.real, mu.imag] for mu in found.multipliers.tolist()]
    checks = {name: float(value) for name, value in found.checks.items()}
    return {"values": dict(found.values), "period": found.period, "stable": found.stable, "multipliers": multipliers,
            "slopes": found.slopes.tolist(), "checks": checks}  # fmt: skip


def _show_crossings(name: str, found: list[Crossing], as_json: bool) -> None:
    from rich.console import Console

    from freebody.solve.figures import figure
    from freebody.solve.rich_tables import table

    if as_json:
        print_json([{"value": each.value, "kind": each.kind, "miss": each.miss} for each in found])
        return
    console = Console(highlight=False, soft_wrap=True)
    if not found:
        console.print("no multiplier reaches the unit circle within these bounds")
        return
    rows = [[figure(each.value, 12), each.kind, each.miss] for each in found]
    console.print(table("boundaries of stability", [f"{name} [SI]", "a multiplier leaves the unit circle", "condition"], rows))
