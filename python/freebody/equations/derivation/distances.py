"""Rows that keep two points apart: a massless rod, a string without a guide, as a book has them, by the differences of coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

from freebody.core import GROUND
from freebody.model.syntax import parse
from freebody.solve.symbolic_state import Row, SymbolicState
from freebody.symbolic.algebra import divided
from freebody.symbolic.differentiate import along_motion
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.linear import linear_in
from freebody.symbolic.tree import (
    ONE,
    Add,
    Sym,
    Tree,
    add,
    is_negative,
    is_zero,
    minus,
    mul,
    negative,
    number,
    power,
    symbols,
)

Sides = tuple[Tree, Tree]


@dataclass(frozen=True)
class Distance:
    """What stays: the squares of the ``differences`` of the coordinates of two points, m, add up to ``square``."""

    differences: tuple[Tree, ...]
    square: Tree

    def levels(self, coordinates: Sequence[str]) -> tuple[Sides, Sides, Sides]:
        """(x_A − x_C)² + … = l², (x_A − x_C) (ẋ_A − ẋ_C) + … = 0, and that once more, with what goes by velocities on the right."""
        rates = [divided(along_motion(each, coordinates), ONE) for each in self.differences]
        again = [divided(along_motion(rate, coordinates), ONE) for rate in rates]
        seconds = [linear_in(each, [Sym(name, 2) for name in coordinates]) for each in again]
        led = [add(*(mul(factor, x) for x, factor in second.coefficients.items())) for second in seconds]
        rest = [mul(each, second.rest) for each, second in zip(self.differences, seconds, strict=True)]
        by = partial(map, mul, self.differences)
        return (
            (add(*(power(each, 2) for each in self.differences)), self.square),
            (add(*by(rates)), number(0)),
            (add(*by(led)), negative(add(*(power(rate, 2) for rate in rates), *rest))),
        )


def distances(subject: SymbolicState, rows: Sequence[Row]) -> dict[str, Distance]:
    """Those among rows, by name."""
    spec = subject.source.spec
    kept = {
        joint["name"]: (joint["with"]["of"], joint["with"].get("length")) for joint in spec["joints"] if joint["type"] == "link"
    }
    for string in spec["strings"]:
        ends = [end.get("point") for end in string["ends"]]
        if all(ends) and not string["over"]:
            kept[string["name"]] = ends, string["length"]
    found = {row.name: _distance(subject, row, *kept[row.name]) for row in rows if row.value is not None and row.name in kept}
    return {name: made for name, made in found.items() if made}


def _distance(subject: SymbolicState, row: Row, ends: Sequence[str], length: float | str | None) -> Distance | None:
    ends = sorted(ends, key=lambda point: subject.points[point][0] == GROUND)
    asked = [{"ask": "equation", "bodies": [], "about": {"point": point}} for point in ends]
    here, there = (balance.place.xy for balance in subject.balances(asked))
    apart = tuple(_positive(each) for each in map(minus, here, there) if not is_zero(each))
    if {x.name for each in apart for x in symbols(each)} & {*subject.names, "t"} - {x.name for x in symbols(row.acceleration)}:
        return None  # a coordinate is held at 0 by another row
    whole = add(*(power(each, 2) for each in apart))
    if isinstance(length, str):
        square = power(parse(length).tree, 2)
    else:
        square = number(float(evaluate(whole, subject.values)) if length is None else length**2)
    fixed = symbols(square) <= subject.constants.keys()
    return Distance(apart, square) if fixed and len(apart) == 2 else None


def _positive(tree: Tree) -> Tree:
    """The tree, or its opposite where all its terms are negative: its square is the same."""
    return negative(tree) if all(map(is_negative, tree.terms if isinstance(tree, Add) else (tree,))) else tree
