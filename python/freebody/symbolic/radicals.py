"""Roots in answers: √(w²/cos²α) is w/cos α, and √(x² + y²) is the length l of a string that is taut."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.factoring import factor
from freebody.symbolic.to_sympy import from_sympy, sympy, to_sympy
from freebody.symbolic.tree import Sym, Tree

_HALVES = 2


def distances(closed: Iterable[Tree]) -> dict[Any, Any]:
    """Of expressions that vanish, those of a root and something else, l − √(x² + y²): l by x² + y² multiplied out, both of SymPy."""
    found = {}
    for value in closed:
        expression = sympy.expand(to_sympy(value))
        roots = [node for node in expression.atoms(sympy.Pow) if node.exp == sympy.S.Half and node.base.is_Add]
        if len(roots) == 1 and (factor := expression.coeff(roots[0])).is_number and factor != 0:
            length = sympy.expand(roots[0] - expression / factor)
            found |= {sympy.expand(roots[0].base): length} if length.free_symbols else {}  # a number is the length at this start
    return found


def with_plain_roots(tree: Tree, known: Mapping[Any, Any], values: Mapping[Sym, float]) -> Tree:
    """An expression with ``known`` distances for powers of their squares, and squares taken out of roots in the sign that they
    have at some values."""
    expression = to_sympy(tree)
    powers = [node for node in expression.atoms(sympy.Pow) if (_HALVES * node.exp).is_Integer and node.base.is_Add]
    plain = {p: length ** (_HALVES * p.exp) for p in powers if (length := known.get(sympy.expand(p.base))) is not None}
    made = expression.xreplace(plain)
    roots = [node for node in made.atoms(sympy.Pow) if (_HALVES * node.exp).is_Integer and not node.exp.is_Integer]
    parts = {root: sympy.fraction(factor(sympy.trigsimp(sympy.together(root.base)))) for root in roots}
    bare = {root: _root(above, values) / _root(below, values) for root, (above, below) in parts.items()}
    made = made.xreplace({root: bare[root] ** (_HALVES * root.exp) for root in roots})
    return from_sympy(made) if plain or roots else tree


def _root(part: Any, values: Mapping[Sym, float]) -> Any:
    """The root of a product, without those of squares."""
    outside, inside = sympy.S.One, sympy.S.One
    for each in sympy.Mul.make_args(part):
        base, times = each.as_base_exp()
        sign = int(np.sign(evaluate(from_sympy(base), values))) if times == _HALVES else 0
        outside *= sign * base if sign else 1
        inside *= 1 if sign else each
    return outside * sympy.sqrt(inside)
