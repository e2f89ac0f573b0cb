"""Loops, prescribed motions and closed limits: their equations at the levels of position, velocity and acceleration."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from freebody.document.blocks import Block, Equation, Heading, MatrixEquation, Paragraph
from freebody.equations.derivation.data import Row
from freebody.equations.derivation.meaning import joined
from freebody.equations.derivation.result import Printed
from freebody.equations.derivation.system import System
from freebody.equations.linear import Linear, linear_in
from freebody.symbolic.collect import common_number
from freebody.symbolic.tree import ONE, ZERO, Add, Sym, add, is_negative, is_zero, mul, symbols

_WHAT = {
    "joint": ("closes a loop", "close loops"), "motion": ("is prescribed", "are prescribed"),
    "coupling": ("couples motions", "couple motions"), "lock": ("holds", "hold"), "contact": ("holds", "hold"), "string": ("is taut", "are taut"),
    "stop": ("is at its end", "are at their end"), "friction": ("sticks", "stick"),
}  # fmt: skip

_HELD = ("contact", "string", "stop", "friction")
_STUCK = ("holds and does not slide", "hold and do not slide")

_AGAIN = "Differentiated once more, for the accelerations"


def section(rows: Sequence[Row], coordinates: Sequence[str], everywhere: bool = False) -> list[Block]:
    """The rows at all levels, the derivatives as matrix equations; ``everywhere``: every joint has rows, not those of loops only."""
    made: list[Block] = [Heading("Constraints" if everywhere else _title(rows)), Paragraph(_why(rows, everywhere))]
    rows = written(rows)
    made += _positions(rows)
    made += _velocities(rows, coordinates)
    system = System.of([row.linear for row in rows], coordinates)
    above = any(row.rate is not None for row in rows)
    return made + _together(system, _AGAIN if above else "For the accelerations")


def _together(system: System, name: str) -> list[Block]:
    """Several equations as a matrix equation, one as it is."""
    if not system.unknowns:
        return []
    if len(system.matrix) > 1:
        return [MatrixEquation(system.matrix, system.unknowns, system.right, name, letter="J")]
    left = add(*(mul(entry, x) for entry, x in zip(system.matrix[0], system.unknowns, strict=True)))
    return [Equation(left, system.right[0], name)]


def printed(rows: Sequence[Row]) -> list[Printed]:
    """The rows at the level of accelerations, as equations among the others."""
    return [Printed(f"acceleration at {row.name}", row.acceleration, ZERO, row.linear) for row in written(rows)]


def written(rows: Sequence[Row]) -> list[Row]:
    """The rows as a person writes them: without those that say nothing, and with no more minus signs than need be."""
    said = [_without_common_number(row) for row in rows if not row.says_nothing]
    return [row.negative if _reads_better_negative(row) else row for row in said]


def _without_common_number(row: Row) -> Row:
    """The row over what all its terms have in common and that has no letters: 0.03 cos(π/9) of the teeth of two gears."""
    terms = [*row.linear.coefficients.values(), *([] if is_zero(row.linear.rest) else [row.linear.rest])]
    common = common_number(terms)
    return row if common == ONE else row.over(common)


def _reads_better_negative(row: Row) -> bool:
    """Whether most terms with coordinates are negative."""
    tree = next(tree for tree in (row.value, row.rate, row.acceleration) if tree is not None)
    moving = {x.name for x in row.linear.coefficients}
    terms = tree.terms if isinstance(tree, Add) else (tree,)
    signs = [is_negative(term) for term in terms if moving & {x.name for x in symbols(term)}]
    return 2 * sum(signs) > len(signs)


def _title(rows: Sequence[Row]) -> str:
    """Loops, motions, and what touches, as far as there are any."""
    kinds = {row.kind for row in rows}
    named = (
        ("Loop closure", {"joint"}),
        ("couplings", {"coupling"}),
        ("locks", {"lock"}),
        ("contacts", set(_HELD)),
        ("prescribed motions", {"motion"}),
    )
    found = joined([name for name, of in named if kinds & of])
    return found[0].upper() + found[1:]


def _why(rows: Sequence[Row], everywhere: bool) -> str:
    said = written(rows)
    number = "This is one equation" if len(said) == 1 else f"These are {len(said)} equations"
    return f"{what(rows, everywhere)}. {number} among the coordinates.{_of_rates(rows)}{_silent(rows)}"


def _silent(rows: Sequence[Row]) -> str:
    """Which rows say nothing."""
    names = [row.name for row in rows if row.says_nothing]
    counts = [
        f"{'one more' if names.count(name) == 1 else f'{names.count(name)} more'} at {name}" for name in dict.fromkeys(names)
    ]
    return f" What would be {joined(counts)} holds by itself: other joints see to it." if names else ""


def what(rows: Sequence[Row], everywhere: bool = False) -> str:
    """What the rows stand for: ``C closes a loop; rope is taut``; ``everywhere``: joints of a tree have rows, too."""
    parts = []
    for kind, (one, several) in _WHAT.items():
        one, several = ("holds", "hold") if everywhere and kind == "joint" else (one, several)
        if names := list(dict.fromkeys(row.name for row in rows if row.kind == kind)):
            parts.append(f"{joined(names)} {one if len(names) == 1 else several}")
    return "; ".join(parts)


def _of_rates(rows: Sequence[Row]) -> str:
    """Which rows tell nothing of positions, where others do."""
    silent = list(dict.fromkeys("sticking" if _sticks(row) else row.name for row in rows if row.value is None))
    if not silent or all(row.value is None for row in rows):
        return ""
    return f" Of these {joined(silent)} {'has' if len(silent) == 1 else 'have'} none for the positions."


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
    return joined([f"{joined(names)} {words[len(names) > 1]}" for words, names in found.items()]) if found else ""


def followers(rows: Sequence[Row], free: Collection[str], needed: Collection[str]) -> list[Row]:
    """The rows that tie accelerations of coordinates ``needed``, which are not ``free``, to each other and to free ones."""
    tied = set(needed) - set(free)
    while more := {x.name for row in rows if tied & _names(row) for x in row.linear.coefficients} - tied - set(free):
        tied |= more
    return [row for row in rows if tied & _names(row)]


def accelerations(rows: Sequence[Row], coordinates: Sequence[str]) -> list[Block]:
    """Rows at the level of accelerations only."""
    return _together(System.of([row.linear for row in written(rows)], coordinates), "")


def _names(row: Row) -> set[str]:
    return {x.name for x in row.linear.coefficients}


def _positions(rows: Sequence[Row]) -> list[Block]:
    held = [row for row in rows if row.value is not None]
    firsts = "For the positions"
    return [Equation(row.value, ZERO, firsts if i == 0 else "") for i, row in enumerate(held)]


def _velocities(rows: Sequence[Row], coordinates: Sequence[str]) -> list[Block]:
    held = [row for row in rows if row.rate is not None]
    try:
        system = System.of([_in_rates(row, coordinates) for row in held], coordinates)
    except ValueError:
        return [Equation(row.rate, ZERO, "Their rates" if i == 0 else "") for i, row in enumerate(held)]
    above = any(row.value is not None for row in rows)
    return _together(system, "Differentiated, for the velocities" if above else "For the velocities")


def _in_rates(row: Row, coordinates: Sequence[str]) -> Linear:
    """The rate of a row, with the factors of its acceleration, which are the same. Raises ``ValueError`` where it is not linear."""
    found = linear_in(row.rate, [Sym(name, 1) for name in coordinates])
    return Linear({Sym(x.name, 1): tree for x, tree in row.linear.coefficients.items() if x.dots == 2}, found.rest)
