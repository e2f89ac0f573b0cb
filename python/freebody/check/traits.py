"""What an equation is: a balance, an equation of motion, an answer; and what a term of it is."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from functools import cached_property

import numpy as np

from freebody.symbolic.dimensions import ACCELERATION, ENERGY, FORCE, INERTIA, LENGTH, MASS, NUMBER_ONLY, TIME, Known
from freebody.symbolic.evaluate import Array
from freebody.symbolic.tree import Add, Fn, Mul, Node, Pow, Quotient, Sym, unsigned, walk

from .language.dimensions import dimension
from .language.statements import Equation, terms
from .powers import powers_of
from .taken_away import numbers
from .vocabulary import Vocabulary

_OF_RODS = (1 / 12, 1 / 6, 1 / 3, 2 / 3)
_OF_BALLS = (2 / 5, 2 / 7, 5 / 7, 7 / 5)
_SAME = 1e-9


class Traits:
    """Those of one equation; ``values`` are those of true states, ``elsewhere`` of others. ``said``: its symbols; ``sides``: without signs."""

    def __init__(
        self, equation: Equation, vocabulary: Vocabulary, values: Mapping[str, Array], elsewhere: Mapping[str, Array]
    ) -> None:
        self.equation, self.vocabulary, self.values, self.elsewhere = equation, vocabulary, values, elsewhere
        self.said = equation.symbols
        self.sides = [unsigned(side) for side in (equation.left, equation.right)]

    def weighs(self, mass: Node | None) -> bool:
        """Whether a mass stands in a sum times g: weights may pull against each other."""
        products = (n.factors for n in walk(self.equation) if isinstance(n, Mul))
        weights = (
            factors
            for factors in products
            if any(self.vocabulary.dimension(f) == ACCELERATION for f in factors if isinstance(f, Sym))
        )
        return any(isinstance(f, Add) and any(term is mass for term in f.terms) for factors in weights for f in factors)

    @cached_property
    def is_closed(self) -> bool:
        """Whether it is the equation of motion of one coordinate."""
        moving = self.said - {*self.vocabulary.parameters}
        return len({n.name for n in moving}) == 1 and max(n.dots for n in moving) == 2 > min(n.dots for n in moving)

    def has_mass_beside(self, part: Node) -> bool:
        """Whether a part stands in a term with a mass or an inertia, whose numbers are of many kinds."""
        whole = next((term for term in terms(self.equation) if any(each is part for each in walk(term))), part)
        return any(self.vocabulary.dimension(Sym(n.name)) in (MASS, INERTIA) for n in whole.symbols)

    @cached_property
    def answers(self) -> set[Node]:
        """The symbols for which an equation, or for whose power, is solved."""
        return {side.base if isinstance(side, Pow) else side for side in self.sides if is_answer(side)}

    def is_reaction_by_ratio(self, term: Node) -> bool:
        """Whether it has a reaction of which nothing was said over a mass or a speed: no balance has it so."""
        known = self.vocabulary
        below = (known.dimension(n) for part in walk(term) if isinstance(part, Quotient) for n in part.bottom.symbols)
        new = any(self.is_reaction(n) and n not in known.letters for n in term.symbols - self.said)
        return new and any(its is not None and bool(its.mass or its.time) for its in below)

    @cached_property
    def dimension(self) -> Known:
        """That of the terms of the equation, as far as it is known."""
        found = (dimension(term, self.vocabulary.dimensions) for term in terms(self.equation))
        return next((each for each in found if each is not None), None)

    def is_another_name(self, symbol: Sym) -> bool:
        """Whether it has, on all true states, the value of one that was said, as the pull of a wire has in small motions."""
        own = self.values.get(symbol.key)
        said = (self.values[n.key] for n in self.said if n.key in self.values)
        return own is not None and any(own.shape == each.shape and np.allclose(own, each, rtol=_SAME, atol=0) for each in said)

    def is_of_another(self, term: Node) -> bool:
        """Whether it is of parameters alone, and of two or more of which nothing was said: in a balance, of which no side is an answer, a letter
        for all of it is likelier."""
        unsaid = term.symbols - self.said
        if self.answers:
            return False
        return term.symbols <= {*self.vocabulary.parameters} and len([n for n in unsaid if n.name != "g"]) > 1

    def is_reaction(self, symbol: Sym) -> bool:
        return symbol in self.vocabulary.others and self.vocabulary.dimension(symbol) in (FORCE, ENERGY)

    @cached_property
    def moves_as_one(self) -> bool:
        """Whether it is an equation of motion of several masses, from which reactions have been taken out."""
        known, together = self.vocabulary, Counter[Sym]()
        for term in self.expanded:
            masses = [n for n in term.symbols if known.dimension(n) == MASS]
            together.update(
                n for n in term.symbols if masses and known.dimension(n) == ACCELERATION and n not in known.parameters
            )
        return not self.has_load and max(together.values(), default=0) > 1

    @cached_property
    def loads(self) -> list[Sym]:
        return [n for n in self.vocabulary.parameters if self.vocabulary.dimension(n) in (FORCE, ENERGY)]

    @cached_property
    def has_mass_times_acceleration(self) -> bool:
        """Whether it is one of forces or moments, as its dimension and what it speaks of say."""
        its = (dimension(term, self.vocabulary.dimensions) for term in self.expanded)
        of_balance = self.said - {*self.vocabulary.parameters} - self.vocabulary.energies
        return any(map(self.vocabulary.is_load, of_balance)) and any(each is not None and each.mass for each in its)

    @cached_property
    def has_load(self) -> bool:
        """Whether a reaction or a force stands in it: else it is an equation of motion, whose numbers are those of rotation, too."""
        return any(self.vocabulary.is_load(n) for n in self.said if n in self.vocabulary.others)

    @cached_property
    def is_static(self) -> bool:
        """Whether it is a balance of forces or moments in which nothing moves."""
        known = self.vocabulary
        moving = (n for n in self.said if n not in known.parameters and (known.is_rate(n) or self.is_acceleration(n)))
        return self.has_load and self.dimension in (FORCE, ENERGY) and not any(moving)

    @cached_property
    def parts(self) -> set[Node]:
        return {*walk(self.equation)}

    @cached_property
    def is_integrated(self) -> bool:
        """Whether it says of a place, a speed, a time or an energy what that is in parameters alone."""
        one, other = self.equation.left, self.equation.right
        asked = one.base if isinstance(one, Pow) else one
        if (
            not isinstance(asked, Sym)
            or asked in self.vocabulary.parameters
            or not other.symbols <= {*self.vocabulary.parameters}
        ):
            return False
        first = asked.dots < 2 and Sym(asked.name) in self.vocabulary.coordinates
        return bool(other.symbols) and (
            first or asked.name == "t" or asked in self.vocabulary.energies or self.vocabulary.is_rate(asked)
        )

    def is_beside_square(self, square: Pow) -> bool:
        """Whether the square of a rate is added to others, as in an energy."""
        moving = lambda n: isinstance(n, Sym) and self.vocabulary.is_rate(n) and n not in self.vocabulary.parameters
        is_square = lambda n: isinstance(n, Pow) and moving(n.base)
        sums = (n.terms for n in self.parts if isinstance(n, Add) and any(term is square for term in n.terms))
        return any(all(map(is_square, terms)) for terms in sums)

    @cached_property
    def has_quotient(self) -> bool:
        return any(isinstance(n, Quotient) for n in self.parts)

    @cached_property
    def below(self) -> set[Sym]:
        return {n for each in self.parts if isinstance(each, Quotient) for n in each.bottom.symbols}

    @cached_property
    def terms(self) -> list[tuple[Node, Array]]:
        return [(term, numbers(term, self.elsewhere)) for term in terms(self.equation)]

    def is_there(self, term: Node, but: Node | None = None) -> bool:
        """Whether it is another term of the equation times a number."""
        own = numbers(term, self.elsewhere)
        with np.errstate(all="ignore"):
            ratios = [own / value for other, value in self.terms if but is None or other is not unsigned(but)]
            return any(np.isfinite(r).all() and np.ptp(r) <= _SAME * np.abs(r).max() for r in ratios)

    def is_acceleration(self, symbol: Sym) -> bool:
        return self.vocabulary.dimension(symbol) in (ACCELERATION, NUMBER_ONLY.times(TIME, -2))

    @cached_property
    def has_energy(self) -> bool:
        """Whether it speaks of kinetic energies, and of no acceleration."""
        known = self.vocabulary
        if any(self.is_acceleration(n) for n in self.said if n not in known.parameters):
            return False
        return any(abs(number) < 1 and _is_of_motion(powers, known) for number, powers in map(powers_of, self.expanded))

    @cached_property
    def is_balance(self) -> bool:
        """Whether it can only be one of forces or moments, as its dimension says, or a term with one rate, as of a damper."""
        known = self.vocabulary
        its = {dimension(term, known.dimensions) for term in self.expanded}
        rates = [
            sum(n for base, n in powers_of(term)[1].items() if isinstance(base, Sym) and known.is_rate(base))
            for term in self.expanded
        ]
        return FORCE in its or (ENERGY in its and 1 in rates)

    def is_part_of_mass(self, term: Node) -> bool:
        """Whether it is a third or so of a mass times its acceleration: such numbers belong to rods that turn."""
        number, powers = powers_of(term)
        if not np.isclose(abs(number), _OF_RODS).any():
            return False
        factors = [n for n in powers if isinstance(n, Sym)]
        moves = any(n.dots == 2 or self.vocabulary.dimension(n) == ACCELERATION for n in factors)
        lengths = any(self.vocabulary.dimension(n) == LENGTH for n in factors)
        return moves and not lengths and not any(n in self.vocabulary.angular for base in powers for n in base.symbols)

    def is_reaction_in_disguise(self, term: Node) -> bool:
        """Whether it has, in a balance of forces with a reaction, the number of a ball that turns: what rubs on it stands for that."""
        return self.dimension == FORCE and self.has_load and bool(np.isclose(abs(powers_of(term)[0]), _OF_BALLS).any())

    def is_force(self, term: Node) -> bool:
        """Whether it is a force, a weight, or a mass times its acceleration, or a component of one, with no number: another one is
        forgotten rather than that."""
        number, powers = powers_of(term)
        known, factors = self.vocabulary, [n for n in powers if isinstance(n, Sym)]
        powers = {n: power for n, power in powers.items() if not isinstance(n, Fn)}
        masses = [n for n in factors if known.dimension(n) == MASS]
        moves = [n for n in factors if known.dimension(n) == ACCELERATION]
        alone = len(factors) == 1 and known.dimension(factors[0]) == FORCE
        return abs(number) == 1 and len(factors) == len(powers) and (alone or len(masses) == len(moves) == len(factors) / 2 == 1)

    def is_centripetal(self, term: Node) -> bool:
        """Whether the square of a rate stands in it beside the same as the second derivative in the equation, or times a distance beside
        the second derivative of that."""
        squared = [n.base for n in walk(term) if isinstance(n, Pow) and isinstance(n.base, Sym) and n.base.dots == 1]
        if len(squared) != 1:
            return False
        sizes = {n for n in term.symbols if not n.dots}
        partners = ((sizes, Sym(squared[0].name, 2)), *((sizes - {n}, Sym(n.name, 2)) for n in sizes))
        return any(own <= part.symbols for own, symbol in partners for part in self.expanded if symbol in part.symbols)

    @cached_property
    def expanded(self) -> list[Node]:
        return terms(self.equation, expand=True)

    def is_solved_for_another(self, symbol: Sym) -> bool:
        """Whether the equation says what one acceleration is, and nothing of this one."""
        alone = any(isinstance(side, Sym) and side.dots == 2 for side in (self.equation.left, self.equation.right))
        return alone and symbol not in self.said


def _is_of_motion(powers: Mapping[Node, int], known: Vocabulary) -> bool:
    """Whether a product is of a mass or an inertia and the square of a rate, as a kinetic energy is."""
    masses = any(known.dimension(n) in (MASS, INERTIA) for base in powers for n in base.symbols)
    return masses and any(
        power == 2 and isinstance(base, Sym) and known.is_rate(base) and base not in known.parameters
        for base, power in powers.items()
    )


def is_answer(side: Node | None) -> bool:
    """Whether it is a symbol, or a power of one."""
    return isinstance(side.base if isinstance(side, Pow) else side, Sym)
