"""Parts that should be the square root of what stands there, or its square, v = 2 g h; and sizes that should be those of two components together."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations, product

import numpy as np

from freebody.symbolic.dimensions import ACCELERATION, FORCE, LENGTH, SPEED, TIME
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Add, Fn, Mul, Negative, Node, Num, Pow, Quotient, Sym, unsigned

from .coefficients import more
from .language.dimensions import dimension
from .monomials import Monomials
from .powers import power_of, powers_of, written
from .solve_for_term import RequiredTerm
from .vocabulary import Vocabulary

_SAME = 1e-8  # relative: below it two values are one
_OF_VECTORS = (LENGTH, SPEED, ACCELERATION, FORCE, FORCE.times(TIME, 1))
_OF_MOTION = (SPEED, FORCE.times(TIME, 1))
_MOST_FACTORS = 6  # of a product of which some stand below a root
_MOST_TERMS = 4  # of a sum that is that of two components


def rooted(required: RequiredTerm, values: Mapping[str, Array]) -> Iterator[Node]:
    """The root of a product or a sum, or the square of a root, where that is needed."""
    node, value, needed = required.node, required.value, required.needed
    if value.ndim != 1 or needed.ndim != 1 or not np.isfinite(needed).all():
        return
    if isinstance(node, Fn) and node.name == "sqrt" and np.allclose(value**2, needed, rtol=_SAME, atol=0):
        yield node.args[0]
    elif isinstance(node, Add | Mul | Quotient) and np.allclose(needed**2, value, rtol=_SAME, atol=0) and np.all(needed >= 0):
        yield Fn("sqrt", (node,), span=node.span)
    elif isinstance(node, Add | Mul | Quotient) and np.allclose(needed, value**2, rtol=_SAME, atol=0):
        yield Pow(node, Num(2.0, "2"), span=node.span)
    elif isinstance(node, Mul | Quotient):
        yield from _rooted_in_part(node, needed / value, values)


def _rooted_in_part(node: Node, factor: Array, values: Mapping[str, Array]) -> Iterator[Node]:
    """A product in which some of what stands there is below a root: v √(k m) for v k m."""
    number, powers = powers_of(node)
    bases = list(powers) if len(powers) <= _MOST_FACTORS else []
    parts = (some for count in range(1, len(bases)) for some in combinations(bases, count))
    for some in (some for some in parts if any(powers[base] % 2 for base in some)):  # √(r²) is r
        rest = {base: n for base, n in powers.items() if base not in some}
        for inside, before in ((1.0, number), (abs(number), math.copysign(1.0, number))):
            below = written(inside, {base: powers[base] for base in some})
            size = np.abs(sampled(below, values))
            if size.shape == factor.shape and np.allclose(factor**2 * size, 1.0, rtol=_SAME, atol=0):
                yield written(before, {**rest, Fn("sqrt", (below,)): 1})


def other_sides(required: RequiredTerm, values: Mapping[str, Array], vocabulary: Vocabulary) -> Iterator[Node]:
    """Another side of the right triangle of which a length is one and a second length another."""
    own, needed, known = required.node, required.needed, vocabulary
    if not isinstance(own, Sym) or known.parameters.get(own) != LENGTH or needed.ndim != 1 or not np.all(needed > 0):
        return
    for other in (n for n, its in known.parameters.items() if its == LENGTH and n != own):
        a, b, one, two = power_of(own, 2), power_of(other, 2), required.value**2, values[other.key] ** 2
        for sides, value in (((a, Negative(b)), one - two), ((a, b), one + two), ((b, Negative(a)), two - one)):
            if np.allclose(value, needed**2, rtol=_SAME, atol=0):
                yield Fn("sqrt", (Add(sides),), span=own.span)


def resultants(
    required: RequiredTerm, values: Mapping[str, Array], vocabulary: Vocabulary, terms: Monomials
) -> Iterator[tuple[Node, int]]:
    """For components that are simply added, the root of the sum of their squares, also of two at an angle; for one of them alone, the root of its
    square and that of the other; with how many components are new."""
    node, value, needed = required.node, required.value, required.needed
    if value.ndim != 1 or needed.ndim != 1 or not np.isfinite(needed).all() or not np.all(needed > 0):
        return
    if isinstance(node, Add):
        yield from ((Fn("sqrt", (whole,), span=node.span), 0) for whole in _at_angles(node, needed**2, values, vocabulary))
    elif isinstance(node, Pow) and isinstance(node.base, Add) and node.exponent == Num(2.0):
        yield from ((whole, 0) for whole in _at_angles(node.base, needed, values, vocabulary))
    rest, its = needed**2 - value**2, dimension(node, vocabulary.dimensions)
    if required.addend and its in _OF_VECTORS and np.all(rest > _SAME * needed**2):
        for other in terms.equal_to(np.sqrt(rest), in_size=True):
            yield Fn("sqrt", (Add((_squared(node), _squared(other))),), span=node.span), 1


def on_the_way(required: RequiredTerm, values: Mapping[str, Array], vocabulary: Vocabulary, terms: Monomials) -> Iterator[Node]:
    """For a speed or momentum that was taken to stay as it was, the root of its square and what is lost or won on the way: √(v₀² − 2 μ g d)."""
    node, value, needed = required.node, required.value, required.needed
    if not required.addend or dimension(node, vocabulary.dimensions) not in _OF_MOTION or value.ndim != 1 or needed.ndim != 1:
        return
    rest, known = needed**2 - value**2, {*vocabulary.parameters, *vocabulary.coordinates}
    if node.symbols <= {*vocabulary.parameters} and np.all(needed > 0) and np.all(np.abs(rest) > _SAME * needed**2):
        for other in terms.equal_to(rest):
            if other.symbols <= known and not any(n.dots for n in other.symbols):
                yield Fn("sqrt", (more(_squared(node), other),), span=node.span)


def _at_angles(whole: Add, needed: Array, values: Mapping[str, Array], vocabulary: Vocabulary) -> Iterator[Node]:
    """The square of the size of two vectors together, of which the sizes were added, at right angles or by the law of cosines."""
    calls = [call for call, _ in calls_of(vocabulary, values)]
    for one, two in _halves(whole.terms):
        a, b = sampled(one, values), sampled(two, values)
        rest = needed - a**2 - b**2
        if not (a.any() and b.any()):  # what is 0 makes no angle
            continue
        if np.all(np.abs(rest) <= _SAME * needed):
            yield Add((_squared(one), _squared(two)))
        for call, sign in product(calls, (2.0, -2.0)):
            if np.allclose(sign * a * b * sampled(call, values), rest, rtol=_SAME, atol=0):
                number, powers = powers_of(Mul((one, two, call)))
                yield Add((_squared(one), _squared(two), written(sign * number, powers)))


def calls_of(vocabulary: Vocabulary, values: Mapping[str, Array]) -> Iterator[tuple[Fn, Array]]:
    """The sines and cosines of angles that change, and their values."""
    known = (n for n in vocabulary.single_factors if isinstance(n, Fn) and {k.key for k in n.symbols} <= values.keys())
    yield from ((call, value) for call in known if np.ptp(value := sampled(call, values)) > _SAME)


def _halves(terms: Sequence[Node]) -> Iterator[tuple[Node, Node]]:
    """A sum as two."""
    joined = lambda some: some[0] if len(some) == 1 else Add(tuple(some))
    for count in range(1, len(terms) // 2 + 1):
        for some in combinations(terms, count) if len(terms) <= _MOST_TERMS else ():
            if 2 * count < len(terms) or terms[0] in some:
                yield joined(some), joined([term for term in terms if term not in some])


def _squared(node: Node) -> Node:
    return power_of(unsigned(node), 2)
