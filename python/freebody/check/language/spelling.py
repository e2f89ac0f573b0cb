"""Trees back to text: plain text that reads back as the same tree, and LaTeX."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Sequence
from fractions import Fraction

from freebody.symbolic.tree import Add, Column, Cross, Dot, Fn, Matrix, Mul, Negative, Node, Num, Pow, Quotient, Sym, Unit

from .statements import Assignment, Equation, Program

_SUM, _DOT, _CROSS, _PRODUCT, _FACTOR, _ATOM = range(6)
_LEVELS = {Add: _SUM, Negative: _SUM, Dot: _DOT, Cross: _CROSS, Mul: _PRODUCT, Quotient: _PRODUCT, Pow: _FACTOR}
_MARKS = ("", "\u0307", "\u0308", "\u20db")


def spell(node: Node) -> str:
    """Plain text: ``l*thetaddot = -g*sin(theta)``. ``parse`` reads it back as the same tree."""
    match node:
        case Program(lines=lines):
            return "\n".join(spell(line) for line in lines)
        case Assignment(name=left, expression=right):
            return f"{spell(left)} = {spell(right)}"
        case Equation(left=left, right=right, relation=relation):
            return f"{spell(left)} {relation} {spell(right)}"
    return _plain(node, _SUM)


def level(node: Node) -> int:
    """How tightly a node holds together; looser ones need brackets inside tighter ones."""
    return _SUM if isinstance(node, Num) and node.value < 0 else _LEVELS.get(type(node), _ATOM)


def _plain(node: Node, least: int) -> str:
    if level(node) < least:
        return f"({_plain(node, _SUM)})"
    match node:
        case Num(value=value, text=text):
            return text or repr(float(value)).removesuffix(".0")
        case Unit(text=text):
            return text
        case Sym():
            return _symbol(node)
        case Add(terms=terms):
            return signed(terms, lambda term: _plain(term, _DOT))
        case Negative(of=of):
            return "-" + _plain(of, _DOT)
        case Dot(left=left, right=right):
            return f"{_plain(left, _DOT)} · {_plain(right, _CROSS)}"
        case Cross(left=left, right=right):
            return f"{_plain(left, _CROSS)} × {_plain(right, _PRODUCT)}"
        case Mul(factors=factors):
            return _times(factors)
        case Quotient(top=top, bottom=bottom):
            return f"{_plain(top, _PRODUCT)}/{_plain(bottom, _FACTOR)}"
        case Pow(base=base, exponent=Fraction() as exponent):
            return f"{_plain(base, _ATOM)}^({exponent})"
        case Pow(base=base, exponent=exponent):
            return f"{_plain(base, _ATOM)}^{_plain(exponent, _ATOM)}"
        case Fn(name=function, args=arguments):
            return f"{function}({_row(arguments)})"
        case Column(items=items):
            return f"({_row(items)})"
        case Matrix(rows=rows):
            return "[" + "; ".join(_row(row) for row in rows) + "]"
    raise TypeError(f"{type(node).__name__} has no spelling")


def _row(items: Sequence[Node]) -> str:
    return ", ".join(_plain(item, _SUM) for item in items)


def signed(terms: Sequence[Node], spelled: Callable[[Node], str]) -> str:
    """Terms with their signs between them."""
    out = ""
    for term in terms:
        minus = isinstance(term, Negative)
        sign = ("-" if minus else "") if not out else (" - " if minus else " + ")
        out += sign + spelled(term.of if minus else term)
    return out


def _times(factors: Sequence[Node]) -> str:
    first = factors[0]
    out = _plain(first, _FACTOR if isinstance(first, Mul) else _PRODUCT)
    for factor in factors[1:]:
        out += " " + factor.text if isinstance(factor, Unit) else "*" + _plain(factor, _FACTOR)
    return out


def _symbol(symbol: Sym) -> str:
    """``thetaddot``; a name with signs in it has its dots on top: Ḣ/E, cart.ẋ."""
    if re.fullmatch(r"\w+'*", symbol.name):
        return symbol.key
    at = symbol.name.rfind(".") + 2 if "." in symbol.name[:-1] else 1
    return unicodedata.normalize("NFC", symbol.name[:at] + _MARKS[symbol.dots] + symbol.name[at:])
