r"""Equations as LaTeX: ``\left(\tfrac{1}{4} m_1 + m_2\right) l^2 \ddot\theta_1 = -m_2 g l \sin\theta_1``. Needs amsmath."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from freebody.symbolic import layout
from freebody.symbolic.letters import Letters
from freebody.symbolic.printers import line_breaking
from freebody.symbolic.printers.line_breaking import ROOM
from freebody.symbolic.printers.printer import Printer
from freebody.symbolic.symbols import latex_name, upright
from freebody.symbolic.tree import Entries, Fn, Sym, Tree

ROW = " \\\\\n"
"""Between two rows of an equation."""
_MATRIX = 10  # columns of a matrix of amsmath
_KNOWN = {"sin": r"\sin", "cos": r"\cos", "tan": r"\tan", "ln": r"\ln", "exp": r"\exp", "atan2": r"\operatorname{atan2}",
          "sign": r"\operatorname{sign}"}  # fmt: skip


def latex(tree: Tree, letters: Letters | None = None) -> str:
    """The expression as LaTeX for mathematics mode, without dollars."""
    return LatexPrinter(letters or Letters()).expression(tree)


def equation_latex(left: Tree, right: Tree, letters: Letters | None = None, *, room: float = ROOM) -> str:
    """``left = right`` for mathematics mode; what would print wider than ``room`` em is ``aligned`` over lines."""
    return sides_latex(latex(left, letters), latex(right, letters), room=room)


def sides_latex(left: str, right: str, *, room: float = ROOM) -> str:
    """Two sides as an equation, on one line or ``aligned`` over several: ``= …`` stands beside a left side that is short."""
    whole = f"{left} = {right}"
    if line_breaking.width(whole) <= room:
        return whole
    before = line_breaking.width(f"{left} =")
    if before <= room / 3:
        first, *more = line_breaking.lines(right, room - before)
        return aligned([rf"{left} &= {first}", *(rf"&\quad {line}" for line in more)])
    above, below = line_breaking.lines(left, room), line_breaking.lines(right, room - line_breaking.width("="))
    return aligned([*_indented(above), *_indented([f"= {below[0]}", *below[1:]])])


def _indented(lines: Sequence[str]) -> list[str]:
    return [f"&{lines[0]}", *(rf"&\quad {line}" for line in lines[1:])]


def aligned(rows: Sequence[str]) -> str:
    """Rows of which each has one place to stand below the others."""
    return "\\begin{aligned}\n" + ROW.join(rows) + "\n\\end{aligned}"


def matrix_latex(entries: Entries, letters: Letters | None = None) -> str:
    """A vector (as a column) or a matrix of trees."""
    printer = LatexPrinter(letters or Letters())
    rows = [row if isinstance(row, Sequence) else [row] for row in entries]
    body = " \\\\\n".join(" & ".join(map(printer.expression, row)) for row in rows)
    across = len(rows[0]) if rows else 0
    if across > _MATRIX:
        return f"\\left[\\begin{{array}}{{{'c' * across}}}\n{body}\n\\end{{array}}\\right]"
    return f"\\begin{{bmatrix}}\n{body}\n\\end{{bmatrix}}"


@dataclass(frozen=True)
class LatexPrinter(Printer):
    """LaTeX with amsmath."""

    minus = "-"

    def name(self, letter: Sym) -> str:
        written = self.letters.written(letter.name)
        if written:
            return written.latex(letter.dots)
        return latex_name(letter.name, letter.dots, reaction=self.letters.kind(letter.name) == "unknown")

    def number(self, value: Fraction | float | int) -> str:
        if not isinstance(value, float):
            value = Fraction(value)
            return str(value) if value.denominator == 1 else rf"\tfrac{{{value.numerator}}}{{{value.denominator}}}"
        if math.isinf(value):
            return r"\infty"
        mantissa, _, exponent = f"{value:.10g}".partition("e")
        return rf"{mantissa} \cdot 10^{{{int(exponent)}}}" if exponent else mantissa

    def rational(self, value: Fraction, factors: Sequence[Tree]) -> str:
        return self._factors(value, factors)

    def juxtapose(self, factors: Sequence[str]) -> str:
        made = factors[0]
        for left, right in itertools.pairwise(factors):
            word = any(re.match(r"\\(mathrm|d*ot\{)", side) for side in (left, right))
            made += (r" \cdot " if right[0].isdecimal() else r" \, " if word else " ") + right
        return made

    def bracket(self, inner: str) -> str:
        return rf"\left({inner}\right)" if r"frac" in inner else f"({inner})"

    def numerator(self, tree: Tree) -> str:
        return self.expression(tree)

    def fraction(self, above: str, below: str, ends_bare: bool, several: bool) -> str:
        return rf"\frac{{{above}}}{{{below}}}"

    def can_stand_apart(self, number: int, below: Sequence[Tree]) -> bool:
        return True

    def apart(self, above: str, below: str) -> str:
        return rf"\frac{{{above}}}{{{below}}}"

    def raised(self, base: str, exponent: Fraction) -> str:
        shown = str(exponent)
        return f"{base}^{shown}" if len(shown) == 1 else f"{base}^{{{shown}}}"

    def root(self, tree: Tree) -> str:
        return rf"\sqrt{{{self.expression(tree)}}}"

    def function(self, tree: Fn, exponent: Fraction) -> str:
        inner = self.arguments(tree)
        raised = "" if exponent == 1 else f"^{exponent}" if exponent < 10 else f"^{{{exponent}}}"
        if tree.name == "abs":
            return rf"\left|{inner}\right|{raised}"
        name = _KNOWN.get(tree.name, upright(tree.name)) + raised
        if layout.is_bare(tree):
            return f"{name}{'' if inner.startswith(chr(92)) else ' '}{inner}"
        return name + self.bracket(inner)
