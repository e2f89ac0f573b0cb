"""Forces that belong in the place of a weight."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from freebody.symbolic.dimensions import FORCE, MASS
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Mul, Node, Sym

from .coefficients import product
from .solve_for_term import RequiredTerm
from .vocabulary import Vocabulary

_SAME = 1e-8  # relative: below it two values are one


def pressing(required: RequiredTerm, values: Mapping[str, Array], vocabulary: Vocabulary) -> Iterator[Node]:
    """A term with a force for a weight: the normal force where something else presses, too."""
    factors = required.node.factors if isinstance(required.node, Mul) else ()
    mass = next((n for n in factors if isinstance(n, Sym) and vocabulary.parameters.get(n) == MASS), None)
    if mass is None or Sym("g") not in factors or required.needed.ndim != 1:
        return
    rest = [n for n in factors if n not in (mass, Sym("g"))]
    needed = required.needed / sampled(product(rest), values)
    for force in vocabulary.others:
        if vocabulary.dimension(force) == FORCE and np.allclose(values[force.key], needed, rtol=_SAME, atol=0):
            yield product([*rest, force])
