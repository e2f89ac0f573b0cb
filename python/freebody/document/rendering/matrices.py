"""Matrices on a line: an entry that is too long to stand in one has a name there, and the names are explained below."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TypeAlias

from freebody.document.blocks import (
    Block,
    Equation,
    Matrices,
    Matrix,
    MatrixEquation,
    Paragraph,
    Side,
    Words,
    Written,
    listed,
    pieces,
)
from freebody.symbolic.alphabet import columns
from freebody.symbolic.formula import EQUALS, joined
from freebody.symbolic.nomenclature import Nomenclature, SymbolEntry
from freebody.symbolic.printers.text import text
from freebody.symbolic.symbols import Name
from freebody.symbolic.tree import Sym, Tree, is_zero

_STEPS = (24, 12, 6, 3, 0)
"""Columns that an entry may take, tried one after another until the line is not too wide."""
_DIGITS = 9
"""Rows and columns beyond which names are numbered one after another, not by their places."""
Place: TypeAlias = tuple[int, ...]
_EDGES, _GAP = 4, 2
"""Columns for a pair of brackets, and between two columns."""


def fitted(block: Equation | MatrixEquation, nomenclature: Nomenclature, room: int) -> tuple[list[Block], Nomenclature]:
    """An equation of matrices as blocks in which none takes more than ``room`` columns, and the symbols with the new names.

    Where even names are too many the entries that are not 0 are listed, and nothing else."""
    left, right = _sides(block)
    whole = Equation(left, right, block.name, block.label, block.note)
    if _across(left, right, nomenclature) <= room:
        return [whole], nomenclature
    for longest in _STEPS:
        named = _Named(longest, nomenclature, {})
        sides = named.side(left), named.side(right)
        known = Nomenclature({**nomenclature, **named.entries})
        if _across(*sides, known) <= room:
            stated = [Equation(name, tree) for (_, tree), name in named.found.items()]
            return [replace(whole, left=sides[0], right=sides[1]), *stated], known
    return [Paragraph(_absent(whole)), *_entries(left), *_entries(right)], nomenclature


@dataclass(frozen=True)
class Named:
    """What names of entries mean so far in a document."""

    meanings: dict[Sym, Tree] = field(default_factory=dict)

    def news(self, blocks: Sequence[Block]) -> list[Block]:
        """The blocks without those that say again what a name means."""
        kept = []
        for block in blocks:
            names = isinstance(block, Equation) and isinstance(block.left, Sym) and not block.name
            if not names or self.meanings.get(block.left) != block.right:
                kept.append(block)
            if names:
                self.meanings[block.left] = block.right
        return kept


def has_matrices(block: Block) -> bool:
    """Whether a block is an equation of matrices."""
    return isinstance(block, MatrixEquation) or (isinstance(block, Equation) and isinstance(block.right, Matrices))


@dataclass
class _Named:
    """Names for the entries that are longer than so many columns; a symbol that is taken is doubled."""

    longest: int
    known: Nomenclature
    found: dict[tuple[str, Tree], Sym]

    @property
    def entries(self) -> dict[str, SymbolEntry]:
        parts = ((name.name, *name.name.split(".")) for name in self.found.values())
        return {name: SymbolEntry(name, "constant", written=Name(stem, ("".join(place),))) for name, stem, *place in parts}

    def side(self, side: Side) -> Side:
        return Matrices(tuple(map(self._matrix, side.factors))) if isinstance(side, Matrices) else side

    def _matrix(self, matrix: Matrix) -> Matrix:
        if not matrix.letter:
            return matrix
        letter = matrix.letter * (1 + any(re.fullmatch(rf"{matrix.letter}\d+", Name.parse(name).ascii()) for name in self.known))
        counted = max(len(matrix.rows), len(matrix.rows[0])) > _DIGITS
        return Matrix(
            [[self._entry(letter, () if counted else place, tree) for place, tree in row] for row in _placed(matrix)], letter
        )

    def _entry(self, letter: str, place: Place, tree: Tree) -> Tree:
        if is_zero(tree) or (self.longest and columns(text(tree, self.known)) <= self.longest):
            return tree
        place = place or (1 + sum(owner == letter for owner, _ in self.found),)
        return self.found.setdefault((letter, tree), Sym(".".join([letter, *map(str, place)])))


def _placed(matrix: Matrix) -> list[list[tuple[Place, Tree]]]:
    """Every entry behind its place, counted from 1; those of a column have one number."""
    single = all(len(row) == 1 for row in matrix.rows)
    return [[((i,) if single else (i, j), tree) for j, tree in enumerate(row, 1)] for i, row in enumerate(matrix.rows, 1)]


def _entries(side: Side) -> list[Equation]:
    """The entries that are not 0, equal ones together."""
    found: dict[Tree, list[Name]] = {}
    for matrix in side.factors if isinstance(side, Matrices) else ():
        for place, tree in (entry for row in _placed(matrix) for entry in row if matrix.letter and not is_zero(entry[1])):
            below = ("" if max(place) <= _DIGITS else ",").join(map(str, place))
            found.setdefault(tree, []).append(Name(matrix.letter, (below,)))
    return [
        Equation(Written(" = ".join(n.unicode() for n in each), joined((n.formula() for n in each), (EQUALS,))), tree)
        for tree, each in found.items()
    ]


def _sides(block: Equation | MatrixEquation) -> tuple[Side, Side]:
    if isinstance(block, Equation):
        return block.left, block.right
    factors = Matrix(block.matrix, block.letter), Matrix([[x] for x in block.unknowns])
    return Matrices(factors), Matrices((Matrix([[b] for b in block.right], "b"),))


def _across(left: Side, right: Side, nomenclature: Nomenclature) -> int:
    """Columns of the line; a single symbol stands on the left where there is no matrix."""
    across = 4
    for matrix in (matrix for side in (left, right) if isinstance(side, Matrices) for matrix in side.factors):
        shown = [[columns(text(tree, nomenclature)) for tree in row] for row in matrix.rows]
        across += sum(max(column) + _GAP for column in zip(*shown, strict=True)) - _GAP + _EDGES
    return across


def _absent(block: Equation) -> Words:
    """What stands in for a matrix that is too wide."""
    factors: Sequence[Matrix] = block.left.factors if isinstance(block.left, Matrices) else ()
    name = [*pieces(block.name), ": "] if block.name else []
    if not factors:
        return [*name, "entries that are not listed are 0."]
    unknowns = [row[0] for row in factors[1].rows]
    return [*name, f"{factors[0].letter} x = b with x = (", *listed(unknowns), "); entries that are not listed are 0."]
