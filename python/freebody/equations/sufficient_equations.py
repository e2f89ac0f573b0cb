"""Which equations are enough for one answer symbolically: the smallest set of balances, with what loops and motions ask."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from freebody.core import Array, FreeBodies
from freebody.equations.balances.smallest import smallest_set
from freebody.equations.dependent_coordinates import holds
from freebody.equations.derivation.balance_text import Stated
from freebody.equations.derivation.coordinates import stated as of_coordinates
from freebody.equations.derivation.minimal import from_search
from freebody.equations.linearization import independent
from freebody.equations.solve import TooLarge
from freebody.equations.substitutions import Substitutions
from freebody.solve.symbolic_state import Row, SymbolicState
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.linear import Linear
from freebody.symbolic.tree import ZERO, Sym, Tree, add, is_zero, mul

_ASIDE = 0.1
"""How far symbols are from those of the state where it is asked what they determine, so that nothing is so by chance."""
_ROUND_OFF = 1e-12
"""Of a coefficient with numbers, relative to what it is beside the state, below which it is 0."""
_SEED = 11


@dataclass(frozen=True)
class SufficientSet:
    """Balances and rows that together give ``gives``; ``linear`` are all of them, ``known`` what they hold of earlier answers."""

    stated: tuple[Stated, ...]
    rows: tuple[Row, ...]
    linear: tuple[Linear, ...]
    unknowns: tuple[Sym, ...]
    gives: tuple[Sym, ...]
    known: tuple[Sym, ...]


@dataclass(frozen=True)
class Search:
    """Where equations are looked for: a subject with what is set, what of that is ``held``, and the ``states`` that tell what
    drops out."""

    subject: SymbolicState
    chosen: Substitutions
    held: Substitutions
    states: Sequence[FreeBodies]

    def enough(self, wanted: Sym, known: Mapping[Sym, Tree], titles: Collection[str]) -> SufficientSet:
        """The equations for one thing, ``known`` being answered before, from equations with ``titles``. Raises ``TooLarge``."""
        rows, names = self.states[0].rows, list(self.states[0].accelerations)
        table = np.array([[row.coefficients[name] for name in names] for row in rows])
        if wanted.dots and rows and holds(table, names.index(wanted.name)):  # motions and loops alone give it
            return self._closed([], wanted, known, titles)
        refusal = TooLarge(f"{wanted.name}: no set of balances about named points gives it; ask for numbers")
        for stated in self._tries(wanted):
            try:
                return self._closed(stated, wanted, known, titles)
            except TooLarge as error:  # what drops out at these numbers does not symbolically
                refusal = error
        raise refusal

    def _tries(self, wanted: Sym) -> Iterator[list[Stated]]:
        """The smallest set; all balances of the coordinates, and more."""
        if least := smallest_set(wanted.name, self.states, self.subject.points).equations:
            yield from_search(self.subject, least, momentum=False)
        stated = of_coordinates(self.subject, momentum=False)
        if wanted.dots or any(wanted in s.balance.linear.coefficients for s in stated):
            yield stated
        else:
            more = smallest_set(wanted.name, self.states, self.subject.points, known_motion=True).equations
            yield stated + from_search(self.subject, more, momentum=False)

    def _closed(self, stated: Sequence[Stated], wanted: Sym, known: Mapping[Sym, Tree], titles: Collection[str]) -> SufficientSet:
        """With the rows that it takes, and without what it does not take."""
        stated = [replace(each, balance=each.balance.with_trees(self.held.put)) for each in stated]
        made: list[tuple[Stated | Row, Linear]] = [(s, self._put(s.balance.linear, known)) for s in stated]
        rows = [(row, self._put(row.linear, known)) for row in self.subject.rows]
        while not self._gives(made, wanted):
            unknown = {wanted, *_unknowns(made)}
            more = next((row for row in rows if row not in made and unknown & row[1].coefficients.keys()), None)
            if more is None:
                loads = ", ".join(sorted(x.name for x in unknown if not x.dots))
                held = f", the loads {loads} among them" if loads else ""
                raise TooLarge(f"{wanted.name}: {len(made)} equations leave {len(unknown)} unknowns{held}; ask for numbers")
            made.append(more)
        for each in sorted(made, key=lambda e: (isinstance(e[0], Stated), isinstance(e[0], Stated) and e[0].title not in titles)):
            others = [other for other in made if other is not each]
            made = others if self._gives(others, wanted) else made
        return self._square(made, wanted, known)

    def _square(self, made: Sequence[tuple[Stated | Row, Linear]], wanted: Sym, known: Mapping[Sym, Tree]) -> SufficientSet:
        """As many unknowns as equations: others, of which the one wanted does not depend, are left out."""
        unknowns = [wanted, *(x for x in _unknowns(made) if x != wanted)]
        numbers = self._numbers(made, unknowns)
        norms = np.linalg.norm(numbers, axis=0)
        kept = independent((numbers / np.where(norms > 0, norms, 1.0)).T)
        gives = [x for i, x in enumerate(unknowns) if i in kept and holds(numbers, i)]
        stated, rows = ([of for of, _ in made if isinstance(of, kind)] for kind in (Stated, Row))
        used = [x for x in known if any(x in each.balance.linear.coefficients for each in stated)]
        linear = tuple(each for _, each in made)
        return SufficientSet(tuple(stated), tuple(rows), linear, tuple(unknowns[i] for i in kept), tuple(gives), tuple(used))

    def _put(self, linear: Linear, known: Mapping[Sym, Tree]) -> Linear:
        """With what is set, and what is known in its place."""
        found = {x: self.chosen.put(tree) for x, tree in linear.coefficients.items() if not self.held.is_immobile(x)}
        if self.chosen.measured:  # as the arm of a load about the very point where it acts
            found = {x: tree for x, tree in found.items() if not self._is_round_off(tree, linear.coefficients[x])}
        rest = add(self.chosen.put(linear.rest), *(mul(tree, known[x]) for x, tree in found.items() if x in known))
        return Linear({x: tree for x, tree in found.items() if x not in known and not is_zero(tree)}, rest)

    def _gives(self, made: Sequence[tuple[Stated | Row, Linear]], wanted: Sym) -> bool:
        """Whether equations determine an unknown, whatever the symbols are."""
        unknowns = _unknowns(made)
        return wanted in unknowns and holds(self._numbers(made, unknowns), unknowns.index(wanted))

    def _is_round_off(self, measured: Tree, tree: Tree) -> bool:
        """Whether a coefficient with numbers is 0, measured by what it is beside the state."""
        tables = self.subject.tables
        here, beside = (float(evaluate(*each, tables)) for each in ((measured, self.subject.values), (tree, self._beside)))
        return abs(here) < _ROUND_OFF * abs(beside)

    @cached_property
    def _beside(self) -> Mapping[Sym, float]:
        """The numbers of all symbols beside the state."""
        rng, values = np.random.default_rng(_SEED), self.subject.values
        return {x: v * (1 + _ASIDE * rng.uniform(-1, 1)) + _ASIDE * rng.uniform(0.1, 1) for x, v in values.items()}

    def _numbers(self, made: Sequence[tuple[Stated | Row, Linear]], unknowns: Sequence[Sym]) -> Array:
        """The coefficients beside the state, rows and then columns of like size."""
        values, tables = self._beside, self.subject.tables
        table = np.array(
            [[float(evaluate(each.coefficients.get(x, ZERO), values, tables)) for x in unknowns] for _, each in made]
        )
        sizes = np.abs(table).max(axis=1, keepdims=True, initial=0.0)
        table = table / np.where(sizes > 0, sizes, 1.0)  # nothing unknown is left in an equation of what is known
        largest = np.abs(table).max(axis=0)
        return table / np.where(largest > 0, largest, 1.0)


def _unknowns(made: Sequence[tuple[Stated | Row, Linear]]) -> list[Sym]:
    return list(dict.fromkeys(x for _, each in made for x in each.coefficients))
