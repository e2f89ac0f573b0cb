"""The shortest of several equal forms of an answer, so that a person can read off what it depends on."""

from __future__ import annotations

import itertools
import random
import re
import time
from collections.abc import Callable, Iterator
from typing import Any

from freebody.symbolic.decimals import is_measured, measured
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.letters import Letters
from freebody.symbolic.printers.text import text
from freebody.symbolic.to_sympy import from_sympy
from freebody.symbolic.tree import MINUS_ONE, Fn, Num, Tree, symbols, walk

PATIENCE = 5.0
"""Seconds after which no further form of an answer is tried."""
_MULTIPLE_ANGLE = 6  # printed signs that a person would rather read than sin 2θ
_LARGE = 60  # operations above which SymPy's search for trigonometric identities takes too long
_FEW_TERMS = 4  # of a numerator that may be better taken apart: g/l + 2 k/m
_SAMPLES = 4
_MOST_WAYS = 8  # of choosing sin² or cos² angle by angle
_AGREEMENT = 1e-8  # relative difference of two forms that are equal


def shortest(expression: Any, letters: Letters | None = None, patience: float = PATIENCE) -> Tree:
    """The shortest of the forms factored, cancelled, with sin² or cos² eliminated, and simplified by trigonometry.

    Each is held against the expression itself at random values, and dropped where they differ. One with measured numbers is only
    multiplied out."""
    if is_measured(expression):
        return measured(expression)
    until = time.monotonic() + patience
    best = given = from_sympy(expression)
    cost = length(best, letters)
    for form in _forms(expression, letters):
        tree = from_sympy(form)
        if (found := length(tree, letters)) < cost and equal(tree, given):
            best, cost = tree, found
        if time.monotonic() > until:
            break
    return best


def length(tree: Tree, letters: Letters | None = None) -> tuple[int, int]:
    """How long an expression reads: its printed signs, multiples of angles being dear, then its brackets."""
    shown = text(tree, letters or Letters())
    multiples = sum(_has_multiple(node) for node in walk(tree))
    return len(re.sub(r"[\s()\u0307\u0308]", "", shown)) + _MULTIPLE_ANGLE * multiples, shown.count("(")


def _has_multiple(node: Tree) -> bool:
    return isinstance(node, Fn) and any(isinstance(below, Num) for below in walk(node.args[0]) if below != MINUS_ONE)


def equal(first: Tree, second: Tree) -> bool:
    """Whether two expressions agree at random values of their letters; places where one has no value are passed over."""
    draw = random.Random(7)
    letters = sorted(symbols(first, second), key=str)
    compared = 0
    for _ in range(4 * _SAMPLES):
        values = {letter: draw.uniform(0.3, 1.9) for letter in letters}
        a, b = (complex(_value(tree, values)) for tree in (first, second))
        if a == a and b == b:
            if abs(a - b) > _AGREEMENT * max(1.0, abs(a), abs(b)):
                return False
            compared += 1
        if compared == _SAMPLES:
            return True
    return compared > 0


def _value(tree: Tree, values: dict) -> float:
    import numpy as np

    with np.errstate(all="ignore"):
        try:
            return evaluate(tree, values)
        except (ZeroDivisionError, OverflowError):
            return float("nan")


def _forms(expression: Any, letters: Letters | None) -> Iterator[Any]:
    import sympy

    together = sympy.factor(sympy.cancel(sympy.together(expression)))
    yield together
    ways = [[shown for way in _ways(part) for shown in _collected(way(part))] for part in sympy.fraction(together)]
    above, below = (
        min((form for form in forms if form != 0), key=lambda f: length(from_sympy(f), letters), default=0) for forms in ways
    )
    if below != 0:
        yield above / below
    if len(sympy.Add.make_args(sympy.expand(above))) <= _FEW_TERMS:
        yield sympy.expand(together)
    if together.count_ops() < _LARGE:
        yield sympy.trigsimp(together)
        yield sympy.factor_terms(sympy.trigsimp(ways[0][0])) / sympy.factor_terms(sympy.trigsimp(ways[1][0]))
        yield sympy.factor(sympy.trigsimp(sympy.expand_trig(together)))


def _ways(part: Any) -> list[Callable[[Any], Any]]:
    """As it is; and for every angle that is in a square, all even powers of its cosine, or of its sine, replaced."""
    import sympy

    squares = {p.base for p in sympy.expand(part).atoms(sympy.Pow) if isinstance(p.base, sympy.sin | sympy.cos)}
    angles = sorted({function.args[0] for function in squares}, key=str)
    ways: list[Callable[[Any], Any]] = [lambda x: x]
    for kept in itertools.islice(itertools.product((sympy.sin, sympy.cos), repeat=len(angles)), _MOST_WAYS):
        if angles:
            rules = [(_other(kind)(angle), kind(angle)) for kind, angle in zip(kept, angles, strict=True)]
            ways.append(lambda x, rules=rules: _without_squares(x, rules))
    return ways


def _other(kind: Any) -> Any:
    import sympy

    return sympy.cos if kind is sympy.sin else sympy.sin


def _without_squares(part: Any, rules: list[tuple[Any, Any]]) -> Any:
    import sympy

    for gone, kept in rules:
        spread = sympy.expand(part)
        if not spread.is_polynomial(gone):  # it stands under a root
            continue
        polynomial = sympy.Poly(spread, gone)
        part = sum(c * (1 - kept**2) ** (n // 2) * gone ** (n % 2) for (n,), c in polynomial.terms())
    return sympy.factor(sympy.expand(part))


def _collected(part: Any) -> list[Any]:
    """As factors; and by what moves: m₁ g sin θ + m₂ g sin θ is (m₁ + m₂) g sin θ."""
    import sympy

    moving = [*part.atoms(sympy.sin, sympy.cos), *(letter for letter in part.free_symbols if letter.name.endswith("'"))]
    spread = sympy.expand(part)
    order = sorted(moving, key=str)
    collected = sympy.collect(spread, order, lambda factor: sympy.collect(factor, order, sympy.factor))
    return [sympy.factor_terms(part), sympy.factor_terms(collected), sympy.factor_terms(spread)]
