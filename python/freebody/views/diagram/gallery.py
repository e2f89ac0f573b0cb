"""The diagrams of many models on one page, to be looked at."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

from freebody.impact.impacts import Impact, impacts
from freebody.views.diagram.impulses import impulse_diagram

if TYPE_CHECKING:
    from freebody.model import Mechanism

_PAGE = """<!doctype html>
<html lang="en"><meta charset="utf-8"><title>Free-body diagrams</title>
<style>
body {{ font: 15px/1.4 system-ui, sans-serif; color: #23272e; margin: 2em auto; max-width: 90em; padding: 0 1em }}
section {{ display: flex; flex-wrap: wrap; gap: 1em 3em; align-items: flex-start; border-top: 1px solid #d5d9de; padding: 1em 0 }}
h2, h3 {{ flex: 100%; font-size: 1.1em; margin: 0 }} h3 {{ font-size: 1em; font-weight: normal }} svg {{ max-width: 100%; height: auto }} p {{ color: #b3261e }}
h2 a {{ color: inherit; text-decoration: none }} h2 a:hover {{ text-decoration: underline }}
nav {{ columns: 24em; margin-bottom: 2em }} nav a {{ display: block; color: #0b5fa5 }}
</style>
<h1>Free-body diagrams</h1>
<nav>
{links}
</nav>
{sections}
</html>
"""


def write_gallery(models: Iterable[tuple[str, Path]], path: Path) -> Path:
    """One page with the diagrams of models, each with a heading and a link to it: every body, and the group of all where there are
    several; and the impulses of the first impact of each kind in its run. A model whose start has no answer is named with the reason."""
    from freebody.model import Mechanism

    links, sections = [], []
    for heading, model in models:
        place = re.sub(r"\W+", "-", heading).strip("-")
        links.append(f'<a href="#{place}">{escape(heading)}</a>')
        mechanism, prefix = Mechanism.load(model), f"d{len(sections)}-"
        pictures = "\n".join([_pictures(mechanism, prefix), *_impacts(mechanism, f"{prefix}b")])
        sections.append(f'<section id="{place}"><h2><a href="#{place}">{escape(heading)}</a></h2>\n{pictures}</section>')
    path.write_text(_PAGE.format(links="\n".join(links), sections="\n".join(sections)), encoding="utf-8")
    return path


def _pictures(mechanism: Mechanism, prefix: str) -> str:
    from freebody.core import MotionError

    try:
        drawn = [mechanism.diagram()]
        if len(drawn[0].cuts) > 1:
            drawn.append(mechanism.diagram("all"))
    except MotionError as error:
        return f"<p>{escape(error.what)}</p>"
    return "\n".join(each.inline(f"{prefix}{i}") for i, each in enumerate(drawn))


def _impacts(mechanism: Mechanism, prefix: str) -> Iterator[str]:
    """The impulse diagrams of the run, one impact of each kind: its bodies, and all together where there are several."""
    for k, (number, impact) in enumerate(_kinds(mechanism)):
        what = " and ".join(impact.change.of) or "what is engaged"
        yield f"<h3>Blow {number} of the run, of {escape(what)}, at t = {impact.change.t:.4g} s: impulses</h3>"
        several = len(impact.impulses.bodies) > 1
        for i, group in enumerate([None, [tuple(impact.impulses.bodies)]] if several else [None]):
            yield impulse_diagram(impact, group).inline(f"{prefix}{k}-{i}")


def _kinds(mechanism: Mechanism) -> Iterator[tuple[int, Impact]]:
    """The first impact of every kind, and its number; parts that repeat are of one kind. Of a model that does not run there is none."""
    from freebody.core import MotionError
    from freebody.model.errors import ModelFileError

    try:
        run = mechanism.simulate()
    except (MotionError, ModelFileError):
        return
    seen = set()
    for number, impact in enumerate(impacts(run), 1):
        kind = tuple(re.sub(r"\[\d+\]", "", name) for name in impact.change.of)
        if kind not in seen:
            seen.add(kind)
            yield number, impact
