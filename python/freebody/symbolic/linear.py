"""Expressions that are linear in what is unknown."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from typing import Any

from freebody.symbolic.tree import ZERO, Add, Mul, Sym, Tree, add, mul, read, symbols


@dataclass(frozen=True)
class Linear:
    """An expression as Σ ``coefficients[x]`` x + ``rest`` of what is unknown."""

    coefficients: Mapping[Sym, Tree]
    rest: Tree

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> Linear:
        """From an answer."""
        return cls({read(each["symbol"]): read(each["tree"]) for each in data["coefficients"]}, read(data["rest"]))

    def with_trees(self, put: Callable[[Tree], Tree]) -> Linear:
        """The same, every expression as ``put``, which is linear, makes it."""
        return Linear({x: put(tree) for x, tree in self.coefficients.items()}, put(self.rest))


def linear_in(tree: Tree, unknowns: Collection[Sym]) -> Linear:
    """An expression that is linear in some symbols, by its coefficients; ``ValueError`` if it is not."""
    wanted = set(unknowns)
    if not symbols(tree) & wanted:
        return Linear({}, tree)
    if tree in wanted:
        return Linear({tree: mul()}, ZERO)
    if isinstance(tree, Add):
        parts = [linear_in(term, unknowns) for term in tree.terms]
        found = dict.fromkeys(x for part in parts for x in part.coefficients)
        sums = {x: add(*(part.coefficients[x] for part in parts if x in part.coefficients)) for x in found}
        return Linear(sums, add(*(part.rest for part in parts)))
    if isinstance(tree, Mul):
        holding = [factor for factor in tree.factors if symbols(factor) & wanted]
        if len(holding) == 1:
            inner, others = linear_in(holding[0], unknowns), [f for f in tree.factors if f is not holding[0]]
            return Linear({x: mul(*others, c) for x, c in inner.coefficients.items()}, mul(*others, inner.rest))
    raise ValueError(f"the expression is not linear in {', '.join(x.name for x in unknowns)}")
