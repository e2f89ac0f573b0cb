"""Equations together: what is unknown in them, and the matrix form A x = b."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from freebody.equations.linear import Linear
from freebody.symbolic.tree import ZERO, Sym, Tree, add, mul, negative


@dataclass(frozen=True)
class System:
    """A x = b: ``matrix`` (rows), ``unknowns`` x, ``right`` b; accelerations come before loads among the unknowns."""

    matrix: tuple[tuple[Tree, ...], ...]
    unknowns: tuple[Sym, ...]
    right: tuple[Tree, ...]

    @classmethod
    def of(cls, equations: Sequence[Linear], order: Sequence[str] = ()) -> System:
        """The system of expressions that vanish; unknowns in the ``order`` of names."""
        ranks = {name: place for place, name in enumerate(order)}
        found = {letter for equation in equations for letter in equation.coefficients}
        unknowns = sorted(found, key=lambda letter: (letter.dots == 0, ranks.get(letter.name, len(ranks)), letter.name))
        matrix = tuple(tuple(equation.coefficients.get(letter, ZERO) for letter in unknowns) for equation in equations)
        return cls(matrix, tuple(unknowns), tuple(negative(equation.rest) for equation in equations))

    @property
    def residuals(self) -> tuple[Tree, ...]:
        """A x − b, equation by equation."""
        return tuple(
            add(*(mul(entry, letter) for entry, letter in zip(row, self.unknowns, strict=True)), negative(right))
            for row, right in zip(self.matrix, self.right, strict=True)
        )

    @property
    def is_square(self) -> bool:
        """Whether there are as many equations as unknowns."""
        return len(self.matrix) == len(self.unknowns)
