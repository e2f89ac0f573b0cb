"""Dimensions: powers of length, mass and time, and the rules by which expressions have them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import reduce
from typing import NamedTuple, TypeAlias

from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import sampled
from freebody.symbolic.tree import (
    Add,
    Column,
    Cross,
    Dot,
    Fn,
    Matrix,
    Mul,
    Negative,
    Node,
    Num,
    Pow,
    Quotient,
    Sym,
    Unit,
    addends,
    symbols,
)


class Dimension(NamedTuple):
    """Powers of length, mass and time; ``angle`` only remembers that radians are meant."""

    length: Fraction | int = 0
    mass: Fraction | int = 0
    time: Fraction | int = 0
    angle: Fraction | int = 0

    def times(self, other: Dimension, power: Fraction | int = 1) -> Dimension:
        """The dimension of a product with a power of the other."""
        return Dimension(*(a + power * b for a, b in zip(self, other, strict=True)))

    def to_the(self, power: Fraction | int) -> Dimension:
        """The dimension of a power."""
        return Dimension(*(power * a for a in self))

    def fits(self, other: Dimension) -> bool:
        """Whether a sum of the two has a meaning; angles are numbers."""
        return self[:3] == other[:3]

    @property
    def is_number(self) -> bool:
        """Whether it is a plain number or an angle."""
        return self.fits(NUMBER_ONLY)

    def unit(self) -> str:
        """Its SI unit as text, e.g. ``N/m``; empty for a plain number."""
        plain = self._replace(angle=0)
        if (known := _UNITS.get(plain)) is not None:
            return (
                f"rad{known}"
                if self.angle == 1 and known in ("", "/s", "/s^2")
                else known.replace("/s", "1/s", known.startswith("/"))
            )
        return _product(self)

    def words(self) -> str:
        """What it is, e.g. ``a force per length (N/m)``."""
        name = _NAMES.get(self._replace(angle=0))
        if self.is_number:
            return "an angle (rad)" if self.angle else "a plain number"
        return f"{name} ({self.unit()})" if name else f"in {self.unit()}"


NUMBER_ONLY = Dimension()
ANGLE = Dimension(angle=1)
LENGTH, MASS, TIME = Dimension(1), Dimension(0, 1), Dimension(0, 0, 1)
FORCE, ENERGY, INERTIA = Dimension(1, 1, -2), Dimension(2, 1, -2), Dimension(2, 1)
SPEED, ACCELERATION, PER_SECOND, STIFFNESS = Dimension(1, 0, -1), Dimension(1, 0, -2), Dimension(time=-1), Dimension(0, 1, -2)

_KNOWN = [
    (NUMBER_ONLY, "", "a plain number"),
    (LENGTH, "m", "a length"),
    (MASS, "kg", "a mass"),
    (TIME, "s", "a time"),
    (FORCE, "N", "a force"),
    (ENERGY, "N*m", "a torque or an energy"),
    (Dimension(2, 1, -3), "W", "a power"),
    (Dimension(0, 1, -2), "N/m", "a force per length"),
    (Dimension(0, 1, -1), "N*s/m", "a force per speed"),
    (Dimension(2, 1, -1), "N*m*s", "an angular momentum or a couple per turning rate"),
    (Dimension(1, 1, -1), "N*s", "a momentum"),
    (Dimension(2, 1), "kg*m^2", "a moment of inertia"),
    (Dimension(2), "m^2", "an area"),
    (Dimension(3), "m^3", "a volume"),
    (Dimension(1, 0, -1), "m/s", "a speed"),
    (Dimension(1, 0, -2), "m/s^2", "an acceleration"),
    (Dimension(0, 0, -1), "/s", "a rate"),
    (Dimension(0, 0, -2), "/s^2", "an angular acceleration"),
    (Dimension(-1, 1, -2), "Pa", "a pressure"),
]
_UNITS = {dimension: text for dimension, text, _ in _KNOWN}
_NAMES = {dimension: name for dimension, _, name in _KNOWN}


def _product(dimension: Dimension) -> str:
    powers = [(w, p) for w, p in zip(("m", "kg", "s"), dimension, strict=False) if p]
    shown = [w if abs(p) == 1 else f"{w}^{abs(p)}" for w, p in powers]
    over = [s for s, (_, p) in zip(shown, powers, strict=True) if p < 0]
    above = [s for s, (_, p) in zip(shown, powers, strict=True) if p > 0]
    below = "" if not over else f"/{over[0]}" if len(over) == 1 else f"/({'*'.join(over)})"
    return ("*".join(above) or "1") + below


# -- of expressions ------------------------------------------------------------------------------

Known: TypeAlias = Dimension | None
"""A dimension; None fits any."""
Shape: TypeAlias = Known | list[list[Known]]
"""Of a number or vector one dimension, of a matrix one for each entry."""
ALIKE = {"abs", "hypot", "min", "max", "clamp", "mod", "atan2", "sign", "step"}
"""Functions whose arguments have one dimension, whichever it is."""
_DENOMINATOR = 12  # largest of an exponent: x^0.333 is a cube root


class Rules(ABC):
    """How dimensions pass through an expression. What numbers and symbols have, and what is said where dimensions do not fit, is
    left to those who read model files and statements."""

    @abstractmethod
    def leaf(self, node: Num | Sym | Unit) -> Shape:
        """The dimension of a number, a symbol or a unit."""

    @abstractmethod
    def unlike(self, term: Node, its: Dimension, other: Node, others: Dimension) -> Exception:
        """The error about two terms that cannot be added; ``term`` is the one out of line."""

    @abstractmethod
    def no_number(self, node: Node, its: Dimension, within: Fn | Pow) -> Exception:
        """The error about an argument or exponent that should be a plain number."""

    def of(self, node: Node) -> Shape:
        """The dimension of an expression."""
        match node:
            case Num() | Sym() | Unit():
                return self.leaf(node)
            case Negative(inner):
                return self.of(inner)
            case Add():
                return self.agreed(term for _, term in addends(node))
            case Mul(factors):
                return self.product(factors)
            case Cross(left, right) | Dot(left, right):
                return self.product((left, right))
            case Quotient(top, bottom):
                return self.times(self.of(top), scalar(self.of(bottom)), bottom, -1)
            case Pow():
                return self.power(node)
            case Fn():
                return self.call(node)
            case Column(items):
                return [[scalar(self.of(item))] for item in items]
            case Matrix(rows):
                return [[scalar(self.of(item)) for item in row] for row in rows]
        raise TypeError(f"{type(node).__name__} has no dimension")

    def term(self, node: Node) -> Shape:
        """The dimension of what is added to something."""
        return self.of(node)

    def agreed(self, terms: Iterable[Node]) -> Shape:
        """The one dimension of terms; of matrices, entry by entry."""
        found = [(node, self.term(node)) for node in terms]
        matrices = [(node, shape) for node, shape in found if isinstance(shape, list)]
        if not matrices:
            return self._common([(node, shape) for node, shape in found if isinstance(shape, Dimension)])
        first = matrices[0][1]
        same = [(node, shape) for node, shape in matrices if [len(r) for r in shape] == [len(r) for r in first]]
        return [
            [self._common([(_entry(node, r, c), d) for node, s in same if (d := s[r][c]) is not None]) for c in range(len(row))]
            for r, row in enumerate(first)
        ]

    def _common(self, found: Sequence[tuple[Node, Dimension]]) -> Known:
        """The one dimension of all; the fewest that differ are to blame, of equally many the last."""
        groups: dict[tuple, list[tuple[Node, Dimension]]] = {}
        for node, dimension in found:
            groups.setdefault(dimension[:3], []).append((node, dimension))
        ranked = sorted(groups.values(), key=len, reverse=True)
        if len(ranked) > 1:
            raise self.unlike(*ranked[-1][0], *ranked[0][0])
        return found[0][1] if found else None

    def product(self, factors: Sequence[Node]) -> Shape:
        """From left to right; figures before a unit are plain numbers."""
        behind = [*factors[1:], None]
        figures = [isinstance(after, Unit) and not symbols(factor) for factor, after in zip(factors, behind, strict=True)]
        shapes = [(NUMBER_ONLY if plain else self.of(f), f) for f, plain in zip(factors, figures, strict=True)]
        return reduce(lambda a, b: (self.times(a[0], b[0], b[1]), b[1]), shapes)[0]

    def times(self, left: Shape, right: Shape, node: Node, power: int = 1) -> Shape:
        """Of a product of two, or a quotient (``power`` −1); ``node`` is the right one."""
        if isinstance(left, list) and isinstance(right, list) and len(left[0]) == len(right):
            return [[self._row_by_column(row, column, node) for column in zip(*right, strict=True)] for row in left]
        if isinstance(right, list):
            left, right = right, scalar(left)
        if isinstance(left, list):
            return [[scalar(self.times(entry, right, node, power)) for entry in row] for row in left]
        return None if left is None or right is None else left.times(right, power)

    def _row_by_column(self, row: Sequence[Known], column: Sequence[Known], at: Node) -> Known:
        products = [x.times(y) for x, y in zip(row, column, strict=True) if x is not None and y is not None]
        if any(not p.fits(products[0]) for p in products):
            words = " and ".join(dict.fromkeys(p.words() for p in products))
            raise StatementError(f"a row of the matrix times this column adds {words}", at.span)
        return products[0] if products else None

    def power(self, node: Pow) -> Shape:
        """Of a power; one whose exponent is no figure is a plain number or fits any."""
        shape, exponent = self.of(node.base), figure(node.exponent)
        if isinstance(shape, Dimension) and (exponent is not None or not shape.is_number):
            return None if exponent is None else shape.to_the(exponent)
        return shape

    def call(self, node: Fn) -> Known:
        """Of a function; those that are not listed take plain numbers."""
        if node.name == "sqrt":
            inside = scalar(self.of(node.args[0])) if node.args else None
            return None if inside is None else inside.to_the(Fraction(1, 2))
        if node.name in ALIKE:
            same = self._common([(arg, d) for arg in node.args if isinstance(d := self.of(arg), Dimension)])
            return ANGLE if node.name == "atan2" else NUMBER_ONLY if node.name in ("sign", "step") else same
        for argument in node.args:
            self.must_be_number(argument, node)
        return ANGLE if node.name in ("asin", "acos", "atan") else NUMBER_ONLY

    def must_be_number(self, node: Node, within: Fn | Pow) -> None:
        """Raises ``no_number`` where an argument or exponent has a dimension."""
        its = self.of(node)
        if isinstance(its, Dimension) and not its.is_number:
            raise self.no_number(node, its, within)


def scalar(shape: Shape) -> Known:
    """The dimension of a number or vector; a matrix has none that is one."""
    return shape if isinstance(shape, Dimension) else None


def figure(exponent: Node | Fraction) -> Fraction | None:
    """An exponent that is made of figures alone, or None."""
    if isinstance(exponent, Fraction):
        return exponent
    try:
        return Fraction(sampled(exponent, {}).item()).limit_denominator(_DENOMINATOR)
    except (KeyError, TypeError, ArithmeticError, ValueError):
        return None


def _entry(node: Node, row: int, column: int) -> Node:
    """The entry of a written column or matrix; of what is worked out, the whole."""
    match node:
        case Column(items):
            return items[row]
        case Matrix(rows):
            return rows[row][column]
    return node
