"""The greatest and least values of a quantity over what is varied."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import partial
from typing import Any, ClassVar

from freebody.find.curve import Curve
from freebody.find.response import Response, Sample
from freebody.find.roots import followed, lowest
from freebody.model.user_units import shown
from freebody.solve.figures import Known
from freebody.solve.rich_tables import PlainText, figure_in, table


@dataclass(frozen=True)
class Extreme:
    """A local extreme of the quantity, ``kind`` maximum or minimum: ``where`` and its ``value`` (SI). ``at_edge``: at a bound, or where
    the quantity jumps or ceases to have a value."""

    kind: str
    where: Known
    value: Known
    at_edge: bool = False


@dataclass(frozen=True)
class Extremes(PlainText):
    """The local extremes of a quantity over what is ``varied``, in order; ``greatest`` and ``least`` of all."""

    of: str
    varied: str
    units: tuple[str, str]
    curve: Curve = field(repr=False)
    all: list[Extreme]
    width: ClassVar[int] = 130

    @property
    def greatest(self) -> Extreme:
        """The greatest value of all, with where."""
        return max(self.all, key=lambda each: each.value)

    @property
    def least(self) -> Extreme:
        """The least value of all, with where."""
        return min(self.all, key=lambda each: each.value)

    @property
    def sentence(self) -> str:
        """The answer, with its unit."""
        at, value = partial(figure_in, self.units[0]), partial(self.curve.printed, self.units[1])
        unit, of_value = (f" {shown(each).unit}".rstrip() for each in self.units)
        told = [
            f"{word}, {value(each.value, 10)}{of_value}, at {self.varied} = {at(each.where, 8)}{unit}"
            + " (an edge)" * each.at_edge
            for word, each in (("greatest", self.greatest), ("least", self.least))
        ]
        between = f"between {at(self.curve.start)} and {at(self.curve.end)}{unit}"
        return f"{self.of} is {' and '.join(told)}, {between}."

    def to_json(self) -> dict[str, Any]:
        """As plain data, in SI."""
        found = [
            {"kind": each.kind, "where": float(each.where), "where_error": each.where.error, "value": float(each.value),
             "error": each.value.error, "at_edge": each.at_edge}
            for each in self.all
        ]  # fmt: skip
        asked = {"of": self.of, "vary": self.varied, "within": [self.curve.start, self.curve.end]}
        return asked | {"sentence": self.sentence, "looked_at": self.curve.sentence(self.units[0]), "extremes": found}

    def __rich_console__(self, console: Any, options: Any) -> Iterator[Any]:
        yield self.sentence
        at, value = partial(figure_in, self.units[0]), partial(self.curve.printed, self.units[1])
        named = zip((self.varied, self.of), self.units, strict=True)
        heads = ["", *(f"{name} [{shown(unit).unit}]" if unit else name for name, unit in named)]
        rows = [(each.kind, at(each.where, 8), value(each.value, 10), "edge" * each.at_edge) for each in self.all]
        yield table("", [*heads, " "], rows, heads[1:], edge=True)
        yield f"Looked at {self.curve.sentence(self.units[0])}."


def extremes(respond: Response, within: tuple[Any, Any], points: int = 33) -> Extremes:
    """The local extremes of a quantity ``within`` two places, its edges among them; ``points`` as in ``find``."""
    curve = followed(respond, within, points)
    found = [each for piece in curve.pieces for each in _of_piece(respond, piece)]
    return Extremes(respond.of, respond.varied, (respond.unit, respond.quantity_unit), curve, found)


def _of_piece(respond: Response, piece: list[Sample]) -> Iterator[Extreme]:
    """The extremes of a piece without breaks: its ends, and where neighbours on both sides are less or more."""
    yield from _edge(respond, piece[:2])
    for before, amid, after in zip(piece, piece[1:], piece[2:], strict=False):
        for kind, sign in (("maximum", -1.0), ("minimum", 1.0)):
            if sign * amid.y < sign * before.y and sign * amid.y <= sign * after.y:
                x, _, bend = lowest(lambda x, sign=sign: sign * respond(x).y, before.x, amid.x, after.x)
                value = respond.known(x)
                error = (value.error / bend) ** 0.5 if bend else after.x - before.x
                yield Extreme(kind, Known(x, error, max(abs(before.x), abs(after.x))), value)
    if len(piece) > 1:
        yield from _edge(respond, piece[:-3:-1])


def _edge(respond: Response, ends: list[Sample]) -> Iterator[Extreme]:
    """An end of a piece, with its neighbour."""
    end, *beside = ends
    kind = "maximum" if not beside or end.y > beside[0].y else "minimum"
    yield Extreme(kind, Known(end.x, 0.0, abs(end.x)), respond.known(end.x), True)
