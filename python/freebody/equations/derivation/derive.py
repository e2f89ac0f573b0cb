"""The equations of a mechanism as a document: configuration, symbols, kinematics, balances, matrix form, what is conserved."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from freebody.document.blocks import Block, Equation, Heading, MatrixEquation, Paragraph, Vector, equations
from freebody.document.document import Document
from freebody.equations.derivation import conserved, page, preamble
from freebody.equations.derivation.balance_page import OF_A_PAGE
from freebody.equations.derivation.balance_text import Stated
from freebody.equations.derivation.brute import brute
from freebody.equations.derivation.constrained import constrained
from freebody.equations.derivation.first_order import first_order
from freebody.equations.derivation.form import Form, Printed, System
from freebody.equations.derivation.limits import section
from freebody.equations.derivation.minimal import minimal
from freebody.equations.derivation.sentences import lettered, readable
from freebody.equations.derivation.single_unknown import wanted
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.algebra import equal
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.to_sympy import sympy, to_sympy
from freebody.symbolic.tree import Add, Num, Sym, Tree, symbols, walk

_TITLES = {
    "minimal": "minimal form", "brute": "brute force", "constraints": "with constraints", "first-order": "first-order form",
}  # fmt: skip
FORMS = tuple(_TITLES)
_ELSEWHERE = "it is among the equations as data and in the generated code"
_LONGER = "the long derivation has it (`--long`)"
_LOPSIDED = "It is not symmetric, as its rows are these balances, not Lagrange's equations."


@dataclass(frozen=True)
class Equations(Document):
    """The equations of motion in one ``form``: minimal, brute or constraints; or the fewest for something wanted.

    ``print`` shows the derivation; a notebook typesets it. ``parts`` are the equations with titles, in the order of the rows of
    the matrix form A x = b."""

    form: str = field(kw_only=True)
    content: Form = field(kw_only=True, repr=False)

    @property
    def parts(self) -> tuple[Printed | Stated, ...]:
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


def derive(
    subject: SymbolicState,
    form: str = "minimal",
    want: str | None = None,
    about: Sequence[str] = (),
    long: bool = False,
    limits: Mapping[str, str] | None = None,
) -> Equations:
    """The equations of a subject in a form, or the fewest that give what is wanted (``want``), or those ``about`` some points: a page,
    or, ``long``, all that a reader may ask for; and what is left of each equation in some ``limits``.

    Raises ``ValueError`` for an unknown form, ``KeyError`` for what is not unknown, ``MotionError``."""
    nomenclature, title = subject.nomenclature, _TITLES.get(form)
    if want is not None:
        title = f"{want} about {', '.join(about)}" if about else f"the fewest for {want}"
        form, content = "wanted", wanted(subject, want, about, long)
    elif form == "constraints":
        content, nomenclature = constrained(subject)
    elif form in FORMS:
        content = (brute if form == "brute" else minimal)(subject, long)
    else:
        raise ValueError(f"form {form!r} is unknown; there are {', '.join(FORMS)}")
    nomenclature = Nomenclature({**nomenclature, **{x.name: x for x in content.symbols}}, nomenclature.renamed)
    own = form != "constraints"  # else the places of the bodies are the coordinates
    body: list[Block] = [*content.blocks]
    if form == "first-order":
        body = first_order(content.system, subject)
    elif form in FORMS:
        body = [*preamble.kinematics(subject)] * (own and long) + body
        body += equations(subject.laws, "The law of friction, as the joint slides now")
        body += _matrix_form(form, content, subject) if long else _uneven(content.system, subject)
        body += [*first_order(content.system, subject, below=True), *conserved.section(subject, symbolically=own)] if long else []
    blocks: list[Block] = [Heading(subject.titled(f"equations, {title}"), 1)]
    if long:
        blocks += [*(preamble.configuration(subject) if own else []), *preamble.nomenclature(nomenclature, used(body))]
    else:
        scalar = used([block for block in body if not (isinstance(block, Equation) and isinstance(block.left, Vector))])
        loads = {*nomenclature.of_kind("unknown")}  # those that are in laws in vectors alone are explained by the free body
        blocks += page.beginning(subject, nomenclature, used(body) - (loads - scalar), own)
    blocks += [*body, *section(subject, content.equations, limits or {})]
    shown = [readable(block, _ELSEWHERE) if long else readable(block, _LONGER, OF_A_PAGE) for block in blocks]
    lettered_blocks = tuple(lettered(block, nomenclature) for block in shown)
    nomenclature = Nomenclature(nomenclature, nomenclature.renamed, decimals=not long and any(map(has_decimals, lettered_blocks)))
    return Equations(lettered_blocks, nomenclature, form=form, content=content)


def _matrix_form(form: str, content: Form, subject: SymbolicState) -> list[Block]:
    """The matrix form; that with constraints has one in blocks of its own."""
    system, made = content.system, list[Block]()
    if system.unknowns and form != "constraints":
        only_moves = system.gives_accelerations and not subject.rows
        letter, name = ("M", "Mass matrix and right-hand side") if only_moves else ("A", "The equations together")
        made = [Heading("Matrix form"), MatrixEquation(system.matrix, system.unknowns, system.right, name, letter=letter)]
        if only_moves:
            pairs = ((row[k], system.matrix[k][i]) for i, row in enumerate(system.matrix) for k in range(i))
            made += [Paragraph(_LOPSIDED)] * (not all(equal(*pair, subject.tables) for pair in pairs))
    return [*made, *_uneven(system, subject)]


def _uneven(system: System, subject: SymbolicState) -> list[Block]:
    """Why there are not as many equations as unknowns, where it is so."""
    count, unknowns, laws = len(system.matrix), len(system.unknowns), len(subject.laws)
    if system.is_square or not unknowns:
        return []
    these = f"{'This is one equation' if count == 1 else f'These are {count} equations'} in {unknowns} unknowns"
    if laws and count + laws == unknowns:
        said = f"{these}: the law{'s' * (laws > 1)} of friction, not linear, make{'s' * (laws == 1)} up the number."
    elif count < unknowns:
        said = f"{these}: redundant constraints, or friction, takes a law of its own besides the balances."
    else:
        said = f"{these}: some follow from the others."
    return [Paragraph(said)]


def has_decimals(block: Any) -> bool:
    """Whether a decimal number is in a block, or in whatever it holds; also as a length, 6/5 − a cos θ."""
    if isinstance(block, Tree):
        return any(map(_is_decimal, walk(block)))
    fields = (getattr(block, name) for name in getattr(block, "__dataclass_fields__", ()))
    return any(map(has_decimals, block if isinstance(block, list | tuple) else fields))


def _is_decimal(part: Tree) -> bool:
    alone = [each.value for each in (part.terms if isinstance(part, Add) else (part,)) if isinstance(each, Num)]
    return any(isinstance(x, float) or (isinstance(part, Add) and Fraction(x).denominator % 5 == 0) for x in alone)


def used(blocks: Any) -> set[str]:
    """Names of all symbols in blocks, and in whatever these hold."""
    if isinstance(blocks, Tree):
        return {symbol.name for symbol in symbols(blocks)}
    fields = [getattr(blocks, name) for name in getattr(blocks, "__dataclass_fields__", ())]
    return set().union(*map(used, blocks if isinstance(blocks, list | tuple) else fields))
