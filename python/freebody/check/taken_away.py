"""Whether what is new in an equation only takes away what stood there."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np

from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Add, Node, addends, is_zero, unsigned, walk

from .language.dimensions import dimension
from .language.statements import Equation, terms
from .powers import powers_of
from .slips import is_constraint
from .solve_for_term import is_asked
from .vocabulary import Vocabulary

_OF_POWER = -3  # of time in the dimension of a power
_SAME = 1e-9  # relative: below it two values are one


@dataclass
class TakenAway:
    """Of one ``equation``, at the ``values`` of true states."""

    equation: Equation
    vocabulary: Vocabulary
    values: Mapping[str, Array]

    def by(self, after: Equation) -> bool:
        """Whether a new term takes away, at every true state, one of several terms as it is written, or a part of a bracket. A power may: that of
        what turns is the change of its energy; and what is asked for is not taken away by what it is."""
        now, known = [*_signed(after)], self.vocabulary
        own, whole = self._own
        its = (dimension(term, known.dimensions) for term in terms(after))
        if len(now) <= len(self._before) or any(of is not None and of.time == _OF_POWER for of in its):
            return False
        turned = [(-sign, term) for sign, term in self._before if (sign, term) not in now]
        asked = {unsigned(term) for side in self.differences for term in terms_of(side)}
        for sign, term in (each for each in now if each not in self._before and each not in turned):
            value, kept = sign * numbers(term, self.values), asked if term.symbols <= {*known.parameters} else ()
            if any(_same(value, -part) for node, part in own if unsigned(node) not in kept) or any(
                _same(np.abs(value), np.abs(part)) for node, part in whole if unsigned(node) not in kept
            ):
                return True
        return False

    def within(self, after: Equation, term: Node) -> bool:
        """Whether a term that stands in a bracket takes away another of it at every true state."""
        inner = (n for n in walk(after) if isinstance(n, Add) and n not in (after.left, after.right))
        return any(any(part is term for part in n.terms) and cancels_within(n, self.values) for n in inner)

    @cached_property
    def differences(self) -> list[Node]:
        """Motions of two parts beside each other, of which the equation says what that is."""
        sides = [side for side in map(unsigned, (self.equation.left, self.equation.right)) if isinstance(side, Add)]
        if is_constraint(self.equation, self.vocabulary):
            return []
        found = {n: self.vocabulary.dimension(n) for side in sides for n in side.symbols if n not in self.vocabulary.parameters}
        moves = lambda n: (its := found.get(n)) is not None and its.mass == 0
        return [side for side in sides if is_asked(side) and all(map(moves, side.symbols))]

    @cached_property
    def _before(self) -> list[tuple[int, Node]]:
        return [*_signed(self.equation)]

    @cached_property
    def _own(self) -> tuple[list[tuple[Node, Array]], list[tuple[Node, Array]]]:
        """The terms of the equation with their values, multiplied out, with signs, and, if there are several, as they are written."""
        whole = terms(self.equation) if len(terms(self.equation)) > 1 else []
        own = ((term, sign * numbers(term, self.values)) for sign, term in self._before)
        written = ((term, numbers(term, self.values)) for term in whole)
        return tuple([(term, value) for term, value in each if value.any()] for each in (own, written))  # type: ignore[return-value]


def cancels(equation: Equation) -> bool:
    """Whether a term stands in a sum beside its opposite, or on both sides; a product in any order."""
    sums = [_in_order(node) for node in walk(equation) if isinstance(node, Add)]
    if any(sign > 0 and (-1, term) in found for found in sums for sign, term in found):
        return True
    left, right = _in_order(equation.left), _in_order(equation.right)
    return len(left) + len(right) > 2 and any(each in right for each in left)


def says_the_same(one: Equation, other: Equation) -> bool:
    """Whether two equations have the same terms on their sides, products in any order and without what is above and below a line."""
    return all({*_in_order(a)} == {*_in_order(b)} for a, b in ((one.left, other.left), (one.right, other.right)))


def _in_order(side: Node) -> list[tuple[int, tuple[float, frozenset[tuple[Node, int]]]]]:
    """The terms of a sum by their signs, numbers and powers."""
    found = ((sign, *powers_of(term)) for sign, term in addends(side))
    powers = lambda each: frozenset((base, n) for base, n in each.items() if n)
    return [(sign if number > 0 else -sign, (abs(number), powers(each))) for sign, number, each in found]


def cancels_within(whole: Node, values: Mapping[str, Array]) -> bool:
    """Whether one part of a sum takes another away at every true state: then that is what has no place."""
    found = [numbers(part, values) for part in terms_of(whole)]
    return any(_same(one, -other) for one, other in combinations(found, 2))


def terms_of(side: Node) -> tuple[Node, ...]:
    """The terms of a sum, or what is none alone."""
    return side.terms if isinstance(side, Add) else (side,)


def numbers(node: Node, values: Mapping[str, Array]) -> Array:
    """The values of a number; NaN of a vector, and where there is none."""
    if not is_zero(node) and {n.key for n in node.symbols} <= values.keys():
        with suppress(StatementError):
            found = sampled(node, values)
            return found if found.ndim == 1 else np.full(1, np.nan)
    return np.full(1, np.nan)


def _signed(equation: Equation) -> Iterator[tuple[int, Node]]:
    """The terms of an equation with the signs that they have on its left side, multiplied out."""
    yield from addends(equation.left, expand=True)
    yield from ((-sign, term) for sign, term in addends(equation.right, expand=True))


def _same(one: Array, other: Array) -> bool:
    return np.allclose(one, other, rtol=_SAME, atol=0)
