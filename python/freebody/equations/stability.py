"""Symbolic matrices: characteristic polynomial, eigenvalues, and when what they describe is stable."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from freebody.equations.solve import TooLarge, rational_in_symbols
from freebody.symbolic.decimals import is_measured, measured, rational
from freebody.symbolic.factoring import factor
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.presentation import PATIENCE, presented
from freebody.symbolic.to_sympy import sympy, to_sympy
from freebody.symbolic.tree import ONE, ZERO, Mul, Num, Pow, Tree, is_zero, mul, number, power

MOST_OPERATIONS = 80
"""Operations in a characteristic polynomial above which its roots are not sought symbolically."""
MOST_IN_MATRIX = 120
"""Operations in a matrix, or in a polynomial, above which nothing is made of it; those of textbooks have twenty."""
_HALF = Fraction(1, 2)
MOST_ROWS = 4
"""Roots of polynomials of higher order have no symbolic formula."""


@dataclass(frozen=True)
class Eigenvalue:
    """real + i·imaginary, ``count`` times. ``imaginary`` is zero where the value is real, or where the symbols decide whether
    a root in ``real`` is of something positive."""

    real: Tree
    imaginary: Tree
    count: int = 1


@dataclass(frozen=True)
class Stability:
    """When a linear motion is stable: each of ``conditions`` is positive.

    ``kind`` is ``decays`` (all eigenvalues have negative real parts), or ``oscillates`` (without damping: the eigenvalues come
    as ±s, and are all imaginary and distinct). ``never`` if one of the conditions cannot hold."""

    kind: str
    conditions: tuple[Tree, ...]
    never: bool = False


def characteristic(matrix: Sequence[Sequence[Tree]], nomenclature: Nomenclature | None = None) -> list[Tree]:
    """The coefficients of det(s I − A), that of the highest power, 1, first. Raises ``TooLarge``."""
    found = _polynomial(matrix, ()).all_coeffs()
    _require_brief(found, "the characteristic polynomial")
    return [presented(factor, nomenclature, patience=PATIENCE) for factor in found]


def factors(polynomial: Sequence[Tree], nomenclature: Nomenclature | None = None) -> list[tuple[list[Tree], int]]:
    """The factors of a polynomial, each by its coefficients, the first being 1, and how often it is there; roots of 0 first.

    With measured numbers only the roots of 0 are taken out."""
    zeros = next(i for i, factor in enumerate(reversed(polynomial)) if not is_zero(factor))
    rest = list(polynomial[: len(polynomial) - zeros])
    made = [([ONE, ZERO], zeros)] if zeros else []
    if len(rest) == 1:
        return made
    expressions = [to_sympy(factor) for factor in rest]
    if any(map(is_measured, expressions)):
        return [*made, (rest, 1)]
    s = sympy.Dummy("s")
    above, _ = sympy.fraction(sympy.together(sympy.Poly(expressions, s).as_expr()))
    powers = (part.as_base_exp() for part in sympy.Mul.make_args(factor(above)) if part.has(s))
    found = [(sympy.Poly(base, s), int(count)) for base, count in powers]
    return made + [
        ([presented(c / p.LC(), nomenclature, patience=PATIENCE) for c in p.all_coeffs()], count) for p, count in found
    ]


def eigenvalues(
    matrix: Sequence[Sequence[Tree]], nomenclature: Nomenclature | None = None, *, positive: Collection[str] = ()
) -> list[Eigenvalue]:
    """The symbolic eigenvalues, all symbols being real and those named ``positive`` positive.

    At most 4 rows, and of cubic and quartic polynomials only those that factor or have only even powers; else ``TooLarge``."""
    polynomial = _polynomial(matrix, positive)
    if sum(factor.count_ops() for factor in polynomial.all_coeffs()) > MOST_OPERATIONS:
        raise TooLarge("the characteristic polynomial is too long for its roots symbolically; set some symbols to numbers")
    given: dict[Any, Any] = {}
    if any(map(is_measured, polynomial.all_coeffs())):  # whose common factors round-off hides: each is as good as a symbol
        given = {sympy.Dummy(real=True): factor for factor in polynomial.all_coeffs()[1:] if factor != 0}
        named = {factor: symbol for symbol, factor in given.items()}
        polynomial = sympy.Poly([named.get(factor, factor) for factor in polynomial.all_coeffs()], polynomial.gen)
    found = sympy.roots(polynomial, cubics=False, quartics=False)
    if sum(found.values()) != polynomial.degree():
        raise TooLarge("these eigenvalues have no short symbolic form; put numbers, or ask for the stability conditions")
    made = [_eigenvalue(root.xreplace(given), count, nomenclature) for root, count in found.items()]
    return sorted(made, key=lambda value: (str(value.imaginary), str(value.real)))


def stability(
    coefficients: Sequence[Tree],
    nomenclature: Nomenclature | None = None,
    *,
    positive: Collection[str] = (),
    symmetric: bool = False,
) -> Stability:
    """When all roots of a polynomial (highest power first, its coefficient positive, order 1 to 4) lie to the left: Routh–Hurwitz.

    A polynomial with only even powers has no damping; then it is when all roots are imaginary and distinct. Where it comes from
    ``symmetric`` matrices M and K alone s² is real and equal roots have directions of their own, so they need not be distinct.
    Conditions that hold because the symbols named ``positive`` are so are left out. Gantmacher, *Theory of Matrices* II, XV §6."""
    order = len(coefficients) - 1
    if not 1 <= order <= MOST_ROWS:
        raise TooLarge(f"symbolic stability conditions are for polynomials of order 1 to {MOST_ROWS}, not {order}")
    a = [to_sympy(factor, positive=positive, real=True) for factor in coefficients]
    _require_brief(a, "the stability conditions")
    even = order % 2 == 0 and all(is_zero(factor) for factor in coefficients[1::2])
    left = _conditions(a, even)[: 2 if even and symmetric else None]
    kept = [found for condition in left if (found := _reduced(condition)) is not None]
    never = any(condition.is_nonpositive for condition in kept)
    shown = tuple(dict.fromkeys(presented(condition, nomenclature, patience=PATIENCE) for condition in kept))
    return Stability("oscillates" if even else "decays", shown, never)


def _conditions(a: Sequence[Any], even: bool) -> list[Any]:
    """Hurwitz's; of a polynomial in z = s² with all roots real, negative and distinct where it has only ``even`` powers."""
    match a:
        case [a1, a0]:
            return [a1 * a0]
        case [a2, _, a0] if even:
            return [a0 / a2]
        case [a2, a1, a0]:
            return [a1 / a2, a0 / a2]
        case [a3, a2, a1, a0]:
            return [a2 / a3, a0 / a3, (a2 * a1 - a3 * a0) / a3**2]
        case [a4, _, a2, _, a0] if even:
            return [a2 / a4, a0 / a4, (a2**2 - 4 * a4 * a0) / a4**2]
        case [a4, a3, a2, a1, a0]:
            return [a3 / a4, a0 / a4, (a3 * a2 - a4 * a1) / a4**2, (a1 * (a3 * a2 - a4 * a1) - a3**2 * a0) / a4**3]
    raise AssertionError("the order was checked")


def _reduced(condition: Any) -> Any:
    """The condition without factors that are positive; None if it holds."""
    rest = sympy.S.One
    for each in sympy.Mul.make_args(factor(condition)):
        if each.is_number:
            rest *= sympy.sign(each)
        elif not each.is_positive:  # an odd power has the sign of its base
            rest *= each.base if each.is_Pow and each.exp.is_Integer and each.exp % 2 else each
    return None if rest.is_positive else rest


def _require_brief(expressions: Iterable[Any], what: str) -> None:
    if sum(each.count_ops() for each in expressions) > MOST_IN_MATRIX:
        raise TooLarge(f"{what} would fill pages; put numbers")


def require_few(rows: int) -> None:
    """Raises ``TooLarge`` for a matrix of more rows than have symbolic eigenvalues."""
    if rows > MOST_ROWS:
        raise TooLarge(f"symbolic eigenvalues are for at most {MOST_ROWS} rows, not {rows}; put numbers")


def _polynomial(matrix: Sequence[Sequence[Tree]], positive: Collection[str]) -> Any:
    require_few(len(matrix))
    entries = sympy.Matrix([[to_sympy(entry, positive=positive, real=True) for entry in row] for row in matrix])
    _require_brief(entries, "the characteristic polynomial")
    rounded = is_measured(entries)
    shared, (plain,) = rational_in_symbols(entries.applyfunc(rational) if rounded else entries)
    polynomial, back = plain.charpoly(sympy.Dummy("s")), {new: old for old, new in shared.items()}

    def short(coefficient: Any) -> Any:
        """In factors; with measured numbers as one sum over another, since round-off hides what it has in common."""
        return to_sympy(measured(coefficient), positive=positive, real=True) if rounded else factor(coefficient)

    return sympy.Poly([short(coefficient.xreplace(back)) for coefficient in polynomial.all_coeffs()], polynomial.gen)


def _eigenvalue(root: Any, count: int, nomenclature: Nomenclature | None) -> Eigenvalue:
    real, imaginary = sympy.expand_complex(root).as_real_imag() if not root.has(sympy.Pow) else root.as_real_imag()
    if any(part.has(sympy.re, sympy.im, sympy.arg, sympy.atan2) for part in (real, imaginary)):
        real, imaginary = _apart(root)
    parts = (
        _one_root(presented(sympy.radsimp(_simplified(part)), nomenclature, patience=PATIENCE)) for part in (real, imaginary)
    )
    return Eigenvalue(*parts, count)


def _apart(root: Any) -> tuple[Any, Any]:
    """Real and imaginary part of a root of which SymPy cannot tell them: (0, ± b) if its square is −b², else as it is."""
    square = _simplified(sympy.expand(-(root**2)))
    if not square.is_positive:
        return root, sympy.S.Zero
    upward = complex(root.subs(dict.fromkeys(root.free_symbols, 1))).imag > 0
    return sympy.S.Zero, sympy.sqrt(square) if upward else -sympy.sqrt(square)


def _simplified(expression: Any) -> Any:
    """By SymPy, but as it is with measured numbers: round-off hides what they have in common, and SymPy looks for it without end."""
    return expression if is_measured(expression) else sympy.simplify(expression)


def _one_root(tree: Tree) -> Tree:
    """√k/√m as √(k/m), ½ √(2 k/m) as √(k/(2 m)): under all roots stands something positive."""
    if not isinstance(tree, Mul):
        return tree
    roots = [f for f in tree.factors if isinstance(f, Pow) and abs(f.exponent) == _HALF]
    under = mul(*(power(f.base, 2 * f.exponent) for f in roots))
    size, rest = _front(mul(*(f for f in tree.factors if f not in roots)))
    inner, nomenclature = _front(under)
    if not roots or (len(roots) == 1 and inner == 1):
        return tree
    sign = 1 if size > 0 else -1
    return mul(number(sign), rest, power(mul(number(size**2 * inner), nomenclature), _HALF))


def _front(tree: Tree) -> tuple[Fraction, Tree]:
    """The exact number in front of a product, and what follows it."""
    factors = tree.factors if isinstance(tree, Mul) else (tree,)
    if isinstance(factors[0], Num) and isinstance(factors[0].value, Fraction):
        return factors[0].value, mul(*factors[1:])
    return Fraction(1), tree
