"""Units at the door: texts like ``400 mm`` or ``9.81 m/s^2`` become SI numbers with a dimension.

Angles are plain numbers in radians; that a number is an angle is remembered for display only.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from functools import cache, lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

from freebody.symbolic.dimensions import ANGLE, ENERGY, FORCE, LENGTH, MASS, NUMBER_ONLY, TIME, Dimension

from .errors import ModelProblem
from .names import NAME, NUMBER, nearest

if TYPE_CHECKING:
    import pint


class Unit(NamedTuple):
    """A unit: its size in SI, exactly, and its dimension."""

    size: Fraction
    dimension: Dimension

    def times(self, other: Unit, power: int = 1) -> Unit:
        """The product with a power of another."""
        return Unit(self.size * other.size**power, self.dimension.times(other.dimension, power))


class Quantity(NamedTuple):
    """A number in SI with its dimension and the unit as it was written."""

    value: float
    dimension: Dimension
    unit: str


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
    "rpm": Unit(Fraction(math.pi) / 30, Dimension(0, 0, -1, 1)),
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
COMMON = (
    *("m", "mm", "cm", "km", "in", "ft", "yd", "kg", "g", "mg", "t", "lb", "lbm", "oz", "slug", "s", "ms", "min", "h"),
    *("rad", "deg", "rev", "N", "kN", "mN", "lbf", "kgf", "J", "kJ", "W", "kW", "hp", "Pa", "kPa", "MPa", "bar", "psi"),
    *("Hz", "rpm", "mph"),
)
"""Those that a slip of the pen may mean, and that are read where a symbol has their name."""
_NO_UNITS = {"c", "pi", "tau", "e", "G", "speed_of_light", "count", "percent", "ppm"}

_FUNCTION_OR_GREEK = re.compile(r"(?:sin|cos|tan|sqrt)\Z|[α-ωϑ-ϖΑ-Ψ](?<!μ)")
_NUMBER = re.compile(rf"\s*([+-]?\s*{NUMBER})\s*")
_WORD = r"[^\W\d²³][^\W²³]*|°"
_PIECE = re.compile(rf"{_WORD}|(?:\^|\*\*)\s*-?\s*\d{{1,2}}(?!\d)|\S")
_NUMBERED = re.compile(rf"{NAME}|(?P<number>{NUMBER})")
_FACTOR = re.compile(
    rf"\s*(?P<sign>[*/·]?)\s*(?P<word>{_WORD})(?![^\W²³])(?P<power>[²³]|\s*(?:\^|\*\*)\s*-?\s*\d{{1,2}}(?![\w.]))?(?!\s*[(\[.'])"
)
_INVERSE = re.compile(r"\s+1\s*(?=/)")
_CALLED = re.compile(r"([^\W\d]\w*)\(")
_WITH_TIME = re.compile(r"[*/·\s]t(?!\w)")
_TIMES = {"s", "ms", "min"}
"""Over one of which a number is a rate: ``10/s``."""
_EXPONENT = str.maketrans("²³", "23", "^* ")


@cache
def _registry() -> pint.UnitRegistry[Fraction]:
    import pint

    # `pi` becomes that of floating point, so that 30 deg is pi/6 to the last bit
    registry = pint.UnitRegistry(non_int_type=Fraction, on_redefinition="ignore")
    for line in _MORE:
        registry.define(line)
    return registry


@cache
def word(text: str) -> Unit | None:
    """The unit of one word, e.g. ``mm``; None when there is none of mechanics."""
    return _EVERYDAY.get(text) or registered(text)


def registered(text: str) -> Unit | None:
    """The unit of one word as the registry knows it."""
    if text in _NO_UNITS or _FUNCTION_OR_GREEK.match(text) or not (text.isidentifier() or text == "°"):
        return None  # without the registry, which takes a second to load
    try:
        unit = _registry().Quantity(Fraction(1), "degree" if text == "°" else text).to_base_units()
    except (AttributeError, TypeError, ValueError, ArithmeticError):
        return None  # a word that the registry does not know, or a unit with an offset or a logarithm
    powers = {str(k): v for k, v in unit.unit_items()}
    known = {"meter": "length", "kilogram": "mass", "second": "time", "radian": "angle"}
    if not powers or set(powers) - set(known) or any(v != int(v) for v in powers.values()):
        return None
    return Unit(Fraction(unit.magnitude), Dimension(**{known[k]: int(v) for k, v in powers.items()}))


@cache
def unit(text: str) -> Unit:
    """The unit of a text like ``kg*m^2/s``, ``N m`` or empty. Raises ``ModelProblem``."""
    pieces = _PIECE.findall(text)
    try:
        rest = pieces[1:] if pieces[:2] == ["1", "/"] else list(pieces)
        found = _product(rest)
        if not rest:
            return found
    except LookupError:
        pass
    unknown = [piece for piece in pieces if piece[0].isalpha() and word(piece) is None]
    near = nearest(unknown[0], COMMON) if unknown else None
    what = f"there is no unit `{unknown[0]}`" if unknown else f"`{text}` is no unit"
    raise ModelProblem(what, f"did you mean `{near}`?" if near else "units look like `mm`, `N*m`, `kg*m^2`, `m/s^2`, `deg`")


def _product(pieces: list[str]) -> Unit:
    """The product at the head of the pieces, which are taken off; a space is a product, too. Raises ``LookupError``."""
    total = Unit(Fraction(1), NUMBER_ONLY)
    while pieces and pieces[0] != ")":
        sign = -1 if pieces[0] == "/" else 1
        if pieces[0] in ("*", "·", "/"):
            pieces.pop(0)
        head = pieces.pop(0)
        base = _product(pieces) if head == "(" else word(head)
        if base is None or (head == "(" and pieces.pop(0) != ")"):
            raise LookupError(head)
        digits = pieces[0].translate(_EXPONENT) if pieces and pieces[0][0] in "²³^*" else ""
        if digits:
            pieces.pop(0)
        total = total.times(base, sign * int(digits or 1))
    return total


@lru_cache(maxsize=4096)
def quantity(text: str) -> Quantity | None:
    """The quantity that the whole text is, or None when it must be read as an expression.

    Raises ``ModelProblem`` when a number stands with one word that is no unit.
    """
    found = _NUMBER.match(text)
    written = text[found.end() :].strip() if found else ""
    if not found or not (written[:1].isalpha() or written[:1] == "°") or _WITH_TIME.search(written):
        return None
    if set(_CALLED.findall(written)) - set(COMMON):
        return None  # a function, for which the registry need not be read
    try:
        size, dimension = unit(written)
    except ModelProblem:
        if len(_PIECE.findall(written)) == 1:
            raise
        return None
    return Quantity(rounded(found[1], size), dimension, written)


class Rewritten(NamedTuple):
    """An expression without units: its text in SI and the dimension of each number in it, in order (None: bare)."""

    text: str
    numbers: list[Dimension | None]


def rewrite(text: str, known: Callable[[str], bool] = lambda _: False) -> Rewritten:
    """The expression with each number and the unit that follows it (``30 deg``, ``2 m/s``, ``10 1/s``) in SI.

    Where a word of the unit is ``known`` as a name of the model, too, the text says nothing certain. Raises ``ModelProblem``."""
    out: list[str] = []
    numbers: list[Dimension | None] = []
    at = 0
    while found := _NUMBERED.search(text, at):
        number, before = found["number"], text[: found.start()].rstrip()[-1:]
        out.append(text[at : found.start()])
        at = found.end()
        if number is None:
            out.append(found[0])
            continue
        read, end = _unit_after(number, text, at, known, before in ("/", "^"))
        if read and before in ("/", "^"):
            shown = text[found.start() : end]
            hint = f"write `{before}({shown})` with the unit inside, or name the number under `parameters`"
            raise ModelProblem(f"`{before}{shown}` can be read in two ways", hint)
        numbers.append(read and read.dimension)
        out.append(repr(rounded(number, read.size)) if read else number)
        at = end
    return Rewritten("".join(out) + text[at:], numbers)


def _unit_after(number: str, text: str, start: int, known: Callable[[str], bool], divides: bool) -> tuple[Unit | None, int]:
    """The unit that follows a number in an expression, and where it ends."""
    total: Unit | None = None
    inverse = _INVERSE.match(text, start)
    at = inverse.end() if inverse else start
    while found := _FACTOR.match(text, at):
        sign, name = found["sign"], found["word"]
        if name in ("and", "or", "not") or (sign and name == "t"):  # t is the time, and 2 t are two tonnes
            break
        if total is None and not sign and word(name) is None:
            near = nearest(name, COMMON)
            hint = f"for a product write `{number}*{name}`" + (f"; or did you mean the unit `{near}`?" if near else "")
            raise ModelProblem(f"after the number {number} stands `{name}`, which is no unit", hint)
        rate = sign == "/" and name in _TIMES and not divides and not known(name)  # 10/s
        if not (rate or inverse or not sign if total is None else sign) or (unit := word(name)) is None:
            break
        if known(name) and (total or inverse):
            shown = text[start : found.end()].strip()
            other = f"{number}/{name}" if total is None else f"({number}{text[start:at]}){text[at : found.end()].strip()}"
            hint = (
                f"for the name write `{other}`, or call it otherwise; a unit alone stands in a parameter, `v: {number} {shown}`"
            )
            raise ModelProblem(f"in `{number} {shown}`, `{name}` is a unit and a name of the model", hint)
        power = int(found["power"].translate(_EXPONENT)) if found["power"] else 1
        total = (total or Unit(Fraction(1), NUMBER_ONLY)).times(unit, -power if sign == "/" else power)
        at = found.end()
    return (total, at) if total else (None, start)


def convert(text: str) -> tuple[float, Dimension]:
    """How much SI one of the unit is, and its dimension: a printed figure is the SI value divided by it. Raises ``ModelProblem``."""
    size, dimension = unit(text)
    return float(size), dimension


def rounded(number: str, size: Fraction) -> float:
    """The number of a text times the size of its unit, rounded once; numbers of absurd exponents take the ordinary way.

    Raises ``ModelProblem``, and ``ValueError`` where the text is no number."""
    value = float(number.replace(" ", ""))
    if math.isinf(value * float(size)):
        raise ModelProblem(f"`{number}` is too large a number", "the largest is 1.79e308")
    if value != 0 and not 1e-60 < abs(value) < 1e60:
        return value * float(size)
    return float(Fraction(number.replace(" ", "")) * size)


def many_turns(name: str, angle: Any) -> dict[str, str]:
    """What is worth saying, by its name, of a bare number that stands for an angle and may have been meant in degrees."""
    try:
        size = float(angle)
    except (TypeError, ValueError):
        return {}
    said = f"{name} = {size:g} rad is {abs(size) / math.tau:.3g} turns; for degrees write `{size:g} deg`"
    return {name: said} if math.tau < abs(size) < math.inf else {}
