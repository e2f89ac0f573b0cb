"""A quantity that should be another wherever it stands: a mass without that of what turns with it, an arm without what lies behind."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from freebody.symbolic.evaluate import Array
from freebody.symbolic.tree import Num, Sym, substitute, walk

from .coefficients import more
from .edits import Edit, depth
from .language.spelling import spell
from .language.statements import Equation
from .monomials import Monomials
from .vocabulary import Vocabulary

_RARE = 0.2  # by which it is less likely than a term that is lacking once
_LINEAR = 1e-9  # bend beside the slope, below which it stands linearly


def throughout(
    equation: Equation,
    vocabulary: Vocabulary,
    lacking: Monomials,
    left: Callable[[Equation], Array],
    times: Callable[[Array, Array], Array] = np.divide,
) -> Iterator[Edit]:
    """Quantities of the model that stand more than once and lack a term each time; ``left`` is what is not 0 in an equation and should
    be, on every state, and ``times`` how many times another that is."""
    found = [n for n in walk(equation) if isinstance(n, Sym) and n in vocabulary.parameters and n not in vocabulary.angular]
    for one in dict.fromkeys(n for n in found if n.name != "g" and found.count(n) > 1):
        larger = (substitute(equation, {one: more(one, Num(step, f"{step:g}"))}) for step in (1.0, 2.0))
        base, once, twice = map(left, (equation, *larger))
        slope, bend = once - base, twice - 2 * once + base
        if base.ndim > 1 or not np.all(np.abs(bend) <= _LINEAR * (np.abs(slope) + np.abs(base))):
            continue
        for term in (term for term in lacking.equal_to(-times(base, slope)) if one not in term.symbols):
            new = more(one, term)
            words = f"`{spell(one)}` should be `{spell(new)}` each time"
            yield Edit("convention", None, new, substitute(equation, {one: new}), _RARE + 0.02 * depth(term), words)
