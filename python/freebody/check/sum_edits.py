"""A symbol that should be the sum or the difference of two."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import permutations

import numpy as np

from freebody.symbolic.dimensions import LENGTH, NUMBER_ONLY, Dimension
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Add, Mul, Negative, Node, Num, Pow, Sym, unsigned

from .solve_for_term import RequiredTerm
from .vocabulary import Vocabulary

_SAME = 1e-8  # relative: below it two values are one
_MOST_LENGTHS = 5  # with which an angle is multiplied


@dataclass
class SumEdits:
    """Of the ``known`` symbols, whose ``values`` are those of true states."""

    values: Mapping[str, Array]
    vocabulary: Vocabulary
    known: Sequence[Sym]
    _made: dict[object, tuple[list[tuple[Node, Node]], Array]] = field(default_factory=dict)

    def edits(self, required: RequiredTerm) -> Iterator[tuple[Node, float]]:
        """The sum or the difference of two symbols for one, for its square, or for twice one."""
        node, needed = required.node, required.needed
        match node:
            case Sym() as own:
                pass
            case Pow(base=Sym() as own, exponent=Num(value=2.0)) if needed.ndim == 1:
                needed = np.sqrt(needed) if np.all(needed >= 0) else np.full(1, np.nan)
            case Mul(factors=(Num(value=2.0), Sym() as own)):
                pass
            case _:
                return
        if needed.ndim != 1 or not np.isfinite(needed).all() or not needed.any():
            return
        pairs, rows = self._pairs(self.vocabulary.dimension(own))
        off = (np.abs(rows) if isinstance(node, Pow) else rows) - needed
        for place in np.flatnonzero(np.abs(off).max(axis=1, initial=0.0) <= _SAME * np.abs(needed).max()).tolist():
            a, b = pairs[place]
            its, fixed = self.vocabulary.dimension(own), [n in self.vocabulary.parameters for n in (a, unsigned(b))]
            # No g + ÿ.
            if (own in (a, unsigned(b)) or (its == LENGTH and all(fixed))) and (
                its in (LENGTH, NUMBER_ONLY) or all(fixed) or not any(fixed)
            ):
                found = Add((a, b), span=node.span)
                size = 0.2 if own in self.vocabulary.parameters else 0.0 if isinstance(node, Mul) else 0.1
                yield Pow(found, node.exponent) if isinstance(node, Pow) else found, size

    def _pairs(self, its: Dimension | None) -> tuple[list[tuple[Node, Node]], Array]:
        """Sums and differences of two symbols of a dimension, and of one and what rolls off beside it, and their values."""
        if its not in self._made:
            known = [n for n in self.known if its is not None and self.vocabulary.dimension(n) == its]
            apart = [
                (a, b) for a, b in permutations(known, 2) if not np.allclose(*np.abs([self.values[a.key], self.values[b.key]]))
            ]
            pairs: list[tuple[Node, Node]] = [(a, c) for a, b in apart for c in (*((b,) if a.key < b.key else ()), Negative(b))]
            moving = [n for n in known if Sym(n.name) in self.vocabulary.coordinates]
            pairs += [(a, c) for a in moving for b in self._rolled(its) for c in (b, Negative(b))]
            rows = [sampled(Add(pair), self.values) for pair in pairs]
            self._made[its] = pairs, np.array(rows).reshape(len(rows), len(next(iter(self.values.values()))))
        return self._made[its]

    def _rolled(self, its: Dimension | None) -> list[Node]:
        """Lengths times angles, or times their rates, of a dimension."""
        lengths = [n for n in self.vocabulary.parameters if self.vocabulary.dimension(n) == LENGTH]
        turns = [n for n in self.known if n not in self.vocabulary.parameters and its == self._times_length(n)]
        return [Mul((length, turn)) for length in lengths[:_MOST_LENGTHS] for turn in turns]

    def _times_length(self, symbol: Sym) -> Dimension | None:
        own = self.vocabulary.dimension(symbol)
        return None if own is None else own.times(LENGTH, 1)
