"""Rows of panels as a picture: on a figure, in files, in the middle of a page."""

from __future__ import annotations

import io
import re
from collections.abc import Sequence
from functools import cached_property
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING
from zlib import crc32

from freebody.formats import Formats, replacing
from freebody.views.diagram.paper import parted, sheet
from freebody.views.diagram.rows import Row
from freebody.views.diagram.tikz import tikz
from freebody.views.style import quiet

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Picture:
    """Rows on one sheet, one below the other, with a name and a description in words."""

    name: str
    rows: Sequence[Row]
    description: str

    @cached_property
    def figure(self) -> Figure:
        """The sheet as a matplotlib figure, just as large as it must be."""
        return sheet(self.rows)

    def save(self, path: str | Path) -> Path:
        """Write one of ``FORMATS``. Raises ``ValueError`` for any other."""
        path = Path(path)
        form = FORMATS.of(path)
        with replacing(path) as beside:
            form(self, beside)
        return path

    def svg(self) -> str:
        """The sheet as SVG with a title and a description, for those who cannot see it."""
        import matplotlib

        buffer = io.StringIO()
        with quiet(), matplotlib.rc_context({"svg.fonttype": "none", "svg.hashsalt": self.name}):
            self.figure.savefig(buffer, format="svg", metadata={"Date": None})
        stated = f"<title>{escape(self.name)}</title>\n <desc>{escape(self.description)}</desc>\n"
        head, opening, rest = buffer.getvalue().partition("<svg")
        attributes, end, body = rest.partition(">")
        return f'{head}{opening}{attributes} role="img"{end}\n {stated}{body}'

    def inline(self, prefix: str = "") -> str:
        """The SVG for a page with others: identifiers begin with a prefix, by default one that no different picture has."""
        svg = self.svg()
        own = prefix or f"d{crc32(svg.encode()):08x}"
        return re.sub(r'(\bid="|xlink:href="#|url\(#)', rf"\g<1>{own}-", svg[svg.index("<svg") :])

    def _repr_svg_(self) -> str:
        return self.svg()


def _write_svg(picture: Picture, path: Path) -> None:
    path.write_text(picture.svg(), encoding="utf-8")


@quiet()
def _write_png(picture: Picture, path: Path) -> None:
    picture.figure.savefig(path, dpi=220)


@quiet()
def _write_pages(picture: Picture, path: Path) -> None:
    from matplotlib.backends.backend_pdf import PdfPages

    with PdfPages(path) as pages:
        for rows in parted(picture.rows):
            pages.savefig(sheet(rows))


def _write_tikz(picture: Picture, path: Path) -> None:
    path.write_text(tikz(picture.figure), encoding="utf-8")


FORMATS = Formats("a picture is", {".svg": _write_svg, ".png": _write_png, ".pdf": _write_pages, ".tex": _write_tikz})
