r"""Formulas as LaTeX: ``\left(\tfrac{1}{4} m_1 + m_2\right) l^2 \ddot\theta_1 = -m_2 g l \sin\theta_1``. Needs amsmath."""

from __future__ import annotations

import re
from collections.abc import Sequence

from freebody.symbolic.alphabet import GREEK
from freebody.symbolic.formula import Accent, Atom, Formula, Fraction, Grid, Part, Root, Script

COMMANDS = {sign: rf"\{word}" for word, sign in GREEK.items()} | {
    "×": r"\times", "·": r"\cdot", "→": r"\to", "∞": r"\infty", "≤": r"\le", "≥": r"\ge", "√": r"\surd", "∂": r"\partial",
    "≠": r"\ne", "≈": r"\approx", "∑": r"\sum", "−": "-", "′": "'", "\u2009": r"\,", "\u2003": r"\quad ",
}  # fmt: skip
"""A sign, and how LaTeX writes it in mathematics."""
ACCENTS = {"˙": r"\dot", "¨": r"\ddot", "¯": r"\overline"}
ROW = " \\\\\n"
"""Between two rows of an equation."""
_COLUMNS = 10  # of a matrix of amsmath
_FUNCTIONS = ("sin", "cos", "tan", "ln", "exp")
_LEFT_RIGHT = {"opening": r"\left", "closing": r"\right"}


def latex(formula: Formula) -> str:
    """For mathematics mode, without dollars."""
    made = ""
    for part in formula:
        shown = _part(part)
        # A command ends where no letter follows.
        made += " " * (shown[:1].isalnum() and re.search(r"\\[a-zA-Z]+$", made) is not None) + shown
    return re.sub(r"  +", " ", made).strip()


def aligned(rows: Sequence[tuple[Formula, Formula]]) -> str:
    """An equation on one line or more, of which the second parts stand below each other."""
    if len(rows) == 1:
        return latex(sum(rows[0], ()))
    return "\\begin{aligned}\n" + beside(rows) + "\n\\end{aligned}"


def beside(rows: Sequence[tuple[Formula, Formula]], end: str = ROW) -> str:
    """The same, for an environment of aligned rows."""
    return end.join(f"{latex(before)} &{latex(after)}".lstrip() for before, after in rows)


def escaped(text: str) -> str:
    """Text for LaTeX, outside and inside of formulas."""
    words = {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}"}
    return "".join(words.get(sign, f"\\{sign}" if sign in "_%#&{}$" else sign) for sign in text)


def _part(part: Part) -> str:
    match part:
        case Atom():
            return _atom(part.text, part.kind)
        case Script(base, below, above):
            scripts = ((sign, latex(raised)) for sign, raised in (("_", below), ("^", above)) if raised)
            return latex(base) + "".join(sign + (shown if len(shown) == 1 else f"{{{shown}}}") for sign, shown in scripts)
        case Accent(inner, sign):
            shown = latex(inner)
            letter = re.fullmatch(r"(\\[a-zA-Z]+)|\w", shown) if sign != "¯" else None
            return ACCENTS[sign] + (f"{{{shown}}}" if not letter else shown if letter[1] else f" {shown}")
        case Fraction(above, below, small):
            return rf"\{'t' * small}frac{{{latex(above)}}}{{{latex(below)}}}"
        case Root(inner):
            return rf"\sqrt{{{latex(inner)}}}"
        case Grid(rows):
            body = ROW.join(" & ".join(map(latex, row)) for row in rows)
            across = len(rows[0]) if rows else 0
            if across > _COLUMNS:
                return f"\\left[\\begin{{array}}{{{'c' * across}}}\n{body}\n\\end{{array}}\\right]"
            return f"\\begin{{bmatrix}}\n{body}\n\\end{{bmatrix}}"


def _atom(text: str, kind: str) -> str:
    sign = COMMANDS.get(text, text)
    match kind:
        case "infix" | "relation":
            return f" {sign} "
        case "sign" | "space":
            return f" {sign} " if text in "·×\u2009" else sign
        case "function":
            return f"\\{text}" if text in _FUNCTIONS else rf"\operatorname{{{text}}}"
        case "word":
            return rf"\mathrm{{{escaped(text)}}}".replace(" ", r"\ ")
        case "label":
            return rf"\text{{{escaped(text)}}}"
        case "bold":
            return rf"\boldsymbol{{{sign}}}" if sign != text else rf"\mathbf{{{escaped(text)}}}"
        case "opening" | "closing":
            return _LEFT_RIGHT[kind] + text
        case "bigl" | "bigr" | "Bigl" | "Bigr":
            return f"\\{kind}{text}"
    return sign
