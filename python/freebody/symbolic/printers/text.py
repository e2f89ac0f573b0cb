"""Equations as plain text, as a textbook prints them: ``(¼ m₁ + m₂) l² θ̈₁ = −m₂ g l sin θ₁``."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import ClassVar

from freebody.symbolic.alphabet import columns
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.printers import layout
from freebody.symbolic.printers.line_breaking import broken
from freebody.symbolic.printers.printer import Printer
from freebody.symbolic.symbols import SUBSCRIPTS, SUPERSCRIPTS, Name, ascii_name, unicode_name
from freebody.symbolic.tree import Fn, Num, Pow, Sym, Tree

WIDTH = 100
_VULGAR = {Fraction(unicodedata.numeric(sign)).limit_denominator(8): sign for sign in "½⅓⅔¼¾⅕⅖⅗⅘⅙⅚⅛⅜⅝⅞"}
_MOST = 99
"""The largest numerator and denominator of a fraction in small figures, ¹⁄₁₂."""


def text(tree: Tree, nomenclature: Nomenclature | None = None, *, ascii: bool = False) -> str:
    """The expression on one line; ``ascii`` spells Greek letters and writes primes for dots."""
    return printer(nomenclature, ascii).expression(tree)


def equation_text(
    left: Tree, right: Tree, nomenclature: Nomenclature | None = None, *, ascii: bool = False, width: int = WIDTH
) -> str:
    """``left = right``, broken at plus and minus signs to lines of at most ``width`` columns where that is possible."""
    return sides_text(*(text(side, nomenclature, ascii=ascii) for side in (left, right)), width)


def sides_text(first: str, second: str, width: int = WIDTH) -> str:
    """Two printed sides as an equation, broken likewise."""
    if columns(whole := f"{first} = {second}") <= width:
        return whole
    if columns(first) <= width // 3:
        return folded(f"{first} = ", second, width)
    return folded("    ", first, width).removeprefix("    ") + "\n" + folded("  = ", second, width)


def folded(lead: str, line: str, width: int = WIDTH) -> str:
    """``lead`` and ``line``, broken before plus and minus signs, outside of brackets where that will do."""
    room = width - columns(lead)
    return lead + f"\n{' ' * columns(lead)}".join(broken(line, room, room, columns, _split, str.lstrip))


def _split(line: str, wanted: float) -> Iterator[str]:
    """The parts of the line between its ` + ` and ` − ` that stand in at most ``wanted`` brackets."""
    depth = start = 0
    for place, sign in enumerate(line):
        depth += (sign in "([") - (sign in ")]")
        if depth <= wanted and place > start and line[place : place + 3] in (" + ", " − ", " - "):
            yield line[start:place]
            start = place
    yield line[start:]


def printer(nomenclature: Nomenclature | None, ascii: bool = False) -> TextPrinter:
    """What prints with some symbols."""
    return (AsciiPrinter if ascii else TextPrinter)(nomenclature or Nomenclature())


@dataclass(frozen=True)
class TextPrinter(Printer[str]):
    """Unicode."""

    plus, minus, negative, comma, cross = " + ", " − ", "−", ", ", " × "
    times: ClassVar[str] = "·"
    """The sign of multiplication, where one is needed."""

    def name(self, symbol: Sym) -> str:
        written = self.nomenclature.written(symbol.name)
        return written.unicode(symbol.dots) if written else unicode_name(symbol.name, symbol.dots)

    def direction(self, name: str | Name) -> str:
        return name if isinstance(name, str) else name.unicode()

    def ends_below(self, shown: str) -> bool:
        return re.search(r"/([^()]+|\([^()]+\))$", shown) is not None

    def number(self, value: Fraction | float | int) -> str:
        if not isinstance(value, float):
            return self._vulgar(Fraction(value)) or str(value)
        if math.isinf(value):
            return "∞"
        mantissa, _, exponent = f"{value:.10g}".partition("e")
        return f"{mantissa}×10{str(int(exponent)).translate(SUPERSCRIPTS)}" if exponent else mantissa

    def product(self, number: Fraction | float, factors: Sequence[Tree]) -> str:
        if isinstance(number, float) or number.denominator == 1:
            return self._factors(number, factors)
        # In front in small figures, ½ m l²; else what is below stands behind, m l²/12, as it does in angles, π/2, but not behind
        # functions: (3/2) m g l sin θ.
        vulgar = "" if list(factors) == [Sym("pi")] else self._vulgar(number)
        if vulgar or not factors:
            return self.juxtapose([vulgar or str(number), *map(self._factor, factors)])
        if any(isinstance(factor.base if isinstance(factor, Pow) else factor, Fn) for factor in factors):
            return self.juxtapose([self.bracket(str(number)), *map(self._factor, factors)])
        ends_bare = layout.is_bare(factors[-1])
        return self.fraction(self._factors(number.numerator, factors), str(number.denominator), ends_bare, False)

    def juxtapose(self, factors: Sequence[str]) -> str:
        # Behind a factor a number would be taken for a part of it.
        return factors[0] + "".join(f"{self.times if factor[0].isdecimal() else ' '}{factor}" for factor in factors[1:])

    def bracket(self, inner: str) -> str:
        return f"({inner})"

    def fraction(self, above: str, below: str, ends_bare: bool, several: bool) -> str:
        # Without brackets sin θ/l could be the sine of θ/l.
        return f"{self.bracket(above) if ends_bare else above}/{self.bracket(below) if several else below}"

    def raised(self, base: str, exponent: Fraction) -> str:
        return (self.bracket(base) if base.endswith(("′", "'")) else base) + self._exponent(exponent)

    def root(self, tree: Tree) -> str:
        inner = self.expression(tree)
        return f"√{inner}" if isinstance(tree, Sym | Num) else f"√({inner})"

    def function(self, tree: Fn, exponent: Fraction) -> str:
        inner = self.arguments(tree)
        if tree.name == "abs" and "|" not in inner:
            return f"|{inner}|" + (self._exponent(exponent) if exponent != 1 else "")
        name = tree.name + (self._exponent(exponent) if exponent != 1 else "")
        return f"{name}{'' if exponent != 1 else ' '}{inner}" if layout.is_bare(tree) else f"{name}({inner})"

    def _exponent(self, exponent: Fraction) -> str:
        return str(exponent).translate(SUPERSCRIPTS) if exponent.denominator == 1 else f"^({exponent})"

    def _vulgar(self, value: Fraction) -> str:
        above, below = value.as_integer_ratio()
        if value in _VULGAR or below == 1 or max(above, below) > _MOST:
            return _VULGAR.get(value, "")
        return f"{str(above).translate(SUPERSCRIPTS)}⁄{str(below).translate(SUBSCRIPTS)}"


@dataclass(frozen=True)
class AsciiPrinter(TextPrinter):
    """Letters of ASCII alone."""

    minus, negative, times = " - ", "-", "*"

    def name(self, symbol: Sym) -> str:
        written = self.nomenclature.written(symbol.name)
        return ascii_name(written.ascii() if written else symbol.name, symbol.dots)

    def number(self, value: Fraction | float | int) -> str:
        return f"{value:.10g}" if isinstance(value, float) else str(value)

    def fraction(self, above: str, below: str, ends_bare: bool, several: bool) -> str:
        return super().fraction(above, below, False, several)

    def root(self, tree: Tree) -> str:
        return f"sqrt({self.expression(tree)})"

    def function(self, tree: Fn, exponent: Fraction) -> str:
        call = f"{tree.name}({', '.join(map(self.expression, tree.args))})"
        return call if exponent == 1 else f"{call}^{exponent}"

    def _exponent(self, exponent: Fraction) -> str:
        return f"^{exponent}" if exponent.denominator == 1 and exponent > 0 else f"^({exponent})"

    def _vulgar(self, value: Fraction) -> str:
        return ""
