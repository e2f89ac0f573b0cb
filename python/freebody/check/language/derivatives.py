"""Derivatives of what a person wrote, by time or by one letter, by the rules of the calculus."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

from .errors import StatementError
from .nodes import Call, Column, Cross, Dot, Letter, Matrix, Negative, Node, Number, Power, Product, Quotient, Sum, Unit, walk

_ZERO, _ONE, _TWO = Number(0.0, "0"), Number(1.0, "1"), Number(2.0, "2")
_MOST = 400  # parts, beyond which an equation is no longer one that a person wrote


def derivative(node: Node, still: Collection[str] = ()) -> Node:
    """Its rate. Letters in ``still`` do not change; the others get one dot more, and ``t`` has the rate 1.

    Raises ``StatementError`` at what has no derivative.
    """
    return _short(node, _Rules(lambda letter: _rate(letter, still)).of(node))


def partial(node: Node, by: Letter) -> Node:
    """Its change with one letter, all others held. Raises ``StatementError`` at what has no derivative."""
    return _short(node, _Rules(lambda letter: _ONE if letter == by else _ZERO).of(node))


def _rate(letter: Letter, still: Collection[str]) -> Node:
    if letter == Letter("t"):
        return _ONE
    return _ZERO if letter.name in still else Letter(letter.name, letter.dots + 1, span=letter.span)


def _short(node: Node, found: Node) -> Node:
    if sum(1 for _ in walk(found)) > _MOST:
        raise StatementError("the derivative of this is too long", node.span, "write it out in several lines")
    return found


class _Rules:
    def __init__(self, letter: Callable[[Letter], Node]) -> None:
        self.letter = letter

    def of(self, node: Node) -> Node:
        match node:
            case Number() | Unit():
                return _ZERO
            case Letter():
                return self.letter(node)
            case Negative(of=of):
                return _negative(self.of(of))
            case Sum(terms=terms):
                return _sum([self.of(term) for term in terms])
            case Product(factors=factors):
                return self.each(factors, lambda parts: _product(parts))
            case Cross(left=left, right=right) | Dot(left=left, right=right):
                return self.each((left, right), lambda parts: _ZERO if _ZERO in parts else type(node)(*parts))
            case Quotient(top=top, bottom=bottom):
                return self.quotient(top, bottom)
            case Power(base=base, exponent=exponent):
                return self.power(node, base, exponent)
            case Call(function=function, arguments=(inside,)) if function in _SLOPES:
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
        return all(self.letter(n) == _ZERO for n in walk(node) if isinstance(n, Letter))

    def each(self, factors: Sequence[Node], product: Callable[[list[Node]], Node]) -> Node:
        """Each factor in turn."""
        rates = [self.of(factor) for factor in factors]
        return _sum([product([*factors[:i], rate, *factors[i + 1 :]]) for i, rate in enumerate(rates) if rate != _ZERO])

    def quotient(self, top: Node, bottom: Node) -> Node:
        """(a/b)˙ = ȧ/b − a ḃ/b²."""
        first = self.of(top)
        terms = [_ZERO if first == _ZERO else Quotient(first, bottom)]
        if not self.stands(bottom):
            terms.append(Negative(Quotient(_product([top, self.of(bottom)]), Power(bottom, _TWO))))
        return _sum(terms)

    def power(self, node: Node, base: Node, exponent: Node) -> Node:
        """(aⁿ)˙ = n aⁿ⁻¹ ȧ."""
        if not self.stands(exponent):
            raise StatementError("an exponent that changes", node.span, "write the derivative out")
        less = Number(exponent.value - 1) if isinstance(exponent, Number) else Sum((exponent, Number(-1.0)))
        lower = base if less == _ONE else Power(base, less)
        return _product([exponent, lower, self.of(base)])


_SLOPES: dict[str, Callable[[Node], Node]] = {
    "sin": lambda x: Call("cos", (x,)),
    "cos": lambda x: Negative(Call("sin", (x,))),
    "tan": lambda x: Quotient(_ONE, Power(Call("cos", (x,)), _TWO)),
    "sinh": lambda x: Call("cosh", (x,)),
    "cosh": lambda x: Call("sinh", (x,)),
    "exp": lambda x: Call("exp", (x,)),
    "ln": lambda x: Quotient(_ONE, x),
    "sqrt": lambda x: Quotient(_ONE, Product((_TWO, Call("sqrt", (x,))))),
    "abs": lambda x: Call("sign", (x,)),
}


def _negative(node: Node) -> Node:
    return node.of if isinstance(node, Negative) else _ZERO if node == _ZERO else Negative(node)


def _sum(terms: Sequence[Node]) -> Node:
    left = [term for term in terms if term != _ZERO]
    return _ZERO if not left else left[0] if len(left) == 1 else Sum(tuple(left))


def _product(factors: Sequence[Node]) -> Node:
    """Factors without 1, a minus in front."""
    if _ZERO in factors:
        return _ZERO
    negative = sum(isinstance(factor, Negative) for factor in factors) % 2
    plain = [factor.of if isinstance(factor, Negative) else factor for factor in factors]
    left = [factor for factor in plain if factor != _ONE] or [_ONE]
    found = left[0] if len(left) == 1 else Product(tuple(left))
    return Negative(found) if negative else found
