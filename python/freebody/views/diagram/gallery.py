"""The diagrams of many models on one page, to be looked at."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from freebody.core import MotionError
from freebody.document.templates import template
from freebody.formats import write
from freebody.impact.impacts import impacts
from freebody.model.errors import ModelFileError
from freebody.views.diagram.impulses import impulse_diagram

if TYPE_CHECKING:
    from freebody.mechanism import Mechanism


def write_gallery(models: Iterable[tuple[str, Mechanism]], path: Path) -> Path:
    """One page with the diagrams of models, each with a heading and a link to it: every body, and the group of all where there are
    several; and the impulses of the first impact of each kind in its run. A model whose start has no answer is named with the reason."""
    shown = []
    for i, (heading, mechanism) in enumerate(models):
        prefix, drawn, refusal = f"d{i}-", [], ""
        try:
            drawn.append(mechanism.diagram())
            drawn += [mechanism.diagram("all")] if len(drawn[0].cuts) > 1 else []
        except MotionError as error:
            refusal = error.what
        pictures = [each.inline(f"{prefix}{i}") for i, each in enumerate(drawn)]
        struck = list(_impacts(mechanism, f"{prefix}b"))
        place = re.sub(r"\W+", "-", heading).strip("-")
        shown.append({"place": place, "heading": heading, "pictures": pictures, "refusal": refusal, "impacts": struck})
    return write(path, template(__package__, "gallery.html").render(models=shown))


def _impacts(mechanism: Mechanism, prefix: str) -> Iterator[dict[str, Any]]:
    """The impulse diagrams of the run, of the first impact of each kind: its bodies, and all together where there are several. Parts
    that repeat are of one kind. Of a model that does not run there is none."""
    try:
        found = impacts(mechanism.simulate())
    except (MotionError, ModelFileError):
        return
    seen = set()
    for number, impact in enumerate(found, 1):
        kind = tuple(re.sub(r"\[\d+\]", "", name) for name in impact.change.of)
        if kind in seen:
            continue
        bodies = tuple(impact.impulses.bodies)
        groups = [None, [bodies]] if len(bodies) > 1 else [None]
        pictures = [impulse_diagram(impact, group).inline(f"{prefix}{len(seen)}-{i}") for i, group in enumerate(groups)]
        of = " and ".join(impact.change.of) or "what is engaged"
        seen.add(kind)
        yield {"number": number, "of": of, "t": f"{impact.change.t:.4g}", "pictures": pictures}
