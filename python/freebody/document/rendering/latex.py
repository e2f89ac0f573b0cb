"""Documents as a fragment of a LaTeX article; it needs amsmath, amssymb and graphicx."""

from __future__ import annotations

import re
from collections.abc import Sequence
from unicodedata import normalize

from freebody.document.blocks import Block, Figure, Paragraph, Words, pieces
from freebody.document.rendering.format import Format
from freebody.document.rendering.markup import TypesetMarkup, side_formula
from freebody.symbolic.formula import QUAD, Formula, Grid
from freebody.symbolic.printers.latex import ACCENTS, COMMANDS, ROW, aligned, beside, escaped, latex
from freebody.symbolic.printers.line_breaking import ROOM, lines, width

_SLACK = 2.5
"""Width, in em, that lists are indented, and that a line without a number beside it has more."""
_TALL = 12
"""Rows of an equation beyond which it may go on over the next page."""
_INLINE = 16.0
"""Width, in em, beyond which a formula in a list stands on lines of its own: TeX does not break it within brackets."""
_SIGNS = COMMANDS | {sign: f"_{digit}" for digit, sign in enumerate("₀₁₂₃₄₅₆₇₈₉")} | {"⁴": "^4", "⁻": "^-", "′": "'"}
_MARKS = {"\u0307": ACCENTS["˙"], "\u0308": ACCENTS["¨"]}


class Latex(TypesetMarkup):
    """A fragment of an article."""

    look = "blocks.tex.j2"

    def render(self, blocks: Sequence[Block]) -> str:
        # Formulas in sentences are hardly ever broken: spaces may be wide.
        lead = "\\emergencystretch=3em\n\n" if any(isinstance(block, Paragraph) for block in blocks) else ""
        return lead + super().render(blocks)

    def plain(self, text: str) -> str:
        return plain(text)

    def inline(self, formula: Formula) -> str:
        return f"${latex(formula)}$"

    def display(self, rows: Sequence[tuple[Formula, Formula]], label: str) -> str:
        tag, math = rf"\tag{{{label}}}" if label else r"\notag", aligned(rows)
        wide = max(width(before + after) for before, after in rows) > ROOM + _SLACK
        if wide or any(isinstance(part, Grid) for row in rows for side in row for part in side):
            math = _fitted(rf"$\displaystyle {math}$")
        elif len(rows) > _TALL:  # a page may end between them
            shown = beside(rows, rf" \notag{ROW}")
            return f"{{\\allowdisplaybreaks\n\\begin{{align}}\n{shown} {tag}\n\\end{{align}}}}"
        return f"\\begin{{equation}}\n{math} {tag}\n\\end{{equation}}"

    def item(self, words: Words) -> str:
        """A sentence of which a long formula stands below."""
        shown = (each if isinstance(each, str) else side_formula(each, self.nomenclature) for each in pieces(words))
        return "".join(
            self.plain(each) if isinstance(each, str) else self.inline(each) if width(each) <= _INLINE else _below(each)
            for each in shown
        )

    def figure(self, figure: Figure, caption: str) -> str:
        if not self.beside:
            return self.plain(f"[Figure: {figure.picture.description}]")
        shown = rf"\includegraphics{{{self.beside}-{figure.name}.pdf}}"
        return "\n".join([r"\begin{center}", _fitted(shown), *([r"\par " + caption] if caption else []), r"\end{center}"])


def plain(text: str) -> str:
    """A text that TeX prints as it is."""
    return re.sub("(?:\\w[\u0307\u0308]|[^\x00-\u024f])+", lambda signs: _signs(signs[0]), escaped(text))


def _fitted(shown: str) -> str:
    """What is wider than the line made smaller."""
    return rf"\resizebox{{\ifdim\width>\linewidth\linewidth\else\width\fi}}{{!}}{{{shown}}}"


def _below(formula: Formula) -> str:
    """A formula on lines below the words of a list."""
    room = ROOM - _SLACK
    first, *more = lines(formula, room)
    made = latex(first) if not more else aligned([((), first), *(((), (QUAD, *line)) for line in more)])
    if max(map(width, (first, *more))) > room:
        made = _fitted(rf"$\displaystyle {made}$")
    return f"\n\\[\n{made}\n\\]\n"


def _signs(signs: str) -> str:
    """Letters that TeX does not have in text: Greek, with dots, lowered digits, arrows; as they are where one is not known."""
    apart = "".join(normalize("NFD", sign) if "\u1e00" <= sign <= "\u1eff" else sign for sign in signs)
    made = [_sign(*found) for found in re.findall("(.)([\u0307\u0308]?)", apart)]
    return f"${' '.join(filter(None, made))}$" if all(made) else signs


def _sign(sign: str, mark: str) -> str | None:
    shown = _SIGNS.get(sign, sign if sign.isascii() else None)
    return rf"{_MARKS[mark]}{{{shown}}}" if shown and mark else shown


FORMAT = Format(
    "tex",
    "latex",
    "A fragment of LaTeX.",
    lambda blocks, nomenclature, beside: Latex(nomenclature, beside).render(blocks),
    figures=".pdf",
)
