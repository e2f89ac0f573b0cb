"""Documents as plain text."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass

from freebody.equations.document import (
    Block, Bullets, Document, Equation, Figure, Heading, MatrixEquation, Paragraph, Side, Table, Vector, Words, Written, is_tree, pieces,
)  # fmt: skip
from freebody.equations.letters import Letters
from freebody.equations.text import columns, equation_text, folded, text
from freebody.equations.tree import Add, Mul, Tree, is_zero

_INDENT = "    "
_CORNERS = {False: ("⎡⎤", "⎢⎥", "⎣⎦", "[]"), True: ("[]", "[]", "[]", "[]")}


def render(document: Document, *, ascii: bool, width: int) -> str:
    """All blocks, an empty line between them."""
    writer = _Writer(document.letters, ascii, width)
    return "\n\n".join(filter(None, map(writer.block, document.blocks))) + "\n"


def side_text(side: Side, letters: Letters, *, ascii: bool = False) -> str:
    """One side of an equation, or mathematics in a sentence."""
    if isinstance(side, Written):
        return side.text
    if isinstance(side, Vector):
        parts = [_component(tree, direction, letters, ascii) for tree, direction in side.components if not is_zero(tree)]
        return " + ".join(parts).replace("+ −", "− ").replace("+ -", "- ") or "0"
    return text(side, letters, ascii=ascii)


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
            case Bullets(items):
                return "\n".join(self.filled(item, "- ") for item in items)
            case Table():
                return self.table(block)
            case Figure():
                return self.filled(["[Figure: ", *pieces(block.caption or block.name), "]"])

    def words(self, words: Words) -> str:
        return "".join(piece if isinstance(piece, str) else side_text(piece, self.letters, ascii=self.ascii) for piece in pieces(words))

    def filled(self, words: Words, lead: str = "") -> str:
        return textwrap.fill(
            self.words(words), self.width, initial_indent=lead, subsequent_indent=" " * len(lead), break_long_words=False
        )

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
        unknowns, right = ([[text(entry, self.letters, ascii=self.ascii)] for entry in side] for side in (block.unknowns, block.right))
        parts = [self.bracketed(part) for part in (shown, unknowns, right)]
        middle = (len(shown) - 1) // 2
        lines = [f"{a} {x} {'=' if row == middle else ' '} {b}" for row, (a, x, b) in enumerate(zip(*parts, strict=True))]
        if all(columns(line) <= self.width - len(_INDENT) - 8 for line in lines):
            return "\n".join(lines)
        return self.listed(block)

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
        """What is too wide for brackets: row by row, as equations."""
        lines = []
        for row, right in zip(block.matrix, block.right, strict=True):
            products = [Mul((entry, unknown)) for entry, unknown in zip(row, block.unknowns, strict=True) if not is_zero(entry)]
            left = Add(tuple(products)) if len(products) > 1 else products[0]
            lines.append(equation_text(left, right, self.letters, ascii=self.ascii, width=self.width - len(_INDENT) - 8))
        return "\n".join(lines)

    def table(self, block: Table) -> str:
        rows = [[self.words(cell) for cell in row] for row in (block.heads, *block.rows)]
        widths = [max(columns(row[column]) for row in rows) for column in range(len(block.heads))]
        lines = ["  ".join(_left(cell, width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
        lines.insert(1, "  ".join("-" * width for width in widths))
        return "\n".join(([self.words(block.caption)] if block.caption else []) + lines)


def _centred(cell: str, width: int) -> str:
    spare = width - columns(cell)
    return " " * (spare // 2) + cell + " " * (spare - spare // 2)


def _left(cell: str, width: int) -> str:
    return cell + " " * (width - columns(cell))
