"""Lagrange's equations, and how they are made of the balances."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from freebody.core import Array
from freebody.document.blocks import Block, Equation, Heading, Paragraph, Words, Written
from freebody.document.document import Document
from freebody.equations.derivation.balance_text import Stated
from freebody.equations.derivation.conserved import energies
from freebody.equations.derivation.coordinates import stated
from freebody.equations.derivation.sentences import joined
from freebody.equations.solve import Singular, TooLarge, Unconfirmed, coefficients, solve
from freebody.equations.topics.common import Asked, document
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.algebra import equal, quotient
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.formula import typed
from freebody.symbolic.linear import linear_in
from freebody.symbolic.tree import ZERO, Add, Num, Sym, Tree, add, is_zero, minus, mul, negative, read, symbols, walk

_MOST_SIGNS = 400
"""Symbols, numbers and operations of an equation and its inertia beyond which its factors are not solved for symbolically."""
_SAMPLES, _NOTHING = 3, 1e-8
_ROUND_OFF = 1e-6
"""Part of the largest term of an equation, whose terms are multiplied out and cancel, that is round-off."""


@dataclass(frozen=True)
class Lagrange:
    """d/dt ∂E_k/∂q̇ − ∂E_k/∂q + ∂E_p/∂q = Q of one coordinate: ``left`` = ``force``; ``momentum`` is ∂E_k/∂q̇."""

    coordinate: str
    momentum: Tree
    left: Tree
    force: Tree

    @property
    def residual(self) -> Tree:
        """left − force."""
        return minus(self.left, self.force)


def equations(subject: SymbolicState) -> tuple[Tree, Tree, list[Lagrange]]:
    """Kinetic and potential energy, and the equation of every coordinate."""
    stated = subject.ask([{"ask": "lagrange"}])[0]
    trees = ("momentum", "left", "force")
    made = [Lagrange(each["coordinate"], *(read(each[word]) for word in trees)) for each in stated["equations"]]
    return read(stated["kinetic"]), read(stated["potential"]), made


def combination(subject: SymbolicState, of: Sequence[Lagrange], balances: Sequence[Stated]) -> list[list[Tree]] | None:
    """Factors S such that equation i is Σ S[i][j] balance j, confirmed at random values; None where none are found symbolically."""
    accelerations = [Sym(name, 2) for name in subject.names]
    inertia = [[balance.balance.linear.coefficients.get(x, ZERO) for x in accelerations] for balance in balances]
    made: list[list[Tree]] = []
    for each in of:
        if row := _plain(each, balances, accelerations):
            made.append(row)
            continue
        if sum(1 for entry in (each.residual, *(x for row in inertia for x in row)) for _ in walk(entry)) > _MOST_SIGNS:
            return None
        own, _ = coefficients(each.residual, accelerations)
        try:
            made.append(solve([list(column) for column in zip(*inertia, strict=True)], own, subject.nomenclature))
        except (TooLarge, Singular, Unconfirmed):
            return None
        sides = (mul(factor, balance.balance.residual) for factor, balance in zip(made[-1], balances, strict=True))
        if not equal(each.residual, add(*sides)):
            return None
    return made


def _plain(each: Lagrange, balances: Sequence[Stated], accelerations: Sequence[Sym]) -> list[Tree] | None:
    """The factors where they are whole numbers, or all but one are 0: numbers tell, and nothing need be solved symbolically."""
    try:
        own = linear_in(each.residual, accelerations).coefficients
    except ValueError:
        return None
    theirs = [balance.balance.linear.coefficients for balance in balances]
    occurring = sorted(symbols(*own.values(), *(tree for row in theirs for tree in row.values())), key=str)

    def factors(seed: int) -> Array:
        """At random values of all symbols."""
        draw = random.Random(seed)
        values = {symbol: draw.uniform(0.3, 1.9) for symbol in occurring}
        rows = [[evaluate(row.get(x, ZERO), values) for x in accelerations] for row in (own, *theirs)]
        return np.linalg.lstsq(np.array(rows[1:], float).T, np.array(rows[0], float), rcond=None)[0]

    seen = np.array(list(map(factors, range(_SAMPLES))))
    present = np.flatnonzero(np.abs(seen).max(axis=0) > _NOTHING)
    row = [Num(Fraction(round(x))) for x in seen[0]]
    if np.abs(seen - np.round(seen[0])).max() > _NOTHING:
        if len(present) != 1:
            return None
        x = next(x for x in own if x in theirs[present[0]] and not is_zero(own[x]))
        row = [quotient(own[x], theirs[i][x]) if i == present[0] else ZERO for i in range(len(balances))]
    sides = [mul(row[i], balances[i].balance.residual) for i in present]
    return row if equal(each.residual, add(*sides)) else None


def lagrange(asked: Asked) -> Document:
    """Energies, Lagrange's equations with generalized forces, and of which balance equations each is made."""
    subject = asked.subject
    kinetic, potential, found = equations(subject)
    left, right = energies(subject)
    made: list[Block] = [Heading("Energies"), Equation(left, kinetic), Equation(right, potential)]
    made += [Heading("Lagrange's equations"), Paragraph(_introduction(subject, left.text, right.text))]
    for each in found:
        rate = subject.symbols.names[each.coordinate]
        momentum = Written(f"∂{left.text}/∂{rate.unicode(1)}", typed("∂", left.formula, "/∂", rate.formula(1)))
        made += [Equation(momentum, each.momentum, ["For ", Sym(each.coordinate)]), Equation(each.left, each.force)]
    made.append(Heading("The same as the balance equations"))
    balances = stated(subject)
    if (factors := combination(subject, found, balances)) is None:
        made.append(Paragraph(_at_state(subject, found)))
    else:
        made += [Paragraph(_sentence(each, row, balances)) for each, row in zip(found, factors, strict=True)]
        made.append(Paragraph("This holds for all values of the symbols; it was checked at random ones."))
    return document(subject, "Lagrange's equations", made)


def _introduction(subject: SymbolicState, kinetic: str, potential: str) -> Words:
    said = (
        f"d/dt ∂{kinetic}/∂q̇ − ∂{kinetic}/∂q + ∂{potential}/∂q = Q for every coordinate q, "
        "where Q is the power of all that has no potential for a unit of q̇."
    )
    if not subject.rows:
        return f"{said} No reaction is in Q: none does work in any motion of the coordinates."
    holding = list(dict.fromkeys(row.name for row in subject.rows))
    return f"{said} The coordinates are not free: what {joined(holding)} exerts is in Q, and unknown."


def _sentence(each: Lagrange, factors: Sequence[Tree], balances: Sequence[Stated]) -> Words:
    said: list[str | Sym | Tree] = ["The equation of ", Sym(each.coordinate), " is "]
    terms = [(factor, balance) for factor, balance in zip(factors, balances, strict=True) if not is_zero(factor)]
    for place, (factor, balance) in enumerate(terms):
        minus_sign = isinstance(factor, Num) and factor.value < 0
        size = negative(factor) if minus_sign else factor
        said.append((" − " if minus_sign else " + ") if place else "− " if minus_sign else "")
        said += [] if size == Num(1) else [size, " × "]
        said.append(balance.title)
    return [*said, "."]


def _at_state(subject: SymbolicState, found: Sequence[Lagrange]) -> str:
    """How far the accelerations and loads of the balances satisfy Lagrange's equations. Raises ``RuntimeError`` where they do not."""
    residuals = [each.residual.terms if isinstance(each.residual, Add) else (each.residual,) for each in found]
    sizes = [[float(evaluate(term, subject.values, subject.tables)) for term in terms] for terms in residuals]
    # What is round-off beside another equation's terms says nothing of its own.
    least = np.finfo(float).eps * max(abs(size) for terms in sizes for size in terms)
    gaps = [abs(sum(terms)) for terms in sizes]
    for each, terms, gap in zip(found, sizes, gaps, strict=True):
        if gap > max(least, _ROUND_OFF * max(map(abs, terms))):
            raise RuntimeError(
                f"Lagrange's equation of {each.coordinate} and the balance equations disagree by {gap:.1e} N or N·m, so "
                "none of them is printed: this is a fault of freebody, please report the model"
            )
    return (
        "How they are made of balance equations is too long to be given symbolically. The accelerations and loads of the balances "
        f"satisfy them at this state to {max(gaps):.1e} N or N·m."
    )
