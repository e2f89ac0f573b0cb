"""A derivation as a document: headings, sentences, equations, tables, figures; printed in several ways."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol, TypeAlias

from freebody.symbolic.letters import Letters
from freebody.symbolic.tree import Add, Fn, Mul, Num, Pow, Sym, Tree


@dataclass(frozen=True)
class Written:
    """Mathematics that is only written, not computed with: ``Written("ΣM/E", r"\\sum M_{/E}")``."""

    text: str
    latex: str


@dataclass(frozen=True)
class Vector:
    """A vector in named unit directions: pairs of a component and a direction, ``"i"``, ``"e_r"``."""

    components: tuple[tuple[Tree, str], ...]


@dataclass(frozen=True)
class Matrix:
    """Rows of trees; entries that are too long to stand in it have names of the ``letter``."""

    rows: Sequence[Sequence[Tree]]
    letter: str = ""


@dataclass(frozen=True)
class Matrices:
    """A product of matrices, or one."""

    factors: tuple[Matrix, ...]


Side: TypeAlias = Tree | Vector | Written | Matrices
"""One side of an equation."""
Words: TypeAlias = str | Sequence[str | Side]
"""A sentence; mathematics in it stands as trees: ``["The angle ", Sym("theta"), " is measured from x."]``."""


@dataclass(frozen=True)
class Heading:
    """A heading; level 1 is the title."""

    words: Words
    level: int = 2


@dataclass(frozen=True)
class Paragraph:
    """Plain sentences."""

    words: Words


@dataclass(frozen=True)
class Equation:
    """left = right, stated as what it is, ``AMB about the elbow for the forearm``; ``label`` is its number, ``note`` its reason."""

    left: Side
    right: Side
    name: Words = ""
    label: str = ""
    note: Words = ""


@dataclass(frozen=True)
class MatrixEquation:
    """A x = b: rows of trees, unknowns, right-hand side; ``letter`` is what a person calls the matrix."""

    matrix: Sequence[Sequence[Tree]]
    unknowns: Sequence[Tree]
    right: Sequence[Tree]
    name: Words = ""
    label: str = ""
    note: Words = ""
    letter: str = "A"


@dataclass(frozen=True)
class Table:
    """Rows of words under heads."""

    heads: Sequence[Words]
    rows: Sequence[Sequence[Words]]
    caption: Words = ""


@dataclass(frozen=True)
class Bullets:
    """A list of sentences."""

    items: Sequence[Words]


class Picture(Protocol):
    """Something drawn when it is asked for."""

    @property
    def description(self) -> str:
        """What is seen, in words."""

    def inline(self) -> str:
        """SVG for a page with others: its identifiers are its own."""

    def save(self, path: Path) -> Path:
        """Writes a file, .svg or .pdf."""


@dataclass(frozen=True)
class Figure:
    """A picture. It is inside of HTML; for Markdown and LaTeX it is a file, where there is none its words stand for it. Text and
    JSON have no pictures: the blocks about it tell the same."""

    picture: Picture
    caption: Words = ""
    name: str = "figure"


Block: TypeAlias = Heading | Paragraph | Equation | MatrixEquation | Table | Bullets | Figure


@dataclass(frozen=True)
class Document:
    """Blocks in order, and what the letters in them mean."""

    blocks: Sequence[Block]
    letters: Letters = field(default_factory=Letters)

    def text(self, *, ascii: bool = False, width: int = 100) -> str:
        """Plain text of at most ``width`` columns, as far as equations can be broken."""
        from freebody.document.rendering.plain import render

        return render(self, ascii=ascii, width=width)

    def markdown(self, beside: str = "") -> str:
        """Markdown with LaTeX between dollars. Figures are files whose names begin with ``beside``; words where that is empty."""
        from freebody.document.rendering.markup import Markdown

        return Markdown(self.letters, beside).render(self.blocks)

    def latex(self, beside: str = "") -> str:
        """A fragment of a LaTeX article; it needs amsmath, amssymb and graphicx. ``beside`` as in ``markdown``."""
        from freebody.document.rendering.markup import Latex

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
        from freebody.document.rendering.plain import words_text

        return next((words_text(block.words, self.letters) for block in self.blocks if isinstance(block, Heading)), "Equations")

    def _page(self, around: str) -> str:
        from freebody.document.rendering.markup import Html
        from freebody.document.templates import template

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
        from freebody.document.rendering.data import block

        made = {"letters": self.letters.write(), "blocks": [block(each, self.letters) for each in self.blocks]}
        return json.dumps(made, ensure_ascii=False, indent=1)

    def __str__(self) -> str:
        return self.text()

    def _repr_html_(self) -> str:
        return self._page("fragment.html")

    def _repr_latex_(self) -> str:
        return self.latex()

    def _repr_markdown_(self) -> str:
        return self.markdown()


def is_tree(side: Any) -> bool:
    """Whether something is an expression."""
    return isinstance(side, Num | Sym | Add | Mul | Pow | Fn)


def pieces(words: Words) -> list[str | Side]:
    """The words as a list of texts and mathematics."""
    return [words] if isinstance(words, str) else list(words)


def listed(sides: Iterable[Side]) -> list[str | Side]:
    """Mathematics in a sentence, commas between."""
    return [piece for i, side in enumerate(sides) for piece in ([", ", side] if i else [side])]


def letters_table(letters: Letters) -> Table:
    """What the letters mean, for the head of a derivation."""
    rows = [([Sym(letter.name)], letter.doc, letter.unit) for letter in letters.values()]
    return Table(("symbol", "what it is", "unit"), rows)
