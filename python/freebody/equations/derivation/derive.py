"""The equations of a mechanism as a document: configuration, symbols, kinematics, balances, matrix form, what is conserved."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from freebody.document.blocks import Block, Equation, Heading, MatrixEquation, Paragraph, Words, equations, listed
from freebody.document.document import Document
from freebody.equations.derivation import conserved, preamble
from freebody.equations.derivation.brute import brute
from freebody.equations.derivation.constrained import constrained
from freebody.equations.derivation.form import Form, Printed
from freebody.equations.derivation.minimal import minimal
from freebody.equations.derivation.sentences import lettered, readable
from freebody.equations.derivation.single_unknown import wanted
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.algebra import equal, quotient
from freebody.symbolic.to_sympy import sympy, to_sympy
from freebody.symbolic.tree import Sym, Tree, symbols

_TITLES = {"minimal": "minimal form", "brute": "brute force", "constraints": "with constraints"}
FORMS = tuple(_TITLES)
_ELSEWHERE = "it is among the equations as data and in the generated code"
_LOPSIDED = "It is not symmetric, as its rows are these balances, not Lagrange's equations."


@dataclass(frozen=True)
class Equations(Document):
    """The equations of motion in one ``form``: minimal, brute or constraints; or the fewest for something wanted.

    ``print`` shows the derivation; a notebook typesets it. ``parts`` are the equations with titles, in the order of the rows of
    the matrix form A x = b."""

    form: str = field(kw_only=True)
    content: Form = field(kw_only=True, repr=False)

    @property
    def parts(self) -> tuple[Printed, ...]:
        """The equations with their titles and sides."""
        return self.content.equations

    @property
    def equations(self) -> tuple[Tree, ...]:
        """Every equation as a tree that vanishes, SI."""
        return tuple(part.residual for part in self.parts)

    @property
    def unknowns(self) -> tuple[Sym, ...]:
        """x of A x = b: accelerations, then forces and couples."""
        return self.content.system.unknowns

    @property
    def mass_matrix(self) -> tuple[tuple[Tree, ...], ...]:
        """A of A x = b, in rows. In a tree's minimal form this is the mass matrix."""
        return self.content.system.matrix

    @property
    def right_hand_side(self) -> tuple[Tree, ...]:
        """b of A x = b."""
        return self.content.system.right

    def sympy(self) -> tuple[sympy.Matrix, sympy.Matrix, sympy.Matrix]:
        """A, x and b of A x = b as matrices of SymPy, coordinates as functions of time."""

        def matrix(rows: Sequence[Sequence[Tree]]) -> sympy.Matrix:
            return sympy.Matrix([[to_sympy(entry, self.letters, time=True) for entry in row] for row in rows])

        return matrix(self.mass_matrix), matrix([[x] for x in self.unknowns]), matrix([[b] for b in self.right_hand_side])


def derive(subject: SymbolicState, form: str = "minimal", want: str | None = None, about: Sequence[str] = ()) -> Equations:
    """The equations of a subject in a form, or the fewest that give what is wanted (``want``), or those ``about`` some points.

    Raises ``ValueError`` for an unknown form, ``KeyError`` for what is not unknown, ``MotionError``."""
    nomenclature, title = subject.nomenclature, _TITLES.get(form)
    if want is not None:
        title = f"{want} about {', '.join(about)}" if about else f"the fewest for {want}"
        form, content = "wanted", wanted(subject, want, about)
    elif form == "constraints":
        content, nomenclature = constrained(subject)
    elif form in FORMS:
        content = (minimal if form == "minimal" else brute)(subject)
    else:
        raise ValueError(f"form {form!r} is unknown; there are {', '.join(FORMS)}")
    own = form != "constraints"  # else the places of the bodies are the coordinates
    body: list[Block] = [*content.blocks]
    if form in FORMS:
        body = [*preamble.kinematics(subject)] * own + body
        body += equations(subject.laws, "The law of friction, as the joint slides now")
        body += [*_matrix_form(form, content, subject), *conserved.section(subject, symbolically=own)]
    first = [Heading(subject.titled(f"equations, {title}"), 1), *(preamble.configuration(subject) if own else [])]
    blocks = (*first, *preamble.nomenclature(nomenclature, used(body)), *body)
    return Equations(
        tuple(lettered(readable(block, _ELSEWHERE), nomenclature) for block in blocks), nomenclature, form=form, content=content
    )


def _matrix_form(form: str, content: Form, subject: SymbolicState) -> list[Block]:
    """Matrix form, which that with constraints has as blocks of its own, and first-order form."""
    system = content.system
    moving = [x for x in system.unknowns if x.dots]
    made: list[Block] = []
    if system.unknowns and form != "constraints":
        only_moves = system.is_square and len(moving) == len(system.unknowns) and not subject.rows
        letter, name = ("M", "Mass matrix and right-hand side") if only_moves else ("A", "The equations together")
        made = [Heading("Matrix form"), MatrixEquation(system.matrix, system.unknowns, system.right, name, letter=letter)]
        if only_moves:
            pairs = ((row[k], system.matrix[k][i]) for i, row in enumerate(system.matrix) for k in range(i))
            made += [Paragraph(_LOPSIDED)] * (not all(equal(*pair, subject.tables) for pair in pairs))
    if system.unknowns and not system.is_square:
        made.append(Paragraph(_uneven(len(system.matrix), len(system.unknowns), len(subject.laws))))
    if moving:
        places, rates = ([Sym(x.name, x.dots - fewer) for x in moving] for fewer in (2, 1))
        own, change = ([Sym(name, dots) for name in subject.source.metadata["states"]] for dots in (0, 1))
        said: Words = ["For integration the state is z = (", *listed([*places, *rates, *own]), "). Its rate is ("]
        said += listed([*rates, *moving, *change])
        rest = "), of which the first half is in the state and the second solves the equations above at each instant."
        if own:
            rest = "), of which the equations above give at each instant what is not in the state."
        made += [Heading("First-order form"), Paragraph([*said, rest])]
        if len(system.unknowns) == len(system.matrix) == 1:
            made.append(Equation(moving[0], quotient(system.right[0], system.matrix[0][0]), "Here this is"))
    return made


def _uneven(equations: int, unknowns: int, laws: int) -> str:
    these = f"{'This is one equation' if equations == 1 else f'These are {equations} equations'} in {unknowns} unknowns"
    if laws and equations + laws == unknowns:
        return f"{these}: the law{'s' * (laws > 1)} of friction, not linear, make{'s' * (laws == 1)} up the number."
    if equations < unknowns:
        return f"{these}: redundant constraints, or friction, takes a law of its own besides the balances."
    return f"{these}: some follow from the others."


def used(blocks: Any) -> set[str]:
    """Names of all symbols in blocks, and in whatever these hold."""
    if isinstance(blocks, Tree):
        return {symbol.name for symbol in symbols(blocks)}
    fields = [getattr(blocks, name) for name in getattr(blocks, "__dataclass_fields__", ())]
    return set().union(*map(used, blocks if isinstance(blocks, list | tuple) else fields))
