"""Squares of speeds that lack a part of the speed, and of stretches that lack a length; sums of two that are those of other components."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import combinations, islice, permutations
from itertools import product as product_of

import numpy as np

from freebody.symbolic.dimensions import ACCELERATION, LENGTH, PER_SECOND, SPEED, Dimension
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Add, Fn, Mul, Negative, Node, Num, Pow, Quotient, Sym, exchange, unsigned

from .beside import signed
from .coefficients import more, multiplied, product, snapped
from .edits import Edit, depth
from .language.dimensions import dimension
from .language.statements import Equation
from .powers import power_of, powers_of, written
from .roots import calls_of
from .solve_for_term import RequiredTerm
from .vocabulary import Vocabulary

_MOST_ANGLES = 8
_NEARLY = 1e-5  # relative spread below which a factor is meant to be one number, or a sum what is needed
_SPEEDS = (SPEED, PER_SECOND)


def _root(square: Node) -> Node | None:
    """What a term is the square of; None where it is of none."""
    number, powers = powers_of(square)
    if number <= 0 or any(power % 2 for power in powers.values()):
        return None
    return written(float(np.sqrt(number)), {n: power // 2 for n, power in powers.items()})


@dataclass
class SquareEdits:
    """What the squares of speeds may lack; ``values`` are those of true states."""

    values: Mapping[str, Array]
    vocabulary: Vocabulary
    _made: dict[Dimension, tuple[list[Node], Array]] = field(default_factory=dict)

    def edits(self, equation: Equation, required: RequiredTerm) -> Iterator[Edit]:
        """The square of a speed that is that of something else, and of one that lacks a part: that of the ground, or of a rotation; of a
        component of an acceleration that lacks its centripetal part."""
        node, base = required.node, required.node.base if isinstance(required.node, Pow) else None
        its = None if base is None else dimension(base, self.vocabulary.dimensions)
        if base is None or its not in (*_SPEEDS, ACCELERATION, LENGTH) or node.exponent != Num(2.0) or required.needed.ndim != 1:
            return
        value, lost = sampled(base, self.values), required.missing
        if not np.isfinite(lost).all() or not lost.any():
            return
        nodes, rows = self._parts(its)
        alike = (np.abs(rows**2 - required.needed) <= _NEARLY * np.abs(required.needed)).all(axis=1)
        for other in (nodes[place] for place in np.flatnonzero(alike) if not isinstance(nodes[place], Sym)):
            yield Edit.at(equation, "symbol", node, Pow(other, node.exponent, span=node.span), 0.02 * depth(other))
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

    def with_another(self, required: RequiredTerm) -> Iterator[Node]:
        """The size of a speed of which only one part was said: with that of what turns or moves along, at an angle to it."""
        value, needed = required.value, required.needed
        if not required.addend or dimension(required.node, self.vocabulary.dimensions) != _SPEEDS[0] or value.ndim > 1:
            return
        nodes, rows = self._parts_of_speeds(_SPEEDS[0])
        cosines = (needed**2 - value**2 - rows**2) / (2 * value * rows)  # of the angle between both
        for call, its in calls_of(self.vocabulary, self.values):
            for place, sign in ((place, sign) for sign in (2.0, -2.0) for place in range(len(nodes))):
                if np.all(needed > 0) and np.abs(cosines[place] - sign / 2 * its).max() <= _NEARLY:
                    number, powers = powers_of(Mul((required.node, nodes[place], call)))
                    squares = (power_of(unsigned(node), 2) for node in (required.node, nodes[place]))
                    yield Fn("sqrt", (Add((*squares, written(sign * number, powers))),), span=required.node.span)

    def _speeds_squared(self, node: Add) -> list[Node]:
        """The speeds of which terms of a sum are the squares."""
        speed = _SPEEDS[0].times(_SPEEDS[0])
        squares = (term for term in node.terms if dimension(term, self.vocabulary.dimensions) == speed)
        return [root for root in map(_root, squares) if root is not None]

    def crossed(self, node: Add, missing: Array) -> Iterator[Node]:
        """What the square of a sum of two velocities has beside their squares: that of a point by its components, and that of what turns about it."""
        roots = self._speeds_squared(node)
        rates = [n for n in roots if isinstance(n, Sym) and n.dots]
        for whole in (n for n in roots if n not in rates):
            for (one, other), angle in product_of(permutations(rates, 2), self.vocabulary.angles):
                parts = [Mul((one, Fn("cos", (angle,)))), Mul((other, Fn("sin", (angle,))))]
                along, across = (sampled(Mul((Num(2.0, "2"), whole, part)), self.values) for part in parts)
                for signs in product_of((1, -1), repeat=2):
                    if np.abs(signs[0] * along + signs[1] * across - missing).max() <= _NEARLY * np.abs(missing).max():
                        both = Add(tuple(map(signed, signs, parts)))
                        yield Mul((Num(2.0, "2"), whole, both))

    def at_an_angle(self, node: Add, missing: Array) -> Iterator[Node]:
        """What the law of cosines has beside the squares of two speeds, of which the directions have an angle between them."""
        known = self.vocabulary
        named = (n for n in known.angles if n.key in self.values and (n in known.letters or n not in known.others))
        angles = [*islice(named, _MOST_ANGLES)]
        for pair in combinations(self._speeds_squared(node), 2):
            both = Mul((Num(2.0, "2"), *pair))
            cosine = missing / sampled(both, self.values)
            if not np.isfinite(cosine).all() or np.abs(cosine).max() > 1 + _NEARLY:
                continue
            for some in (some for count in (1, 2, 3) for some in combinations(angles, count)):
                for signs in product_of((1, -1), repeat=len(some) - 1):
                    parts = (some[0], *map(signed, signs, some[1:]))
                    angle = parts[0] if len(parts) == 1 else Add(parts)
                    for name, sign in product_of(("cos", "sin"), (1.0, -1.0)):
                        call = Fn(name, (angle,))
                        if np.abs(sign * sampled(call, self.values) - cosine).max() <= _NEARLY:
                            yield signed(sign, Mul((*both.factors, call)))

    def of_components(
        self,
        equation: Equation,
        addends: Sequence[tuple[Node, Node]],
        missing: Array,
        change: Callable[[Array], Array] = np.asarray,
    ) -> Iterator[Edit]:
        """Two squares of speeds that should be those of two other components, or lack a part each: that of what turns. ``addends`` come with what
        they are multiplied by; ``missing`` is what the equation lacks, or how that ``change``s along the motions."""
        found = [(term, self._of_speed(term), self._of_speed(product([before, term]))) for term, before in addends]
        for pair in combinations([each for each in found if each[1]], 2):
            (one, two), terms = (speed for _, (speed, _, _), _ in pair), [term for term, _, _ in pair]
            (_, *before), (_, *beside) = (whole for _, _, whole in pair)
            if before != beside or dimension(one, self.vocabulary.dimensions) != _SPEEDS[0]:
                continue
            needed = sum(change(sampled(speed, self.values) ** 2) for speed in (one, two)) + missing / sampled(
                written(*before), self.values
            )
            (ones, first), (twos, second) = map(self._instead_of, (one, two))
            off = np.abs(change(first)[:, None] + change(second) - needed).max(axis=2)
            for i, j in np.argwhere(off <= _NEARLY * np.abs(needed).max()).tolist():
                new = [
                    written(number, {**rest, speed: 2})
                    for (_, (_, number, rest), _), speed in zip(pair, (ones[i], twos[j]), strict=True)
                ]
                after = exchange(exchange(equation, terms[0], new[0]), terms[1], new[1])
                whole = Add(tuple(new))
                yield Edit("squares", Add(tuple(terms)), whole, after, 0.01 * depth(whole))

    def _of_speed(self, term: Node) -> tuple[Node, float, dict[Node, int]] | None:
        """The speed that is squared in a term, and what it is multiplied by there, as a number and powers."""
        number, powers = powers_of(term)
        speeds = [n for n, power in powers.items() if power == 2 and dimension(n, self.vocabulary.dimensions) in _SPEEDS]
        if len(speeds) != 1:
            return None
        return speeds[0], number, {n: power for n, power in powers.items() if n is not speeds[0]}

    def _instead_of(self, speed: Node) -> tuple[list[Node], Array]:
        """A speed, the rates of coordinates, and it with a part in either sense, and their squares."""
        parts, _ = self._parts_of_speeds(_SPEEDS[0])
        rates = [n for n in parts if isinstance(n, Sym)]
        found = [speed, *rates, *(more(speed, part) for n in parts if n not in rates for part in (n, Negative(n)))]
        return found, np.array([sampled(node, self.values) ** 2 for node in found])

    def _parts(self, its: Dimension) -> tuple[list[Node], Array]:
        """What may be lacking of something of a dimension, and its values."""
        return (
            self._lengths
            if its == LENGTH
            else self._parts_of_accelerations
            if its == ACCELERATION
            else self._parts_of_speeds(its)
        )

    @cached_property
    def _lengths(self) -> tuple[list[Node], Array]:
        """Lengths of the model, and their values: the stretch of a spring lacks that at which it is free, or is met."""
        found: list[Node] = [
            n for n in (*self.vocabulary.parameters, *self.vocabulary.coordinates) if self.vocabulary.dimension(n) == LENGTH
        ]
        return found, self._rows(found)

    def _rows(self, found: Sequence[Node]) -> Array:
        """The values of expressions, a row each."""
        count = len(next(iter(self.values.values())))
        return np.array([np.broadcast_to(sampled(node, self.values), count) for node in found]).reshape(len(found), count)

    @cached_property
    def _parts_of_accelerations(self) -> tuple[list[Node], Array]:
        """Lengths times squares of rates, and their values."""
        known = self.vocabulary
        turns = [n for n in (*known.parameters, *(Sym(q.name, 1) for q in known.coordinates)) if known.dimension(n) == _SPEEDS[1]]
        lengths = [n for n in (*known.parameters, *known.coordinates) if known.dimension(n) == LENGTH]
        found = [Mul((length, Pow(turn, Num(2.0, "2")))) for turn in turns for length in lengths]
        return found, self._rows(found)

    def _parts_of_speeds(self, its: Dimension) -> tuple[list[Node], Array]:
        """Rates, and rates times a length, of a dimension, and their values."""
        if its not in self._made:
            known = self.vocabulary
            steady = [n for n in known.parameters if known.is_rate(n)]
            is_driven = lambda n: any(np.allclose(self.values[n.key], self.values[given.key]) for given in steady)
            rates = [n for n in (Sym(q.name, 1) for q in known.coordinates) if not is_driven(n)]
            rates += [*steady, *(n for n in known.others if known.is_rate(n))]
            lengths = [n for n in (*known.parameters, *known.coordinates) if known.dimension(n) == LENGTH]
            turns = [n for n in rates if known.dimension(n) != its]
            found: list[Node] = [n for n in rates if known.dimension(n) == its]
            if its.length:
                found += [Mul((length, turn)) for turn in turns for length in lengths]
            else:
                found += [Quotient(rate, length) for rate in turns for length in lengths]
            self._made[its] = found, self._rows(found)
        return self._made[its]
