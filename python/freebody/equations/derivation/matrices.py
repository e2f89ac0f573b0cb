"""The last steps: the matrix form (that with constraints has blocks of its own), and the first-order form for integration."""

from __future__ import annotations

import numpy as np

from freebody.document.blocks import Block, Equation, Heading, MatrixEquation, Paragraph, Words
from freebody.equations.derivation.data import SymbolicState
from freebody.equations.derivation.result import Form
from freebody.equations.derivation.system import System
from freebody.symbolic.collect import quotient
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import Sym

_SAME = 1e-9
"""Part of the largest entry of a matrix by which two are no longer equal."""
_LOPSIDED = "That it is not symmetric is no slip: its rows are these balances, not Lagrange's equations."


def section(form: str, content: Form, subject: SymbolicState) -> list[Block]:
    """Matrix form and first-order form."""
    system = content.system
    if not system.unknowns:
        return []
    moving = [x for x in system.unknowns if x.dots]
    made: list[Block] = []
    if form != "constraints":
        only_moves = system.is_square and len(moving) == len(system.unknowns) and not subject.rows
        letter, name = ("M", "Mass matrix and right-hand side") if only_moves else ("A", "The equations together")
        made = [Heading("Matrix form"), MatrixEquation(system.matrix, system.unknowns, system.right, name, letter=letter)]
        if only_moves and not _is_symmetric(system, subject):
            made.append(Paragraph(_LOPSIDED))
    if not system.is_square:
        made.append(Paragraph(_uneven(content, len(subject.laws))))
    if moving:
        made += [Heading("First-order form"), *_first_order(content, moving)]
    return made


def _is_symmetric(system: System, subject: SymbolicState) -> bool:
    rows = np.array([[evaluate(entry, subject.values, subject.tables) for entry in row] for row in system.matrix], float)
    return bool(np.abs(rows - rows.T).max() <= _SAME * np.abs(rows).max())


def _uneven(content: Form, laws: int) -> str:
    equations, unknowns = len(content.system.matrix), len(content.system.unknowns)
    these = "This is one equation" if equations == 1 else f"These are {equations} equations"
    if laws and equations + laws == unknowns:
        return f"{these} in {unknowns} unknowns: the law{'s' * (laws > 1)} of friction, not linear, make{'s' * (laws == 1)} up the number."
    if equations < unknowns:
        return (
            f"{these} in {unknowns} unknowns: redundant constraints, or friction, "
            "takes a law of its own besides the balances."
        )
    return f"{these} in {unknowns} unknowns: some follow from the others."


def _first_order(content: Form, moving: list[Sym]) -> list[Block]:
    system = content.system
    state: Words = ["For integration the state is z = (", *_row(moving, 2), *[", "], *_row(moving, 1), "). Its rate is ("]
    rest = ", of which the first half is in the state and the second solves the equations above at each instant"
    said: Words = [*state, *_row(moving, 1), ", ", *_row(moving, 0), ")", rest, "."]
    if len(system.unknowns) == 1 and len(system.matrix) == 1:
        made = quotient(system.right[0], system.matrix[0][0])
        return [Paragraph(said), Equation(moving[0], made, "Here this is")]
    return [Paragraph(said)]


def _row(moving: list[Sym], fewer: int) -> list[str | Sym]:
    return [p for i, x in enumerate(moving) for p in ((", ",) if i else ()) + (Sym(x.name, x.dots - fewer),)]
