"""Tables of an instant, for rich."""

from __future__ import annotations

import html
import math
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.table import Table

    from freebody.core import Limit
    from freebody.solve.instant import Reaction

_WORDS = ("motion", "coupling", "lock", "coordinate", "unit", "joint", "on", "body", "", "state")
_ROUND_OFF = 1e-12  # of a contact's force: below it a component is what rounding left


def figure(value: float) -> str:
    """Six digits; -0 is 0, NaN is indeterminate."""
    if math.isnan(value):
        return "indeterminate"
    return f"{value + 0.0:.6g}"


class PlainText:
    """What a notebook shows as its text, line by line."""

    def _repr_html_(self) -> str:
        return f'<div style="white-space: pre-wrap">{html.escape(str(self))}</div>'


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
    """How contacts, strings and stops hold: state, gap, normal force or tension, friction."""
    made = _table("contacts, strings and stops", "", "state", "gap [m]", "force [N]", "friction [N]")
    for limit in limits:
        turns = limit.dimension == "rad"
        friction = figure(limit.T) if limit.kind == "contact" else ""
        _add(made, limit.name, limit.state, figure(limit.gap) + " rad" * turns, figure(limit.N) + " N·m" * turns, friction)
    return made


def of_forces(limits: Iterable[Limit]) -> Table:
    """The forces of contacts and strings that carry, on their first body, and where a contact acts."""
    made = _table("their forces", "", "on", "Fx [N]", "Fy [N]", "at x [m]", "at y [m]")
    for limit in limits:
        noise = _ROUND_OFF * abs(limit.N)
        if limit.kind != "stop" and limit.N != 0:
            force = [figure(0.0 if abs(f) <= noise else f) for f in (limit.Fx, limit.Fy)]
            _add(made, limit.name, limit.first, *force, *(map(figure, limit.at) if limit.at else ("", "")))
    return made


def of_drives(title: str, kind: str, values: Mapping[str, float]) -> Table:
    """The forces of prescribed motions, couplings or locks."""
    made = _table(title, kind, "force or torque")
    for name, value in values.items():
        _add(made, name, figure(value))
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
