"""Documents as HTML, formulas as MathML; how blocks look is in ``templates/blocks.html``."""

from __future__ import annotations

import math
import re
from base64 import b64encode
from collections.abc import Sequence
from pathlib import Path

import markupsafe

from freebody.document.blocks import Block, Figure, Heading
from freebody.document.rendering.format import Format
from freebody.document.rendering.markup import TypesetMarkup
from freebody.document.rendering.text import words_text
from freebody.document.templates import template
from freebody.symbolic.formula import Formula
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.printers.mathml import broken, mathml

_FONT = Path(__file__).with_name("templates") / "math.woff"
_BEFORE_STOP = re.compile(r"(<math(?:(?!<math).)*</math>[:;,.)])", re.S)


class Html(TypesetMarkup):
    """A fragment of a page."""

    kind = markupsafe.Markup
    look = "blocks.html"
    room = math.inf  # a browser breaks lines by itself

    def plain(self, text: str) -> str:
        return markupsafe.escape(text)

    def paragraph(self, words: str) -> str:
        # A browser would begin a line with a colon or a stop; of Markup, ``sub`` would escape what it puts in.
        return super().paragraph(self.kind(_BEFORE_STOP.sub(r'<span style="white-space:nowrap">\1</span>', str(words))))

    def inline(self, formula: Formula) -> str:
        return self.kind(mathml(formula))

    def display(self, rows: Sequence[tuple[Formula, Formula]], label: str) -> str:
        [(_, whole)] = rows
        return self.blocks.display(self.kind(broken(whole)), label)

    def figure(self, figure: Figure, caption: str) -> str:
        return self.blocks.figure(self.kind(figure.picture.inline()), caption)


def page(blocks: Sequence[Block], nomenclature: Nomenclature, around: str = "page.html") -> str:
    """A whole page, which needs nothing from elsewhere, or a ``fragment.html`` of one; a page has the font of its mathematics in it."""
    titles = (words_text(block.words, nomenclature) for block in blocks if isinstance(block, Heading))
    shown = {"title": next(titles, "Equations"), "body": Html(nomenclature).render(blocks)}
    return template(__package__, around).render(**shown, font=b64encode(_FONT.read_bytes()).decode())


FORMAT = Format("html", "html", "A page for a browser.", lambda blocks, nomenclature, beside: page(blocks, nomenclature))
