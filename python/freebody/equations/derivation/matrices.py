"""The last steps: the matrix form (that with constraints has blocks of its own), and the first-order form for integration."""

from __future__ import annotations

from freebody.equations.collect import quotient
from freebody.equations.derivation.result import Form
from freebody.equations.document import Block, Equation, Heading, MatrixEquation, Paragraph, Words
from freebody.equations.letters import Letters
from freebody.equations.tree import Sym


def section(form: str, content: Form, letters: Letters) -> list[Block]:
    """Matrix form and first-order form."""
    system = content.system
    if not system.unknowns:
        return []
    moving = [x for x in system.unknowns if x.dots]
    made: list[Block] = []
    if form != "constraints":
        letter = "M" if form == "minimal" else "A"
        made = [
            Heading("Matrix form"),
            MatrixEquation(system.matrix, system.unknowns, system.right, "The equations together", letter=letter),
        ]
    if not system.is_square:
        made.append(Paragraph(_uneven(content)))
    if moving:
        made += [Heading("First-order form"), *_first_order(content, moving, letters)]
    return made


def _uneven(content: Form) -> str:
    equations, unknowns = len(content.system.matrix), len(content.system.unknowns)
    these = "This is one equation" if equations == 1 else f"These are {equations} equations"
    if equations < unknowns:
        return (
            f"{these} in {unknowns} unknowns: what is held in more ways than needed, or rubs, "
            "takes a law of its own besides the balances."
        )
    return f"{these} in {unknowns} unknowns: some follow from the others."


def _first_order(content: Form, moving: list[Sym], letters: Letters) -> list[Block]:
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
