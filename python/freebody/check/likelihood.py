"""How unlikely an edit is as the mend of a slip that people make."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterator, Mapping
from functools import cached_property

import numpy as np

from freebody.symbolic.dimensions import ENERGY, FORCE, INERTIA, LENGTH, MASS, NUMBER_ONLY, TIME, Known
from freebody.symbolic.evaluate import Array
from freebody.symbolic.tree import Add, Fn, Mul, Negative, Node, Num, Pow, Quotient, Sym, unsigned, walk

from .edits import FIGURES, Edit
from .language.dimensions import dimension
from .language.statements import Equation, terms
from .powers import powers_of
from .slips import is_constraint
from .taken_away import TakenAway, cancels, cancels_within, numbers, terms_of
from .vocabulary import Vocabulary

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
_OF_RODS = (1 / 12, 1 / 6, 1 / 3, 2 / 3)
_FOURFOLD = 0.2  # for a number that is another four times, and not 1/12 for 1/3
_ODD = 0.5
_ROOTED = 0.6  # that a root of a number, as of a sine, is beside what moves and not in the place of another number
_USUAL = 0.1  # for one usual number for another
_MIXED = 1.0  # for an acceleration or a force in an energy or a momentum
_FORGOTTEN = 0.3  # for a number before a weight or a mass times its acceleration
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
_STEM = re.compile(r"[^_\d.]*")
"""A letter without its index."""
_ACCELERATION = LENGTH.times(TIME, -2)
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
        self._said = equation.symbols
        self._sides = [unsigned(side) for side in (equation.left, equation.right)]

    def lack(self, edit: Edit) -> float:
        """By how much an edit is larger than its kind says; without bound where it would be no correction: a mass or an inertia below
        0, another name of the same or of its opposite."""
        if edit.new is None:
            asked = any(not side.symbols <= edit.after.symbols for side in self.taken.differences)
            return self._of_extra_term(edit.old) + _ODD * asked if edit.kind == "extra term" and edit.old is not None else 0.0
        if cancels(edit.after) and not cancels(self.equation):
            return math.inf
        if isinstance(edit.new, Negative) and dimension(edit.new, self.vocabulary.dimensions) in (MASS, INERTIA):
            return 0.0 if self._weighs(edit.old) else math.inf
        return self._of_kind(edit) + self._opens(edit)

    def _weighs(self, mass: Node | None) -> bool:
        """Whether a mass stands in a sum times g: weights may pull against each other."""
        products = (n.factors for n in walk(self.equation) if isinstance(n, Mul))
        weights = (
            factors
            for factors in products
            if any(self.vocabulary.dimension(f) == _ACCELERATION for f in factors if isinstance(f, Sym))
        )
        return any(isinstance(f, Add) and any(term is mass for term in f.terms) for factors in weights for f in factors)

    def _of_kind(self, edit: Edit) -> float:
        """That of an edit that puts something in."""
        match edit.kind, edit.old, edit.new:
            case "factor", Node() as old, new:
                answers = any(isinstance(side, Sym) for side in self._sides)
                odd_here = is_constraint(self.equation, self.vocabulary) or not (answers or self._has_mass_beside(old))
                odd = _of_number(old, new, self.values, _ODD if odd_here else _USUAL)
                odd = min(odd, _USUAL) if self._at_instant and answers else odd
                odd += _ROOTED * (bool(old.symbols) and new is not None and any(map(_is_root_of_number, walk(new))))
                return odd + _FORGOTTEN * (odd > 0 and self._has_load and self._is_force(old))
            case "symbol", Sym() as old, Sym() as new if {old.key, new.key} <= self.values.keys():
                sums = [side for side in (edit.after.left, edit.after.right) if isinstance(side, Add)]
                twice = any(len({*each.terms}) < len(each.terms) for each in sums)  # 2 T is not written T + T
                return self._of_symbol(old, new) + _ODD * (twice or any(cancels_within(each, self.values) for each in sums))
            case "symbol", _, new:
                if not (new.symbols & self._answers).issubset(() if edit.old is None else edit.old.symbols):
                    return math.inf  # what it is solved for, for something else
                undoes = isinstance(new, Add) and self.taken.by(edit.after)
                solved = edit.old not in self.vocabulary.parameters and any(side is edit.old for side in self._sides)
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
            case "missing factor", Node() as old, new:
                return self._of_factor(old, new)
            case "resultant", Node() as old, new:
                return self._of_resultant(old, new)
            case "angle", _, new:
                return _NEW * len({n.name for n in new.symbols} - {n.name for n in self._said})
        return 0.0

    def _of_resultant(self, old: Node, new: Node) -> float:
        """Of a component beside one that was said; none is made of what the equation is solved for, or stands beside that but by a letter."""
        squares = (n.base for n in walk(new) if isinstance(n, Pow) and n.base != unsigned(old))
        other = next((base for base in squares if not base.symbols <= old.symbols), None)
        if other is None:
            return 0.0
        alone = old in self._sides and _is_answer(old) and not all(map(_is_answer, self._sides))
        if not other.symbols.isdisjoint(self._sides) or (alone and not isinstance(other, Sym)):
            return math.inf
        return self._of_term("missing term", other)

    def _opens(self, edit: Edit) -> float:
        """Of what brings a reaction or another coordinate into an equation of motion of one alone, which can be solved by itself; more where the
        acceleration is exchanged."""
        new = edit.after.symbols - self._said - {*self.vocabulary.parameters} if self._is_closed else ()
        exchanged = edit.kind == "symbol" and any(n.dots == 2 for n in new)
        return _ODD if exchanged else _OPENED * bool(new)

    @cached_property
    def _is_closed(self) -> bool:
        """Whether it is the equation of motion of one coordinate."""
        moving = self._said - {*self.vocabulary.parameters}
        return len({n.name for n in moving}) == 1 and max(n.dots for n in moving) == 2 > min(n.dots for n in moving)

    def _has_mass_beside(self, part: Node) -> bool:
        """Whether a part stands in a term with a mass or an inertia, whose numbers are of many kinds."""
        whole = next((term for term in terms(self.equation) if any(each is part for each in walk(term))), part)
        return any(self.vocabulary.dimension(Sym(n.name)) in (MASS, INERTIA) for n in whole.symbols)

    @cached_property
    def _answers(self) -> set[Node]:
        """The symbols for which an equation, or for whose power, is solved."""
        return {side.base if isinstance(side, Pow) else side for side in self._sides if _is_answer(side)}

    def _of_extra_term(self, term: Node) -> float:
        """What an equation is solved for does not go, nor all but that; what is counted twice does."""
        other = next((side for side in self._sides if side is not unsigned(term)), None)
        alone = _is_answer(other) and any(side is term for side in self._sides)  # X = 0 is left
        solved = alone or (_is_answer(unsigned(term)) and unsigned(term) in self._sides)
        inside = all(part is not term and unsigned(part) is not term for side in self._sides for part in terms_of(side))
        its = dimension(term, self.vocabulary.dimensions)
        inside &= its is None or bool(its.mass) or its.time != -1  # a speed is easily taken as one beside another
        return _ODD * solved + _ONCE * (not self._is_there(term, but=term)) + _INSIDE * inside

    def _of_symbol(self, old: Sym, new: Sym) -> float:
        known = self.vocabulary
        one, other = np.abs(self.values[old.key]), np.abs(self.values[new.key])
        if one.shape == other.shape and np.allclose(one, other, rtol=_SAME, atol=0):
            return math.inf
        turns = known.dimension(old) == INERTIA  # its moment about another point may have a letter of its own
        moves = known.dimension(old) == _ACCELERATION  # as it is prescribed
        mixed = old in known.parameters and new not in known.parameters and not (turns or moves)
        unsaid = new in known.others and new not in self._said
        solved = any(side is old for side in self._sides)
        other = known.is_load(new) and _STEM.match(old.name)[0] != _STEM.match(new.name)[0]  # type: ignore[index]
        new_letter = (_NEW_RATE if known.is_rate(new) else _NEW) + _OTHER_LETTER * other
        return _ODD * mixed + new_letter * unsaid + _SOLVED * solved

    def _of_symbols(self, new: Node) -> float:
        """Of a sum or a square for a symbol, or of a force for a weight."""
        known, unsaid = self.vocabulary, new.symbols - self._said
        if isinstance(new, Pow):
            return _NEW * len(unsaid) + _ODD * cancels_within(new.base, self.values)
        if isinstance(new, Add):
            stems = {_STEM.match(n.name)[0] for n in new.symbols & self._said}  # type: ignore[index]
            twins = {n for n in unsaid & {*known.parameters} if _STEM.match(n.name)[0] in stems}  # type: ignore[index]
            return _NEW * sum(
                3 if known.is_rate(n) and n not in known.parameters else 1 + (n in known.others and n not in known.letters)
                for n in unsaid - twins
            )
        return sum(_PRESSES if n in known.letters else _UNDECLARED for n in unsaid if n in known.others)

    def _of_factor(self, old: Node, new: Node) -> float:
        """Of a factor that is no parameter and of which nothing was said, or a place below a line, and of a term for a quite other one."""
        known, (once, before), (number, after) = self.vocabulary, powers_of(old), powers_of(new)
        unsaid = {n for base in after for n in base.symbols} - self._said
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
        bound += _SOLVED * any(side is old for side in self._sides if isinstance(side, Sym))  # rather on the other side
        return bound + _ODD * divided + _NEW * (strange + len(unsaid) * (len(gained) > 1)) + _ODD * (bool(lost) and bool(gained))

    def _of_term(self, kind: str, term: Node) -> float:
        if kind == "missing term" and self._is_reaction_by_ratio(term):
            return math.inf
        strange = len([*self._strange(term, kind == "missing term")])
        again = kind == "missing term" and (
            self._is_there(term) or any(term in n.terms for n in self._parts if isinstance(n, Add))
        )
        # What it is solved for does not stand on both sides.
        answered = kind == "missing term" and not term.symbols.isdisjoint(self._sides)
        size = _NEW * strange + _ODD * (again + answered) + self._mixture(term)
        size += _NEW_RATE * any(self.vocabulary.is_rate(n) and n in self.vocabulary.parameters for n in term.symbols - self._said)
        size += _ODD * (kind == "missing term" and abs(powers_of(term)[0]) > _MOST_TIMES)
        size += _TAKEN_OUT * (self._moves_as_one and any(map(self._is_reaction, term.symbols - self._said)))
        return size - PARTNER * self._is_centripetal(term)

    def _is_reaction_by_ratio(self, term: Node) -> bool:
        """Whether it has a reaction of which nothing was said over a mass or a speed: no balance has it so."""
        known = self.vocabulary
        below = (known.dimension(n) for part in walk(term) if isinstance(part, Quotient) for n in part.bottom.symbols)
        new = any(self._is_reaction(n) and n not in known.letters for n in term.symbols - self._said)
        return new and any(its is not None and bool(its.mass or its.time) for its in below)

    def _strange(self, term: Node, missing: bool) -> Iterator[Node]:
        """What speaks against a term, each as often as it counts."""
        known, names = self.vocabulary, {n.name for n in term.symbols} - {n.name for n in self._said}
        new = [n for n in (*known.coordinates, *known.others, *self._loads) if n.name in names]
        new = [n for n in new if n not in known.letters or n not in known.angular]
        for symbol in new:
            load = known.dimension(symbol) in (FORCE, ENERGY) and symbol not in known.letters
            arm = known.coordinates.get(symbol) == LENGTH and symbol in term.symbols
            yield from [symbol] * (1 + load + arm + 2 * self._is_another_name(symbol))
        quotients = [n for n in walk(term) if isinstance(n, Quotient)]
        below = {n for each in quotients for n in each.bottom.symbols}
        if missing and below and (new or not self._has_quotient):
            yield from [term] * (2 if new else 1)
        if missing and below - self._below and self._dimension == ENERGY and not self._has_mass_times_acceleration:
            yield from [term] * 3  # energies have no fractions
        if missing and below and dimension(term, known.dimensions) != self._dimension:  # a fraction in what stands there
            yield from [term] * 2
        for symbol in below - self._below:
            yield from [symbol] * 2 * (symbol in known.coordinates and not symbol.dots)
        usual = {
            *known.products_across,
            *known.accelerations,
            *(part for n in walk(term) if isinstance(n, Fn) for part in n.args),
        }
        for part in walk(term):
            yield from (
                [part] * 2 * (isinstance(part, Add) and not _is_fall(part) and part not in usual and part not in self._parts)
            )
        for symbol in term.symbols:
            yield from [symbol] * 2 * (symbol.dots == 2 and self._is_solved_for_another(symbol))
        if self._is_part_of_mass(term) or self._is_of_another(term):
            yield term
        rates = [n for n in term.symbols if known.is_rate(n)]
        if (
            missing
            and not self._has_mass_times_acceleration
            and len(rates) > 1
            and new
            and not all(Sym(n.name) in known.coordinates for n in rates)
        ):
            yield from [term] * 4  # energies have products of the rates of coordinates alone

    @cached_property
    def _dimension(self) -> Known:
        """That of the terms of the equation, as far as it is known."""
        found = (dimension(term, self.vocabulary.dimensions) for term in terms(self.equation))
        return next((each for each in found if each is not None), None)

    def _is_another_name(self, symbol: Sym) -> bool:
        """Whether it has, on all true states, the value of one that was said, as the pull of a wire has in small motions."""
        own = self.values.get(symbol.key)
        said = (self.values[n.key] for n in self._said if n.key in self.values)
        return own is not None and any(own.shape == each.shape and np.allclose(own, each, rtol=_SAME, atol=0) for each in said)

    def _is_of_another(self, term: Node) -> bool:
        """Whether it is of parameters alone, and of two or more of which nothing was said: in a balance, of which no side is an answer, a letter
        for all of it is likelier."""
        unsaid = term.symbols - self._said
        if self._answers:
            return False
        return term.symbols <= {*self.vocabulary.parameters} and len([n for n in unsaid if n.name != "g"]) > 1

    def _is_reaction(self, symbol: Sym) -> bool:
        return symbol in self.vocabulary.others and self.vocabulary.dimension(symbol) in (FORCE, ENERGY)

    @cached_property
    def _moves_as_one(self) -> bool:
        """Whether it is an equation of motion of several masses, from which reactions have been taken out."""
        known, together = self.vocabulary, Counter[Sym]()
        for term in self._expanded:
            masses = [n for n in term.symbols if known.dimension(n) == MASS]
            together.update(
                n for n in term.symbols if masses and known.dimension(n) == _ACCELERATION and n not in known.parameters
            )
        return not self._has_load and max(together.values(), default=0) > 1

    @cached_property
    def _loads(self) -> list[Sym]:
        return [n for n in self.vocabulary.parameters if self.vocabulary.dimension(n) in (FORCE, ENERGY)]

    @cached_property
    def _has_mass_times_acceleration(self) -> bool:
        """Whether it is one of forces or moments, as its dimension and what it speaks of say."""
        its = (dimension(term, self.vocabulary.dimensions) for term in self._expanded)
        of_balance = self._said - {*self.vocabulary.parameters} - self.vocabulary.energies
        return any(map(self.vocabulary.is_load, of_balance)) and any(each is not None and each.mass for each in its)

    @cached_property
    def _has_load(self) -> bool:
        """Whether a reaction or a force stands in it: else it is an equation of motion, whose numbers are those of rotation, too."""
        return any(self.vocabulary.is_load(n) for n in self._said if n in self.vocabulary.others)

    @cached_property
    def _parts(self) -> set[Node]:
        return {*walk(self.equation)}

    @cached_property
    def _has_quotient(self) -> bool:
        return any(isinstance(n, Quotient) for n in self._parts)

    @cached_property
    def _below(self) -> set[Sym]:
        return {n for each in self._parts if isinstance(each, Quotient) for n in each.bottom.symbols}

    @cached_property
    def _terms(self) -> list[tuple[Node, Array]]:
        return [(term, numbers(term, self.elsewhere)) for term in terms(self.equation)]

    def _is_there(self, term: Node, but: Node | None = None) -> bool:
        """Whether it is another term of the equation times a number."""
        own = numbers(term, self.elsewhere)
        with np.errstate(all="ignore"):
            ratios = [own / value for other, value in self._terms if but is None or other is not unsigned(but)]
            return any(np.isfinite(r).all() and np.ptp(r) <= _SAME * np.abs(r).max() for r in ratios)

    def _mixture(self, term: Node) -> float:
        """Of an acceleration, or a force that does no work along a coordinate, beside energies or momenta alone."""
        known = self.vocabulary
        loads = [n for n in term.symbols if n not in known.parameters and known.is_load(n)]
        said = [n for n in self._said if n not in known.parameters]
        driven = any(known.is_load(n) or (n in known.others and known.dimension(n) is None) for n in said)  # the load of a motor
        if not loads or self._is_balance or driven:
            return _MIXED * (driven and self._has_energy and any(map(self._is_acceleration, loads)))
        if not any(map(known.is_rate, self._said)) or any(n in known.coordinates and not n.dots for n in term.symbols):
            return math.inf if any(n.dots == 2 for n in loads) and any(map(known.is_rate, self._said)) else 0.0
        return _MIXED if all(n in known.letters for n in loads) else math.inf

    def _is_acceleration(self, symbol: Sym) -> bool:
        return self.vocabulary.dimension(symbol) in (_ACCELERATION, NUMBER_ONLY.times(TIME, -2))

    @cached_property
    def _has_energy(self) -> bool:
        """Whether it speaks of kinetic energies, and of no acceleration."""
        known = self.vocabulary
        if any(self._is_acceleration(n) for n in self._said if n not in known.parameters):
            return False
        return any(abs(number) < 1 and _is_of_motion(powers, known) for number, powers in map(powers_of, self._expanded))

    @cached_property
    def _is_balance(self) -> bool:
        """Whether it can only be one of forces or moments, as its dimension says, or a term with one rate, as of a damper."""
        known = self.vocabulary
        its = {dimension(term, known.dimensions) for term in self._expanded}
        rates = [
            sum(n for base, n in powers_of(term)[1].items() if isinstance(base, Sym) and known.is_rate(base))
            for term in self._expanded
        ]
        return FORCE in its or (ENERGY in its and 1 in rates)

    def _is_part_of_mass(self, term: Node) -> bool:
        """Whether it is a third or so of a mass times its acceleration: such numbers belong to rods that turn."""
        number, powers = powers_of(term)
        if not np.isclose(abs(number), _OF_RODS).any():
            return False
        factors = [n for n in powers if isinstance(n, Sym)]
        moves = any(n.dots == 2 or self.vocabulary.dimension(n) == _ACCELERATION for n in factors)
        lengths = any(self.vocabulary.dimension(n) == LENGTH for n in factors)
        return moves and not lengths and not any(n in self.vocabulary.angular for base in powers for n in base.symbols)

    def _is_force(self, term: Node) -> bool:
        """Whether it is a force, a weight, or a mass times its acceleration, or a component of one, with no number: another one is
        forgotten rather than that."""
        number, powers = powers_of(term)
        known, factors = self.vocabulary, [n for n in powers if isinstance(n, Sym)]
        powers = {n: power for n, power in powers.items() if not isinstance(n, Fn)}
        masses = [n for n in factors if known.dimension(n) == MASS]
        moves = [n for n in factors if known.dimension(n) == _ACCELERATION]
        alone = len(factors) == 1 and known.dimension(factors[0]) == FORCE
        return abs(number) == 1 and len(factors) == len(powers) and (alone or len(masses) == len(moves) == len(factors) / 2 == 1)

    def _is_centripetal(self, term: Node) -> bool:
        """Whether the square of a rate stands in it beside the same as the second derivative in the equation, or times a distance beside
        the second derivative of that."""
        squared = [n.base for n in walk(term) if isinstance(n, Pow) and isinstance(n.base, Sym) and n.base.dots == 1]
        if len(squared) != 1:
            return False
        sizes = {n for n in term.symbols if not n.dots}
        partners = ((sizes, Sym(squared[0].name, 2)), *((sizes - {n}, Sym(n.name, 2)) for n in sizes))
        return any(own <= part.symbols for own, symbol in partners for part in self._expanded if symbol in part.symbols)

    @cached_property
    def _expanded(self) -> list[Node]:
        return terms(self.equation, expand=True)

    def _is_solved_for_another(self, symbol: Sym) -> bool:
        """Whether the equation says what one acceleration is, and nothing of this one."""
        alone = any(isinstance(side, Sym) and side.dots == 2 for side in (self.equation.left, self.equation.right))
        return alone and symbol not in self._said


def _is_of_motion(powers: Mapping[Node, int], known: Vocabulary) -> bool:
    """Whether a product is of a mass or an inertia and the square of a rate, as a kinetic energy is."""
    masses = any(known.dimension(n) in (MASS, INERTIA) for base in powers for n in base.symbols)
    return masses and any(
        power == 2 and isinstance(base, Sym) and known.is_rate(base) and base not in known.parameters
        for base, power in powers.items()
    )


def _is_root_of_number(node: Node) -> bool:
    return isinstance(node, Fn) and node.name == "sqrt" and not node.symbols


def _is_answer(side: Node | None) -> bool:
    """Whether it is a symbol, or a power of one."""
    return isinstance(side.base if isinstance(side, Pow) else side, Sym)


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
