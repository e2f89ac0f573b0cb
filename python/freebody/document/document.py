"""A derivation as a document, printed in several ways."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from freebody.document.blocks import Block, Equation, Figure, MatrixEquation, Paragraph, is_tree
from freebody.document.rendering import FORMATS
from freebody.document.rendering.html import page
from freebody.document.rendering.text import Text
from freebody.formats import write
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.to_sympy import sympy, to_sympy
from freebody.symbolic.tree import Tree


@dataclass(frozen=True)
class Document:
    """Blocks in order, and what the symbols in them mean."""

    blocks: Sequence[Block]
    letters: Nomenclature = field(default_factory=Nomenclature)

    def with_remark(self, words: str) -> Document:
        """The same with a sentence below the title, if there is one."""
        title, rest = self.blocks[:1], self.blocks[1:]
        return replace(self, blocks=[*title, Paragraph(words), *rest]) if words else self

    def printed(self, kind: str, beside: str = "") -> str:
        """In an output format, by the ending of its files; figures are files whose names begin with ``beside``, words where that is
        empty. Raises ``KeyError`` for a format that there is not, see ``FORMATS``."""
        return FORMATS[kind].render(self.blocks, self.letters, beside)

    def save(self, path: str | Path, kind: str = "") -> list[Path]:
        """Write a file by its ending or ``kind``, see ``printed``, and the figures beside it. Returns all that is written."""
        path = Path(path)
        form = FORMATS[kind or path.suffix.removeprefix(".")]
        write(path, self.printed(form.ending, path.stem))
        figures = [block for block in self.blocks if isinstance(block, Figure) and form.figures]
        return [path, *(each.picture.save(path.with_name(f"{path.stem}-{each.name}{form.figures}")) for each in figures)]

    def text(self, *, ascii: bool = False, width: int = 100) -> str:
        """Plain text of at most ``width`` columns, as far as equations can be broken."""
        return Text(self.letters, ascii=ascii, width=width).render(self.blocks)

    def markdown(self, beside: str = "") -> str:
        """Markdown with LaTeX between dollars. Figures are files whose names begin with ``beside``; words where that is empty."""
        return self.printed("md", beside)

    def latex(self, beside: str = "") -> str:
        """A fragment of a LaTeX article; it needs amsmath, amssymb and graphicx. ``beside`` as in ``markdown``."""
        return self.printed("tex", beside)

    def html(self) -> str:
        """A whole page, formulas as MathML, figures inside; it needs nothing from elsewhere."""
        return self.printed("html")

    def json(self) -> str:
        """Every block with its kind and fields, trees as JSON and printed, and the symbols."""
        return self.printed("json")

    def sympy(self, *, time: bool = True) -> list[Any]:
        """The equations as SymPy ``Eq``, those of matrices as ``Eq(A x, b)``; vectors and what is only written are left out.

        With ``time`` coordinates are functions of t, else plain symbols, as rates and accelerations are."""

        def matrix(rows: Sequence[Sequence[Tree]]) -> Any:
            return sympy.Matrix([[to_sympy(entry, self.letters, time=time) for entry in row] for row in rows])

        made = []
        for block in self.blocks:
            if isinstance(block, Equation) and is_tree(block.left) and is_tree(block.right):
                sides = (to_sympy(side, self.letters, time=time) for side in (block.left, block.right))
                made.append(sympy.Eq(*sides, evaluate=False))
            elif isinstance(block, MatrixEquation):
                x, b = matrix([[x] for x in block.unknowns]), matrix([[b] for b in block.right])
                made.append(sympy.Eq(sympy.MatMul(matrix(block.matrix), x, evaluate=False), b, evaluate=False))
        return made

    def __str__(self) -> str:
        return self.text()

    def _repr_html_(self) -> str:
        return page(self.blocks, self.letters, "fragment.html")

    def _repr_latex_(self) -> str:
        return self.latex()

    def _repr_markdown_(self) -> str:
        return self.markdown()
