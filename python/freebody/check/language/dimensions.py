"""Whether the terms of a statement can be added at all: their dimensions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from freebody.symbolic.errors import StatementError
from freebody.symbolic.tree import Add, Column, Cross, Dot, Fn, Matrix, Mul, Negative, Node, Num, Pow, Quotient, Sym, Unit

from ...model.units import NUMBER_ONLY, Dimension, unit
from .spelling import spell
from .statements import Equation, Program, addends, inlined, letters

Known = Dimension | None
"""A dimension; None fits any: 0, a figure with a decimal point, what is made of figures alone."""

Shape = Known | list[list[Known]]
"""Of a number or vector one dimension, of a matrix one for each entry."""

_DIRECTIONS = {"i", "j", "k"}
_SAME = {"abs", "hypot", "min", "max"}


class DimensionError(StatementError):
    """Two terms that cannot be added: ``term`` is out of line with ``other``."""

    term: Node
    other: Node

    @classmethod
    def of(cls, term: Node, its: Dimension, other: Node, others: Dimension) -> DimensionError:
        """The error about two terms and their dimensions."""
        what = f"`{spell(term)}` is {its.words()}, but `{spell(other)}` is {others.words()}"
        error = cls(what, term.span, "a factor is missing, or one too many")
        error.term, error.other = term, other
        return error

    def within(self, text: str) -> DimensionError:
        error = super().within(text)
        error.term, error.other = self.term, self.other
        return error


def check_dimensions(
    program: Program, units_of_letters: Mapping[str, str | Dimension], *, figures: bool = False, strictly: bool = False
) -> None:
    """Raises ``DimensionError`` at the first two terms that do not go together.

    ``units_of_letters``: dimension or unit of each letter by its name, ``""`` for plain numbers and directions. A rate has that of its
    letter by second; a letter that is not listed fits anything. ``figures``: so does every
    figure, every sum with one in it, and the time in seconds. ``strictly``: a figure with a decimal point is a plain number, too.
    """
    try:
        for line in inlined(program):
            _Reader(units_of_letters, figures, strictly).equation(line)
    except StatementError as error:
        raise error.within(program.text) from None


def dimensions(node: Node, units_of_letters: Mapping[str, str | Dimension]) -> Shape:
    """The dimension of an expression, None where any fits; of a matrix, by entries. Raises ``DimensionError``."""
    return _Reader(units_of_letters).of(node)


class _Reader:
    def __init__(self, units_of_letters: Mapping[str, str | Dimension], figures: bool = False, strictly: bool = False) -> None:
        self.units, self.figures, self.strictly = units_of_letters, figures, strictly

    def equation(self, equation: Equation) -> None:
        """All terms of both sides have one dimension; of columns, entry by entry."""
        both = [term for side in (equation.left, equation.right) for _, term in addends(side)]
        self.agreed([(term, self.term(term)) for term in both])

    def term(self, node: Node) -> Shape:
        """The dimension of a term; figures alone, with or without directions, fit any."""
        found = self.of(node)
        bare = all(letter.name in _DIRECTIONS and not letter.dots for letter in letters(node))
        return None if bare and isinstance(found, Dimension) and found.is_number else found

    def of(self, node: Node) -> Shape:
        match node:
            case Num(value=value, text=text):
                return None if self.figures or value == 0 or ("." in text and not self.strictly) else NUMBER_ONLY
            case Unit(text=text):
                return unit(text).dimension
            case Sym():
                return None if self.figures and node.name == "t" else self.letter(node)
            case Negative(of=of):
                return self.of(of)
            case Add():
                if self.figures and any(not letters(term) for _, term in addends(node)):
                    return None
                return self.agreed([(term, self.term(term)) for _, term in addends(node)])
            case Mul(factors=factors):
                return self.product(factors)
            case Cross(left=left, right=right) | Dot(left=left, right=right):
                return self.product((left, right))
            case Quotient(top=top, bottom=bottom):
                return _times(self.of(top), _scalar(self.of(bottom)), -1)
            case Pow(base=base, exponent=exponent):
                return self.power(base, exponent)
            case Fn(name=function, args=arguments):
                return self.call(function, arguments)
            case Column(items=items):
                return [[_scalar(self.of(item))] for item in items]
            case Matrix(rows=rows):
                return [[_scalar(self.of(item)) for item in row] for row in rows]
        raise TypeError(f"{type(node).__name__} has no dimension")

    def letter(self, letter: Sym) -> Shape:
        for name, dots in ((letter.key, 0), (letter.name, letter.dots)):
            if name in self.units:
                given = self.units[name]
                dimension = unit(given).dimension if isinstance(given, str) else given
                return dimension.times(Dimension(time=1), -dots)
        return None

    def agreed(self, found: Sequence[tuple[Node, Shape]]) -> Shape:
        """The common shape of terms."""
        matrices = [(node, shape) for node, shape in found if isinstance(shape, list)]
        if not matrices:
            return self.common([(node, shape) for node, shape in found if isinstance(shape, Dimension)])
        first = matrices[0][1]
        same = [(node, shape) for node, shape in matrices if [len(r) for r in shape] == [len(r) for r in first]]
        return [
            [self.common([(_entry(node, r, c), d) for node, s in same if (d := s[r][c]) is not None]) for c in range(len(row))]
            for r, row in enumerate(first)
        ]

    def common(self, found: Sequence[tuple[Node, Dimension]]) -> Known:
        """The one dimension of all; the fewest that differ are to blame, of equally many the last."""
        if not found:
            return None
        groups: dict[tuple, list[tuple[Node, Dimension]]] = {}
        for node, dimension in found:
            groups.setdefault(dimension[:3], []).append((node, dimension))
        ranked = sorted(groups.values(), key=len, reverse=True)
        if len(ranked) > 1:
            raise DimensionError.of(*ranked[-1][0], *ranked[0][0])
        return found[0][1]

    def product(self, factors: Sequence[Node]) -> Shape:
        out: Shape = NUMBER_ONLY
        for factor, after in zip(factors, [*factors[1:], None], strict=True):
            figure = isinstance(after, Unit) and not letters(factor)
            shape = NUMBER_ONLY if figure else self.of(factor)
            if isinstance(out, list) and isinstance(shape, list) and len(out[0]) == len(shape):
                out = self.matrix_product(out, shape, factor)
            elif isinstance(shape, list):
                out = _times(shape, _scalar(out))
            else:
                out = _times(out, shape)
        return out

    def matrix_product(self, a: list[list[Known]], b: list[list[Known]], at: Node) -> Shape:
        """Row times column: its products have one dimension."""
        out = []
        for row in a:
            entries = []
            for column in zip(*b, strict=True):
                products = [_times(x, y) for x, y in zip(row, column, strict=True)]
                known = [p for p in products if isinstance(p, Dimension)]
                if any(not p.fits(known[0]) for p in known):
                    words = " and ".join(dict.fromkeys(p.words() for p in known))
                    raise StatementError(f"a row of the matrix times this column adds {words}", at.span)
                entries.append(known[0] if known else None)
            out.append(entries)
        return out

    def power(self, base: Node, exponent: Node) -> Shape:
        power = _whole(exponent)
        shape = self.of(base)
        if power is None:
            return NUMBER_ONLY if isinstance(shape, Dimension) and shape.is_number else None
        return shape.to_the(power) if isinstance(shape, Dimension) else shape

    def call(self, function: str, arguments: Sequence[Node]) -> Known:
        found = [(a, shape) for a in arguments if isinstance(shape := self.of(a), Dimension)]
        if function == "sqrt":
            return found[0][1].to_the(Fraction(1, 2)) if found else None
        if function in _SAME or function == "atan2":
            same = self.common(found)
            return NUMBER_ONLY if function == "atan2" else same
        for node, dimension in found:
            if function != "sign" and not dimension.is_number:
                raise StatementError(
                    f"`{function}` of `{spell(node)}`, {dimension.words()}", node.span, "it takes a plain number"
                )
        return NUMBER_ONLY


def _entry(node: Node, row: int, column: int) -> Node:
    """The entry of a written column or matrix; of what is worked out, the whole."""
    match node:
        case Column(items=items):
            return items[row]
        case Matrix(rows=rows):
            return rows[row][column]
    return node


def _scalar(shape: Shape) -> Known:
    return shape if isinstance(shape, Dimension) else None


def _times(a: Shape, b: Shape, power: int = 1) -> Shape:
    """A product with a power of a dimension, entry by entry."""
    if isinstance(a, list):
        return [[_scalar(_times(x, b, power)) for x in row] for row in a]
    return a.times(b, power) if isinstance(a, Dimension) and isinstance(b, Dimension) else None


def _whole(exponent: Node) -> Fraction | None:
    """An exponent that is a figure, or None."""
    match exponent:
        case Num(value=value):
            return Fraction(value).limit_denominator(1000)
        case Negative(of=of):
            inside = _whole(of)
            return None if inside is None else -inside
        case Quotient(top=top, bottom=bottom):
            a, b = _whole(top), _whole(bottom)
            return a / b if a is not None and b else None
    return None
