"""The command ``periodic``: motions that come back, their multipliers, and boundaries of stability."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from freebody.cli.models import opened, pairs, ranges
from freebody.cli.options import AsJson, Changes, Model, Units
from freebody.cli.terminal import print_json

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from rich.table import Table

    from freebody.periodic.ask import Periodic
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
    units: Units = None,
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
        _show_limit(name, asked.limit(name, first), asked, as_json)
    elif boundary:
        ((name, bounds),) = ranges([boundary], "--boundary").items()
        _show_crossings(name, asked.boundary(name, bounds), asked, as_json)
    else:
        _show_motions(asked.find_all(ranges(within, "--within"), starts) if within else [asked.find()], asked, as_json)


def _show_motions(found: Sequence[PeriodicMotion], asked: Periodic, as_json: bool) -> None:
    from rich.console import Console

    from freebody.model.user_units import shown
    from freebody.periodic.motion import PeriodicMotions
    from freebody.solve.rich_tables import figure_in, table

    sought = found.sentence if isinstance(found, PeriodicMotions) else "Newton's method from the start of the model"
    if as_json:
        print_json({"looked": sought, "motions": [_motion(each) for each in found]})
        return
    console = Console(highlight=False, soft_wrap=True)
    console.print(f"{sought}\n")
    for each in found:
        console.print(_values("starts with", {name: (value, asked.unit_of(name)) for name, value in each.values.items()}))
        time = f"{figure_in('s', each.period, 12)} {shown('s').unit}"
        console.print(f"comes back after {time}, {'stable' if each.stable else 'not stable'}\n")
        rows = [[f"{mu:.10g}" if abs(mu.imag) else f"{mu.real:.10g}", float(abs(mu))] for mu in each.multipliers.tolist()]
        console.print(table("multipliers", ["multiplier", "modulus"], rows))
        console.print(table("checked", ["", "differs by"], [[name, float(value)] for name, value in each.checks.items()]))


def _show_limit(name: str, found: Limit, asked: Periodic, as_json: bool) -> None:
    from rich.console import Console

    from freebody.solve.rich_tables import table

    if as_json:
        multipliers = [[mu.real, mu.imag] for mu in found.multipliers.tolist()]
        print_json({"values": dict(found.values), "period": found.period, "multipliers": multipliers, "estimate": found.error})
        return
    console = Console(highlight=False, soft_wrap=True)
    values = {each: (value, asked.unit_of(each)) for each, value in found.values.items()}
    console.print(_values(f"as {name} → 0", values | {"period": (found.period, "s")}))
    console.print(
        table("multipliers", ["multiplier", "modulus"], [[f"{x:.8g}", float(abs(x))] for x in found.multipliers.tolist()])
    )
    console.print(f"estimate of the error, from the last two extrapolations: {found.error:.0e}")


def _values(title: str, values: Mapping[str, tuple[float, str]]) -> Table:
    """Values in units of SI, with twelve digits, as they are shown."""
    from freebody.solve.rich_tables import figure_in, table

    rows = [(name, figure_in(unit, value, 12), unit) for name, (value, unit) in values.items()]
    return table(title, ["name", "value", "unit"], rows, ["value"])


def _motion(found: PeriodicMotion) -> dict[str, Any]:
    multipliers = [[mu.real, mu.imag] for mu in found.multipliers.tolist()]
    checks = {name: float(value) for name, value in found.checks.items()}
    return {"values": dict(found.values), "period": found.period, "stable": found.stable, "multipliers": multipliers,
            "slopes": found.slopes.tolist(), "checks": checks}  # fmt: skip


def _show_crossings(name: str, found: list[Crossing], asked: Periodic, as_json: bool) -> None:
    from rich.console import Console

    from freebody.model.user_units import shown
    from freebody.solve.rich_tables import figure_in, table

    if as_json:
        print_json([{"value": each.value, "kind": each.kind, "miss": each.miss} for each in found])
        return
    console = Console(highlight=False, soft_wrap=True)
    if not found:
        console.print("no multiplier reaches the unit circle within these bounds")
        return
    unit = asked.unit_of(name)
    head = f"{name} [{shown(unit).unit}]" if unit else name
    rows = [[figure_in(unit, each.value, 12), each.kind, each.miss] for each in found]
    console.print(table("boundaries of stability", [head, "a multiplier leaves the unit circle", "condition"], rows))
