"""Edits whose number or term is found from what the equation lacks: factors, missing terms, terms that should be others."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain, combinations
from typing import Any

import numpy as np

from freebody.symbolic.dimensions import FORCE, INERTIA, LENGTH, MASS, NUMBER_ONLY
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import (
    Add,
    Fn,
    Mul,
    Negative,
    Node,
    Num,
    Pow,
    Quotient,
    Sym,
    children,
    exchange,
    is_zero,
    unsigned,
    walk,
)

from .coefficients import more, multiplied, powered, recognised, snapped
from .edits import Edit, depth
from .inertia_edits import about_another_point, shares
from .known_terms import KnownTerms, calls_in
from .language.dimensions import dimension
from .language.statements import Equation, symbols_in, without_ones
from .monomials import Monomials
from .powers import powers_of, written
from .residual import HOLDS, magnitude
from .roots import on_the_way, other_sides, resultants, rooted
from .shared_ratios import shared_ratios
from .solve_for_term import RequiredTerm, is_asked, required_terms
from .spans import proportional
from .square_edits import SquareEdits
from .sum_edits import SumEdits
from .throughout import throughout
from .vocabulary import Vocabulary
from .weights import pressing

_SAME = 1e-8  # relative spread below which a factor is one number on all states
_NEARLY = 1e-5  # relative spread below which one is meant
_FAR_FETCHED = 0.9  # by which a term is less likely that stands for a wrong sign
_HIGHEST_POWER = 4  # that a factor may be wrong by
_MOST_MASSES = 4  # of which sums are thought of
_MOST_TERMS = 4  # of sums of which two are thought of together
_PART = 0.3  # for a letter that is a part of what it stands for
_NO_ANSWER = 0.25  # for a denominator where an equation is not solved for something
_TAKEN = 0.1  # for powers that are taken away
_WHOLE = 0.3  # for all that a letter is said to be
_ANOTHER = 0.3  # for the second component of which a resultant consists
_ONE = Num(1.0, "1")


@dataclass
class FittedEdits:
    """What can be fitted to an equation: ``values`` are those of true states, ``vocabulary`` has the shapes of missing terms,
    of which as many are tried as lie ``within`` a budget. What an equation lacks is known to ``blur`` times round-off."""

    values: Mapping[str, Array]
    vocabulary: Vocabulary
    within: Callable[[Iterable[Any]], Iterator[Any]] = iter
    blur: float = 1.0
    small: bool = False
    """Whether angles stand for their sines."""
    followed: bool = False
    """Whether motions were followed to the states, which leaves more than round-off."""

    def edits(self, equation: Equation) -> Iterator[Edit]:
        """Single edits found by solving for each part, terms that should be quite other ones aside."""
        with np.errstate(all="ignore"):
            yield from shared_ratios(equation, self.values, self.vocabulary, self.blur)
            yield from self.of_parts(equation, required_terms(equation, self.values))
            yield from throughout(equation, self.vocabulary, self._sizes, self._left)

    def of_parts(self, equation: Equation, needed: Iterable[RequiredTerm]) -> Iterator[Edit]:
        """The edits after which parts of an equation are what is needed."""
        quotients = [n for n in walk(equation) if isinstance(n, Quotient)]
        whole = {id(part) for n in (*quotients, equation) for part in children(n) if not isinstance(part, Num)}
        below_roots = {id(part) for n in walk(equation) if isinstance(n, Fn) and n.name == "sqrt" for part in n.args}
        for required in self.within(needed):
            yield from (Edit.at(equation, "symbol", required.node, new, size) for new, size in self._symbols(required))
            node = required.node  # a number, or a fraction of two
            parts = (node.top, node.bottom) if isinstance(node, Quotient) else (node,)
            found = self._constant(required.needed) if all(isinstance(part, Num) for part in parts) else None
            if found is not None and found != -required.value[0] and (number := recognised(found)) is not None:
                yield Edit.at(equation, "factor", required.node, number)
            if required.addend or id(node) in below_roots:
                yield from self._forgotten(equation, required)
                yield from self._factors(equation, required)
                turned = about_another_point(required, self.terms.monomials(equation))
                yield from (Edit.at(equation, "factor", node, new) for new in turned)
                yield from (Edit.at(equation, "share", node, new) for new in shares(required, self.vocabulary, self.values))
            yield from (Edit.at(equation, "root", node, new) for new in rooted(required, self.values))
            yield from (
                Edit.at(equation, "resultant", node, new, _ANOTHER * lost + 0.02 * depth(new) * lost)
                for new, lost in resultants(required, self.values, self.vocabulary, self.terms.monomials(equation))
            )
            ways = on_the_way(required, self.values, self.vocabulary, self.terms.monomials(equation))
            yield from (Edit.at(equation, "way", node, new, _ANOTHER + 0.02 * depth(new)) for new in ways)
            yield from (
                Edit.at(equation, "symbol", node, new, 0.1) for new in other_sides(required, self.values, self.vocabulary)
            )
            yield from self._squares.edits(equation, required)
            at_angle = self._squares.with_another(required)
            yield from (Edit.at(equation, "resultant", node, new, _ANOTHER + 0.02 * depth(new)) for new in at_angle)
            if isinstance(node, Add) and required.missing.ndim == 1:
                yield from self._squares.of_components(equation, [(term, _ONE) for term in node.terms], required.missing)
                for term in chain(*(lost(node, required.missing) for lost in (self._squares.crossed, self._squares.at_an_angle))):
                    yield Edit("missing term", None, term, exchange(equation, node, more(node, term)), 0.01 * depth(term))
            yield from (Edit.at(equation, "symbol", node, new) for new in pressing(required, self.values, self.vocabulary))
            if isinstance(node, Add):
                yield from self._parts(equation, required)
            if isinstance(node, Add) or id(node) in whole:
                yield from self._missing(equation, required)
            elif isinstance(node, Sym) and required.missing.ndim == 1 and not node.dots:
                yield from self._part_of_letter(equation, required)
            if node in (equation.left, equation.right) and not any(symbols_in(n.bottom) for n in quotients):
                yield from self._denominator(equation, required)

    def other_terms(self, equation: Equation) -> Iterator[Edit]:
        """Terms that should be quite other ones; the whole of what a letter is said to be only where parameters alone say that."""
        with np.errstate(all="ignore"):
            for required in self.within(required_terms(equation, self.values)):
                sides = (s for s in (equation.left, equation.right) if any(n is required.node for n in (s, unsigned(s))))
                side = next(sides, None)
                other = equation.right if side is equation.left else equation.left
                if not required.addend or (side is not None and not isinstance(unsigned(other), Sym)):
                    continue
                if side is None:
                    found = self.terms.matching(equation, required.needed)
                else:
                    every = self.terms.monomials(equation).equal_to(required.needed)
                    found = (term for term in every if term.symbols <= {*self.vocabulary.parameters})
                for term in found:
                    size = 0.02 * depth(term) + _WHOLE * (side is not None)
                    yield Edit.at(equation, "other term", required.node, term, size)

    def _symbols(self, required: RequiredTerm) -> Iterator[tuple[Node, float]]:
        """Symbols of another kind for a symbol or a function, also squared, whatever their sign; for a parameter the sum or the
        difference of two, as an arm often is. With how far-fetched they are."""
        node, span, needed = required.node, required.node.span, required.needed
        known, rows = self._scalars
        alike = lambda values: [known[i] for i in np.flatnonzero((np.abs(values - needed) <= _SAME * np.abs(needed)).all(axis=1))]
        match node:
            case Sym() | Fn() if required.value.ndim == needed.ndim == 1:
                turns = dimension(node, self.vocabulary.dimensions) == INERTIA  # one about another point
                size = lambda n: 0.0 if turns else 0.1 if _is_linear_for_angular(node, n) else 0.3
                yield from ((Sym(n.name, n.dots, span=span), size(n)) for n in alike(rows) if n != node)
            case Pow(base=Sym() as base, exponent=Num(value=2.0) as two) if required.value.ndim == needed.ndim == 1:
                yield from ((Pow(Sym(n.name, n.dots), two, span=span), 0.1) for n in alike(rows**2) if n != base)
        yield from self._of_sums_of_two.edits(required)

    @cached_property
    def terms(self) -> KnownTerms:
        """What an equation may hold."""
        return KnownTerms(self.values, self.vocabulary, self.within, self.blur)

    @cached_property
    def _of_sums_of_two(self) -> SumEdits:
        return SumEdits(self.values, self.vocabulary, self._known)

    @cached_property
    def _squares(self) -> SquareEdits:
        return SquareEdits(self.values, self.vocabulary)

    def _left(self, equation: Equation) -> Array:
        """What the sides of an equation differ by."""
        return np.asarray(sampled(equation.left, self.values) - sampled(equation.right, self.values))

    @cached_property
    def _sizes(self) -> Monomials:
        """Products of quantities of the model."""
        sizes = [n for n in self.vocabulary.parameters if n not in self.vocabulary.angular]
        return Monomials(self.values, sizes, [()], self.blur)

    @cached_property
    def _known(self) -> list[Sym]:
        known = self.vocabulary
        moving = [Sym(q.name, dots) for q in known.coordinates for dots in range(3)]
        return [n for n in (*known.parameters, *moving, *known.others) if n.key in self.values]

    @cached_property
    def _scalars(self) -> tuple[list[Sym], Array]:
        """Symbols that are numbers, and their values."""
        found = [n for n in self._known if self.values[n.key].ndim == 1]
        return found, np.array([self.values[n.key] for n in found]).reshape(len(found), -1)

    def _factors(self, equation: Equation, required: RequiredTerm) -> Iterator[Edit]:
        """A term that lacks a number, or a product of powers of symbols."""
        node, factor = required.node, required.factor
        if factor is None or not np.isfinite(factor).all():
            return
        found = self._constant(factor, self._round_off(equation, required.value))
        if found is None:
            yield from self._other_powers(equation, node, factor)
        elif abs(found + 1) < _SAME:
            yield Edit.at(equation, "sign", node, node.of if isinstance(node, Negative) else Negative(node, span=node.span))
        elif abs(found - 1) > _SAME and (new := multiplied(node, found)) is not None:
            own = 0.05 if any(isinstance(n, Num) for n in walk(node)) else 0.0
            yield Edit.at(equation, "factor", node, new, own)

    def _forgotten(self, equation: Equation, required: RequiredTerm) -> Iterator[Edit]:
        """A term that lacks a sine or cosine, a symbol, or what is made of two."""
        if required.factor is None or not np.isfinite(required.factor).all():
            return
        factors, rows = self._single
        off = np.abs(rows - required.factor).max(axis=1)
        for place in np.flatnonzero(off <= _SAME * self.blur * np.abs(required.factor).max()).tolist():
            size = 0.0 if place < len(self.vocabulary.single_factors) else 0.2
            yield Edit.at(
                equation, "missing factor", required.node, Mul((required.node, factors[place]), span=required.node.span), size
            )
        yield from self._of_sums(equation, required, factors, rows)

    def _of_sums(self, equation: Equation, required: RequiredTerm, factors: Sequence[Node], rows: Array) -> Iterator[Edit]:
        """A term that lacks a number times a sum, as 2 (1 + cos θ)."""
        sums = [i for i, factor in enumerate(factors) if isinstance(factor, Add)]
        for place in (sums[i] for i in proportional(rows[sums], required.factor, _SAME * self.blur)) if sums else ():
            number = self._constant(required.factor / rows[place])
            new = None if number is None or number == 1 else multiplied(Mul((required.node, factors[place])), number)
            if new is not None:
                yield Edit.at(equation, "missing factor", required.node, new, 0.3)

    @cached_property
    def _single(self) -> tuple[list[Node], Array]:
        """Factors that are easily forgotten, and their values."""
        nodes = [*self.vocabulary.single_factors, *self.vocabulary.double_factors]
        rows = np.full((len(nodes), len(next(iter(self.values.values())))), np.nan)
        for row, node in zip(rows, nodes, strict=True):
            if {n.key for n in symbols_in(node)} <= self.values.keys() and (value := sampled(node, self.values)).ndim == 1:
                still = isinstance(node, Add) and node.symbols & {*self.vocabulary.coordinates} and np.ptp(value) <= _NEARLY
                row[:] = np.nan if still else value  # 1 + cos θ is no factor where θ is small, or stays
        return nodes, rows

    def _constant(self, values: Array, round_off: Array | float = 0.0) -> float | None:
        """The number that a factor is on all states, which is known but for ``round_off`` on each; None where it is none."""
        if values.ndim != 1 or not np.isfinite(values).all():
            return None
        same = _SAME * self.blur
        mean = float(np.median(values) if np.ndim(round_off) != 1 else values[np.argmin(round_off)])
        return snapped(mean, same) if mean and np.all(np.abs(values - mean) <= same * abs(mean) + round_off) else None

    def _round_off(self, equation: Equation, value: Array) -> Array | float:
        """What may be left of an equation beside a part of that value on motions that were followed; nothing on states."""
        if not self.followed or value.ndim > 1:
            return 0.0
        sizes = [magnitude(side, self.values) for side in (equation.left, equation.right) if not is_zero(side)]
        return HOLDS * sum(sizes) / np.abs(value) if all(size.ndim == 1 for size in sizes) else 0.0

    def _other_powers(self, equation: Equation, node: Node, factor: Array) -> Iterator[Edit]:
        """A term that lacks a product of powers: a ratio of it upside down, a ratio that counts twice, or what is forgotten."""
        if factor.ndim != 1:
            return
        number, own = powers_of(node)
        sizes = self.vocabulary.sizes
        still = [n for n in own if not isinstance(n, Sym) or n in sizes] + calls_in(equation) + self._bare_angles(equation)
        likely = [n for n in sizes if n in self.vocabulary.letters or n in equation.symbols]
        ways = ((*still, *sizes), (*still, *likely, *self._more_bases(equation), *sizes))
        found = (Monomials(self.values, dict.fromkeys(bases), (), self.blur).powers(factor) for bases in ways)
        lacked = next(filter(None, found), None)
        if not lacked or max(map(abs, lacked.values())) > _HIGHEST_POWER:
            return
        rest = self._constant(factor / sampled(written(1.0, lacked), self.values))
        if rest is None or recognised(number * rest) is None:
            return
        after = Counter(own)
        after.update(lacked)
        new = written(number * rest, {base: n for base, n in after.items() if n})
        if len(lacked) > 1 and all(n == -2 * own.get(base, 0) for base, n in lacked.items()):
            yield Edit.at(equation, "ratio", node, new)
        elif all(n == -2 * own.get(base, 0) and isinstance(base, Fn) for base, n in lacked.items()):
            yield Edit.at(equation, "upside down", node, new)
        elif len(lacked) > 1 and all(n == own.get(base) for base, n in lacked.items()) and {*lacked.values()} == {1, -1}:
            yield Edit.at(equation, "ratio once", node, new)
        else:
            plain = powered(node, rest, lacked) if min(lacked.values()) > 0 else None
            size = sum(map(abs, lacked.values())) + (abs(rest - 1) > _SAME)
            size += any(n > 0 and own.get(base) for base, n in lacked.items()) and min(lacked.values()) < 0  # r²/h for r/cos φ
            if rest == 1.0 and _is_share(lacked):
                yield Edit.at(equation, "share", node, new)
                return
            if rest == 1.0 and _is_share({base: -n for base, n in lacked.items()}):  # one mass for several
                lost = next(base.terms for base, n in lacked.items() if n > 0 and isinstance(base, Add))
                others = [mass for mass in lost if mass not in lacked]
                yield Edit("missing term", None, Add(tuple(others)) if others[1:] else others[0], exchange(equation, node, new))
                return
            taken = _TAKEN * (min(lacked.values()) < 0)  # a factor is rather forgotten than one too many
            yield Edit.at(equation, "missing factor", node, plain or new, 0.2 * (size - 1) + taken)

    def _more_bases(self, equation: Equation) -> list[Node]:
        """Sines and cosines of angles that are given, or that it has, with which something is resolved along a direction; the mass of several."""
        within = [n.args[0] for n in calls_in(equation) if n.name in ("sin", "cos") and isinstance(n.args[0], Sym)]
        angles = [*within, *(n for n in self.vocabulary.angles if n in self.vocabulary.parameters)]
        calls = [Fn(name, (angle,)) for angle in dict.fromkeys(angles) for name in ("cos", "sin")]
        masses = [n for n, its in self.vocabulary.parameters.items() if its == MASS][:_MOST_MASSES]
        return [*calls, *(Add(some) for count in (2, 3) for some in combinations(masses, count))]

    def _bare_angles(self, equation: Equation) -> list[Sym]:
        """Angles that stand in an equation as lengths do, as that of a spiral."""
        within = {id(part) for call in calls_in(equation) if call.name in ("sin", "cos", "tan") for part in walk(call)}
        angles = self.vocabulary.angular & {*self.vocabulary.coordinates}
        return [n for n in walk(equation) if isinstance(n, Sym) and n in angles and id(n) not in within]

    def _parts(self, equation: Equation, required: RequiredTerm) -> Iterator[Edit]:
        """Two terms of a sum of more that lack the same factor."""
        terms = required.node.terms if isinstance(required.node, Add) and required.missing.ndim == 1 else ()
        for pair in combinations(terms, 2) if 2 < len(terms) <= _MOST_TERMS else ():
            both = Add(pair)
            rest = tuple(term for term in terms if term not in pair)
            gathered = exchange(equation, required.node, Add((*rest, both), span=required.node.span))
            factor = 1 + required.missing / sampled(both, self.values)
            if np.isfinite(factor).all() and self._constant(factor) is None:
                yield from self._other_powers(gathered, both, factor)

    # -- terms

    def _missing(self, equation: Equation, required: RequiredTerm) -> Iterator[Edit]:
        """A sum that lacks a term."""
        scalar = required.missing.ndim == 1
        ratio = required.missing / required.value if scalar and not isinstance(required.node, Add) else np.full(1, np.nan)
        is_number = np.ptp(ratio) < _NEARLY * np.abs(ratio).max()
        if scalar:
            found: Iterator[Node] = self.terms.monomials(equation).equal_to(required.missing)
        else:
            found = chain(self.terms.matching(equation, required.missing), self._of_components(equation, required.missing))
        for term in map(_linear, found) if self.small else found:
            if is_number and {*symbols_in(term)} <= {*symbols_in(equation)}:
                continue  # another number is a factor
            size = 0.02 * depth(term) + _FAR_FETCHED * self._far_fetched(term, equation)
            yield Edit("missing term", None, term, exchange(equation, required.node, more(required.node, term)), size)

    def _part_of_letter(self, equation: Equation, required: RequiredTerm) -> Iterator[Edit]:
        """A letter that is only a part of what should stand in its place: of a stretch or an amplitude, A for A + F/k; of what presses, P for
        P + m a."""
        its = dimension(required.node, self.vocabulary.dimensions)
        if its not in (LENGTH, NUMBER_ONLY, FORCE):
            return
        moving = (Sym(n.name, 2) for n in self.vocabulary.coordinates) if its == FORCE else ()
        known = {*self.vocabulary.parameters, *moving}
        for term in self.terms.monomials(equation).equal_to(required.missing):
            if symbols_in(term) and term.symbols <= known:
                new = Add((required.node, term), span=required.node.span)
                yield Edit.at(equation, "symbol", required.node, new, _PART + 0.02 * depth(term))

    def _of_components(self, equation: Equation, wanted: Array) -> Iterator[Node]:
        """Vectors along i and j whose components are one term each."""
        units = [Sym("i"), Sym("j")]
        if wanted.ndim == 2 and {*units} <= {*self.vocabulary.vectors} and np.isfinite(wanted).all():
            terms = self.terms.monomials(equation)
            along = [next(terms.equal_to(np.ascontiguousarray(wanted[:, k])), None) for k in range(2)]
            if None not in along:
                yield Add(tuple(Mul((term, unit)) for term, unit in zip(along, units, strict=True)))

    def _denominator(self, equation: Equation, required: RequiredTerm) -> Iterator[Edit]:
        """A side that should be divided by 1 and a term, as where what turns beside what moves is forgotten; where it is what is asked,
        the other side is multiplied by that."""
        if required.factor is None or not np.isfinite(required.factor).all() or not required.factor.all():
            return
        node, other = required.node, equation.right if required.node is equation.left else equation.left
        for term in self.terms.monomials(equation).equal_to(1 / required.factor - 1):
            if symbols_in(term) and not any(n.dots or n in self.vocabulary.others for n in symbols_in(term)):
                more = Add((Num(1.0, "1"), term))
                old, new = (other, Mul((more, other))) if is_asked(node) else (node, Quotient(node, more))
                answers = any(map(is_asked, (equation.left, equation.right)))
                size = 0.02 * depth(term) + _NO_ANSWER * (not answers)
                yield Edit("missing term", None, term, exchange(equation, old, new), size)

    def _far_fetched(self, term: Node, equation: Equation) -> bool:
        """Whether a term is twice an acceleration or force that the equation does not have: it stands for what has a wrong sign."""
        said = set(symbols_in(equation))
        new = [n for n in symbols_in(term) if n not in said and (n.dots == 2 or n in self.vocabulary.others)]
        first = unsigned(term.top if isinstance(term, Quotient) else term)
        its = self.terms.dimension_of(equation)
        return (its is None or its.mass != 0) and bool(new) and isinstance(first, Mul) and first.factors[0] == Num(2.0)


def _is_share(powers: Mapping[Node, int]) -> bool:
    """Whether powers make the share of one mass in several: m/(m + M)."""
    sums = [
        base for base, n in powers.items() if n == -1 and isinstance(base, Add) and all(isinstance(t, Sym) for t in base.terms)
    ]
    return len(powers) == 2 and any(powers.get(mass) == 1 for whole in sums for mass in whole.terms)


def _is_linear_for_angular(old: Node, new: Sym) -> bool:
    """Whether one rate or acceleration stands for another of quite another kind: I x'' for I θ''."""
    return isinstance(old, Sym) and old.dots == new.dots > 0


def _linear(term: Node) -> Node:
    """A term with angles for their sines, and 1 for their cosines."""
    for call in [n for n in walk(term) if isinstance(n, Fn) and n.name in ("sin", "tan", "cos") and isinstance(n.args[0], Sym)]:
        term = exchange(term, call, Num(1.0, "1") if call.name == "cos" else call.args[0])
    return without_ones(term)
