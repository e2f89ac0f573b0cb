"""An equation of columns as one equation of numbers for each row."""

from __future__ import annotations

from freebody.symbolic.evaluate import is_zero
from freebody.symbolic.tree import Add, Column, Dot, Matrix, Mul, Negative, Node, Num, Quotient

from .language.statements import Equation


def rows(equation: Equation) -> list[Equation]:
    """One equation a row, made of the same parts; the equation itself where its sides are no columns."""
    left, right = _entries(equation.left), _entries(equation.right)
    count = len(left or right or ())
    if not count:
        return [equation]
    left = left or ([equation.left] * count if is_zero(equation.left) else [])
    right = right or ([equation.right] * count if is_zero(equation.right) else [])
    if len(left) != count or len(right) != count:
        return [equation]
    return [Equation(a, b, span=equation.span) for a, b in zip(left, right, strict=True)]


def _entries(node: Node) -> list[Node] | None:
    """The entries of a column, or None."""
    match node:
        case Column(items=items):
            return list(items)
        case Matrix(rows=lines) if all(len(line) == 1 for line in lines):
            return [line[0] for line in lines]
        case Negative(of=of):
            inside = _entries(of)
            return None if inside is None else [Negative(item) for item in inside]
        case Add(terms=terms):
            columns = [_entries(term) for term in terms if not is_zero(term)]
            alike = None not in columns and len(set(map(len, columns))) == 1  # type: ignore[arg-type]
            return [Add(parts) for parts in zip(*columns, strict=True)] if alike else None  # type: ignore[arg-type]
        case Quotient(top=top, bottom=bottom):
            inside = _entries(top)
            return None if inside is None else [Quotient(item, bottom) for item in inside]
        case Mul(factors=factors):
            return _products(factors)
        case Dot(left=left, right=right):
            return _products((left, right))
    return None


def _products(factors: tuple[Node, ...]) -> list[Node] | None:
    """A product whose last column or matrix is multiplied from the left."""
    out: list[Node] | None = None
    for factor in reversed(factors):
        if isinstance(factor, Matrix) and out is not None:
            if any(len(line) != len(out) for line in factor.rows):
                return None
            out = [_row(line, out) for line in factor.rows]
        elif (column := _entries(factor)) is not None:
            if out is not None:
                return None
            out = column
        elif out is not None:
            out = [_times(factor, item) for item in out]
        else:
            return None
    return out


def _row(line: tuple[Node, ...], column: list[Node]) -> Node:
    terms = [_times(a, b) for a, b in zip(line, column, strict=True) if not is_zero(a) and not is_zero(b)]
    return Add(tuple(terms)) if len(terms) > 1 else terms[0] if terms else Num(0.0, "0")


def _times(a: Node, b: Node) -> Node:
    return b if a == Num(1.0) else Mul((a, b))
