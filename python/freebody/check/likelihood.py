"""How unlikely an edit is as the mend of a slip that people make."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np

from freebody.symbolic.dimensions import ACCELERATION, ENERGY, FORCE, INERTIA, LENGTH, MASS
from freebody.symbolic.evaluate import Array
from freebody.symbolic.tree import Add, Fn, Negative, Node, Num, Pow, Quotient, Sym, unsigned, walk

from .edits import FIGURES, Edit
from .language.dimensions import dimension
from .language.statements import Equation, terms
from .powers import powers_of
from .slips import is_constraint
from .taken_away import TakenAway, cancels, cancels_within, numbers, says_the_same, terms_of
from .traits import Traits, is_answer
from .vocabulary import Vocabulary, stem

_NATURAL = (
    1 / 24,
    1 / 12,
    1 / 8,
    1 / 6,
    1 / 5,
    1 / 4,
    1 / 3,
    3 / 8,
    2 / 5,
    1 / 2,
    2 / 3,
    7 / 10,
    3 / 4,
    1.0,
    3 / 2,
    2.0,
    3.0,
    4.0,
)
"""Numbers before the terms of balances and energies."""
_RATIOS = (2.0, 4.0)
"""By which numbers are mistaken for each other: ½ forgotten or twice, an inertia of 1/12 for 1/3."""
_OF_BODIES = (1 / 12, 1 / 4, 1 / 3, 2 / 5, 2 / 3)
"""Factors of moments of inertia, any of which is taken for another."""
_MOST_TIMES = 2  # that a term is lacking: one that stands with the wrong sign
_FOURFOLD = 0.2  # for a number that is another four times, and not 1/12 for 1/3
_ODD = 0.5
_ROOTED = 0.6  # that a root of a number, as of a sine, is beside what moves and not in the place of another number
_USUAL = 0.1  # for one usual number for another
_MIXED = 1.0  # for an acceleration or a force in an energy or a momentum
_FORGOTTEN = 0.3  # for a number before a weight or a mass times its acceleration
_STATICS = 0.2  # by which what accelerates is likelier forgotten where a balance has nothing that moves
_ONCE = 0.15  # for a term that has no place, and is not counted twice
_SOLVED = 0.2  # for another quantity in the place of that which is alone on a side
_PRESSES = 0.3  # for a force in the place of a weight, of which the equation did not speak
_INSIDE = 0.25  # for a part of a bracket that has no place there: what is too much mostly stands by itself
_BOUND = 0.2  # for a term that is lacking at one instant, where many are equal
_UNDECLARED = 0.6  # for a reaction without a letter in the place of a weight
_TAKEN_OUT = 0.2  # for a reaction in an equation of motion of several masses: what turns as well is likelier forgotten
_OPENED = 0.25  # for what else moves in the equation of motion of one coordinate alone
_NEW_RATE = 0.05  # for a rate of which the equation did not speak, which is easily taken for another
_NEW = 0.15  # for any other quantity of which it did not speak, more for a force
_OTHER_LETTER = 0.2  # more, for a force or a moment in the place of one that differs by more than its index
PARTNER = 0.15
"""By how much a centripetal term is likelier beside its own second derivative."""
_SAME = 1e-9


class Likelihood:
    """That of the edits of one equation; ``values`` are those of true states, ``elsewhere`` of others. ``at_instant``: it is of one, where a number
    is the answer, and a term is easily made of what is bound there."""

    def __init__(
        self,
        equation: Equation,
        vocabulary: Vocabulary,
        values: Mapping[str, Array],
        elsewhere: Mapping[str, Array],
        at_instant: bool = False,
    ) -> None:
        self._at_instant = at_instant
        self.equation, self.vocabulary, self.values, self.elsewhere = equation, vocabulary, values, elsewhere
        self.taken = TakenAway(equation, vocabulary, values)
        self.its = Traits(equation, vocabulary, values, elsewhere)

    def lack(self, edit: Edit) -> float:
        """By how much an edit is larger than its kind says; without bound where it would be no correction: a mass or an inertia below
        0, another name of the same or of its opposite."""
        if edit.new is None:
            asked = any(not side.symbols <= edit.after.symbols for side in self.taken.differences)
            return self._of_extra_term(edit.old) + _ODD * asked if edit.kind == "extra term" and edit.old is not None else 0.0
        if (cancels(edit.after) and not cancels(self.equation)) or says_the_same(edit.after, self.equation):
            return math.inf
        if isinstance(edit.new, Negative) and dimension(edit.new, self.vocabulary.dimensions) in (MASS, INERTIA):
            return 0.0 if self.its.weighs(edit.old) else math.inf
        return self._of_kind(edit) + self._opens(edit)

    def _of_kind(self, edit: Edit) -> float:
        """That of an edit that puts something in."""
        match edit.kind, edit.old, edit.new:
            case "factor", Node() as old, new:
                answers = any(isinstance(side, Sym) for side in self.its.sides)
                odd_here = is_constraint(self.equation, self.vocabulary) or not (answers or self.its.has_mass_beside(old))
                odd = _of_number(old, new, self.values, _ODD if odd_here else _USUAL)
                odd = min(odd, _USUAL) if self._at_instant and answers else odd
                odd += _ROOTED * (bool(old.symbols) and new is not None and any(map(_is_root_of_number, walk(new))))
                return odd + _FORGOTTEN * (odd > 0 and self.its.has_load and self.its.is_force(old))
            case "symbol", Sym() as old, Sym() as new if {old.key, new.key} <= self.values.keys():
                sums = [side for side in (edit.after.left, edit.after.right) if isinstance(side, Add)]
                twice = any(len({*each.terms}) < len(each.terms) for each in sums)  # 2 T is not written T + T
                if (
                    new.dots
                    and is_constraint(edit.after, self.vocabulary)
                    and all(new in each.symbols for each in terms(edit.after))
                ):
                    return math.inf  # a law of places, times a rate
                return self._of_symbol(old, new) + _ODD * (twice or any(cancels_within(each, self.values) for each in sums))
            case "symbol", _, new:
                if not (new.symbols & self.its.answers).issubset(() if edit.old is None else edit.old.symbols):
                    return math.inf  # what it is solved for, for something else
                if isinstance(edit.old, Pow) and edit.old in self.its.sides and edit.old.symbols.isdisjoint(edit.after.symbols):
                    return math.inf  # the same
                undoes = isinstance(new, Add) and self.taken.by(edit.after)
                solved = edit.old not in self.vocabulary.parameters and any(side is edit.old for side in self.its.sides)
                return (
                    self._of_symbols(new)
                    + _SOLVED * solved
                    + _ODD * undoes
                    + _ODD * all(isinstance(unsigned(s), Sym) for s in (edit.after.left, edit.after.right))
                )
            case "missing term" | "other term", _, new:
                undoes = edit.kind == "missing term" and (self.taken.by(edit.after) or self.taken.within(edit.after, new))
                if undoes and isinstance(new, Add):  # two terms, of which one only takes away what was said
                    return math.inf
                odd = _BOUND * self._at_instant + _ODD * undoes
                parts = (new,) if _is_fall(new) else terms_of(new)
                return odd + sum(self._of_term(edit.kind, part) for part in parts)
            case "sign", Pow() as old, _ if self.its.is_beside_square(old):
                return math.inf  # an energy is no difference of squares of rates
            case "missing factor", Node() as old, new:
                return self._of_factor(old, new)
            case "resultant", Node() as old, new:
                return self._of_resultant(old, new)
            case "angle", _, new:
                return _NEW * len({n.name for n in new.symbols} - {n.name for n in self.its.said})
        return 0.0

    def _of_resultant(self, old: Node, new: Node) -> float:
        """Of a component beside one that was said; none is made of what the equation is solved for, or stands beside that but by a letter."""
        squares = (n.base for n in walk(new) if isinstance(n, Pow) and n.base != unsigned(old))
        other = next((base for base in squares if not base.symbols <= old.symbols), None)
        if other is None:
            return 0.0
        alone = old in self.its.sides and is_answer(old) and not all(map(is_answer, self.its.sides))
        if not other.symbols.isdisjoint(self.its.sides) or (alone and not isinstance(other, Sym)):
            return math.inf
        return self._of_term("missing term", other)

    def _opens(self, edit: Edit) -> float:
        """Of what brings a reaction or another coordinate into an equation of motion of one alone, which can be solved by itself; more where the
        acceleration is exchanged, or where a speed or an energy was given in numbers of the model alone."""
        new = edit.after.symbols - self.its.said - {*self.vocabulary.parameters}
        if self.its.is_integrated:
            return _ODD * bool(new)
        if not self.its.is_closed:
            return 0.0
        exchanged = edit.kind == "symbol" and any(n.dots == 2 for n in new)
        return _ODD if exchanged else _OPENED * bool(new)

    def _of_extra_term(self, term: Node) -> float:
        """What an equation is solved for does not go, nor all but that; what is counted twice does."""
        other = next((side for side in self.its.sides if side is not unsigned(term)), None)
        alone = is_answer(other) and any(side is term for side in self.its.sides)  # X = 0 is left
        solved = alone or (is_answer(unsigned(term)) and unsigned(term) in self.its.sides)
        inside = all(part is not term and unsigned(part) is not term for side in self.its.sides for part in terms_of(side))
        its = dimension(term, self.vocabulary.dimensions)
        inside &= its is None or bool(its.mass) or its.time != -1  # a speed is easily taken as one beside another
        inside_of_statics = _ODD * (inside and self.its.is_static)
        return _ODD * solved + _ONCE * (not self.its.is_there(term, but=term)) + _INSIDE * inside + inside_of_statics

    def _of_symbol(self, old: Sym, new: Sym) -> float:
        known = self.vocabulary
        one, other = np.abs(self.values[old.key]), np.abs(self.values[new.key])
        if one.shape == other.shape and np.allclose(one, other, rtol=_SAME, atol=0):
            return math.inf
        turns = known.dimension(old) == INERTIA  # its moment about another point may have a letter of its own
        moves = known.dimension(old) == ACCELERATION  # as it is prescribed
        mixed = old in known.parameters and new not in known.parameters and not (turns or moves)
        unsaid = new in known.others and new not in self.its.said
        solved = any(side is old for side in self.its.sides)
        other = known.is_load(new) and stem(old) != stem(new)
        new_letter = (_NEW_RATE if known.is_rate(new) else _NEW) + _OTHER_LETTER * other
        return _ODD * mixed + new_letter * unsaid + _SOLVED * solved

    def _of_symbols(self, new: Node) -> float:
        """Of a sum or a square for a symbol, or of a force for a weight."""
        known, unsaid = self.vocabulary, new.symbols - self.its.said
        if isinstance(new, Pow):
            return _NEW * len(unsaid) + _ODD * cancels_within(new.base, self.values)
        if isinstance(new, Add):
            stems = {stem(n) for n in new.symbols & self.its.said}
            twins = {n for n in unsaid & {*known.parameters} if stem(n) in stems}
            return _NEW * sum(
                3 if known.is_rate(n) and n not in known.parameters else 1 + (n in known.others and n not in known.letters)
                for n in unsaid - twins
            )
        return sum(_PRESSES if n in known.letters else _UNDECLARED for n in unsaid if n in known.others)

    def _of_factor(self, old: Node, new: Node) -> float:
        """Of a factor that is no parameter and of which nothing was said, or a place below a line, and of a term for a quite other one."""
        known, (once, before), (number, after) = self.vocabulary, powers_of(old), powers_of(new)
        unsaid = {n for base in after for n in base.symbols} - self.its.said
        places = [base for base, n in after.items() if n < 0 <= before.get(base, 0) and _is_place(base, known)]
        lost = [base for base, n in before.items() if n and not after.get(base)]
        gained = [base for base, n in after.items() if n and not before.get(base)]
        strange = (
            len(places)
            + 2 * (bool(gained) and abs(number) != abs(once))
            + sum(n in known.others or Sym(n.name) in known.coordinates for n in unsaid)
        )
        divided = isinstance(old, Add) and any(n < before.get(base, 0) for base, n in after.items())  # rather times it elsewhere
        bound = _BOUND * (self._at_instant and bool(unsaid))
        bound += _SOLVED * any(side is old for side in self.its.sides if is_answer(side))  # rather on the other side
        return bound + _ODD * divided + _NEW * (strange + len(unsaid) * (len(gained) > 1)) + _ODD * (bool(lost) and bool(gained))

    def _of_term(self, kind: str, term: Node) -> float:
        if kind == "missing term" and self.its.is_reaction_by_ratio(term):
            return math.inf
        strange = len([*self._strange(term, kind == "missing term")])
        again = kind == "missing term" and (
            self.its.is_there(term) or any(term in n.terms for n in self.its.parts if isinstance(n, Add))
        )
        # What it is solved for does not stand on both sides.
        answered = kind == "missing term" and not term.symbols.isdisjoint(self.its.sides)
        size = _NEW * strange + _ODD * (again + answered) + self._mixture(term)
        size += _NEW_RATE * any(
            self.vocabulary.is_rate(n) and n in self.vocabulary.parameters for n in term.symbols - self.its.said
        )
        number = abs(powers_of(term)[0])
        of_body = bool(number) and np.isclose(1 / number, _OF_BODIES).any()  # 12 m d²/L²
        size += _ODD * (kind == "missing term" and number > _MOST_TIMES and not of_body)
        size += _TAKEN_OUT * (self.its.moves_as_one and any(map(self.its.is_reaction, term.symbols - self.its.said)))
        accelerates = any(map(self.its.is_acceleration, term.symbols - {*self.vocabulary.parameters}))
        size -= _STATICS * (kind == "missing term" and self.its.is_static and accelerates)
        return size - PARTNER * self.its.is_centripetal(term)

    def _strange(self, term: Node, missing: bool) -> Iterator[Node]:
        """What speaks against a term, each as often as it counts."""
        known, names = self.vocabulary, {n.name for n in term.symbols} - {n.name for n in self.its.said}
        new = [n for n in (*known.coordinates, *known.others, *self.its.loads) if n.name in names]
        new = [n for n in new if n not in known.letters or n not in known.angular]
        for symbol in new:
            load = known.dimension(symbol) in (FORCE, ENERGY) and symbol not in known.letters
            arm = known.coordinates.get(symbol) == LENGTH and symbol in term.symbols
            yield from [symbol] * (1 + load + arm + 2 * self.its.is_another_name(symbol))
        quotients = [n for n in walk(term) if isinstance(n, Quotient)]
        below = {n for each in quotients for n in each.bottom.symbols}
        if missing and below and (new or not self.its.has_quotient):
            yield from [term] * (2 if new else 1)
        if missing and below - self.its.below and self.its.dimension == ENERGY and not self.its.has_mass_times_acceleration:
            yield from [term] * 3  # energies have no fractions
        if missing and below and dimension(term, known.dimensions) != self.its.dimension:  # a fraction in what stands there
            yield from [term] * 2
        for symbol in below - self.its.below:
            yield from [symbol] * 2 * (symbol in known.coordinates and not symbol.dots)
        usual = {
            *known.products_across,
            *known.accelerations,
            *(part for n in walk(term) if isinstance(n, Fn) for part in n.args),
        }
        for part in walk(term):
            yield from (
                [part] * 2 * (isinstance(part, Add) and not _is_fall(part) and part not in usual and part not in self.its.parts)
            )
        for symbol in term.symbols:
            yield from [symbol] * 2 * (symbol.dots == 2 and self.its.is_solved_for_another(symbol))
        if self.its.is_part_of_mass(term) or self.its.is_of_another(term):
            yield term
        if self.its.is_reaction_in_disguise(term):
            yield from [term] * 2
        if (
            missing
            and any(map(known.is_load, term.symbols - {*known.parameters}))
            and _resolved(term) > max(map(_resolved, self.its.parts))
        ):
            yield from [term] * 3  # a force that is resolved twice
        rates = [n for n in term.symbols if known.is_rate(n)]
        if (
            missing
            and not self.its.has_mass_times_acceleration
            and len(rates) > 1
            and new
            and not all(Sym(n.name) in known.coordinates for n in rates)
        ):
            yield from [term] * 4  # energies have products of the rates of coordinates alone

    def _mixture(self, term: Node) -> float:
        """Of an acceleration, or a force that does no work along a coordinate, beside energies or momenta alone."""
        known = self.vocabulary
        loads = [n for n in term.symbols if n not in known.parameters and known.is_load(n)]
        said = [n for n in self.its.said if n not in known.parameters]
        driven = any(known.is_load(n) or (n in known.others and known.dimension(n) is None) for n in said)  # the load of a motor
        if not loads or self.its.is_balance or driven:
            return _MIXED * (driven and self.its.has_energy and any(map(self.its.is_acceleration, loads)))
        if not any(map(known.is_rate, self.its.said)) or any(n in known.coordinates and not n.dots for n in term.symbols):
            return math.inf if any(n.dots == 2 for n in loads) and any(map(known.is_rate, self.its.said)) else 0.0
        return _MIXED if all(n in known.letters for n in loads) else math.inf


def _is_root_of_number(node: Node) -> bool:
    return isinstance(node, Fn) and node.name == "sqrt" and not node.symbols


def _resolved(term: Node) -> int:
    """How often something is resolved along a direction; once at least."""
    calls = (n for base, n in powers_of(term)[1].items() if isinstance(base, Fn) and base.name in ("sin", "cos"))
    return max(1, sum(map(abs, calls)))


def _is_fall(node: Node) -> bool:
    """Whether it is 1 − cos θ, as of what has fallen from there."""
    return isinstance(node, Add) and len(node.terms) == 2 and isinstance(node.terms[0], Num)


def _is_place(base: Node, known: Vocabulary) -> bool:
    """Whether a coordinate stands in it, or an expression with one."""
    return any(n in known.coordinates for n in base.symbols)


def _of_number(old: Node, new: Node, values: Mapping[str, Array], usual: float) -> float:
    """How unlikely a number is to be taken for another; ``usual``: one that is usual before terms, for another."""
    before, after = (float(numbers(node, values)[0]) for node in (old, new))
    if before * after < 0:  # another sign and another number are two slips
        return 2 * _ODD
    before, after = abs(before), abs(after)
    if isinstance(old, Num) and isinstance(new, Num) and before.is_integer() and after not in FIGURES:
        return _ODD
    is_number = isinstance(old, Num | Quotient) and not old.symbols
    of_body = is_number and np.isclose(before, _OF_BODIES).any() and np.isclose(after, _NATURAL).any()
    ratio = max(after / before, before / after) if before and after else 0.0
    if np.isclose(ratio, _RATIOS).any() or of_body:
        of_rod = of_body or np.isclose(max(before, after), 12.0)
        return _FOURFOLD * bool(np.isclose(ratio, _RATIOS[1]) and not of_rod)
    figures = [abs(powers_of(node)[0]) for node in (old, new)]
    return usual if all(np.isclose(figure, _NATURAL).any() for figure in figures) else _ODD
