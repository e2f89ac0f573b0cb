"""Tables of an instant, for rich."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.table import Table

    from freebody.instant import Reaction
    from freebody.switched import Limit

_WORDS = ("coordinate", "unit", "joint", "on", "body", "", "state")
_ROUND_OFF = 1e-12  # of a contact's force: below it a component is what rounding left


def figure(value: float) -> str:
    """Six digits; -0 is 0."""
    return f"{value + 0.0:.6g}"


def of_accelerations(coordinates: Iterable[Mapping[str, Any]], values: Mapping[str, float]) -> Table:
    """Second time derivatives of the coordinates."""
    made = _table("accelerations", "coordinate", "value", "unit")
    for coordinate in coordinates:
        _add(made, coordinate["name"], figure(values[coordinate["name"]]), f"{coordinate['dimension']}/s²")
    return made


def of_reactions(reactions: Iterable[Reaction]) -> Table:
    """Reactions on both bodies of every joint that can carry a load."""
    made = _table("reactions", "joint", "on", "Fx [N]", "Fy [N]", "M [N·m]")
    for joint in reactions:
        for body in (joint.second, joint.first) if joint.carries else ():
            side = joint.on(body)
            cells = zip(side.values.tolist(), side.determined.tolist(), strict=True)
            figures = [figure(value) if known else "indeterminate" for value, known in cells]
            figures[2] = figures[2] if joint.has_couple else ""
            _add(made, joint.name if body == joint.second else "", body, *figures)
    return made


def of_limits(limits: Iterable[Limit]) -> Table:
    """Contacts, strings and stops; forces as they act on the body named."""
    shown = list(limits)
    rubs, told = any(limit.kind == "contact" for limit in shown), any(limit.state for limit in shown)
    heads = [
        "",
        *(["state"] if told else []),
        "gap [m]",
        "force [N]",
        *(["friction [N]"] if rubs else []),
        "on",
        "Fx [N]",
        "Fy [N]",
    ]
    made = _table("contacts, strings and stops", *heads, *(["x [m]", "y [m]"] if rubs else []))
    for limit in shown:
        acts = limit.kind != "stop" and limit.state not in ("off", "open", "slack")
        turns = limit.dimension == "rad"
        noise = _ROUND_OFF * abs(limit.N)
        force = [limit.first, *(figure(f if abs(f) > noise else 0.0) for f in (limit.Fx, limit.Fy))] if acts else ["", "", ""]
        _add(
            made,
            limit.name,
            *([limit.state] if told else []),
            figure(limit.gap) + " rad" * turns,
            figure(limit.N) + " N·m" * turns,
            *([figure(limit.T) if limit.kind == "contact" else ""] if rubs else []),
            *force,
            *([*map(figure, limit.at or ())] or ["", ""] if rubs else []),
        )
    return made


def of_residuals(residuals: Mapping[str, tuple[float, float, float]]) -> Table:
    """What is left of the momentum balance of every body."""
    made = _table("what is left of the momentum balances", "body", "x [N]", "y [N]", "about G [N·m]")
    for body, row in residuals.items():
        _add(made, body, *(f"{value:.1e}" for value in row))
    return made


def _table(title: str, *heads: str) -> Table:
    from rich import box
    from rich.table import Table

    made = Table(title=title, title_justify="left", box=box.SIMPLE_HEAD, show_edge=False, title_style="bold")
    for head in heads:
        made.add_column(head.replace("[", r"\["), justify="left" if head in _WORDS else "right")
    return made


def _add(table: Table, *cells: str) -> None:
    from rich.text import Text

    # Names come from the model: as Text they cannot be taken for markup.
    table.add_row(*(Text(cell) for cell in cells))
