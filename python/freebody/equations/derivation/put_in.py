"""What is closed put into balances, where that is shorter: ẍ by φ̈ of a rod in a corner, accelerations that a motion prescribes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

from freebody.document.blocks import Equation
from freebody.equations.derivation.balance_text import Stated
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.algebra import factored, opposite, pythagorean, quotient, spread
from freebody.symbolic.linear import linear_in
from freebody.symbolic.presentation import length
from freebody.symbolic.to_sympy import from_sympy, sympy, to_sympy
from freebody.symbolic.tree import (
    ONE,
    ZERO,
    Fn,
    Mul,
    Num,
    Pow,
    Sym,
    Tree,
    add,
    is_negative,
    is_zero,
    minus,
    mul,
    negative,
    number,
    operations,
    power,
    rebuilt,
    symbols,
)
from freebody.symbolic.tree import replace as put

_MOST = 200
"""Operations of an equation, and of what is closed, above which nothing is put in."""
_SHORT = 60
"""Printed signs of an acceleration up to which it is given by itself."""


@dataclass(frozen=True)
class Closed:
    """What is closed at a subject."""

    subject: SymbolicState

    @cached_property
    def follow(self) -> dict[Sym, Tree]:
        """Places, rates and accelerations that others give, where that takes no root and no division by what moves."""
        found: dict[Sym, Tree] = {}
        for dots, level in enumerate(("value", "rate", "acceleration")):
            rows = [row for row in self.subject.rows if row.kind != "motion" or dots == 2]
            for tree in (getattr(row, level) for row in rows):
                if tree is not None and (one := self._one(put(tree, found), dots)):
                    found = {x: put(known, dict([one])) for x, known in found.items()} | dict([one])
        return found

    def _one(self, tree: Tree, dots: int) -> tuple[Sym, Tree] | None:
        """The symbol with the plainest factor that depends on nothing that moves, in what vanishes, and what it is."""
        names, found = {*self.subject.names}, []
        for x in (x for x in symbols(tree) if x.dots == dots and x.name in names) if operations(tree) <= _MOST else ():
            try:
                linear = linear_in(tree, [x])
            except ValueError:
                continue
            factor = linear.coefficients[x]
            if not is_zero(factor) and not {y.name for y in symbols(factor)} & names:
                found.append((operations(factor), x.name, x, quotient(negative(linear.rest), factor)))
        return min(found)[2:] if found else None

    def put(self, tree: Tree) -> Tree:
        """An expression with these put in, where that makes it shorter."""
        if operations(tree) > _MOST or not symbols(tree) & self.follow.keys():
            return tree
        return min(tree, _plain(put(tree, self.follow)), key=lambda each: length(each)[0])

    def reduced(self, stated: Stated) -> tuple[Stated, list[Sym]]:
        """A balance with these put in, where its scalar equation is shorter so, and the accelerations that are."""
        given = symbols(*stated.sides)
        known = [x for x in self.follow if x.dots == 2 and x in given]
        if not known or sum(map(operations, stated.sides)) > _MOST:
            return stated, []
        made = replace(stated, balance=stated.balance.with_trees(lambda tree: _plain(put(tree, self.follow))), own=0)
        first, second = (sum(length(side)[0] for side in each.sides) for each in (stated, made))
        return (made, known) if second < first else (stated, [])

    def alone(self, left: Tree, right: Tree) -> tuple[Tree, Tree]:
        """Two sides; with a load alone on the left where it is the only unknown and no acceleration is."""
        kinds = self.subject.nomenclature.kind
        unknown = [x for x in symbols(left, right) if x.dots == 2 or kinds(x.name) == "unknown"]
        if len(unknown) != 1 or unknown[0].dots:
            return left, right
        linear = linear_in(minus(right, left), unknown)
        factor = linear.coefficients[unknown[0]]
        if not isinstance(factor, Num) or abs(factor.value) != 1:
            return left, right
        return unknown[0], opposite(linear.rest) if factor.value > 0 else linear.rest

    def result(self, equation: Equation) -> list[Equation]:
        """The acceleration, where it is the only unknown of an equation and short."""
        whole = minus(equation.left, equation.right)
        moving = [x for x in symbols(whole) if x.dots == 2]
        known = all(self.subject.nomenclature.kind(x.name) != "unknown" for x in symbols(whole))
        if len(moving) != 1 or not known or operations(whole) > _SHORT:
            return []
        try:
            linear = linear_in(whole, moving)
        except ValueError:
            return []
        found = quotient(negative(linear.rest), linear.coefficients[moving[0]])
        found = from_sympy(sympy.factor(sympy.together(to_sympy(found))))
        found = opposite(negative(found)) if is_negative(found) else found
        return [Equation(moving[0], found, "So")] if not is_zero(found) and length(found)[0] <= _SHORT else []


def _plain(tree: Tree) -> Tree:
    """Multiplied out, nothing that vanishes, double angles by single ones, sin² + cos² being 1, with what is common in front."""

    def single(part: Tree) -> Tree | None:
        match part:
            case Pow(base) | Fn("sin", (base,)) if is_zero(base):
                return ZERO
            case Fn("cos", (angle,)) if is_zero(angle):
                return ONE
            case Fn("sin", (Mul((Num(count), angle)),)) if count == 2:
                return mul(number(2), Fn("sin", (angle,)), Fn("cos", (angle,)))
            case Fn("cos", (Mul((Num(count), angle)),)) if count == 2:
                return add(power(Fn("cos", (angle,)), 2), negative(power(Fn("sin", (angle,)), 2)))
        return None

    return factored(spread(pythagorean(spread(rebuilt(tree, single)))))
