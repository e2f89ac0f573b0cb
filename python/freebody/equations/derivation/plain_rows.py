"""Rows as a page has them: distances squared, nothing below a line that does not move, what is prescribed by itself."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import partial

from freebody.document.blocks import Written, is_tree
from freebody.equations.derivation.distances import Distance
from freebody.solve.symbolic_state import Row
from freebody.symbolic.algebra import common_factors, divided, quotient, spread, with_zero
from freebody.symbolic.differentiate import along_motion
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.formula import word
from freebody.symbolic.linear import Linear, linear_in
from freebody.symbolic.tree import (
    ONE,
    ZERO,
    Add,
    Fn,
    Mul,
    Num,
    Pow,
    Sym,
    Tree,
    add,
    is_negative,
    is_zero,
    minus,
    mul,
    negative,
    number,
    operations,
    power,
    rebuilt,
    symbols,
    walk,
)

Sides = tuple[Tree, Tree | Written]
_ROOT = Sym("the root")
_WRITTEN = 6
"""Decimal places of a number that a person has written, at most."""
_NONE = 1e-9
"""A coordinate below which it is 0, rad or m."""


def root_of(row: Row, moving: Collection[str]) -> tuple[Tree, Tree] | None:
    """A and b of a row √A = b, of which b does not move: of a string, its length."""
    if row.value is None:
        return None
    roots = {
        part for part in walk(row.value) if isinstance(part, Pow) and part.exponent == Fraction(1, 2) and _moves(part, moving)
    }
    if len(roots) != 1:
        return None
    [root] = roots
    try:
        linear = linear_in(rebuilt(row.value, lambda part: _ROOT if part == root else None), [_ROOT])
    except ValueError:
        return None
    factor, rest = linear.coefficients.get(_ROOT, ZERO), linear.rest
    return (
        None
        if is_zero(factor) or _moves(factor, moving) or _moves(rest, moving)
        else (root.base, quotient(negative(rest), factor))
    )


def squared(row: Row, coordinates: Sequence[str]) -> Row:
    """A row √A = b as A = b², and half of its derivatives; any other as it is."""
    if (found := root_of(row, {*coordinates, "t"})) is None:
        return row
    inside, constant = found
    square = number(constant.value**2) if isinstance(constant, Num) else power(constant, 2)
    half = divided(along_motion(inside, coordinates), number(2))
    again = divided(along_motion(half, coordinates), ONE)
    try:
        linear = linear_in(again, [Sym(name, 2) for name in coordinates])
    except ValueError:
        return row
    return Row(row.name, row.kind, minus(inside, square), half, again, linear)


def below(trees: Sequence[Tree], wanted: Callable[[Pow], bool]) -> Tree:
    """The product of all that is ``wanted`` of what stands below a line, but in functions."""
    found: dict[Tree, Fraction] = {}
    for part in (part for tree in trees for part in _outside(tree)):
        if isinstance(part, Pow) and part.exponent < 0 and wanted(part):
            found[part.base] = max(found.get(part.base, Fraction(0)), -part.exponent)
    return mul(*(power(base, exponent) for base, exponent in found.items()))


def times(tree: Tree, factor: Tree) -> Tree:
    """The product, with the brackets that the tree has where nothing is left below a line that the factor has above."""
    if factor == ONE or is_zero(tree):
        return tree
    under = quotient(ONE, factor)
    made = divided(tree, under)
    above = {part.base if isinstance(part, Pow) else part for part in _outside(factor)}
    left = any(isinstance(part, Pow) and part.exponent < 0 and part.base in above for part in _outside(made))
    return divided(spread(tree), under) if left else made


def _outside(tree: Tree) -> list[Tree]:
    """All parts but what functions are of."""
    match tree:
        case Fn():
            return [tree]
        case Add(parts) | Mul(parts):
            return [tree, *(inner for part in parts for inner in _outside(part))]
    return [tree]


def _moves(tree: Tree, moving: Collection[str]) -> bool:
    return any(x.name in moving for x in symbols(tree))


def plain(rows: Sequence[Row], coordinates: Sequence[str], values: Mapping[Sym, float]) -> list[Row]:
    """Rows with distances squared, and nothing below a line, nor in front, that does not move; where one holds a coordinate at 0, that
    coordinate, which no other has then."""
    made = [squared(row, coordinates) for row in rows]
    still: list[Sym] = []
    while found := next(((i, x) for i, row in enumerate(made) if (x := _held_at_zero(row, coordinates, values, still))), None):
        still.append(found[1])
        made = [_standing(row, found[1], i == found[0]) for i, row in enumerate(made)]
    return [_cleared(row, coordinates, values) for row in made]


def with_rates(row: Row, coordinates: Sequence[str], give: Callable[[float, int, bool], Sym]) -> Row:
    """A prescribed motion in which each number times a power of t, and nothing else that has a unit, is a symbol that ``give`` has for
    it, its power and whether it is in an angle of sin or cos: θ = ω t, never an angle that is a time."""
    time = Sym("t")

    def put(part: Tree, in_angle: bool = False) -> Tree | None:
        if isinstance(part, Fn):
            turns = part.name in ("sin", "cos", "tan")
            return Fn(part.name, tuple(rebuilt(arg, partial(put, in_angle=True)) for arg in part.args)) if turns else part
        if isinstance(part, Pow) and part.base != time:  # its base has another unit
            return part
        again = partial(put, in_angle=in_angle)
        factors = part.factors if isinstance(part, Mul) else (part,)
        times = [f for f in factors if f == time or (isinstance(f, Pow) and f.base == time)]
        others = [f for f in factors if not symbols(f) or isinstance(f, Fn)]
        if len(times) != 1:
            return None
        if len(others) + 1 != len(factors):  # a symbol beside it has the unit
            return mul(*(f if f in times else rebuilt(f, again) for f in factors))
        power_of_t = times[0].exponent if isinstance(times[0], Pow) else Fraction(1)
        size = math.prod(float(f.value) for f in others if isinstance(f, Num))
        rest = (rebuilt(f, again) for f in others if not isinstance(f, Num))
        return mul(number(-1 if size < 0 else 1), give(abs(size), int(power_of_t), in_angle), power(time, power_of_t), *rest)

    if row.kind != "motion" or row.value is None or (value := rebuilt(row.value, put)) == row.value:
        return row
    rate = along_motion(value, coordinates)
    acceleration = along_motion(rate, coordinates)
    return Row(row.name, row.kind, value, rate, acceleration, linear_in(acceleration, [Sym(name, 2) for name in coordinates]))


def at_rest(tree: Tree, x: Sym) -> Tree:
    """The expression where a coordinate and its rates are 0."""
    for dots in range(3):
        tree = with_zero(tree, Sym(x.name, dots))
    return tree


def _standing(row: Row, x: Sym, holds: bool) -> Row:
    """A row where a coordinate stays 0; that which ``holds`` it there."""
    rate, acceleration = Sym(x.name, 1), Sym(x.name, 2)
    if holds:
        return Row(row.name, row.kind, x, rate, acceleration, Linear({acceleration: ONE}, ZERO))
    made = row.with_trees(lambda tree: at_rest(tree, x))
    kept = {y: factor for y, factor in made.linear.coefficients.items() if y != acceleration}
    return replace(made, linear=Linear(kept, made.linear.rest))


def _cleared(row: Row, coordinates: Sequence[str], values: Mapping[Sym, float]) -> Row:
    """What is 0 at the state is no factor that could be left out."""
    moving = {*coordinates, "t"}
    levels = [tree for tree in (row.value, row.rate, row.acceleration) if tree is not None]
    above = below(levels, lambda part: not _moves(part, moving))
    fixed = lambda factor: not _moves(factor, moving) and evaluate(factor, values) != 0
    shared = common_factors([times(tree, above) for tree in levels], fixed)
    factor = quotient(above, shared)
    return row if factor == ONE else row.with_trees(lambda tree: times(tree, factor))


def level_by_level(row: Row) -> Row:
    """A row whose rate and acceleration have nothing below a line, each by itself, where they are shorter so."""
    first, second = (ONE if tree is None else below([tree], lambda _: True) for tree in (row.rate, row.acceleration))
    rate, acceleration = row.rate and times(row.rate, first), times(row.acceleration, second)
    if row.rate is not None and operations(rate) < operations(row.rate):
        row = replace(row, rate=rate)
    if operations(acceleration) < operations(row.acceleration):
        row = replace(row, acceleration=acceleration, linear=row.linear.with_trees(lambda tree: times(tree, second)))
    return row


def _held_at_zero(row: Row, coordinates: Sequence[str], values: Mapping[Sym, float], still: Sequence[Sym]) -> Sym | None:
    """The one coordinate of a row, where the row holds it at 0, whatever the parameters are, and it is none of those found before."""
    moving = [x for x in symbols(row.value or ZERO) if x.name in coordinates or x.name == "t"]
    if (
        len(moving) != 1
        or (x := moving[0]) in (*still, Sym("t"))
        or abs(values[x]) > _NONE
        or not is_zero(with_zero(row.value or ONE, x))
    ):
        return None
    slope = linear_in(row.rate, [Sym(x.name, 1)]).coefficients.get(Sym(x.name, 1), ZERO) if row.rate else ZERO
    return x if abs(evaluate(slope, values)) > _NONE else None


def on_two_sides(rows: Sequence[Row], coordinates: Sequence[str], apart: Mapping[str, Distance]) -> list[list[Sides]]:
    """Rows as a person puts them on two sides: places, velocities, accelerations; what is prescribed stands by itself, and what keeps
    two points ``apart``, by name, goes by differences."""
    rates = {id(row): linear_in(row.rate, [Sym(name, 1) for name in coordinates]) for row in rows if row.rate is not None}
    levels: list[list[Sides]] = [[], [], []]
    for row in rows:
        own, by_differences = _prescribed(row), apart[row.name].levels(coordinates) if row.name in apart else None
        if row.value is not None:
            kept = _kept(rates.get(id(row)), coordinates) if _winds(row.value) or _of_the_start(row.value) else None
            levels[0].append(by_differences[0] if by_differences else _alone(row.value, own, 0) or kept or on_sides(row.value))
        if row.rate is not None:
            usual = _alone(row.rate, own, 1) or on_sides(_spread(rates[id(row)]))
            levels[1].append(_shorter(by_differences[1], usual) if by_differences else usual)
        usual = _alone(_spread(row.linear), own, 2) or _apart(row)
        levels[2].append(_shorter(by_differences[2], usual) if by_differences else usual)
    return levels


def _shorter(one: Sides, other: Sides) -> Sides:
    """The one, unless the other is shorter."""
    return min((one, other), key=lambda sides: sum(operations(side) for side in sides if is_tree(side)))


def _prescribed(row: Row) -> str:
    """The coordinate that a motion prescribes, where its row has one with a number in front."""
    single = [x.name for x, factor in row.linear.coefficients.items() if isinstance(factor, Num)]
    return single[0] if row.kind == "motion" and len(single) == 1 else ""


def _alone(tree: Tree, name: str, dots: int) -> Sides | None:
    """A symbol = the rest of what vanishes; None where there is no such symbol."""
    try:
        linear = linear_in(tree, [x := Sym(name, dots)])
    except ValueError:
        return None
    factor = linear.coefficients.get(x)
    return (x, quotient(negative(linear.rest), factor)) if isinstance(factor, Num) else None


def _winds(tree: Tree) -> bool:
    """Whether a function of something moving is in it, as of a rope the angle over which it lies."""
    return any(isinstance(part, Fn) and part.name.startswith("atan") for part in walk(tree))


def _of_the_start(tree: Tree) -> bool:
    """Whether a number is in it that nobody has written, as the length that a rope has by the start."""
    numbers = (part.value for part in walk(tree) if isinstance(part, Num) and isinstance(part.value, float))
    return any(abs(size - round(size, _WRITTEN)) > _NONE for size in numbers)


def _kept(rate: Linear | None, coordinates: Sequence[str]) -> tuple[Tree, Written] | None:
    """What stays as it is, x₁ + x₂ = const, where several rates have a sum that vanishes: of a rope over pulleys."""
    if rate is None or len(rate.coefficients) < 2 or not is_zero(rate.rest):
        return None
    if {x.name for factor in rate.coefficients.values() for x in symbols(factor)} & {*coordinates, "t"}:
        return None
    return add(*(mul(factor, Sym(x.name)) for x, factor in rate.coefficients.items())), Written("const", word("const"))


def _spread(linear: Linear) -> Tree:
    return add(*(mul(factor, x) for x, factor in linear.coefficients.items()), linear.rest)


def _apart(row: Row) -> Sides:
    """The accelerations = what depends on places and velocities, if anything does."""
    linear = row.linear
    if is_zero(linear.rest):
        return on_sides(_spread(linear))
    left = add(*(mul(factor, x) for x, factor in linear.coefficients.items()))
    sides = (left, negative(linear.rest))
    return sides if any(not is_negative(term) for term in _terms(left)) else (negative(left), linear.rest)


def on_sides(tree: Tree) -> tuple[Tree, Tree]:
    """What vanishes as two sides without minus signs in front of their terms."""
    terms = _terms(tree)
    left, right = (add(*(t for t in terms if is_negative(t) == sign)) for sign in (False, True))
    return (negative(right), ZERO) if is_zero(left) else (left, negative(right))


def _terms(tree: Tree) -> tuple[Tree, ...]:
    return tree.terms if isinstance(tree, Add) else (tree,)
