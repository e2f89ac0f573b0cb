"""What the symbols of given forces stand for, in the sense of their arrows, as it stands in the balances of their bodies."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeAlias

from freebody.core import CompiledModel, FreeBodies, Load, State
from freebody.symbolic.alphabet import columns
from freebody.symbolic.printers import line_breaking
from freebody.symbolic.printers.latex import latex
from freebody.symbolic.printers.typeset import formula
from freebody.symbolic.tree import ZERO, Sym, Tree, is_zero, negative, number, read
from freebody.views.diagram.actions import Action
from freebody.views.diagram.names import symbol
from freebody.views.draw import UNNAMED
from freebody.views.labels import mathtext

_EM = 10.0  # pt, of a formula below a diagram
_EN = 0.42  # em, of a column of text, much of which is small
_LEAST = 12.0  # em of a line
_ON_AXIS = 1e-9  # component of a unit direction across an axis, below which it is round-off
_SPACE = re.compile(r"(\\text\{[^}]*\}|\\d+ot )|(?<=[\w})]) (?=[\w\\(])")
"""Between factors; words, and dots above what follows, keep theirs."""
_PLAIN = re.compile(r"[^\W\d]\w*")
_Parts: TypeAlias = tuple[Tree, Tree, Tree]
"""What a load gives to the balances of a body: along x, along y, about its mass centre."""


@dataclass(frozen=True)
class Laws:
    """The laws of the forces of a model at a state."""

    source: CompiledModel
    state: State
    free: FreeBodies

    def stated(self, actions: Sequence[Action], width: float) -> list[str]:
        """Lines of mathtext about the loads that have a law and not only a symbol, ``width`` pt long as far as terms can be parted."""
        lines: dict[str, list[str]] = {}
        for action in actions:
            if action.kind == "force" and action.label not in lines:
                lines[action.label] = list(self._law(action, width / _EM))
        made = [line for each in lines.values() for line in each]
        return [f"where {line}" if not i else line for i, line in enumerate(made)]

    def size(self, action: Action) -> Tree | None:
        """The size of a known load in the sense of its arrow, where that is along an axis or a couple; None where it is not."""
        [load] = action.loads
        x, y, moment = self._parts.get((load.symbol, action.body), (ZERO, ZERO, ZERO))
        if action.turns:
            return moment if action.couple > 0 else negative(moment)
        for along, across, sense, aside in ((x, y, *action.force), (y, x, *action.force[::-1])):
            if is_zero(across) and abs(aside) < _ON_AXIS:
                return along if sense > 0 else negative(along)
        return None

    def _law(self, action: Action, room: float) -> Iterator[str]:
        [load], size = action.loads, self.size(action)
        if size is None:
            law = self._of_length(load)
        else:
            lead = _EN * columns(f"where {action.sign.plain} = ")
            law = [latex(line) for line in line_breaking.lines(formula(size), max(_LEAST, room - lead))]
        if law and law[0] != action.label:
            if any(force["cases"] for force in self.source.metadata["forces"] if force["name"] == load.name):
                law[-1] += r",\ \mathrm{as\ it\ is\ here}"
            yield f"${action.label} = {_spaced(law[0])}$"
            yield from (rf"$\qquad {_spaced(line)}$" for line in law[1:])

    @cached_property
    def _parts(self) -> Mapping[tuple[str, str], _Parts]:
        """By symbol of the load and body. Empty where symbols would fill pages."""
        from freebody.core import MotionError

        forces = [load for load in self.free.loads if load.kind == "force"]
        bodies = [name for name in self.free.bodies if any(part.body == name for load in forces for part in load.on)]
        ways: list[dict[str, Any]] = [{"along": "x"}, {"along": "y"}]
        asked = [
            {"ask": "equation", "bodies": [name], "momentum": False, **way}
            for name in bodies
            for way in (*ways, {"about": {"point": f"{name}.G"}})
        ]
        try:
            stated = self.source.symbolic_answers(self.state, asked).answers
        except MotionError:
            return {}
        given = [{each["load"]: read(each["tree"]) for each in answer["loads"]} for answer in stated]
        return {
            (load.symbol, name): tuple(given[3 * k + way].get(i, ZERO) for way in range(3))
            for k, name in enumerate(bodies)
            for i, load in enumerate(self.free.loads)
            if load in forces and any(part.body == name for part in load.on)
        }

    def _of_length(self, load: Load) -> list[str]:
        """That of a spring or damper between two points, in the distance of these; nothing of what else pulls aslant."""
        spec = next(each for each in self.source.spec["forces"] if each["name"] == load.name)
        fields = spec["with"]
        stiffness, rest, damping = (_quantity(fields.get(word, 0)) for word in ("stiffness", "rest_length", "damping"))
        if "between" not in fields or stiffness is None or rest is None or damping is None:
            return []
        length = rf"\overline{{{' '.join(map(self._end, fields['between']))}}}"
        factor, stretched = stiffness, length if is_zero(rest) else rf"\left({length} - {latex(formula(rest))}\right)"
        if load.card.name == "damper":
            factor, stretched = damping, rf"\frac{{d}}{{dt}}{length}"
        return [stretched if factor == number(1) else rf"{latex(formula(factor))}\,{stretched}"]

    def _end(self, point: str) -> str:
        """The symbol of a point; of a particle it is that of its body."""
        body, _, last = point.rpartition(".")
        if last not in UNNAMED:
            return symbol(last)
        return symbol(body if self.free.bodies[body].particle else f"{body}_{last}")


def _quantity(given: Any) -> Tree | None:
    """A number or a symbol of the model; None of what is longer."""
    if isinstance(given, int | float):
        return number(given)
    return Sym(given) if _PLAIN.fullmatch(given) else None


def _spaced(line: str) -> str:
    """For mathtext, which has no space between letters of its own, and no brackets in sizes of their own."""
    return _SPACE.sub(lambda found: found[1] or r"\,", re.sub(r"\\[bB]ig[lr]", "", mathtext(line)))
