"""Parts that should be the square root of what stands there, or its square: v = 2 g h."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from freebody.symbolic.tree import Add, Fn, Mul, Node, Num, Pow, Quotient

from .solve_for_term import RequiredTerm

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
