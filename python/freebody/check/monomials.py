"""Terms by their values: the product of a number, powers of symbols, and one of many shapes that is equal to what is wanted."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property

import numpy as np

from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Node, Quotient

from .coefficients import multiplied, product, snapped
from .powers import power_of

_SPARE = 4  # states more than bases, at least
_MOST_SHAPES = 4000
_SAME = 1e-7  # of a logarithm: below it two values are one
_WHOLE = 1e-2  # off a whole number, below which a power is one: whether it is shows beside the values
_HIGHEST = 3
_MOST_POWERS = 7
_EXCHANGED = (1, 2, -1, -2)
"""Powers of a base that may stand for those of another of which it is a multiple."""
_DEPENDENT = 1e-6  # of a column: what is left of it beside others, below which it says nothing new, or is lost in round-off
_ONE = 1e-9  # of a column, by which its values differ at most where it is one


class Monomials:
    """What can be made of ``bases``, those that count first in front, and ``shapes``, products of what changes with the motion and
    of sines and cosines, at ``values``, which are known to ``blur`` times round-off."""

    def __init__(
        self, values: Mapping[str, Array], bases: Iterable[Node], shapes: Iterable[tuple[Node, ...]], blur: float = 1.0
    ) -> None:
        self.values, self.same, count = values, _SAME * blur, len(next(iter(values.values())))
        self.bases: list[Node] = []
        self._multiples: list[tuple[Node, Node, float]] = []  # bases left out, and of which other one they are how many times
        columns, basis = [np.ones(count)], np.ones((count, 1)) / np.sqrt(count)
        for node in bases:
            with np.errstate(all="ignore"):
                column = np.log(np.abs(sampled(node, values)))
            if column.ndim != 1 or not np.isfinite(column).all() or len(columns) > count - _SPARE:
                continue
            rest = column - basis @ (basis.T @ column)
            rest -= basis @ (basis.T @ rest)  # once more: the first leaves round-off of what is nearly dependent
            if np.linalg.norm(rest) > _DEPENDENT * np.linalg.norm(column):
                self.bases.append(node)
                columns.append(column)
                basis = np.column_stack([basis, rest / np.linalg.norm(rest)])
                continue
            ratios = (
                (base, float(column[0] - own[0]))
                for base, own in zip(self.bases, columns[1:], strict=True)
                if _is_one(column - own)
            )
            self._multiples += [(node, base, np.exp(ratio)) for base, ratio in ratios]
        self._columns = np.column_stack(columns)
        self._shapes = [shape for _, shape in zip(range(_MOST_SHAPES), shapes, strict=False)]

    def equal_to(self, wanted: Array, in_size: bool = False) -> Iterator[Node]:
        """Terms whose values, or only their sizes, are the ``wanted`` ones."""
        if wanted.ndim != 1 or not np.isfinite(wanted).all() or not wanted.all():
            return
        solve, left, logs, rests = self._solved
        log = np.log(np.abs(wanted))
        off = np.abs((left @ log)[:, None] - rests).max(axis=0)
        for place in np.flatnonzero(off < self.same).tolist():
            whole = _whole((solve @ (log - logs[:, place]))[1:])
            few = whole is not None and max(map(abs, whole), default=0) <= _HIGHEST and sum(map(abs, whole)) <= _MOST_POWERS
            if few and (found := self._term(whole, place, wanted, in_size)):
                yield found

    def powers(self, wanted: Array) -> dict[Node, int] | None:
        """The powers of the bases whose product is ``wanted`` but for a number; None where it is none."""
        if not np.isfinite(wanted).all() or not wanted.all():
            return None
        whole = _whole(np.linalg.lstsq(self._columns, np.log(np.abs(wanted)), rcond=None)[0][1:])
        if whole is None:
            return None
        found = {node: power for node, power in zip(self.bases, whole, strict=True) if power}
        ratio = wanted / self._value(tuple(power_of(node, power) for node, power in found.items()))
        return found if np.ptp(ratio) <= self.same * np.abs(ratio).max() else None

    @cached_property
    def _solved(self) -> tuple[Array, Array, Array, Array]:
        """What gives the powers of a logarithm, and what is left of it; the logarithms of the shapes, and what is left of these."""
        rows = np.array([self._value(shape) for shape in self._shapes])
        good = np.isfinite(rows).all(axis=1) & rows.all(axis=1)
        self._shapes = [shape for shape, ok in zip(self._shapes, good, strict=True) if ok]
        solve, logs = np.linalg.pinv(self._columns), np.log(np.abs(rows[good])).T
        left = np.eye(len(self._columns)) - self._columns @ solve
        return solve, left, logs, left @ logs

    def _value(self, factors: tuple[Node, ...]) -> Array:
        found = np.ones(len(self._columns))
        for factor in factors:
            found = found * self._known(factor)
        return found

    def _known(self, factor: Node) -> Array:
        if factor not in self._factors:
            found = sampled(factor, self.values)
            self._factors[factor] = found if found.ndim == 1 else np.full(len(found), np.nan)
        return self._factors[factor]

    @cached_property
    def _factors(self) -> dict[Node, Array]:
        return {}

    def _cancels(self, factor: Node, base: Node, power: int) -> bool:
        """Whether a factor and a power of a base are 1 together: the same, or what is the same here."""
        if factor == base:
            return True
        with np.errstate(all="ignore"):
            column = np.log(np.abs(self._known(factor))) + power * np.log(np.abs(self._known(base)))
        return bool(np.isfinite(column).all() and np.abs(column).max() <= _ONE)

    def _term(self, powers: list[int], place: int, wanted: Array, in_size: bool) -> Node | None:
        """The term of such powers; None where its number is none that a person writes."""
        own = {node: n for node, n in zip(self.bases, powers, strict=True) if n}
        if any(self._cancels(factor, base, n) for factor in self._shapes[place] for base, n in own.items() if n < 0):
            return None
        ratio = wanted / sampled(_product(own, self._shapes[place]), self.values)
        ratio = np.abs(ratio) if in_size else ratio
        if np.ptp(ratio) > self.same * np.abs(ratio).max():
            return None  # of changing sign
        number = float(np.median(ratio))
        if (found := multiplied(_product(own, self._shapes[place]), snapped(number, self.same))) is not None:
            return found
        for multiple, base, times in self._multiples:
            for n in _EXCHANGED:
                exchanged = {**own, base: own.get(base, 0) - n, multiple: n}
                few = sum(map(abs, exchanged.values())) <= _MOST_POWERS
                figure = snapped(number / times**n, self.same)
                if few and (found := multiplied(_product(exchanged, self._shapes[place]), figure)) is not None:
                    return found
        return None


def _product(powers: Mapping[Node, int], shape: tuple[Node, ...]) -> Node:
    """A shape times powers."""
    above = [power_of(node, n) for node, n in powers.items() if n > 0]
    below = [power_of(node, -n) for node, n in powers.items() if n < 0]
    top = product([*above, *shape])
    return Quotient(top, product(below)) if below else top


def _is_one(column: Array) -> bool:
    """Whether it has one value at all places."""
    return bool(np.ptp(column) <= _ONE * np.abs(column).max() + _ONE)


def _whole(powers: Array) -> list[int] | None:
    """Powers that are whole numbers; None where one is not."""
    whole = np.round(powers).astype(int)
    return whole.tolist() if np.abs(powers - whole).max(initial=0.0) < _WHOLE else None
