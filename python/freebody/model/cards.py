"""What the core says of its joints and forces: the words of the model language that come from there."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from typing import Any

from freebody import _core


@dataclass(frozen=True)
class Field:
    """One field of a joint or force.

    ``kind`` is point, points, line, circle, curve, body, number, numbers, law, gauge, flag or choice;
    ``unit`` is the SI unit of its numbers, None where any will do; ``default`` None means required; ``role`` is what it is to a
    joint: number, or the marker of its first body, its second body or both.
    """

    name: str
    kind: str
    unit: str | None
    default: str | None
    doc: str
    role: str
    choices: tuple[str, ...] = ()

    @property
    def required(self) -> bool:
        """Whether it must be given."""
        return self.default is None


@dataclass(frozen=True)
class Coordinate:
    """A coordinate of a joint with its SI unit (empty for a curve parameter); ``turn``: it is the second body's own turn."""

    name: str
    unit: str
    turn: bool


@dataclass(frozen=True)
class Card:
    """A joint or a force as a person writes it. ``rows`` are the readings of the constraints of a joint, of which those
    numbered in ``presses``, from 1, are by one side pressing on the other; ``rubs`` tells whether it can have friction along its first coordinate;
    ``loads`` names what a force does."""

    type: str
    doc: str
    fields: tuple[Field, ...]
    coordinates: tuple[Coordinate, ...] = ()
    rows: tuple[str, ...] = ()
    presses: tuple[int, ...] = ()
    rubs: bool = False
    loads: tuple[str, ...] = ()

    @property
    def pinned(self) -> bool:
        """Whether it holds a pin of the second body, about which that turns."""
        return self._second in ("point", "points") and any(coordinate.turn for coordinate in self.coordinates)

    @property
    def slides(self) -> bool:
        """Whether it guides a line of the second body, and so acts at no point of its own."""
        return self._second == "line"

    @property
    def _second(self) -> str:
        return next((field.kind for field in self.fields if field.role in ("second", "both")), "")


@cache
def joints() -> dict[str, Card]:
    """The joints by their words, in the order of the core."""
    return _section("joints")


@cache
def forces() -> dict[str, Card]:
    """The forces by their words, in the order of the core."""
    return _section("forces")


def _section(name: str) -> dict[str, Card]:
    return {card["type"]: _card(card) for card in json.loads(_core.cards())[name]}


def _card(data: dict[str, Any]) -> Card:
    coordinates = tuple(Coordinate(c["name"], c["dimension"] or "", c["turn"]) for c in data.get("coordinates", []))
    rows = tuple(row["reading"] for row in data["rows"])
    presses = tuple(i for i, row in enumerate(data["rows"], 1) if row["presses"])
    loads = tuple(load["name"] for load in data["parts"])
    fields = tuple(_field(f) for f in data["fields"])
    return Card(data["type"], data["doc"], fields, coordinates, rows, presses, data["rubs"], loads)


def _field(data: dict[str, Any]) -> Field:
    kind, _, choices = "choice:fixed|body".partition(":") if data["kind"] == "frame" else data["kind"].partition(":")
    # An expression without a unit may be anything; a plain number is written as one.
    unit = data["dimension"] if data["dimension"] or kind not in ("law", "gauge") else None
    return Field(
        data["name"], kind, unit, data["default"], data["doc"], data["role"], tuple(choices.split("|")) if choices else ()
    )
