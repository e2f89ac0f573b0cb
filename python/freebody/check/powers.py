"""Products as a number and powers of what they are made of."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from fractions import Fraction

from freebody.symbolic.tree import ZERO, Add, Fn, Mul, Negative, Node, Num, Pow, Quotient, Sym, addends

from .coefficients import multiplied, product, recognised

NOTHING: Mapping[Sym, Node] = {}


def powers_of(node: Node, own: Mapping[Sym, Node] = NOTHING) -> tuple[float, dict[Node, int]]:
    """The number of a product and the powers of its other factors, symbols being what they are in ``own`` letters."""
    match node:
        case Sym() if node in own:
            return powers_of(own[node])
        case Num(value=value):
            return float(value), {}
        case Negative(of=of):
            number, powers = powers_of(of, own)
            return -number, powers
        case Mul(factors=factors):
            return _times(powers_of(factor, own) for factor in factors)
        case Quotient(top=top, bottom=bottom):
            number, powers = powers_of(bottom, own)
            return _times([powers_of(top, own), (1 / number, {base: -n for base, n in powers.items()})])
        case Pow(base=base, exponent=Num() | Fraction() as exponent):
            n = Fraction(exponent.value if isinstance(exponent, Num) else exponent)
            if n.denominator == 1:
                number, powers = powers_of(base, own)
                return number ** int(n), {each: int(n) * m for each, m in powers.items()}
            if n.denominator == 2:
                return 1.0, {Fn("sqrt", (_sum(base, own),)): n.numerator}
        case Fn(name=name, args=args):
            return 1.0, {Fn(name, tuple(_sum(arg, own) for arg in args)): 1}
        case Add():
            return 1.0, {_sum(node, own): 1}
    return 1.0, {node: 1}


def written(number: float, powers: Mapping[Node, int]) -> Node:
    """A product as a person writes it: a number, what stands above and what below the line."""
    above = [power_of(base, n) for base, n in powers.items() if n > 0]
    below = [power_of(base, -n) for base, n in powers.items() if n < 0]
    if below and isinstance(figure := recognised(abs(number)), Quotient) and isinstance(figure.top, Num):
        above = above if figure.top == Num(1.0) else [figure.top, *above]
        term: Node = Quotient(product(above), product([figure.bottom, *below]))
        return Negative(term) if number < 0 else term
    term = Quotient(product(above), product(below)) if below else product(above)
    return multiplied(term, number) or Mul((Num(number, repr(number)), term))


def power_of(base: Node, n: int) -> Node:
    """A power, the first being the base itself."""
    return base if n == 1 else Pow(base, Num(float(n), str(n)))


def _sum(node: Node, own: Mapping[Sym, Node]) -> Node:
    """A sum in other letters, term by term."""
    terms = [written(sign * number, powers) for sign, term in addends(node) for number, powers in [powers_of(term, own)]]
    return Add(tuple(terms)) if len(terms) > 1 else terms[0] if terms else ZERO


def _times(parts: Iterable[tuple[float, dict[Node, int]]]) -> tuple[float, dict[Node, int]]:
    number, powers = 1.0, Counter[Node]()
    for its, of in parts:
        number *= its
        for base, n in of.items():
            powers[base] += n
    return number, {base: n for base, n in powers.items() if n}
