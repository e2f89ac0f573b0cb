"""Sums as products, by FLINT's factorization of polynomials: SymPy's own draws numbers at random where there are several variables, and
now and then does not end."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from freebody.symbolic.to_sympy import sympy


def factor(expression: Any) -> Any:
    """An expression as one fraction, above and below products of powers of polynomials without factors, and cancelled. Their variables
    are symbols, functions and roots; what has numbers that are not exact stays as it is."""
    parts = [part for factor in sympy.Mul.make_args(sympy.together(expression)) for part in _of_power(factor)]
    number = sympy.Mul(*(part for part in parts if part.is_Number))
    product = sympy.Mul(*(part for part in parts if not part.is_Number))
    # a number times one sum would be multiplied out
    whole = number in (1, -1) or not product.is_Add
    return number * product if whole else sympy.Mul(number, product, evaluate=False)


def _of_power(part: Any) -> Iterator[Any]:
    base, exponent = part.as_base_exp()
    if not base.is_Add:
        yield part
    elif exponent.is_Integer:
        yield from (each**exponent for each in _of_sum(base))
    else:
        yield factor(base) ** exponent


def _of_sum(total: Any) -> Iterator[Any]:
    import flint  # it takes a tenth of a second to load

    try:
        below, polynomial = sympy.Poly(total).clear_denoms(convert=True)
    except sympy.PolynomialError:
        polynomial = None
    if polynomial is None or not polynomial.domain.is_ZZ:
        yield total
        return
    variables = polynomial.gens
    ring = flint.fmpz_mpoly_ctx.get([f"x{i}" for i in range(len(variables))], flint.Ordering.lex)
    number, found = ring.from_dict({powers: int(each) for powers, each in polynomial.terms()}).factor()
    yield sympy.Integer(int(number)) / below
    yield from (_expression(each, variables) ** times for each, times in found)


def _expression(polynomial: Any, variables: tuple[Any, ...]) -> Any:
    terms = {powers: int(each) for powers, each in polynomial.to_dict().items()}
    return sympy.Poly.from_dict(terms, *variables).as_expr()
