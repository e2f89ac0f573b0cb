"""A derivation as a document: headings, sentences, equations, tables, figures; printed in several ways."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeAlias

from freebody.document.drawings import Picture, drawn
from freebody.symbolic.formula import Formula
from freebody.symbolic.printers.printer import Components
from freebody.symbolic.symbols import Name
from freebody.symbolic.tree import Add, Fn, Mul, Num, Pow, Sym, Tree


@dataclass(frozen=True)
class Written:
    """Mathematics that is only written, not computed with: on a line of text, and set in type."""

    text: str
    formula: Formula

    @classmethod
    def of(cls, name: Name, *, bold: bool = False) -> Written:
        """A name; one of a vector is ``bold``."""
        return cls(name.unicode(), name.formula(bold=bold))


@dataclass(frozen=True)
class Vector:
    """A vector in named unit directions, ``"i"``, ``"e_r"``, or as a sum of others: pairs of a component and a direction."""

    components: Components


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
    """A list of sentences; ``data`` are the numbers in them for scripts, printed in JSON only."""

    items: Sequence[Words]
    data: Sequence[Mapping[str, float]] = ()


@dataclass(frozen=True)
class Figure:
    """A picture. It is inside of HTML; for Markdown and LaTeX it is a file, where there is none its words stand for it. Text and
    JSON have no pictures: the blocks about it tell the same."""

    drawing: Any
    caption: Words = ""
    name: str = "figure"

    @cached_property
    def picture(self) -> Picture:
        """The drawing, drawn."""
        return drawn(self.drawing)


Block: TypeAlias = Heading | Paragraph | Equation | MatrixEquation | Table | Bullets | Figure


def is_tree(side: Any) -> bool:
    """Whether something is an expression."""
    return isinstance(side, Num | Sym | Add | Mul | Pow | Fn)


def pieces(words: Words) -> list[str | Side]:
    """The words as a list of texts and mathematics."""
    return [words] if isinstance(words, str) else list(words)


def listed(sides: Iterable[Side], last: str = ", ", others: str = ", ") -> list[str | Side]:
    """Mathematics in a sentence, commas between, or something else before the ``last`` and the ``others``."""
    every = list(sides)
    between = [others] * (len(every) - 2) + [last]
    return [piece for i, side in enumerate(every) for piece in ([between[i - 1], side] if i else [side])]


def equations(pairs: Iterable[tuple[Side, Side]], name: Words = "") -> list[Block]:
    """Equations below each other, left = right, of which the first is named."""
    return [Equation(left, right, "" if i else name) for i, (left, right) in enumerate(pairs)]
