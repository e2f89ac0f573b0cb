"""Two terms of an equation that lack the same ratio."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations

import numpy as np

from freebody.symbolic.dimensions import NUMBER_ONLY
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Add, Mul, Node, exchange, is_zero, unsigned

from .edits import Edit
from .language.dimensions import dimension
from .language.spelling import spell
from .language.statements import Equation
from .monomials import Monomials
from .powers import written
from .solve_for_term import required_terms
from .vocabulary import Vocabulary

_SAME = 1e-8  # relative: below it a factor is the ratio
_HIGHEST = 2  # power of a symbol in a ratio
_MOST = 6  # terms of an equation of which two are thought of together


def shared_ratios(equation: Equation, values: Mapping[str, Array], vocabulary: Vocabulary, blur: float = 1.0) -> Iterator[Edit]:
    """Two terms, wherever they stand, that lack the same ratio, as what turns behind a gear does and what acts on it."""
    required = next(required_terms(equation, values), None)
    addends = addends_of(equation)
    if required is None or required.missing.ndim != 1 or not 3 < len(addends) <= _MOST:
        return
    parts = [sign * sampled(term, values) for term, sign in addends]
    sizes = [n for n in vocabulary.parameters if n not in vocabulary.angular]
    lacking = Monomials(values, sizes, (), blur)
    for i, j in combinations(range(len(addends)), 2):
        ratio = 1 - sum(parts) / (parts[i] + parts[j])
        powers = lacking.powers(ratio)
        factor = written(1.0, powers or {})
        if not powers or dimension(factor, vocabulary.dimensions) != NUMBER_ONLY or max(map(abs, powers.values())) > _HIGHEST:
            continue
        if np.allclose(sampled(factor, values), ratio, rtol=_SAME, atol=0):
            first, second = addends[i][0], addends[j][0]
            after = exchange(exchange(equation, first, Mul((factor, first))), second, Mul((factor, second)))
            words = f"`{spell(first)}` and `{spell(second)}` times `{spell(factor)}`"
            yield Edit("convention", None, factor, after, words=words)


def addends_of(equation: Equation) -> list[tuple[Node, int]]:
    """The terms of both sides, with the sign that each has where all stand on the left."""
    found = []
    for side, sign in ((equation.left, 1), (equation.right, -1)):
        for term in side.terms if isinstance(side, Add) else (side,):
            own = unsigned(term)
            found += [] if is_zero(own) else [(own, -sign if own is not term else sign)]
    return found
