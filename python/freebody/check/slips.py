"""The slips that people make: how unlikely an edit is as one, and why what stood there is wrong, in a sentence."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from freebody.symbolic.dimensions import ENERGY, FORCE, INERTIA, LENGTH, MASS
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Add, Mul, Negative, Node, Num, Pow, Quotient, Sym, is_zero, walk

from .edits import FIGURES, Edit
from .language.dimensions import dimension
from .language.statements import Equation, symbols_in, terms
from .vocabulary import Vocabulary

_RATIOS = (2.0, 4.0)
"""By which numbers are mistaken for each other: ½ forgotten or twice, an inertia of 1/12 for 1/3."""
_OF_BODIES = (1 / 12, 1 / 4, 1 / 3, 2 / 5, 2 / 3)
"""Factors of moments of inertia, any of which is taken for another."""
_ODD = 0.5
_NEW = 0.15  # for each coordinate of which the equation did not speak, twice that for a force
_PARTNER = 0.15  # by which a centripetal term is likelier beside its own second derivative
_SAME = 1e-9


def unlikely(
    edit: Edit, equation: Equation, vocabulary: Vocabulary, values: Mapping[str, Array], elsewhere: Mapping[str, Array]
) -> float:
    """By how much an edit is larger than its kind says; without bound where it would be no correction: a mass or an inertia below 0,
    another name of the same or of its opposite. ``values`` are those of true states, ``elsewhere`` of others."""
    if edit.new is None:  # what an equation is solved for does not go
        sides = [_bare(side) for side in (equation.left, equation.right)]
        return _ODD * (edit.kind == "extra term" and isinstance(edit.old, Sym) and edit.old in sides)
    if isinstance(edit.new, Negative) and dimension(edit.new, vocabulary.dimensions) in (MASS, INERTIA):
        return math.inf
    match edit.kind, edit.old, edit.new:
        case "factor", Node() as old, new:
            return _ODD * (not _is_mistaken(old, new, values))
        case "symbol", Sym() as old, Sym() as new if {old.key, new.key} <= values.keys():
            one, other = np.abs(values[old.key]), np.abs(values[new.key])
            same = one.shape == other.shape and np.allclose(one, other, rtol=_SAME, atol=0)
            turns = vocabulary.dimension(old) == INERTIA  # its moment about another point may have a letter of its own
            mixed = old in vocabulary.parameters and new not in vocabulary.parameters and not turns
            unsaid = new in vocabulary.others and new not in symbols_in(equation)
            return math.inf if same else _ODD * mixed + _NEW * unsaid
        case "symbol", _, Add() as new:
            unsaid = [n for n in symbols_in(new) if n not in symbols_in(equation)]
            return _NEW * sum(3 if vocabulary.is_rate(n) else 1 for n in unsaid)
        case "missing term" | "other term", _, new:
            found = {n.name for n in symbols_in(new)} - {n.name for n in symbols_in(equation)}
            forces = [n for n in vocabulary.parameters if vocabulary.dimension(n) in (FORCE, ENERGY)]
            strange = [n for n in (*vocabulary.coordinates, *vocabulary.others, *forces) if n.name in found]
            strange += [n for n in strange if vocabulary.dimension(n) in (FORCE, ENERGY)]
            below = edit.kind == "missing term" and any(symbols_in(n.bottom) for n in walk(new) if isinstance(n, Quotient))
            if below and (strange or not any(isinstance(n, Quotient) for n in walk(equation))):
                strange += [new] * (2 if strange else 1)
            strange += [n for n in walk(new) if isinstance(n, Add) and n not in {*walk(equation)}] * 2
            again = edit.kind == "missing term" and any(_is_multiple(new, term, elsewhere) for term in terms(equation))
            strange += [n for n in symbols_in(new) if n.dots == 2 and _is_solved(equation, n)] * 2
            return _NEW * len(strange) + _ODD * again - _PARTNER * _is_centripetal(new, equation)
    return 0.0


def _is_centripetal(term: Node, equation: Equation) -> bool:
    """Whether the square of a rate stands in it beside the same as the second derivative in the equation."""
    (squared, *others) = [n.base for n in walk(term) if isinstance(n, Pow) and isinstance(n.base, Sym) and n.base.dots == 1] or [
        None
    ]
    if squared is None or others:
        return False
    sizes = {n for n in symbols_in(term) if not n.dots}
    partners = (part for part in terms(equation, expand=True) if Sym(squared.name, 2) in symbols_in(part))
    return any(sizes <= {*symbols_in(part)} for part in partners)


def _is_solved(equation: Equation, other: Sym) -> bool:
    """Whether an equation says what one acceleration is, and nothing of another."""
    return any(
        isinstance(side, Sym) and side.dots == 2 and other != side for side in (equation.left, equation.right)
    ) and not any(n == other for n in symbols_in(equation))


def _bare(node: Node) -> Node:
    return node.of if isinstance(node, Negative) else node


def _is_multiple(one: Node, other: Node, values: Mapping[str, Array]) -> bool:
    """Whether a term is another times a number."""
    first, second = _number(one, values), _number(other, values)
    with np.errstate(all="ignore"):
        ratio = first / second
    return bool(np.isfinite(ratio).all() and np.ptp(ratio) <= _SAME * np.abs(ratio).max())


def _is_mistaken(old: Node, new: Node, values: Mapping[str, Array]) -> bool:
    """Whether a number is one that people take for another."""
    before, after = (float(_number(node, values)[0]) for node in (old, new))
    if before * after < 0:
        return False
    before, after = abs(before), abs(after)
    if isinstance(old, Num) and isinstance(new, Num) and before.is_integer() and after not in FIGURES:
        return False
    is_number = isinstance(old, Num | Quotient) and not symbols_in(old)
    ratio = max(after / before, before / after) if before and after else 0.0
    return bool(np.isclose(ratio, _RATIOS).any() or (is_number and np.isclose(before, _OF_BODIES).any()))


def _number(node: Node, values: Mapping[str, Array]) -> Array:
    """The values of a number; NaN of a vector, and where there is none."""
    found = (
        sampled(node, values) if {n.key for n in symbols_in(node)} <= values.keys() and not is_zero(node) else np.full(1, np.nan)
    )
    return found if found.ndim == 1 else np.full(1, np.nan)


def why(edit: Edit, equation: Equation, vocabulary: Vocabulary) -> str:
    """What is wrong with what stood there, in a sentence."""
    part = edit.new if edit.new is not None else edit.old
    if edit.kind in ("missing term", "extra term") and part is not None:
        verb = "is left out" if edit.kind == "missing term" else "has no place here, or is counted twice"
        return f"{_what(part, equation, vocabulary)} {verb}"
    if edit.kind == "symbol" and isinstance(edit.new, Sym) and edit.new.dots == 1:
        return "one rate stands for another: that of the body for the relative one, or the other way round"
    if edit.kind == "factor" and edit.old is not None and sum(n.dots == 1 for n in symbols_in(edit.old)) > 1:
        return "the Coriolis part of an acceleration is twice the product of the two rates"
    if edit.kind in ("factor", "sign", "symbol") and _is_constraint(equation, vocabulary):
        return "the constraint between these motions is another: count what moves along, and differentiate it term by term"
    if edit.kind == "factor" and _is_of_inertia(edit.old, equation, vocabulary):
        return "the moment of inertia is about another point: I about P is I_G + m d²"
    return _WHY.get(edit.kind, "")


_WHY = {
    "convention": "two things stand for each other throughout",
    "sign": "it acts, or counts, in the other sense",
    "function": "the component along the other direction is meant: sine and cosine are exchanged",
    "factor": "a number is wrong or forgotten: ½, 2, or one of an inertia or of a rotation that was left out",
    "ratio": "the ratio is upside down: what turns or moves faster has the smaller radius or arm",
    "ratio once": "the ratio counts twice: once for the motion and once for the force or moment, or squared with the rate",
    "symbol": "another quantity belongs here",
    "derivative": "the order of the derivative is another",
    "rates": "two rates are multiplied, or one is squared",
    "angle": "the angle is measured from elsewhere, or is that between others",
    "power": "the power is another: a centripetal term goes with the square of the rate, a moment of inertia with that of the distance",
    "missing factor": "a factor is forgotten: dimensions or an arm tell which",
    "extra factor": "a factor is one too many: dimensions tell which",
    "brackets": "what stands behind a fraction is not below it",
    "unit vector": "a vector and a number cannot be equal: a direction is missing",
    "other term": "this part is no balance of what acts and moves",
}


_OF_MOTION = ("a momentum, of a rotation or of another body,", "a kinetic energy, of a rotation or of another body,")


def _what(term: Node, equation: Equation, vocabulary: Vocabulary) -> str:
    """What a term is, in a balance or in an energy."""

    def order(symbol: Sym) -> int:
        """Of which derivative a symbol is, as its dimension says."""
        its = vocabulary.dimension(symbol)
        known = its is not None and its.mass == 0 and its.length in (0, 1) and symbol not in vocabulary.parameters
        return -its.time if known else symbol.dots if its is None else 0

    found = symbols_in(term)
    rates = [n for n in found if order(n) == 1]
    squared = any(isinstance(n, Pow) and n.exponent == Num(2.0, "2") and n.base in rates for n in walk(term))
    loads = (n for n in symbols_in(equation) if n not in vocabulary.parameters and vocabulary.dimension(n) in (FORCE, ENERGY))
    balance = any(loads) or any(order(n) == 2 for n in symbols_in(equation))
    its = dimension(term, vocabulary.dimensions)
    if its == LENGTH:
        return "a part of an arm"
    if its is not None and its.time == 0 and its.length in (0, 2):
        return "a part of the inertia, of what turns as well or m d² of a parallel axis,"
    if any(order(n) == 2 for n in found):
        return (
            "r × m a of a point that accelerates, or of what moves as well," if its == ENERGY else "a mass times its acceleration"
        )
    if rates and not balance:
        return _OF_MOTION[len(rates) > 1 or squared] if its is None or its.mass else "a part of the motion"
    if squared:
        return "the centripetal part of the acceleration"
    if len(rates) > 1:
        return "the Coriolis part of the acceleration"
    if any(n.name in ("g", "gravity") for n in found):
        return "a weight, or its moment or energy,"
    return "a force or a moment" if balance else "this part"


def _is_constraint(equation: Equation, vocabulary: Vocabulary) -> bool:
    """Whether an equation speaks of lengths and motions alone."""
    found = [vocabulary.dimension(n) for n in symbols_in(equation)]
    return all(its is not None and its.mass == 0 for its in found) and not any(
        n.name in ("g", "gravity") for n in symbols_in(equation)
    )


def _is_of_inertia(old: Node | None, equation: Equation, vocabulary: Vocabulary) -> bool:
    """Whether a number stands in a term with the second derivative of an angle."""
    products = (n for n in walk(equation) if isinstance(n, Mul | Quotient) and any(part is old for part in walk(n)))
    return any(n.dots == 2 and Sym(n.name) in vocabulary.angular for product in products for n in symbols_in(product))
