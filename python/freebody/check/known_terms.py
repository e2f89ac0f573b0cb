"""The terms that an equation may hold, and their values on true states: those of the model's letters that are of its dimension."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain, combinations
from typing import Any

import numpy as np

from freebody.symbolic.dimensions import FORCE, LENGTH, MASS, NUMBER_ONLY, Dimension, Known
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Add, Fn, Mul, Negative, Node, Num, Pow, Sym, unsigned, walk

from .coefficients import multiplied
from .language.dimensions import dimension
from .language.statements import Equation, symbols_in, terms
from .monomials import Monomials
from .spans import proportional
from .vocabulary import Vocabulary

_SAME = 1e-8  # spread of a sine below which it is one number on all states
_MOST_LETTERS = 3  # of rates of which the equation says nothing
_MOST_SHARES = 2  # parameters without a dimension, of which 1 + e and 1 − e are thought of
_MOST_LENGTHS = 5  # of which, as of masses, sums and differences are thought of
_ONE = Num(1.0, "1")


@dataclass
class KnownTerms:
    """Those of a ``vocabulary`` at the ``values`` of true states, of which as many are tried as lie ``within`` a budget; what is known to
    ``blur`` times round-off."""

    values: Mapping[str, Array]
    vocabulary: Vocabulary
    within: Callable[[Iterable[Any]], Iterator[Any]] = iter
    blur: float = 1.0
    _made: dict[object, tuple[list[Node], Array]] = field(default_factory=dict)
    _terms: dict[Equation, Monomials] = field(default_factory=dict)
    _numbers: dict[Node, bool] = field(default_factory=dict)

    def dimension_of(self, equation: Equation) -> Known:
        """The dimension of most terms of an equation: one of them may be wrong."""
        found = (dimension(term, self.vocabulary.dimensions) for term in terms(equation, expand=True))
        known = [each for each in found if each is not None]
        return max(known, key=known.count) if known else None

    def monomials(self, equation: Equation) -> Monomials:
        """The terms that an equation may lack."""
        if equation not in self._terms:
            known, said = self.vocabulary, symbols_in(equation)
            sizes = known.sizes
            sums = [n for n in walk(equation) if isinstance(n, Add) and n.symbols <= {*sizes, *known.parameters, Sym("t")}]
            lengths, masses = ([n for n in known.parameters if known.dimension(n) == its] for its in (LENGTH, MASS))
            alike = [Add(some) for count in (2, 3) for some in combinations(masses[:_MOST_LENGTHS], count)]
            bases = sorted(sizes, key=lambda n: (n not in known.parameters, n not in said, n in known.letters))
            alike += [Add((a, Negative(b))) for a, b in combinations(masses[:_MOST_LENGTHS], 2)]
            alike += [Add((a, c)) for a, b in combinations(lengths[:_MOST_LENGTHS], 2) for c in (Negative(b), b)]
            kept = [n for n, its in known.parameters.items() if its == NUMBER_ONLY and n not in known.angular]
            alike += [Add((_ONE, c)) for n in kept[:_MOST_SHARES] for c in (n, Negative(n))]  # 1 − e² of a blow
            own = [n for n in (*bases, Sym("t")) if n in said]
            moving = [n for n in said if Sym(n.name) in known.others]
            answers = [side for side in map(unsigned, (equation.left, equation.right)) if isinstance(side, Sym)]
            if all(known.dimension(n) == FORCE for n in answers):  # no answer, or that of a force
                moving += [n for n in known.others if n in known.letters and known.is_rate(n) and n not in said][:_MOST_LETTERS]
            fixed = lambda n: n.symbols <= {*known.parameters}
            calls = [n for n in calls_in(equation) if n.name not in ("sin", "cos") and fixed(n)]
            every = known.shapes(self.dimension_of(equation), moving, self._angles(equation), calls)
            brackets = [n for part in walk(equation) if isinstance(part, Mul) for n in part.factors if isinstance(n, Add)]
            brackets += [Add((_ONE, Negative(n))) for n in calls_in(equation) if n.name == "cos"]  # from rest there
            every = chain(every, ((n,) for n in dict.fromkeys(brackets) if n not in sums))  # 1 − cos θ of what falls
            shapes = (shape for shape in every if not any(map(self.has_number, shape)))
            self._terms[equation] = Monomials(
                self.values, dict.fromkeys((*own, *sums, *bases[: len(known.parameters)], *alike, *bases)), shapes, self.blur
            )
        return self._terms[equation]

    def matching(self, equation: Equation, wanted: Array, less: Dimension = NUMBER_ONLY) -> Iterator[Node]:
        """Terms that are ``wanted`` but for a number, of the dimension of the equation over ``less``; vectors are a number times a
        known one."""
        if wanted.ndim == 2:
            for vector, its in self.vocabulary.vectors.items():
                value = self.values[vector.key]
                along = np.sum(value * wanted, axis=1) / np.sum(value**2, axis=1)
                off = np.abs(wanted - along[:, None] * value).max(axis=1)
                if np.all(off <= 1e-9 * (np.abs(wanted).max(axis=1) + 1e-300)) and np.abs(along).max() > 0:
                    yield from (Mul((term, vector)) for term in self.matching(equation, along, its or NUMBER_ONLY))
        elif np.isfinite(wanted).all() and wanted.any():
            nodes, rows = self.dictionary(equation, less)
            for i in proportional(rows, wanted):
                if (term := multiplied(nodes[i], float(np.sum(wanted * rows[i]) / np.sum(rows[i] ** 2)))) is not None:
                    yield term

    def dictionary(self, equation: Equation, less: Dimension = NUMBER_ONLY, highest: int = 2) -> tuple[list[Node], Array]:
        """Terms that an equation may hold, of its dimension over ``less`` and with derivatives up to the ``highest``, and their values."""
        its = self.dimension_of(equation)
        wanted = None if its is None else its.times(less, -1)
        moving = tuple(n for n in symbols_in(equation) if Sym(n.name) in self.vocabulary.others)
        long = self._angles(equation)
        key = (wanted, moving, long, highest)
        if key not in self._made:
            nodes = list(
                self.within(chain(self.vocabulary.moments(wanted), self.vocabulary.terms(wanted, moving, long, highest)))
            )
            rows = self._rows(nodes)
            good = np.isfinite(rows).all(axis=1) & (np.abs(rows).max(axis=1) > 0)
            factors = {id(f): f for n in nodes if isinstance(n, Mul) for f in n.factors}  # by identity: many terms share them
            still = {key for key, factor in factors.items() if self._is_number(factor)}
            good &= np.array([not (isinstance(n, Mul) and any(id(f) in still for f in n.factors)) for n in nodes], dtype=bool)
            self._made[key] = [n for n, ok in zip(nodes, good, strict=True) if ok], rows[good]
        return self._made[key]

    def has_number(self, part: Node) -> bool:
        """Whether a part is a sine or cosine that has one value on all states, or a sum in which one is."""
        return any(map(self._is_number, walk(part) if isinstance(part, Add) else (part,)))

    def _is_number(self, factor: Node) -> bool:
        """Whether a sine or cosine has one value on all states: it says nothing there."""
        base = factor.base if isinstance(factor, Pow) else factor
        if isinstance(base, Fn) and base not in self._numbers:
            self._numbers[base] = bool(np.ptp(sampled(base, self.values)) <= _SAME)
        return self._numbers.get(base, False)

    def _angles(self, equation: Equation) -> tuple[Node, ...]:
        """Sums and parts of angles in sines and cosines."""
        angles = (n.args[0] for n in walk(equation) if isinstance(n, Fn) and n.name in ("sin", "cos"))
        plain = lambda n: isinstance(n, Sym) or (isinstance(n, Add) and len(n.terms) < 3)
        return tuple(dict.fromkeys(n for n in angles if not plain(n)))

    def _rows(self, nodes: Sequence[Node]) -> Array:
        """The value of each term; factors, of which there are few, are worked out once."""
        parts = [n.factors if isinstance(n, Mul) else (n,) for n in nodes]
        places: dict[Node, int] = {}
        seen: dict[int, int] = {}  # by identity: many terms share their factors
        for factor in (f for factors in parts for f in factors):
            if id(factor) not in seen:
                seen[id(factor)] = places.setdefault(factor, len(places) + 1)
        count = len(next(iter(self.values.values())))
        known = np.array([np.ones(count), *(sampled(factor, self.values) for factor in places)])
        rows = np.ones((len(nodes), count))
        for i in range(max(map(len, parts), default=0)):
            rows *= known[[seen[id(factors[i])] if i < len(factors) else 0 for factors in parts]]
        return rows


def calls_in(equation: Equation) -> list[Fn]:
    """The functions of one number that stand in an equation."""
    return [n for n in dict.fromkeys(walk(equation)) if isinstance(n, Fn) and len(n.args) == 1]
