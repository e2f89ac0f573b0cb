"""Numbers and products as a person writes them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TypeVar

from freebody.symbolic.tree import Add, Mul, Negative, Node, Num, Quotient, Sym, exchange, is_zero, walk

from .language.statements import without_ones

N = TypeVar("N", bound=Node)
_SAME = 1e-8  # relative: below it a number is the one recognised
_DENOMINATOR = 24
_NUMERATOR = 60


def recognised(value: float) -> Node | None:
    """A number as a person writes it: p/q with q ≤ 12, or such a part of π; None where it is neither."""
    for unit in (1.0, math.pi):
        part = Fraction(abs(value) / unit).limit_denominator(_DENOMINATOR)
        if not part or part.numerator > _NUMERATOR or abs(float(part) * unit / abs(value) - 1) >= _SAME:
            continue
        above, below = (Num(float(figure), str(figure)) for figure in part.as_integer_ratio())
        pi = Num(math.pi, "pi")
        top: Node = above if unit == 1.0 else pi if part.numerator == 1 else Mul((above, pi))
        found = top if part.denominator == 1 else Quotient(top, below)
        return Negative(found) if value < 0 else found
    return None


def snapped(value: float, near: float) -> float:
    """The fraction of small figures that is as ``near`` to a number, relative to it; the number itself where none is."""
    part = float(Fraction(value).limit_denominator(_DENOMINATOR))
    return part if abs(part - value) <= near * abs(value) else value


def multiplied(node: Node, value: float) -> Node | None:
    """A term times a number; None where that is no number that a person writes."""
    if isinstance(node, Negative):
        return multiplied(node.of, -value)
    match node:
        case Mul((Num(own), *rest)) if recognised(own * value) is not None:
            return multiplied(product(rest), own * value)
        case Quotient(top, Num(below)) if recognised(value / below) is not None:
            return multiplied(top, value / below)
        case Mul((Quotient(Num(above), Num(below)), *rest)) if recognised(above / below * value) is not None:
            return multiplied(product(rest), above / below * value)
    number = recognised(abs(value))
    if number is None:
        return None
    if isinstance(number, Quotient) and number.top == Num(1.0):
        found: Node = Quotient(node, number.bottom, span=node.span)
    else:
        found = (
            node if number == Num(1.0) else Mul((number, *(node.factors if isinstance(node, Mul) else (node,))), span=node.span)
        )
    return Negative(found) if value < 0 else found


def powered(node: Node, number: float, powers: Mapping[Sym, int]) -> Node | None:
    """A term times a number and powers of symbols; factors that it has itself are taken off first."""
    own, below = list(node.factors) if isinstance(node, Mul) else [node], []
    for symbol, power in powers.items():
        own += [symbol] * power
        for _ in range(-power):
            if symbol in own:
                own.remove(symbol)
            else:
                below.append(symbol)
    return multiplied(Quotient(product(own), product(below)) if below else product(own), number)


def product(factors: Sequence[Node]) -> Node:
    """A product, of one factor or none, too."""
    return Mul(tuple(factors)) if len(factors) > 1 else factors[0] if factors else Num(1.0, "1")


def more(node: Node, *terms: Node) -> Node:
    """A sum with more terms."""
    return Add((*(node.terms if isinstance(node, Add) else (node,)), *terms), span=node.span)


def tidied(node: N) -> N:
    """The same without factors and denominators 1, and without 0 in sums."""
    node = without_ones(node)
    has_zero = lambda n: isinstance(n, Add) and any(map(is_zero, n.terms))
    while (found := next(filter(has_zero, walk(node)), None)) is not None:
        left = tuple(term for term in found.terms if not is_zero(term))
        new = Add(left, span=found.span) if len(left) > 1 else left[0] if left else Num(0.0, "0")
        node = exchange(node, found, new)
    return node
