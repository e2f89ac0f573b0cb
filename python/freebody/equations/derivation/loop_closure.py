"""Loops, prescribed motions and closed limits: their equations at the levels of position, velocity and acceleration."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from freebody.document.blocks import Block, Equation, Heading, MatrixEquation, Paragraph, equations
from freebody.equations.derivation.form import Printed, System
from freebody.equations.derivation.sentences import clause, joined
from freebody.solve.symbolic_state import Row
from freebody.symbolic.algebra import common_number, divided
from freebody.symbolic.linear import Linear, linear_in
from freebody.symbolic.tree import ONE, ZERO, Add, Sym, add, is_negative, mul, negative, symbols

_WHAT = {
    "joint": ("closes a loop", "close loops"), "motion": ("is prescribed", "are prescribed"),
    "coupling": ("couples motions", "couple motions"), "lock": ("holds", "hold"), "contact": ("holds", "hold"), "string": ("is taut", "are taut"),
    "non-holonomic": ("constrains rates only", "constrain rates only"), "stop": ("is at its end", "are at their end"), "friction": ("sticks", "stick"),
}  # fmt: skip
_HELD = ("contact", "string", "stop", "friction")
_STUCK = ("holds and does not slide", "hold and do not slide")
_TITLES = {
    "Loop closure": {"joint"}, "constraints on rates": {"non-holonomic"}, "couplings": {"coupling"}, "locks": {"lock"},
    "contacts": {*_HELD}, "prescribed motions": {"motion"},
}  # fmt: skip


def section(rows: Sequence[Row], coordinates: Sequence[str], everywhere: bool = False) -> list[Block]:
    """The rows at all levels, the derivatives as matrix equations; ``everywhere``: every joint has rows, not those of loops only."""
    made: list[Block] = [Heading("Constraints" if everywhere else title(rows)), Paragraph(_why(rows, everywhere))]
    rows = written(rows)
    held, moving = ([row for row in rows if getattr(row, level) is not None] for level in ("value", "rate"))
    made += equations(((row.value, ZERO) for row in held), "For the positions")
    try:
        found = [linear_in(row.rate, [Sym(name, 1) for name in coordinates]) for row in moving]
        slopes = [{Sym(x.name, 1): tree for x, tree in row.linear.coefficients.items() if x.dots == 2} for row in moving]
        rates = System.of([Linear(own, each.rest) for own, each in zip(slopes, found, strict=True)], coordinates)
        made += _together(rates, "Differentiated, for the velocities" if held else "For the velocities")
    except ValueError:  # some are not linear in the rates
        made += equations(((row.rate, ZERO) for row in moving), "Their rates")
    name = "Differentiated once more, for the accelerations" if moving else "For the accelerations"
    return made + accelerations(rows, coordinates, name)


def title(rows: Sequence[Row]) -> str:
    """Loops, motions, and what touches, as far as there are any."""
    said = joined([name for name, kinds in _TITLES.items() if kinds & {row.kind for row in rows}])
    return said[0].upper() + said[1:]


def accelerations(rows: Sequence[Row], coordinates: Sequence[str], name: str = "") -> list[Block]:
    """Rows, as they are written, at the level of accelerations."""
    return _together(System.of([row.linear for row in rows], coordinates), name)


def _together(system: System, name: str) -> list[Block]:
    """Several equations as a matrix equation, one as it is."""
    if not system.unknowns:
        return []
    if len(system.matrix) > 1:
        return [MatrixEquation(system.matrix, system.unknowns, system.right, name, letter="J")]
    return [Equation(add(*map(mul, system.matrix[0], system.unknowns)), system.right[0], name)]


def printed(rows: Sequence[Row]) -> list[Printed]:
    """The rows at the level of accelerations, as equations among the others."""
    return [Printed(f"acceleration at {row.name}", row.acceleration, ZERO, row.linear) for row in written(rows)]


def written(rows: Sequence[Row]) -> list[Row]:
    """The rows as a person writes them: without those that say nothing, without numbers that all terms have in common (0.03 cos(π/9)
    of the teeth of two gears), and with signs by which most terms with coordinates are positive."""
    made = []
    for row in (row for row in rows if not row.says_nothing):
        if (common := common_number([*row.linear.coefficients.values(), row.linear.rest])) != ONE:
            row = row.with_trees(lambda tree, by=common: divided(tree, by))
        tree = next(tree for tree in (row.value, row.rate, row.acceleration) if tree is not None)
        signs = [
            is_negative(part)
            for part in (tree.terms if isinstance(tree, Add) else (tree,))
            if _names(row) & {x.name for x in symbols(part)}
        ]
        made.append(row.with_trees(negative) if 2 * sum(signs) > len(signs) else row)
    return made


def _why(rows: Sequence[Row], everywhere: bool) -> str:
    """What the rows are, how many equations, which have none for the positions where others have, and which say nothing."""
    number = sum(not row.says_nothing for row in rows)
    said = f"{what(rows, everywhere)}. {'This is one equation' if number == 1 else f'These are {number} equations'} among the coordinates."
    rates = list(dict.fromkeys("sticking" if _sticks(row) else row.name for row in rows if row.value is None))
    if rates and any(row.value is not None for row in rows):
        said += f" Of these {clause(rates, 'has', 'have')} none for the positions."
    if idle := [row.name for row in rows if row.says_nothing]:
        counts = [f"{'one' if (n := idle.count(name)) == 1 else n} at {name}" for name in dict.fromkeys(idle)]
        said += f" Further ones, {joined(counts)}, are redundant: they follow from the other joints."
    return said


def what(rows: Sequence[Row], everywhere: bool = False) -> str:
    """What the rows stand for: ``C closes a loop; rope is taut``; ``everywhere``: joints of a tree have rows, too."""
    parts = []
    for kind, words in _WHAT.items():
        if names := list(dict.fromkeys(row.name for row in rows if row.kind == kind)):
            parts.append(clause(names, *(("holds", "hold") if everywhere and kind == "joint" else words)))
    return "; ".join(parts)


def _sticks(row: Row) -> bool:
    """Whether it holds something from sliding."""
    return row.kind == "friction" or (row.kind == "contact" and row.value is None)


def holding(rows: Sequence[Row]) -> str:
    """What closed limits and sticking joints do: ``foot holds and does not slide``; empty where there are none."""
    held = [row for row in rows if row.kind in _HELD]
    found: dict[tuple[str, str], list[str]] = {}
    for name in dict.fromkeys(row.name for row in held):
        own = [row for row in held if row.name == name]
        words = _STUCK if {_sticks(row) for row in own} == {True, False} else _WHAT[own[0].kind]
        found.setdefault(words, []).append(name)
    return joined([clause(names, *words) for words, names in found.items()]) if found else ""


def followers(rows: Sequence[Row], free: Collection[str], needed: Collection[str]) -> list[Row]:
    """The rows that tie accelerations of coordinates ``needed``, which are not ``free``, to each other and to free ones."""
    tied = set(needed) - set(free)
    while more := {name for row in rows if tied & _names(row) for name in _names(row)} - tied - set(free):
        tied |= more
    return [row for row in rows if tied & _names(row)]


def _names(row: Row) -> set[str]:
    return {x.name for x in row.linear.coefficients}
