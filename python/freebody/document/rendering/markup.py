"""What the formats for a reader have in common: the walk over blocks, sentences, equations with their names and notes."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

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
    pieces,
)
from freebody.document.rendering.matrices import Named, fitted, has_matrices
from freebody.document.templates import template
from freebody.symbolic.formula import GAP, Formula, joined
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.printers.line_breaking import ROOM, equation
from freebody.symbolic.printers.typeset import Typesetter, matrix


def side_formula(side: Side, nomenclature: Nomenclature) -> Formula:
    """One side of an equation, or mathematics in a sentence, set in type."""
    if isinstance(side, Written):
        return side.formula
    if isinstance(side, Matrices):
        return joined(((matrix(each.rows, nomenclature),) for each in side.factors), (GAP,))
    printer = Typesetter(nomenclature)
    return printer.vector(side.components) if isinstance(side, Vector) else printer.expression(side)


@dataclass(frozen=True)
class Markup(ABC):
    """A document being written. ``beside``: how the names of figures' files begin; empty where there are none."""

    nomenclature: Nomenclature
    beside: str = ""
    named: Named = field(default_factory=Named)
    kind: ClassVar[type[str]] = str
    """Of what is made: text, or text that knows that it is markup already."""
    look: ClassVar[str] = ""
    """The name of a template."""
    gap: ClassVar[str] = "\n\n"
    """Between an equation, its name and its note."""
    across: ClassVar[int] = 80
    """Columns of text that an equation of matrices may take."""

    def render(self, blocks: Sequence[Block]) -> str:
        """All blocks."""
        return self.kind("\n\n").join(map(self.block, blocks)) + "\n"

    def block(self, block: Block) -> str:
        """One block."""
        match block:
            case Heading(words, level):
                return self.heading(self.words(words), level)
            case Paragraph(words):
                return self.paragraph(self.words(words))
            case Equation() | MatrixEquation() if has_matrices(block):
                made, nomenclature = fitted(block, self.nomenclature, self.across)
                writer = replace(self, nomenclature=nomenclature)
                return self.kind(self.gap).join(map(writer.stated, self.named.news(made)))
            case Equation():
                return self.stated(block)
            case Bullets(items):
                return self.bullets([self.item(item) for item in items])
            case Table():
                rows = [[self.words(cell) for cell in row] for row in (block.heads, *block.rows)]
                return self.table(rows[0], rows[1:], self.words(block.caption))
            case Figure():
                return self.figure(block, self.words(block.caption))

    def stated(self, block: Block) -> str:
        """An equation between its name and its note; any other block as it is."""
        if not isinstance(block, Equation):
            return self.block(block)
        name, note = self.words(block.name), self.words(block.note)
        named = name if not name or name.endswith((":", ".")) else name + ":"
        parts = [self.paragraph(named) if named else "", self.equation(block), self.paragraph(note) if note else ""]
        return self.kind(self.gap).join(filter(None, parts))

    def words(self, words: Words) -> str:
        """A sentence with its mathematics."""
        return self.kind().join(self.plain(each) if isinstance(each, str) else self.math(each) for each in pieces(words))

    def item(self, words: Words) -> str:
        """A sentence of a list."""
        return self.words(words)

    @abstractmethod
    def math(self, side: Side) -> str:
        """Mathematics in a sentence."""

    @abstractmethod
    def equation(self, block: Equation) -> str:
        """An equation on lines of its own."""

    @abstractmethod
    def plain(self, text: str) -> str:
        """Text with the signs of the markup escaped."""

    @property
    def blocks(self) -> Any:
        """The macros of the template that says how headings, paragraphs, lists and tables look."""
        return template(__package__, self.look).module

    def heading(self, title: str, level: int) -> str:
        """A heading."""
        return self.blocks.heading(title, level)

    def paragraph(self, words: str) -> str:
        """A paragraph."""
        return self.blocks.paragraph(words)

    def bullets(self, items: Sequence[str]) -> str:
        """A list."""
        return self.blocks.bullets(items)

    def table(self, heads: Sequence[str], rows: Sequence[Sequence[str]], caption: str) -> str:
        """A table."""
        return self.blocks.table(heads, rows, caption)

    @abstractmethod
    def figure(self, figure: Figure, caption: str) -> str:
        """A picture."""


class TypesetMarkup(Markup):
    """A format that spells formulas."""

    room: ClassVar[float] = ROOM
    """Width of a line in em."""

    def math(self, side: Side) -> str:
        return self.inline(side_formula(side, self.nomenclature))

    def equation(self, block: Equation) -> str:
        left, right = (side_formula(side, self.nomenclature) for side in (block.left, block.right))
        return self.display(equation(left, right, math.inf if has_matrices(block) else self.room), block.label)

    @abstractmethod
    def inline(self, formula: Formula) -> str:
        """A formula in a sentence."""

    @abstractmethod
    def display(self, rows: Sequence[tuple[Formula, Formula]], label: str) -> str:
        """An equation on lines of its own, whose second parts stand below each other; one of matrices is not broken."""
