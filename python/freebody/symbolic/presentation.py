"""How a person writes a sum: the one place that decides it.

What comes is a canonical sum of products from the core, or what SymPy has made. The steps, in their order:

1. *Measured numbers* end the search before it begins: round-off hides common factors, so the expression becomes one sum over another,
   the largest number below being 1.
2. *Multiplied out*, where it was put together from parts: only then like terms meet, and sin² + cos² become 1.
3. *The shortest of several equal forms*, of an answer: factored, cancelled, by sin² or cos², by trigonometry. What follows is one of the
   forms already, so the search has the last word.
4. *Unknowns with one factor each*, in a balance: that makes the matrix of the equations visible.
5. *Common factors in front*, squares of sums as such; after all that compares terms, since it hides them from each other.

The order of terms and factors, and what stands below a line, depends on nothing but what is written, and is found when it is printed
(``printers/layout.py``)."""

from __future__ import annotations

import itertools
import re
import time
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Any

from freebody.symbolic.algebra import equal, factored, grouped, pythagorean
from freebody.symbolic.decimals import is_measured, measured
from freebody.symbolic.factoring import factor
from freebody.symbolic.linear import linear_in
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.printers.text import text
from freebody.symbolic.to_sympy import from_sympy, sympy, to_sympy
from freebody.symbolic.tree import MINUS_ONE, Add, Fn, Mul, Node, Num, Sym, Tree, add, mul, symbols, walk

PATIENCE = 5.0
"""Seconds after which no further form of an answer is tried."""
_MULTIPLE_ANGLE = 6  # printed signs that a person would rather read than sin 2θ
_LARGE = 60  # operations above which SymPy's search for trigonometric identities takes too long
_FEW_TERMS = 4  # of a numerator that may be better taken apart: g/l + 2 k/m
_MOST_WAYS = 8  # of choosing sin² or cos² angle by angle


def presented(
    expression: Any,
    nomenclature: Nomenclature | None = None,
    *,
    multiplied_out: bool = False,
    unknowns: Sequence[Sym] | None = None,
    by_loads: bool = False,
    patience: float | None = None,
) -> Tree:
    """An expression, a tree or one of SymPy, as a person writes it; its value stays the same.

    ``multiplied_out``: it was put together from parts; ``unknowns`` have one factor each, where it is linear in them. With ``patience``
    the shortest form is searched for so many seconds, and each is held against the expression itself at random values; ``by_loads`` the
    factor of each product of masses and loads for itself."""
    if patience is not None:
        given = to_sympy(expression) if isinstance(expression, Node) else expression
        return (
            _by_loads(given, nomenclature or Nomenclature(), patience) if by_loads else _shortest(given, nomenclature, patience)
        )
    tree = pythagorean(from_sympy(to_sympy(expression).expand())) if multiplied_out else expression
    return factored(tree) if unknowns is None else _by_unknowns(tree, unknowns)


def _by_unknowns(tree: Tree, unknowns: Sequence[Sym]) -> Tree:
    """A sum that is linear in some symbols, with one factor for each of them and one for the rest; as it is if it is not linear."""
    terms = tree.terms if isinstance(tree, Add) else ()
    factors = [factor for term in terms for factor in (term.factors if isinstance(term, Mul) else (term,))]
    if not terms or any(symbols(factor) & {*unknowns} for factor in factors if not isinstance(factor, Sym)):
        return tree
    try:
        found = linear_in(tree, unknowns)
    except ValueError:
        return tree
    held = ((found.coefficients[x], x) for x in unknowns if x in found.coefficients)
    return add(*(mul(grouped(factor), x) for factor, x in held), factored(found.rest))


def _by_loads(expression: Any, nomenclature: Nomenclature, patience: float) -> Tree:
    """A sum by masses and loads."""
    light = nomenclature.geometric()
    heavy = {sympy.Symbol(name) for name in nomenclature.of_kind("parameter", "constant") if name not in light}
    parts: dict[Any, Any] = {}
    for term in sympy.Add.make_args(sympy.expand(expression)):
        key = sympy.Mul(*(factor for factor in sympy.Mul.make_args(term) if factor in heavy))
        parts[key] = parts.get(key, 0) + term / key
    return add(*(mul(from_sympy(key), _shortest(factor, nomenclature, patience)) for key, factor in parts.items()))


def _shortest(expression: Any, nomenclature: Nomenclature | None, patience: float) -> Tree:
    """The shortest of the forms; one with measured numbers is only multiplied out."""
    if is_measured(expression):
        return measured(expression)
    until = time.monotonic() + patience
    best = given = from_sympy(expression)
    cost = length(best, nomenclature)
    for form in _forms(expression, nomenclature):
        tree = from_sympy(form)
        if (found := length(tree, nomenclature)) < cost and equal(tree, given):
            best, cost = tree, found
        if time.monotonic() > until:
            break
    return best


def length(tree: Tree, nomenclature: Nomenclature | None = None) -> tuple[int, int]:
    """How long an expression reads: its printed signs, multiples of angles being dear, then its brackets."""
    shown = text(tree, nomenclature or Nomenclature())
    inside = [[part for part in walk(node.args[0]) if part != MINUS_ONE] for node in walk(tree) if isinstance(node, Fn)]
    multiples = sum(any(isinstance(part, Num) for part in parts) for parts in inside)
    return len(re.sub(r"[\s()\u0307\u0308]", "", shown)) + _MULTIPLE_ANGLE * multiples, shown.count("(")


def _forms(expression: Any, nomenclature: Nomenclature | None) -> Iterator[Any]:
    together = factor(expression)
    yield together
    ways = [[shown for way in _ways(part) for shown in _collected(way(part))] for part in sympy.fraction(together)]
    above, below = (
        min((form for form in forms if form != 0), key=lambda f: length(from_sympy(f), nomenclature), default=0) for forms in ways
    )
    if below != 0:
        yield above / below
    if len(sympy.Add.make_args(sympy.expand(above))) <= _FEW_TERMS:
        yield sympy.expand(together)
    if together.count_ops() < _LARGE:
        yield sympy.trigsimp(together)
        yield sympy.factor_terms(sympy.trigsimp(ways[0][0])) / sympy.factor_terms(sympy.trigsimp(ways[1][0]))
        yield factor(sympy.trigsimp(sympy.expand_trig(together)))


def _ways(part: Any) -> list[Callable[[Any], Any]]:
    """As it is; and for every angle that is in a square, all even powers of its cosine, or of its sine, replaced."""
    squares = {p.base for p in sympy.expand(part).atoms(sympy.Pow) if isinstance(p.base, sympy.sin | sympy.cos)}
    angles = sorted({function.args[0] for function in squares}, key=str)
    if not angles:
        return [lambda x: x]
    sides = itertools.product(((sympy.cos, sympy.sin), (sympy.sin, sympy.cos)), repeat=len(angles))
    rules = ([(gone(a), kept(a)) for (gone, kept), a in zip(side, angles, strict=True)] for side in sides)
    return [lambda x: x, *(partial(_without_squares, rules=each) for each in itertools.islice(rules, _MOST_WAYS))]


def _without_squares(part: Any, rules: list[tuple[Any, Any]]) -> Any:
    for gone, kept in rules:
        spread = sympy.expand(part)
        if not spread.is_polynomial(gone):  # it stands under a root
            continue
        polynomial = sympy.Poly(spread, gone)
        part = sum(c * (1 - kept**2) ** (n // 2) * gone ** (n % 2) for (n,), c in polynomial.terms())
    return factor(sympy.expand(part))


def _collected(part: Any) -> list[Any]:
    """As factors; and by what moves: m₁ g sin θ + m₂ g sin θ is (m₁ + m₂) g sin θ."""
    moving = [*part.atoms(sympy.sin, sympy.cos), *(symbol for symbol in part.free_symbols if symbol.name.endswith("'"))]
    spread = sympy.expand(part)
    order = sorted(moving, key=str)
    collected = sympy.collect(spread, order, lambda part: sympy.collect(part, order, factor))
    return [sympy.factor_terms(part), sympy.factor_terms(collected), sympy.factor_terms(spread)]
