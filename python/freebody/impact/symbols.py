"""A mechanism symbolically during an impact."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from freebody.core import SymbolicAnswers
from freebody.impact.impacts import Impulsive
from freebody.solve.symbolic_state import Row, SymbolicState
from freebody.symbolic.symbols import Name


@dataclass(frozen=True)
class ImpulsiveState(SymbolicState):
    """A mechanism during an impact, while all that takes part holds; rates are those before."""

    impact: Impulsive = field(kw_only=True)

    @classmethod
    def of(cls, impact: Impulsive) -> ImpulsiveState:
        """That of an impact."""
        return cls(impact.source, impact.state, given=impact.free, impact=impact)

    @cached_property
    def rows_before(self) -> list[Row]:
        """What held just before the impact."""
        return list(map(Row.read, self.impact.rows_before()))

    @cached_property
    def impulses(self) -> dict[str, Name]:
        """How impulses are written, by the symbols of their forces: J with the symbol of the force below, ``J_N_floor``."""
        made = {symbol: Name("J", (force.stem, *force.below), force.owner) for symbol, force in self.symbols.loads.items()}
        given = {load.symbol: self.impact.given[load.name] for load in self.impact.acting if load.name in self.impact.given}
        return made | {symbol: Name.parse(name) for symbol, name in given.items()}

    def _ask(self, questions: Sequence[Mapping[str, Any]]) -> SymbolicAnswers:
        return self.impact.symbolic_answers(questions)
