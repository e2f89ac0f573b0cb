"""The equations of an impact, linear in what is unknown: rates after it, and impulses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from freebody.equations.solve import TooLarge
from freebody.equations.topics.impact_equations import Condition, Impact, after
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.linear import linear_in
from freebody.symbolic.tree import ZERO, Sym, Tree, is_zero, mul, operations

MOST_OPERATIONS = 300
"""In a system, or in an answer before it is shortened, above which none is sought symbolically."""

Row = tuple[list[Tree], Tree]


@dataclass(frozen=True)
class Rows:
    """What an impact asks, linear in what is unknown: the ``mass`` matrix and, of impulses, what they give to the balance of each
    coordinate (with what is given besides); then of each ``condition`` the factors of the rates, and the rest."""

    mass: list[list[Tree]]
    gives: list[Row]
    conditions: list[tuple[Condition, Row]]
    impulses: list[Sym]

    @classmethod
    def of(cls, found: Impact) -> Rows:
        """Those of an impact, without impulses that no coordinate feels, and without conditions that hold by themselves."""
        before = [Sym(name, 1) for name in found.subject.names]
        now, impulses = [Sym(after(x.name), 1) for x in before], list(found.impulses.values())
        balances = [each.balance for each in found.of_coordinates()]
        gives = [_row(found.acting(each), impulses) for each in balances]
        felt = [k for k in range(len(impulses)) if any(not is_zero(row[k]) for row, _ in gives)]
        asked = [(each, _row(each.rate, before)) for each in found.conditions()]
        return cls(
            [_row(found.jump(each), now)[0] for each in balances],
            [([row[k] for k in felt], rest) for row, rest in gives],
            [(each, row) for each, row in asked if not all(map(is_zero, row[0]))],
            [impulses[k] for k in felt],
        )

    def require_small(self) -> None:
        """Raises ``TooLarge`` where no answer symbolically is sought."""
        if len(self.impulses) != len(self.conditions):
            raise TooLarge(f"{len(self.conditions)} equations for {len(self.impulses)} unknowns: constraints are redundant")
        rows = [*self.mass, *(row for row, _ in self.gives), *(row for _, (row, _) in self.conditions)]
        require_brief([entry for row in rows for entry in row])

    def matrix(self, found: Impact) -> tuple[list[list[float]], list[float]]:
        """A and b of A (rates after, impulses) = b, in numbers."""
        n, m, values, tables = len(self.mass), len(self.impulses), found.values, found.subject.tables
        before = np.array([values[Sym(name, 1)] for name in found.subject.names])

        def number(tree: Tree) -> float:
            return float(evaluate(tree, values, tables))

        rows = (self.mass, [row for row, _ in self.gives], [row for _, (row, _) in self.conditions])
        shapes = zip(rows, (n, m, n), strict=True)
        mass, gives, held = (np.array([[number(x) for x in row] for row in of]).reshape(len(of), k) for of, k in shapes)
        rest = [number(rest) for _, rest in self.gives]
        back = [-number(mul(each.back, each.rate)) - number(rest) for each, (_, rest) in self.conditions]
        a = np.block([[mass, -gives], [held, np.zeros((len(held), m))]])
        return a.tolist(), [*(mass @ before + rest), *back]


def _row(tree: Tree, unknowns: Sequence[Sym]) -> Row:
    parts = linear_in(tree, unknowns)
    return [parts.coefficients.get(x, ZERO) for x in unknowns], parts.rest


def require_brief(trees: Sequence[Tree]) -> None:
    """Raises ``TooLarge``."""
    if (size := sum(map(operations, trees))) > MOST_OPERATIONS:
        raise TooLarge(f"what acts together has {size} operations, which is too long for a symbolic answer")
