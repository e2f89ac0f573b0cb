"""The equations of a mechanism as an object that prints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from freebody.document.blocks import Block, Equation, Heading
from freebody.document.document import Document
from freebody.equations.derivation import conserved, matrices, preamble
from freebody.equations.derivation.brute import brute
from freebody.equations.derivation.constrained import constrained
from freebody.equations.derivation.data import SymbolicState
from freebody.equations.derivation.minimal import minimal
from freebody.equations.derivation.result import Form, Printed
from freebody.equations.derivation.sentences import lettered
from freebody.equations.derivation.single_unknown import wanted
from freebody.equations.derivation.size_limits import readable
from freebody.symbolic.letters import Letters
from freebody.symbolic.tree import Sym, Tree, symbols

if TYPE_CHECKING:
    import sympy

FORMS = ("minimal", "brute", "constraints")
_TITLES = {"minimal": "minimal form", "brute": "brute force", "constraints": "with constraints"}


@dataclass(frozen=True)
class Equations:
    """The equations of motion in one ``form``: minimal, brute or constraints; or the fewest for something wanted.

    ``print`` shows the derivation; a notebook typesets it. ``parts`` are the equations with titles, in the order of the rows of
    the matrix form A x = b."""

    form: str
    letters: Letters
    document: Document = field(repr=False)
    content: Form = field(repr=False)

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
        import sympy

        from freebody.symbolic.to_sympy import to_sympy

        def matrix(rows: Sequence[Sequence[Tree]]) -> sympy.Matrix:
            return sympy.Matrix([[to_sympy(entry, self.letters, time=True) for entry in row] for row in rows])

        return matrix(self.mass_matrix), matrix([[x] for x in self.unknowns]), matrix([[b] for b in self.right_hand_side])

    def text(self, *, width: int = 100, ascii: bool = False) -> str:
        """The derivation as plain text."""
        return self.document.text(width=width, ascii=ascii)

    def latex(self) -> str:
        """The derivation as a fragment of a LaTeX article."""
        return self.document.latex()

    def markdown(self) -> str:
        """The derivation as Markdown with LaTeX between dollars."""
        return self.document.markdown()

    def printed(self, kind: str) -> str:
        """By the ending of a file: txt, tex, md, html or json. Raises ``KeyError`` for any other."""
        return self.document.printed(kind)

    def save(self, path: str | Path, kind: str = "") -> list[Path]:
        """Write a file by its ending or ``kind``, see ``printed``, and beside it the sketch for Markdown (.svg) and LaTeX (.pdf).
        Returns all that is written."""
        return self.document.save(path, kind or Path(path).suffix.removeprefix("."))

    def json(self) -> str:
        """The derivation as JSON: letters, and blocks with trees."""
        return self.document.json()

    def __str__(self) -> str:
        return self.text()

    def html(self) -> str:
        """The derivation as a page of HTML, formulas as MathML."""
        return self.document.html()

    def _repr_html_(self) -> str:
        return self.document._repr_html_()

    def _repr_latex_(self) -> str:
        return self.latex()


def derive(subject: SymbolicState, form: str = "minimal", want: str | None = None) -> Equations:
    """The equations of a subject in a form, or the fewest that give what is wanted (``want``).

    Raises ``ValueError`` for an unknown form, ``KeyError`` for what is not unknown, ``MotionError``."""
    if want is not None:
        content = wanted(subject, want)
        return Equations(
            "wanted", subject.letters, _Writer(subject, f"the fewest for {want}", subject.letters, content).document, content
        )
    if form not in FORMS:
        raise ValueError(f"form {form!r} is unknown; there are {', '.join(FORMS)}")
    letters = subject.letters
    if form == "constraints":
        content, letters = constrained(subject)
    else:
        content = (minimal if form == "minimal" else brute)(subject)
    return Equations(form, letters, _Writer(subject, form, letters, content).document, content)


@dataclass(frozen=True)
class _Writer:
    subject: SymbolicState
    form: str
    letters: Letters
    content: Form

    @cached_property
    def document(self) -> Document:
        body = (
            [*self._body(), *conserved.section(self.subject, in_letters=self.form != "constraints")]
            if self.form in FORMS
            else list(self.content.blocks)
        )
        first: list[Block] = [Heading(f"{self.subject.source.name}: equations, {_TITLES.get(self.form, self.form)}", 1)]
        if self.form != "constraints":
            first += preamble.configuration(self.subject)
        blocks = (*first, *preamble.letters(self.letters, used(body)), *body)
        return Document(tuple(lettered(readable(block), self.letters) for block in blocks), self.letters)

    def _body(self) -> list[Block]:
        kinematics = [] if self.form == "constraints" else preamble.kinematics(self.subject)
        laws = [
            Equation(*law, "The law of friction, as the joint slides now" if not i else "")
            for i, law in enumerate(self.subject.laws)
        ]
        return [*kinematics, *self.content.blocks, *laws, *matrices.section(self.form, self.content, self.subject)]


def used(blocks: Any) -> set[str]:
    """Names of all letters in blocks, and in whatever these hold."""
    found: set[str] = set()
    waiting = [blocks]
    while waiting:
        each = waiting.pop()
        if isinstance(each, Tree):
            found |= {letter.name for letter in symbols(each)}
        elif isinstance(each, list | tuple):
            waiting += each
        elif hasattr(each, "__dataclass_fields__"):
            waiting += [getattr(each, name) for name in each.__dataclass_fields__]
    return found
