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
    ``unit`` is the SI unit of its numbers, None where any will do; ``default`` None means required.
    """

    name: str
    kind: str
    unit: str | None
    default: str | None
    doc: str
    choices: tuple[str, ...] = ()

    @property
    def required(self) -> bool:
        """Whether it must be given."""
        return self.default is None


@dataclass(frozen=True)
class Coordinate:
    """A coordinate of a joint with its SI unit (empty for a curve parameter)."""

    name: str
    unit: str


@dataclass(frozen=True)
class Card:
    """A joint or a force as a person writes it. ``rows`` names the constraints of a joint by their forces; ``rubs`` tells whether
    it can have friction along its first coordinate."""

    type: str
    doc: str
    fields: tuple[Field, ...]
    coordinates: tuple[Coordinate, ...] = ()
    rows: tuple[str, ...] = ()
    rubs: bool = False

    @property
    def pushes(self) -> tuple[int, ...]:
        """The constraints, counted from 1, whose force is that of one side pushing the other; a curve holds its point for good."""
        if any(field.kind == "curve" for field in self.fields):
            return ()
        return tuple(i for i, row in enumerate(self.rows, 1) if row == "normal force" or "roller" in row)


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
    coordinates = tuple(Coordinate(c["name"], c["dimension"] or "") for c in data.get("coordinates", []))
    rows = tuple(row["name"] for row in data.get("rows", []))
    return Card(data["type"], data["doc"], tuple(_field(f) for f in data["fields"]), coordinates, rows, data["rubs"])


def _field(data: dict[str, Any]) -> Field:
    kind, _, choices = "choice:fixed|body".partition(":") if data["kind"] == "frame" else data["kind"].partition(":")
    # An expression without a unit may be anything; a plain number is written as one.
    unit = data["dimension"] if data["dimension"] or kind not in ("law", "gauge") else None
    return Field(data["name"], kind, unit, data["default"], data["doc"], tuple(choices.split("|")) if choices else ())
