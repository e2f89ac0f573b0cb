"""Expressions of symbols and measured numbers: multiplied out, without round-off, and how they are shown."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

from freebody.symbolic.algebra import factored, quotient
from freebody.symbolic.to_sympy import from_sympy, sympy, to_sympy
from freebody.symbolic.tree import PI, ZERO, Num, Sym, Tree, add, mul, number, rebuilt

_RATIONAL = 1e-12
_DENOMINATORS = 1000
_ROUND_OFF = 1e-12
"""Coefficient over the largest below which a term is round-off."""
_FIGURES = 5
_PLAIN = 12
"""Denominators that a person reads as fractions."""
_MOST = 1000
"""The same of what is no decimal number."""


def is_measured(expression: Any) -> bool:
    """Whether a SymPy expression has numbers that are not exact."""
    return bool(expression.atoms(sympy.Float))


def measured(expression: Any) -> Tree:
    """One sum over another, the largest number below being 1."""
    return ratio(*sympy.fraction(sympy.cancel(rational(expression))))


def ratio(above: Any, below: Any) -> Tree:
    """One polynomial over another, both of SymPy, without the symbols that all terms of both have."""
    tops, bottoms = _terms(above), _terms(below)
    if not tops:
        return ZERO
    largest = max((c for c, _ in bottoms), key=abs)
    return quotient(_sum(tops, largest), _sum(bottoms, largest))


def rational(expression: Any) -> Any:
    """A SymPy expression in which numbers are the plain fractions, or the decimals, that they are as floats, so that algebra is exact."""
    found = sympy.N(expression, 17)
    return found.xreplace({x: _fraction(float(x)) for x in found.atoms(sympy.Float)})


def _fraction(value: float) -> Any:
    part = Fraction(value).limit_denominator(_DENOMINATORS)
    return sympy.Rational(part if abs(float(part) - value) <= math.ulp(value) else Fraction(repr(value)))


def _terms(expression: Any) -> list[tuple[float, Any]]:
    parts = [term.as_coeff_Mul() for term in sympy.Add.make_args(sympy.expand(expression))]
    found = [(float(c), rest) for c, rest in parts if c != 0]
    largest = max((abs(c) for c, _ in found), default=0.0)
    return [(c, rest) for c, rest in found if abs(c) > _ROUND_OFF * largest]


def _sum(terms: list[tuple[float, Any]], unit: float) -> Tree:
    """The sum; 2.3 m + 4.6 M is 2.3 (m + 2 M)."""
    first = terms[0][0]
    parts = [exact(c / first) for c, _ in terms]
    alike = all(isinstance(part.value, Fraction) and part.value.denominator <= _PLAIN for part in parts)
    sizes = parts if alike else [exact(c / unit) for c, _ in terms]
    made = factored(add(*(mul(size, _with_short_roots(rest)) for size, (_, rest) in zip(sizes, terms, strict=True))))
    return mul(exact(first / unit), made) if alike else made


def _with_short_roots(expression: Any) -> Tree:
    roots = (part for part in expression.atoms(sympy.Pow) if not part.exp.is_Integer and part.base.free_symbols)
    return from_sympy(expression.xreplace({root: to_sympy(measured(root.base)) ** root.exp for root in roots}))


def with_exact_numbers(tree: Tree) -> Tree:
    """An expression with its plain measured numbers as fractions."""
    return rebuilt(tree, lambda part: exact(part.value) if isinstance(part, Num) and isinstance(part.value, float) else None)


def exact_angle(value: float) -> Tree:
    """An angle as a part of π, where it is a plain one."""
    part = Fraction(value / math.pi).limit_denominator(12)
    return mul(number(part), Sym(PI)) if abs(float(part) * math.pi - value) < _RATIONAL else exact(value)


def exact(value: float) -> Tree:
    """A number as a fraction, where it is a plain one."""
    part = Fraction(value).limit_denominator(_DENOMINATORS)
    return number(part if abs(float(part) - value) <= _RATIONAL * max(1.0, abs(value)) else float(value))


def shown(tree: Tree) -> Tree:
    """With numbers to five figures, as they are printed."""
    return rebuilt(tree, lambda part: _in_figures(part.value) if isinstance(part, Num) else None)


def _in_figures(value: float | Fraction) -> Num:
    exact = isinstance(value, Fraction)
    ends = exact and 10**6 % value.denominator == 0  # as a decimal number
    plain = exact and (value.denominator <= _PLAIN or (value.denominator <= _MOST and not ends))
    return Num(value if plain else float(f"{float(value):.{_FIGURES}g}"))
