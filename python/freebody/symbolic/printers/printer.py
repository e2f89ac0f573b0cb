"""Printing, as far as it is the same for text and LaTeX: signs, brackets, fractions, order."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from freebody.symbolic import layout
from freebody.symbolic.letters import Letters
from freebody.symbolic.tree import Add, Fn, Mul, Num, Pow, Sym, Tree


@dataclass(frozen=True)
class Term:
    """One term of a printed sum: its sign and what follows it."""

    negative: bool
    text: str


@dataclass(frozen=True)
class Printer(ABC):
    """Prints trees; the letters say in what order a person writes them."""

    letters: Letters = field(default_factory=Letters)
    minus = "−"
    """The sign of subtraction."""

    def expression(self, tree: Tree) -> str:
        """The tree as one line."""
        return self.join(self.terms(tree))

    def terms(self, tree: Tree) -> list[Term]:
        """The terms of the tree in the order of writing."""
        return [self._term(term) for term in layout.terms(tree, self.letters)]

    def join(self, terms: Sequence[Term]) -> str:
        """The terms as a sum: a leading plus is left out."""
        signs = [f" {self.minus} " if term.negative else " + " for term in terms]
        signs[0] = self.minus if terms[0].negative else ""
        return "".join(sign + term.text for sign, term in zip(signs, terms, strict=True))

    def _term(self, tree: Tree) -> Term:
        laid = layout.product(tree, self.letters)
        return Term(laid.negative, self._fraction(laid) if laid.below else self._product(laid))

    def _fraction(self, laid: layout.Product) -> str:
        above, below = (laid.size, 1)
        if isinstance(laid.size, Fraction):
            above, below = laid.size.numerator, laid.size.denominator
        bottom = self._factors(below, laid.below)
        if layout.stands_apart(laid, self.letters) and self.can_stand_apart(below, laid.below):
            return self.juxtapose([self.apart(self._factors(above, laid.head), bottom), *map(self._factor, laid.tail)])
        sole = laid.above[0] if len(laid.above) == 1 and above == 1 else None
        top = self.numerator(sole) if isinstance(sole, Add) else self._factors(above, laid.above)
        ends_bare = bool(laid.above) and layout.is_bare(laid.above[-1])
        return self.fraction(top, self._bottom(below, laid.below, bottom), ends_bare, below != 1 or len(laid.below) > 1)

    def _bottom(self, number: int, below: Sequence[Tree], printed: str) -> str:
        return self.numerator(below[0]) if number == 1 and len(below) == 1 and isinstance(below[0], Add) else printed

    def _factors(self, number: Fraction | float | int, factors: Sequence[Tree]) -> str:
        shown = [] if number == 1 and factors else [self.number(number)]
        return self.juxtapose([*shown, *map(self._factor, factors)])

    def _product(self, laid: layout.Product) -> str:
        if isinstance(laid.size, Fraction) and laid.size.denominator != 1:
            return self.rational(laid.size, laid.above)
        return self._factors(laid.size, laid.above)

    def _factor(self, tree: Tree) -> str:
        match tree:
            case Sym():
                return self.name(tree)
            case Pow(base, exponent):
                return self._power(base, exponent)
            case Fn():
                return self.function(tree, Fraction(1))
            case Add() | Mul():
                return self.bracket(self.expression(tree))
            case Num(value):
                return self.number(value) if value >= 0 else self.bracket(self.expression(tree))

    def arguments(self, tree: Fn) -> str:
        """What a function is of, without the brackets."""
        if layout.is_bare(tree) and isinstance(tree.args[0], Mul):
            count, letter = tree.args[0].factors
            return self._factor(count) + self._factor(letter)
        return ", ".join(map(self.expression, tree.args))

    def _power(self, base: Tree, exponent: Fraction) -> str:
        if exponent == Fraction(1, 2):
            return self.root(base)
        if isinstance(base, Fn) and exponent.denominator == 1 and exponent > 0:
            return self.function(base, exponent)
        if isinstance(base, Pow) or (isinstance(base, Num) and isinstance(base.value, Fraction) and base.value.denominator != 1):
            return self.raised(self.bracket(self.expression(base)), exponent)
        return self.raised(self._factor(base), exponent)

    @abstractmethod
    def name(self, letter: Sym) -> str:
        """A letter."""

    @abstractmethod
    def number(self, value: Fraction | float | int) -> str:
        """A number that is not negative."""

    @abstractmethod
    def rational(self, value: Fraction, factors: Sequence[Tree]) -> str:
        """A number that is not whole times factors."""

    @abstractmethod
    def juxtapose(self, factors: Sequence[str]) -> str:
        """Printed factors side by side."""

    @abstractmethod
    def bracket(self, inner: str) -> str:
        """Round brackets."""

    @abstractmethod
    def numerator(self, tree: Tree) -> str:
        """A sum that is all that stands above or below the line."""

    @abstractmethod
    def fraction(self, above: str, below: str, ends_bare: bool, several: bool) -> str:
        """A fraction; whether its upper part ends with sin θ, and whether its lower part has several factors."""

    @abstractmethod
    def can_stand_apart(self, number: int, below: Sequence[Tree]) -> bool:
        """Whether a fraction of parameters is readable before other factors."""

    @abstractmethod
    def apart(self, above: str, below: str) -> str:
        """A fraction that other factors follow."""

    @abstractmethod
    def raised(self, base: str, exponent: Fraction) -> str:
        """A power of something printed."""

    @abstractmethod
    def root(self, tree: Tree) -> str:
        """The square root."""

    @abstractmethod
    def function(self, tree: Fn, exponent: Fraction) -> str:
        """A function, raised to a whole power."""
