"""Matrices on a line: an entry that is too long to stand in one has a name there, and the names are told below."""

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
from freebody.symbolic.formula import EQUALS, joined
from freebody.symbolic.letters import Letter, Letters
from freebody.symbolic.printers.text import columns, text
from freebody.symbolic.symbols import Name
from freebody.symbolic.tree import Sym, Tree, is_zero

_STEPS = (24, 12, 6, 3, 0)
"""Columns that an entry may take, tried one after another until the line is not too wide."""
_DIGITS = 9
"""Rows and columns beyond which names are numbered one after another, not by their places."""
Place: TypeAlias = tuple[int, ...]
_EDGES, _GAP = 4, 2
"""Columns for a pair of brackets, and between two columns."""


def fitted(block: Equation | MatrixEquation, letters: Letters, room: int) -> tuple[list[Block], Letters]:
    """An equation of matrices as blocks in which none takes more than ``room`` columns, and the letters with the new names.

    Where even names are too many the entries that are not 0 are told, and nothing else."""
    left, right = _sides(block)
    whole = Equation(left, right, block.name, block.label, block.note)
    if _across(left, right, letters) <= room:
        return [whole], letters
    for longest in _STEPS:
        named = _Named(longest, letters, {})
        sides = named.side(left), named.side(right)
        known = Letters({**letters, **named.letters})
        if _across(*sides, known) <= room:
            stated = [Equation(letter, tree) for tree, letter in named.found.values()]
            return [replace(whole, left=sides[0], right=sides[1]), *stated], known
    return [Paragraph(_absent(whole)), *_entries(left), *_entries(right)], letters


@dataclass(frozen=True)
class Named:
    """What names of entries mean so far in a document."""

    meanings: dict[Sym, Tree] = field(default_factory=dict)

    def news(self, blocks: Sequence[Block]) -> list[Block]:
        """The blocks without those that say again what a name means."""
        return [block for block in blocks if not self._is_known(block)]

    def _is_known(self, block: Block) -> bool:
        if not isinstance(block, Equation) or not isinstance(block.left, Sym) or block.name:
            return False
        known = self.meanings.get(block.left) == block.right
        self.meanings[block.left] = block.right
        return known


def has_matrices(block: Block) -> bool:
    """Whether a block is an equation of matrices."""
    return isinstance(block, MatrixEquation) or (isinstance(block, Equation) and isinstance(block.right, Matrices))


@dataclass
class _Named:
    """Names for the entries that are longer than so many columns; a letter that is taken is doubled."""

    longest: int
    known: Letters
    found: dict[tuple[str, Tree], tuple[Tree, Sym]]

    @property
    def letters(self) -> dict[str, Letter]:
        return {letter.name: _letter(letter) for _, letter in self.found.values()}

    def side(self, side: Side) -> Side:
        return Matrices(tuple(map(self._matrix, side.factors))) if isinstance(side, Matrices) else side

    def _matrix(self, matrix: Matrix) -> Matrix:
        if not matrix.letter:
            return matrix
        letter = matrix.letter * (1 + any(re.fullmatch(rf"{matrix.letter}_?\d+", name) for name in self.known))
        places = [[self._entry(letter, place, tree, matrix) for place, tree in row] for row in _placed(matrix)]
        return Matrix(places, letter)

    def _entry(self, letter: str, place: Place, tree: Tree, matrix: Matrix) -> Tree:
        if is_zero(tree) or (self.longest and columns(text(tree, self.known)) <= self.longest):
            return tree
        if max(len(matrix.rows), len(matrix.rows[0])) > _DIGITS:
            place = (1 + sum(1 for owner, _ in self.found if owner == letter),)
        name = Sym(".".join([letter, *map(str, place)]))
        return self.found.setdefault((letter, tree), (tree, name))[1]


def _placed(matrix: Matrix) -> list[list[tuple[Place, Tree]]]:
    """Every entry behind its place, counted from 1; those of a column have one number."""
    single = all(len(row) == 1 for row in matrix.rows)
    return [[((i,) if single else (i, j), tree) for j, tree in enumerate(row, 1)] for i, row in enumerate(matrix.rows, 1)]


def _entries(side: Side) -> list[Equation]:
    """The entries that are not 0, equal ones together."""
    found: dict[Tree, list[Name]] = {}
    for matrix in side.factors if isinstance(side, Matrices) else ():
        for place, tree in (entry for row in _placed(matrix) for entry in row if matrix.letter):
            if not is_zero(tree):
                found.setdefault(tree, []).append(_name(matrix.letter, place))
    return [
        Equation(Written(" = ".join(n.unicode() for n in each), joined((n.formula() for n in each), (EQUALS,))), tree)
        for tree, each in found.items()
    ]


def _name(letter: str, place: Sequence[object]) -> Name:
    places = list(map(str, place))
    return Name(letter, ("".join(places) if all(len(each) == 1 for each in places) else ",".join(places),))


def _letter(symbol: Sym) -> Letter:
    stem, *places = symbol.name.split(".")
    return Letter(symbol.name, "constant", written=Name(stem, ("".join(places),)))


def _sides(block: Equation | MatrixEquation) -> tuple[Side, Side]:
    if isinstance(block, Equation):
        return block.left, block.right
    factors = Matrix(block.matrix, block.letter), Matrix([[x] for x in block.unknowns])
    return Matrices(factors), Matrices((Matrix([[b] for b in block.right], "b"),))


def _across(left: Side, right: Side, letters: Letters) -> int:
    """Columns of the line; a single letter stands on the left where there is no matrix."""
    return sum(_wide(matrix, letters) for side in (left, right) if isinstance(side, Matrices) for matrix in side.factors) + 4


def _wide(matrix: Matrix, letters: Letters) -> int:
    shown = [[columns(text(tree, letters)) for tree in row] for row in matrix.rows]
    return sum(max(column) + _GAP for column in zip(*shown, strict=True)) - _GAP + _EDGES


def _absent(block: Equation) -> Words:
    """What stands in for a matrix that is too wide."""
    factors: Sequence[Matrix] = block.left.factors if isinstance(block.left, Matrices) else ()
    name = [*pieces(block.name), ": "] if block.name else []
    if not factors:
        return [*name, "entries that are not told are 0."]
    unknowns = [row[0] for row in factors[1].rows]
    return [*name, f"{factors[0].letter} x = b with x = (", *listed(unknowns), "); entries that are not told are 0."]
