"""Tables of many rows for rich, which takes a tenth of a millisecond for every cell."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from rich.cells import cell_len
from rich.segment import Segment
from rich.table import Table
from rich.text import Text

_MANY = 20  # rows from which on it is worth it
_BETWEEN = 3  # signs between columns


class LongTable(Table):
    """A table of words and figures without edges. Where many rows fit as they are, rich lays out only the head and the widest cells."""

    def __rich_console__(self, console: Any, options: Any) -> Iterator[Any]:
        columns = [[str(cell) for cell in column.cells] for column in self.columns]
        plain = self.row_count > _MANY and not self.show_edge and all(text.isprintable() for cells in columns for text in cells)
        widest = [max(cells, key=cell_len) for cells in columns] if plain else []
        heads = [str(column.header) for column in self.columns]
        widths = [max(cell_len(head), cell_len(cell)) for head, cell in zip(heads, widest, strict=False)]
        if not plain or sum(widths) + _BETWEEN * len(widths) - 1 > options.max_width:
            yield from super().__rich_console__(console, options)
            return
        short = Table(title=self.title, title_justify=self.title_justify, box=self.box, show_edge=False)
        for column, head, width in zip(self.columns, heads, widths, strict=True):
            short.add_column(Text(head), justify=column.justify, min_width=width)
        short.add_row(*map(Text, widest))
        *above, _ = Segment.split_lines(console.render(short, options))
        for line in above:
            yield from (*line, Segment.line())
        aligned = [_aligned(*each) for each in zip(columns, widths, self.columns, strict=True)]
        yield Segment("".join(f" {'   '.join(row)} \n" for row in zip(*aligned, strict=True)))


def _aligned(cells: list[str], width: int, column: Any) -> list[str]:
    """The cells of a column, of one width."""
    blank = [" " * (width - cell_len(cell)) for cell in cells]
    to_right = column.justify == "right"
    return [space + cell if to_right else cell + space for cell, space in zip(cells, blank, strict=True)]
