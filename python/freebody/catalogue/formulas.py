"""Symbolic answers, beside closed forms."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING

from freebody.catalogue.answers import Answer

if TYPE_CHECKING:
    from freebody.symbolic.letters import Letters
    from freebody.symbolic.tree import Tree

PLACES = 4
"""Places of random letters at which an answer and its closed form are compared."""
RANGE = (0.3, 1.4)
"""Of the letters: angles stay below a right angle."""
TOLERANCE = 1e-9
_SEED = 9


def formula(label: str, found: Tree, closed: str, against: str, letters: Letters | None = None) -> Answer:
    """a symbolic answer beside a closed form in the words of the model language, ``rate(theta)`` for a rate: both at random
    values of all letters, of which neither knows anything."""
    from freebody.equations.language import read_text
    from freebody.symbolic.decimals import shown
    from freebody.symbolic.evaluate import evaluate
    from freebody.symbolic.printers.text import text
    from freebody.symbolic.tree import symbols

    true, draw = read_text(closed), random.Random(_SEED)
    every = sorted(symbols(found, true), key=str)
    places = [{letter: draw.uniform(*RANGE) for letter in every} for _ in range(PLACES)]
    value, check = ([float(evaluate(tree, place)) for place in places] for tree in (found, true))
    return Answer(label, value, "", check, against, TOLERANCE, said=text(shown(found), letters))
