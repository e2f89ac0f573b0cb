"""Edits whose number or term is found from what the equation lacks: factors, missing terms, terms that should be others."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import permutations
from typing import Any

import numpy as np

from freebody.symbolic.dimensions import NUMBER_ONLY, Dimension, Known
from freebody.symbolic.evaluate import Array
from freebody.symbolic.evaluate import sampled as evaluate
from freebody.symbolic.tree import Add, Fn, Mul, Negative, Node, Num, Pow, Quotient, Sym, exchange, walk

from .edits import Edit, depth
from .language.dimensions import dimension
from .language.statements import Equation, letters
from .language.statements import terms as terms_of
from .solve_for_term import RequiredTerm, required_terms
from .vocabulary import Vocabulary

_SAME = 1e-8  # relative spread below which a factor is one number on all states
_LIKELY = 60  # terms of which pairs with all others are tried
_FAR_FETCHED = 0.9  # by which a term is less likely that stands for a wrong sign
_DENOMINATOR = 12
_NUMERATOR = 60


def recognised(value: float) -> Node | None:
    """A number as a person writes it: p/q with q ≤ 12, or such a part of π; None where it is neither."""
    for unit, name in ((1.0, ""), (math.pi, "pi")):
        fraction = Fraction(value / unit).limit_denominator(_DENOMINATOR)
        if fraction and abs(fraction.numerator) <= _NUMERATOR and abs(float(fraction) * unit / value - 1) < _SAME:
            return _fraction(fraction, name)
    return None


def _fraction(fraction: Fraction, name: str) -> Node:
    top: Node = Num(float(fraction.numerator), str(fraction.numerator))
    if name:
        pi = Num(math.pi, "pi")
        top = pi if fraction.numerator == 1 else Mul((top, pi))
    if fraction.denominator == 1:
        return top
    return Quotient(top, Num(float(fraction.denominator), str(fraction.denominator)))


@dataclass
class FittedEdits:
    """What can be fitted to an equation: ``values`` are those of true states, ``terms`` the shapes of missing terms."""

    values: Mapping[str, Array]
    vocabulary: Vocabulary

    def edits(self, equation: Equation) -> Iterator[Edit]:
        """Single edits found by solving for each part, terms that should be quite other ones aside."""
        with np.errstate(all="ignore"):
            for required in required_terms(equation, self.values):
                yield from self._leaves(equation, required)
                if required.addend:
                    yield from self._factors(equation, required)
                if isinstance(required.node, Add) or required.node in (equation.left, equation.right):
                    yield from self._missing(equation, required)

    def other_terms(self, equation: Equation) -> Iterator[Edit]:
        """Terms that should be quite other ones."""
        with np.errstate(all="ignore"):
            for required in required_terms(equation, self.values):
                if required.addend:
                    yield from self._replaced(equation, required)

    def _leaves(self, equation: Equation, required: RequiredTerm) -> Iterator[Edit]:
        """A number that should be another, a letter or a function that should be a letter of another kind."""
        found = _constant(required.needed) if _is_figure(required.node) else None
        if found is not None and found != -required.value[0] and (number := recognised(found)) is not None:
            yield Edit("factor", required.node, number, exchange(equation, required.node, number))
        if isinstance(required.node, Sym | Fn) and required.value.ndim == 1:
            for letter in self._letters:
                if letter != required.node and np.allclose(self.values[letter.key], required.needed, rtol=_SAME, atol=0):
                    new = Sym(letter.name, letter.dots, span=required.node.span)
                    yield Edit("letter", required.node, new, exchange(equation, required.node, new), 0.3)
        yield from self._squares(equation, required)
        if isinstance(required.node, Sym) and required.node in self.vocabulary.parameters:
            yield from self._lengthened(equation, required, required.node)

    def _squares(self, equation: Equation, required: RequiredTerm) -> Iterator[Edit]:
        """The square of a letter that should be that of another, of whatever sign."""
        match required.node:
            case Pow(base=Sym() as base, exponent=Num(value=2.0) as two) if required.value.ndim == 1:
                for letter in self._letters:
                    if letter != base and np.allclose(self.values[letter.key] ** 2, required.needed, rtol=_SAME, atol=0):
                        new = Pow(Sym(letter.name, letter.dots), two, span=required.node.span)
                        yield Edit("letter", required.node, new, exchange(equation, required.node, new), 0.1)

    def _lengthened(self, equation: Equation, required: RequiredTerm, letter: Sym) -> Iterator[Edit]:
        """A parameter that should be the sum or the difference of two, as an arm often is."""
        for a, b in permutations((letter, *self.vocabulary.alike(letter)), 2):
            one, two = self.values[a.key], self.values[b.key]
            for part, whole in ((b, one + two), (Negative(b), one - two)):
                if np.allclose(whole, required.needed, rtol=_SAME, atol=0):
                    new = Add((a, part), span=letter.span)
                    yield Edit("letter", letter, new, exchange(equation, letter, new), 0.2)

    @cached_property
    def _letters(self) -> list[Sym]:
        known = self.vocabulary
        moving = [Sym(q.name, dots) for q in known.coordinates for dots in range(3)]
        return [n for n in (*known.parameters, *moving, *known.others) if n.key in self.values]

    def _factors(self, equation: Equation, required: RequiredTerm) -> Iterator[Edit]:
        factor = required.factor
        if factor is None or not np.isfinite(factor).all():
            return
        found = _constant(factor)
        if found is not None:
            number = recognised(found)
            if number == Num(-1.0):
                new = (
                    required.node.of if isinstance(required.node, Negative) else Negative(required.node, span=required.node.span)
                )
                yield Edit("sign", required.node, new, exchange(equation, required.node, new))
            elif number is not None and number != Num(1.0):
                new = multiplied(required.node, number)
                own = 0.05 if any(isinstance(n, Num) for n in walk(required.node)) else 0.0
                yield Edit("factor", required.node, new, exchange(equation, required.node, new), own)
            return
        for size, new in self._monomials(required.node, factor, equation):
            yield Edit("missing factor", required.node, new, exchange(equation, required.node, new), 0.2 * (size - 1))

    def _monomials(self, node: Node, factor: Array, equation: Equation) -> Iterator[tuple[int, Node]]:
        """The node with the product of powers of letters that it lacks."""
        known = [n for n in (*self.vocabulary.parameters, *self.vocabulary.coordinates) if n not in self.vocabulary.angular]
        used = [n for n in known if _varies(self.values[n.key])]
        if not used or len(used) + 1 >= len(factor) or not (np.all(factor > 0) or np.all(factor < 0)):
            return
        columns = np.column_stack([np.ones(len(factor)), *[np.log(np.abs(self.values[n.key])) for n in used]])
        fit, *_ = np.linalg.lstsq(columns, np.log(np.abs(factor)), rcond=None)
        powers = np.round(fit[1:]).astype(int)
        if np.max(np.abs(fit[1:] - powers)) > 1e-6 or not powers.any() or np.abs(powers).max() > 3:
            return
        number = recognised(float(np.sign(factor[0]) * np.exp(fit[0])))
        if number is not None:
            chosen = [(n, int(p)) for n, p in zip(used, powers, strict=True) if p]
            yield sum(abs(p) for _, p in chosen) + (number != Num(1.0)), powered(node, number, chosen)

    # -- terms

    def _missing(self, equation: Equation, required: RequiredTerm) -> Iterator[Edit]:
        """A sum that lacks a term."""
        inner = not any(required.node is side for side in (equation.left, equation.right))
        like = Equation(required.node, Num(0.0)) if inner else equation
        for term in self._matching(like, required.missing):
            old = required.node.terms if isinstance(required.node, Add) else (required.node,)
            new = Add((*old, term), span=required.node.span)
            far = _FAR_FETCHED * self._far_fetched(term, equation)
            yield Edit("missing term", None, term, exchange(equation, required.node, new), 0.02 * depth(term) + far)

    def _far_fetched(self, term: Node, equation: Equation) -> bool:
        """Whether a term is twice an acceleration or force that the equation does not have: it stands for what has a wrong sign."""
        said = set(letters(equation))
        new = [n for n in letters(term) if n not in said and (n.dots == 2 or n in self.vocabulary.others)]
        first = term.of if isinstance(term, Negative) else term
        return bool(new) and isinstance(first, Mul) and first.factors[0] == Num(2.0)

    def two_missing(self, equation: Equation) -> Iterator[Edit]:
        """A side that lacks two terms."""
        with np.errstate(all="ignore"):
            required = next(required_terms(equation, self.values), None)
            if required is None or required.missing.ndim != 1 or not np.isfinite(required.missing).all():
                return
            nodes, rows = self._dictionary(equation, NUMBER_ONLY)
            for i, j in _spanning(rows, required.missing):
                sizes, *_ = np.linalg.lstsq(rows[[i, j]].T, required.missing, rcond=None)
                numbers = [recognised(float(size)) for size in sizes]
                if all(number is not None for number in numbers):
                    lost = tuple(multiplied(nodes[k], n) for k, n in zip((i, j), numbers, strict=True) if n is not None)
                    old = required.node.terms if isinstance(required.node, Add) else (required.node,)
                    new = Add((*old, *lost), span=required.node.span)
                    after = exchange(equation, required.node, new)
                    yield Edit("missing term", None, Add(lost), after, 1.2 + 0.02 * sum(depth(term) for term in lost))

    def _replaced(self, equation: Equation, required: RequiredTerm) -> Iterator[Edit]:
        """A term that should be quite another."""
        for term in self._matching(equation, required.needed):
            yield Edit("other term", required.node, term, exchange(equation, required.node, term), 0.02 * depth(term))

    def _matching(self, equation: Equation, wanted: Array, less: Dimension = NUMBER_ONLY) -> Iterator[Node]:
        """Terms of the dictionary that are ``wanted`` but for a number; their dimension is that of the equation over ``less``."""
        scale = np.max(np.abs(wanted))
        if wanted.ndim == 2:
            yield from self._matching_vectors(equation, wanted)
            return
        if not np.isfinite(scale) or scale == 0:
            return
        nodes, rows = self._dictionary(equation, less)
        for i in _proportional(rows, wanted):
            ratio = float(np.sum(wanted * rows[i]) / np.sum(rows[i] ** 2))
            if (number := recognised(ratio)) is not None:
                yield multiplied(nodes[i], number)

    def _matching_vectors(self, equation: Equation, wanted: Array) -> Iterator[Node]:
        """Terms that are a number times a known vector."""
        for vector, its in self.vocabulary.vectors.items():
            value = self.values[vector.key]
            along = np.sum(value * wanted, axis=1) / np.sum(value**2, axis=1)
            off = np.abs(wanted - along[:, None] * value).max(axis=1)
            if np.all(off <= 1e-9 * (np.abs(wanted).max(axis=1) + 1e-300)) and np.abs(along).max() > 0:
                yield from (Mul((term, vector)) for term in self._matching(equation, along, its or NUMBER_ONLY))

    def _dictionary(self, equation: Equation, less: Dimension) -> tuple[list[Node], Array]:
        whole = self._dimension(equation)
        wanted = None if whole is None else whole.times(less, -1)
        moving = tuple(n for n in letters(equation) if n in self.vocabulary.others)
        long = tuple(dict.fromkeys(n for n in _arguments(equation) if isinstance(n, Add) and len(n.terms) > 2))
        key = (wanted, moving, long)
        if key not in self._made:
            nodes = [*self.vocabulary.terms(wanted, moving, long), *self.vocabulary.moments(wanted)]
            rows = self._rows(nodes)
            good = np.isfinite(rows).all(axis=1) & (np.abs(rows).max(axis=1) > 0)
            self._made[key] = [n for n, ok in zip(nodes, good, strict=True) if ok], rows[good]
        return self._made[key]

    def _rows(self, nodes: Sequence[Node]) -> Array:
        """The value of each term; factors, of which there are few, are worked out once."""
        parts = [n.factors if isinstance(n, Mul) else (n,) for n in nodes]
        places: dict[Node, int] = {}
        seen: dict[int, int] = {}  # by identity: many terms share their factors
        for factor in (f for factors in parts for f in factors):
            if id(factor) not in seen:
                seen[id(factor)] = places.setdefault(factor, len(places) + 1)
        count = len(next(iter(self.values.values())))
        known = np.array([np.ones(count), *(evaluate(factor, self.values) for factor in places)])
        rows = np.ones((len(nodes), count))
        for i in range(max(map(len, parts), default=0)):
            rows *= known[[seen[id(factors[i])] if i < len(factors) else 0 for factors in parts]]
        return rows

    def _dimension(self, equation: Equation) -> Known:
        """That of most terms of the equation, as one of them may be wrong."""
        found = (dimension(term.node, self.vocabulary.dimensions) for term in terms_of(equation, expand=True))
        known = [each for each in found if each is not None]
        return max(known, key=known.count) if known else None

    @cached_property
    def _made(self) -> dict[tuple[Known, tuple[Sym, ...], tuple[Node, ...]], tuple[list[Node], Array]]:
        return {}


def _arguments(equation: Equation) -> Iterator[Node]:
    """What sines and cosines are taken of."""
    return (n.args[0] for n in walk(equation) if isinstance(n, Fn) and n.name in ("sin", "cos"))


def _is_figure(node: Node) -> bool:
    """Whether it is a number, or a fraction of two."""
    parts = (node.top, node.bottom) if isinstance(node, Quotient) else (node,)
    return all(isinstance(part, Num) for part in parts)


def _constant(values: Array) -> float | None:
    if values.ndim != 1 or not np.isfinite(values).all():
        return None
    mean = float(np.median(values))
    return mean if mean and np.max(np.abs(values - mean)) <= _SAME * abs(mean) else None


def _varies(values: Array) -> bool:
    return bool(values.ndim == 1 and np.all(values != 0) and np.ptp(np.log(np.abs(values))) > 1e-3)


def _proportional(rows: Array, wanted: Array) -> list[int]:
    """Rows that are ``wanted`` but for a factor."""
    dots, sizes = rows @ wanted, np.sum(rows**2, axis=1)
    off = np.abs(rows * (dots / sizes)[:, None] - wanted).max(axis=1)
    return np.flatnonzero(off <= _SAME * np.abs(wanted).max()).tolist()


def _spanning(rows: Array, wanted: Array) -> Iterator[tuple[int, int]]:
    """Pairs of rows of which ``wanted`` is made, the first among those most like it."""
    sizes = np.linalg.norm(rows, axis=1)
    order = np.argsort(-np.abs(rows @ wanted) / sizes)[:_LIKELY]
    for i in order.tolist():
        along = rows[i] / sizes[i]
        rest, others = wanted - (wanted @ along) * along, rows - np.outer(rows @ along, along)
        others[np.linalg.norm(others, axis=1) < 1e-6 * sizes] = np.nan
        yield from ((i, j) for j in _proportional(others, rest) if i < j or j not in order)


def multiplied(node: Node, number: Node) -> Node:
    """A term times a number, as a person writes it."""
    if number == Num(1.0):
        return node
    if number == Num(-1.0):
        return Negative(node)
    if isinstance(node, Negative):
        return Negative(multiplied(node.of, number), span=node.span)
    if (own := _own_number(node)) is not None:
        first, *rest = own
        together = recognised(first.value * float(evaluate(number, {})[0]))
        if together is not None:
            return multiplied(rest[0] if len(rest) == 1 else Mul(tuple(rest), span=node.span), together)
    if isinstance(number, Quotient) and isinstance(number.top, Num) and number.top.value < 0:
        return Negative(multiplied(node, Quotient(Num(-number.top.value, number.top.text.lstrip("-")), number.bottom)))
    if isinstance(number, Num) and number.value < 0:
        return Negative(multiplied(node, Num(-number.value, number.text.lstrip("-"))))
    if isinstance(number, Quotient) and number.top == Num(1.0):
        return Quotient(node, number.bottom, span=node.span)
    return Mul((number, *(node.factors if isinstance(node, Mul) else (node,))), span=node.span)


def _own_number(node: Node) -> tuple[Any, ...] | None:
    """The factors of a product that begins with a number."""
    return node.factors if isinstance(node, Mul) and isinstance(node.factors[0], Num) else None


def powered(node: Node, number: Node, chosen: Sequence[tuple[Sym, int]]) -> Node:
    """A term times a number and powers of letters; factors that it has itself are taken off first."""
    own = list(node.factors) if isinstance(node, Mul) else [node]
    below: list[Node] = []
    for letter, power in chosen:
        for _ in range(abs(power)):
            if power > 0:
                own.append(letter)
            elif letter in own:
                own.remove(letter)
            else:
                below.append(letter)
    top = own[0] if len(own) == 1 else Mul(tuple(own)) if own else Num(1.0, "1")
    if below:
        top = Quotient(top, below[0] if len(below) == 1 else Mul(tuple(below)))
    return multiplied(top, number)
