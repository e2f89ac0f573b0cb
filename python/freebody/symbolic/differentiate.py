"""Derivatives of expressions, by time or by one symbol, by the rules of the calculus."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from fractions import Fraction

from freebody.symbolic.errors import StatementError
from freebody.symbolic.tree import (
    ONE,
    ZERO,
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
    Tree,
    Unit,
    canonical,
    power,
    unsigned,
    walk,
)

_ZERO, _ONE, _TWO = Num(0.0, "0"), Num(1.0, "1"), Num(2.0, "2")
_MOST = 400  # parts, beyond which an equation is no longer one that a person wrote


def derivative(node: Node, symbol: Callable[[Sym], Node]) -> Node:
    """Its derivative, where ``symbol`` has that of each symbol. Raises ``StatementError`` at what has none."""
    of = lambda part: derivative(part, symbol)
    stands = lambda part: all(symbol(x) == _ZERO for x in walk(part) if isinstance(x, Sym))

    def each(factors: Sequence[Node], product: Callable[[list[Node]], Node]) -> Node:
        """Each factor in turn."""
        rates = enumerate(map(of, factors))
        return _sum([product([*factors[:i], rate, *factors[i + 1 :]]) for i, rate in rates if rate != _ZERO])

    match node:
        case Num() | Unit():
            return _ZERO
        case Sym():
            return symbol(node)
        case Negative(inner):
            return _negative(of(inner))
        case Add(terms):
            return _sum(list(map(of, terms)))
        case Mul(factors):
            return each(factors, _product)
        case Cross(left, right) | Dot(left, right):
            return each((left, right), lambda parts: _ZERO if _ZERO in parts else type(node)(*parts))
        case Quotient(top, bottom):  # (a/b)˙ = ȧ/b − a ḃ/b²
            first, second = of(top), _product([top, of(bottom)])
            terms = [_ZERO if first == _ZERO else Quotient(first, bottom)]
            return _sum([*terms, *([] if stands(bottom) else [Negative(Quotient(second, Pow(bottom, _TWO)))])])
        case Pow(base, Fraction() as exponent):  # (aⁿ)˙ = n aⁿ⁻¹ ȧ
            return _product([Num(exponent), power(base, exponent - 1), of(base)])
        case Pow(base, exponent) if stands(exponent):
            less = Num(exponent.value - 1) if isinstance(exponent, Num) else Add((exponent, Num(-1.0)))
            return _product([exponent, base if less == _ONE else Pow(base, less), of(base)])
        case Pow():
            raise StatementError("an exponent that changes", node.span, "write the derivative out")
        case Fn("atan2", (y, x)):
            above = _sum([_product([x, of(y)]), _negative(_product([y, of(x)]))])
            return _ZERO if above == _ZERO else Quotient(above, Add((Pow(x, _TWO), Pow(y, _TWO))))
        case Fn(function, (inside,)) if function in _SLOPES:
            return _product([_SLOPES[function](inside), of(inside)])
        case Column(items):
            return Column(tuple(map(of, items)))
        case Matrix(rows):
            return Matrix(tuple(tuple(map(of, row)) for row in rows))
    if stands(node):
        return _ZERO
    raise StatementError("this has no derivative here", node.span, "write the derivative out")


def rate(node: Node, constants: Collection[str] = ()) -> Node:
    """What a person wrote, differentiated by time. Symbols in ``constants`` do not change; the others get one dot more, and ``t`` has the rate 1.

    Raises ``StatementError`` at what has no derivative.
    """
    one_more = lambda n: _ZERO if n.name in constants else Sym(n.name, n.dots + 1, span=n.span)
    return _short(node, derivative(node, lambda symbol: _ONE if symbol == Sym("t") else one_more(symbol)))


def along_motion(tree: Tree, coordinates: Collection[str]) -> Tree:
    """The derivative with respect to time of an expression of coordinates, their rates and time; other symbols do not change."""

    def of(symbol: Sym) -> Tree:
        if symbol == Sym("t"):
            return ONE
        return Sym(symbol.name, symbol.dots + 1) if symbol.name in coordinates and symbol.dots < 2 else ZERO

    return canonical(derivative(tree, of))


def partial(node: Node, by: Sym) -> Node:
    """Its change with one symbol, all others held. Raises ``StatementError`` at what has no derivative."""
    return _short(node, derivative(node, lambda symbol: _ONE if symbol == by else _ZERO))


def _short(node: Node, found: Node) -> Node:
    if sum(1 for _ in walk(found)) > _MOST:
        raise StatementError("the derivative of this is too long", node.span, "write it out in several lines")
    return found


def _root(*terms: Node) -> Node:
    return Fn("sqrt", (Add(terms),))


_SLOPES: dict[str, Callable[[Node], Node]] = {
    "sin": lambda x: Fn("cos", (x,)),
    "cos": lambda x: Negative(Fn("sin", (x,))),
    "tan": lambda x: Quotient(_ONE, Pow(Fn("cos", (x,)), _TWO)),
    "sinh": lambda x: Fn("cosh", (x,)),
    "cosh": lambda x: Fn("sinh", (x,)),
    "asin": lambda x: Quotient(_ONE, _root(_ONE, Negative(Pow(x, _TWO)))),
    "acos": lambda x: Negative(Quotient(_ONE, _root(_ONE, Negative(Pow(x, _TWO))))),
    "atan": lambda x: Quotient(_ONE, Add((_ONE, Pow(x, _TWO)))),
    "asinh": lambda x: Quotient(_ONE, _root(Pow(x, _TWO), _ONE)),
    "acosh": lambda x: Quotient(_ONE, _root(Pow(x, _TWO), Negative(_ONE))),
    "atanh": lambda x: Quotient(_ONE, Add((_ONE, Negative(Pow(x, _TWO))))),
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
    plain = [unsigned(factor) for factor in factors]
    left = [factor for factor in plain if factor != _ONE] or [_ONE]
    found = left[0] if len(left) == 1 else Mul(tuple(left))
    return Negative(found) if negative else found
