"""One degree of freedom in closed loops: ratios of rates named one after the other, and the one equation of motion with them.

With q̇ = k ż and q̈ = k z̈ + c of all coordinates, Lagrange's equations M q̈ + b = 0, added up with the factors k, hold no load of
what closes the loops: (kᵀ M k) z̈ + kᵀ (M c + b) = 0. The factor of z̈ is the inertia that is felt at z."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from dataclasses import replace as replaced
from itertools import combinations

import numpy as np

from freebody.core import Array
from freebody.document.blocks import Block, Equation, Paragraph, Words, Written, equations
from freebody.equations.solve import TooLarge, coefficients, solve
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.decimals import measured
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.linear import Linear, linear_in
from freebody.symbolic.presentation import PATIENCE, presented
from freebody.symbolic.symbols import Name
from freebody.symbolic.to_sympy import from_sympy, sympy, to_sympy
from freebody.symbolic.tree import ONE, ZERO, Sym, Tree, add, mul, negative, operations, over, replace, symbols

Put = Callable[[Tree], Tree]
MOST_TOGETHER = 3
"""Coordinates that are solved for together."""
_SHORT = 2
"""Operations up to which a ratio has no symbol of its own."""
_NOTHING = 1e-9
"""Factor of a coordinate, by what that and the row are measured by, below which the row does not give it."""


@dataclass
class Ratios:
    """By the coordinate ``free``: ``named`` symbols, k of rates and c of accelerations, each by those before; ``rates`` and ``rests``
    of every coordinate by them; the ``inertia`` that is felt at it, and its ``load``. Where a motion has ``prescribed`` its
    acceleration, what it takes is ``driving``."""

    free: str
    named: dict[Sym, Tree] = field(default_factory=dict)
    rates: dict[str, Tree] = field(default_factory=dict)
    rests: dict[str, Tree] = field(default_factory=dict)
    inertia: Tree = ZERO
    load: Tree = ZERO
    prescribed: Tree | None = None
    driving: dict[Sym, Tree] = field(default_factory=dict)

    def moving(self, tree: Tree) -> Tree:
        """An expression with the rates that have no symbol of their own by that of the free coordinate."""
        plain = {Sym(n, 1): mul(k, Sym(self.free, 1)) for n, k in self.rates.items() if k not in self.named}
        return from_sympy(to_sympy(replace(tree, plain))) if symbols(tree) & plain.keys() else tree

    def definitions(self) -> dict[Sym, Tree]:
        """The named symbols and all accelerations, each by those before."""
        others = {Sym(name, 2): self.acceleration(name) for name in self.rates if name != self.free}
        return self.named | {Sym(self.free, 2): self.acceleration(self.free)} | others

    def acceleration(self, name: str) -> Tree:
        """Of a coordinate; others by that of the free one."""
        if name == self.free:
            return over(self.load, self.inertia) if self.prescribed is None else self.prescribed
        return add(mul(self.rates[name], Sym(self.free, 2)), self.rests[name])


def ratios(subject: SymbolicState, put: Put, free: str) -> Ratios:
    """The ratios where loops leave one coordinate, which a motion may drive. Raises ``TooLarge`` where they leave more."""
    names = subject.names
    found = Ratios(free, rates={free: ONE}, rests={free: ZERO})
    rows = [Linear({x: put(c) for x, c in row.linear.coefficients.items()}, put(row.linear.rest))
            for row in subject.rows if row.kind != "motion"]  # fmt: skip
    sizes = subject.free.row_sizes(subject.coordinates)
    held = [size for row, size in zip(subject.rows, sizes, strict=True) if row.kind != "motion"]
    table = np.array([_factors(subject, row) / size for row, size in zip(rows, held, strict=True)]).reshape(len(rows), len(names))
    while unknown := [name for name in names if name not in found.rates]:
        _tell(found, subject, *_block(rows, unknown, table[:, [names.index(name) for name in unknown]]))
    _sum_up(found, subject, put)
    for row in subject.rows:
        if row.kind == "motion":  # what it takes: J z̈ less the other loads
            [factor] = row.linear.coefficients.values()
            found.prescribed = negative(over(put(row.linear.rest), put(factor)))
            force = next(Sym(load.symbol) for load in subject.free.loads if load.kind == "motion" and load.unknown)
            [[own], rest] = coefficients(found.load, [force])
            whole = add(mul(found.inertia, Sym(free, 2)), negative(rest))
            found.driving = {force: whole if own == ONE else over(whole, own)}
    return found


def driven(subject: SymbolicState) -> str | None:
    """The coordinate whose acceleration a motion prescribes. Raises ``TooLarge`` where it prescribes anything else."""
    motions = [row for row in subject.rows if row.kind == "motion"]
    if len(motions) > 1 or any(len(row.linear.coefficients) != 1 for row in motions):
        raise TooLarge("motions prescribe more than one coordinate; ask for numbers")
    return next(iter(motions[0].linear.coefficients)).name if motions else None


def _factors(subject: SymbolicState, row: Linear) -> Array:
    """What a row changes by while each coordinate does by what it is measured by, (n,)."""
    factors = [evaluate(row.coefficients.get(Sym(name, 2), ZERO), subject.values) for name in subject.names]
    return np.array(factors, float) * subject.free.units(subject.coordinates)


def _block(rows: Sequence[Linear], unknown: Sequence[str], sizes: Array) -> tuple[list[Linear], list[str]]:
    """The fewest rows that give as many coordinates, with these; ``sizes`` are their factors in the rows, over those of the rows."""
    for count in range(1, MOST_TOGETHER + 1):
        for chosen in combinations(range(len(rows)), count):
            held = [i for i in range(len(unknown)) if np.abs(sizes[list(chosen), i]).max() > _NOTHING]
            if len(held) == count and np.linalg.matrix_rank(sizes[np.ix_(chosen, held)]) == count:
                return [rows[i] for i in chosen], [unknown[i] for i in held]
    raise TooLarge("loops leave more than one coordinate free; put numbers by set, or ask for numbers")


def _tell(found: Ratios, subject: SymbolicState, block: Sequence[Linear], of: Sequence[str]) -> None:
    """Some coordinates by those before: k_ψ and c_ψ, or a longer stem if the model has such symbols."""
    matrix = [[_plain(row.coefficients.get(Sym(name, 2), ZERO)) for name in of] for row in block]
    for stem, stated in (("k", found.rates), ("c", found.rests)):
        right = []
        for row in block:
            known = [mul(tree, stated[x.name]) for x, tree in row.coefficients.items() if x.name in stated]
            right.append(negative(_plain(add(*known, *([found.moving(row.rest)] if stated is found.rests else [])))))
        for name, tree in zip(of, solve(matrix, right, subject.nomenclature, patience=PATIENCE / 5), strict=True):
            word = stem
            while (symbol := f"{word}_{name}") in subject.nomenclature:
                word += word
            stated[name] = tree if operations(tree) <= _SHORT else Sym(symbol)
            found.named |= {} if operations(tree) <= _SHORT else {Sym(symbol): tree}


def _plain(tree: Tree) -> Tree:
    """With sines of numbers and roots of numbers as numbers, which loops of gears are full of, exactly where they are plain."""
    expression = to_sympy(tree)
    constants = [f for f in expression.atoms(sympy.Function, sympy.Pow) if not f.free_symbols and not f.is_rational]
    return measured(expression.xreplace({f: f.evalf(17) for f in constants})) if constants else tree


def _sum_up(found: Ratios, subject: SymbolicState, put: Put) -> None:
    """The inertia felt and the load."""
    from freebody.equations.topics.lagrange import equations

    names = subject.names
    holding = [Sym(load.symbol) for load in subject.free.loads if load.unknown and load.kind != "motion"]
    gone = dict.fromkeys(holding, ZERO)
    gone |= {Sym(name, 1): ZERO for name in names if subject.at_rest}
    accelerations = [Sym(name, 2) for name in names]
    stated = equations(replaced(subject, at_rest=False))[2]  # the rates are symbols of the kinetic energy
    _require_no_work(found, subject, [linear_in(each.residual, holding) for each in stated], put)
    rows = [coefficients(found.moving(replace(put(each.residual), gone)), accelerations) for each in stated]
    k, c = ([part[name] for name in names] for part in (found.rates, found.rests))
    inertia = [mul(k[i], entry, k[j]) for i, (row, _) in enumerate(rows) for j, entry in enumerate(row)]
    moved = [mul(k[i], entry, c[j]) for i, (row, _) in enumerate(rows) for j, entry in enumerate(row)]
    rests = [mul(k[i], rest) for i, (_, rest) in enumerate(rows)]
    found.inertia = _by_loads(add(*inertia), subject)
    found.load = _by_loads(negative(add(*moved, *rests)), subject)


def _require_no_work(found: Ratios, subject: SymbolicState, equations: Sequence[Linear], put: Put) -> None:
    """Raises ``TooLarge`` where a load of what closes the loops has power in the motion that they leave: by friction that follows from
    it, it stays in the one equation of motion."""
    values = dict(subject.values)
    for x, tree in found.named.items():
        values[x] = float(evaluate(tree, values, subject.tables))
    factors = [float(evaluate(found.rates[name], values, subject.tables)) for name in subject.names]
    for x in dict.fromkeys(x for each in equations for x in each.coefficients):
        own = [float(evaluate(put(each.coefficients.get(x, ZERO)), values, subject.tables)) for each in equations]
        powers = np.multiply(factors, own)
        if abs(powers.sum()) > _NOTHING * np.abs(powers).max():
            raise TooLarge(f"{x.name} has power in the motion that the loops leave, by friction; ask for numbers")


def _by_loads(tree: Tree, subject: SymbolicState) -> Tree:
    return presented(_plain(tree), subject.nomenclature, by_loads=True, patience=PATIENCE / 5)


def blocks(found: Ratios, wanted: Sequence[str], shown: Put) -> list[Block]:
    """The ratios, what they are, the one equation of motion, and the accelerations wanted by that of the free coordinate."""
    rate, acceleration = Sym(found.free, 1), Sym(found.free, 2)
    said: Words = ["Loops leave one coordinate free. With ", Sym(found.free), " all others move, at the rates"]
    made: list[Block] = [Paragraph(said)]
    made += [Equation(Sym(name, 1), shown(mul(k, rate))) for name, k in found.rates.items() if name != found.free]
    made += equations(((x, shown(tree)) for x, tree in found.named.items()), "Where")
    stated = "Lagrange's equations, added up with these factors, contain no load that closes a loop: the reduced inertia is"
    made += [Paragraph(stated), Equation(Written.of(Name("J")), shown(found.inertia))]
    made.append(Equation(mul(Sym("J"), acceleration), shown(found.load), "And with it"))
    return made + equations(((Sym(name, 2), shown(found.acceleration(name))) for name in wanted if name != found.free), "So")
