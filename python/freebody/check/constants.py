"""What would make true that something is constant: the smallest edits after which it is one along each motion."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np

from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Add, Negative, Node, Num, Sym, is_zero, walk

from .coefficients import multiplied, tidied
from .correction import EQUAL, MOST, Correction, stated
from .edits import Edit, conventions, depth, edits
from .fitted_edits import FittedEdits, proportional
from .language.dimensions import dimension
from .language.spelling import spell
from .language.statements import Equation, symbols_in
from .residual import magnitude
from .slips import unlikely, why

if TYPE_CHECKING:
    from .case import Case

_STEADY = 1e-7  # change along a motion, relative to the terms: what the integrator leaves
_ZERO = Num(0.0, "0")


def constant_corrections(case: Case, node: Node, runs: Sequence[Mapping[str, Array]]) -> tuple[Correction, ...]:
    """The corrections of what was said to be constant, from the values of its symbols at moments of several motions."""
    values = {key: np.concatenate([run[key] for run in runs]) for key in runs[0]}
    search = _Search(case, node, values, len(next(iter(runs[0].values()))))
    found = sorted(((search.size(edit), edit) for edit in search.found()), key=lambda pair: (pair[0], depth(pair[1].after)))
    made: dict[object, tuple[float, Edit]] = {}
    for size, edit in found:
        if np.isfinite(size) and size <= found[0][0] + EQUAL:
            made.setdefault(search.mark(edit.after.left), (size, edit))
    return tuple(
        Correction((stated(edit),), f"{spell(tidied(edit.after.left))} = const", size, why=search.why(edit))
        for size, edit in [*made.values()][:MOST]
    )


class _Search:
    def __init__(self, case: Case, node: Node, values: Mapping[str, Array], moments: int) -> None:
        self.node, self.values, self.moments = node, values, moments
        self.equation, self.vocabulary, self.within = Equation(node, _ZERO), case.meaning.vocabulary, case.budget.within
        self.fits, self.elsewhere, self.admissible = case.meaning.fits, case.elsewhere(values), case.admissible

    def found(self) -> Iterator[Edit]:
        """The edits after which it is constant."""
        with np.errstate(all="ignore"):
            plain = chain(edits(self.equation, self.vocabulary), conventions(self.equation, self.vocabulary))
            for edit in self.within(chain(plain, self._rates(), self._factors(), self._missing())):
                if self.fits(edit.after) and self._is_steady(edit.after.left):
                    yield edit

    def size(self, edit: Edit) -> float:
        """How large an edit is, larger where it is none that people make."""
        return edit.size + unlikely(edit, self.equation, self.vocabulary, self.values, self.elsewhere)

    def mark(self, node: Node) -> object:
        """What an expression is but for its size, whatever letters it is written in."""
        value = sampled(node, self.admissible) if self.admissible else np.full(1, np.nan)
        return (
            tuple(np.round(value / np.abs(value).max() * np.sign(value[0]), 7))
            if np.isfinite(value).all() and value.any()
            else node
        )

    def why(self, edit: Edit) -> str:
        """What is wrong with what stood there."""
        return why(edit, self.equation, self.vocabulary)

    def _changes(self, value: Array) -> Array:
        """By how much something differs from what it was at the beginning of each motion."""
        blocks = value.reshape(-1, self.moments)
        return (blocks - blocks[:, :1]).ravel()

    def _is_steady(self, node: Node) -> bool:
        """Whether it is constant along each motion, and no part of it is by itself."""
        try:
            value, size = sampled(node, self.values), magnitude(node, self.values)
        except (KeyError, ValueError):
            return False
        parts = [part for part in (node.terms if isinstance(node, Add) else (node,)) if not is_zero(part)]
        if value.ndim != 1 or len(parts) < 2 or not np.isfinite(value).all() or np.abs(value).max() < _STEADY * size.max():
            return False
        moves = all(np.abs(self._changes(sampled(part, self.values))).max() > _STEADY * size.max() for part in parts)
        return moves and np.abs(self._changes(value)).max() < _STEADY * size.max()

    def _terms(self) -> tuple[Node, ...]:
        return self.node.terms if isinstance(self.node, Add) else (self.node,)

    def _factors(self) -> Iterator[Edit]:
        """A term with another number."""
        whole = self._changes(sampled(self.node, self.values))
        for term in self._terms():
            own = self._changes(sampled(term, self.values))
            number = 1 - np.sum(whole * own) / np.sum(own**2)
            if np.isfinite(number) and (new := multiplied(term, float(number))) is not None and new != term:
                sign = (isinstance(new, Negative) and new.of == term) or (isinstance(term, Negative) and term.of == new)
                yield Edit.at(self.equation, "sign" if sign else "factor", term, new)

    def _missing(self) -> Iterator[Edit]:
        """A sum that lacks a term."""
        whole = self._changes(sampled(self.node, self.values))
        nodes, rows = FittedEdits(self.values, self.vocabulary, self.within).dictionary(self.equation, highest=1)
        if not len(rows):
            return
        changes = np.array([self._changes(row) for row in rows]).reshape(len(rows), -1)
        if changes.shape[1] != whole.size:  # a vector lacks no number
            return
        forces = {n for n in self.vocabulary.others if (its := self.vocabulary.dimension(n)) is None or its.time == -2}
        for place in proportional(changes, whole, _STEADY):
            if forces & {*symbols_in(nodes[place])}:
                continue  # a force is none of what is constant
            number = -np.sum(whole * changes[place]) / np.sum(changes[place] ** 2)
            if (term := multiplied(nodes[place], float(number))) is not None:
                after = Equation(Add((*self._terms(), term)), _ZERO)
                yield Edit("missing term", None, term, after, 0.02 * depth(term))

    def _rates(self) -> Iterator[Edit]:
        """One rate for another."""
        known = [Sym(n.name, 1) for n in self.vocabulary.coordinates] + list(self.vocabulary.others)
        for node in walk(self.node):
            its = dimension(node, self.vocabulary.dimensions) if isinstance(node, Sym) else None
            if its is not None and its.mass == 0 and its.time == -1:
                same = (n for n in known if n != node and self.vocabulary.dimension(n) == its)
                yield from (Edit.at(self.equation, "symbol", node, Sym(n.name, n.dots, span=node.span)) for n in same)
