"""Documents as Markdown, LaTeX and HTML: mathematics is LaTeX, in HTML the same as MathML."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar
from unicodedata import normalize

import markupsafe

from freebody.document.blocks import (
    Block,
    Bullets,
    Equation,
    Figure,
    Heading,
    Matrices,
    MatrixEquation,
    Paragraph,
    Side,
    Table,
    Vector,
    Words,
    Written,
    pieces,
)
from freebody.document.rendering.matrices import Named, fitted, has_matrices
from freebody.document.templates import template
from freebody.symbolic.letters import Letters
from freebody.symbolic.printers import line_breaking
from freebody.symbolic.printers.latex import ROW, LatexPrinter, aligned, latex, matrix_latex, sides_latex
from freebody.symbolic.printers.mathml import broken, mathml
from freebody.symbolic.symbols import GREEK, SPELT, escaped, latex_name
from freebody.symbolic.tree import Add, Tree, is_zero

_ACROSS = 80
"""Columns of text that an equation of matrices may take."""
_SLACK = 2.5
"""Width, in em, that lists are indented, and that a line without a number beside it has more."""
_TALL = 12
"""Rows of an equation from which on it may go on over the next page."""
_INLINE = 16.0
"""Width, in em, beyond which a formula in a list stands on lines of its own: TeX does not break it within brackets."""


def side_latex(side: Side, letters: Letters) -> str:
    """One side of an equation, or mathematics in a sentence."""
    if isinstance(side, Written):
        return side.latex
    if isinstance(side, Matrices):
        return " ".join(matrix_latex(matrix.rows, letters) for matrix in side.factors)
    if isinstance(side, Vector):
        parts = [_component(tree, direction, letters) for tree, direction in side.components if not is_zero(tree)]
        return " + ".join(parts).replace("+ -", "- ") or "0"
    return latex(side, letters)


def _component(tree: Tree, direction: str, letters: Letters) -> str:
    inner = latex(tree, letters)
    stem, _, below = direction.partition("_")
    letter = rf"\boldsymbol{{\{SPELT[stem]}}}" if stem in SPELT else rf"\mathbf{{{escaped(stem)}}}"
    unit = letter + (f"_{{{latex_subscript(below)}}}" if below else "")
    if isinstance(tree, Add):
        return f"{LatexPrinter(letters).bracket(inner)} {unit}"
    return unit if inner == "1" else f"-{unit}" if inner == "-1" else rf"{inner} \, {unit}"


def latex_subscript(text: str) -> str:
    """A subscript: Greek words as letters."""
    return latex_name(text) if re.fullmatch(r"\w+", text) else escaped(text)


@dataclass(frozen=True)
class Markup(ABC):
    """What the three have in common. ``beside``: how the names of figures' files begin; empty where there are none."""

    letters: Letters
    beside: str = ""
    named: Named = field(default_factory=Named)
    text: ClassVar[type[str]] = str
    """Of what is made: text, or text that knows that it is markup already."""

    def render(self, blocks: Sequence[Block]) -> str:
        """All blocks."""
        return self.text("\n\n").join(map(self.block, blocks)) + "\n"

    def block(self, block: Block) -> str:
        """One block."""
        match block:
            case Heading(words, level):
                return self.heading(self.words(words), level)
            case Paragraph(words):
                return self.paragraph(self.words(words))
            case Equation() | MatrixEquation() if has_matrices(block):
                return self.matrices(block)
            case Equation():
                return self.stated(block, self.equation(block))
            case Bullets(items):
                return self.bullets([self.item(item) for item in items])
            case Table():
                rows = [[self.words(cell) for cell in row] for row in (block.heads, *block.rows)]
                return self.table(rows[0], rows[1:], self.words(block.caption))
            case Figure():
                return self.figure(block, self.words(block.caption))

    def words(self, words: Words) -> str:
        """A sentence with its mathematics."""
        return self.text().join(
            self.plain(piece) if isinstance(piece, str) else self.inline(side_latex(piece, self.letters))
            for piece in pieces(words)
        )

    def item(self, words: Words) -> str:
        """A sentence of a list."""
        return self.words(words)

    def matrices(self, block: Equation | MatrixEquation) -> str:
        """An equation of matrices, and below it the entries that have names."""
        made, letters = fitted(block, self.letters, _ACROSS)
        writer = replace(self, letters=letters)
        parts = [writer.stated(e, writer.whole(e)) if has_matrices(e) else writer.block(e) for e in self.named.news(made)]
        return self.text("\n\n").join(parts)

    def whole(self, block: Equation) -> str:
        """LaTeX of an equation on one line."""
        return " = ".join(side_latex(side, self.letters) for side in (block.left, block.right))

    def equation(self, block: Equation) -> str:
        """LaTeX of an equation."""
        return sides_latex(*(side_latex(side, self.letters) for side in (block.left, block.right)))

    def stated(self, block: Equation, body: str) -> str:
        """An equation between its name and its note."""
        name, note = self.words(block.name), self.words(block.note)
        named = name if not name or name.endswith((":", ".")) else name + ":"
        parts = [self.paragraph(named) if named else "", self.display(body, block.label), self.paragraph(note) if note else ""]
        return self.text("\n\n").join(filter(None, parts))

    @abstractmethod
    def plain(self, text: str) -> str:
        """Text with the signs of the markup escaped."""

    @abstractmethod
    def inline(self, math: str) -> str:
        """Mathematics in a sentence."""

    @abstractmethod
    def display(self, math: str, label: str) -> str:
        """Mathematics on lines of its own."""

    @abstractmethod
    def heading(self, title: str, level: int) -> str:
        """A heading."""

    @abstractmethod
    def paragraph(self, words: str) -> str:
        """A paragraph."""

    @abstractmethod
    def bullets(self, items: Sequence[str]) -> str:
        """A list."""

    @abstractmethod
    def table(self, heads: Sequence[str], rows: Sequence[Sequence[str]], caption: str) -> str:
        """A table."""

    @abstractmethod
    def figure(self, figure: Figure, caption: str) -> str:
        """A picture."""


class Markdown(Markup):
    """Markdown with dollars."""

    def plain(self, text: str) -> str:
        return re.sub(r"([\\`*_\[\]<>$#|])", r"\\\1", text)

    def inline(self, math: str) -> str:
        return f"${math}$"

    def display(self, math: str, label: str) -> str:
        return f"$$\n{math}{f' {chr(92)}tag{{{label}}}' if label else ''}\n$$"

    def heading(self, title: str, level: int) -> str:
        return f"{'#' * level} {title}"

    def paragraph(self, words: str) -> str:
        return words

    def bullets(self, items: Sequence[str]) -> str:
        return "\n".join(f"- {item}" for item in items)

    def table(self, heads: Sequence[str], rows: Sequence[Sequence[str]], caption: str) -> str:
        lines = [f"| {' | '.join(row)} |" for row in (heads, ["---"] * len(heads), *rows)]
        return "\n".join(([caption, ""] if caption else []) + lines)

    def figure(self, figure: Figure, caption: str) -> str:
        if not self.beside:
            return self.paragraph(self.plain(f"[Figure: {figure.picture.description}]"))
        return f"![{self.plain(figure.picture.description)}](<{self.beside}-{figure.name}.svg>)\n\n{caption}"


class Latex(Markup):
    """A fragment of an article."""

    _SECTIONS = ("section", "subsection", "subsubsection", "paragraph")

    def render(self, blocks: Sequence[Block]) -> str:
        # Formulas in sentences are hardly ever broken: spaces may be wide.
        lead = "\\emergencystretch=3em\n\n" if any(isinstance(block, Paragraph) for block in blocks) else ""
        return lead + super().render(blocks)

    def plain(self, text: str) -> str:
        return re.sub("(?:\\w[\u0307\u0308]|[^\x00-\u024f])+", lambda signs: _signs(signs[0]), escaped(text))

    def inline(self, math: str) -> str:
        return f"${math}$"

    def display(self, math: str, label: str) -> str:
        tag = rf"\tag{{{label}}}" if label else r"\notag"
        rows = re.sub(r"\\(begin|end)\{aligned\}|&", "", math).split(ROW)
        if "matrix" in math or "{array}" in math or max(map(line_breaking.width, rows)) > line_breaking.ROOM + _SLACK:
            math = _fitted(rf"$\displaystyle {math}$")
        elif math.startswith(r"\begin{aligned}") and math.count(ROW) >= _TALL:
            return _over_pages(math, tag)
        return f"\\begin{{equation}}\n{math} {tag}\n\\end{{equation}}"

    def heading(self, title: str, level: int) -> str:
        return rf"\{self._SECTIONS[min(level, 4) - 1]}*{{{title}}}"

    def paragraph(self, words: str) -> str:
        return words

    def item(self, words: Words) -> str:
        """A sentence of which a long formula stands below."""
        shown = [p if isinstance(p, str) else side_latex(p, self.letters) for p in pieces(words)]
        return "".join(
            self.plain(made)
            if isinstance(piece, str)
            else self.inline(made)
            if line_breaking.width(made) <= _INLINE
            else _below(made)
            for piece, made in zip(pieces(words), shown, strict=True)
        )

    def bullets(self, items: Sequence[str]) -> str:
        return "\n".join([r"\begin{itemize}\sloppy", *(rf"\item {item}" for item in items), r"\end{itemize}"])

    def table(self, heads: Sequence[str], rows: Sequence[Sequence[str]], caption: str) -> str:
        body = [" & ".join(row) + r" \\" for row in rows]
        top = [rf"\begin{{tabular}}{{{'l' * len(heads)}}}", " & ".join(heads) + r" \\ \hline"]
        return "\n".join(
            [
                r"\begin{center}",
                *([caption, "", ""] if caption else []),
                _fitted("\n".join([*top, *body, r"\end{tabular}"])),
                r"\end{center}",
            ]
        )

    def figure(self, figure: Figure, caption: str) -> str:
        if not self.beside:
            return self.paragraph(self.plain(f"[Figure: {figure.picture.description}]"))
        shown = rf"\includegraphics{{{self.beside}-{figure.name}.pdf}}"
        return "\n".join([r"\begin{center}", _fitted(shown), *([r"\par " + caption] if caption else []), r"\end{center}"])


class Html(Markup):
    """A fragment of a page, formulas as MathML; how blocks look is in ``templates/blocks.html``."""

    text = markupsafe.Markup

    @property
    def _blocks(self) -> Any:
        return template(__package__, "blocks.html").module

    def plain(self, text: str) -> str:
        return markupsafe.escape(text)

    def inline(self, math: str) -> str:
        return self.text(mathml(math))

    def equation(self, block: Equation) -> str:
        return self.whole(block)

    def display(self, math: str, label: str) -> str:
        return self._blocks.display(self.text(broken(math)), label)

    def heading(self, title: str, level: int) -> str:
        return self._blocks.heading(title, level)

    def paragraph(self, words: str) -> str:
        return self._blocks.paragraph(words)

    def bullets(self, items: Sequence[str]) -> str:
        return self._blocks.bullets(items)

    def table(self, heads: Sequence[str], rows: Sequence[Sequence[str]], caption: str) -> str:
        return self._blocks.table(heads, rows, caption)

    def figure(self, figure: Figure, caption: str) -> str:
        return self._blocks.figure(self.text(figure.picture.inline()), caption)


def _fitted(shown: str) -> str:
    """What is wider than the line made smaller."""
    return rf"\resizebox{{\ifdim\width>\linewidth\linewidth\else\width\fi}}{{!}}{{{shown}}}"


def _over_pages(math: str, tag: str) -> str:
    """Aligned rows that a page may end between."""
    rows = math.removeprefix("\\begin{aligned}\n").removesuffix("\n\\end{aligned}").replace(ROW, rf" \notag{ROW}")
    return f"{{\\allowdisplaybreaks\n\\begin{{align}}\n{rows} {tag}\n\\end{{align}}}}"


def _below(math: str) -> str:
    """A formula on lines below the words of a list."""
    room = line_breaking.ROOM - _SLACK
    shown = line_breaking.lines(math, room)
    made = shown[0] if len(shown) == 1 else aligned([f"&{shown[0]}", *(rf"&\quad {line}" for line in shown[1:])])
    if max(map(line_breaking.width, shown)) > room:
        made = _fitted(rf"$\displaystyle {made}$")
    return f"\n\\[\n{made}\n\\]\n"


_SIGNS = {sign: rf"\{word}" for word, sign in GREEK.items()}
_SIGNS |= {sign: f"_{digit}" for digit, sign in enumerate("₀₁₂₃₄₅₆₇₈₉")}
_SIGNS |= {"⁴": "^4", "⁻": "^-", "−": "-", "×": r"\times", "·": r"\cdot", "→": r"\to", "∞": r"\infty", "≥": r"\ge", "≤": r"\le",
           "√": r"\surd", "∂": r"\partial", "≠": r"\ne", "≈": r"\approx", "′": "'"}  # fmt: skip
_ACCENTS = {"\u0307": r"\dot", "\u0308": r"\ddot"}


def _signs(signs: str) -> str:
    """Letters that TeX does not have in text: Greek, with dots, lowered digits, arrows; as they are where one is not known."""
    apart = "".join(normalize("NFD", sign) if "\u1e00" <= sign <= "\u1eff" else sign for sign in signs)
    made = [_sign(*found) for found in re.findall("(.)([\u0307\u0308]?)", apart)]
    return f"${' '.join(filter(None, made))}$" if all(made) else signs


def _sign(sign: str, accent: str) -> str | None:
    shown = _SIGNS.get(sign, sign if sign.isascii() else None)
    return rf"{_ACCENTS[accent]}{{{shown}}}" if shown and accent else shown
