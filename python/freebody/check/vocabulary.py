"""The letters that a true equation may be written in, and the terms that can be made of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import combinations, combinations_with_replacement, islice, permutations

import numpy as np

from freebody.symbolic.evaluate import Array
from freebody.symbolic.evaluate import sampled as evaluate
from freebody.symbolic.tree import Add, Cross, Dot, Fn, Mul, Negative, Node, Num, Pow, Sym

Powers = tuple[int, int, int]
"""Powers of length, mass and time."""

_DEGREE = 4  # of the product of parameters in a term: m l² has three, m l r g four
_MOST = 400  # products, each with all its sines and cosines
_BLIND_DEGREE = 3  # where dimensions do not thin them out


@dataclass(frozen=True)
class Vocabulary:
    """Letters by what they are, each with its dimension: ``parameters`` of the model, ``coordinates`` (without dots; their
    rates and accelerations are the same with dots), ``others`` (forces, reactions); ``angles`` are those of no dimension."""

    parameters: Mapping[Sym, Powers | None]
    coordinates: Mapping[Sym, Powers | None]
    others: Mapping[Sym, Powers | None] = field(default_factory=dict)
    vectors: Mapping[Sym, Powers | None] = field(default_factory=dict)
    angular: frozenset[Sym] = frozenset()

    @cached_property
    def angles(self) -> list[Sym]:
        """Letters that are angles, coordinates first."""
        return [n for n in (*self.coordinates, *self.parameters) if n in self.angular]

    def powers(self, letter: Sym) -> Powers | None:
        """The dimension of a letter with its dots; None where it is not known."""
        plain = Sym(letter.name)
        known = {**self.parameters, **self.coordinates, **self.others, **self.vectors}
        found = known.get(plain)
        return None if found is None else (found[0], found[1], found[2] - letter.dots)

    def alike(self, letter: Sym) -> list[Sym]:
        """Other letters of the same kind that one may write by mistake."""
        plain = Sym(letter.name)
        if letter in self.vectors:
            return [n for n in self.vectors if n != letter and self.vectors[n] == self.vectors[letter]]
        for group in (self.coordinates, self.parameters, self.others):
            if plain in group:
                kin = [n for n in group if n != plain and (group[n] == group[plain])]
                return [Sym(n.name, letter.dots) for n in kin]
        return []

    # -- factors

    @cached_property
    def single_factors(self) -> list[Node]:
        """What a term can have as a factor: a sine or cosine, or a letter."""
        differences = [Add((a, Negative(b))) for a, b in combinations(self.angles, 2)]
        sines: list[Node] = [Fn(name, (angle,)) for angle in (*self.angles, *differences) for name in ("sin", "cos")]
        sizes = [n for n in (*self.parameters, *self.coordinates) if n not in self.angular]
        return [*sines, *sizes, *(Sym(n.name, dots) for n in self.coordinates for dots in (1, 2)), *self.others]

    @cached_property
    def double_factors(self) -> list[Node]:
        """Differences of two coordinates or of their rates, and squares of rates and of those."""
        pairs = [(a, b) for a, b in combinations(self.coordinates, 2) if self.coordinates[a] == self.coordinates[b]]
        rates = [(Sym(a.name, 1), Sym(b.name, 1)) for a, b in pairs]
        lengths = [pair for pair in pairs if pair[0] not in self.angular]
        apart: list[Node] = [Add((a, Negative(b))) for a, b in (*lengths, *rates)]
        squares = [_square(Sym(n.name, 1)) for n in self.coordinates]
        return [*apart, *squares, *(_square(Add((a, Negative(b)))) for a, b in rates), *(Mul(pair) for pair in rates)]

    # -- terms

    def terms(self, wanted: Powers | None, moving: Sequence[Sym] = (), angles: Sequence[Node] = ()) -> Iterator[Node]:
        """Terms of a dimension (of any where it is None) as equations of motion have them, also with sines of ``angles``."""
        shapes = [*self._shapes, *((Fn(name, (angle,)),) for angle in angles for name in ("sin", "cos"))]
        for monomial in islice(self._monomials(wanted, list(self._dynamic(moving))), _MOST):
            for shape in shapes:
                factors = (*monomial, *shape)
                yield Mul(factors) if len(factors) > 1 else factors[0] if factors else Num(1.0, "1")

    def moments(self, wanted: Powers | None) -> Iterator[Node]:
        """k · (r × F) of known vectors that are of a dimension."""
        upright = Sym("k")
        if wanted is None or upright not in self.vectors:
            return
        for arm, force in permutations(self.vectors, 2):
            if self.vectors[arm] == (1, 0, 0) and _joined([self.vectors[arm], self.vectors[force]]) == wanted:
                yield Dot(upright, Cross(arm, force))

    def _dynamic(self, moving: Sequence[Sym]) -> Iterator[tuple[tuple[Node, ...], Powers | None]]:
        """What changes with the motion: accelerations, products of two rates, forces."""
        yield (), (0, 0, 0)
        for q in self.coordinates:
            yield (Sym(q.name, 2),), self.powers(Sym(q.name, 2))
        for a, b in combinations_with_replacement([Sym(q.name, 1) for q in self.coordinates], 2):
            yield (_square(a),) if a == b else (a, b), _joined([self.powers(a), self.powers(b)])
        for letter in dict.fromkeys((*self.others, *moving)):
            yield (letter,), self.powers(letter)
        for q in self.coordinates:
            yield (Sym(q.name, 1),), self.powers(Sym(q.name, 1))

    def _monomials(
        self, wanted: Powers | None, dynamic: list[tuple[tuple[Node, ...], Powers | None]]
    ) -> Iterator[tuple[Node, ...]]:
        sizes = [n for n in (*self.parameters, *self.coordinates) if n not in self.angular]
        known = {n: self.powers(n) for n in sizes}
        blind = wanted is None
        sizes = sizes if blind else [n for n in sizes if known[n] is not None]
        for degree in range((_BLIND_DEGREE if blind else _DEGREE) + 1):
            for chosen in combinations_with_replacement(sizes, degree):
                if max([chosen.count(n) for n in chosen], default=0) > 2:
                    continue
                size = _joined([known[n] for n in chosen])
                for factors, powers in dynamic:
                    if blind or powers is None or _joined([size, powers]) == wanted:
                        yield (*_gathered(chosen), *factors)

    @cached_property
    def _shapes(self) -> list[tuple[Node, ...]]:
        """1, and sines and cosines of angles, their sums and differences, and products of two."""
        arguments: list[Node] = list(self.angles)
        for a, b in combinations(self.angles, 2):
            arguments += [Add((a, Negative(b))), Add((a, b))]
        single = [Fn(name, (argument,)) for argument in arguments for name in ("sin", "cos")]
        plain = [Fn(name, (argument,)) for argument in self.angles for name in ("sin", "cos")]
        double = [(_square(a),) if a == b else (a, b) for a, b in combinations_with_replacement(plain, 2)]
        return [(), *((s,) for s in single), *double]


def _square(node: Node) -> Node:
    return Pow(node, Num(2.0, "2"))


def _gathered(chosen: Sequence[Sym]) -> tuple[Node, ...]:
    return tuple(n if chosen.count(n) == 1 else _square(n) for n in dict.fromkeys(chosen))


def _joined(powers: Sequence[Powers | None]) -> Powers | None:
    known = [p for p in powers if p is not None]
    if len(known) < len(powers):
        return None
    return (sum(p[0] for p in known), sum(p[1] for p in known), sum(p[2] for p in known))


def dimension(node: Node, values: Mapping[str, Array], vocabulary: Vocabulary, letters: Sequence[Sym]) -> Powers | None:
    """The dimension of a term, found by measuring it in other units; None where a letter's is not known or it has none."""
    powers = {n.key: vocabulary.powers(n) for n in letters}
    if any(p is None for p in powers.values()) or len(powers) < len(letters):
        return None
    plain = np.abs(evaluate(node, values)).sum()
    found = []
    for axis in range(3):
        scaled = {key: 2.0 ** powers[key][axis] * value if key in powers else value for key, value in values.items()}  # type: ignore[index]
        with np.errstate(all="ignore"):
            ratio = np.log2(np.abs(evaluate(node, scaled)).sum() / plain)
        if not np.isfinite(ratio) or abs(ratio - round(ratio)) > 1e-6:
            return None
        found.append(round(ratio))
    return (found[0], found[1], found[2])
