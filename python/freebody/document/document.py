"""A derivation as a document, printed in several ways."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from freebody.document.blocks import Block, Equation, Figure, Heading, MatrixEquation, is_tree
from freebody.document.rendering import data, plain
from freebody.document.rendering.markup import Html, Latex, Markdown
from freebody.document.templates import template
from freebody.symbolic.letters import Letters
from freebody.symbolic.tree import Tree


@dataclass(frozen=True)
class Document:
    """Blocks in order, and what the letters in them mean."""

    blocks: Sequence[Block]
    letters: Letters = field(default_factory=Letters)

    def text(self, *, ascii: bool = False, width: int = 100) -> str:
        """Plain text of at most ``width`` columns, as far as equations can be broken."""
        return plain.render(self.blocks, self.letters, ascii=ascii, width=width)

    def markdown(self, beside: str = "") -> str:
        """Markdown with LaTeX between dollars. Figures are files whose names begin with ``beside``; words where that is empty."""
        return Markdown(self.letters, beside).render(self.blocks)

    def latex(self, beside: str = "") -> str:
        """A fragment of a LaTeX article; it needs amsmath, amssymb and graphicx. ``beside`` as in ``markdown``."""
        return Latex(self.letters, beside).render(self.blocks)

    def printed(self, kind: str, beside: str = "") -> str:
        """By the ending of a file: txt, tex, md, html or json. Raises ``KeyError`` for any other."""
        ways: dict[str, Callable[[], str]] = {
            "txt": self.text, "tex": lambda: self.latex(beside), "md": lambda: self.markdown(beside), "html": self.html,
            "json": self.json,
        }  # fmt: skip
        return ways[kind]()

    def save(self, path: str | Path, kind: str = "") -> list[Path]:
        """Write a file by its ending or ``kind``, see ``printed``, and beside it the figures of Markdown (.svg) and LaTeX (.pdf).
        Returns all that is written."""
        path = Path(path)
        kind = kind or path.suffix.removeprefix(".")
        path.write_text(self.printed(kind, path.stem), encoding="utf-8")
        ending = {"md": ".svg", "tex": ".pdf"}.get(kind)
        figures = [block for block in self.blocks if isinstance(block, Figure) and ending]
        return [path, *(each.picture.save(path.with_name(f"{path.stem}-{each.name}{ending}")) for each in figures)]

    def html(self) -> str:
        """A whole page, formulas as MathML, figures inside; it needs nothing from elsewhere."""
        return self._page("page.html")

    @property
    def title(self) -> str:
        """The words of the first heading."""
        return next((plain.words_text(block.words, self.letters) for block in self.blocks if isinstance(block, Heading)), "Equations")

    def _page(self, around: str) -> str:
        body = Html(self.letters).render(self.blocks)
        return template("freebody.document.rendering", around).render(title=self.title, body=body)

    def sympy(self, *, time: bool = True) -> list[Any]:
        """The equations as SymPy ``Eq``, those of matrices as ``Eq(A x, b)``; vectors and what is only written are left out.

        With ``time`` coordinates are functions of t, else letters, rates and accelerations are symbols."""
        import sympy

        from freebody.symbolic.to_sympy import to_sympy

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

    def json(self) -> str:
        """Every block with its kind and fields, trees as JSON and printed, and the letters."""
        made = {"letters": self.letters.write(), "blocks": [data.block(each, self.letters) for each in self.blocks]}
        return json.dumps(made, ensure_ascii=False, indent=1)

    def __str__(self) -> str:
        return self.text()

    def _repr_html_(self) -> str:
        return self._page("fragment.html")

    def _repr_latex_(self) -> str:
        return self.latex()

    def _repr_markdown_(self) -> str:
        return self.markdown()
