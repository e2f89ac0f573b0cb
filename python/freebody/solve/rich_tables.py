"""Tables of an instant, for rich."""

from __future__ import annotations

import html
import re
from collections.abc import Collection, Iterable, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from freebody.model import user_units
from freebody.solve.figures import Known, figure

if TYPE_CHECKING:
    from rich.table import Table

    from freebody.core import Limit
    from freebody.solve.instant import Reaction

_UNIT = re.compile(r"\[(.+)\]$")
_NOTHING = 1e-15  # of the largest force or acceleration, by the metre for couples and turns: less is round-off
_ROUND_OFF = 1e-12  # of a contact's force: below it a component is what rounding left


class PlainText:
    """What is printed for rich in ``width`` columns. A notebook shows its tables as such, or what is printed line by line."""

    width: ClassVar[int] = 100

    def __str__(self) -> str:
        return captured(self, self.width)

    def _repr_html_(self) -> str:
        from rich.console import Console

        console = Console(width=self.width)
        parts = self.__rich_console__(console, console.options) if hasattr(self, "__rich_console__") else [str(self)]
        return "".join(map(as_html, parts))


def as_html(part: Any) -> str:
    """A table for rich as one of a page; anything else as text, line by line."""
    from rich.table import Table

    if not isinstance(part, Table):
        return f'<div style="white-space: pre-wrap">{html.escape(str(part))}</div>' if str(part).strip() else ""
    sides = [f' style="text-align: {column.justify}"' for column in part.columns]

    def row(tag: str, cells: Iterable[Any]) -> str:
        made = (f"<{tag}{side}>{html.escape(str(cell))}</{tag}>" for side, cell in zip(sides, cells, strict=True))
        return f"<tr>{''.join(made)}</tr>"

    head = row("th", (column.header for column in part.columns))
    rows = "".join(row("td", cells) for cells in zip(*(column.cells for column in part.columns), strict=True))
    caption = (
        f'<caption style="text-align: left; font-weight: bold">{html.escape(str(part.title))}</caption>' if part.title else ""
    )
    return f"<table>{caption}<thead>{head}</thead><tbody>{rows}</tbody></table>"


def table(
    title: str, heads: Sequence[str], rows: Iterable[Sequence[Any]], figures: Collection[str] = (), edge: bool = False
) -> Table:
    """A table for rich: words to the left, figures to the right. Figures are floats, what stands below a unit in brackets, and the
    columns with the heads ``figures``; None is left blank, and a blank column is left out. Names come from the model, so nothing is
    taken for markup.

    Figures come in SI, that of their head or else of their row under ``unit``, and are shown in the units that are chosen."""
    from rich import box
    from rich.text import Text

    from freebody.solve.long_tables import LongTable

    rows = list(rows)
    filled = [i for i in range(len(heads)) if not rows or any(row[i] not in ("", None) for row in rows)]
    heads, rows = [heads[i] for i in filled], [[row[i] for i in filled] for row in rows]
    made = LongTable(title=Text(title, "bold") if title else None, title_justify="left", box=box.SIMPLE_HEAD, show_edge=edge)
    heads, rows = _in_user_units(heads, rows)
    stated = [[figure(cell) if isinstance(cell, float) else "" if cell is None else cell for cell in row] for row in rows]
    for i, head in enumerate(heads):
        right = "[" in head or head in figures or any(isinstance(row[i], float) for row in rows)
        widest = max((len(str(row[i])) for row in stated), default=0) if right else None  # words give way to figures
        made.add_column(Text(head), justify="right" if right else "left", min_width=widest, overflow="fold")
    for row in stated:
        made.add_row(*(text if isinstance(text, Text) else Text(str(text)) for text in row))
    return made


def _in_user_units(heads: Sequence[str], rows: Sequence[Sequence[Any]]) -> tuple[list[str], list[list[Any]]]:
    """Heads and rows with their figures as ``user_units`` shows them; a column in which figures are texts stays in SI."""
    heads, rows, own = list(heads), [list(row) for row in rows], list(heads).index("unit") if "unit" in heads else None
    for i, head in enumerate(heads):
        if found := _UNIT.search(head):
            if not any(isinstance(row[i], str) and re.search(r"\d", row[i]) for row in rows):
                other = user_units.shown(found[1])
                heads[i] = head if other.size == 1 else head.replace(found[0], f"[{other.unit.replace('*', '·')}]")
                for row in rows:
                    row[i] = _divided(row[i], other.size)
        elif own is not None:
            for row in rows:
                row[i] = _divided(row[i], user_units.shown(row[own]).size)
    if own is not None:
        for row in rows:
            row[own] = user_units.shown(row[own]).unit
    return heads, rows


def _divided(cell: Any, size: float) -> Any:
    """A figure, with what is known of its error, by the size of its unit; what is none as it is."""
    if size == 1 or not isinstance(cell, float):
        return cell
    return cell.per(size) if isinstance(cell, Known) else cell / size


def figure_in(unit: str, value: float, most: int = 6) -> str:
    """A figure in a unit of SI as it is printed: in the unit that is chosen in its place."""
    return figure(_divided(value, user_units.shown(unit).size), most)


def captured(shown: Any, width: int) -> str:
    """What rich prints, as plain text."""
    from rich.console import Console

    console = Console(width=width, no_color=True, highlight=False)
    with console.capture() as capture:
        console.print(shown)
    return capture.get()


def beside(value: float, largest: float) -> float:
    """A figure, 0 where it is round-off beside the ``largest`` among what balances."""
    return 0.0 if abs(value) <= _NOTHING * largest else value


def of_reactions(reactions: Iterable[Reaction], largest: float) -> Table:
    """Reactions on both bodies of every joint that can carry a load; beside the ``largest`` force among what balances (N) round-off is
    0."""
    rows = []
    for joint in reactions:
        for body in (joint.second, joint.first) if joint.carries else ():
            side = joint.on(body)
            values = [beside(value, largest) for value in side.values]
            x, y, couple = np.where(side.determined, values, np.nan).tolist()
            rows.append((joint.name if body == joint.second else "", body, x, y, couple if joint.has_couple else None))
    return table("reactions", ["joint", "on", "Fx [N]", "Fy [N]", "M [N·m]"], rows)


def of_limits(limits: Iterable[Limit]) -> Table:
    """How contacts, strings and stops hold: state, gap, normal force or tension, friction."""
    rows: list[tuple[Any, ...]] = []
    for limit in limits:
        turns = limit.dimension == "rad"
        held = (f"{figure(limit.gap)} rad", f"{figure(limit.N)} N·m") if turns else (limit.gap, limit.N)
        rows.append((limit.name, limit.state, *held, limit.T if limit.kind == "contact" else None))
    return table("contacts, strings and stops", ["", "state", "gap [m]", "force [N]", "friction [N]"], rows)


def of_forces(limits: Iterable[Limit]) -> Table:
    """The forces of contacts and strings that carry, on their first body, and where a contact acts."""
    rows = []
    for limit in limits:
        if limit.kind != "stop" and limit.N != 0:
            force = [0.0 if abs(f) <= _ROUND_OFF * abs(limit.N) else f for f in (limit.Fx, limit.Fy)]
            rows.append((limit.name, limit.first, *force, *(limit.at or (None, None))))
    return table("their forces", ["", "on", "Fx [N]", "Fy [N]", "at x [m]", "at y [m]"], rows)
