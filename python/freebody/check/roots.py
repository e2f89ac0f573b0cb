"""Parts that should be the square root of what stands there, or its square: v = 2 g h."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from freebody.symbolic.dimensions import LENGTH
from freebody.symbolic.evaluate import Array
from freebody.symbolic.tree import Add, Fn, Mul, Negative, Node, Num, Pow, Quotient, Sym

from .powers import power_of
from .solve_for_term import RequiredTerm
from .vocabulary import Vocabulary

_SAME = 1e-8  # relative: below it two values are one


def rooted(required: RequiredTerm) -> Iterator[Node]:
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
