"""Energy said to be kept in an impact, where momentum is."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from freebody.symbolic.dimensions import ACCELERATION, LENGTH, PER_SECOND, SPEED
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import ZERO, Add, Fn, Mul, Negative, Node, Num, Sym, addends, is_zero

from .edits import Edit
from .language.statements import Equation
from .powers import powers_of, written
from .vocabulary import Vocabulary

_PARTS = (1.0, 0.5)  # of a length, as an arm
_HELD = 1e-9  # relative: below it a sum is 0
_MOST_ARMS = 2  # momenta that have one, all lengths being tried for each


@dataclass(frozen=True)
class _Momentum:
    """What a kinetic energy C s²/2 is the half of, divided by its speed s: C s; ``turns`` where s is the rate of an angle."""

    number: float
    powers: dict[Node, int]
    turns: bool

    def about(self, arm: tuple[float, Sequence[Node]]) -> Node:
        """It as a term, with an arm."""
        return written(self.number * arm[0], {**self.powers, **dict.fromkeys(arm[1], 1)})


_NO_ARM: tuple[float, Sequence[Node]] = (1.0, ())


def momentum_edits(equation: Equation, vocabulary: Vocabulary, values: Mapping[str, Array]) -> Iterator[Edit]:
    """Where kinetic energies are said to be equal: the balances of their momenta, and of these about a point, that hold."""
    sides = [
        [(sign, term) for sign, term in addends(side, expand=True) if not is_zero(term)]
        for side in (equation.left, equation.right)
    ]
    found = [[_momentum(sign, term, vocabulary) for sign, term in side] for side in sides]
    momenta = [each for side in found for each in side if each is not None]
    heavy = any((its := vocabulary.dimension(n)) is not None and its.mass for n in equation.symbols)
    if len(momenta) < sum(map(len, sides)) or len(momenta) < 2 or not heavy:
        return
    lengths = [n for n in (*vocabulary.parameters, *vocabulary.coordinates) if vocabulary.dimension(n) == LENGTH]
    leaning: list[tuple[Node, ...]] = [(), *((Fn(name, (angle,)),) for angle in vocabulary.angles for name in ("sin", "cos"))]
    arms = [(part, (length, *lean)) for part in _PARTS for length in lengths for lean in leaning]
    whole = any(each.turns for each in momenta)
    asked = [[_NO_ARM] if each.turns or not whole else arms for each in momenta]
    if sum(len(each) > 1 for each in asked) > _MOST_ARMS:
        return
    side_of = [1.0] * len(found[0]) + [-1.0] * len(found[1])
    for chosen in _balanced(momenta, asked, side_of, values):
        left, right = chosen[: len(found[0])], chosen[len(found[0]) :]
        words = "momenta in the place of kinetic energies"
        yield Edit("momentum", None, _sum(chosen), Equation(_sum(left), _sum(right)), words=words)


def _momentum(sign: int, term: Node, vocabulary: Vocabulary) -> _Momentum | None:
    """Of a term that is a kinetic energy of one speed, or that of a fall, m g h, from which the speed is √(2 g h)."""
    number, powers = powers_of(term)
    of = {base: vocabulary.dimension(base) for base in powers if isinstance(base, Sym)}
    speeds = [base for base, its in of.items() if powers[base] == 2 and its in (SPEED, PER_SECOND)]
    if len(speeds) == 1:
        (speed,) = speeds
        return _Momentum(2 * sign * number, {**powers, speed: 1}, of[speed] == PER_SECOND)
    fall = [
        next((base for base, its in of.items() if its == wanted and powers[base] == 1), None) for wanted in (ACCELERATION, LENGTH)
    ]
    if speeds or None in fall or len(powers) != len(of):
        return None
    speed_of_fall = Fn("sqrt", (Mul((Num(2.0, "2"), *filter(None, fall))),))
    rest = {base: n for base, n in powers.items() if base not in fall}
    return _Momentum(sign * number, {**rest, speed_of_fall: 1}, False)


def _balanced(
    momenta: Sequence[_Momentum],
    asked: Sequence[Sequence[tuple[float, Sequence[Node]]]],
    side_of: Sequence[float],
    values: Mapping[str, Array],
) -> Iterator[list[Node]]:
    """Terms, in any senses and with any of the arms, whose sum is 0: the last of those that have a choice is found from all others."""
    order = sorted(range(len(momenta)), key=lambda i: len(asked[i]))
    terms = [[momenta[i].about(arm) for arm in asked[i]] for i in range(len(momenta))]
    rows = [
        side * np.array([np.broadcast_to(sampled(term, values), _shape(values)) for term in some])
        for side, some in zip(side_of, terms, strict=True)
    ]
    *first, last = order
    for senses in product((1.0, -1.0), repeat=len(momenta) - 1):
        of = dict(zip(order, (1.0, *senses), strict=True))
        for places in product(*(range(len(terms[i])) for i in first)):
            parts = [of[i] * rows[i][place] for i, place in zip(first, places, strict=True)]
            left = np.abs(sum(parts) + of[last] * rows[last]).max(axis=1)
            for place in np.flatnonzero(left < _HELD * np.abs(rows[last]).max(axis=1)).tolist():
                at = dict(zip(order, (*places, place), strict=True))
                yield [terms[i][at[i]] if of[i] > 0 else Negative(terms[i][at[i]]) for i in range(len(momenta))]


def _shape(values: Mapping[str, Array]) -> tuple[int, ...]:
    return next(iter(values.values())).shape[:1]


def _sum(terms: Sequence[Node]) -> Node:
    return Add(tuple(terms)) if len(terms) > 1 else terms[0] if terms else ZERO
