"""Whether the terms of a statement can be added at all: their dimensions."""

from __future__ import annotations

from collections.abc import Mapping

from freebody.symbolic.dimensions import NUMBER_ONLY, Dimension, Known, Rules, Shape, scalar
from freebody.symbolic.errors import StatementError
from freebody.symbolic.tree import Add, Fn, Node, Num, Pow, Sym, Unit, addends

from ...model.units import unit
from .spelling import spell
from .statements import Program, inlined, symbols_in, terms

_DIRECTIONS = {"i", "j", "k"}


class DimensionError(StatementError):
    """Two terms that cannot be added: ``term`` is out of line with ``other``."""

    term: Node
    other: Node

    def within(self, text: str) -> DimensionError:
        error = super().within(text)
        error.term, error.other = self.term, self.other
        return error


def check_dimensions(
    program: Program, units_of_symbols: Mapping[str, str | Dimension], *, figures: bool = False, strictly: bool = False
) -> None:
    """Raises ``DimensionError`` at the first two terms that do not go together.

    ``units_of_symbols``: dimension or unit of each symbol by its name, ``""`` for plain numbers and directions. A rate has that of
    its symbol by second; a symbol that is not listed fits anything. ``figures``: so does every
    figure, every sum with one in it, and the time in seconds. ``strictly``: a figure with a decimal point is a plain number, too.
    """
    rules = _OfStatements(units_of_symbols, figures, strictly)
    try:
        for line in inlined(program):
            rules.agreed(terms(line))
    except StatementError as error:
        raise error.within(program.text) from None


def misfit(program: Program, dimensions: Mapping[str, Dimension], **read: bool) -> DimensionError | None:
    """The first two terms that do not go together, or None; kinds that do not are reported with the verdict."""
    try:
        check_dimensions(program, dimensions, **read)
    except DimensionError as error:
        return error
    except StatementError:
        pass
    return None


def dimension(node: Node, dimensions: Mapping[str, Dimension]) -> Known:
    """The dimension of a term, by those of its symbols; None where one is not known, or it has none; radians aside."""
    try:
        found = scalar(_OfStatements(dimensions, False, True).of(node))
        return None if found is None else found._replace(angle=0)
    except StatementError:
        return None


class _OfStatements(Rules):
    def __init__(self, units: Mapping[str, str | Dimension], figures: bool, strictly: bool) -> None:
        self.units, self.figures, self.strictly = units, figures, strictly

    def of(self, node: Node) -> Shape:
        if self.figures and isinstance(node, Add) and any(not symbols_in(term) for _, term in addends(node)):
            return None
        return super().of(node)

    def term(self, node: Node) -> Shape:
        """Figures alone, with or without directions, fit any."""
        found = self.of(node)
        bare = all(symbol.name in _DIRECTIONS and not symbol.dots for symbol in symbols_in(node))
        return None if bare and isinstance(found, Dimension) and found.is_number else found

    def leaf(self, node: Num | Sym | Unit) -> Known:
        match node:
            case Num(value, text):
                return None if self.figures or value == 0 or ("." in text and not self.strictly) else NUMBER_ONLY
            case Unit(text=text):
                return unit(text).dimension
            case Sym("t") if self.figures:
                return None
        for name, dots in ((node.key, 0), (node.name, node.dots)):
            if name in self.units:
                given = self.units[name]
                return (unit(given).dimension if isinstance(given, str) else given).times(Dimension(time=1), -dots)
        return None

    def unlike(self, term: Node, its: Dimension, other: Node, others: Dimension) -> DimensionError:
        what = f"`{spell(term)}` is {its.words()}, but `{spell(other)}` is {others.words()}"
        error = DimensionError(what, term.span, "a factor is missing, or one too many")
        error.term, error.other = term, other
        return error

    def no_number(self, node: Node, its: Dimension, within: Fn | Pow) -> StatementError:
        what = within.name if isinstance(within, Fn) else "the exponent"
        return StatementError(f"`{what}` of `{spell(node)}`, {its.words()}", node.span, "it takes a plain number")
