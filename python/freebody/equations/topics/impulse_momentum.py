"""What an impact leaves, solved symbolically: impulses first, then by them the rates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from freebody.core import Array
from freebody.equations.answers import with_positive_divisors
from freebody.equations.derivation.balance_text import Stated
from freebody.equations.solve import Singular, TooLarge, Unconfirmed, linear_system, solve
from freebody.equations.topics.abbreviations import Names
from freebody.equations.topics.common import spread
from freebody.equations.topics.impact_equations import MOST_OPERATIONS, Impact, Row, Rows, after, require_brief
from freebody.solve.perturbed_states import independent
from freebody.symbolic.algebra import divided, without_circles
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.linear import linear_in
from freebody.symbolic.presentation import length, presented
from freebody.symbolic.to_sympy import from_sympy, sympy, to_sympy
from freebody.symbolic.tree import (
    ONE,
    ZERO,
    Add,
    Fn,
    Pow,
    Sym,
    Tree,
    add,
    is_zero,
    mul,
    negative,
    operations,
    replace,
    symbols,
    walk,
)

_DEPENDS = 1e-9
"""Below it a row adds nothing to others."""
_READABLE = 90
"""Signs that an answer may have for the sake of holding no impulse."""
_BRIEF = 40
"""Signs of a rate after an impact above which it may be written by another."""
_HELPS = 12
"""Operations of a rate by others, above which it is no help."""
_MOST_SPREAD = 1000
"""Operations in equations above which they are not multiplied out: that takes long, and what comes is no shorter."""
_MOST_TOGETHER = 6
"""Unknowns that are solved together."""
_PATIENCE = 1.0
"""Seconds for the shortest form of one answer."""

Solution = Mapping[Sym, Tree]
_Sides = tuple[Tree, Tree]


@dataclass(frozen=True)
class Jumps:
    """``known``: rates before an impact that follow from others by what held then; ``names``: what is long, by symbols; then the
    ``impulses`` of what acts, the ``rates`` after the impact, and the impulses of ``joints`` that the balances of the coordinates
    do not have. Each may hold the symbols of others, see ``solution``."""

    known: Solution
    names: Solution
    impulses: Solution
    rates: Solution
    joints: Solution
    joints_missing: str = ""
    """Why the impulses of joints are not given, where they are not."""

    def spelt(self) -> Solution:
        """Rates after and impulses by what is given alone."""
        made: dict[Sym, Tree] = {}
        for x, tree in (*self.names.items(), *self.solution.items()):
            made[x] = replace(tree, made)
        return {x: made[x] for x in self.solution}

    @property
    def solution(self) -> Solution:
        """All that is found, each by those before it: rates first where they hold no impulse."""
        alone = not any(symbols(tree) & self.impulses.keys() for tree in self.rates.values())
        first, then = (self.rates, self.impulses) if alone else (self.impulses, self.rates)
        return {**first, **then, **self.joints}


def jumps(found: Impact) -> Jumps:
    """What an impact leaves. Raises ``TooLarge``, ``Singular``; ``Unconfirmed`` where it is not what the run says."""
    if not all(found.holds(each) for each in found.conditions()):
        raise Unconfirmed(found.otherwise())
    rows = Rows.of(found)
    if len(rows.impulses) != len(rows.conditions):
        raise TooLarge(f"{len(rows.conditions)} equations for {len(rows.impulses)} unknowns: constraints are redundant")
    factors = [*rows.mass, *(row for row, _ in rows.gives), *(row for _, (row, _) in rows.conditions)]
    require_brief([entry for row in factors for entry in row])
    solved = _System(found, rows).solved()
    if not found.agrees(solved.spelt()):
        raise Unconfirmed(found.otherwise())
    return solved


class _System:
    """The equations of an impact, what is long in them named, and their solution."""

    def __init__(self, found: Impact, rows: Rows) -> None:
        self.found = found
        self.names = Names(frozenset(found.nomenclature))
        self.before = [Sym(name, 1) for name in found.subject.names]
        self.after = [Sym(after(x.name), 1) for x in self.before]
        held = [row.rate for row in found.subject.rows_before if row.rate is not None and found.vanishes(row.rate)]
        self.known = self._bound(held, self.before)
        now = dict(zip(self.before, self.after, strict=True))
        self.follow = self._bound([replace(each.rate, now) for each, _ in rows.conditions if is_zero(each.back)], self.after)
        self.mass = [[self._entry(entry) for entry in row] for row in rows.mass]
        self.gives = [self._named(row) for row in rows.gives]
        self.rows = [(each, *self._named(row)) for each, row in rows.conditions]
        self.acting = rows.impulses

    def solved(self) -> Jumps:
        """Without impulses where that is short: of what is free after the impact. Else impulses first, then the rates by them; last
        the impulses of joints."""
        rates, impulses, full = self._without_impulses() or self._by_impulses()
        joints, joints_missing = {}, ""
        try:
            joints = self._joints(full)
        except (TooLarge, Singular) as error:
            joints_missing = str(error)
        used = self.names.used((*impulses.values(), *rates.values(), *joints.values(), *self.known.values()))
        return Jumps(self.known, used, impulses, rates, joints, joints_missing)

    def _without_impulses(self) -> tuple[Solution, Solution, Solution] | None:
        """Where what holds after the impact leaves rates free, and the others follow from these by short expressions: impulses give
        nothing to the balances of motions that it allows. Rates, impulses, and all of these by rates before."""
        free = [x for x in self.after if x not in self.follow]
        if len(self.follow) != len(self.rows) or not free:
            return None
        motions = [linear_in(self.follow.get(x, x), free).coefficients for x in self.after]
        ways = [[motion.get(w, ZERO) for w in free] for motion in motions]  # what each rate is for a unit of a free one
        one, other = (self._in_numbers(rows) for rows in (ways, [row for row, _ in self.gives]))
        if np.abs(one.T @ other).max(initial=0.0) >= _DEPENDS:
            return None  # some impulse has a part in the balances of these motions
        changes = [add(self.follow.get(x, x), negative(self._of_before(y))) for x, y in zip(self.after, self.before, strict=True)]
        momenta = [add(*map(mul, row, changes), negative(rest)) for row, (_, rest) in zip(self.mass, self.gives, strict=True)]
        balances = [(add(*(mul(way[k], p) for way, p in zip(ways, momenta, strict=True))), ZERO) for k in range(len(free))]
        rates = {x: self._stated(tree, tree) for x, tree in self._together(balances, free).items()}
        if any(self._signs(tree) > _READABLE for tree in rates.values()):
            return None
        full = {**rates, **{x: replace(tree, rates) for x, tree in self.follow.items()}}
        stopped = {x: tree for x, tree in full.items() if is_zero(tree)}
        found = self._by_balances(self.found.of_coordinates(), self.acting, self.known)
        by_rates = {x: self._stated(tree, tree) for x, tree in found.items()}
        impulses = {x: self._finished(replace(tree, stopped)) for x, tree in by_rates.items()}
        rest = {x: self._stated(full[x], full[x]) for x in self.follow}  # by rates before where that is brief
        for x, tree in rest.items():
            if self._signs(tree) > max(_BRIEF, self._signs(self.follow[x])):
                rest[x] = self.follow[x]
        return {**rates, **rest}, impulses, {**full, **{x: replace(tree, full) for x, tree in impulses.items()}}

    def _in_numbers(self, rows: Sequence[Sequence[Tree]]) -> Array:
        values, tables = self._numbers(), self.found.subject.tables
        return np.array([[float(evaluate(entry, values, tables)) for entry in row] for row in rows])

    def _by_impulses(self) -> tuple[Solution, Solution, Solution]:
        """Impulses by rates before, and rates after by these or by impulses, then all of them by rates before."""
        # what every rate changes by, by the impulses
        sums = [add(*map(mul, row, self.acting), rest) for row, rest in self.gives]
        n = len(sums)
        if all(is_zero(self.mass[i][k]) for i in range(n) for k in range(n) if i != k):
            jumped = [divided(each, self.mass[i][i]) for i, each in enumerate(sums)]
        else:
            _require_few(n)
            jumped = solve(self.mass, sums, self.found.nomenclature, patience=0.0)
        asked: list[_Sides] = []
        for each, row, rest in self.rows:
            before = add(*(mul(factor, self._of_before(x)) for factor, x in zip(row, self.before, strict=True)), rest)
            jump = ZERO if self.found.vanishes(each.rate) else negative(mul(add(ONE, each.back), before))
            asked.append((add(*map(mul, row, jumped)), jump))
        impulses = self._together(asked, self.acting) if asked else {}
        old = [self._of_before(x) for x in self.before]
        full = {x: add(u, replace(jump, impulses)) for x, u, jump in zip(self.after, old, jumped, strict=True)}
        rates = {x: self._stated(add(u, jump), full[x]) for x, u, jump in zip(self.after, old, jumped, strict=True)}
        return rates, {x: self._stated(tree, tree) for x, tree in impulses.items()}, {**impulses, **full}

    def _put(self, tree: Tree) -> Tree:
        """An expression with what is 0 at the impact, and with symbols for its angles."""
        zeros = self.found.zeros
        small = from_sympy(to_sympy(replace(tree, zeros))) if symbols(tree) & zeros.keys() else tree
        return self.names.angles(small)

    def _entry(self, tree: Tree) -> Tree:
        return self.names.entry(presented(self._put(tree)))

    def _named(self, row: Row) -> Row:
        return [self._entry(entry) for entry in row[0]], self._put(row[1])

    def _signs(self, tree: Tree) -> int:
        return length(tree, self.found.nomenclature)[0]

    def _bound(self, held: Sequence[Tree], there: Sequence[Sym]) -> Solution:
        """Some rates by others where some expressions of them vanish; those that are short."""
        there = [x for x in there if x not in self.found.zeros]
        parts = [linear_in(rate, there) for rate in held]
        rows = [[self._put(each.coefficients.get(x, ZERO)) for x in there] for each in parts]
        if not rows:
            return {}
        table = self._in_numbers(rows)
        if not (chosen := independent(table)):
            return {}
        simple = sorted(range(len(there)), key=lambda k: max(operations(rows[i][k]) for i in chosen))
        bound = [simple[k] for k in independent(table[chosen][:, simple].T)]
        if len(bound) > _MOST_TOGETHER:
            return {}
        free = [k for k in range(len(there)) if k not in bound]
        right = [negative(add(*(mul(rows[i][k], there[k]) for k in free), self._put(parts[i].rest))) for i in chosen]
        solution = solve([[rows[i][k] for k in bound] for i in chosen], right, self.found.nomenclature, patience=_PATIENCE)
        stated = {there[k]: self._finished(tree) for k, tree in zip(bound, solution, strict=True)}
        short = {x: tree for x, tree in stated.items() if operations(tree) <= _HELPS}
        parts = {
            x: [part.base for part in walk(tree) if isinstance(part, Pow) and part.exponent < 0] for x, tree in short.items()
        }
        zeros = {x for x, below in parts.items() if any(isinstance(part, Fn) for base in below for part in walk(base))}
        return {x: tree for x, tree in short.items() if x not in zeros}  # those are divided by what is 0 in some places

    def _of_before(self, rate: Sym) -> Tree:
        return self.found.zeros.get(rate, self.known.get(rate, rate))

    def _joints(self, solution: Solution) -> Solution:
        """From the balances of single bodies, as many as it takes."""
        sizes = self.found.sizes()
        wanted = [x for x in self.found.impulses.values() if x not in self.acting]
        if not wanted:
            return {}
        if any(np.isnan(sizes[x]) for x in wanted):
            raise Singular("they are not determined, as constraints are redundant")
        staged = self._by_balances(self.found.of_bodies(), wanted, {})
        return {x: self._stated(tree, replace(replace(tree, self.known), solution)) for x, tree in staged.items()}

    def _by_balances(self, stated: Sequence[Stated], wanted: Sequence[Sym], known: Solution) -> Solution:
        """Impulses by the rates before and after, with what is ``known`` of these, from the first balances that together give them
        at the numbers of the impact."""
        values = {x: 0.0 if np.isnan(value) else value for x, value in self._numbers().items()}  # NaN: not determined
        largest = max((abs(values[x]) for x in self.found.sizes()), default=0.0) or 1.0

        def factor(x: Sym, tree: Tree) -> float:
            much, none = (evaluate(tree, values | {x: size}, self.found.subject.tables) for size in (largest, 0.0))
            return float(much - none) / largest

        balances = [(self.found.acting(each.balance), self.found.jump(each.balance)) for each in stated]
        chosen = independent(np.array([[factor(x, left) for x in wanted] for left, _ in balances]))
        put = [(self._put(left), self._put(replace(right, known))) for left, right in (balances[i] for i in chosen)]
        return self._one_by_one(put, wanted)

    def _one_by_one(self, equations: Sequence[_Sides], wanted: Sequence[Sym]) -> Solution:
        """First each equation that has only one unknown left, then the rest together."""
        for k, sides in enumerate(equations):
            unknown = [x for x in wanted if x in symbols(*sides)]
            if len(unknown) == 1 < len(wanted):
                first = self._together([sides], unknown)
                rest = [(replace(left, first), replace(right, first)) for left, right in (*equations[:k], *equations[k + 1 :])]
                return {**first, **self._one_by_one(rest, [x for x in wanted if x not in first])}
        return self._together(equations, wanted) if wanted else {}

    def _together(self, equations: Sequence[_Sides], wanted: Sequence[Sym]) -> Solution:
        _require_few(len(wanted))
        require_brief([side for sides in equations for side in sides], _MOST_SPREAD)
        matrix, right = linear_system(equations, wanted)
        require_brief([*(entry for row in matrix for entry in row), *right])
        found = solve([list(map(spread, row)) for row in matrix], list(map(spread, right)), self.found.nomenclature, patience=0.0)
        require_brief(found)
        return {x: self.names.plain_angles(_fourier(tree)) for x, tree in zip(wanted, found, strict=True)}

    def _stated(self, staged: Tree, full: Tree) -> Tree:
        """``full`` in its shortest form where that can be read, else ``staged``, which says it by other symbols."""
        short, whole = self._finished(staged), self.names.spelt(full)
        if operations(whole) > MOST_OPERATIONS:
            return short
        nomenclature, turns = self.found.nomenclature, any(isinstance(part, Fn) for part in walk(whole))
        forms = [whole, *([self.names.plain_angles(_fourier(whole))] if turns else [])]
        given = (sympy.together(to_sympy(form)) if isinstance(form, Add) else to_sympy(form) for form in forms)
        made = (self._finished(presented(form, nomenclature, patience=_PATIENCE)) for form in given)
        best = min(made, key=lambda form: length(form, nomenclature))
        return best if self._signs(best) <= max(_READABLE, self._signs(short)) else short

    def _finished(self, tree: Tree) -> Tree:
        return with_positive_divisors(without_circles(self.names.plain_angles(tree)), self._numbers())

    def _numbers(self) -> dict[Sym, float]:
        """The numbers of all symbols at the impact."""
        found = self.found
        values = found.values | found.rates_after | found.sizes()
        for name, tree in self.names.made.items():
            values[name] = float(evaluate(tree, values, found.subject.tables))
        return values


def _fourier(tree: Tree) -> Tree:
    """A fraction with products of sines and cosines as sums, in which the angles between parts stand by themselves."""
    from sympy.simplify.fu import TR8

    above, below = (TR8(sympy.expand(part)) for part in sympy.fraction(sympy.together(to_sympy(tree))))
    return from_sympy(sympy.cancel(above / below))


def _require_few(unknowns: int) -> None:
    """Raises ``TooLarge``."""
    if unknowns > _MOST_TOGETHER:
        raise TooLarge(f"{unknowns} unknowns that hang together are too many for a symbolic answer")
