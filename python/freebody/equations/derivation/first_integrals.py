"""First integrals besides the energy and the momenta that nothing changes: of what a known force changes evenly, and of what moves
relative to prescribed motions and to coordinates that only their accelerations matter of (Jacobi's integral; Routh).

Both are read off Lagrange's equations R = 0 of the coordinates that no motion holds, linear in the accelerations: R = M q̈ + b(q, q̇, t).
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import Array, quote
from freebody.equations.derivation.sentences import joined
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.evaluate import sampled
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.presentation import presented
from freebody.symbolic.printers.text import text
from freebody.symbolic.symbols import unicode_name
from freebody.symbolic.to_sympy import from_sympy, sympy, to_sympy
from freebody.symbolic.tree import Sym, Tree, is_zero, operations, read, symbols

if TYPE_CHECKING:
    from freebody.run.simulation import Run

_MOST = 400
"""Operations in the equations of one mechanism above which no first integral is looked for."""
_MOST_FREE = 3
"""Coordinates that no motion holds, at most."""
_PLACES, _ROUND_OFF = 6, 1e-9
"""At which a force is tried, and the share by which it varies at least if it does."""


@dataclass(frozen=True)
class FirstIntegral:
    """A ``quantity`` of coordinates, rates and time that stays constant; ``words`` say what it is, ``reason`` why it stays, and
    ``letter`` is what it is usually called; ``numbers`` are those of the model without a name."""

    words: str
    quantity: Tree
    reason: str
    letter: str
    numbers: Mapping[str, float]

    def along(self, run: Run) -> Array:
        """Its values (nt,) over a motion of the model."""
        values = {}
        for x in symbols(self.quantity):
            known = x.name in self.numbers
            values[x.key] = (
                np.full(len(run.t), self.numbers[x.name]) if known else run[("rate(" * x.dots) + quote(x.name) + ")" * x.dots]
            )
        return sampled(self.quantity, values)

    def stated(self, nomenclature: Nomenclature | None = None) -> str:
        """The quantity as text."""
        return text(self.quantity, nomenclature)


def first_integrals(subject: SymbolicState) -> list[FirstIntegral]:
    """All that are found; none where the mechanism has loops, closed contacts, friction, loads without potential, or is too large."""
    free = _free(subject)
    if free is None:
        return []
    names, equations, held = free
    return [*_evenly_changed(subject, names, equations), *_relative(subject, names, equations, held)]


Equations = dict[str, tuple[Any, Any]]
"""Of each coordinate that no motion holds: its momentum ∂E_k/∂q̇, and R, as SymPy has them."""


def _free(subject: SymbolicState) -> tuple[list[str], Equations, dict[str, Any]] | None:
    """The coordinates that no motion holds, their equations with the prescribed accelerations put in, and these."""
    if any(row.kind != "motion" for row in subject.rows) or subject.laws:
        return None
    if not 0 < len(subject.names) - len(subject.rows) <= _MOST_FREE:
        return None
    stated, held = subject.ask([{"ask": "lagrange"}])[0], dict[str, Any]()
    for row in subject.rows:
        moved = [x for x in row.linear.coefficients if not is_zero(row.linear.coefficients[x])]
        if len(moved) != 1 or moved[0].dots != 2:
            return None
        symbol = to_sympy(moved[0])
        held[moved[0].name] = sympy.solve(to_sympy(row.acceleration), symbol)[0]
    each = {e["coordinate"]: e for e in stated["equations"] if e["coordinate"] not in held}
    sizes = sum(operations(read(e["left"])) for e in each.values())
    if sizes > _MOST or any(not is_zero(read(e["force"])) for e in each.values()):
        return None
    prescribed = {_symbol(name, 2): acceleration for name, acceleration in held.items()}
    equations = {
        name: (to_sympy(read(e["momentum"])), sympy.expand(to_sympy(read(e["left"])).subs(prescribed)))
        for name, e in each.items()
    }
    return list(each), equations, held


def _numbers(subject: SymbolicState) -> dict[str, float]:
    return {name: entry["value"] for name, entry in subject.table.items() if entry["kind"] == "number"}


def _symbol(name: str, dots: int = 0) -> Any:
    return to_sympy(Sym(name, dots))


def _evenly_changed(subject: SymbolicState, names: Sequence[str], equations: Equations) -> list[FirstIntegral]:
    """Momenta of coordinates whose force ∂L/∂q is a number of the model."""
    found = []
    numbers = _numbers(subject)
    states = {_symbol(c, dots) for c in subject.names for dots in range(3)} | {_symbol("t")}
    for name in names:
        momentum, equation = equations[name]
        change = sum(momentum.diff(_symbol(c, d)) * _symbol(c, d + 1) for c in subject.names for d in (0, 1))
        if _varies(change - equation, states):
            continue
        force = sympy.simplify(change - equation)
        if force != 0 and not force.free_symbols & states and not momentum.has(_symbol("t")):
            words = f"momentum of {unicode_name(name)}, less what its force gives it"
            reason = f"{unicode_name(name)} itself is in no energy but by a force that does not change"
            found.append(FirstIntegral(words, _tree(momentum - force * _symbol("t")), reason, "p", numbers))
    return found


def _varies(expression: Any, states: Collection[Any]) -> bool:
    """Whether an expression has other values at other places, which is known at once, while to simplify it takes seconds."""
    tree, rng = from_sympy(expression), np.random.default_rng(1)
    drawn = {x.key: rng.uniform(0.5, 1.5, _PLACES if to_sympy(x) in states else 1) * np.ones(_PLACES) for x in symbols(tree)}
    values = sampled(tree, drawn)
    return bool(np.ptp(values) > _ROUND_OFF * np.abs(values).max(initial=1.0))


def _relative(subject: SymbolicState, names: Sequence[str], equations: Equations, held: dict[str, Any]) -> list[FirstIntegral]:
    """½ q̇ᵀ M q̇ + W, where what is left of the equations at rest is ∂W/∂q, and time is in none of them."""
    out = [name for name in names if all(not {_symbol(name), _symbol(name, 1)} & e.free_symbols for _, e in equations.values())]
    moving = [name for name in names if name not in out]
    if not moving or not (held or out):
        return []
    residuals = _without(out, {name: equation for name, (_, equation) in equations.items()})
    accelerations = [_symbol(name, 2) for name in moving]
    gone = {_symbol("t"), *(_symbol(name) for name in held)}
    gone |= {_symbol(name, 1) for name, acceleration in held.items() if sympy.simplify(acceleration) != 0}
    rest = {_symbol(name, dots): 0 for name in moving for dots in (1, 2)}
    mass = [[sympy.simplify(residuals[name].diff(a)) for a in accelerations] for name in moving]
    forces = [sympy.simplify(residuals[name].subs(rest)) for name in moving]
    if any(tree.free_symbols & gone for tree in (*forces, *(entry for row in mass for entry in row))):
        return []
    stored = sympy.Integer(0)
    for name, force in zip(moving, forces, strict=True):
        stored += sympy.integrate(sympy.simplify(force - stored.diff(_symbol(name))), _symbol(name))
    rates = [_symbol(name, 1) for name in moving]
    kinetic = sum(m * a * b for row, a in zip(mass, rates, strict=True) for m, b in zip(row, rates, strict=True)) / 2
    whole = kinetic + stored
    change = sum(whole.diff(_symbol(n)) * _symbol(n, 1) + whole.diff(_symbol(n, 1)) * _symbol(n, 2) for n in moving) - sum(
        residuals[name] * rate for name, rate in zip(moving, rates, strict=True)
    )
    if whole.has(sympy.Integral) or sympy.simplify(change) != 0:
        return []
    beside = joined([unicode_name(name) for name in (*held, *out)])
    numbers = _numbers(subject)
    reason = f"neither time nor {beside} is in the equations of {joined([unicode_name(name) for name in moving])}"
    return [
        FirstIntegral(
            f"energy of the motion relative to {beside}" + " (Jacobi's integral)" * bool(held), _tree(whole), reason, "h", numbers
        )
    ]


def _without(out: Sequence[str], residuals: dict[str, Any]) -> dict[str, Any]:
    """The equations of the other coordinates, when those of ``out`` have given their accelerations."""
    if not out:
        return residuals
    accelerations = sympy.solve([residuals[name] for name in out], [_symbol(name, 2) for name in out], dict=True)[0]
    return {name: sympy.expand(e.subs(accelerations)) for name, e in residuals.items() if name not in out}


def _tree(expression: Any) -> Tree:
    return presented(from_sympy(sympy.factor_terms(sympy.simplify(expression))))
