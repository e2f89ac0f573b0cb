"""The symbols that a true equation may be written in, and the terms that can be made of them."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, reduce
from itertools import combinations, combinations_with_replacement, islice, permutations, product

from freebody.symbolic.dimensions import ENERGY, FORCE, LENGTH, NUMBER_ONLY, SPEED, TIME, Dimension, Known
from freebody.symbolic.tree import Add, Cross, Dot, Fn, Mul, Negative, Node, Num, Pow, Quotient, Sym

_DEGREE = 4  # of the product of parameters in a term: m l² has three, m l r g four
_MOST = 400  # products, each with all its sines and cosines
_OF_POWER = -3  # of time in the dimension of a power
_BLIND_DEGREE = 3  # where dimensions do not thin them out
_MOST_SPEEDS = 4  # letters of speeds, of which ratios are thought of


@dataclass(frozen=True)
class Vocabulary:
    """Symbols by what they are, each with its dimension: ``parameters`` of the model, ``coordinates`` (without dots; their
    rates and accelerations are the same with dots), ``others`` (forces, reactions); ``angles`` are those of no dimension."""

    parameters: Mapping[Sym, Known]
    coordinates: Mapping[Sym, Known]
    others: Mapping[Sym, Known] = field(default_factory=dict)
    vectors: Mapping[Sym, Known] = field(default_factory=dict)
    angular: frozenset[Sym] = frozenset()
    letters: frozenset[Sym] = frozenset()
    """What was declared for the statements."""
    energies: frozenset[Sym] = frozenset()
    """Of the others those that stand for an energy, which a couple could be by its dimension."""

    @cached_property
    def angles(self) -> list[Sym]:
        """Symbols that are angles, coordinates first."""
        return [n for n in (*self.coordinates, *self.parameters, *self.others) if n in self.angular]

    @cached_property
    def dimensions(self) -> dict[str, Dimension]:
        """The dimension of each symbol, where it is known."""
        groups = (self.parameters, self.coordinates, self.others, self.vectors)
        return {n.name: dimension for group in groups for n, dimension in group.items() if dimension is not None}

    def dimension(self, symbol: Sym) -> Known:
        """The dimension of a symbol with its dots; None where it is not known."""
        found = self.dimensions.get(symbol.name)
        return None if found is None else found.times(TIME, -symbol.dots)

    def alike(self, symbol: Sym) -> list[Sym]:
        """Other symbols of the same kind that one may write by mistake."""
        plain, vectors = Sym(symbol.name), {} if symbol.dots else self.vectors
        groups = (vectors, self.coordinates, self.parameters, self.others)
        group = next((group for group in groups if plain in group), {})
        return [Sym(n.name, symbol.dots) for n in group if n != plain and group[n] == group[plain]]

    def motions_like(self, symbol: Sym) -> list[Sym]:
        """Other rates and accelerations of the dimension of one."""
        its = self.dimension(symbol)
        every = (*(Sym(q.name, dots) for q in self.coordinates for dots in (1, 2)), *self.others)
        return [n for n in every if n != symbol and its is not None and its.time < 0 and self.dimension(n) == its]

    @cached_property
    def sizes(self) -> list[Sym]:
        """What products are made of that is no angle: parameters, coordinates, and letters for lengths and inertias that change."""
        still = [n for n in self.others if (its := self.dimension(n)) is not None and its != NUMBER_ONLY and not its.time]
        return [n for n in (*self.parameters, *self.coordinates, *still) if n not in self.angular]

    # -- factors

    @cached_property
    def single_factors(self) -> list[Node]:
        """What a term can have as a factor: a sine or cosine, or a symbol."""
        differences = [Add((a, Negative(b))) for a, b in combinations(self.angles, 2)]
        sines: list[Node] = [Fn(name, (angle,)) for angle in (*self.angles, *differences) for name in ("sin", "cos")]
        sizes = [n for n in (*self.parameters, *self.coordinates) if n not in self.angular]
        return [*sines, *sizes, *(Sym(n.name, dots) for n in self.coordinates for dots in (1, 2)), *self.others]

    @cached_property
    def double_factors(self) -> list[Node]:
        """Differences of two coordinates or of their rates, squares of rates and of those, and of sines and cosines, and what is left or
        gained where a number is a share: 1 + e."""
        pairs = [(a, b) for a, b in combinations(self.coordinates, 2) if self.coordinates[a] == self.coordinates[b]]
        rates = [(Sym(a.name, 1), Sym(b.name, 1)) for a, b in pairs]
        lengths = [pair for pair in pairs if pair[0] not in self.angular]
        apart: list[Node] = [Add((a, Negative(b))) for a, b in (*lengths, *rates)]
        squares = [_square(Sym(n.name, 1)) for n in self.coordinates]
        squares += [_square(Fn(name, (angle,))) for angle in self.angles for name in ("sin", "cos")]
        shares = [n for n, its in self.parameters.items() if its == NUMBER_ONLY and n not in self.angular]
        sums = [Add((Num(1.0, "1"), share)) for n in shares for share in (n, Negative(n))]
        sums += [Add((Num(1.0, "1"), sign(Fn("cos", (angle,))))) for angle in self.angles for sign in (lambda n: n, Negative)]
        speeds = [n for n in self.letters if n in self.others and self.is_rate(n) and self.dimension(n) == SPEED]
        speeds = sorted((n for n in speeds if not n.name.endswith(("_1", "_2"))), key=lambda n: n.name)[:_MOST_SPEEDS]
        # Friction along a velocity has such ratios; speeds of two bodies or moments have none.
        sums += [Quotient(*pair) for pair in permutations(speeds, 2)]
        return [*apart, *squares, *(_square(Add((a, Negative(b)))) for a, b in rates), *(Mul(pair) for pair in rates), *sums]

    # -- terms

    def terms(self, wanted: Known, moving: Sequence[Sym] = (), angles: Sequence[Node] = (), highest: int = 2) -> Iterator[Node]:
        """Terms of a dimension (of any where it is None) as equations of motion have them, also with sines of ``angles``, and with
        derivatives up to the ``highest``."""
        shapes = [*self._shapes, *((Fn(name, (angle,)),) for angle in angles for name in ("sin", "cos"))]
        accelerated = {Sym(q.name, 2) for q in self.coordinates if highest < 2}
        dynamic = [each for each in (*self._dynamic(moving), *self._works(wanted)) if not accelerated & {*each[0]}]
        for monomial in islice(self._monomials(wanted, dynamic), _MOST):
            for shape in shapes:
                factors = (*monomial, *shape)
                yield Mul(factors) if len(factors) > 1 else factors[0] if factors else Num(1.0, "1")

    def shapes(
        self, wanted: Known, moving: Sequence[Sym] = (), angles: Sequence[Node] = (), calls: Sequence[Node] = ()
    ) -> Iterator[tuple[Node, ...]]:
        """What changes with the motion, in equations of a dimension, times sines and cosines or other ``calls``; plain ones first."""
        functions = [*self._shapes, *((Fn(name, (angle,)),) for angle in angles for name in ("sin", "cos"))]
        functions += [(call,) for call in calls]
        dynamic = dict.fromkeys(each for each, _ in (*self._dynamic(moving), *self._works(wanted)))
        yield from ((*moves, *function) for function in functions for moves in dynamic)
        parts = (*self.differences, *self.turned_components, *self.products_across, *self.accelerations)
        yield from ((part,) for part in parts)

    @cached_property
    def differences(self) -> list[Node]:
        """Of two coordinates of one kind, and of their rates, as what stands between two masses has them."""
        pairs = [(a, b) for a, b in combinations(self.coordinates, 2) if self.coordinates[a] == self.coordinates[b]]
        return [Add((Sym(a.name, dots), Negative(Sym(b.name, dots)))) for a, b in pairs for dots in (0, 1)]

    @cached_property
    def products_across(self) -> list[Node]:
        """Of pairs of coordinates: moments of velocities and accelerations, x ẏ − y ẋ and x ÿ − y ẍ, and the half rate of a square, x ẋ + y ẏ."""
        lengths = [n for n, its in self.coordinates.items() if its == LENGTH]
        dotted = lambda n, dots: Sym(n.name, dots)
        across = [
            Add((Mul((x, dotted(y, dots))), Negative(Mul((y, dotted(x, dots))))))
            for x, y in combinations(lengths, 2)
            for dots in (1, 2)
        ]
        return [*across, *(Add((Mul((x, dotted(x, 1))), Mul((y, dotted(y, 1))))) for x, y in combinations(lengths, 2))]

    @cached_property
    def turned_components(self) -> list[Node]:
        """The components of forces and accelerations, of which those along x and y have letters, along and across directions at each angle."""
        forces = [n for n in self.others if self.dimension(n) == FORCE and n.name.endswith("x")]
        pairs = [(n, other) for n in forces if (other := Sym(f"{n.name[:-1]}y")) in self.others]
        lengths = [n for n, its in self.coordinates.items() if its == LENGTH]
        pairs += [(Sym(x.name, 2), Sym(y.name, 2)) for x, y in combinations(lengths, 2)]
        out: list[Node] = []
        for (x, y), angle in product(pairs, self.angles):
            sine, cosine = (Fn(name, (angle,)) for name in ("sin", "cos"))
            out += [Add((Mul((x, cosine)), Mul((y, sine)))), Add((Mul((x, sine)), Negative(Mul((y, cosine)))))]
        return out

    @cached_property
    def accelerations(self) -> list[Node]:
        """Components of the acceleration of the end of an arm that turns, each of its two parts, along axes and across and along other angles."""
        turning = [n for n in self.coordinates if n in self.angular]
        pairs = [*permutations(turning, 2)]
        seen: list[tuple[Sym, Node, bool]] = [(n, n, True) for n in turning]
        seen += [(n, angle, False) for n, other in pairs for angle in (Add((other, Negative(n))), other)]  # absolute, relative
        out: list[Node] = []
        for n, angle, along in seen:
            sine, cosine = (Fn(name, (angle,)) for name in ("sin", "cos"))
            across, inwards = Sym(n.name, 2), _square(Sym(n.name, 1))
            with_sense = lambda term, plus: term if plus else Negative(term)
            out.append(Add((Mul((across, cosine)), with_sense(Mul((inwards, sine)), not along))))
            out.append(Add((Mul((across, sine)), with_sense(Mul((inwards, cosine)), along))))
        return out

    def is_rate(self, symbol: Sym) -> bool:
        its = self.dimension(symbol)
        return its is not None and its.mass == 0 and its.time == -1

    def moments(self, wanted: Known) -> Iterator[Node]:
        """k · (r × F) of known vectors that are of a dimension."""
        upright = Sym("k")
        if wanted is None or upright not in self.vectors:
            return
        for arm, force in permutations(self.vectors, 2):
            if self.vectors[arm] == LENGTH and _joined([self.vectors[arm], self.vectors[force]]) == wanted:
                yield Dot(upright, Cross(arm, force))

    def _dynamic(self, moving: Sequence[Sym]) -> Iterator[tuple[tuple[Node, ...], Known]]:
        """What changes with the motion: accelerations, products of two rates, forces."""
        yield (), NUMBER_ONLY
        for q in self.coordinates:
            yield (Sym(q.name, 2),), self.dimension(Sym(q.name, 2))
        rates = [*(Sym(q.name, 1) for q in self.coordinates), *filter(self.is_rate, self.parameters)]
        for a, b in combinations_with_replacement((*rates, *filter(self.is_rate, moving)), 2):
            yield (_square(a),) if a == b else (a, b), _joined([self.dimension(a), self.dimension(b)])
        for symbol in dict.fromkeys((*self.others, *moving)):
            yield (symbol,), self.dimension(symbol)
            if self.is_rate(symbol) and symbol not in moving:
                yield (_square(symbol),), _joined([self.dimension(symbol)] * 2)
        for a, b in ((a, b) for a, b in combinations(rates, 2) if self.dimension(a) == self.dimension(b)):
            yield from (((_square(Add((a, c))),), _joined([self.dimension(a)] * 2)) for c in (b, Negative(b)))
        for rate in rates:
            yield (rate,), self.dimension(rate)

    def _works(self, wanted: Known) -> Iterator[tuple[tuple[Node, ...], Known]]:
        """What changes with the motion in an energy, a couple times an angle or the difference of two, and in a power, a rate times an acceleration or a force."""
        if wanted == ENERGY:
            couples = [n for n in (*self.parameters, *self.others) if self.dimension(n) == ENERGY and n not in self.energies]
            couples += [n for n in self.parameters if self.dimension(n) is None]
            turned: list[Node] = [n for n in self.coordinates if n in self.angular]
            turned += [Add((a, Negative(b))) for a, b in combinations(turned, 2)]
            yield from (((couple, angle), ENERGY) for couple, angle in product(couples, turned))
        if wanted is None or wanted.time != _OF_POWER:
            return
        rates = [Sym(q.name, 1) for q in self.coordinates] + [n for n in self.others if self.is_rate(n)]
        loads = [Sym(q.name, 2) for q in self.coordinates]
        loads += [n for n in self.others if self.is_load(n) or self.dimension(n) is None]
        for rate, load in product(rates, loads):
            yield (rate, load), _joined([self.dimension(rate), self.dimension(load)])

    def is_load(self, symbol: Sym) -> bool:
        """Whether it is a force, a moment or an acceleration, by its dimension."""
        its = self.dimension(symbol)
        return its is not None and its.time == -2

    def _monomials(self, wanted: Known, dynamic: list[tuple[tuple[Node, ...], Known]]) -> Iterator[tuple[Node, ...]]:
        sizes = [n for n in (*self.parameters, *self.coordinates) if n not in self.angular and not self.is_rate(n)]
        sizes = sizes if wanted is None else [n for n in sizes if n.name in self.dimensions]
        alike: dict[Known, list[tuple[Node, ...]]] = {}  # what changes with the motion, by the dimension that is left for it
        left: dict[tuple[Sym, ...], Known] = {(): wanted}
        for degree in range((_BLIND_DEGREE if wanted is None else _DEGREE) + 1):
            for chosen in combinations_with_replacement(sizes, degree):
                powers = Counter(chosen)
                if max(powers.values(), default=0) > 2:
                    continue
                if chosen:
                    before = left[chosen[:-1]]
                    left[chosen] = None if before is None else before.times(self.dimensions[chosen[-1].name], -1)
                if (rest := left[chosen]) not in alike:
                    alike[rest] = [factors for factors, own in dynamic if rest is None or own is None or own == rest]
                for factors in alike[rest]:
                    yield (*(n if count == 1 else _square(n) for n, count in powers.items()), *factors)

    @cached_property
    def _shapes(self) -> list[tuple[Node, ...]]:
        """1, and sines and cosines of angles, their sums and differences, angles as such, and products of two sines or cosines."""
        arguments: list[Node] = list(self.angles)
        for a, b in combinations(self.angles, 2):
            arguments += [Add((a, Negative(b))), Add((a, b))]
        single = [Fn(name, (argument,)) for argument in arguments for name in ("sin", "cos")]
        plain = [Fn(name, (argument,)) for argument in self.angles for name in ("sin", "cos")]
        double = [(_square(a),) if a == b else (a, b) for a, b in combinations_with_replacement(plain, 2)]
        return [(), *((s,) for s in single), *((angle,) for angle in self.angles), *double]


def stem(symbol: Sym) -> str:
    """A letter without its index: of F1 and F_B it is F."""
    return re.split(r"[_\d.]", symbol.name, maxsplit=1)[0]


def _square(node: Node) -> Node:
    return Pow(node, Num(2.0, "2"))


def _joined(dimensions: Sequence[Known]) -> Known:
    return None if None in dimensions else reduce(Dimension.times, dimensions, NUMBER_ONLY)
