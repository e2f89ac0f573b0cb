"""Documents as Jupyter notebooks (nbformat 4.5): a cell of Markdown for each section, with the figures in it."""

from __future__ import annotations

import json
from base64 import b64encode
from collections.abc import Sequence
from typing import Any

from freebody.document.blocks import Block, Figure, Heading
from freebody.document.rendering.format import Format
from freebody.document.rendering.markdown import Markdown
from freebody.symbolic.nomenclature import Nomenclature


class Cells(Markdown):
    """Markdown whose pictures are attached to its cell."""

    def figure(self, figure: Figure, caption: str) -> str:
        return f"![{self.plain(figure.picture.description)}](attachment:{figure.name}.svg)\n\n{caption}"


def render(blocks: Sequence[Block], nomenclature: Nomenclature, beside: str = "") -> str:
    """A whole notebook."""
    writer, cells = Cells(nomenclature), list[dict[str, Any]]()
    for block in blocks:
        if isinstance(block, Heading) or not cells:
            cell = {"cell_type": "markdown", "id": f"section-{len(cells)}", "metadata": {}, "attachments": {}, "source": ""}
            cells.append(cell)
        cells[-1]["source"] += f"{writer.block(block)}\n\n"
        if isinstance(block, Figure):
            picture = b64encode(block.picture.inline().encode()).decode()
            cells[-1]["attachments"][f"{block.name}.svg"] = {"image/svg+xml": picture}
    python = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    return json.dumps({"nbformat": 4, "nbformat_minor": 5, "metadata": python, "cells": cells}, ensure_ascii=False, indent=1)


FORMAT = Format("ipynb", "notebook", "A Jupyter notebook.", render)
