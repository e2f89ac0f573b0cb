"""Long tables look as rich would lay them out cell by cell."""

import io

import pytest
from rich.console import Console
from rich.table import Table

from freebody.solve.rich_tables import table

CELLS = {
    "figures": lambda i: (f"pin[{i}]", "rod" if i % 2 else "", 1.2345 * i, -3.3e-5 * i, None if i % 3 else 0.0),
    "wide signs": lambda i: ("漢字" if i % 4 else "θ₁ µ", "m²·s", float(i), float("nan"), "x"),
    "markup": lambda i: ("[b]pin[/b]", "a\\b", float(i), 1e300, ":smile:"),
    "an end of line in a cell": lambda i: ("pin\nand" if i == 7 else "pin", "rod", float(i), 0.0, "x"),
    "one column": lambda i: (None, None, float(i), None, None),
}


@pytest.mark.parametrize("cell", CELLS.values(), ids=CELLS.keys())
@pytest.mark.parametrize("title", ["", "reactions", "what is left of the momentum balances of every body and of all together"])
def test_a_long_table_looks_as_any(cell, title):
    made = table(title, ["joint", "on", "Fx [N]", "Fy [N]", "note"], [cell(i) for i in range(30)])
    for width, coloured in ((30, False), (100, False), (100, True)):
        assert printed(made, width, coloured) == printed(as_any(made), width, coloured)


def as_any(made: Table) -> Table:
    """The same table, laid out by rich."""
    plain = Table(title=made.title, title_justify=made.title_justify, box=made.box, show_edge=made.show_edge)
    plain.columns, plain.rows = made.columns, made.rows
    return plain


def printed(made: Table, width: int, coloured: bool) -> str:
    shown = Console(file=io.StringIO(), width=width, force_terminal=coloured, no_color=not coloured, highlight=False)
    shown.print(made)
    return shown.file.getvalue()
