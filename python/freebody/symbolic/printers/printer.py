"""Printing, as far as it is the same on one line and set in type: signs, brackets, fractions, order."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import ClassVar, Generic, TypeAlias, TypeVar

from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.printers import layout
from freebody.symbolic.symbols import Name
from freebody.symbolic.tree import Add, Fn, Mul, Num, Pow, Sym, Tree, is_zero

Made = TypeVar("Made", bound=Sequence)


@dataclass(frozen=True)
class Cross:
    """The product arm × vector, each by its components."""

    arm: Components
    vector: Components


Components: TypeAlias = "Sequence[tuple[Tree, str | Name | Cross]]"
"""Components with their directions: a unit direction ``"e_r"``, a vector by its name, or a product of vectors."""


@dataclass(frozen=True)
class Printer(ABC, Generic[Made]):
    """Walks over trees and makes of them a text, or a formula; the symbols say in what order a person writes them."""

    nomenclature: Nomenclature = field(default_factory=Nomenclature)
    plus: ClassVar[Sequence]
    minus: ClassVar[Sequence]
    negative: ClassVar[Sequence]
    comma: ClassVar[Sequence]
    cross: ClassVar[Sequence]
    """The signs between terms, in front of the first, between arguments, and between vectors."""
    linear: ClassVar[bool] = True
    """Whether fractions stand on one line, where brackets tell what is above and below."""

    def expression(self, tree: Tree) -> Made:
        """The tree as one line."""
        return self._sum([self._term(term) for term in layout.terms(tree, self.nomenclature)])

    def vector(self, components: Components) -> Made:
        """A vector by its components along unit directions, or as a sum of other vectors."""
        terms = []
        for tree, unit in ((tree, self._along(name)) for tree, name in components if not is_zero(tree)):
            negative, shown = (False, self.expression(tree)) if isinstance(tree, Add) else self._term(tree)
            shown = self.bracket(shown) if isinstance(tree, Add) or self.ends_below(shown) else shown
            terms.append((negative, unit if shown == self.number(1) else self.juxtapose([shown, unit])))
        return self._sum(terms) if terms else self.number(0)

    def _along(self, name: str | Name | Cross) -> Made:
        if not isinstance(name, Cross):
            return self.direction(name)
        arm, vector = (self._operand(part) for part in (name.arm, name.vector))
        return arm + self.cross + vector

    def _operand(self, components: Components) -> Made:
        """A vector beside ×: a sum, and what has a minus sign, in brackets."""
        shown, first = self.vector(components), components[0][0]
        single = len(components) == 1 and (isinstance(first, Add) or not self._term(first)[0])
        return shown if single else self.bracket(shown)

    def _sum(self, terms: Sequence[tuple[bool, Made]]) -> Made:
        """Terms behind their signs, whether they are negative; a leading plus is left out."""
        (negative, made), *more = terms
        made = self.negative + made if negative else made
        for negative, shown in more:
            made += (self.minus if negative else self.plus) + shown
        return made

    def _term(self, tree: Tree) -> tuple[bool, Made]:
        laid = layout.product(tree, self.nomenclature)
        return laid.negative, self._fraction(laid) if laid.below else self.product(laid.size, laid.above)

    def _fraction(self, laid: layout.Product) -> Made:
        above, below = laid.size.as_integer_ratio() if isinstance(laid.size, Fraction) else (laid.size, 1)
        bottom, several = self._factors(below, laid.below), below != 1 or len(laid.below) > 1
        sums = not several and isinstance(laid.below[0], Add)
        if layout.stands_apart(laid, self.nomenclature) and not (self.linear and (several or sums)):
            parameters = self.fraction(self._factors(above, laid.head), bottom, False, False)
            return self.juxtapose([self.bracket(parameters) if self.linear else parameters, *map(self._factor, laid.tail)])
        sole = laid.above[0] if len(laid.above) == 1 and above == 1 else None
        top = self._alone(sole) if isinstance(sole, Add) else self._factors(above, laid.above)
        ends_bare = bool(laid.above) and layout.is_bare(laid.above[-1])
        return self.fraction(top, self._alone(laid.below[0]) if sums else bottom, ends_bare, several)

    def _alone(self, tree: Tree) -> Made:
        """A sum that is all that stands above or below the line."""
        shown = self.expression(tree)
        return self.bracket(shown) if self.linear else shown

    def _factors(self, number: Fraction | float | int, factors: Sequence[Tree]) -> Made:
        shown = [] if number == 1 and factors else [self.number(number)]
        return self.juxtapose([*shown, *map(self._factor, factors)])

    def product(self, number: Fraction | float, factors: Sequence[Tree]) -> Made:
        """A number and the factors behind it, where nothing stands below a line."""
        return self._factors(number, factors)

    def _factor(self, tree: Tree) -> Made:
        match tree:
            case Sym():
                return self.name(tree)
            case Pow(base, exponent):
                return self._power(base, exponent)
            case Fn():
                return self._function(tree, Fraction(1))
            case Num(value) if value >= 0:
                return self.number(value)
        return self.bracket(self.expression(tree))

    def _function(self, tree: Fn, exponent: Fraction) -> Made:
        """A function, raised to a whole power, that may have been printed before."""
        known, key = self.nomenclature.functions, (type(self), tree, exponent)
        if key not in known:
            known[key] = self.function(tree, exponent)
        return known[key]

    def arguments(self, tree: Fn) -> Made:
        """What a function is of, without the brackets."""
        if layout.is_bare(tree) and isinstance(tree.args[0], Mul):
            count, symbol = tree.args[0].factors
            return self._factor(count) + self._factor(symbol)
        first, *more = map(self.expression, tree.args)
        for each in more:
            first += self.comma + each
        return first

    def _power(self, base: Tree, exponent: Fraction) -> Made:
        if exponent == Fraction(1, 2):
            return self.root(base)
        if isinstance(base, Fn) and exponent.denominator == 1 and exponent > 0:
            return self._function(base, exponent)
        if isinstance(base, Pow) or (isinstance(base, Num) and isinstance(base.value, Fraction) and base.value.denominator != 1):
            return self.raised(self.bracket(self.expression(base)), exponent)
        return self.raised(self._factor(base), exponent)

    @abstractmethod
    def name(self, symbol: Sym) -> Made:
        """A symbol."""

    @abstractmethod
    def direction(self, name: str | Name) -> Made:
        """A unit vector, or the name of another."""

    @abstractmethod
    def number(self, value: Fraction | float | int) -> Made:
        """A number that is not negative."""

    @abstractmethod
    def juxtapose(self, factors: Sequence[Made]) -> Made:
        """Printed factors side by side."""

    @abstractmethod
    def bracket(self, inner: Made) -> Made:
        """Round brackets."""

    @abstractmethod
    def fraction(self, above: Made, below: Made, ends_bare: bool, several: bool) -> Made:
        """A fraction; whether its upper part ends with sin θ, and whether its lower part has several factors."""

    def ends_below(self, shown: Made) -> bool:
        """Whether what comes behind something printed would be taken for a part of what is below its line."""
        return False

    @abstractmethod
    def raised(self, base: Made, exponent: Fraction) -> Made:
        """A power of something printed."""

    @abstractmethod
    def root(self, tree: Tree) -> Made:
        """The square root."""

    @abstractmethod
    def function(self, tree: Fn, exponent: Fraction) -> Made:
        """A function, raised to a whole power."""
