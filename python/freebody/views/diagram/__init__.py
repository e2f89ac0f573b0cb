"""Free-body diagrams as pictures: symbolic, or to true scale at an instant."""

from __future__ import annotations

import io
import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from freebody.free_body import FreeBodies
from freebody.instant import State
from freebody.run import Source
from freebody.views.diagram import actions as acting
from freebody.views.diagram.actions import Action
from freebody.views.diagram.arrows import LONGEST, Mark
from freebody.views.diagram.describe import described
from freebody.views.diagram.names import Letters
from freebody.views.diagram.panel import panel
from freebody.views.diagram.paper import Row, sheet
from freebody.views.diagram.scenery import scenery
from freebody.views.style import quiet

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class Cut:
    """A group of bodies cut free and drawn: ``forces`` act on it, ``effective`` is the other side of its balance."""

    group: tuple[str, ...]
    row: Row

    @property
    def forces(self) -> list[Mark]:
        """The arrows of all that acts."""
        return self.row.panels[0].marks

    @property
    def effective(self) -> list[Mark]:
        """The arrows of m a and I α; none where they were not asked for."""
        return self.row.panels[1].marks if len(self.row.panels) > 1 else []


@dataclass(frozen=True)
class Diagram:
    """Free-body diagrams on one sheet, one cut below the other."""

    name: str
    cuts: tuple[Cut, ...]

    @cached_property
    def figure(self) -> Figure:
        """The sheet as a matplotlib figure, just as large as it must be."""
        return sheet([cut.row for cut in self.cuts])

    @property
    def description(self) -> str:
        """In words, what the diagrams show."""
        return " ".join(described(cut.group, [mark.action for mark in cut.forces]) for cut in self.cuts)

    def save(self, path: str | Path) -> Path:
        """Write a file: .svg, .png or .pdf."""
        path = Path(path)
        if path.suffix.lower() == ".svg":
            path.write_text(self.svg(), encoding="utf-8")
        else:
            with quiet():
                self.figure.savefig(path, dpi=220)
        return path

    def svg(self) -> str:
        """The sheet as SVG with a title and a description, for those who cannot see it."""
        import matplotlib

        buffer = io.StringIO()
        with quiet(), matplotlib.rc_context({"svg.fonttype": "none", "svg.hashsalt": self.name}):
            self.figure.savefig(buffer, format="svg", metadata={"Date": None})
        told = f"<title>{escape(self.name)}</title>\n <desc>{escape(self.description)}</desc>\n"
        return re.sub(r"(<svg[^>]*)>", rf'\g<1> role="img">\n {told}'.replace("\\", r"\\").replace(r"\\g", r"\g"),
                      buffer.getvalue(), count=1)  # fmt: skip

    def _repr_svg_(self) -> str:
        return self.svg()


def diagram(
    source: Source,
    state: State,
    free: FreeBodies,
    groups: Sequence[Sequence[str]] | None = None,
    scaled: bool = False,
    effective: bool = True,
) -> Diagram:
    """Free-body diagrams of groups of bodies (by default every body by itself) at a state."""
    letters = Letters(source, free)
    chosen = [(name,) for name in free.bodies] if groups is None else [tuple(group) for group in groups]
    cuts = tuple(_cut(source, state, free, group, letters, scaled, effective) for group in chosen)
    return Diagram(f"free-body diagrams of {source.name}", cuts)


def _cut(
    source: Source, state: State, free: FreeBodies, group: tuple[str, ...], letters: Letters, scaled: bool, effective: bool
) -> Cut:
    drawn = scenery(source, state, free, group, scaled)
    if scaled:
        forces, notes = acting.to_scale(free, group, letters)
    else:
        forces, notes = list(acting.symbolic(free, group, letters, drawn.sketch)), []
    sides = [forces, list(acting.effective(free, group, letters, scaled))] if effective else [forces]
    per_newton = _per_newton(sides) if scaled else None
    named = group if len(group) > 1 else ()
    panels = [panel(drawn, forces, named, per_newton, axes=True)]
    if effective:
        panels.append(panel(drawn.bare(), sides[1], (), per_newton, axes=False))
    return Cut(group, Row(" + ".join(group), panels, per_newton, notes))


def _per_newton(sides: Sequence[Sequence[Action]]) -> float | None:
    largest = max((float(np.hypot(*action.force)) for side in sides for action in side), default=0.0)
    return LONGEST / largest if largest > 0 else None
