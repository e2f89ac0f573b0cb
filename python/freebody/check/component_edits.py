"""Two terms of an equation that each lack a factor of their own, as forces of which the components along a direction were meant, or in which two
letters stand for each other."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations, permutations, product

import numpy as np

from freebody.symbolic.dimensions import LENGTH
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Add, Fn, Mul, Negative, Node, Quotient, exchange, substitute, unsigned, walk

from .edits import Edit
from .language.dimensions import dimension
from .language.spelling import spell
from .language.statements import Equation
from .powers import powers_of, written
from .shared_ratios import addends_of
from .vocabulary import Vocabulary

_SAME, _ALIKE = 1e-8, 1e-5  # relative: below it two values are one, and two ratios
_MOST = 6  # terms of an equation of which two are thought of together
_MOST_LENGTHS = 6


def exchanges(equation: Equation, vocabulary: Vocabulary) -> Iterator[Edit]:
    """Two letters of one kind exchanged in two terms, and not in others: radii, of which each force got that of the other."""
    sums = (
        [unsigned(term) for term in n.terms]
        for n in walk(equation)
        if isinstance(n, Add) and n not in (equation.left, equation.right)
    )
    for terms in ([term for term, _ in addends_of(equation)], *sums):
        for one, two in combinations(terms, 2) if len(terms) <= _MOST else ():
            for own in sorted(one.symbols - two.symbols, key=lambda n: n.key):
                for other in (n for n in vocabulary.alike(own) if n in two.symbols - one.symbols):
                    if sum(n in (own, other) for n in walk(equation)) == sum(n in (own, other) for n in (*walk(one), *walk(two))):
                        continue  # it is so wherever they stand
                    after = exchange(equation, one, substitute(one, {own: other}))
                    words = f"`{own.key}` and `{other.key}` exchanged in `{spell(one)}` and `{spell(two)}`"
                    yield Edit("exchange", None, None, exchange(after, two, substitute(two, {other: own})), words=words)


def component_edits(equation: Equation, values: Mapping[str, Array], vocabulary: Vocabulary) -> Iterator[Edit]:
    """Two terms, wherever they stand, each times a sine, a cosine or the ratio of two lengths."""
    addends = addends_of(equation)
    parts = [sign * sampled(term, values) for term, sign in addends]
    if not 2 < len(parts) <= _MOST or any(part.ndim > 1 for part in parts):
        return
    factors, rows = _factors(equation, values, vocabulary)
    for i, j in combinations(range(len(parts)), 2) if factors else ():
        with np.errstate(all="ignore"):
            needed = -(sum(parts) - parts[i] - parts[j] + rows * parts[i]) / parts[j]
        for k, m in _equal(needed, rows):
            (one, _), (two, _) = addends[i], addends[j]
            first, second = (written(*powers_of(Mul(pair))) for pair in ((one, factors[k]), (two, factors[m])))
            words = f"`{spell(first)}` and `{spell(second)}` for `{spell(one)}` and `{spell(two)}`"
            after = exchange(exchange(equation, one, first), two, second)
            yield Edit("components", None, second, after, words=words)


def _equal(needed: Array, rows: Array) -> Iterator[tuple[int, int]]:
    """Which rows are one: on the first state few are."""
    with np.errstate(all="ignore"):
        nothing, order = _SAME * np.abs(needed).max(axis=1), np.argsort(rows[:, 0])
        begin, end = (np.searchsorted(rows[order, 0], needed[:, 0] + off) for off in (-nothing, nothing))
    for k in np.flatnonzero(np.isfinite(nothing) & (end > begin)).tolist():
        yield from ((k, m) for m in order[begin[k] : end[k]].tolist() if np.abs(rows[m] - needed[k]).max() <= nothing[k])


def _factors(equation: Equation, values: Mapping[str, Array], vocabulary: Vocabulary) -> tuple[list[Node], Array]:
    """Sines, cosines, and ratios of lengths that change with the motion, also of what is added up in the equation, and their values."""
    calls = [n for n in vocabulary.single_factors if isinstance(n, Fn) and {k.key for k in n.symbols} <= values.keys()]
    lengths = [n for n in vocabulary.sizes if vocabulary.dimension(n) == LENGTH and np.all(values[n.key])]
    still = [n for n in lengths if n in vocabulary.parameters][:_MOST_LENGTHS]
    moving: list[Node] = [n for n in lengths if n not in vocabulary.parameters][:_MOST_LENGTHS]
    moving += [Add((a, Negative(b))) for pairs in (product(still, moving), combinations(moving, 2)) for a, b in pairs]
    said = (n for n in walk(equation) if isinstance(n, Add) and dimension(n, vocabulary.dimensions) == LENGTH)
    moving = [*dict.fromkeys((*said, *moving))]
    every = [*still, *moving]
    sizes = [sampled(n, values) for n in every]
    count = len(next(iter(values.values())))
    fixed = np.array([np.ones(count), *(np.abs(sizes[i] / sizes[k]) for i, k in permutations(range(len(still)), 2))])
    ratios = []
    for i, k in ((i, k) for i, k in permutations(range(len(every)), 2) if max(i, k) >= len(still) and sizes[k].all()):
        ratio = sizes[i] / sizes[k]
        # where it is a number, or the ratio of two lengths, on all motions, the speeds of two parts are in that ratio: no component
        if not np.any(np.all(np.abs(np.abs(ratio) - fixed) <= _ALIKE * fixed, axis=1)):
            ratios.append((Quotient(every[i], every[k]), ratio))
    rows = [*(sampled(n, values) for n in calls), *(row for _, row in ratios)]
    return [*calls, *(ratio for ratio, _ in ratios)], np.array(rows)
