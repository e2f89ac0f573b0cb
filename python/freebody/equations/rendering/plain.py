"""Documents as plain text."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Sequence
from dataclasses import dataclass

from freebody.equations.document import (
    Block,
    Bullets,
    Document,
    Equation,
    Figure,
    Heading,
    MatrixEquation,
    MatrixOf,
    Paragraph,
    Side,
    Table,
    Vector,
    Words,
    Written,
    is_tree,
    pieces,
)  # fmt: skip
from freebody.equations.letters import Letters
from freebody.equations.names import ascii_name, unicode_name
from freebody.equations.text import columns, equation_text, folded, text
from freebody.equations.tree import Add, Tree, is_zero

_INDENT = "    "
FEW = 4
"""Unknowns up to which a matrix that is too wide is told entry by entry."""
_TIE = "\u00a0"
_CORNERS = {False: ("⎡⎤", "⎢⎥", "⎣⎦", "[]"), True: ("[]", "[]", "[]", "[]")}


def render(document: Document, *, ascii: bool, width: int) -> str:
    """All blocks, an empty line between them."""
    writer = _Writer(document.letters, ascii, width)
    made = [(block, writer.block(block)) for block in document.blocks]
    kept = [(block, shown) for block, shown in made if shown]
    spaces = ["" if place == 0 else _space(kept[place - 1][0], block) for place, (block, _) in enumerate(kept)]
    return "".join(space + shown for space, (_, shown) in zip(spaces, kept, strict=True)) + "\n"


def _space(above: Block, below: Block) -> str:
    """Equations without words between them stand together."""
    close = isinstance(above, Equation) and isinstance(below, Equation) and not above.note and not below.name
    return "\n" if close else "\n\n"


def side_text(side: Side, letters: Letters, *, ascii: bool = False) -> str:
    """One side of an equation, or mathematics in a sentence."""
    if isinstance(side, Written):
        return side.text
    if isinstance(side, Vector):
        parts = [_component(tree, direction, letters, ascii) for tree, direction in side.components if not is_zero(tree)]
        return " + ".join(parts).replace("+ −", "− ").replace("+ -", "- ") or "0"
    return text(side, letters, ascii=ascii)


def _tied(math: str) -> str:
    """Mathematics in a sentence, to be broken at plus and minus signs only."""
    return re.sub(rf" (?![+−-]{_TIE})", _TIE, re.sub(r"(?<= [+−-]) ", _TIE, math))


def _component(tree: Tree, direction: str, letters: Letters, ascii: bool) -> str:
    inner = text(tree, letters, ascii=ascii)
    if isinstance(tree, Add):
        return f"({inner}) {direction}"
    return direction if inner == "1" else f"{inner[0]}{direction}" if inner in ("−1", "-1") else f"{inner} {direction}"


@dataclass(frozen=True)
class _Writer:
    letters: Letters
    ascii: bool
    width: int

    def block(self, block: Block) -> str:
        match block:
            case Heading(words, level):
                title = self.words(words)
                return f"{title}\n{('=' if level == 1 else '-') * columns(title)}" if level < 3 else title
            case Paragraph(words):
                return self.filled(words)
            case Equation():
                return self.stated(block, self.equation(block))
            case MatrixEquation():
                return self.stated(block, self.matrices(block))
            case MatrixOf(letter, matrix):
                return textwrap.indent(self.matrix(letter, matrix), _INDENT)
            case Bullets(items):
                return "\n".join(self.filled(item, "- ") for item in items)
            case Table():
                return self.table(block)
            case Figure():
                return ""

    def words(self, words: Words) -> str:
        return "".join(
            piece if isinstance(piece, str) else side_text(piece, self.letters, ascii=self.ascii) for piece in pieces(words)
        )

    def filled(self, words: Words, lead: str = "") -> str:
        whole = "".join(
            _tied(side_text(p, self.letters, ascii=self.ascii)) if not isinstance(p, str) else p for p in pieces(words)
        )
        indent = " " * len(lead)
        filled = textwrap.fill(
            whole, self.width, initial_indent=lead, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False
        )
        return filled.replace(_TIE, " ")

    def stated(self, block: Equation | MatrixEquation, body: str) -> str:
        lines = textwrap.indent(body, _INDENT).split("\n")
        if block.label:
            lines[-1] += " " * max(2, self.width - columns(lines[-1]) - len(block.label) - 2) + f"({block.label})"
        name = self.words(block.name)
        above = [self.filled(name if name.endswith((":", ".")) else f"{name}:")] if name else []
        return "\n".join([*above, *lines, *([self.filled(block.note)] if block.note else [])])

    def equation(self, block: Equation) -> str:
        room = self.width - len(_INDENT) - (len(block.label) + 4 if block.label else 0)
        left, right = block.left, block.right
        if is_tree(left) and is_tree(right):
            return equation_text(left, right, self.letters, ascii=self.ascii, width=room)
        left, right = (side_text(side, self.letters, ascii=self.ascii) for side in (left, right))
        return folded(f"{left} = ", right, room)

    def matrices(self, block: MatrixEquation) -> str:
        shown = [[text(entry, self.letters, ascii=self.ascii) for entry in row] for row in block.matrix]
        unknowns, right = (
            [[text(entry, self.letters, ascii=self.ascii)] for entry in side] for side in (block.unknowns, block.right)
        )
        height = max(len(shown), len(unknowns))
        parts = [_padded(self.bracketed(part), height) for part in (shown, unknowns, right)]
        middle = (height - 1) // 2
        lines = [f"{a} {x} {'=' if row == middle else ' '} {b}" for row, (a, x, b) in enumerate(zip(*parts, strict=True))]
        if all(columns(line) <= self.width - len(_INDENT) - 8 for line in lines):
            return "\n".join(lines)
        return self.listed(block)

    def matrix(self, letter: Written, matrix: Sequence[Sequence[Tree]]) -> str:
        """Letter = matrix; what is too wide for brackets entry by entry."""
        rows = [[text(entry, self.letters, ascii=self.ascii) for entry in row] for row in matrix]
        lines, middle = self.bracketed(rows), (len(rows) - 1) // 2
        lead = [f"{letter.text} = " if i == middle else " " * (columns(letter.text) + 3) for i in range(len(rows))]
        if columns(lead[0] + lines[0]) <= self.width - len(_INDENT):
            return "\n".join(map(str.__add__, lead, lines))
        entries = [(i, j, entry) for i, row in enumerate(rows, 1) for j, entry in enumerate(row, 1) if entry != "0"]
        return "\n".join(
            folded(f"{self.indexed(letter.text, f'{i}{j}')} = ", entry, self.width - len(_INDENT)) for i, j, entry in entries
        )

    def bracketed(self, rows: Sequence[Sequence[str]]) -> list[str]:
        widths = [max(columns(row[column]) for row in rows) for column in range(len(rows[0]))]
        top, middle, bottom, single = _CORNERS[self.ascii]
        made = []
        for place, row in enumerate(rows):
            ends = single if len(rows) == 1 else top if place == 0 else bottom if place == len(rows) - 1 else middle
            cells = (_centred(cell, width) for cell, width in zip(row, widths, strict=True))
            made.append(f"{ends[0]} {'  '.join(cells)} {ends[1]}")
        return made

    def listed(self, block: MatrixEquation) -> str:
        """What is too wide for brackets: entry by entry if there are few, else row by row, as equations."""
        if len(block.unknowns) <= FEW:
            return self.entries(block)
        width = self.width - len(_INDENT) - 8
        return "\n".join(equation_text(*sides, self.letters, ascii=self.ascii, width=width) for sides in block.rows())

    def entries(self, block: MatrixEquation) -> str:
        """Every entry that is not 0, equal ones once, behind what they are entries of."""
        lines = [
            folded(
                f"{' = '.join(self.indexed(block.letter, f'{i}{j}') for i, j in places)} = ",
                text(entry, self.letters, ascii=self.ascii),
                self.width - len(_INDENT) - 8,
            )
            for entry, places in block.entries().items()
        ]
        for i, entry in enumerate(block.right, 1):
            name = self.indexed("b", str(i))
            lines.append(folded(f"{name} = ", text(entry, self.letters, ascii=self.ascii), self.width - len(_INDENT) - 8))
        unknowns = ", ".join(text(x, self.letters, ascii=self.ascii) for x in block.unknowns)
        return "\n".join([f"{block.letter} x = b with x = ({unknowns}); what is not told is 0", *lines])

    def indexed(self, letter: str, digits: str) -> str:
        """A letter with digits below."""
        return ascii_name(letter + digits) if self.ascii else unicode_name(letter + digits)

    def table(self, block: Table) -> str:
        rows = [[self.words(cell) for cell in row] for row in (block.heads, *block.rows)]
        widths = [max(columns(row[column]) for row in rows) for column in range(len(block.heads))]
        lines = ["  ".join(_left(cell, width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
        lines.insert(1, "  ".join("-" * width for width in widths))
        return "\n".join(([self.words(block.caption)] if block.caption else []) + lines)


def _padded(lines: list[str], height: int) -> list[str]:
    """The lines in the middle of some more."""
    blank, spare = " " * columns(lines[0]), height - len(lines)
    return [blank] * (spare // 2) + lines + [blank] * (spare - spare // 2)


def _centred(cell: str, width: int) -> str:
    spare = width - columns(cell)
    return " " * (spare // 2) + cell + " " * (spare - spare // 2)


def _left(cell: str, width: int) -> str:
    return cell + " " * (width - columns(cell))
