"""Small perturbations from rest: the linear equations of the coordinates, and of those that loops and motions leave free."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from freebody.core import Array
from freebody.equations.solve import TooLarge, solve
from freebody.solve.symbolic_state import Row, SymbolicState
from freebody.symbolic.decimals import exact, exact_angle, is_measured, measured, with_exact_numbers
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.linear import linear_in
from freebody.symbolic.presentation import presented
from freebody.symbolic.to_sympy import from_sympy, sympy, to_sympy
from freebody.symbolic.tree import ONE, PI, ZERO, Sym, Tree, is_zero, negative, operations, read, symbols

Matrix = list[list[Tree]]
PATIENCE = 1.0
"""Seconds for the shortest form of one entry."""
MOST_OPERATIONS = 150
"""Operations in an entry above which no short form of it is looked for."""
MOST_IN_ENTRY = 400
"""Operations in an entry above which it is not multiplied out, which would take minutes, or not shown when it is."""
READABLE = 40
"""Operations in the short form of an entry above which it is left to numbers."""
_INDEPENDENT = (0.1, 1e-3, 1e-8)
"""What is left of a row beside those chosen before, in parts of the largest, to be chosen: as much as there is."""


@dataclass(frozen=True)
class Linearised:
    """M ẍ + C ẋ + K x = 0 for perturbations x of the coordinates from rest; ``left`` is what is out of balance there."""

    coordinates: tuple[str, ...]
    mass: Matrix
    damping: Matrix
    stiffness: Matrix
    left: list[Tree]

    def first_order(self) -> Matrix:
        """A of ż = A z with z = (x, ẋ). Raises ``TooLarge``, ``Singular``."""
        n = len(self.coordinates)
        columns = [[row[j] for row in matrix] for matrix in (self.stiffness, self.damping) for j in range(n)]
        solved = [[negative(entry) for entry in solve(self.mass, column, patience=0.0)] for column in columns]
        upper = [[ONE if j == n + i else ZERO for j in range(2 * n)] for i in range(n)]
        return upper + [[column[i] for column in solved] for i in range(n)]


@dataclass(frozen=True)
class Held:
    """Departures of coordinates that depend on each other, J x = 0 (``jacobian``): ``follow`` gives those that follow by the free
    ones. ``reactions`` are the loads of what holds, as they are at rest, ``undecided`` if not all of them are determined;
    ``equations`` those of the free ones, last those of ``laws`` of motions that prescribe an acceleration by places and rates."""

    jacobian: Matrix
    follow: Mapping[str, Sequence[Tree]]
    reactions: Mapping[Sym, Tree]
    undecided: bool
    equations: Linearised
    laws: tuple[str, ...]


def linearised(subject: SymbolicState, put: Mapping[str, Tree]) -> Linearised:
    """The linear equations at the state of a subject, some symbols being as ``put``. Loads of loops and motions stay symbols."""
    stated = replace(subject, at_rest=False).ask([{"ask": "linear", "at": {}}])[0]  # rates must be symbols for their slopes
    names = tuple(subject.names)
    words = zip(*(stated[word] for word in ("M", "C", "K", "left")), strict=True)
    rows = [[_put(read(entry), put) for entry in (*m, *c, *k, left)] for m, c, k, left in words]
    upright = [evaluate(row[i], subject.values, subject.tables) >= 0 for i, row in enumerate(rows)]
    rows = [row if up else [negative(entry) for entry in row] for row, up in zip(rows, upright, strict=True)]
    n = len(names)
    matrices = ([row[start : start + n] for row in rows] for start in (0, n, 2 * n))
    return Linearised(names, *matrices, [row[-1] for row in rows])


def held(subject: SymbolicState, found: Linearised, put: Mapping[str, Tree]) -> Held:
    """What loops, motions and what touches leave of linear equations, the free perturbations being z.

    In x = N z + O(z²) the second order takes no part: it meets the balances, which hold at rest with the reactions λ of rest. These
    stand in K with the slopes of their directions, −Σ λ ∂²g/∂q². With Lᵀ B = 0 for the directions B of the reactions (L = N where
    they do no work) the equations are Lᵀ (M N z̈ + C N ż + K N z) = 0. Raises ``TooLarge``, ``Singular``."""
    names, nomenclature = found.coordinates, subject.nomenclature
    # Laws of places and rates leave these free.
    laws = [
        row
        for row in replace(subject, at_rest=False).rows
        if row.kind == "motion"
        and row.value is None
        and row.rate is None
        and any(x.name in names for x in symbols(row.linear.rest))
    ]
    holding = [row for row in subject.rows if row.name not in {law.name for law in laws}]
    slopes = [[_put(row.linear.coefficients.get(Sym(name, 2), ZERO), put) for name in names] for row in holding]
    loads = [Sym(load.symbol) for load in subject.free.loads if load.unknown]
    parts = [linear_in(left, loads) for left in found.left]
    loads = [x for x in loads if any(x in part.coefficients for part in parts)]
    loading = [[negative(part.coefficients.get(x, ZERO)) for x in loads] for part in parts]
    asked = independent(numbers(subject, slopes).reshape(len(slopes), len(names)))
    follows = independent(numbers(subject, [slopes[i] for i in asked]).reshape(len(asked), len(names)).T, last_first=True)
    chosen = [i for i in range(len(names)) if i not in follows]

    def perturbations(inner: Matrix, outer: Matrix, follows: Sequence[int], chosen: Sequence[int]) -> Matrix:
        """N of J N = 0, a row for each coordinate, from the columns of J that follow and those chosen."""
        columns = [[negative(row[c]) for row in outer] for c in range(len(chosen))]
        solved = [solve(inner, column, nomenclature, patience=PATIENCE) if inner else [] for column in columns]
        return [[column[follows.index(i)] if i in follows else ONE if chosen[c] == i else ZERO for c, column in enumerate(solved)]
                for i in range(len(names))]  # fmt: skip

    ways = perturbations(_part(slopes, asked, follows), _part(slopes, asked, chosen), follows, chosen)
    free = numbers(subject, ways).reshape(len(names), len(chosen))
    laws = [law for law in laws if np.abs(_accelerations(subject, law) @ free).max(initial=0.0) > _INDEPENDENT[-1]]
    bearing = independent(numbers(subject, loading), last_first=True) if laws else follows
    acting = independent(numbers(subject, [loading[i] for i in bearing]).T)
    bare = [i for i in range(len(names)) if i not in bearing]
    inner = _part(loading, bearing, acting)
    turned, others = ([list(column) for column in zip(*part, strict=True)] for part in (inner, _part(loading, bare, acting)))
    tests = perturbations(turned, others, bearing, bare)
    rests = solve(inner, [parts[i].rest for i in bearing], nomenclature, patience=PATIENCE)
    reactions = dict.fromkeys(loads, ZERO) | dict(zip([loads[i] for i in acting], rests, strict=True))
    stiffness = [[_put(entry, {x.name: tree for x, tree in reactions.items()}) for entry in row] for row in found.stiffness]
    balances = [_between(tests, matrix, ways, subject) if bare else [] for matrix in (found.mass, found.damping, stiffness)]
    identity = [[ONE if i == j else ZERO for j in range(len(laws))] for i in range(len(laws))]
    lawful = [_between(identity, [[_slope(law, Sym(name, dots), put) for name in names] for law in laws], ways, subject)
              if laws else [] for dots in (2, 1, 0)]  # fmt: skip
    matrices = ([*above, *below] for above, below in zip(balances, lawful, strict=True))
    equations = Linearised(tuple(names[i] for i in chosen), *matrices, [ZERO] * len(chosen))
    follow, undecided = {names[i]: ways[i] for i in follows}, len(acting) < len(loads)
    return Held([slopes[i] for i in asked], follow, reactions, undecided, equations, tuple(law.name for law in laws))


def _accelerations(subject: SymbolicState, row: Row) -> Array:
    """The factors of all accelerations in a row."""
    return numbers(subject, [[row.linear.coefficients.get(Sym(name, 2), ZERO) for name in subject.names]])[0]


def _slope(row: Row, symbol: Sym, put: Mapping[str, Tree]) -> Tree:
    """How what a row asks changes by a symbol, at rest."""
    expression = to_sympy(with_exact_numbers(row.acceleration))
    slope = expression.diff(sympy.Symbol(symbol.name + "'" * symbol.dots))
    at_rest = {x: 0 for x in slope.free_symbols if x.name.endswith("'")}
    return _put(from_sympy(slope.subs(at_rest)), put)


def place_of(subject: SymbolicState) -> dict[str, Tree]:
    """Where the coordinates of a subject are, as a person writes it, parts of π among them."""
    values = zip(subject.coordinates, subject.q, strict=True)
    return {c["name"]: (exact_angle if c["dimension"] == "rad" else exact)(x) for c, x in values}


def is_natural(place: Tree) -> bool:
    """Whether a place is one whatever the lengths are: 0, or a part of a turn."""
    return is_zero(place) or Sym(PI) in symbols(place)


def numbers(subject: SymbolicState, matrix: Matrix) -> Array:
    """A matrix with the numbers of a subject, SI."""
    return np.array([[float(evaluate(entry, subject.values, subject.tables)) for entry in row] for row in matrix])


def independent(rows: Array, last_first: bool = False) -> list[int]:
    """The places of as many independent rows as there are; early rows are preferred, or late ones, where they do as well."""
    largest = np.linalg.norm(rows, axis=1).max(initial=0.0)
    order = range(len(rows))[::-1] if last_first else range(len(rows))
    chosen: list[int] = []
    basis = np.zeros((0, rows.shape[-1]))
    for enough in _INDEPENDENT:
        for i in order:
            rest = rows[i] - basis.T @ (basis @ rows[i])
            if i not in chosen and np.linalg.norm(rest) > enough * largest:
                chosen.append(i)
                basis = np.vstack([basis, rest / np.linalg.norm(rest)])
    return sorted(chosen)


def _put(tree: Tree, place: Mapping[str, Tree]) -> Tree:
    values = {sympy.Symbol(name): to_sympy(value) for name, value in place.items()}
    given = to_sympy(with_exact_numbers(tree)).subs(values, simultaneous=True)
    if given.count_ops() <= MOST_IN_ENTRY:
        found = measured(given) if is_measured(given) else from_sympy(sympy.factor_terms(sympy.expand(given)))
        if operations(found) <= MOST_IN_ENTRY:
            return found
    raise TooLarge("the linear equations are too long symbolically; set some symbols to numbers")


def _part(matrix: Matrix, rows: Sequence[int], columns: Sequence[int]) -> Matrix:
    return [[matrix[i][j] for j in columns] for i in rows]


def _between(left: Matrix, matrix: Matrix, right: Matrix, subject: SymbolicState) -> Matrix:
    """Leftᵀ matrix right, each entry shortly. Raises ``TooLarge``."""
    a, m, b = (sympy.Matrix([[to_sympy(entry) for entry in row] for row in part]) for part in (left, matrix, right))
    product = a.T * m * b
    if all(entry.count_ops() <= MOST_OPERATIONS for entry in product):
        made = [
            [presented(entry, subject.nomenclature, patience=PATIENCE) for entry in product.row(i)] for i in range(product.rows)
        ]
        if all(operations(entry) <= READABLE for row in made for entry in row):
            return made
    raise TooLarge("the linear equations of what is left free are too long symbolically")
