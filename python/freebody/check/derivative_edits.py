"""Slips made before something was differentiated by time: edits inside of d/dt(…)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import suppress
from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np

from freebody.symbolic.differentiate import rate
from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Add, Node, Num, Sym, exchange, walk

from .coefficients import multiplied
from .edits import Edit, conventions, depth, edits, forgotten_factors
from .fitted_edits import FittedEdits
from .language.spelling import spell
from .language.statements import Equation
from .solve_for_term import required_terms
from .spans import proportional

if TYPE_CHECKING:
    from .case import Case

_DERIVATIVE = re.compile(r"\(?(?:d\s*/\s*d\s*t|\\[dt]?frac\s*\{\s*d\s*\}\s*\{\s*d\s*t\s*\})\)?\s*")
_SAME = 1e-8  # relative spread below which a number is one
_ZERO = Num(0.0, "0")


class DerivativeEdits:
    """The edits inside of the derivatives of an equation; ``values`` are those of true states."""

    def __init__(self, case: Case, equation: Equation, values: Mapping[str, Array], fits: FittedEdits) -> None:
        self.equation, self.values, self.fits = equation, values, fits
        self._text, self._read, self._constants = (
            case.program.text,
            case.meaning.symbols.read,
            case.meaning.symbols.constants,
        )

    def __iter__(self) -> Iterator[Edit]:
        for node, inside in self._differentiated:
            given = Equation(inside, _ZERO)
            plain = chain(*(of(given, self.fits.vocabulary) for of in (edits, conventions, forgotten_factors)))
            for edit in chain(plain, self._fitted(node, given)):
                with suppress(StatementError):
                    yield self._outside(node, edit)

    def is_within(self, edit: Edit) -> bool:
        """Whether an edit is of a part that came from differentiating."""
        begin, end = edit.old.span if edit.old is not None and edit.shown is None else (0, 0)
        return any(node.span[0] <= begin < end <= node.span[1] for node, _ in self._differentiated)

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

    def _outside(self, node: Node, edit: Edit) -> Edit:
        """An edit of what is differentiated as one of the equation."""
        inside = edit.after.left
        after = exchange(self.equation, node, rate(inside, self._constants))
        shown = exchange(self.equation, node, Sym(f"d/dt({spell(inside)})"))
        return Edit(edit.kind, edit.old, edit.new, after, edit.extra, edit.words, shown)

    def _fitted(self, node: Node, given: Equation) -> Iterator[Edit]:
        """Another number before a term, and a term that is lacking."""
        required = next((found for found in required_terms(self.equation, self.values) if found.node is node), None)
        if required is None or required.missing.ndim != 1 or not np.isfinite(required.missing).all():
            return
        parts = given.left.terms if isinstance(given.left, Add) else (given.left,)
        for term in parts:
            with np.errstate(all="ignore"):
                number = 1 + required.missing / self._rates([term])[0]
            same = np.isfinite(number).all() and np.ptp(number) <= _SAME * np.abs(number).max()
            if same and (new := multiplied(term, float(np.median(number)))) is not None:
                yield Edit.at(given, "factor", term, new)
        nodes, _ = self.fits.dictionary(given, highest=1)
        rows = self._rates(nodes)
        for place in proportional(rows, required.missing):
            number = float(np.sum(required.missing * rows[place]) / np.sum(rows[place] ** 2))
            if (term := multiplied(nodes[place], number)) is not None:
                yield Edit("missing term", None, term, Equation(Add((*parts, term)), _ZERO), 0.02 * depth(term))

    def _rates(self, nodes: list[Node]) -> Array:
        """The derivatives of terms; NaN where one has none."""
        rows = np.full((len(nodes), len(next(iter(self.values.values())))), np.nan)
        for row, node in self.fits.within(zip(rows, nodes, strict=True)):
            with suppress(StatementError, KeyError, ValueError):
                row[:] = sampled(rate(node, self._constants), self.values)
        return rows
