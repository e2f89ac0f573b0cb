"""Friction that is no fixed part of one force, as that of a bearing: the balances for the forces that its law holds."""

from __future__ import annotations

from collections.abc import Sequence

from freebody.core import Load
from freebody.equations.derivation.balance_text import Stated
from freebody.equations.derivation.data import SymbolicState
from freebody.equations.derivation.meaning import joined
from freebody.symbolic.tree import symbols


def beside(subject: SymbolicState, stated: Sequence[Stated]) -> list[Stated]:
    """A force balance for every force that a law of friction holds and none of the equations does: along it, of all that its joint
    carries."""
    held = {x.name for s in stated for x in s.balance.linear.coefficients}
    needed = {x.name for _, law in subject.laws for x in symbols(law)} - held
    wanted = [(i, load) for i, load in enumerate(subject.free.loads) if load.unknown and load.symbol in needed]
    asked = [{"ask": "equation", "bodies": _carried(subject, load), "along": load.axis or {"load": i}} for i, load in wanted]
    found = zip(wanted, subject.balances(asked), strict=True) if asked else []
    return [Stated(balance, load.axis or f"the line of {load.symbol}", "along") for (_, load), balance in found]


def sentence(subject: SymbolicState, added: Sequence[Stated]) -> str:
    """What the balances beside the minimal form are for."""
    laws = joined([letter.name for letter, _ in subject.laws])
    forces = joined([x.name for s in added for x in s.balance.linear.coefficients if not x.dots])
    return f"The friction {laws} stays, which follows from {forces} by a law that is not linear: {len(added)} more are for these."


def _carried(subject: SymbolicState, load: Load) -> list[str]:
    """The bodies that move with the coordinate of a joint; of one that closes a loop its second body."""
    own = [c["name"] for c in subject.coordinates if c["joint"] == load.name]
    return list(subject.balances([{"ask": "coordinate", "name": own[0]}])[0].bodies) if own else [load.of[-1]]
