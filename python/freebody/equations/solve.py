"""Symbolic answers: small linear systems solved, limits, coefficients."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from freebody.symbolic.algebra import equal
from freebody.symbolic.decimals import is_measured, ratio, rational
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.presentation import PATIENCE, presented
from freebody.symbolic.to_sympy import from_sympy, sympy, to_sympy
from freebody.symbolic.tree import MINUS_ONE, Sym, Tree, add, minus, mul, symbols

MOST_UNKNOWNS = 6
"""Above it a symbolic answer is too long to be read."""
MOST_OPERATIONS = 1500
"""Operations in all coefficients above which no answer symbolically is sought."""
MOST_TOGETHER = 16
"""Symbols, sines and roots in three or more equations above which their elimination does not end; in textbooks there are twelve."""

_UNDETERMINED = "the equations do not determine the unknowns, whatever the symbols are"


class TooLarge(ValueError):
    """A symbolic answer would be too long to read; the sentence says what to do instead."""


class Unconfirmed(ArithmeticError, ValueError):
    """A symbolic answer that numbers which share nothing with it do not bear out, so that it is not given."""


class Singular(ValueError):
    """The equations do not determine the unknowns."""


def solve(
    matrix: Sequence[Sequence[Tree]],
    right: Sequence[Tree],
    nomenclature: Nomenclature | None = None,
    *,
    patience: float = PATIENCE,
    most: float = math.inf,
) -> list[Tree]:
    """The solution x of A x = b symbolically, each entry in the shortest form found.

    ``patience`` is in seconds for each entry. ``TooLarge`` are more than 6 unknowns, unless coefficients are measured numbers, and then determinants of more than
    ``most`` operations; a matrix that is singular for all values of the symbols is ``Singular``. The solution is held against the system at random values."""
    if any(len(row) != len(right) for row in (matrix, *matrix)):
        raise ValueError("A x = b needs as many equations as unknowns")

    a = sympy.Matrix([[to_sympy(entry) for entry in row] for row in matrix])
    b = sympy.Matrix([to_sympy(entry) for entry in right])
    numeric = is_measured(a) or is_measured(b)
    if len(right) > MOST_UNKNOWNS and not numeric:
        many = f"{len(right)} unknowns are too many for a symbolic answer (at most {MOST_UNKNOWNS})"
        raise TooLarge(f"{many}; ask for numbers, or for a smaller set of equations")
    found = (
        _solved_measured(a, b, most)
        if numeric
        else [presented(entry, nomenclature, patience=patience) for entry in _solved(a, b)]
    )
    if not all(equal(add(*map(mul, row, found)), entry) for row, entry in zip(matrix, right, strict=True)):
        raise Unconfirmed("the symbolic answer does not satisfy the equations at random values; take the numbers instead")
    return found


def solve_equations(
    equations: Sequence[tuple[Tree, Tree]],
    unknowns: Sequence[Sym],
    nomenclature: Nomenclature | None = None,
    *,
    patience: float = PATIENCE,
) -> dict[Sym, Tree]:
    """The unknowns from equations left = right that are linear in them."""
    matrix, right = linear_system(equations, unknowns)
    return dict(zip(unknowns, solve(matrix, right, nomenclature, patience=patience), strict=True))


def linear_system(equations: Sequence[tuple[Tree, Tree]], unknowns: Sequence[Sym]) -> tuple[list[list[Tree]], list[Tree]]:
    """A and b of A x = b from equations left = right; ``ValueError`` names an equation that is not linear."""
    rows = [coefficients(minus(left, right), unknowns) for left, right in equations]
    return [row for row, _ in rows], [mul(MINUS_ONE, rest) for _, rest in rows]


def coefficients(tree: Tree, unknowns: Sequence[Sym]) -> tuple[list[Tree], Tree]:
    """The factors of the unknowns in a linear expression, and what is left without them."""
    names = [to_sympy(unknown) for unknown in unknowns]
    expanded = sympy.expand(to_sympy(tree))
    factors = [expanded.diff(name) for name in names]
    for unknown, factor in zip(unknowns, factors, strict=True):
        if factor.free_symbols & set(names):
            raise ValueError(f"the expression is not linear in {unknown.name}; ask for numbers, or linearise it first")
    rest = expanded.subs(dict.fromkeys(names, 0))
    return [from_sympy(sympy.factor_terms(factor)) for factor in factors], from_sympy(rest)


def limit(tree: Tree, symbol: str, to: float | Fraction = 0, nomenclature: Nomenclature | None = None) -> Tree:
    """The limit as a symbol goes to a value (from above) or to infinity, the other symbols being positive.

    An infinite limit is the number ``inf``."""
    names = {symbol.name for symbol in symbols(tree) if not symbol.dots}
    expression = to_sympy(tree, positive=names, real=True)
    target = sympy.oo if to == float("inf") else -sympy.oo if to == -float("inf") else sympy.nsimplify(to)
    found = sympy.limit(expression, sympy.Symbol(symbol, positive=True), target, "+")
    if found.has(sympy.AccumBounds):
        raise ValueError(f"there is no limit for {symbol} to {to}: it goes to and fro without end; put a number for {symbol}")
    if isinstance(found, sympy.Limit) or found.has(sympy.nan):
        raise ValueError(f"no symbolic limit was found for {symbol} to {to}; set some symbols to numbers")
    return from_sympy(found) if found.is_infinite else presented(found, nomenclature, patience=PATIENCE)


def substitute(tree: Tree, values: Mapping[str, Tree], nomenclature: Nomenclature | None = None) -> Tree:
    """The expression at given values of symbols, in the shortest form found: θ = π/4, m₂ = m₁."""
    chosen = {sympy.Symbol(name): to_sympy(value) for name, value in values.items()}
    return presented(to_sympy(tree).subs(chosen, simultaneous=True), nomenclature, patience=PATIENCE)


def _solved(a: Any, b: Any) -> list[Any]:
    """By exact elimination over the rational functions of the symbols, sines and cosines."""
    if sum(entry.count_ops() for entry in (*a, *b)) > MOST_OPERATIONS:
        raise TooLarge("the equations are too long for a symbolic answer; set some symbols to numbers")
    shared, (a, b) = rational_in_symbols(a, b)
    if a.rows > 2 and len(a.free_symbols | b.free_symbols) > MOST_TOGETHER:
        raise TooLarge(f"{a.rows} equations together hold too many symbols for a symbolic answer; ask for numbers")
    joined = sympy.polys.matrices.DomainMatrix.from_Matrix(a.row_join(b)).to_field()
    try:
        solution = joined[:, :-1].lu_solve(joined[:, -1:])
    except sympy.polys.matrices.exceptions.DMNonInvertibleMatrixError:
        raise Singular(_UNDETERMINED) from None
    back = {new: old for old, new in shared.items()}
    return [entry.xreplace(back) for entry in solution.to_Matrix()]


def _solved_measured(a: Any, b: Any, most: float) -> list[Tree]:
    """The same with measured numbers: determinants, whose common factors are not looked for, as round-off hides them."""
    shared, (a, b) = rational_in_symbols(a.applyfunc(rational), b.applyfunc(rational))
    joined = sympy.polys.matrices.DomainMatrix.from_Matrix(a.row_join(b)).to_dense()
    n, back = a.rows, {new: old for old, new in shared.items()}

    def determinant(columns: list[int]) -> Any:
        found = joined.domain.to_sympy(joined.extract(list(range(n)), columns).charpoly()[-1] * (-1) ** n)
        if found.count_ops() > most:
            raise TooLarge("the symbolic answer would be too long to read")
        return found.xreplace(back)

    below = determinant(list(range(n)))
    if below == 0:
        raise Singular(_UNDETERMINED)
    return [ratio(determinant([n if j == i else j for j in range(n)]), below) for i in range(n)]


def rational_in_symbols(*matrices: Any) -> tuple[dict, list[Any]]:
    """SymPy's matrices with functions and roots replaced by symbols of their own, so that the entries are rational."""
    atoms = {atom for matrix in matrices for atom in matrix.atoms(sympy.Function, sympy.Pow)}
    found = {atom for atom in atoms if not (atom.is_Pow and atom.exp.is_Integer)}
    outer = sorted(found, key=lambda f: (-f.count_ops(), str(f)))
    shared = {function: sympy.Symbol(f"_{place}") for place, function in enumerate(outer)}
    return shared, [matrix.xreplace(shared) for matrix in matrices]
