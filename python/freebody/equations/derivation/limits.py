"""What is left of equations as a parameter vanishes, or grows without end, each equation by itself."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from freebody.document.blocks import Block, Equation, Heading, Paragraph
from freebody.equations.derivation.balance_text import Stated
from freebody.equations.derivation.form import Printed
from freebody.equations.derivation.plain_rows import below, on_sides, times
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.algebra import quotient, signed, spread
from freebody.symbolic.presentation import presented
from freebody.symbolic.tree import Add, Mul, Pow, Sym, Tree, add, number, power, replace, symbols


def section(subject: SymbolicState, equations: Sequence[Printed | Stated], limits: Mapping[str, str]) -> list[Block]:
    """Every equation in each limit, to ``inf``, 0 or a number in SI: of what it holds the terms that are largest there; divided by the
    power of the symbol that they have, so that a length may vanish. Raises ``ValueError``."""
    known = subject.nomenclature.of_kind("parameter", "constant")
    made: list[Block] = [Heading("Limits")] if limits else []
    for name, to in limits.items():
        if name not in known:
            raise ValueError(f"{name!r} has no limit, as it is no parameter; there are {', '.join(known)}")
        goes = [Sym(name), f" → {'∞' if str(to) == 'inf' else to}"]
        for i, each in enumerate(equations, 1):
            if Sym(name) not in symbols(each.residual):
                made.append(Paragraph([f"({i}), {each.title}, stays as it is as ", *goes, "."]))
                continue
            left, right = on_sides(signed(_at(each, name, to), subject.constants))
            made.append(Equation(presented(left), presented(right), [f"({i}), {each.title}, as ", *goes]))
    return made


def _at(equation: Printed | Stated, name: str, to: str) -> Tree:
    """What vanishes in the limit."""
    symbol = Sym(name)
    if str(to) not in ("inf", "0"):
        try:
            return replace(equation.residual, {symbol: number(Fraction(str(to)))})
        except ValueError:
            raise ValueError(f"{name} cannot go to {to!r}; give 0, a positive number in SI, or inf") from None
    whole = spread(times(equation.residual, below([equation.residual], lambda part: symbol in symbols(part))))
    terms = whole.terms if isinstance(whole, Add) else (whole,)
    exponents = [_exponent(term, symbol, equation.title) for term in terms]
    leading = max(exponents) if str(to) == "inf" else min(exponents)
    kept = (term for term, exponent in zip(terms, exponents, strict=True) if exponent == leading)
    return add(*(quotient(term, power(symbol, leading)) for term in kept))


def _exponent(term: Tree, symbol: Sym, title: str) -> Fraction:
    """The power of a symbol in a product. Raises ``ValueError`` where it is in a function or a root of a sum."""
    found = Fraction(0)
    for factor in term.factors if isinstance(term, Mul) else (term,):
        base, exponent = (factor.base, factor.exponent) if isinstance(factor, Pow) else (factor, Fraction(1))
        if base == symbol:
            found += exponent
        elif symbol in symbols(base):
            what = f"{title} holds {symbol.name} in a function, so that its limit is not one of its terms"
            raise ValueError(f"{what}; take form solved, or put a number for {symbol.name}")
    return found
