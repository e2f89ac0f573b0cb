"""The order in which a person writes sums and products, and what of a product stands above and below the line."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction

from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.tree import Add, Fn, Mul, Num, Pow, Sym, Tree, power, symbols, walk

SIMPLE_FUNCTIONS = ("sin", "cos", "tan", "ln")
"""Functions that a person writes without brackets when what they are of is one symbol."""
_TENTHS = 10
"""The largest denominator with a 5 in it that stands as a fraction."""
_PARAMETERS, _COORDINATES, _FUNCTIONS, _RATES, _BARE = range(1, 6)


@dataclass(frozen=True)
class Product:
    """A product laid out: ± number × head × tail / below.

    ``head`` are the parameters, ``tail`` is what moves; the exponents below are positive. ``size`` is positive."""

    negative: bool
    size: Fraction | float
    head: tuple[Tree, ...]
    tail: tuple[Tree, ...]
    below: tuple[Tree, ...]

    @property
    def above(self) -> tuple[Tree, ...]:
        """Everything above the line but the number."""
        return self.head + self.tail


def is_bare(tree: Tree) -> bool:
    """Whether a function is written without brackets: sin θ, cos 2θ, sin²θ."""
    node = tree.base if isinstance(tree, Pow) else tree
    match node:
        case Fn(name, (Sym(),)):
            return name in SIMPLE_FUNCTIONS
        case Fn(name, (Mul((Num(count), Sym())),)):
            return name in SIMPLE_FUNCTIONS and count > 0 and float(count).is_integer()
    return False


def product(tree: Tree, nomenclature: Nomenclature) -> Product:
    """The tree as one product."""
    factors = _factors(tree)
    whole = math.prod((factor.value for factor in factors if isinstance(factor, Num)), start=Fraction(1))
    size, rest = abs(whole), [factor for factor in factors if not isinstance(factor, Num)]
    below = [power(f.base, -f.exponent) for f in rest if isinstance(f, Pow) and f.exponent < 0]
    above = _sorted((f for f in rest if not (isinstance(f, Pow) and f.exponent < 0)), nomenclature)
    head = tuple(factor for factor in above if _class(factor, nomenclature) == _PARAMETERS)
    # A fraction that nobody calculates with, 9/20000, stands as the decimal number that it is, beside decimal numbers also 3/5.
    least = 0 if nomenclature.decimals else _TENTHS
    odd = isinstance(size, Fraction) and size.denominator > least and size.denominator % 5 == 0
    size = float(size) if odd and Fraction(f"{float(size):.10g}") == size else size
    return Product(whole < 0, size, head, tuple(above[len(head) :]), tuple(_sorted(below, nomenclature)))


def stands_apart(laid: Product, nomenclature: Nomenclature) -> bool:
    """Whether the fraction is one of parameters and what moves is written behind it: (g/l) sin θ."""
    constant = all(_class(factor, nomenclature) == _PARAMETERS for factor in laid.below)
    moves = any(_class(factor, nomenclature) in (_FUNCTIONS, _BARE) for factor in laid.tail)
    return bool(laid.head) and constant and moves


def terms(tree: Tree, nomenclature: Nomenclature) -> list[Tree]:
    """The terms of a sum: accelerations first, then rates, then the rest, each in the order of the symbols;
    of a polynomial in an indeterminate its powers falling.

    One with a plus goes first, if there is any, but none before an acceleration."""
    found = sorted(tree.terms, key=lambda term: _term_rank(term, nomenclature)) if isinstance(tree, Add) else [tree]
    if product(found[0], nomenclature).negative:
        accelerates = _dots(found[0]) == 2
        rivals = (t for t in found if not accelerates or _dots(t) == 2)
        first = next((t for t in rivals if not product(t, nomenclature).negative), found[0])
        found.remove(first)
        found.insert(0, first)
    return found


def _factors(tree: Tree) -> list[Tree]:
    if isinstance(tree, Pow) and isinstance(tree.base, Mul) and tree.exponent.denominator == 1:
        return [power(inner, tree.exponent) for inner in tree.base.factors]
    return [inner for factor in tree.factors for inner in _factors(factor)] if isinstance(tree, Mul) else [tree]


def _sorted(factors: Iterable[Tree], nomenclature: Nomenclature) -> list[Tree]:
    def place(factor: Tree) -> tuple:
        found = [x for x in symbols(factor) if nomenclature.kind(x.name) == "indeterminate"] or symbols(factor)
        first = min(((symbol.dots, *nomenclature.rank(symbol)) for symbol in found), default=())
        return _class(factor, nomenclature), first, isinstance(factor, Add)

    return sorted(factors, key=place)


def _class(factor: Tree, nomenclature: Nomenclature) -> int:
    found = symbols(factor)
    if is_bare(factor):
        return _BARE
    if any(symbol.dots for symbol in found):
        return _RATES
    if any(isinstance(node, Fn) for node in walk(factor)):
        return _FUNCTIONS
    load = isinstance(factor, Sym) and nomenclature.kind(factor.name) == "unknown"
    fixed = all(nomenclature.kind(symbol.name) in ("parameter", "constant") for symbol in found)
    return _PARAMETERS if fixed or load else _COORDINATES


def _term_rank(term: Tree, nomenclature: Nomenclature) -> tuple:
    found, dots = symbols(term), _dots(term)
    powers = (f if isinstance(f, Pow) else Pow(f, Fraction(1)) for f in _factors(term))
    degree = sum(f.exponent for f in powers if isinstance(f.base, Sym) and nomenclature.kind(f.base.name) == "indeterminate")
    moves = any(nomenclature.kind(symbol.name) not in ("parameter", "constant") for symbol in found)
    leading = sorted(nomenclature.place(symbol.name) for symbol in found if symbol.dots == dots)
    rest = sorted(nomenclature.place(symbol.name) for symbol in found if symbol.dots != dots)
    return -degree, -dots, dots == 0 and moves, leading, rest


def _dots(term: Tree) -> int:
    return max((symbol.dots for symbol in symbols(term)), default=0)
