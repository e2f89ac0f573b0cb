"""Virtual power: equations without reactions where no balance of a rigid group gives them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from freebody.core import Array, MotionError, OutcomeKind
from freebody.document.blocks import Block, Equation, Heading, Paragraph, Written
from freebody.equations.derivation.data import SymbolicState
from freebody.equations.derivation.meaning import joined
from freebody.equations.linear import Linear
from freebody.solve.perturbed_states import DEPENDENT
from freebody.symbolic.collect import common_number, divided
from freebody.symbolic.formula import typed
from freebody.symbolic.symbols import name_formula, unicode_name
from freebody.symbolic.tree import ONE, Tree, is_negative, is_zero, minus, negative, read


@dataclass(frozen=True)
class VirtualPower:
    """The power of all loads, ``left``, is that of all inertia, ``right``, where the coordinates change at virtual ``rates``
    that keep closed what is closed; ``linear`` is right − left in what is unknown."""

    rates: dict[str, Tree]
    left: Tree
    right: Tree
    linear: Linear

    def over(self, factor: Tree) -> VirtualPower:
        """The same with all rates divided by a number."""
        if factor == ONE:
            return self
        rates = {name: divided(tree, factor) for name, tree in self.rates.items()}
        return VirtualPower(rates, divided(self.left, factor), divided(self.right, factor), self.linear.over(factor))

    @property
    def residual(self) -> Tree:
        """right − left."""
        return minus(self.right, self.left)

    @property
    def reactions(self) -> list[str]:
        """Unknown loads that have power even so: forces of motions, and what friction follows from."""
        return [letter.name for letter in self.linear.coefficients if not letter.dots]


def virtual_power(subject: SymbolicState) -> list[VirtualPower]:
    """One equation for each degree of freedom, prescribed ones among them. Raises ``MotionError`` where they grow too large."""
    names = [c["name"] for c in subject.coordinates]
    rows = [i for i, row in enumerate(subject.rows) if row.kind != "motion"]
    stated = subject.neighbours[-1].rows
    table = np.array([[stated[i].coefficients[name] for name in names] for i in rows]).reshape(len(rows), len(names))
    bound = [len(names) - 1 - place for place in _independent(table[:, ::-1].T)]
    kept = _independent(table[:, bound])
    asked = {"ask": "virtual_power", "bound": [names[i] for i in bound], "rows": [rows[i] for i in kept]}
    return [_read(each, names) for each in subject.ask([asked])[0]]


def section(subject: SymbolicState, wanted: int) -> list[Block]:
    """The equations, or why there are none; ``wanted``: how many would be enough."""
    said = "The principle of virtual power does without: the bodies move all at once, so that what is closed stays closed, and no reaction has power"
    head = Heading("Virtual power", 3)
    try:
        found = virtual_power(subject)
    except MotionError as error:
        if error.kind is not OutcomeKind.TOO_LARGE:
            raise
        return [head, Paragraph(f"{said}. The symbolic equations are too long to be written.")]
    driving = {load.symbol for load in subject.free.loads if load.kind == "motion"}
    working = list(dict.fromkeys(name for each in found for name in each.reactions if name not in driving))
    if working:
        return [
            head,
            Paragraph(
                f"The principle of virtual power does not do without either: {joined(working)} {'has' if len(working) == 1 else 'have'} power, by friction or by a law of the force."
            ),
        ]
    made: list[Block] = [head, Paragraph(f"{said}. {_count(wanted)}")]
    for each in found:
        made += _blocks(each)
    return made


def _read(data: dict, names: Sequence[str]) -> VirtualPower:
    rates = {name: read(data["rates"][name]) for name in names}
    found = VirtualPower(rates, read(data["left"]), read(data["right"]), Linear.read(data["linear"]))
    moved = [tree for tree in rates.values() if not is_zero(tree)]
    size = common_number(moved)
    signs = [-1 if is_negative(tree) else 1 for tree in moved]
    return found.over(negative(size) if (sum(signs) or signs[0]) < 0 else size)


def _independent(rows: Array) -> list[int]:
    """The first rows of which none follows from those before."""
    found: list[int] = []
    for i in range(len(rows)):
        sizes = np.linalg.svd(rows[[*found, i]], compute_uv=False)
        if len(sizes) == len(found) + 1 and sizes[-1] > DEPENDENT * np.abs(rows).max():
            found.append(i)
    return found


def _count(number: int) -> str:
    return "There is one such equation." if number == 1 else f"There are {number} such equations, one for each degree of freedom."


def _blocks(power: VirtualPower) -> list[Block]:
    moved = {name: tree for name, tree in power.rates.items() if not is_zero(tree)}
    lead = "Where the coordinates change at the virtual rates"
    made: list[Block] = [Equation(_rate(name), tree, "" if i else lead) for i, (name, tree) in enumerate(moved.items())]
    return [*made, Equation(power.right, power.left, "the power of inertia is that of the loads")]


def _rate(name: str) -> Written:
    return Written(f"δ{unicode_name(name)}", typed("δ ", name_formula(name)))
