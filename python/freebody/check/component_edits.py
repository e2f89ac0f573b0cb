"""Two terms of an equation that each lack a factor of their own, as forces of which the components along a direction were meant."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations, permutations

import numpy as np

from freebody.symbolic.dimensions import LENGTH
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Fn, Mul, Node, Quotient, exchange

from .edits import Edit
from .language.spelling import spell
from .language.statements import Equation
from .shared_ratios import addends_of
from .vocabulary import Vocabulary

_SAME = 1e-8  # relative: below it two values are one
_MOST = 6  # terms of an equation of which two are thought of together
_MOST_LENGTHS = 6


def component_edits(equation: Equation, values: Mapping[str, Array], vocabulary: Vocabulary) -> Iterator[Edit]:
    """Two terms, wherever they stand, each times a sine, a cosine or the ratio of two lengths."""
    addends = addends_of(equation)
    parts = [sign * sampled(term, values) for term, sign in addends]
    if not 2 < len(parts) <= _MOST or any(part.ndim > 1 for part in parts):
        return
    factors = [*_factors(vocabulary, values)]
    if not factors:
        return
    rows = np.array([sampled(factor, values) for factor in factors])
    for i, j in combinations(range(len(parts)), 2):
        others = sum(parts) - parts[i] - parts[j]
        for k, row in enumerate(rows):
            needed = -(others + row * parts[i]) / parts[j]
            for m in np.flatnonzero(np.abs(rows - needed).max(axis=1) <= _SAME * np.abs(needed).max()).tolist():
                (one, _), (two, _) = addends[i], addends[j]
                first, second = Mul((one, factors[k])), Mul((two, factors[m]))
                words = f"`{spell(first)}` and `{spell(second)}` for `{spell(one)}` and `{spell(two)}`"
                after = exchange(exchange(equation, one, first), two, second)
                yield Edit("components", None, second, after, words=words)


def _factors(vocabulary: Vocabulary, values: Mapping[str, Array]) -> Iterator[Node]:
    """Sines, cosines, and ratios of lengths, of which one at least changes with the motion."""
    yield from (n for n in vocabulary.single_factors if isinstance(n, Fn) and {k.key for k in n.symbols} <= values.keys())
    lengths = [n for n in vocabulary.sizes if vocabulary.dimension(n) == LENGTH and np.all(values[n.key])]
    still = [n for n in lengths if n in vocabulary.parameters][:_MOST_LENGTHS]
    moving = [n for n in lengths if n not in vocabulary.parameters][:_MOST_LENGTHS]
    yield from (Quotient(*pair) for pair in permutations((*still, *moving), 2) if not {*pair} <= {*still})
