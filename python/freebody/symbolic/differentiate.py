"""Derivatives of expressions, by time or by one symbol, by the rules of the calculus."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from fractions import Fraction

from freebody.symbolic.errors import StatementError
from freebody.symbolic.tree import (
    Add,
    Column,
    Cross,
    Dot,
    Fn,
    Matrix,
    Mul,
    Negative,
    Node,
    Num,
    Pow,
    Quotient,
    Sym,
    Unit,
    power,
    walk,
)

_ZERO, _ONE, _TWO = Num(0.0, "0"), Num(1.0, "1"), Num(2.0, "2")
_MOST = 400  # parts, beyond which an equation is no longer one that a person wrote


def derivative(node: Node, symbol: Callable[[Sym], Node]) -> Node:
    """Its derivative, where ``symbol`` has that of each symbol. Raises ``StatementError`` at what has none."""
    return _Rules(symbol).of(node)


def rate(node: Node, still: Collection[str] = ()) -> Node:
    """What a person wrote, differentiated by time. Symbols in ``still`` do not change; the others get one dot more, and ``t`` has the rate 1.

    Raises ``StatementError`` at what has no derivative.
    """
    one_more = lambda n: _ZERO if n.name in still else Sym(n.name, n.dots + 1, span=n.span)
    return _short(node, derivative(node, lambda symbol: _ONE if symbol == Sym("t") else one_more(symbol)))


def partial(node: Node, by: Sym) -> Node:
    """Its change with one symbol, all others held. Raises ``StatementError`` at what has no derivative."""
    return _short(node, derivative(node, lambda symbol: _ONE if symbol == by else _ZERO))


def _short(node: Node, found: Node) -> Node:
    if sum(1 for _ in walk(found)) > _MOST:
        raise StatementError("the derivative of this is too long", node.span, "write it out in several lines")
    return found


class _Rules:
    def __init__(self, symbol: Callable[[Sym], Node]) -> None:
        self.symbol = symbol

    def of(self, node: Node) -> Node:
        match node:
            case Num() | Unit():
                return _ZERO
            case Sym():
                return self.symbol(node)
            case Negative(of=of):
                return _negative(self.of(of))
            case Add(terms=terms):
                return _sum([self.of(term) for term in terms])
            case Mul(factors=factors):
                return self.each(factors, lambda parts: _product(parts))
            case Cross(left=left, right=right) | Dot(left=left, right=right):
                return self.each((left, right), lambda parts: _ZERO if _ZERO in parts else type(node)(*parts))
            case Quotient(top=top, bottom=bottom):  # (a/b)˙ = ȧ/b − a ḃ/b²
                first, second = self.of(top), _product([top, self.of(bottom)])
                terms = [_ZERO if first == _ZERO else Quotient(first, bottom)]
                return _sum([*terms, *([] if self.stands(bottom) else [Negative(Quotient(second, Pow(bottom, _TWO)))])])
            case Pow(base=base, exponent=exponent):
                return self.power(node, base, exponent)
            case Fn(name="atan2", args=(y, x)):
                above = _sum([_product([x, self.of(y)]), _negative(_product([y, self.of(x)]))])
                return _ZERO if above == _ZERO else Quotient(above, Add((Pow(x, _TWO), Pow(y, _TWO))))
            case Fn(name=function, args=(inside,)) if function in _SLOPES:
                return _product([_SLOPES[function](inside), self.of(inside)])
            case Column(items=items):
                return Column(tuple(self.of(item) for item in items))
            case Matrix(rows=rows):
                return Matrix(tuple(tuple(self.of(item) for item in row) for row in rows))
        if self.stands(node):
            return _ZERO
        raise StatementError("this has no derivative here", node.span, "write the derivative out")

    def stands(self, node: Node) -> bool:
        """Whether it does not change."""
        return all(self.symbol(n) == _ZERO for n in walk(node) if isinstance(n, Sym))

    def each(self, factors: Sequence[Node], product: Callable[[list[Node]], Node]) -> Node:
        """Each factor in turn."""
        rates = [self.of(factor) for factor in factors]
        return _sum([product([*factors[:i], rate, *factors[i + 1 :]]) for i, rate in enumerate(rates) if rate != _ZERO])

    def power(self, node: Node, base: Node, exponent: Node | Fraction) -> Node:
        """(aⁿ)˙ = n aⁿ⁻¹ ȧ."""
        if isinstance(exponent, Fraction):
            return _product([Num(exponent), power(base, exponent - 1), self.of(base)])
        if not self.stands(exponent):
            raise StatementError("an exponent that changes", node.span, "write the derivative out")
        less = Num(exponent.value - 1) if isinstance(exponent, Num) else Add((exponent, Num(-1.0)))
        lower = base if less == _ONE else Pow(base, less)
        return _product([exponent, lower, self.of(base)])


_SLOPES: dict[str, Callable[[Node], Node]] = {
    "sin": lambda x: Fn("cos", (x,)),
    "cos": lambda x: Negative(Fn("sin", (x,))),
    "tan": lambda x: Quotient(_ONE, Pow(Fn("cos", (x,)), _TWO)),
    "sinh": lambda x: Fn("cosh", (x,)),
    "cosh": lambda x: Fn("sinh", (x,)),
    "exp": lambda x: Fn("exp", (x,)),
    "ln": lambda x: Quotient(_ONE, x),
    "sqrt": lambda x: Quotient(_ONE, Mul((_TWO, Fn("sqrt", (x,))))),
    "abs": lambda x: Fn("sign", (x,)),
}


def _negative(node: Node) -> Node:
    return node.of if isinstance(node, Negative) else _ZERO if node == _ZERO else Negative(node)


def _sum(terms: Sequence[Node]) -> Node:
    left = [term for term in terms if term != _ZERO]
    return _ZERO if not left else left[0] if len(left) == 1 else Add(tuple(left))


def _product(factors: Sequence[Node]) -> Node:
    """Factors without 1, a minus in front."""
    if _ZERO in factors:
        return _ZERO
    negative = sum(isinstance(factor, Negative) for factor in factors) % 2
    plain = [factor.of if isinstance(factor, Negative) else factor for factor in factors]
    left = [factor for factor in plain if factor != _ONE] or [_ONE]
    found = left[0] if len(left) == 1 else Mul(tuple(left))
    return Negative(found) if negative else found
