"""Expressions set in type, for LaTeX, MathML and whatever else spells formulas."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from freebody.symbolic.formula import (
    GAP,
    MINUS,
    NEGATIVE,
    PLUS,
    THIN,
    TIMES,
    Atom,
    Formula,
    Grid,
    Root,
    Script,
    leading,
    rational,
    walk,
)
from freebody.symbolic.formula import Fraction as Stacked
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.printers import latex as spelled
from freebody.symbolic.printers import layout
from freebody.symbolic.printers.line_breaking import ROOM, equation
from freebody.symbolic.printers.printer import Printer
from freebody.symbolic.symbols import Name, direction, name_formula
from freebody.symbolic.tree import Entries, Fn, Sym, Tree

_FUNCTIONS = ("sin", "cos", "tan", "ln", "exp", "atan2", "sign")


def formula(tree: Tree, nomenclature: Nomenclature | None = None) -> Formula:
    """The expression set in type."""
    return Typesetter(nomenclature or Nomenclature()).expression(tree)


def latex(tree: Tree, nomenclature: Nomenclature | None = None) -> str:
    """The expression as LaTeX for mathematics mode, without dollars."""
    return spelled.latex(formula(tree, nomenclature))


def equation_latex(left: Tree, right: Tree, nomenclature: Nomenclature | None = None, *, room: float = ROOM) -> str:
    """``left = right`` for mathematics mode; what would print wider than ``room`` em is ``aligned`` over lines."""
    return spelled.aligned(equation(formula(left, nomenclature), formula(right, nomenclature), room))


def matrix(entries: Entries, nomenclature: Nomenclature | None = None) -> Grid:
    """A vector (as a column) or a matrix of trees, set in type."""
    rows = (row if isinstance(row, Sequence) else [row] for row in entries)
    return Grid(tuple(tuple(formula(tree, nomenclature) for tree in row) for row in rows))


@dataclass(frozen=True)
class Typesetter(Printer[Formula]):
    """Fractions are stacked, brackets grow with what is between them."""

    plus, minus, negative, comma = (GAP, PLUS), (GAP, MINUS), (NEGATIVE,), (Atom(",", "sign"), GAP)
    cross = (Atom("×", "sign"),)
    linear = False

    def name(self, symbol: Sym) -> Formula:
        written = self.nomenclature.written(symbol.name)
        if written:
            return written.formula(symbol.dots)
        return name_formula(symbol.name, symbol.dots, reaction=self.nomenclature.kind(symbol.name) == "unknown")

    def direction(self, name: str | Name) -> Formula:
        return direction(name) if isinstance(name, str) else name.formula(bold=True)

    def number(self, value: Fraction | float | int) -> Formula:
        if not isinstance(value, float):
            top, *bottom = (rational(Fraction(part)) for part in Fraction(value).as_integer_ratio())
            return top if bottom == [(Atom("1", "number"),)] else (Stacked(top, bottom[0], small=True),)
        if math.isinf(value):
            return (Atom("∞"),)
        mantissa, _, exponent = f"{value:.10g}".partition("e")
        made = (Atom(mantissa, "number"),)
        return (*made, TIMES, Script((Atom("10", "number"),), above=rational(Fraction(exponent)))) if exponent else made

    def juxtapose(self, factors: Sequence[Formula]) -> Formula:
        made = factors[0]
        for pair in itertools.pairwise(factors):
            kinds = [first.kind if (first := leading(side)) else "" for side in pair]
            made += (TIMES if kinds[1] == "number" else THIN if {"word", "bold"} & {*kinds} else GAP, *pair[1])
        return made

    def bracket(self, inner: Formula) -> Formula:
        grows = any(isinstance(part, Stacked) for part in walk(inner))
        return (Atom("(", "opening" if grows else "open"), *inner, Atom(")", "closing" if grows else "close"))

    def fraction(self, above: Formula, below: Formula, ends_bare: bool, several: bool) -> Formula:
        return (Stacked(above, below),)

    def raised(self, base: Formula, exponent: Fraction) -> Formula:
        last, above = base[-1], rational(exponent)
        if isinstance(last, Script) and not last.above:
            return (*base[:-1], Script(last.base, last.below, above))
        return (*base[:-1], Script((last,), above=above))

    def root(self, tree: Tree) -> Formula:
        return (Root(self.expression(tree)),)

    def function(self, tree: Fn, exponent: Fraction) -> Formula:
        inner = self.arguments(tree)
        if tree.name == "abs":
            made = (Atom("|", "opening"), *inner, Atom("|", "closing"))
            return made if exponent == 1 else self.raised(made, exponent)
        name: Formula = (Atom(tree.name, "function" if tree.name in _FUNCTIONS else "word"),)
        name = name if exponent == 1 else self.raised(name, exponent)
        return (*name, *(inner if layout.is_bare(tree) else self.bracket(inner)))
