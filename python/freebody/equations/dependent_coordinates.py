"""Coordinates and rates that follow from others because of what is closed: y = R + d sin φ of a body that rolls."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any

from freebody.equations.derivation.data import Row
from freebody.symbolic.algebra import equal
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.presentation import PATIENCE, presented
from freebody.symbolic.to_sympy import from_sympy, to_sympy
from freebody.symbolic.tree import ZERO, Sym, Tree, operations, replace

MOST_OPERATIONS = 120
"""In what is closed, above which nothing is sought that follows from it."""


def followed(
    rows: Sequence[Row], put: Callable[[Tree], Tree], free: Collection[str], values: Mapping[Sym, float]
) -> dict[Sym, Tree]:
    """Of the coordinates ``free`` to be told by others, those of which a row is linear whatever the rest is, and their rates;
    ``values`` are the numbers at which a factor by which is divided should be large."""
    places = solved([put(row.value) for row in rows if row.value is not None], free, 0, values)
    rates = solved([replace(put(row.rate), places) for row in rows if row.rate is not None], free, 1, values)
    return {x: _shortly(tree) for x, tree in (places | rates).items()}


def solved(given: Sequence[Tree], free: Collection[str], dots: int, values: Mapping[Sym, float]) -> dict[Sym, Tree]:
    """Letters of coordinates, or of their rates, in which expressions that vanish are linear, by the others; one of each."""
    found: dict[Sym, Tree] = {}
    for value in given:
        rest = replace(value, found)
        if operations(rest) > MOST_OPERATIONS or (one := _one(to_sympy(rest), free, dots, values)) is None:
            continue
        letter, tree = one
        found = {x: replace(known, {letter: tree}) for x, known in found.items()} | {letter: tree}
    return found


def vanishing(values: Sequence[Tree], found: Mapping[Sym, Tree]) -> list[bool]:
    """Which of some expressions vanish, whatever the letters are, with what was solved."""
    return [equal(replace(value, found), ZERO) for value in values]


def _one(value: Any, free: Collection[str], dots: int, values: Mapping[Sym, float]) -> tuple[Sym, Tree] | None:
    """The letter with the plainest factor that depends on no place and no rate, and what it is."""
    import sympy

    moving = {sympy.Symbol(name + "'" * n) for name in free for n in (0, 1)}
    asked = sorted(value.free_symbols & {sympy.Symbol(name + "'" * dots) for name in free}, key=str)
    factors = {x: value.diff(x) for x in asked}
    sizes = {x: abs(float(evaluate(from_sympy(factors[x]), values))) for x in asked if not factors[x].free_symbols & moving}
    if not sizes or max(sizes.values()) == 0:
        return None
    chosen = min((x for x in sizes if sizes[x] > 0), key=lambda x: (factors[x].count_ops(), -sizes[x]))
    made = sympy.cancel(sympy.together(-value.subs(chosen, 0) / factors[chosen]))
    return Sym(chosen.name.rstrip("'"), dots), from_sympy(made)


def _shortly(tree: Tree) -> Tree:
    """Without tangents, which are in no balance and would not cancel there."""
    import sympy

    short = to_sympy(presented(tree, patience=PATIENCE / 5))
    return from_sympy(short.replace(sympy.tan, lambda angle: sympy.sin(angle) / sympy.cos(angle)))
