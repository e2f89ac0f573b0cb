"""Units at the door: texts like ``400 mm`` or ``9.81 m/s^2`` become SI numbers with a dimension.

Angles are plain numbers in radians; that a number is an angle is remembered for display only.
"""

from __future__ import annotations

import math
import re
from decimal import Decimal
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING, NamedTuple

from freebody.symbolic.dimensions import ANGLE, ENERGY, FORCE, LENGTH, MASS, NUMBER_ONLY, TIME, Dimension

from .errors import ModelProblem
from .names import NUMBER, TOKEN, nearest

if TYPE_CHECKING:
    import pint


class Unit(NamedTuple):
    """A unit: its size in SI, exactly, and its dimension."""

    size: Fraction
    dimension: Dimension


class Quantity(NamedTuple):
    """A number in SI with its dimension and the unit as it was written."""

    value: float
    dimension: Dimension
    unit: str


# What most models use, so that they need not wait for the registry.
_THOUSAND = Fraction(1000)
_EVERYDAY = {
    "m": Unit(Fraction(1), LENGTH),
    "mm": Unit(1 / _THOUSAND, LENGTH),
    "cm": Unit(Fraction(1, 100), LENGTH),
    "km": Unit(_THOUSAND, LENGTH),
    "kg": Unit(Fraction(1), MASS),
    "g": Unit(1 / _THOUSAND, MASS),
    "s": Unit(Fraction(1), TIME),
    "ms": Unit(1 / _THOUSAND, TIME),
    "min": Unit(Fraction(60), TIME),
    "rad": Unit(Fraction(1), ANGLE),
    "deg": Unit(Fraction(math.pi) / 180, ANGLE),
    "°": Unit(Fraction(math.pi) / 180, ANGLE),
    "N": Unit(Fraction(1), FORCE),
    "kN": Unit(_THOUSAND, FORCE),
    "J": Unit(Fraction(1), ENERGY),
    "W": Unit(Fraction(1), Dimension(2, 1, -3)),
    "Pa": Unit(Fraction(1), Dimension(-1, 1, -2)),
    "Hz": Unit(Fraction(1), Dimension(0, 0, -1)),
}
"""What most models do with, so that they need not wait for the registry to be read."""
_MORE = (
    f"pi = {Decimal(math.pi)} = π",
    "lbm = pound",
    "rev = turn",
    "revs = turn",
    "rps = turn / second",
    "kph = kilometer / hour",
)
_COMMON = (
    *("m", "mm", "cm", "km", "in", "ft", "yd", "kg", "g", "mg", "t", "lb", "lbm", "oz", "slug", "s", "ms", "min", "h"),
    *("rad", "deg", "rev", "N", "kN", "mN", "lbf", "kgf", "J", "kJ", "W", "kW", "hp", "Pa", "kPa", "MPa", "bar", "psi"),
    *("Hz", "rpm", "mph"),
)
_NO_UNITS = {"c", "pi", "tau", "e", "G", "speed_of_light", "count", "percent", "ppm"}

_NUMBER = re.compile(rf"\s*([+-]?\s*{NUMBER})\s*")
_PIECE = re.compile(r"\s*([^\W\d²³][^\W²³]*|°|\d+|\*\*|[*^/·()²³-])")


@cache
def _registry() -> pint.UnitRegistry[Fraction]:
    import pint

    # `pi` becomes that of floating point, so that 30 deg is pi/6 to the last bit
    registry = pint.UnitRegistry(non_int_type=Fraction, on_redefinition="ignore")
    for line in _MORE:
        registry.define(line)
    return registry


def _not_a_unit() -> tuple[type[Exception], ...]:
    """What the registry raises for words that it does not know, and for units with an offset or a logarithm."""
    import pint

    return (pint.errors.PintError, TypeError, ValueError, ArithmeticError)


@cache
def word(text: str) -> Unit | None:
    """The unit of one word, e.g. ``mm``; None when there is none of mechanics."""
    return _EVERYDAY.get(text) or registered(text)


def registered(text: str) -> Unit | None:
    """The unit of one word as the registry knows it."""
    if text in _NO_UNITS or not (text.isidentifier() or text == "°"):
        return None
    registry = _registry()
    try:
        unit = registry.Quantity(Fraction(1), "degree" if text == "°" else text).to_base_units()
    except _not_a_unit():
        return None
    powers = {str(k): v for k, v in unit.unit_items()}
    known = {"meter": "length", "kilogram": "mass", "second": "time", "radian": "angle"}
    if not powers or set(powers) - set(known) or any(v != int(v) for v in powers.values()):
        return None
    return Unit(Fraction(unit.magnitude), Dimension(**{known[k]: int(v) for k, v in powers.items()}))


@cache
def unit(text: str) -> Unit:
    """The unit of a text like ``kg*m^2/s``, ``N m`` or empty. Raises ``ModelProblem``."""
    if not text.strip():
        return Unit(Fraction(1), NUMBER_ONLY)
    pieces = _pieces(text)
    found = _Reader(pieces).product() if pieces else None
    if found is not None:
        return found
    unknown = [p for p in pieces or [] if p[0].isalpha() and word(p) is None]
    near = nearest(unknown[0], _COMMON) if unknown else None
    what = f"there is no unit `{unknown[0]}`" if unknown else f"`{text}` is no unit"
    raise ModelProblem(what, f"did you mean `{near}`?" if near else "units look like `mm`, `N*m`, `kg*m^2`, `m/s^2`, `deg`")


def quantity(text: str) -> Quantity | None:
    """The quantity that the whole text is, or None when it must be read as an expression.

    Raises ``ModelProblem`` when a number stands with one word that is no unit.
    """
    found = _NUMBER.match(text)
    written = text[found.end() :].strip() if found else ""
    if not found or not (written[:1].isalpha() or written[:1] == "°") or not (pieces := _pieces(written)):
        return None
    if _Reader(pieces).product() is None:
        if len(pieces) == 1:
            unit(written)
        return None
    size, dimension = unit(written)
    return Quantity(_rounded(found[1], size), dimension, written)


class Rewritten(NamedTuple):
    """An expression without units: its text in SI and the dimension of each number in it, in order (None: bare)."""

    text: str
    numbers: list[Dimension | None]


def rewrite(text: str) -> Rewritten:
    """The expression with each number directly followed by a unit (``30 deg``) in SI. Raises ``ModelProblem``."""
    tokens = list(TOKEN.finditer(text))
    out: list[str] = []
    numbers: list[Dimension | None] = []
    before = ""
    skip_to = 0
    for i, token in enumerate(tokens):
        if i < skip_to:
            continue
        kind, piece = token.lastgroup, token[0]
        if kind == "number":
            after = i + 1 + (i + 1 < len(tokens) and tokens[i + 1].lastgroup == "space")
            if after < len(tokens) and tokens[after].lastgroup in ("name", "degree") and not _is_operator(tokens[after][0]):
                name = tokens[after][0]
                if before in ("/", "^"):
                    raise ModelProblem(
                        f"`{before}{piece} {name}` can be read in two ways",
                        f"write `{before}({piece} {name})` with the unit inside, or name the number under `parameters`",
                    )
                size, dimension = _literal(piece, name)
                piece, skip_to = repr(_rounded(piece, size)), after + 1
                numbers.append(dimension)
            else:
                numbers.append(None)
        if kind != "space":
            before = piece
        out.append(piece)
    return Rewritten("".join(out), numbers)


def convert(text: str) -> tuple[float, Dimension]:
    """How much SI one of the unit is, and its dimension: a printed figure is the SI value divided by it. Raises ``ModelProblem``."""
    size, dimension = unit(text)
    return float(size), dimension


def _literal(number: str, name: str) -> Unit:
    found = word(name)
    if found is None:
        near = nearest(name, _COMMON)
        hint = f"for a product write `{number}*{name}`" + (f"; or did you mean the unit `{near}`?" if near else "")
        raise ModelProblem(f"after the number {number} stands `{name}`, which is no unit", hint)
    return found


def _is_operator(name: str) -> bool:
    return name in ("and", "or", "not")


def _rounded(number: str, size: Fraction) -> float:
    """The product, rounded once; numbers of absurd exponents take the ordinary way."""
    value = float(number.replace(" ", ""))
    if value != 0 and not 1e-60 < abs(value) < 1e60:
        return value * float(size)
    return float(Fraction(number.replace(" ", "")) * size)


def _pieces(text: str) -> list[str] | None:
    pieces: list[str] = []
    at, text = 0, text.rstrip()
    while at < len(text):
        found = _PIECE.match(text, at)
        if not found:
            return None
        pieces.append(found[1])
        at = found.end()
    return pieces


class _Reader:
    """Reads ``kg*m^2/(s N)``; a space is a product. Every method gives None when the text is no unit."""

    def __init__(self, pieces: list[str]) -> None:
        self.pieces = pieces
        self.at = 0

    def next(self) -> str:
        return self.pieces[self.at] if self.at < len(self.pieces) else ""

    def take(self, *signs: str) -> str:
        piece = self.next()
        if piece not in signs:
            return ""
        self.at += 1
        return piece

    def product(self, until: str = "") -> Unit | None:
        total: Unit | None = self.power()
        while total is not None and self.next() != until:
            sign = self.take("*", "·", "/")
            factor = self.power()
            if factor is None:
                return None
            exponent = -1 if sign == "/" else 1
            total = Unit(total.size * factor.size**exponent, total.dimension.times(factor.dimension, exponent))
        return total

    def power(self) -> Unit | None:
        base = self.atom()
        if base is None:
            return None
        exponent = self.exponent()
        return None if exponent is None else Unit(base.size**exponent, base.dimension.to_the(exponent))

    def exponent(self) -> int | None:
        if squared := self.take("²", "³"):
            return 2 if squared == "²" else 3
        if not self.take("^", "**"):
            return 1
        sign = -1 if self.take("-") else 1
        digits = self.next()
        if not digits.isdecimal() or len(digits) > 2:
            return None
        self.at += 1
        return sign * int(digits)

    def atom(self) -> Unit | None:
        if self.take("("):
            inside = self.product(until=")")
            return inside if self.take(")") else None
        piece = self.next()
        if piece == "1" and self.at == 0:
            self.at += 1
            return Unit(Fraction(1), NUMBER_ONLY)  # of 1/s
        if not piece or not (piece[0].isalpha() or piece == "°"):
            return None
        self.at += 1
        return word(piece)
