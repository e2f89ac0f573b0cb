"""Documents as HTML, formulas as MathML; how blocks look is in ``templates/blocks.html``."""

from __future__ import annotations

import math
from collections.abc import Sequence

import markupsafe

from freebody.document.blocks import Block, Figure, Heading
from freebody.document.rendering.format import Format
from freebody.document.rendering.markup import TypesetMarkup
from freebody.document.rendering.text import words_text
from freebody.document.templates import template
from freebody.symbolic.formula import Formula
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.printers.mathml import broken, mathml


class Html(TypesetMarkup):
    """A fragment of a page."""

    kind = markupsafe.Markup
    look = "blocks.html"
    room = math.inf  # a browser breaks lines by itself

    def plain(self, text: str) -> str:
        return markupsafe.escape(text)

    def inline(self, formula: Formula) -> str:
        return self.kind(mathml(formula))

    def display(self, rows: Sequence[tuple[Formula, Formula]], label: str) -> str:
        [(_, whole)] = rows
        return self.blocks.display(self.kind(broken(whole)), label)

    def figure(self, figure: Figure, caption: str) -> str:
        return self.blocks.figure(self.kind(figure.picture.inline()), caption)


def page(blocks: Sequence[Block], nomenclature: Nomenclature, around: str = "page.html") -> str:
    """A whole page, which needs nothing from elsewhere, or a ``fragment.html`` of one."""
    titles = (words_text(block.words, nomenclature) for block in blocks if isinstance(block, Heading))
    return template(__package__, around).render(title=next(titles, "Equations"), body=Html(nomenclature).render(blocks))


FORMAT = Format("html", "html", "A page for a browser.", lambda blocks, nomenclature, beside: page(blocks, nomenclature))
