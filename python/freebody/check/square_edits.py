"""Squares of speeds that lack a part of the speed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from freebody.symbolic.dimensions import LENGTH, NUMBER_ONLY, TIME, Dimension
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Mul, Node, Num, Pow, Quotient, Sym

from .coefficients import more, multiplied, snapped
from .edits import Edit, depth
from .language.dimensions import dimension
from .language.statements import Equation
from .solve_for_term import RequiredTerm
from .vocabulary import Vocabulary

_NEARLY = 1e-5  # relative spread below which a factor is meant to be one number
_SPEEDS = (LENGTH.times(TIME, -1), NUMBER_ONLY.times(TIME, -1))


@dataclass
class SquareEdits:
    """What the squares of speeds may lack; ``values`` are those of true states."""

    values: Mapping[str, Array]
    vocabulary: Vocabulary
    _made: dict[Dimension, tuple[list[Node], Array]] = field(default_factory=dict)

    def edits(self, equation: Equation, required: RequiredTerm) -> Iterator[Edit]:
        """The square of a speed that lacks a part of it: that of the ground, or of a rotation."""
        node, base = required.node, required.node.base if isinstance(required.node, Pow) else None
        its = None if base is None else dimension(base, self.vocabulary.dimensions)
        if base is None or its not in _SPEEDS or node.exponent != Num(2.0) or required.needed.ndim != 1:
            return
        value, lost = sampled(base, self.values), required.missing
        if not np.isfinite(lost).all() or not lost.any():
            return
        nodes, rows = self._parts_of_speeds(its)
        # (base + k part)² is what is needed: lost = 2 k base part + k² part²
        linear, square = 2 * value * rows, rows**2
        ll, ls, ss = (np.sum(a * b, axis=1) for a, b in ((linear, linear), (linear, square), (square, square)))
        lw, sw = linear @ lost, square @ lost
        det = ll * ss - ls**2
        k, k2 = (ss * lw - ls * sw) / det, (ll * sw - ls * lw) / det
        off = np.abs(linear * k[:, None] + square * k2[:, None] - lost).max(axis=1)
        same = (off <= _NEARLY * np.abs(lost).max()) & (np.abs(k**2 - k2) <= _NEARLY * np.abs(k2))
        for place in np.flatnonzero(same).tolist():
            if (part := multiplied(nodes[place], snapped(float(k[place]), _NEARLY))) is not None:
                new = Pow(more(base, part), node.exponent, span=node.span)
                yield Edit.at(equation, "symbol", node, new, 0.1 + 0.02 * depth(part))

    def _parts_of_speeds(self, its: Dimension) -> tuple[list[Node], Array]:
        """Rates, and rates times a length, of a dimension, and their values."""
        if its not in self._made:
            known = self.vocabulary
            rates = [Sym(q.name, 1) for q in known.coordinates]
            rates += [n for n in (*known.parameters, *known.others) if known.is_rate(n)]
            lengths = [n for n in (*known.parameters, *known.coordinates) if known.dimension(n) == LENGTH]
            turns = [n for n in rates if known.dimension(n) != its]
            found: list[Node] = [n for n in rates if known.dimension(n) == its]
            if its.length:
                found += [Mul((length, turn)) for turn in turns for length in lengths]
            else:
                found += [Quotient(rate, length) for rate in turns for length in lengths]
            rows = np.array([sampled(node, self.values) for node in found]).reshape(len(found), -1)
            self._made[its] = found, rows
        return self._made[its]
