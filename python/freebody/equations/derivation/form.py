"""Equations before they are written down: titles and sides, what is unknown in them, and the matrix form A x = b."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from freebody.document.blocks import Block
from freebody.symbolic.linear import Linear
from freebody.symbolic.nomenclature import Nomenclature, SymbolEntry
from freebody.symbolic.tree import ZERO, Sym, Tree, minus, negative

if TYPE_CHECKING:
    from freebody.equations.derivation.balance_text import Stated


@dataclass(frozen=True)
class Printed:
    """One equation with its title; ``left`` = ``right``, ``residual`` vanishes, and as ``linear`` in what is unknown."""

    title: str
    left: Tree
    right: Tree
    linear: Linear

    @property
    def residual(self) -> Tree:
        """left − right."""
        return minus(self.left, self.right)


@dataclass(frozen=True)
class System:
    """A x = b: ``matrix`` (rows), ``unknowns`` x, ``right`` b; accelerations come before loads among the unknowns."""

    matrix: tuple[tuple[Tree, ...], ...]
    unknowns: tuple[Sym, ...]
    right: tuple[Tree, ...]

    @classmethod
    def of(cls, equations: Sequence[Linear], order: Sequence[str]) -> System:
        """The system of expressions that vanish; unknowns in the ``order`` of names."""
        ranks = {name: place for place, name in enumerate(order)}
        found = {symbol for equation in equations for symbol in equation.coefficients}
        unknowns = sorted(found, key=lambda symbol: (symbol.dots == 0, ranks.get(symbol.name, len(ranks)), symbol.name))
        matrix = tuple(tuple(equation.coefficients.get(symbol, ZERO) for symbol in unknowns) for equation in equations)
        return cls(matrix, tuple(unknowns), tuple(negative(equation.rest) for equation in equations))

    @property
    def is_square(self) -> bool:
        """Whether there are as many equations as unknowns."""
        return len(self.matrix) == len(self.unknowns)

    @property
    def gives_accelerations(self) -> bool:
        """Whether accelerations, and nothing else, are unknown, as many as there are equations."""
        return self.is_square and all(x.dots for x in self.unknowns)


@dataclass(frozen=True)
class Form:
    """The equations of a form, their matrix form, the blocks that derive them, and symbols that these have besides."""

    equations: tuple[Printed | Stated, ...]
    system: System
    blocks: tuple[Block, ...] = field(default=(), repr=False)
    symbols: Sequence[SymbolEntry] = ()

    @classmethod
    def of(cls, nomenclature: Nomenclature, equations: Sequence[Printed | Stated]) -> Form:
        """The form of some equations, with the unknowns in the order of the symbols."""
        return cls(tuple(equations), System.of([equation.linear for equation in equations], list(nomenclature)))

    @property
    def reactions(self) -> tuple[str, ...]:
        """The unknowns that are no accelerations."""
        return tuple(x.name for x in self.system.unknowns if not x.dots)
