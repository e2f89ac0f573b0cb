"""The diagrams of many models on one page, to be looked at."""

from __future__ import annotations

import re
from collections.abc import Iterable
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from freebody.model import Mechanism

_PAGE = """<!doctype html>
<html lang="en"><meta charset="utf-8"><title>Free-body diagrams</title>
<style>
body {{ font: 15px/1.4 system-ui, sans-serif; color: #23272e; margin: 2em auto; max-width: 90em; padding: 0 1em }}
section {{ display: flex; flex-wrap: wrap; gap: 1em 3em; align-items: flex-start; border-top: 1px solid #d5d9de; padding: 1em 0 }}
h2 {{ flex: 100%; font-size: 1.1em; margin: 0 }} svg {{ max-width: 100%; height: auto }} p {{ color: #b3261e }}
</style>
<h1>Free-body diagrams</h1>
{sections}
</html>
"""


def write_gallery(models: Iterable[tuple[str, Path]], path: Path) -> Path:
    """One page with the diagrams of models, each with its heading: every body, and the group of all where there are several.
    A model whose start has no answer is named with the reason."""
    from freebody.model import Mechanism

    sections = []
    for heading, model in models:
        sections.append(f"<section><h2>{escape(heading)}</h2>\n{_pictures(Mechanism.load(model), f'd{len(sections)}')}</section>")
    path.write_text(_PAGE.format(sections="\n".join(sections)), encoding="utf-8")
    return path


def _pictures(mechanism: Mechanism, prefix: str) -> str:
    from freebody._core import MotionError

    try:
        drawn = [mechanism.diagram()]
        if len(drawn[0].cuts) > 1:
            drawn.append(mechanism.diagram("all"))
    except MotionError as error:
        return f"<p>{escape(error.args[2])}</p>"
    return "\n".join(_inline(each.svg(), f"{prefix}{i}") for i, each in enumerate(drawn))


def _inline(svg: str, prefix: str) -> str:
    """An SVG for a page with others: its identifiers made its own."""
    body = svg[svg.index("<svg") :]
    return re.sub(r'(\bid="|xlink:href="#|url\(#)', rf"\g<1>{prefix}-", body)
