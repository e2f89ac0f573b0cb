"""What is said to be constant beside the energy of the model, term by term."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from freebody.equations import read
from freebody.symbolic.evaluate import Array
from freebody.symbolic.tree import ZERO, Add, Node, addends

from .beside import Letters, difference, signed
from .language.statements import Equation, symbols_in

if TYPE_CHECKING:
    from .case import Case

_MOST = 5  # terms that are told to be lacking


def lacking_energies(case: Case, node: Node, value: Callable[[Node], Array]) -> tuple[Node, ...]:
    """The terms of the energy that an expression lacks; none where it has others, or nothing in common with it. ``value`` is how a term
    changes along the motions."""
    if not case.admissible:
        return ()
    answer = case.sampler.core.symbolic_answers(case.samples().states[0], [{"ask": "energy"}])
    letters = Letters(case, Equation(node, ZERO), answer.symbols)
    energy = Add((read(answer.answers[0]["kinetic"]), read(answer.answers[0]["potential"])))
    terms = [term for term, _ in letters.terms(energy, ZERO)]
    if not {n.key for term in terms for n in symbols_in(term)} <= case.values().keys():
        return ()
    true = [(term, change) for term in terms if np.any(change := value(term))]
    said = [(signed(sign, term), value(signed(sign, term))) for sign, term in addends(node, expand=True)]
    found = difference([each for each in said if np.any(each[1])], true)
    return found.missing if found.common and not found.strange and len(found.missing) <= _MOST else ()
