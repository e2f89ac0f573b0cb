"""What would make true that something is constant: the smallest edits after which it is one along each motion."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np

from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Add, Negative, Node, Num, Sym, is_zero, walk

from .coefficients import multiplied, tidied
from .correction import EQUAL, MOST
from .edits import Edit, conventions, depth, edits, forgotten_factors
from .fitted_edits import FittedEdits, proportional
from .language.dimensions import dimension
from .language.spelling import spell
from .language.statements import Equation, symbols_in
from .likelihood import Likelihood
from .residual import magnitude
from .slips import why
from .stated import Correction, stated

if TYPE_CHECKING:
    from .case import Case

_STEADY = 1e-7  # change along a motion, relative to the terms: what the integrator leaves
_NEAREST = 40  # single edits beside which a second is looked for
_ZERO = Num(0.0, "0")


def constant_corrections(case: Case, node: Node, runs: Sequence[Mapping[str, Array]]) -> tuple[Correction, ...]:
    """The corrections of what was said to be constant, from the values of its symbols at moments of several motions."""
    values = {key: np.concatenate([run[key] for run in runs]) for key in runs[0]}
    search = _Search(case, node, values, len(next(iter(runs[0].values()))))
    every = [*search.found()] or [*search.pairs()]
    found = sorted(((search.size(chosen), chosen) for chosen in every), key=lambda pair: (pair[0], depth(pair[1][-1].after)))
    made: dict[object, tuple[float, tuple[Edit, ...]]] = {}
    for size, chosen in found:
        if np.isfinite(size) and size <= found[0][0] + EQUAL:
            made.setdefault(search.mark(chosen[-1].after.left), (size, chosen))
    return tuple(
        Correction(tuple(map(stated, chosen)), f"{spell(tidied(chosen[-1].after.left))} = const", size, why=search.why(chosen))
        for size, chosen in [*made.values()][:MOST]
    )


class _Search:
    def __init__(self, case: Case, node: Node, values: Mapping[str, Array], moments: int) -> None:
        self.node, self.values, self.moments = node, values, moments
        self.equation, self.vocabulary, self.within = Equation(node, _ZERO), case.meaning.vocabulary, case.budget.within
        self.fits, self.admissible = case.meaning.fits, case.admissible
        self._likelihood = Likelihood(self.equation, self.vocabulary, values, case.elsewhere(values))

    def found(self) -> Iterator[tuple[Edit, ...]]:
        """The edits after which it is constant."""
        with np.errstate(all="ignore"):
            for edit in self.within(chain(self._plain(), self._rates(), self._fitted(self.node))):
                if self.fits(edit.after) and self._is_steady(edit.after.left):
                    yield (edit,)

    def pairs(self) -> Iterator[tuple[Edit, ...]]:
        """Pairs of an edit that brings it near, and of what is then another number or lacking."""
        with np.errstate(all="ignore"):
            left = ((self._left(edit.after.left), edit) for edit in self.within(self._plain()) if self.fits(edit.after))
            near = sorted(((size, edit) for size, edit in left if size), key=lambda pair: pair[0])[:_NEAREST]
            for _, first in self.within(near):
                for second in self._fitted(first.after.left):
                    if self.fits(second.after) and self._is_steady(second.after.left):
                        yield first, second

    def _plain(self) -> Iterator[Edit]:
        return chain(*(of(self.equation, self.vocabulary) for of in (edits, conventions, forgotten_factors)))

    def _fitted(self, node: Node) -> Iterator[Edit]:
        return chain(self._factors(node), self._missing(node))

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

    def _factors(self, node: Node) -> Iterator[Edit]:
        """A term with another number."""
        equation, whole = Equation(node, _ZERO), self._changes(sampled(node, self.values))
        for term in _terms(node):
            own = self._changes(sampled(term, self.values))
            number = 1 - np.sum(whole * own) / np.sum(own**2)
            if np.isfinite(number) and (new := multiplied(term, float(number))) is not None and new != term:
                sign = (isinstance(new, Negative) and new.of == term) or (isinstance(term, Negative) and term.of == new)
                yield Edit.at(equation, "sign" if sign else "factor", term, new)

    def _missing(self, node: Node) -> Iterator[Edit]:
        """A sum that lacks a term."""
        whole = self._changes(sampled(node, self.values))
        nodes, changes = self._lacked
        if not len(changes) or changes.shape[1] != whole.size:  # a vector lacks no number
            return
        for place in proportional(changes, whole, _STEADY):
            number = -np.sum(whole * changes[place]) / np.sum(changes[place] ** 2)
            if (term := multiplied(nodes[place], float(number))) is not None:
                yield Edit("missing term", None, term, Equation(Add((*_terms(node), term)), _ZERO), 0.02 * depth(term))

    @cached_property
    def _lacked(self) -> tuple[list[Node], Array]:
        """What may be lacking, and how it changes along each motion; a force is none of what is constant."""
        nodes, rows = FittedEdits(self.values, self.vocabulary, self.within).dictionary(self.equation, highest=1)
        forces = {n for n in self.vocabulary.others if (its := self.vocabulary.dimension(n)) is None or its.time == -2}
        kept = [(node, self._changes(row)) for node, row in zip(nodes, rows, strict=True) if not forces & {*symbols_in(node)}]
        return [node for node, _ in kept], np.array([change for _, change in kept]).reshape(len(kept), -1 if kept else 0)

    def _rates(self) -> Iterator[Edit]:
        """Another rate for one, or a coordinate."""
        known = [Sym(n.name, dots) for n in self.vocabulary.coordinates for dots in range(2)] + list(self.vocabulary.others)
        for node in walk(self.node):
            its = dimension(node, self.vocabulary.dimensions) if isinstance(node, Sym) else None
            if its is not None and its.mass == 0 and its.time == -1:
                others = (Sym(n.name, n.dots, span=node.span) for n in known if n != node)
                yield from (Edit.at(self.equation, "symbol", node, other) for other in others)


def _terms(node: Node) -> tuple[Node, ...]:
    return node.terms if isinstance(node, Add) else (node,)
