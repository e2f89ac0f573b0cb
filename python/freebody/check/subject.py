"""What an equation speaks of: what it is solved for, whether of accelerations, of which dimension; and whether a correction changes that."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING

from freebody.symbolic.dimensions import Known
from freebody.symbolic.evaluate import is_zero
from freebody.symbolic.tree import Add, Node, Num, Pow, Quotient, Sym, unsigned, walk

from .edits import Edit
from .language.dimensions import dimension
from .language.statements import Equation, symbols_in, terms
from .powers import powers_of
from .slips import is_constraint

if TYPE_CHECKING:
    from .case import Case
    from .vocabulary import Vocabulary


class Subject:
    """That of one ``equation``, said of a model in a ``case``."""

    def __init__(self, case: Case, equation: Equation) -> None:
        self.equation, self._case = equation, case
        self._meaning, self._known = case.meaning, case.meaning.vocabulary

    @cached_property
    def is_constraint(self) -> bool:
        return is_constraint(self.equation, self._known)

    def is_changed(self, edits: Sequence[Edit], after: Equation) -> bool:
        """Whether nothing is left of what was asked; whether two edits leave none of the accelerations and forces of which was spoken; or whether
        what is left is but kinematics, after two edits, or with all gone from it that was said of forces, masses, weights or, after two, of a
        given speed."""
        if self._is_lost(after):
            return True
        own = {n.key for n in symbols_in(after)}
        solved = {n.key for n in symbols_in(self.equation) if self._meaning.solved(n)}
        lost = [self._known.dimension(n) for n in symbols_in(self.equation) if n.key not in own and not n.dots]
        of_mechanics = lambda its: its is not None and bool(its.mass or its.time == -2)
        kept = any(of_mechanics(self._known.dimension(n)) for n in symbols_in(after) if n.key not in solved)
        mechanics = any(map(of_mechanics, lost)) and not kept
        two = len(edits) > 1 or any(edit.kind == "missing term" and isinstance(edit.new, Add) for edit in edits)
        gone = (n for n in symbols_in(self.equation) if n in self._known.parameters and n.key not in own)
        given = two and any((its := self._known.dimension(n)) is not None and its.time for n in gone)
        kept_answers = not self.answers or not self.answers.isdisjoint(after.symbols)
        return (two and ((bool(solved) and not solved & own) or not kept_answers)) or (
            (given or (((two and lost) or mechanics) and not self.is_constraint)) and self._case.is_kinematic(after)
        )

    def _is_lost(self, after: Equation) -> bool:
        """Whether nothing that moves is left, or a derivative by what moves is no longer that."""
        still = lambda equation: equation.symbols <= {*self._known.parameters}
        return not self._slopes <= {*walk(after)} or (still(after) and not still(self.equation))

    @cached_property
    def _sides(self) -> set[Node]:
        """Both sides, without their signs."""
        return {unsigned(side) for side in (self.equation.left, self.equation.right)}

    @cached_property
    def answers(self) -> set[Node]:
        """The symbols that stand alone on a side; of two those that are no parameters, if one is none."""
        alone = {side for side in self._sides if isinstance(side, Sym)}
        return {side for side in alone if side not in self._known.parameters} or alone

    @cached_property
    def answer_sides(self) -> set[Node]:
        """The same, and powers of one: ``ω_n²``."""
        powers = {side for side in self._sides if isinstance(side, Pow) and isinstance(side.base, Sym)}
        return self.answers | {side for side in powers if side.base not in self._known.parameters}

    @cached_property
    def _slopes(self) -> set[Node]:
        """Derivatives by what moves that stand alone on a side, ``dv/dφ``."""
        is_rate = lambda n: isinstance(n, Sym) and n.dots > 0
        return {side for side in self._sides if isinstance(side, Quotient) and is_rate(side.top) and is_rate(side.bottom)}

    def is_no_answer(self, after: Equation) -> bool:
        """Whether what an equation is solved for, or a power of it, or what that is the derivative of, has come to its other side."""
        sides = [(self.equation.left, after.right, self.equation.right), (self.equation.right, after.left, self.equation.left)]
        for own, other, before in sides:
            answer = own.base if isinstance(own, Pow) else unsigned(own)
            new = other.symbols - before.symbols
            if isinstance(answer, Sym) and any(n.name == answer.name and n.dots <= answer.dots for n in new):
                return True
        return False

    def is_elsewhere(self, edit: Edit) -> bool:
        """Whether a sign is changed of what accelerates, or a number of what acts: people make these slips the other way round; or twice
        what accelerates is added, which stands for that."""
        if edit.kind == "missing term" and edit.new is not None:
            return abs(powers_of(edit.new)[0]) == 2 and self._accelerates(edit.new) and self._accelerates(self.equation)
        if edit.old is None or not self._accelerates(self.equation):
            return False
        of_motion, has_number = self._accelerates(edit.old), any(isinstance(n, Num) for n in walk(edit.old))
        return of_motion if edit.kind == "sign" else edit.kind == "factor" and not (of_motion or has_number)

    def _accelerates(self, node: Node) -> bool:
        """Whether an acceleration stands in it, which may have a letter of its own."""
        known = {n: self._known.dimension(n) for n in symbols_in(node) if n not in self._known.parameters}
        return any(its is not None and its.time == -2 and its.mass == 0 for its in known.values())

    def is_of_other_dimension(self, after: Equation) -> bool:
        """Whether an equation is no longer of what it was of, where one side is 0."""
        given = self._dimension
        its = None if given is None else _dimension(after, self._known)
        return its is not None and its != given and bool(is_zero(after.left) or is_zero(after.right))

    @cached_property
    def _dimension(self) -> Known:
        """What the equation given is of; None where that is not known."""
        return _dimension(self.equation, self._known) if self._meaning.fits(self.equation) else None


def _dimension(equation: Equation, vocabulary: Vocabulary) -> Known:
    """What the terms of an equation are of, as far as that is known."""
    found = (dimension(term, vocabulary.dimensions) for term in terms(equation))
    return next((each for each in found if each is not None), None)
