"""What a form of the equations is made of, before it is written down."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from freebody.document.blocks import Block
from freebody.equations.derivation.system import System
from freebody.equations.linear import Linear
from freebody.symbolic.letters import Letters
from freebody.symbolic.tree import Tree, minus


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
class Form:
    """The equations of a form, the blocks that derive them, and the matrix form."""

    equations: tuple[Printed, ...]
    blocks: tuple[Block, ...] = field(repr=False)
    system: System
    reactions: tuple[str, ...] = ()

    @classmethod
    def of(cls, letters: Letters, equations: Sequence[Printed], blocks: Sequence[Block]) -> Form:
        """The form of some equations, with the unknowns in the order of the letters."""
        system = System.of([equation.linear for equation in equations], list(letters))
        return cls(tuple(equations), tuple(blocks), system, tuple(x.name for x in system.unknowns if not x.dots))
