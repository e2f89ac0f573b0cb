"""The edits of one equation beside one family of motions: which of them make it true, and which of these a person would."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property, partial
from heapq import heappop, heappush
from itertools import chain, combinations
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from freebody.symbolic.dimensions import PER_SECOND
from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Add, Node, Num, Sym, exchange, is_zero, substitute, unsigned, walk

from .assumptions import first_order
from .coefficients import tidied
from .component_edits import component_edits, exchanges
from .conventions import conventions
from .derivative_edits import DerivativeEdits
from .edits import Edit, depth, edits, forgotten_factors, other_figures, with_unit_vectors
from .energy_terms import energy_edits
from .families import NoMotion
from .fitted_edits import FittedEdits
from .language.spelling import spell
from .language.statements import Equation, symbols_in, terms
from .likelihood import PARTNER, Likelihood
from .marks import Marks
from .momentum_edits import momentum_edits
from .relative_edits import seen_from_elsewhere
from .residual import HOLDS, OFTEN, REACH, Edited, Residual, magnitude, residual, unreached
from .several_terms import as_one, two_missing
from .slips import why
from .stated import Correction, stated
from .subject import Subject

if TYPE_CHECKING:
    from .case import Case
    from .families import Family

EQUAL = 0.35
"""Edits whose sizes differ by less are equally small."""
_VAIN = 0.3  # more, for a correction by what is always 0
_WITHIN = 0.5  # more, for one of what has been differentiated
_FEW = 5  # states on which an edit is tried first
_PROMISING = 1e-7  # worst residual there of one that is tried on all
_BEST = 40  # single edits of which pairs are tried
_PLAIN = ("sign", "function")  # edits of which all pairs are tried
_MOST_PLAIN = 24
_BEST_FIGURES = 12
MOST = 3  # corrections that are given
_FOR_EQUALS = 0.2  # of what is left when a likely edit is found
_CONFIRMING = 0.1  # of it, for what was found by then
_OF_BALANCE = 0.5  # more, where motions alone were spoken of, for what only a balance makes true
_CALLED_ENERGY = 0.5  # more, for momenta in the place of what is called an energy
_FRESH, _FRESH_STATES = 1, 16
_WORTH = 10  # characters that an edit of size 1 may save
LIKELIEST = 1.0  # size of a single edit; none is smaller
_LINEAR = 2e-6  # what is left of a true linear equation where all is small, for terms of higher order and round-off
_LITTLE = 0.01  # of the least term: what is left there of one that is no slip
_LIMIT = 1e-5  # what is left of a true equation where a parameter is as large as it can be
_OF_RUN = 1e-9  # what is left of a true equation at a moment to which a motion was followed
_BLUR = 1e3  # of what is lacking there, beside round-off
_SAME = 1e-9  # rad: below it two angles are one
_BLUR_OF_RUN = 1e2  # the same where a motion was followed from its start
_ROUND_OFF = 1e-12  # of the terms of a part, below which it is 0
_KINEMATIC = 1e-8  # what is left of an equation that holds though no balance does
_SWAPPED = ("missing factor", "symbol", "other term")
_IN_OTHER_LETTERS = ("missing term", "missing factor", "symbol", "rates", "resultant")
"""What may stand in the place of the same part of an equation of motions alone in many letters."""
_REPLACED = (("extra term", "missing term"), ("missing factor", "missing factor"), ("derivative", "missing factor"))
"""Pairs that take something away and put another in its place: no correction."""
T = TypeVar("T")


@dataclass(frozen=True)
class Found:
    edits: tuple[Edit, ...]

    @property
    def after(self) -> Equation:
        return self.edits[-1].after

    @property
    def size(self) -> float:
        return sum(edit.size for edit in self.edits)

    def correction(self, given: str, why: str, as_written: Callable[[Equation], Equation]) -> Correction:
        edits = self.edits
        where = tuple(e.old.span for e in edits if e.old is not None and e.old.span != (0, 0))
        shown = edits[0].shown if len(edits) == 1 and edits[0].shown else as_written(self.after)
        return Correction(tuple(map(stated, edits)), spell(tidied(shown)), self.size, where, given, why)


class Search:
    """The edits of one equation beside one family of motions."""

    def __init__(self, case: Case, equation: Equation, family: Family, part: float) -> None:
        self.equation, self.family, self.vocabulary = equation, family, case.meaning.vocabulary
        self.values = _where_known(equation, case.values(family))
        self.few = {key: value[:_FEW] for key, value in self.values.items()}
        self._edited = Edited(equation, self.few)
        self.fit = case.meaning.fits
        self.said = {n.key for n in symbols_in(equation)}
        self.given, self.case, self.subject = case.meaning.given(), case, Subject(case, equation)
        self.other, self.free = case.elsewhere(self.few), case.elsewhere(self.few, bound=False)
        self._part = part
        self._marks = Marks(
            equation, self.vocabulary.parameters, self.given, (self.other, self.free), family.at_start, self._residual
        )
        self.lasts = partial(case.budget.lasts, part=part + _CONFIRMING)
        near = bool(family.small or family.scaled)
        blur, followed = _BLUR if near else _BLUR_OF_RUN if family.since else 1.0, bool(family.since) and not near
        self.fits = FittedEdits(self.values, self.vocabulary, self.within, blur, bool(family.small), followed)
        self.differentiated = DerivativeEdits(case, equation, self.values, self.fits)
        self.holds, self._near = (
            (_LIMIT, _LIMIT)
            if family.scaled or family.late
            else (min(_LINEAR, _LITTLE * self._least_share),) * 2
            if family.small
            else (_OF_RUN if case.sampler.moment else HOLDS, _PROMISING)
        )
        self.right = self._worst(equation, self.values) < self.holds

    @cached_property
    def _least_share(self) -> float:
        """What the least term is of all of them: where one is small, what is left has to be little beside that one."""
        with np.errstate(all="ignore"):
            sizes = [np.abs(sampled(term, self.values)) for term in terms(self.equation, expand=True)]
            shares = [np.median(size / sum(sizes)) for size in sizes if size.ndim == 1 and size.any()]
        return float(min(filter(np.isfinite, shares), default=1.0))

    def singles(self) -> Iterator[Found]:
        """Every single edit that may make it true."""
        readable = self._residual(self.equation, self.few)
        units = tuple(n for n in self.vocabulary.vectors if n in map(Sym, "ijk"))
        found = chain(  # the likely ones first: there may be no time for all
            () if readable else with_unit_vectors(self.equation, units),
            edits(self.equation, self.vocabulary),
            self.differentiated.likely(),
            self._fitted(self.equation) if readable else (),
            conventions(self.equation, self.vocabulary),
            seen_from_elsewhere(self.equation, self.vocabulary),
            exchanges(self.equation, self.vocabulary),
            self.differentiated.others(),
            self._momenta() if readable else (),
            () if readable else forgotten_factors(self.equation, self.vocabulary),
        )
        for edit in self._promising(found):
            if edit.size <= LIKELIEST:  # only its equals are looked for
                self._part = min(self._part, self.case.budget.with_rest(_FOR_EQUALS))
            yield Found((edit,))

    def _momenta(self) -> Iterator[Edit]:
        """Momenta that are kept in the place of energies; less likely where it was called an energy."""
        extra = _CALLED_ENERGY * self.case.meaning.symbols.of_energy
        found = momentum_edits(self.equation, self.vocabulary, self.few)
        yield from (replace(edit, extra=edit.extra + extra) for edit in found)

    def within(self, found: Iterable[T]) -> Iterator[T]:
        """What there is, as long as there is time for this search."""
        every = iter(found)
        while self.case.budget.lasts(self._part) and (each := next(every, None)) is not None:
            yield each

    def other_terms(self) -> Iterator[Found]:
        """Every term that should be quite another."""
        if self._residual(self.equation, self.few):
            yield from (Found((edit,)) for edit in self._promising(self.fits.other_terms(self.equation)))

    def together(self) -> Iterator[Found]:
        """All terms that it lacks of an energy, or all inertias that turn as one; the components of two forces; two terms."""
        found = list(self._promising(energy_edits(self.case, self.equation, self.family)))
        components = component_edits(self.equation, self.few, self.vocabulary)
        others = self._promising(chain(() if found else as_one(self.equation, self.fits.terms), components))
        yield from (Found((edit,)) for edit in chain(found, others))
        if not found:
            yield from (Found((edit,)) for edit in self._promising(two_missing(self.equation, self.fits.terms)))

    def pairs(self) -> Iterator[Found]:
        """Pairs of the edits that bring it nearest, and of one of them and what is then lacking."""
        every = list(self.within(chain(*(of(self.equation, self.vocabulary) for of in (edits, forgotten_factors)))))
        yield from self._both([edit for edit in every if edit.kind in _PLAIN][:_MOST_PLAIN])
        near = self._nearest(every, _BEST)
        yield from self._both(near)
        for first in self.within((*near, *self._nearest(other_figures(self.equation), _BEST_FIGURES))):
            found = self._promising(self._fitted(first.after))
            found = (edit for edit in found if edit.kind != "resultant" and (first.kind, edit.kind) not in _REPLACED)
            yield from (Found((first, edit)) for edit in found)

    def _both(self, found: Sequence[Edit]) -> Iterator[Found]:
        """Two edits of other places."""
        for first, second in combinations(found, 2):
            replaced = (first.kind, second.kind) in _REPLACED
            if second.old is not None and (second.new is not None or second.kind == "extra term") and not replaced:
                both = exchange(first.after, second.old, second.new or Num(0.0, "0"))
                made = [replace(second, after=both)] if both is not first.after else []
                yield from (Found((first, edit)) for edit in self._promising(made))

    def _nearest(self, found: Iterable[Edit], count: int) -> list[Edit]:
        """The edits after which the least is left."""
        tried = ((edit, self._residual(edit.after, self.few)) for edit in self.within(found))
        left = [(np.mean(each.ratio**2) if each else 0.0, edit) for edit, each in tried]
        return [edit for _, edit in sorted(left, key=lambda pair: pair[0] if pair[0] > 0 else np.inf)[:count]]

    def _fitted(self, equation: Equation) -> Iterator[Edit]:
        with suppress(StatementError):
            yield from self.fits.edits(equation)

    def best(self, found: Iterable[Found]) -> list[Found]:
        """Those confirmed on all and on fresh states, one of each meaning, the smallest and their equals."""
        kept: dict[tuple[float, ...], list[Found]] = {}
        alike: dict[object, tuple[float, ...]] = {}
        least, found = 0.0, list(found)
        alone = len(found) == 1  # then nothing else may say the same
        for tried, (size, each) in enumerate(self._ranked(found)):
            if tried >= MOST and not self.lasts():
                break
            if (kept and size > least + EQUAL) or np.isinf(size):
                break
            mark = self._marks.of(each.after)
            idle = any(self._is_idle(edit, len(each.edits) > 1) for edit in each.edits)
            # T (R̈ − R θ̇²) = 0 holds whatever the symbols are that it has from the equation given: it says nothing of T
            own = self.said & {n.key for n in symbols_in(each.after)}
            free = (own, own & {n.key for n in self.subject.answers})  # nor of what it is solved for
            vacuous = any(
                keys and self._worst(each.after, self.few | {key: self.free[key] for key in keys}) < HOLDS for keys in free
            )
            if mark is None or idle or vacuous or self.subject.is_changed(each.edits, each.after) or not self.fit(each.after):
                continue
            place = self._place(each)
            said = self._in_few_letters(each.after) or self._beside_balances(each.after) or place or mark
            mark = mark if alone else alike.setdefault(said, mark)
            if place and mark in kept:
                continue  # in other letters
            if mark in kept or self._confirmed(each.after):
                least = size if not kept else least
                kept.setdefault(mark, []).append(each)
        chosen = [min(same, key=self._oddness) for same in kept.values()]
        if len(chosen) > 1 and self.case.is_kinematic(chosen[0].after):  # then no balance is asked for
            chosen = [each for each in chosen if self.case.is_kinematic(each.after)]
        if chosen and len(chosen[0].edits) == 1:
            chosen = [each for each in chosen if len(each.edits) == 1]
        return chosen[:MOST]

    def _ranked(self, found: Iterable[Found]) -> Iterator[tuple[float, Found]]:
        """By size, those of one size by how much there is of them, as long as there is time; the first few at any rate. How unlikely they are is
        only asked where it matters."""
        waiting: list[tuple[float, int, int, Found]] = []
        for i, each in enumerate(sorted(found, key=lambda each: each.size)):
            while waiting and waiting[0][0] < each.size - PARTNER:
                size, _, _, first = heappop(waiting)
                yield size, first
            heappush(waiting, (self.likely_size(each), depth(each.after), i, each))
        yield from ((size, each) for size, _, _, each in sorted(waiting))

    def _beside_balances(self, equation: Equation) -> tuple[float, ...]:
        """What is left of an equation where no balance holds; nothing where that is nothing."""
        found = self._residual(equation, self.case.admissible) if self.case.admissible else None
        if found is None or not np.isfinite(found.ratio).all() or found.worst < _KINEMATIC:
            return ()
        left = found.sides.residual.ravel()
        return tuple(np.round(left / left[np.argmax(np.abs(left))], 7).tolist())

    def _in_few_letters(self, equation: Equation) -> Equation | None:
        """An equation in one letter for all angles that are one on all states, as at a moment; None where there are no such."""
        return substitute(equation, self._same_angles) if self._same_angles else None

    @cached_property
    def _same_angles(self) -> dict[Sym, Sym]:
        """Angles, and at a moment rates of them, with that of the same value which is given, or else comes first."""
        known = self.vocabulary
        angles = [n for n in known.angles if isinstance(n, Sym) and n.key in self.values]
        if self.case.sampler.moment:
            rates = [*(n for n in known.letters if known.dimension(n) == PER_SECOND), *(Sym(n.name, 1) for n in known.angular)]
            angles += [n for n in rates if n.key in self.values and self.values[n.key].ndim == 1]
        angles.sort(key=lambda n: n not in {*known.parameters, *known.letters})
        first = {n: next((one for one in angles if self._are_one(one, n)), n) for n in angles}  # where it has no value, itself
        return {n: one for n, one in first.items() if one != n}

    def _are_one(self, one: Sym, other: Sym) -> bool:
        return bool(np.allclose(self.values[one.key], self.values[other.key], rtol=_SAME, atol=_SAME))

    def _place(self, found: Found) -> tuple[Any, ...]:
        """Which part of an equation of motions alone is another: what stands there is the same in all letters."""
        (first, *others) = found.edits
        if others or first.kind not in _IN_OTHER_LETTERS or not self.case.is_kinematic(found.after):
            return ()
        return (first.kind, id(first.old))

    def _oddness(self, found: Found) -> tuple[bool, int, int, float]:
        """Of corrections that say the same, how unlike a person's one is: changing what an equation is solved for, in symbols of which
        nothing was said, or places of the start that have letters of their own, long, and large."""
        length = len(spell(tidied(found.after))) + _WORTH * self.likely_size(found)
        strange = (*self.vocabulary.coordinates, *self.vocabulary.others)
        new = {n.name for n in symbols_in(found.after)} - {n.name for n in symbols_in(self.equation)}
        solved = any(edit.old in self.subject.answer_sides for edit in found.edits) or self.subject.is_no_answer(found.after)
        solved |= not self.subject.answers.union(self._likelihood.taken.differences) <= {
            *map(unsigned, (found.after.left, found.after.right))
        }
        moved = sum(n in self.vocabulary.coordinates for n in found.after.symbols - self.equation.symbols) * self.family.at_start
        return (
            solved or any(map(self.subject.is_elsewhere, found.edits)),
            moved + len(new & {n.name for n in strange}),
            len(new),
            length,
        )

    def why(self, found: Found) -> str:
        """What was wrong, a sentence for each edit."""
        return "; ".join(dict.fromkeys(filter(None, (why(edit, self.equation, self.vocabulary) for edit in found.edits))))

    def _leaves_nothing(self, found: Found) -> bool:
        """Whether it says of what is small, or of when something happens, that it is 0."""
        sides = found.after.left, found.after.right
        other = next((one for one, zero in (sides, sides[::-1]) if is_zero(zero)), None)
        return isinstance(other, Sym) and bool(self.family.small or other.name == "t") and found.edits[-1].kind == "extra term"

    def likely_size(self, found: Found) -> float:
        """How large a correction is; larger where it adds what is always 0 here, or is no slip that people make."""
        new = symbols_in(found.after)
        if self.subject.is_of_other_dimension(found.after) or any(
            n.key not in self.said and not np.any(self.few[n.key]) for n in new
        ):
            return np.inf
        if self._leaves_nothing(found):
            return np.inf
        odd = sum(map(self._likelihood.lack, found.edits))
        odd += _OF_BALANCE * (self.subject.is_constraint and not self.case.is_kinematic(found.after))
        odd += _WITHIN * any(map(self.differentiated.is_within, found.edits))
        return found.size + odd + _VAIN * any(edit.new is not None and not self._moves(edit.new) for edit in found.edits)

    def _is_idle(self, edit: Edit, beside_another: bool) -> bool:
        """Whether an edit puts 0 in the place of something, or adds it within a part."""
        if edit.new is None:
            return False
        sums = (part for part in walk(edit.new) if isinstance(part, Add))
        nothing = any(term not in self._parts and not self._moves(term) for whole in sums for term in whole.terms)
        return nothing or ((beside_another or edit.kind in _SWAPPED) and not self._moves(edit.new))

    @cached_property
    def _parts(self) -> set[Node]:
        return {*walk(self.equation)}

    def _moves(self, node: Node) -> bool:
        """Whether a part has a value other than 0."""
        return not vanishes(node, self.few)

    @cached_property
    def _likelihood(self) -> Likelihood:
        return Likelihood(self.equation, self.vocabulary, self.few, self.other, bool(self.family.vanishing))

    @cached_property
    def fresh(self) -> Mapping[str, Array]:
        """The symbols on other true states; on the same where no others are found."""
        with suppress(NoMotion):
            return _where_known(self.equation, self.case.values(self.family, _FRESH, _FRESH_STATES))
        return self.values

    def _confirmed(self, equation: Equation) -> bool:
        holds = all(self._worst(equation, values) < self.holds for values in (self.values, self.fresh))
        reach = REACH * (self._least_share if self.family.small else 1.0)
        # What is held at 0, or stays it, may hide what is wrong.
        held = self.family.held and unreached(equation, self.values, reach=reach)
        # Energies are all 0 to first order.
        if holds and self.family.small and not equation.symbols.isdisjoint(self.vocabulary.energies):
            with suppress(NoMotion):
                holds = first_order(self.case, equation, self.family)
        return holds and not held and not (self.family.since and not all(map(self._moves, terms(equation))))

    def _promising(self, found: Iterable[Edit]) -> Iterator[Edit]:
        return (edit for edit in self.within(found) if self._worst(edit.after, self.few) < self._near)

    def _worst(self, equation: Equation, values: Mapping[str, Array]) -> float:
        found = self._residual(equation, values)
        return float("inf") if found is None or np.isnan(found.worst) else found.worst

    def _residual(self, equation: Equation, values: Mapping[str, Array]) -> Residual | None:
        try:
            return self._edited.residual(equation) if values is self.few else residual(equation, values)
        except ValueError:
            return None


def vanishes(node: Node, values: Mapping[str, Array]) -> bool:
    """Whether a part is 0 on all states, but for round-off."""
    try:
        return not np.any(np.abs(sampled(node, values)) > _ROUND_OFF * magnitude(node, values))
    except (KeyError, ValueError):
        return False


def _where_known(equation: Equation, values: Mapping[str, Array]) -> Mapping[str, Array]:
    """The values where all symbols of an equation have one: not every position has a natural frequency."""
    found = [np.isfinite(values[n.key]) for n in symbols_in(equation) if n.key in values]
    known = np.all([each.reshape(len(each), -1).all(axis=1) for each in found], axis=0)
    return values if np.all(known) or np.sum(known) < OFTEN else {key: value[known] for key, value in values.items()}
