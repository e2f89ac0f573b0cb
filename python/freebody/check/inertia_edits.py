"""What moments of inertia may lack: the parallel axis of a body that is no bar about its end, and what all wheels add to a mass."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from freebody.symbolic.dimensions import INERTIA, LENGTH, TIME
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Add, Node, Num, Pow, Quotient

from .coefficients import multiplied, product
from .language.statements import Equation, symbols_in
from .monomials import Monomials
from .powers import powers_of
from .solve_for_term import RequiredTerm
from .vocabulary import Vocabulary

_ABOUT_CENTRE = {1 / 3: 1 / 4, 4 / 3: 1 / 4, 3 / 2: 1 / 3, 5 / 4: 1 / 5, 7 / 5: 2 / 7}
"""By the number of an inertia about an end or the rim, its share that is about the mass centre: of bars, disks, rods of length 2 l, and balls."""
_MOST_WHEELS = 4
_ACCELERATION = LENGTH.times(TIME, -2)


def about_another_point(required: RequiredTerm, terms: Monomials) -> Iterator[Node]:
    """The inertia about the mass centre and m d² for one about the end or the rim."""
    number, powers = powers_of(required.node)
    share = next((its for own, its in _ABOUT_CENTRE.items() if np.isclose(number, own)), None)
    if share is None or required.missing.ndim != 1:
        return
    centre = multiplied(required.node, share)
    for term in terms.equal_to(required.needed - share * required.value) if centre is not None else ():
        its, others = powers_of(term)
        of_same_mass = all(others.get(n) == power for n, power in powers.items() if n not in _squared(powers))
        if its == 1 and of_same_mass and _squared(others):
            yield Add((centre, term), span=required.node.span)


def _squared(powers: Mapping[Node, int]) -> list[Node]:
    return [n for n, power in powers.items() if power == 2]


def wheels(equation: Equation, vocabulary: Vocabulary, values: Mapping[str, Array]) -> tuple[list[Node], Array]:
    """What each body that turns with what moves adds to the mass, times its acceleration: J ẍ/r², and their values."""
    known = vocabulary
    moves = [n for n in symbols_in(equation) if known.dimension(n) == _ACCELERATION and n not in known.parameters]
    inertias, lengths = ([n for n in known.parameters if known.dimension(n) == its] for its in (INERTIA, LENGTH))
    square = lambda n: Pow(n, Num(2.0, "2"))
    found: list[Node] = [
        Quotient(product([J, a]), square(r)) for a in moves for J in inertias[:_MOST_WHEELS] for r in lengths[:_MOST_WHEELS]
    ]
    count = len(next(iter(values.values())))
    return found, np.array([sampled(node, values) for node in found]).reshape(len(found), count)
