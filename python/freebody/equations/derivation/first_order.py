"""The equations as a first-order system: the state and its rate, explicitly where that is short."""

from __future__ import annotations

from freebody.document.blocks import Block, Heading, MatrixEquation, Paragraph, Words, equations, listed
from freebody.equations.derivation.form import System
from freebody.equations.solve import Singular, TooLarge, Unconfirmed, solve
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.tree import Sym, Tree, operations, read

_SHORT = 60
"""Operations of an acceleration up to which it stands explicitly."""
_MOST = 4 * _SHORT
"""The same of two equations, or of a determinant multiplied out, from which so short a one may still come."""
_PATIENCE = 0.5


def first_order(system: System, subject: SymbolicState, below: bool = False) -> list[Block]:
    """z = (q, q̇) and its rate; accelerations in one place each, or the equations that give them; ``below``: these stand above."""
    moving = [x for x in system.unknowns if x.dots]
    if not moving:
        return []
    places, rates = ([Sym(x.name, x.dots - fewer) for x in moving] for fewer in (2, 1))
    states = subject.source.metadata["states"]
    own, change = ([Sym(name, dots) for name in states] for dots in (0, 1))
    said: Words = ["The state is z = (", *listed([*places, *rates, *own]), "), its rate ("]
    said += [*listed([*rates, *moving, *change]), ")"]
    made: list[Block] = [Heading("First-order form")]
    if explicit := _explicit(system, subject):
        laws = zip(states, map(read, subject.ask([{"ask": "state_rates"}])[0]), strict=True) if states else ()
        pairs = [*zip(moving, explicit, strict=True), *((Sym(name, 1), rate) for name, rate in laws)]
        return [*made, Paragraph([*said, ", with"]), *equations(pairs)]
    if below:
        return [*made, Paragraph([*said, ", of which the accelerations solve the equations above at each instant."])]
    gives = MatrixEquation(system.matrix, system.unknowns, system.right)
    return [*made, Paragraph([*said, ", of which at each instant the accelerations solve"]), gives]


def _explicit(system: System, subject: SymbolicState) -> list[Tree]:
    """The accelerations by the state; none where they take pages, or other unknowns."""
    size = sum(operations(entry) for row in (*system.matrix, system.right) for entry in row)
    if not system.gives_accelerations or size > (_MOST if len(system.unknowns) < 3 else _SHORT):
        return []
    try:
        found = solve(system.matrix, system.right, subject.nomenclature, patience=_PATIENCE, most=_MOST)
    except (Singular, TooLarge, Unconfirmed):
        return []
    return found if all(operations(tree) <= _SHORT for tree in found) else []
