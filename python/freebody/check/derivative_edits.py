"""Slips made where something was differentiated by time: edits inside of d/dt(…), and factors that were taken for constants."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np

from freebody.symbolic.differentiate import rate
from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Add, Mul, Node, Num, Quotient, Sym, addends, exchange, is_zero, walk

from .beside import signed
from .coefficients import more, multiplied, tidied
from .conventions import conventions
from .edits import Edit, depth, edits, forgotten_factors
from .fitted_edits import FittedEdits
from .language.spelling import spell
from .language.statements import Equation, without_ones
from .powers import powers_of, written
from .relative_edits import seen_from_elsewhere
from .solve_for_term import required_terms
from .spans import proportional

if TYPE_CHECKING:
    from .case import Case

_DERIVATIVE = re.compile(r"\(?(?:d\s*/\s*d\s*t|\\[dt]?frac\s*\{\s*d\s*\}\s*\{\s*d\s*t\s*\})\)?\s*")
_SAME = 1e-8  # relative spread below which a number is one
_ZERO, _TWO = Num(0.0, "0"), Num(2.0, "2")
_TAKEN = 0.2  # by which what is differentiated is less likely to have a term too many: who wrote an energy of all forgot a power
_OF_PRODUCT = -0.15  # by which what a product's rule has is likelier than other terms that are lacking


class DerivativeEdits:
    """The edits inside of the derivatives of an equation; ``values`` are those of true states."""

    def __init__(self, case: Case, equation: Equation, values: Mapping[str, Array], fits: FittedEdits) -> None:
        self.equation, self.values, self.fits = equation, values, fits
        self._text, self._read, self._fits = case.program.text, case.meaning.symbols.read, case.meaning.fits
        self._constants = case.meaning.symbols.constants

    def likely(self) -> Iterator[Edit]:
        """What the rule for products gives, and other numbers before what is differentiated."""
        yield from self._of_products()
        yield from self._of_differentiated(self._numbers)

    def others(self) -> Iterator[Edit]:
        """All other edits of what is differentiated."""
        vocabulary = self.fits.vocabulary
        plain = lambda _, given: chain(
            *(of(given, vocabulary) for of in (edits, conventions, seen_from_elsewhere, forgotten_factors))
        )
        for made in (plain, self._missing):
            yield from self._of_differentiated(made)

    def _of_differentiated(self, made: Callable[[Node, Equation], Iterable[Edit]]) -> Iterator[Edit]:
        """Edits of what is differentiated; a factor that is taken from it makes it a constant, whose dimension does not fit."""
        for node, inside in self._differentiated:
            given = Equation(inside, _ZERO)
            fit = self._fits(given)
            for edit in made(node, given):
                if self._fits(edit.after) or not fit:
                    with suppress(StatementError):
                        yield self._outside(node, edit)

    def _of_products(self) -> Iterator[Edit]:
        """Terms of which a derivative is a factor, as that of a product of which only one factor was differentiated; and half of what is
        lacking then, as Lagrange's equation of an inertia that changes has it; also on both sides, as where a constraint was differentiated twice."""
        differentiated, whole = [node for node, _ in self._differentiated], []
        for side in (self.equation.left, self.equation.right):
            if any(part is node for part in walk(side) for node in differentiated):
                continue  # there all of it was
            parts = [signed(sign, term) for sign, term in addends(side, expand=True)]
            lost = list(chain(*map(self._of_other_factors, parts)))
            together = [Add(tuple(lost))] if len(lost) > 1 else []
            for term in (*lost, *together, *(Quotient(term, _TWO) for term in lost)):
                yield Edit("missing term", None, term, exchange(self.equation, side, more(side, term)), _OF_PRODUCT)
            whole += [(side, lost)] if lost else []
        if len(whole) > 1:
            after = Equation(*(more(side, *lost) for side, lost in whole))
            every = [Add(tuple(lost)) if len(lost) > 1 else lost[0] for _, lost in whole]
            yield Edit("missing term", None, Add(tuple(every)), after, _OF_PRODUCT, "` and `".join(map(spell, every)))

    def _of_other_factors(self, term: Node) -> Iterator[Node]:
        """What the derivative of a product has beside a term in which one factor of it is differentiated."""
        for symbol in {n: None for n in walk(term) if isinstance(n, Sym) and n.dots}:
            rest = without_ones(exchange(term, symbol, Num(1.0, "1")))
            with suppress(StatementError):
                if not is_zero(slope := rate(rest, self._constants)) and symbol not in rest.symbols:
                    lost = addends(Mul((slope, Sym(symbol.name, symbol.dots - 1))), expand=True)
                    yield from (written(sign * number, powers) for sign, each in lost for number, powers in [powers_of(each)])

    def is_within(self, edit: Edit) -> bool:
        """Whether an edit is of a part that came from differentiating, or an acceleration beside what is differentiated."""
        own = edit.old if edit.shown is None else None
        if edit.kind == "missing term" and edit.shown is None and edit.new is not None and self._differentiated:
            return any(n.dots == 2 for n in edit.new.symbols)
        return any(part is own for node, _ in self._differentiated for part in walk(node))

    @cached_property
    def _differentiated(self) -> list[tuple[Node, Node]]:
        """What stands differentiated in the equation, and what it is the derivative of."""
        return list(self._derivatives())

    def _derivatives(self) -> Iterator[tuple[Node, Node]]:
        for node in walk(self.equation):
            begin, end = node.span
            found = _DERIVATIVE.match(self._text, begin, end)
            if found and node is not self.equation and found.end() < end:
                with suppress(StatementError):
                    inside = self._read(f"{self._text[found.end() : end]} = 0").equations[0].left
                    if rate(inside, self._constants) == node:
                        yield node, inside

    def as_written(self, equation: Equation) -> Equation:
        """An edited equation with the derivatives that were not touched as derivatives."""
        for node, inside in self._differentiated:
            equation = exchange(equation, node, _derivative(inside))
        return equation

    def _outside(self, node: Node, edit: Edit) -> Edit:
        """An edit of what is differentiated as one of the equation."""
        inside = edit.after.left
        after = exchange(self.equation, node, rate(inside, self._constants))
        shown = exchange(self.equation, node, _derivative(inside))
        extra = edit.extra + _TAKEN * (edit.kind == "extra term")
        return Edit(edit.kind, edit.old, edit.new, after, extra, edit.words, shown)

    def _lost(self, node: Node) -> Array | None:
        """What a derivative lacks; None where that is not known."""
        required = next((found for found in required_terms(self.equation, self.values) if found.node is node), None)
        known = required is not None and required.missing.ndim == 1 and np.isfinite(required.missing).all()
        return required.missing if known else None  # type: ignore[union-attr]

    def _numbers(self, node: Node, given: Equation) -> Iterator[Edit]:
        """Another number before a term."""
        if (lost := self._lost(node)) is None:
            return
        for term in _terms(given):
            with np.errstate(all="ignore"):
                number = 1 + lost / self._rates([term])[0]
            same = np.isfinite(number).all() and np.ptp(number) <= _SAME * np.abs(number).max()
            if same and (new := multiplied(term, float(np.median(number)))) is not None:
                yield Edit.at(given, "factor", term, new)

    def _missing(self, node: Node, given: Equation) -> Iterator[Edit]:
        """A term that is lacking."""
        if (lost := self._lost(node)) is None:
            return
        nodes, _ = self.fits.terms.dictionary(given, highest=1)
        rows = self._rates(nodes)
        for place in proportional(rows, lost):
            number = float(np.sum(lost * rows[place]) / np.sum(rows[place] ** 2))
            if (term := multiplied(nodes[place], number)) is not None:
                yield Edit("missing term", None, term, Equation(Add((*_terms(given), term)), _ZERO), 0.02 * depth(term))

    def _rates(self, nodes: list[Node]) -> Array:
        """The derivatives of terms; NaN where one has none."""
        rows = np.full((len(nodes), len(next(iter(self.values.values())))), np.nan)
        for row, node in self.fits.within(zip(rows, nodes, strict=True)):
            with suppress(StatementError, KeyError, ValueError):
                row[:] = sampled(rate(node, self._constants), self.values)
        return rows


def _derivative(inside: Node) -> Sym:
    return Sym(f"d/dt({spell(tidied(inside))})")


def _terms(given: Equation) -> tuple[Node, ...]:
    return given.left.terms if isinstance(given.left, Add) else (given.left,)
