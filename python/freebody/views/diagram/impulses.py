"""Impulse diagrams: what acts on each body during an impact, and the jump of its momentum."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import ClassVar

from freebody.core import FreeBodies
from freebody.impact.impacts import Impulsive
from freebody.impact.symbols import ImpulsiveState
from freebody.symbolic.symbols import Name
from freebody.views.diagram import Cut, Diagram, DiagramBuilder, chosen_groups
from freebody.views.diagram.names import Labels, Sign
from freebody.views.diagram.rows import COLUMN


@dataclass(frozen=True)
class _Jumps(Labels):
    """What is written at impulses, m Δv and I Δω."""

    unit: ClassVar[str] = "N·s"
    turning_unit: ClassVar[str] = "N·m·s"

    @property
    def loads(self) -> Mapping[str, Name]:
        """The names of impulses by the symbols of their forces."""
        assert isinstance(self.subject, ImpulsiveState)
        return self.subject.impulses

    def acceleration(self, body: str) -> Sign:
        """Of the jump of the velocity of a body's mass centre."""
        return _jump(Sign.of(self._of_body("v", body), bold=True))

    def component(self, body: str, part: str) -> Sign:
        """Of a component of that jump."""
        name = self._of_body("v", body)
        return _jump(Sign.of(replace(name, below=(*name.below, part))))

    def angular(self, body: str) -> Sign:
        """Of the jump of the angular velocity."""
        return _jump(Sign.of(self._of_body("omega", body)))


def _jump(of: Sign) -> Sign:
    return Sign(rf"\Delta {of.latex}", f"Δ{of.plain}")


def impulse_diagram(
    impact: Impulsive,
    groups: Sequence[Sequence[str]] | None = None,
    scaled: bool = False,
    effective: bool = True,
    column: float = COLUMN,
) -> Diagram:
    """Impulse diagrams of groups of bodies (by default every body by itself) during an impact, with what is absent and why."""
    free, source = impact.impulses, impact.source
    # A body that no impulse acts on: nothing of its momentum jumps.
    moved = {name: body if free.on(name) else replace(body, mass=0.0, inertia=0.0) for name, body in free.bodies.items()}
    touched = FreeBodies(moved, free.loads)
    chosen = chosen_groups(groups, free)

    def draw(figures: int) -> Iterator[Cut]:
        labels = _Jumps(ImpulsiveState.of(impact), free, figures)
        builder = DiagramBuilder(source, impact.state, touched, touched, labels, chosen, scaled, effective, column)
        for group in chosen:
            cut = builder.cut(group)
            absent = [f"Absent: {sentence}." for sentence in impact.absent(*group)]
            yield replace(cut, notes=[*cut.notes, *absent])

    return Diagram(f"impulse diagrams of {source.name}", free, draw)
