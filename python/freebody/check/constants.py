"""What would make true that something is constant: the smallest edits after which it is one along each motion."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np

from freebody.symbolic.differentiate import rate
from freebody.symbolic.dimensions import LENGTH, SPEED
from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Add, Fn, Mul, Negative, Node, Num, Pow, Quotient, Sym, is_zero, unsigned, walk

from .coefficients import more, multiplied, product, tidied
from .conventions import conventions
from .edits import Edit, depth, edits, exchanged, forgotten_factors
from .energy_terms import lacking_energies
from .fitted_edits import FittedEdits
from .language.dimensions import dimension
from .language.spelling import spell
from .language.statements import Equation, symbols_in
from .likelihood import Likelihood
from .monomials import Monomials
from .powers import power_of, powers_of, written
from .residual import magnitude
from .search import EQUAL, MOST
from .slips import why
from .solve_for_term import RequiredTerm, parts_inside
from .square_edits import SquareEdits
from .stated import Correction, stated
from .throughout import throughout

if TYPE_CHECKING:
    from .case import Case

_STEADY = 1e-7  # change along a motion, relative to the terms: what the integrator leaves
_NEAREST = 40  # single edits beside which a second is looked for
_BLUR = 30.0  # of what a motion leaves of a number, beside round-off
_BELOW = 0.1  # for a missing term with symbols below its line
_SQUARE = LENGTH.times(LENGTH, 1)
_OF_POWER = 1.5  # how large a correction is that says what changes a quantity
_TWO = Num(2.0, "2")
_ZERO = Num(0.0, "0")


def constant_corrections(case: Case, node: Node, runs: Sequence[Mapping[str, Array]]) -> tuple[Correction, ...]:
    """The corrections of what was said to be constant, from the values of its symbols at moments of several motions."""
    moments = [len(next(iter(run.values()))) for run in runs]
    runs, moments = zip(*((run, n) for run, n in zip(runs, moments, strict=True) if n > 1), strict=True)
    values = {key: np.concatenate([run[key] for run in runs]) for key in runs[0]}
    if sampled(node, values).ndim > 1:
        return ()  # of a vector no single number says by what factor a term is wrong
    search = _Search(case, node, values, moments)
    every = [*search.found()] or [*search.energies()] or [*search.pairs()]
    found = sorted(((search.size(chosen), chosen) for chosen in every), key=lambda pair: (pair[0], depth(pair[1][-1].after)))
    made: dict[object, tuple[float, tuple[Edit, ...]]] = {}
    for size, chosen in found:
        if np.isfinite(size) and size <= found[0][0] + EQUAL:
            made.setdefault(search.mark(chosen[-1].after.left), (size, chosen))
    constant = tuple(
        Correction(tuple(map(stated, chosen)), f"{spell(tidied(chosen[-1].after.left))} = const", size, why=search.why(chosen))
        for size, chosen in [*made.values()][:MOST]
    )
    return constant or tuple(search.powers())[:1]


class _Search:
    """The edits of an expression, whose symbols have ``values`` on so many ``moments`` of each motion."""

    def __init__(self, case: Case, node: Node, values: Mapping[str, Array], moments: Sequence[int]) -> None:
        self.case, self.node, self.values = case, node, values
        self._begins = np.repeat(np.cumsum([0, *moments[:-1]]), moments)
        self.equation, self.vocabulary, self.within = Equation(node, _ZERO), case.meaning.vocabulary, case.budget.within
        self.fits, self.admissible = case.meaning.fits, case.admissible
        self._likelihood = Likelihood(self.equation, self.vocabulary, values, case.elsewhere(values))
        self._fitting = FittedEdits(values, self.vocabulary, self.within, _BLUR)

    def found(self) -> Iterator[tuple[Edit, ...]]:
        """The edits after which it is constant."""
        with np.errstate(all="ignore"):
            for edit in self.within(chain(self._plain(), self._rates(), self._squares(), self._fitted(self.node))):
                if self.fits(edit.after) and self._is_steady(edit.after.left):
                    yield (edit,)

    def pairs(self) -> Iterator[tuple[Edit, ...]]:
        """Pairs of an edit that brings it near, and of what is then another number or lacking."""
        with np.errstate(all="ignore"):
            # Another rate makes what is not kept something else that is.
            firsts = (edit for edit in self._plain() if edit.kind != "derivative" and self.fits(edit.after))
            left = ((self._left(edit.after.left), edit) for edit in self.within(firsts))
            near = sorted(((size, edit) for size, edit in left if size), key=lambda pair: pair[0])[:_NEAREST]
            for _, first in self.within(near):
                for second in chain(self._factors(first.after.left), self._missing(first.after.left)):
                    if self.fits(second.after) and self._is_steady(second.after.left):
                        yield first, second

    def energies(self) -> Iterator[tuple[Edit, ...]]:
        """All terms of the energy that it lacks."""
        along = np.arange(len(self._begins)) != self._begins
        lost = lacking_energies(self.case, self.node, lambda term: self._changes(sampled(term, self.values))[along])
        after = Equation(Add((*_terms(self.node), *lost)), _ZERO)
        if lost and self.fits(after) and self._is_steady(after.left):
            yield (Edit("missing term", None, Add(lost), after, 0.3 * len(lost)),)

    def powers(self) -> Iterator[Correction]:
        """What changes it: its derivative is one term, a power or a moment."""
        try:
            changes = rate(self.node, self.case.meaning.symbols.constants)
            lost = sampled(changes, self.values)
        except (StatementError, KeyError, ValueError):
            return
        of_rates = Equation(changes, _ZERO)
        for term in self._fitting.terms.monomials(of_rates).equal_to(lost):
            if (
                self.fits(Equation(changes, term))
                and self._likelihood.lack(Edit("missing term", None, term, of_rates)) < _OF_POWER
            ):
                what = ("missing term", "", spell(term))
                words = "it is not kept: this is the power or the moment that changes it"
                yield Correction((what,), f"d/dt({spell(self.node)}) = {spell(term)}", _OF_POWER, why=words)

    def _plain(self) -> Iterator[Edit]:
        return chain(*(of(self.equation, self.vocabulary) for of in (edits, conventions, forgotten_factors)))

    def _fitted(self, node: Node) -> Iterator[Edit]:
        left = lambda equation: self._changes(sampled(equation.left, self.values))
        each_time = throughout(Equation(node, _ZERO), self.vocabulary, self._sizes, left, self._of_motions)
        return chain(self._factors(node), self._coefficients(node), self._missing(node), each_time)

    def _left(self, node: Node) -> float:
        """By how much it changes beside its terms."""
        try:
            found = np.abs(self._changes(sampled(node, self.values))) / magnitude(node, self.values)
        except (KeyError, ValueError):
            return 0.0
        return float(np.mean(found)) if found.ndim == 1 and np.isfinite(found).all() else 0.0

    def size(self, edits: tuple[Edit, ...]) -> float:
        """How large edits are, larger where they are none that people make."""
        return sum(edit.size + self._likelihood.lack(edit) for edit in edits)

    def mark(self, node: Node) -> object:
        """What an expression is but for its size, whatever letters it is written in."""
        value = sampled(node, self.admissible) if self.admissible else np.full(1, np.nan)
        return (
            tuple(np.round(value / np.abs(value).max() * np.sign(value[0]), 7))
            if np.isfinite(value).all() and value.any()
            else node
        )

    def why(self, edits: tuple[Edit, ...]) -> str:
        """What is wrong with what stood there, a sentence for each edit."""
        return "; ".join(dict.fromkeys(filter(None, (why(edit, self.equation, self.vocabulary) for edit in edits))))

    def _changes(self, value: Array) -> Array:
        """By how much something differs from what it was at the beginning of each motion; the last axis is that of the states."""
        return value - value[..., self._begins]

    def _of_motions(self, whole: Array, part: Array) -> Array:
        """How many times the change of a part the whole changes by, of one motion each and so on all its states; NaN where that is no number."""
        above, below = (np.zeros((*each.shape[:-1], len(self._begins))) for each in (part, part))
        for place in np.unique(self._begins):
            own = self._begins == place
            above[..., own] = np.sum(whole[own] * part[..., own], axis=-1)[..., None]
            below[..., own] = np.sum(part[..., own] ** 2, axis=-1)[..., None]
        with np.errstate(all="ignore"):
            found = above / below
        off = np.abs(whole - found * part).max(axis=-1)
        return np.where((off <= _STEADY * np.abs(whole).max())[..., None], found, np.nan)

    def _is_steady(self, node: Node) -> bool:
        """Whether it is constant along each motion, and no part of it is by itself."""
        try:
            value, size = sampled(node, self.values), magnitude(node, self.values)
        except (KeyError, ValueError):
            return False
        parts = [part for part in (node.terms if isinstance(node, Add) else (node,)) if not is_zero(part)]
        if value.ndim != 1 or not np.isfinite(value).all() or np.abs(value).max() < _STEADY * size.max():
            return False
        if len(parts) < 2:
            return self._moving_factors(node) > 1 and np.abs(self._changes(value)).max() < _STEADY * size.max()
        moves = all(np.abs(self._changes(sampled(part, self.values))).max() > _STEADY * size.max() for part in parts)
        return moves and np.abs(self._changes(value)).max() < _STEADY * size.max()

    def _moving_factors(self, node: Node) -> int:
        """How many factors of a product change along the motions."""
        factors = node.factors if isinstance(node, Mul) else ()
        values = [sampled(factor, self.values) for factor in factors]
        return sum(bool(np.abs(self._changes(value)).max() > _STEADY * np.abs(value).max()) for value in values)

    def _factors(self, node: Node) -> Iterator[Edit]:
        """A term with another number."""
        equation, whole = Equation(node, _ZERO), self._changes(sampled(node, self.values))
        for term in _terms(node):
            own = self._changes(sampled(term, self.values))
            number = 1 - np.sum(whole * own) / np.sum(own**2)
            if np.isfinite(number) and (new := multiplied(term, float(number))) is not None and new != term:
                sign = (isinstance(new, Negative) and new.of == term) or (isinstance(term, Negative) and term.of == new)
                yield Edit.at(equation, "sign" if sign else "factor", term, new)

    def _coefficients(self, node: Node) -> Iterator[Edit]:
        """Parts that do not change along a motion, and should be others: what stands before what changes."""
        yield from self._fitting.of_parts(Equation(node, _ZERO), self._required(node))

    def _required(self, node: Node) -> Iterator[RequiredTerm]:
        whole = self._changes(sampled(node, self.values))
        for term, before in _addends(node, Num(1.0, "1")):
            value, times = (sampled(each, self.values) for each in (term, before))
            if whole.ndim == value.ndim == times.ndim == 1 and not is_zero(term):
                factor = 1 - self._of_motions(whole, self._changes(times * value))
                if np.isfinite(factor).all():
                    yield from parts_inside(RequiredTerm(term, value, value * factor, True), self.values)

    def _missing(self, node: Node) -> Iterator[Edit]:
        """A sum that lacks a term: what changes along a motion as it does, times what does not."""
        whole = self._changes(sampled(node, self.values))
        shapes, rows = self._lacked
        if whole.ndim != 1 or not len(rows):  # a vector lacks no number
            return
        numbers = -self._of_motions(whole, rows)
        for place in np.flatnonzero(np.isfinite(numbers).all(axis=1)).tolist():
            for before in self._sizes.equal_to(numbers[place]):
                number, powers = powers_of(product([before, *shapes[place]]))
                term = written(number, dict(sorted(powers.items(), key=lambda item: self._order(item[0]))))
                size = 0.02 * depth(term) + _BELOW * any(power < 0 for power in powers.values())
                if self.fits(Equation(more(node, term), _ZERO)):
                    yield Edit("missing term", None, term, Equation(Add((*_terms(node), term)), _ZERO), size)

    def _order(self, factor: Node) -> tuple[bool, bool]:
        """Where a factor stands in a term: masses first, what changes last."""
        its = dimension(factor, self.vocabulary.dimensions)
        return factor not in self.vocabulary.parameters, its is None or not its.mass

    @cached_property
    def _sizes(self) -> Monomials:
        """What may stand before what changes."""
        sizes = [n for n in self.vocabulary.parameters if n not in self.vocabulary.angular]
        said = {*symbols_in(self.equation)}
        sums = [n for n in walk(self.node) if isinstance(n, Add) and {unsigned(t) for t in n.terms} <= {*sizes}]
        rooted = lambda n: not self.vocabulary.is_rate(n)  # a rate first: it is a root of others, which are powers of it
        ordered = sorted(sizes, key=lambda n: (n not in said, n in self.vocabulary.letters, rooted(n)))
        return Monomials(self.values, dict.fromkeys((*(n for n in ordered if n in said), *sums, *ordered)), [()], _BLUR)

    @cached_property
    def _lacked(self) -> tuple[list[tuple[Node, ...]], Array]:
        """What changes in terms that may be lacking, and its changes along each motion; a force is none of what is constant."""
        known = self.vocabulary
        its = next((d for term in _terms(self.node) if (d := dimension(term, known.dimensions)) is not None), None)
        places = [n for n in known.coordinates if n not in known.angular]
        powers: list[tuple[Node, ...]] = [(), *((power_of(n, k),) for n in places for k in (1, 2))]
        angles = [n.args[0] for n in walk(self.node) if isinstance(n, Fn) and n.name in ("sin", "cos")]
        moves = known.shapes(its, (), tuple(dict.fromkeys(a for a in angles if not isinstance(a, Sym))))
        loads = lambda n: n.dots == 2 or (n in known.others and ((its := known.dimension(n)) is None or its.time == -2))
        shapes = [(*power, *shape) for shape in moves if not any(map(loads, chain(*map(symbols_in, shape)))) for power in powers]
        count = len(self._begins)
        values = {}
        for factor in dict.fromkeys(chain(*shapes)):
            found = sampled(factor, self.values)
            values[factor] = found if found.ndim == 1 else np.full(count, np.nan)
        rows = np.array([np.prod([np.ones(count), *(values[f] for f in shape)], axis=0) for shape in shapes])
        changes = self._changes(rows)
        good = np.isfinite(changes).all(axis=1) & (np.abs(changes).max(axis=1) > _STEADY * np.abs(rows).max(axis=1))
        return [shape for shape, ok in zip(shapes, good, strict=True) if ok], changes[good]

    def _rates(self) -> Iterator[Edit]:
        """Another rate for one, or a coordinate."""
        known = [Sym(n.name, dots) for n in self.vocabulary.coordinates for dots in range(2)] + list(self.vocabulary.others)
        for node in walk(self.node):
            its = dimension(node, self.vocabulary.dimensions) if isinstance(node, Sym) else None
            if its is not None and its.mass == 0 and its.time == -1:
                others = (Sym(n.name, n.dots, span=node.span) for n in known if n != node)
                yield from (Edit.at(self.equation, "symbol", node, other) for other in others)

    def _squares(self) -> Iterator[Edit]:
        """Two squares of other components of a speed; the square of a length, an angle or a speed that lacks a part; that of a distance for that of a stretch."""
        known, lost = self.vocabulary, -self._changes(sampled(self.node, self.values))
        addends = [*_addends(self.node, Num(1.0, "1"))]
        yield from SquareEdits(self.values, known).of_components(self.equation, addends, lost, self._changes)
        every = [*known.parameters, *(Sym(n.name, dots) for n in known.coordinates for dots in (0, 1)), *known.others]
        turning = [n for n in every if n.dots == 1 and (its := known.dimension(n)) is not None and its.length == 0]
        speeds: list[Node] = [Mul((n, turn)) for turn in turning for n in every if known.dimension(n) == LENGTH]
        for node in walk(self.node):
            base = node.base if isinstance(node, Pow) and node.exponent == _TWO else None
            its = dimension(base if base is not None else node, known.dimensions)
            if base is not None and its is not None and its.mass == 0:
                parts: list[Node] = [
                    n for n in every if known.dimension(n) == its and n != base and (n.dots or n not in known.others)
                ]
                for part in (*parts, *(speeds if its == SPEED else ())):
                    for more_of_it in (part, Negative(part)):
                        new = Pow(more(base, more_of_it), node.exponent, span=node.span)
                        yield Edit.at(self.equation, "symbol", node, new, 0.1)
            elif isinstance(node, Add) and its == _SQUARE:
                for length in (n for n in known.parameters if known.dimension(n) == LENGTH):
                    stretch = Add((Fn("sqrt", (node,)), Negative(length)))
                    yield Edit.at(self.equation, "symbol", node, Pow(stretch, _TWO, span=node.span), 0.1)
        yield from self._stretches()

    def _stretches(self) -> Iterator[Edit]:
        """Every square of a length that changes that of what it is more than a length at rest, as of two springs."""
        known = self.vocabulary
        moving = lambda n: isinstance(n, Sym) and n not in known.parameters and not n.dots and known.dimension(n) == LENGTH
        found = [n for n in walk(self.node) if isinstance(n, Pow) and n.exponent == _TWO and moving(n.base)]
        for rest in [n for n in known.parameters if known.dimension(n) == LENGTH] if len({*found}) > 1 else []:
            changes = {n: Pow(Add((n.base, Negative(rest))), _TWO) for n in found}
            words = f"each length of a spring should be its stretch, less `{spell(rest)}`"
            yield Edit("convention", None, None, exchanged(self.equation, changes), words=words)


def _addends(node: Node, before: Node) -> Iterator[tuple[Node, Node]]:
    """What is added to something, wherever it stands, and what it is multiplied by."""
    match node:
        case Add(terms=terms):
            for term in terms:
                yield term, before
                yield from _addends(term, before)
        case Negative(of=of):
            yield from _addends(of, Negative(before))
        case Mul(factors=factors):
            for i, factor in enumerate(factors):
                yield from _addends(factor, product([before, *factors[:i], *factors[i + 1 :]]))
        case Quotient(top=top, bottom=bottom):
            yield from _addends(top, Quotient(before, bottom))


def _terms(node: Node) -> tuple[Node, ...]:
    return node.terms if isinstance(node, Add) else (node,)
