"""Formulas that are too wide for a line, over several: m (a + b) − c breaks before its signs, within brackets where it must.

Widths are those of Computer Modern, roughly, in em."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Any, TypeVar

from freebody.symbolic.formula import (
    EQUALS,
    GAP,
    QUAD,
    Accent,
    Atom,
    Formula,
    Fraction,
    Grid,
    Part,
    Root,
    Script,
    bracket,
    split,
    turn,
    walk,
)

Line = TypeVar("Line", bound=Sequence)
ROOM = 30.0
"""Width of a line of an article with a number beside it."""
INDENT = 1.0
_LETTER, _CAPITAL, _DIGIT, _SCRIPT = 0.52, 0.76, 0.5, 0.7
_WIDTHS = {
    "+": 1.22, "−": 1.22, "=": 1.33, ",": 0.45, "·": 0.72, "m": 0.88, "w": 0.72, "l": 0.3, "i": 0.35, "t": 0.36,
    "sin": 1.5, "cos": 1.55, "tan": 1.65, "ln": 1.1, "exp": 1.75, " ": 0.0, "\u2009": 0.17, "\u2003": 1.0,
}  # fmt: skip
_BRACKETS = {"open": 0.39, "close": 0.39, "opening": 0.5, "closing": 0.5} | dict.fromkeys(("bigl", "bigr", "Bigl", "Bigr"), 0.49)
_GROWING = ("opening", "closing")
_BAR = 0.24
"""What a fraction takes beyond what stands in it."""
_ROOT = 0.85
"""What the sign of a root takes."""


def broken(
    line: Line,
    room: float,
    later: float,
    width: Callable[[Line], float],
    split: Callable[[Line, float], Iterable[Line]],
    begin: Callable[[Line], Line] = lambda piece: piece,
) -> list[Line]:
    """A line over several, of at most ``room`` and then ``later``, which ``begin`` with a piece: it is broken where ``split`` does so
    outside of brackets, and within as many brackets as it takes."""

    def pieces(part: Line, depth: int) -> Iterator[Line]:
        for each in split(part, depth):
            if width(each) <= later or len(list(split(each, math.inf))) == 1:
                yield each
            else:
                yield from pieces(each, depth + 1)

    made: list[Any] = []
    for piece in pieces(line, 0):
        if made and width(made[-1] + piece) <= (room if len(made) == 1 else later):
            made[-1] += piece
        else:
            made.append(begin(piece))
    return made


def width(formula: Sequence[Part]) -> float:
    """How wide a formula is on one line."""
    return sum(map(_width, formula))


def equation(left: Formula, right: Formula, room: float = ROOM) -> list[tuple[Formula, Formula]]:
    """``left = right`` on one line, or on several of which the second parts stand below each other: what is after = beside a left
    side that is short."""
    whole = (*left, EQUALS, *right)
    if width(whole) <= room:
        return [((), whole)]
    before = width((*left, EQUALS))
    if before <= room / 3:
        first, *more = lines(right, room - before)
        return [(left, (EQUALS, *first)), *_indented(more)]
    above, below = lines(left, room), lines(right, room - width((EQUALS,)))
    return [((), above[0]), *_indented(above[1:]), ((), (EQUALS, *below[0])), *_indented(below[1:])]


def _indented(rows: Sequence[Formula]) -> list[tuple[Formula, Formula]]:
    return [((), (QUAD, *row)) for row in rows]


def lines(formula: Formula, room: float = ROOM) -> list[Formula]:
    """The formula on lines of at most ``room``, as far as it can be broken; those after the first begin with their sign."""
    made = broken([*_unstacked(formula, room)], room, room - INDENT, width, split)
    # Brackets that grow cannot be broken.
    size = "Big" if any(isinstance(part, Fraction) and not part.small for part in walk(formula)) else "big"
    torn = any(sum(turn(part, _GROWING) for part in line) for line in made)
    return [tuple(_sized(part, size) for part in line) if torn else tuple(line) for line in made]


def _sized(part: Part, size: str) -> Part:
    """A bracket that grows in a size of its own."""
    growth = turn(part, _GROWING)
    sized = Atom(bracket(part).text, size + ("l" if growth > 0 else "r"))
    return part if not growth else replace(part, base=(*part.base[:-1], sized)) if isinstance(part, Script) else sized


def _unstacked(formula: Formula, room: float) -> Iterator[Part]:
    """The formula with fractions that are too wide as what is above times one over what is below: that can be broken."""
    for part in formula:
        if isinstance(part, Fraction) and not part.small and width((part,)) > room:
            one = (Atom("1", "number"),)
            yield from (Fraction(one, part.below), GAP, Atom("(", "opening"), *part.above, Atom(")", "closing"))
        else:
            yield part


def _width(part: Part) -> float:
    match part:
        case Atom(text, kind) if kind in _BRACKETS:
            return _BRACKETS[kind]
        case Atom(text, "word" | "label" | "number"):
            return _DIGIT * len(text)
        case Atom(text, "bold"):
            return width(tuple(map(Atom, text))) + 0.05
        case Atom(text, "function") if text not in _WIDTHS:
            return _DIGIT * len(text) + 0.33
        case Atom(text):
            return _WIDTHS.get(text, _CAPITAL if text.isascii() and text.isupper() else _LETTER)
        case Script(base, below, above):
            return width(base) + _SCRIPT * (width(below) + width(above))
        case Accent(inner):
            return width(inner)
        case Fraction(above, below, small):
            return (_SCRIPT if small else 1.0) * max(width(above), width(below)) + _BAR
        case Root(inner):
            return width(inner) + _ROOT
        case Grid(rows):
            return sum(max(map(width, column)) + 1.0 for column in zip(*rows, strict=True))
