"""The letters of an impact: an impulse is J with the letter of its force below, ``J_N_floor``."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from freebody.core import SymbolicAnswers
from freebody.impact.impacts import Impulsive
from freebody.solve.symbols import Naming, Symbols
from freebody.symbolic.symbols import Name


@dataclass(frozen=True)
class ImpulseNaming(Naming):
    """The letters of an impact: an impulse is J with the letter of its force below, ``J_N_floor``."""

    blow: Impulsive

    @classmethod
    def of(cls, impact: Impulsive) -> ImpulseNaming:
        """Those of an impact."""
        return cls(impact.source, impact.state, impact.impulses, impact)

    @cached_property
    def loads(self) -> dict[str, Name]:
        """The letters of impulses, by the symbols of their forces."""
        forces = Symbols.of(self.source, self.blow.free.loads, self._ask([]).letters).loads
        given = {load.symbol: self.blow.given[load.name] for load in self.blow.acting if load.name in self.blow.given}
        made = {symbol: Name("J", (force.stem, *force.below), force.owner) for symbol, force in forces.items()}
        return made | {symbol: Name.parse(letter) for symbol, letter in given.items()}

    def _ask(self, questions: list[dict[str, str]]) -> SymbolicAnswers:
        """What the core answers during the impact."""
        return self.blow.letters(questions)
