"""Documents as plain text."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from freebody.document.blocks import (
    Block,
    Bullets,
    Equation,
    Figure,
    Heading,
    Matrices,
    MatrixEquation,
    Paragraph,
    Side,
    Table,
    Vector,
    Words,
    Written,
    is_tree,
    pieces,
)  # fmt: skip
from freebody.document.rendering.matrices import Named, fitted, has_matrices
from freebody.symbolic.letters import Letters
from freebody.symbolic.printers.text import columns, equation_text, folded, text
from freebody.symbolic.tree import Add, Tree, is_zero

_INDENT = "    "
_TIE = "\u00a0"
_CORNERS = {False: ("⎡⎤", "⎢⎥", "⎣⎦", "[]"), True: ("[]", "[]", "[]", "[]")}


def render(blocks: Sequence[Block], letters: Letters, *, ascii: bool, width: int) -> str:
    """All blocks, an empty line between them."""
    writer = _Writer(letters, ascii, width)
    made = [(block, writer.block(block)) for block in blocks]
    kept = [(block, shown) for block, shown in made if shown]
    spaces = ["" if place == 0 else _space(kept[place - 1][0], block) for place, (block, _) in enumerate(kept)]
    return "".join(space + shown for space, (_, shown) in zip(spaces, kept, strict=True)) + "\n"


def _space(above: Block, below: Block) -> str:
    """Equations without words between them stand together."""
    equations = isinstance(above, Equation) and isinstance(below, Equation) and not above.note and not below.name
    close = equations and not has_matrices(above) and not has_matrices(below)
    return "\n" if close else "\n\n"


def side_text(side: Side, letters: Letters, *, ascii: bool = False) -> str:
    """One side of an equation, or mathematics in a sentence."""
    if isinstance(side, Written):
        return side.text
    if isinstance(side, Vector):
        parts = [_component(tree, direction, letters, ascii) for tree, direction in side.components if not is_zero(tree)]
        return " + ".join(parts).replace("+ −", "− ").replace("+ -", "- ") or "0"
    return text(side, letters, ascii=ascii)


def words_text(words: Words, letters: Letters, *, ascii: bool = False) -> str:
    """A sentence on one line."""
    return "".join(piece if isinstance(piece, str) else side_text(piece, letters, ascii=ascii) for piece in pieces(words))


def _tied(math: str) -> str:
    """Mathematics in a sentence, to be broken at plus and minus signs only."""
    return re.sub(rf" (?![+−-]{_TIE})", _TIE, re.sub(r"(?<= [+−-]) ", _TIE, math))


def _component(tree: Tree, direction: str, letters: Letters, ascii: bool) -> str:
    inner = text(tree, letters, ascii=ascii)
    if isinstance(tree, Add) or re.search(r"/[^()]+$", inner):
        return f"({inner}) {direction}"
    return direction if inner == "1" else f"{inner[0]}{direction}" if inner in ("−1", "-1") else f"{inner} {direction}"


@dataclass(frozen=True)
class _Writer:
    letters: Letters
    ascii: bool
    width: int
    named: Named = field(default_factory=Named)

    def block(self, block: Block) -> str:
        match block:
            case Heading(words, level):
                title = self.words(words)
                return f"{title}\n{('=' if level == 1 else '-') * columns(title)}" if level < 3 else title
            case Paragraph(words):
                return self.filled(words)
            case Equation() | MatrixEquation() if has_matrices(block):
                return self.matrices(block)
            case Equation():
                return self.stated(block, self.equation(block))
            case Bullets(items):
                return "\n".join(self.filled(item, "- ") for item in items)
            case Table():
                return self.table(block)
            case Figure():
                return ""

    def words(self, words: Words) -> str:
        return words_text(words, self.letters, ascii=self.ascii)

    def filled(self, words: Words, lead: str = "") -> str:
        whole = "".join(
            _tied(side_text(p, self.letters, ascii=self.ascii)) if not isinstance(p, str) else p for p in pieces(words)
        )
        indent = " " * len(lead)
        filled = textwrap.fill(
            whole, self.width, initial_indent=lead, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False
        )
        return filled.replace(_TIE, " ")

    def stated(self, block: Equation, body: str) -> str:
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

    def matrices(self, block: Equation | MatrixEquation) -> str:
        """An equation of matrices, and below it the entries that have names."""
        made, letters = fitted(block, self.letters, self.width - len(_INDENT) - 8)
        writer = replace(self, letters=letters)
        return "\n".join(writer.spread(e) if has_matrices(e) else writer.block(e) for e in self.named.news(made))

    def spread(self, block: Equation) -> str:
        """Matrices side by side, over several lines."""
        parts = [self.grid(side) for side in (block.left, block.right)]
        height = max(map(len, parts))
        left, right = (_padded(part, height) for part in parts)
        middle = (height - 1) // 2
        lines = [f"{a} {'=' if row == middle else ' '} {b}" for row, (a, b) in enumerate(zip(left, right, strict=True))]
        return self.stated(block, "\n".join(lines))

    def grid(self, side: Side) -> list[str]:
        """The lines of a product of matrices, or of a letter."""
        if not isinstance(side, Matrices):
            return [side_text(side, self.letters, ascii=self.ascii)]
        parts = [
            self.bracketed([[text(tree, self.letters, ascii=self.ascii) for tree in row] for row in matrix.rows])
            for matrix in side.factors
        ]
        height = max(map(len, parts))
        return [" ".join(row) for row in zip(*(_padded(part, height) for part in parts), strict=True)]

    def bracketed(self, rows: Sequence[Sequence[str]]) -> list[str]:
        widths = [max(columns(row[column]) for row in rows) for column in range(len(rows[0]))]
        top, middle, bottom, single = _CORNERS[self.ascii]
        made = []
        for place, row in enumerate(rows):
            ends = single if len(rows) == 1 else top if place == 0 else bottom if place == len(rows) - 1 else middle
            cells = (_centred(cell, width) for cell, width in zip(row, widths, strict=True))
            made.append(f"{ends[0]} {'  '.join(cells)} {ends[1]}")
        return made

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
