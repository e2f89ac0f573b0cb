"""Documents as plain text."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import zip_longest

from freebody.document.blocks import Block, Equation, Figure, Heading, Matrices, Side, Vector, Words, Written, is_tree, pieces
from freebody.document.rendering.format import Format
from freebody.document.rendering.markup import Markup
from freebody.document.rendering.matrices import has_matrices
from freebody.symbolic.alphabet import columns
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.printers.text import equation_text, printer, sides_text, text

_INDENT, _BETWEEN = "    ", "  "
_BRIEF = 20
"""Letters of what an equation is called up to which it stands close under another."""
_NARROW = 12
"""Columns that the widest column of a table has at least."""
_TIE = "\u00a0"
_CORNERS = {False: ("⎡⎤", "⎢⎥", "⎣⎦", "[]"), True: ("[]", "[]", "[]", "[]")}


def side_text(side: Side, nomenclature: Nomenclature, *, ascii: bool = False) -> str:
    """One side of an equation, or mathematics in a sentence."""
    if isinstance(side, Written):
        return side.text
    return (
        printer(nomenclature, ascii).vector(side.components)
        if isinstance(side, Vector)
        else text(side, nomenclature, ascii=ascii)
    )


def words_text(words: Words, nomenclature: Nomenclature) -> str:
    """A sentence on one line."""
    return Text(nomenclature).words(words).replace(_TIE, " ")


@dataclass(frozen=True)
class Text(Markup):
    """Lines of at most ``width`` columns, as far as equations can be broken."""

    ascii: bool = False
    width: int = 100
    gap = "\n"

    @property
    def across(self) -> int:
        """Columns that an equation of matrices may take beside its label."""
        return self.width - len(_INDENT) - 8

    def render(self, blocks: Sequence[Block]) -> str:
        made, above = "", None
        for block in blocks:
            if shown := self.block(block):
                made += (_space(above, block) if above else "") + shown
                above = block
        return made.replace(_TIE, " ") + "\n"

    def plain(self, text: str) -> str:
        return text

    def math(self, side: Side) -> str:
        # A line ends at plus and minus signs only.
        shown = side_text(side, self.nomenclature, ascii=self.ascii)
        if isinstance(side, Written):
            return shown.replace(" ", _TIE)
        return re.sub(rf" (?![+−-]{_TIE})", _TIE, re.sub(r"(?<= [+−-]) ", _TIE, shown))

    def heading(self, title: str, level: int) -> str:
        lines = _wrapped(title, self.width)
        under = ["=-"[level - 1] * max(map(columns, lines))] if level < 3 else []
        return "\n".join([*lines, *under])

    def paragraph(self, words: str, lead: str = "") -> str:
        lines = _wrapped(words, self.width - len(lead))
        return lead + f"\n{' ' * len(lead)}".join(lines)

    def bullets(self, items: Sequence[str]) -> str:
        return "\n".join(self.paragraph(item, "- ") for item in items)

    def equation(self, block: Equation) -> str:
        left, right = block.left, block.right
        room = self.width - len(_INDENT) - (len(block.label) + 4 if block.label else 0)
        if has_matrices(block):
            shown = self._spread(block)
        elif is_tree(left) and is_tree(right):
            shown = equation_text(left, right, self.nomenclature, ascii=self.ascii, width=room)
        else:
            shown = sides_text(*(side_text(side, self.nomenclature, ascii=self.ascii) for side in (left, right)), room)
        if not has_matrices(block):
            shown = "\n".join(part for line in shown.split("\n") for part in _broken(line, room))
        lines = textwrap.indent(shown, _INDENT).split("\n")
        if block.label:
            lines[-1] += " " * max(2, self.width - columns(lines[-1]) - len(block.label) - 2) + f"({block.label})"
        return "\n".join(lines)

    def _spread(self, block: Equation) -> str:
        """Matrices side by side, over several lines."""
        parts = [self._grid(side) for side in (block.left, block.right)]
        height = max(map(len, parts))
        left, right = (_padded(part, height) for part in parts)
        middle = (height - 1) // 2
        return "\n".join(f"{a} {'=' if i == middle else ' '} {b}" for i, (a, b) in enumerate(zip(left, right, strict=True)))

    def _grid(self, side: Side) -> list[str]:
        """The lines of a product of matrices, or of a symbol."""
        if not isinstance(side, Matrices):
            return [side_text(side, self.nomenclature, ascii=self.ascii)]
        shown = (
            [[text(tree, self.nomenclature, ascii=self.ascii) for tree in row] for row in each.rows] for each in side.factors
        )
        parts = [self._bracketed(rows) for rows in shown]
        height = max(map(len, parts))
        return [" ".join(row) for row in zip(*(_padded(part, height) for part in parts), strict=True)]

    def _bracketed(self, rows: Sequence[Sequence[str]]) -> list[str]:
        widths = [max(map(columns, column)) for column in zip(*rows, strict=True)]
        top, middle, bottom, single = _CORNERS[self.ascii]
        edges = [single] if len(rows) == 1 else [top, *[middle] * (len(rows) - 2), bottom]
        lines = ("  ".join(_centred(cell, width) for cell, width in zip(row, widths, strict=True)) for row in rows)
        return [f"{left} {line} {right}" for (left, right), line in zip(edges, lines, strict=True)]

    def table(self, heads: Sequence[str], rows: Sequence[Sequence[str]], caption: str) -> str:
        widths = [max(map(columns, column)) for column in zip(heads, *rows, strict=True)]
        over = sum(widths) + len(_BETWEEN) * (len(widths) - 1) - self.width
        if over > 0:  # the widest column on several lines
            widest = widths.index(max(widths))
            widths[widest] = max(widths[widest] - over, _NARROW)
        lines = []
        for row in (heads, ["-" * width for width in widths], *rows):
            cells = zip_longest(*(_wrapped(cell, width) for cell, width in zip(row, widths, strict=True)), fillvalue="")
            lines += [_BETWEEN.join(_filled(*each) for each in zip(line, widths, strict=True)).rstrip() for line in cells]
        return "\n".join((_wrapped(caption, self.width) if caption else []) + lines)

    def figure(self, figure: Figure, caption: str) -> str:
        return ""


def _space(above: Block, below: Block) -> str:
    """Equations with no more than a word between them stand together, and what stands under a small heading."""
    if isinstance(above, Heading) and above.level > 2:
        return "\n"
    if (
        not (isinstance(above, Equation) and isinstance(below, Equation))
        or above.note
        or has_matrices(above)
        or has_matrices(below)
    ):
        return "\n\n"
    return "\n" if sum(map(len, filter(lambda piece: isinstance(piece, str), pieces(below.name)))) <= _BRIEF else "\n\n"


def _wrapped(words: str, width: int) -> list[str]:
    """Words on lines of at most so many columns, as far as there is space between them."""
    lines = [""]
    for each in words.split(" "):
        longer = f"{lines[-1]} {each}" if lines[-1] else each
        if columns(longer) <= width or not lines[-1]:
            lines[-1] = longer
        else:
            lines.append(each)
    return lines


def _broken(line: str, width: int) -> list[str]:
    """A line of an equation, where it has no sign to be broken at between factors; one with products of vectors before their signs."""
    if columns(line) <= width:
        return [line]
    margin = " " * (len(line) - len(line.lstrip()))
    inner = line.strip()
    inner = re.sub(" (?!×)", _TIE, inner) if " × " in inner else inner
    first, *more = (part.replace(_TIE, " ") for part in _wrapped(inner, width - len(margin) - 2))
    return [margin + first, *(f"{margin}  {each}" for each in more)]


def _filled(cell: str, width: int) -> str:
    return cell + " " * (width - columns(cell))


def _padded(lines: list[str], height: int) -> list[str]:
    """The lines in the middle of some more."""
    blank, spare = " " * columns(lines[0]), height - len(lines)
    return [blank] * (spare // 2) + lines + [blank] * (spare - spare // 2)


def _centred(cell: str, width: int) -> str:
    spare = width - columns(cell)
    return " " * (spare // 2) + cell + " " * (spare - spare // 2)


FORMAT = Format("txt", "text", "Plain text.", lambda blocks, nomenclature, beside: Text(nomenclature).render(blocks))
