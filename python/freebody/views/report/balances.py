"""The balances of every body, term by term, as formulas of a page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from freebody.core import MotionError
from freebody.solve.symbolic_state import Balance
from freebody.symbolic.formula import NEGATIVE
from freebody.symbolic.printers.mathml import mathml
from freebody.symbolic.printers.typeset import formula
from freebody.symbolic.tree import Tree, is_zero
from freebody.views.diagram.names import Labels

_LONGEST = 2000
"""Letters of MathML that one term may take; a longer one is shown by its name."""


def balances(labels: Labels, figures: Sequence[str]) -> list[dict[str, Any]]:
    """Σ F along x and y and Σ M about G of every body; none where the state has no symbolic answer."""
    try:
        stated = labels.subject.of_bodies()
    except MotionError:
        return []
    return [_balance(each, labels, figures) for each in stated]


def _balance(balance: Balance, labels: Labels, figures: Sequence[str]) -> dict[str, Any]:
    [body] = balance.bodies
    loads = labels.free.loads
    terms = [_term(loads[each.load].symbol, each.tree, labels) for each in balance.contributions if not each.absent]
    return {"figure": figures.index(body), "about": _about(balance), "terms": terms}


def _about(balance: Balance) -> str:
    """x, y, or G."""
    if balance.turns:
        return "G"
    return "x" if is_zero(balance.place.xy[1]) else "y"


def _term(symbol: str, tree: Tree, labels: Labels) -> dict[str, Any]:
    """The sign before it, and the rest as MathML."""
    parts = formula(tree, labels.subject.nomenclature)
    negative = parts[0] == NEGATIVE
    written = mathml(parts[1:] if negative else parts)
    return {"symbol": symbol, "negative": negative, "math": written if len(written) <= _LONGEST else ""}
