"""Virtual power: equations without reactions where no balance of a rigid group gives them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from freebody.core import MotionError, OutcomeKind
from freebody.document.blocks import Block, Equation, Heading, Paragraph, Written, equations
from freebody.equations.derivation.sentences import clause
from freebody.solve.perturbed_states import independent
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.algebra import common_number, divided
from freebody.symbolic.formula import typed
from freebody.symbolic.linear import Linear
from freebody.symbolic.symbols import name_formula, unicode_name
from freebody.symbolic.tree import ONE, Tree, is_negative, is_zero, minus, negative, read

_LAW = "Σ (F · δv + M δω) = Σ (m a · δv + I α δω)"


@dataclass(frozen=True)
class VirtualPower:
    """The power of all loads, ``left``, is that of all inertia, ``right``, where the coordinates change at virtual ``rates``
    that keep closed what is closed; ``linear`` is right − left in what is unknown."""

    rates: dict[str, Tree]
    left: Tree
    right: Tree
    linear: Linear

    def with_trees(self, put: Callable[[Tree], Tree]) -> VirtualPower:
        """The same, every expression as ``put`` makes it."""
        rates = {name: put(tree) for name, tree in self.rates.items()}
        return VirtualPower(rates, put(self.left), put(self.right), self.linear.with_trees(put))

    @property
    def residual(self) -> Tree:
        """right − left."""
        return minus(self.right, self.left)

    @property
    def reactions(self) -> list[str]:
        """Unknown loads that have power even so: forces of motions, and what friction follows from."""
        return [symbol.name for symbol in self.linear.coefficients if not symbol.dots]


def virtual_power(subject: SymbolicState) -> list[VirtualPower]:
    """One equation for each degree of freedom, prescribed ones among them. Raises ``MotionError`` where they grow too large."""
    names = subject.names
    rows = [i for i, row in enumerate(subject.rows) if row.kind != "motion"]
    stated = subject.neighbours[-1].rows
    table = np.array([[stated[i].coefficients[name] for name in names] for i in rows]).reshape(len(rows), len(names))
    bound = [len(names) - 1 - place for place in independent(table[:, ::-1].T)]
    asked = {"ask": "virtual_power", "bound": [names[i] for i in bound], "rows": [rows[i] for i in independent(table[:, bound])]}
    made = []
    for data in subject.ask([asked])[0]:
        rates = {name: read(data["rates"][name]) for name in names}
        moved = [tree for tree in rates.values() if not is_zero(tree)]
        size, signs = common_number(moved), [-1 if is_negative(tree) else 1 for tree in moved]
        size = negative(size) if (sum(signs) or signs[0]) < 0 else size
        found = VirtualPower(rates, read(data["left"]), read(data["right"]), Linear.read(data["linear"]))
        made.append(found if size == ONE else found.with_trees(lambda tree, by=size: divided(tree, by)))
    return made


def section(subject: SymbolicState, wanted: int) -> list[Block]:
    """The equations, or why there are none; ``wanted``: how many would be enough."""
    said = "The principle of virtual power needs no reactions: the bodies move all at once, so that what is closed stays closed, and no reaction has power"
    head = Heading("Virtual power", 3)
    try:
        found = virtual_power(subject)
    except MotionError as error:
        if error.kind is not OutcomeKind.TOO_LARGE:
            raise
        return [head, Paragraph(f"{said}. The symbolic equations are too long to be written.")]
    driving = {load.symbol for load in subject.free.loads if load.kind == "motion"}
    if working := list(dict.fromkeys(name for each in found for name in each.reactions if name not in driving)):
        power = f"{clause(working, 'has', 'have')} power, by friction or by a law of the force."
        return [head, Paragraph(f"The principle of virtual power needs reactions as well: {power}")]
    count = "is one such equation" if wanted == 1 else f"are {wanted} such equations, one for each degree of freedom"
    law = Written(_LAW, typed(_LAW))
    made: list[Block] = [head, Paragraph([f"{said}: ", law, f". There {count}."])]
    for each in found:
        moved = {name: tree for name, tree in each.rates.items() if not is_zero(tree)}
        rates = [(Written(f"δ{unicode_name(name)}", typed("δ ", name_formula(name))), tree) for name, tree in moved.items()]
        made += equations(rates, "Where the coordinates change at the virtual rates")
        made.append(Equation(each.right, each.left, "the power of inertia is that of the loads"))
    return made
