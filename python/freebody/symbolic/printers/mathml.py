"""Formulas as MathML, which browsers typeset by themselves: θ̈₁ is ``<msub><mover>…</mover><mn>1</mn></msub>``."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

from freebody.symbolic.formula import Accent, Atom, Formula, Fraction, Grid, Part, Root, Script, split

_SIGNS = ("infix", "relation")
_BARE = {"φ": "ϕ"}  # as TeX draws it
_ATOMS = {
    "number": "<mn>{}</mn>",
    "word": '<mi mathvariant="normal">{}</mi>', "label": '<mi mathvariant="normal">{}</mi>',
    "infix": '<mo form="infix">{}</mo>', "relation": '<mo form="infix">{}</mo>', "prefix": '<mo form="prefix">{}</mo>',
    "sign": "<mo>{}</mo>", "open": '<mo stretchy="false">{}</mo>', "close": '<mo stretchy="false">{}</mo>',
    "opening": '<mo stretchy="true">{}</mo>', "closing": '<mo stretchy="true">{}</mo>',
    "function": '<mo form="prefix" lspace=".17em" rspace=".17em">{}</mo>', "letter": "<mi>{}</mi>", "bold": "<mi>{}</mi>",
}  # fmt: skip
_SPACES = {"\u2009": '<mspace width=".17em"/>', "\u2003": '<mspace width="1em"/>'}
_BOLD = (("a", 0x1D41A), ("A", 0x1D400), ("α", 0x1D736))


def mathml(parts: Iterable[Part], style: str = "") -> str:
    """A formula in a sentence."""
    inner = "".join(map(_part, parts))
    return f"<math{style}>{inner}</math>" if inner else ""


def broken(parts: Sequence[Part], depth: int = 0) -> str:
    """A formula on lines of its own: a browser breaks it before =, + and −, within brackets (``depth``) only where it must."""
    return "".join(
        f"<span>{broken(term, depth + 1)}</span>"
        if any(isinstance(part, Atom) and part.kind in _SIGNS for part in term[1:])
        else mathml(term, ' displaystyle="true"')
        for term in split(parts, depth, _SIGNS)
    )


def _row(formula: Formula) -> str:
    """What stands in one place."""
    shown = list(filter(None, map(_part, formula)))
    return shown[0] if len(shown) == 1 else f"<mrow>{''.join(shown)}</mrow>"


def _part(part: Part) -> str:
    match part:
        case Atom(text, "space"):
            return _SPACES.get(text, "")
        case Atom(text, kind):
            shown = "".join(map(_bold, text)) if kind == "bold" else _BARE.get(text, text)
            return _ATOMS[kind].format(escape(shown, quote=False))
        case Script(base, below, above):
            tag = f"m{'sub' * bool(below)}{'sup' * bool(above)}"
            return f"<{tag}>{''.join(_row(each) for each in (base, below, above) if each)}</{tag}>"
        case Accent(inner, sign):
            return f'<mover accent="true">{_row(inner)}<mo stretchy="{"true" if sign == "¯" else "false"}">{sign}</mo></mover>'
        case Fraction(above, below, small):
            style = ' displaystyle="false"' if small else ""
            return f"<mfrac{style}>{_row(above)}{_row(below)}</mfrac>"
        case Root(inner):
            return f"<msqrt>{_row(inner)}</msqrt>"
        case Grid(rows):
            cells = ((f"<mtd>{''.join(map(_part, cell))}</mtd>" for cell in row) for row in rows)
            lines = (f"<mtr>{''.join(row)}</mtr>" for row in cells)
            return f"<mrow><mo>[</mo><mtable>{''.join(lines)}</mtable><mo>]</mo></mrow>"


def _bold(letter: str) -> str:
    """The bold letter of mathematics, upright for Latin letters."""
    steps = ((ord(letter) - ord(first), start) for first, start in _BOLD)
    return next((chr(start + step) for step, start in steps if 0 <= step < 26), letter)
