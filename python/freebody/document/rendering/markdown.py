"""Documents as Markdown with LaTeX between dollars."""

from __future__ import annotations

import re
from collections.abc import Sequence

from freebody.document.blocks import Figure
from freebody.document.rendering.format import Format
from freebody.document.rendering.markup import TypesetMarkup
from freebody.symbolic.formula import Formula
from freebody.symbolic.printers.latex import aligned, latex


class Markdown(TypesetMarkup):
    """Markdown with dollars."""

    look = "blocks.md.j2"

    def plain(self, text: str) -> str:
        return re.sub(r"([\\`*_\[\]<>$#|])", r"\\\1", text)

    def inline(self, formula: Formula) -> str:
        return f"${latex(formula)}$"

    def display(self, rows: Sequence[tuple[Formula, Formula]], label: str) -> str:
        return f"$$\n{aligned(rows)}{f' {chr(92)}tag{{{label}}}' if label else ''}\n$$"

    def figure(self, figure: Figure, caption: str) -> str:
        if not self.beside:
            return self.plain(f"[Figure: {figure.picture.description}]")
        return f"![{self.plain(figure.picture.description)}](<{self.beside}-{figure.name}.svg>)\n\n{caption}"


FORMAT = Format(
    "md",
    "markdown",
    "Markdown.",
    lambda blocks, nomenclature, beside: Markdown(nomenclature, beside).render(blocks),
    figures=".svg",
)
