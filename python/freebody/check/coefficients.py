"""Numbers and products as a person writes them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import chain
from typing import TypeVar

from freebody.symbolic.tree import Add, Fn, Mul, Negative, Node, Num, Pow, Quotient, Sym, exchange, walk

from .language.statements import without_ones

N = TypeVar("N", bound=Node)
_SAME = 1e-8  # relative: below it a number is the one recognised
_DENOMINATOR = 24
_NUMERATOR = 60
_ONE = Num(1.0, "1")
_BESIDE_PI = {1, 2, 4, 8}
"""Figures beside π² and below the line beside π: other ones are angles of a model, in disguise."""
_BESIDE_ROOTS = 4
"""The largest figure beside √2 and √3."""


def recognised(value: float) -> Node | None:
    """A number as a person writes it: p/q with q ≤ 24, or so many π or π², or parts of them, as of a lead p/(2 π), or of √2 and √3, as sines
    have them; None where it is neither."""
    for power in (0, 1, 2, -1, -2):
        part = Fraction(abs(value) / math.pi**power).limit_denominator(_DENOMINATOR)
        if not part or part.numerator > _NUMERATOR or abs(float(part) * math.pi**power / abs(value) - 1) >= _SAME:
            continue
        if power not in (0, 1) and not {*part.as_integer_ratio()} <= _BESIDE_PI:
            continue
        above, below = _figures(part)
        return _quotient(value, _with_pi(above, power), _with_pi(below, -power))
    for n in (2, 3):
        part = Fraction(abs(value) / math.sqrt(n)).limit_denominator(_BESIDE_ROOTS)
        if part and part.numerator <= _BESIDE_ROOTS and abs(float(part) * math.sqrt(n) / abs(value) - 1) < _SAME:
            above, below = _figures(part)
            root = Fn("sqrt", (Num(float(n), str(n)),))
            return _quotient(value, root if above == _ONE else Mul((above, root)), below)
    return None


def _figures(part: Fraction) -> tuple[Num, Num]:
    above, below = (Num(float(figure), str(figure)) for figure in part.as_integer_ratio())
    return above, below


def _quotient(value: float, top: Node, bottom: Node) -> Node:
    """A quotient with the sign of a value."""
    found = top if bottom == _ONE else Quotient(top, bottom)
    return Negative(found) if value < 0 else found


def _with_pi(figure: Num, power: int) -> Node:
    """A figure times a power of π that is above 0, or it alone."""
    pi = Num(math.pi, "pi")
    factors = [
        *([figure] if figure != Num(1.0) or power < 1 else []),
        *([pi] * (power == 1)),
        *([Pow(pi, Num(2.0, "2"))] * (power == 2)),
    ]
    return product(factors)


def snapped(value: float, near: float) -> float:
    """The fraction of small figures that is as ``near`` to a number, relative to it; the number itself where none is."""
    part = float(Fraction(value).limit_denominator(_DENOMINATOR))
    return part if abs(part - value) <= near * abs(value) else value


def multiplied(node: Node, value: float) -> Node | None:
    """A term times a number; None where that is no number that a person writes."""
    if isinstance(node, Negative):
        return multiplied(node.of, -value)
    if node == _ONE:
        return recognised(value)
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
    if isinstance(node, Quotient):  # m/(3 k), and no m/k/3
        above, below = (number.top, number.bottom) if isinstance(number, Quotient) else (number, _ONE)
        sides = ((above, *_factors(node.top)), (below, *_factors(node.bottom)))
        found = Quotient(*(product([n for n in each if n != _ONE]) for each in sides), span=node.span)
        return Negative(found) if value < 0 else found
    if isinstance(number, Quotient) and number.top == Num(1.0):
        found: Node = Quotient(node, number.bottom, span=node.span)
    else:
        found = node if number == Num(1.0) else Mul((*_factors(number), *_factors(node)), span=node.span)
    return Negative(found) if value < 0 else found


def _factors(node: Node) -> tuple[Node, ...]:
    return node.factors if isinstance(node, Mul) else (node,)


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
    parts = (part.terms if isinstance(part, Add) else (part,) for part in (node, *terms))
    return Add(tuple(chain(*parts)), span=node.span)


def tidied(node: N) -> N:
    """The same without factors and denominators 1, without 0 in sums, and with what is added to its like gathered."""
    node = without_ones(node)
    while (found := next((n for n in walk(node) if isinstance(n, Add) and len(_gathered(n)) < len(n.terms)), None)) is not None:
        left = _gathered(found)
        new = Add(left, span=found.span) if len(left) > 1 else left[0] if left else Num(0.0, "0")
        node = exchange(node, found, new)
    for whole in [n for n in walk(node) if isinstance(n, Mul)]:
        for plus in whole.factors:
            match plus:  # (1 + e) (1 − e) is 1 − e²
                case Add(terms=(Num(value=1.0), other)) if (minus := Add((_ONE, Negative(other)))) in whole.factors:
                    rest = [n for n in whole.factors if n not in (plus, minus)]
                    node = exchange(node, whole, product([*rest, Add((_ONE, Negative(Pow(other, Num(2.0, "2")))))]))
    return node


def _gathered(whole: Add) -> tuple[Node, ...]:
    """The terms of a sum that are not 0, each joined with those that are it but for a number; as they are where that is no number of a person."""
    alike: dict[Node, list[Node]] = {}
    for term in whole.terms:
        alike.setdefault(_split(term)[1], []).append(term)
    found: list[Node] = []
    for rest, some in alike.items():
        number = sum(_split(term)[0] for term in some)
        if not number:
            continue
        joined = some[0] if len(some) == 1 else recognised(number) if rest == _ONE else multiplied(rest, number)
        if joined is None:
            return whole.terms
        found.append(joined)
    return tuple(found)


def _split(term: Node) -> tuple[float, Node]:
    """The number before a term, and the rest; of a number alone, that and 1."""
    match term:
        case Num(value=value):
            return float(value), _ONE
        case Negative(of=of):
            number, rest = _split(of)
            return -number, rest
        case Mul((Num(value=value), *rest)):
            return float(value), product(rest)
    return 1.0, term
