"""Free-body diagrams as pictures: symbolic, or to true scale at an instant."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from freebody.core import CompiledModel, FreeBodies, MotionError, State
from freebody.solve.symbolic_state import SymbolicState
from freebody.views.diagram import actions as acting
from freebody.views.diagram.actions import Action
from freebody.views.diagram.arrows import LONGEST, SHORTEST, Mark, arranged
from freebody.views.diagram.details import crowded, marked
from freebody.views.diagram.laws import Laws
from freebody.views.diagram.names import Labels
from freebody.views.diagram.panel import Panel
from freebody.views.diagram.picture import Picture
from freebody.views.diagram.rows import COLUMN, MARGIN, Row, fits
from freebody.views.diagram.scenery import CROWD, Scenery, scenery
from freebody.views.dimension_lines import FIGURES
from freebody.views.sketch import sketch_of_state

_NARROWEST = 60.0  # mm
_SMALLER = 0.85  # of what is drawn, step by step until it is as narrow as the column
_SMALLEST = 0.5
_STEP = 1e-3  # of the size of the mechanism, rad, and the same at its usual rate: enough for a spring at rest to pull


@dataclass(frozen=True)
class Cut(Row):
    """A group of bodies cut free and drawn: ``forces`` act on it, ``effective`` is the other side of its balance."""

    group: tuple[str, ...] = ()

    @property
    def forces(self) -> list[Mark]:
        """The arrows of all that acts."""
        return [mark for panel in (self.panels[0], *self.apart) for mark in panel.marks]

    @property
    def effective(self) -> list[Mark]:
        """The arrows of m a and I α; none where they were not asked for."""
        return self.panels[1].marks if len(self.panels) > 1 else []


@dataclass(frozen=True)
class Diagram(Picture):
    """Free-body diagrams on one sheet, one cut below the other, drawn when they are asked for."""

    name: str
    free: FreeBodies
    draw: Callable[[int], Iterable[Cut]]
    remark: str = ""
    figures: int = FIGURES

    def with_remark(self, words: str, figures: int = FIGURES) -> Diagram:
        """The same with a sentence below all of them, and values of so many figures at most; of none, without values."""
        return replace(self, remark=words, figures=min(figures, FIGURES))

    @cached_property
    def cuts(self) -> tuple[Cut, ...]:
        """The diagrams."""
        return tuple(self.draw(self.figures))

    @property
    def data(self) -> list[dict[str, Any]]:
        """The same as data, one entry for each diagram: see ``FreeBodies.data``; ``letter`` is that of the diagram, in LaTeX."""
        made = []
        for cut in self.cuts:
            labels = {load.symbol: mark.action.label for mark in cut.forces for load in mark.action.loads}
            stated = self.free.data(*cut.group)
            made.append(stated | {"loads": [{"letter": labels.get(load["symbol"])} | load for load in stated["loads"]]})
        return made

    @property
    def rows(self) -> tuple[Cut, ...]:
        """A row for every cut."""
        *others, last = self.cuts
        return (*others, replace(last, notes=[*last.notes, *filter(None, [self.remark])]))

    @property
    def description(self) -> str:
        """In words, what the diagrams show."""
        made = []
        for cut in self.cuts:
            stated = [f"{mark.action.sign.plain} {mark.action.way} on {mark.action.body}" for mark in cut.forces]
            made.append(f"On {' and '.join(cut.group)} {'act: ' if stated else 'nothing acts'}{'; '.join(stated)}.")
        return " ".join([*made, *filter(None, [self.remark])])


def diagram(
    source: CompiledModel,
    state: State,
    free: FreeBodies,
    groups: Sequence[Sequence[str]] | None = None,
    scaled: bool = False,
    effective: bool = True,
    column: float = COLUMN,
) -> Diagram:
    """Free-body diagrams of groups of bodies (by default every body by itself) at a state, on a sheet as wide as a ``column`` in
    pt."""
    near = _further(source, state, free)
    laws = None if scaled else Laws(source, state, free)
    chosen = chosen_groups(groups, free)
    subject = SymbolicState(source, state, given=free)

    def draw(figures: int) -> Iterable[Cut]:
        labels = Labels(subject, free, figures)
        builder = DiagramBuilder(source, state, free, near, labels, chosen, scaled, effective, column, laws)
        return map(builder.cut, chosen)

    return Diagram(f"free-body diagrams of {source.name}", free, draw)


def chosen_groups(groups: Sequence[Sequence[str]] | None, free: FreeBodies) -> tuple[tuple[str, ...], ...]:
    """The groups that are drawn, by default every body by itself."""
    return tuple((name,) for name in free.bodies) if groups is None else tuple(map(tuple, groups))


@dataclass(frozen=True)
class DiagramBuilder:
    """All that the diagrams of one sheet share, of the ``groups`` on it; ``near`` are the free bodies a little further on."""

    source: CompiledModel
    state: State
    free: FreeBodies
    near: FreeBodies
    labels: Labels
    groups: Sequence[tuple[str, ...]]
    scaled: bool
    effective: bool
    column: float = COLUMN
    laws: Laws | None = None

    @cached_property
    def per_newton(self) -> float | None:
        """The one scale of a sheet to scale, pt for each N: the largest of all its forces and m a is as long as the paper allows."""
        sketch = sketch_of_state(self.source, self.state)
        sides = (acting.to_scale(self.free, self.near, group, self.labels, sketch, self.effective) for group in self.groups)
        longest = max((each.size for forces, terms, _ in sides for each in forces + terms if not each.turns), default=0.0)
        return LONGEST / longest if longest > 0 else None

    def cut(self, group: tuple[str, ...]) -> Cut:
        """The diagram of a group, as large as the column allows."""
        size = 1.0
        while not fits(cut := self._cut(group, size)) and size > _SMALLEST:
            size *= _SMALLER
        return cut

    def _cut(self, group: tuple[str, ...], size: float) -> Cut:
        drawn = scenery(self.source, self.state, self.free, group, size)
        crowd = len(group) > CROWD
        forces, terms, notes = self._sides(group, drawn)
        pushes = [action for action in forces + terms if not action.turns]
        per_newton = self.per_newton if self.scaled and pushes else None
        if per_newton is not None:
            short = [action.sign.plain for action in pushes if action.size * per_newton < SHORTEST]
            notes = notes + [f"drawn longer than to scale: {', '.join(short)}"] * bool(short)
        bare = drawn.bare()
        figures = self.labels.figures
        angles = [each for each in drawn.measured(group, self.scaled, [], figures).dimensions if each.angle and not crowd]
        details = [] if self.scaled else crowded(forces, drawn)
        large = [action for detail in details for action in detail.forces]
        drawn = marked(drawn, details)
        marks = arranged([a for a in forces if not any(a is b for b in large)], replace(drawn, dimensions=angles), per_newton)
        measured = drawn.measured(group, self.scaled, [] if crowd else [mark.line for mark in marks], figures)
        panels = [Panel(drawn if crowd else measured, marks, group if len(group) > 1 else ())]
        if terms:
            panels.append(Panel(bare, arranged(terms, bare, per_newton), ()))
        return Cut(
            "all bodies" if len(group) == len(self.free.bodies) > CROWD else " + ".join(group),
            panels,
            per_newton,
            notes + self.labels.renamed,
            vanishes=self.effective and not terms,
            unit=self.labels.unit,
            apart=[*(Panel(each.scenery(drawn), each.marks(), ()) for each in details)]
            + [Panel(measured, [], ())] * bool(crowd and measured.dimensions),
            column=self.column,
            laws=self.laws.stated(forces, self.column - 2 * MARGIN) if self.laws else (),
            group=group,
        )

    def _sides(self, group: tuple[str, ...], drawn: Scenery) -> tuple[list[Action], list[Action], list[str]]:
        """What acts, m a and I α, and remarks."""
        if self.scaled:
            return acting.to_scale(self.free, self.near, group, self.labels, drawn.sketch, self.effective)
        forces = list(acting.symbolic(self.free, self.near, group, self.labels, drawn.sketch))
        return forces, list(acting.effective(self.free, self.near, group, self.labels)) if self.effective else [], []


def _further(source: CompiledModel, state: State, free: FreeBodies) -> FreeBodies:
    """The free bodies a little further on in all coordinates and rates, and with something of every parameter (a mass, gravity)
    that is 0; those of now where that has no answer."""
    coordinates = source.metadata["coordinates"]
    # all different, so that differences of coordinates change as well
    step = _STEP * free.units(coordinates) * (1.0 + np.arange(len(state.q)) % 7 / 3.0)
    p, rates = np.where(state.p == 0, _STEP, state.p), free.usual_rate(coordinates, state.u) * step
    try:
        return source.free_bodies(State(p, state.t, state.q + step, state.u + rates))
    except MotionError:
        return free


def points(column: float) -> float:
    """The width of a column in pt, from mm. Raises ``ValueError`` for one that has no room."""
    if not column >= _NARROWEST:
        raise ValueError(f"a diagram needs a column of {_NARROWEST:g} mm or more, not {column:g}")
    return column / 25.4 * 72.0


def groups(of: str | Sequence[str] | None, free: FreeBodies) -> list[tuple[str, ...]] | None:
    """The groups that a person names: ``crank``, ``crank+coupler``, ``all``, or several of these. Raises ``ValueError``."""
    if of is None:
        return None
    made = []
    for text in [of] if isinstance(of, str) else of:
        named = [text] if text in free.bodies else [name.strip() for name in text.split("+")]
        named = list(free.bodies) if named == ["all"] else named
        if unknown := [name for name in named if name not in free.bodies]:
            raise ValueError(f"no body is called {unknown[0]!r}; there are {', '.join(free.bodies)}")
        made.append(tuple(dict.fromkeys(named)))
    return made
