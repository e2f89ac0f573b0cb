"""Mathematics as it is set in type: a row of parts, which LaTeX and MathML spell, and of which the widths are known."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction as Rational
from typing import TypeAlias


@dataclass(frozen=True)
class Atom:
    """What has no parts: ``letter`` (slanted), ``bold`` letter, upright ``word``, upright ``label`` below a letter, ``number``,
    ``function`` (sin), ``infix`` (+ and − between terms), ``relation``, ``prefix`` (− in front), ``sign``, ``space``; brackets that
    ``open`` and ``close``, or do so in the size of what is between (``opening``, ``closing``), or in a size of TeX (``bigl``,
    ``bigr``, ``Bigl``, ``Bigr``)."""

    text: str
    kind: str = "letter"


@dataclass(frozen=True)
class Script:
    """Something with what stands lower or higher behind it."""

    base: Formula
    below: Formula = ()
    above: Formula = ()


@dataclass(frozen=True)
class Accent:
    """One or two dots, or a bar, above something."""

    inner: Formula
    sign: str


@dataclass(frozen=True)
class Fraction:
    """One above the other; ``small`` for numbers beside letters."""

    above: Formula
    below: Formula
    small: bool = False


@dataclass(frozen=True)
class Root:
    """A square root."""

    inner: Formula


@dataclass(frozen=True)
class Grid:
    """A matrix in square brackets."""

    rows: tuple[tuple[Formula, ...], ...]


Part: TypeAlias = Atom | Script | Accent | Fraction | Root | Grid
Formula: TypeAlias = tuple[Part, ...]
GAP, THIN, QUAD = (Atom(width, "space") for width in (" ", "\u2009", "\u2003"))
"""Nothing but two factors side by side; a small space between words; a wide one in front of a line."""
PLUS, MINUS, EQUALS = Atom("+", "infix"), Atom("−", "infix"), Atom("=", "relation")
NEGATIVE, TIMES = Atom("−", "prefix"), Atom("·", "sign")


_KINDS = {"=": "relation", " ": "space"} | dict.fromkeys("/×·∑", "sign") | dict.fromkeys("0123456789", "number")


def typed(*parts: str | Formula) -> Formula:
    """One behind the other; a text is its letters, digits and signs, each by itself."""
    atoms = (tuple(Atom(sign, _KINDS.get(sign, "letter")) for sign in part) if isinstance(part, str) else part for part in parts)
    return tuple(itertools.chain.from_iterable(atoms))


def bold(text: str) -> Formula:
    """The letter of a vector or a matrix."""
    return (Atom(text, "bold"),)


def word(text: str) -> Formula:
    """An upright word or letter."""
    return (Atom(text, "word"),)


def dotted(inner: Formula, dots: int) -> Formula:
    """A letter with a dot for each differentiation by time."""
    return (Accent(inner, "˙¨"[dots - 1]),) if dots else inner


def joined(formulas: Iterable[Formula], between: Formula) -> Formula:
    """One behind the other."""
    return tuple(itertools.chain.from_iterable((*between, *each) if i else each for i, each in enumerate(formulas)))


def rational(value: Rational) -> Formula:
    """A fraction on the line, 3/2."""
    below = () if value.denominator == 1 else (Atom("/", "sign"), Atom(str(value.denominator), "number"))
    return (*((NEGATIVE,) if value < 0 else ()), Atom(str(abs(value.numerator)), "number"), *below)


def leading(formula: Formula) -> Atom | None:
    """What a formula begins with, where that has no parts."""
    first = formula[0]
    while isinstance(first, Script | Accent):
        first = first.base[0] if isinstance(first, Script) else first.inner[0]
    return first if isinstance(first, Atom) else None


def walk(formula: Formula) -> Iterator[Part]:
    """Every part, and all that it is made of."""
    for part in formula:
        yield part
        match part:
            case Script(base, below, above):
                yield from walk((*base, *below, *above))
            case Accent(inner) | Root(inner):
                yield from walk(inner)
            case Fraction(above, below):
                yield from walk((*above, *below))


def bracket(part: Part) -> Atom:
    """What may be a bracket: the part itself, or what it raises."""
    last = part.base[-1] if isinstance(part, Script) else part
    return last if isinstance(last, Atom) else GAP


def turn(part: Part, kinds: Sequence[str] = ("open", "opening", "close", "closing")) -> int:
    """1 where brackets open, −1 where they close."""
    kind = bracket(part).kind
    return (kind in kinds) * (1 if kind.startswith("open") else -1)


def split(formula: Sequence[Part], depth: float, kinds: Sequence[str] = ("infix",)) -> Iterator[list[Part]]:
    """What stands between the signs that are in at most ``depth`` brackets."""
    inside, part = 0, []
    for each in formula:
        if part and inside <= depth and getattr(each, "kind", "") in kinds:
            yield part
            part = []
        inside += turn(each)
        part.append(each)
    yield part
