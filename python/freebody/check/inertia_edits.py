"""What moments of inertia may lack: the parallel axis of a body that is no bar about its end, and what all wheels add to a mass; what a share of
all that moves is; and the acceleration of a mass centre off the axes of its body."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations, product

import numpy as np

from freebody.symbolic.dimensions import ACCELERATION, INERTIA, LENGTH, MASS, PER_SECOND, STIFFNESS, TIME
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Add, Mul, Node, Num, Quotient, Sym

from .beside import signed
from .coefficients import multiplied
from .coefficients import product as product_of
from .language.statements import Equation, symbols_in
from .monomials import Monomials
from .powers import power_of, powers_of
from .solve_for_term import RequiredTerm
from .vocabulary import Vocabulary

_ABOUT_CENTRE = {1 / 3: 1 / 4, 4 / 3: 1 / 4, 3 / 2: 1 / 3, 5 / 4: 1 / 5, 7 / 5: 2 / 7}
"""By the number of an inertia about an end or the rim, its share that is about the mass centre: of bars, disks, rods of length 2 l, and balls."""
_MOST_WHEELS = 4
_MOST_ARMS = 8
_MOST_SHARING = 12
_MOST_INERTIAS = 40
_SAME = 1e-8  # relative: below it two values are one


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


def shares(required: RequiredTerm, vocabulary: Vocabulary, values: Mapping[str, Array]) -> Iterator[Node]:
    """A term times the share that it lacks: of what moved before an impact among all that moves on, m/(m + M) or J/(I + J + m l²); of one
    mass among all that a force accelerates; of one of two masses or stiffnesses in series, M/(m + M)."""
    node, factor, known = required.node, required.factor, {*vocabulary.parameters}
    if not node.symbols <= known or factor is None or factor.ndim != 1 or not np.all((factor > 0) & (factor < 1)):
        return
    masses, lengths, inertias, stiffnesses = (
        [n for n in vocabulary.parameters if vocabulary.dimension(n) == its] for its in (MASS, LENGTH, INERTIA, STIFFNESS)
    )
    turning = [*inertias, *(Mul((mass, power_of(length, 2))) for mass in masses for length in lengths)]
    for parts in (masses[:_MOST_SHARING], turning[:_MOST_SHARING], stiffnesses[:_MOST_SHARING]):
        rows = [sampled(part, values) for part in parts]
        for own in (i for i, part in enumerate(parts) if isinstance(part, Sym) or part.symbols <= node.symbols):
            others = [i for i in range(len(parts)) if i != own]
            for some in (some for count in (1, 2) for some in combinations(others, count)):
                if np.allclose(rows[own], factor * sum(rows[i] for i in (own, *some)), rtol=_SAME, atol=0):
                    yield Mul((node, Quotient(parts[own], Add(tuple(parts[i] for i in (own, *some))))), span=node.span)


def wheels(equation: Equation, vocabulary: Vocabulary, values: Mapping[str, Array]) -> tuple[list[Node], Array]:
    """What each body that turns with what moves adds to the mass, times its acceleration: J ẍ/r², and their values."""
    known = vocabulary
    moves = [n for n in symbols_in(equation) if known.dimension(n) == ACCELERATION and n not in known.parameters]
    inertias, lengths = ([n for n in known.parameters if known.dimension(n) == its] for its in (INERTIA, LENGTH))
    found: list[Node] = [
        Quotient(product_of([J, a]), power_of(r, 2))
        for a in moves
        for J in inertias[:_MOST_WHEELS]
        for r in lengths[:_MOST_WHEELS]
    ]
    count = len(next(iter(values.values())))
    return found, np.array([sampled(node, values) for node in found]).reshape(len(found), count)


def mass_centres(
    vocabulary: Vocabulary, values: Mapping[str, Array], parts: Sequence[Node], of_moment: bool
) -> tuple[list[Node], Array]:
    """A mass times each of some components of the acceleration of the end of an arm that turns: one for each of the two arms to what is off the axes of
    a body, or with these arms again ``of_moment`` about the end of the first; and their values."""
    masses, lengths = ([n for n in vocabulary.parameters if vocabulary.dimension(n) == its] for its in (MASS, LENGTH))
    arms = [(arm,) for arm in lengths[:_MOST_ARMS]]
    arms = [(arm, *other) for arm in lengths[:_MOST_ARMS] for other in arms] if of_moment else arms
    found: list[Node] = [product_of([mass, *arm, part]) for mass in masses[:_MOST_WHEELS] for arm in arms for part in parts]
    count = len(next(iter(values.values())))
    return found, np.array([sampled(node, values) for node in found]).reshape(len(found), count)


def of_whole(equation: Equation, missing: Array, vocabulary: Vocabulary, values: Mapping[str, Array]) -> Iterator[Node]:
    """What an energy lacks of several inertias that turn as one, ½ (I + J + μ ρ²) ω², or a moment, (I + J + μ ρ²) α."""
    known = vocabulary
    rates = [n for n in (*(Sym(q.name, 1) for q in known.coordinates), *known.others) if known.dimension(n) == PER_SECOND]
    moves: list[Node] = [Quotient(power_of(n, 2), Num(2.0, "2")) for n in rates]
    moves += [n for n in symbols_in(equation) if n not in known.parameters and known.dimension(n) == PER_SECOND.times(TIME, -1)]
    masses, lengths, inertias = ([n for n in known.sizes if known.dimension(n) == its] for its in (MASS, LENGTH, INERTIA))
    found: list[Node] = [*inertias, *(Mul((mass, power_of(length, 2))) for mass in masses for length in lengths)][:_MOST_INERTIAS]
    rows = np.array([sampled(node, values) for node in found])
    for move, sign in product(moves, (1.0, -1.0)):
        needed = sign * missing / sampled(move, values)
        if np.isfinite(needed).all() and np.all(needed > 0):
            for some in _adding_up(rows, needed):
                term = Mul((Add(tuple(found[i] for i in some)), move))
                yield signed(sign, term)


def _adding_up(rows: Array, needed: Array) -> Iterator[tuple[int, ...]]:
    """Two or three rows of which something is the sum."""
    nothing = _SAME * np.abs(needed).max()
    for i, j in combinations(range(len(rows)), 2):
        rest = needed - rows[i] - rows[j]
        if np.abs(rest).max() <= nothing:
            yield i, j
        elif np.all(rest > 0):
            yield from ((i, j, k) for k in np.flatnonzero(np.abs(rows - rest).max(axis=1) <= nothing).tolist() if k > j)
