"""Arithmetic on numbers of the model, which are literals or expressions of parameters."""

from __future__ import annotations

from collections.abc import Sequence

from . import syntax

Number = float | str


def text(number: Number) -> str:
    """The number as an operand of an expression."""
    if isinstance(number, float):
        return f"({number!r})" if number < 0 else repr(number)
    return f"({number})"


def worked(expression: str) -> Number:
    """The value of an expression without names; others stay as they are."""
    tree = syntax.parse(expression).tree
    return expression if syntax.names(tree) else float(syntax.evaluate(tree, float))


def difference(a: Number, b: Number) -> str:
    """a − b as an operand."""
    if isinstance(a, float) and isinstance(b, float):
        return text(a - b)
    return f"({text(a)} - {text(b)})"


def distance(a: Sequence[Number], b: Sequence[Number]) -> Number:
    """The distance of two places of one body."""
    return worked(f"hypot({difference(b[0], a[0])}, {difference(b[1], a[1])})")


def half(number: Number, sign: int = 1) -> Number:
    """Half the number, or its opposite."""
    if isinstance(number, float):
        return sign * number / 2
    return f"({number})/2" if sign > 0 else f"-({number})/2"


def placed(place: Sequence[Number], at: Sequence[Number], angle: Number) -> list[Number]:
    """A place of a piece in the frame of the body in which the piece stands at ``at``, turned by ``angle``."""
    x, y, turn = text(place[0]), text(place[1]), text(angle)
    return [
        worked(f"{text(at[0])} + {x}*cos({turn}) - {y}*sin({turn})"),
        worked(f"{text(at[1])} + {x}*sin({turn}) + {y}*cos({turn})"),
    ]
