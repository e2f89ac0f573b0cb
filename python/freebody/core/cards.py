"""What the core says of its joints and forces: the words of the model language that come from there."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
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
    """A coordinate of a joint with its SI unit (empty for a curve parameter); ``turn``: it is the second body's own turn.
    ``line``: that along which, or ``across`` which, it moves this body, ``{}`` being the joint; or empty. ``gap``: a stop, called
    ``JOINT.contact``, keeps it from falling below 0. ``ends``: what is said of the joint where it falls to 0 and a motion ends; or empty."""

    name: str
    unit: str
    turn: bool
    line: str
    across: bool
    gap: bool
    ends: str


@dataclass(frozen=True)
class LoadCard:
    """What a load is, as the core declares it where its joint, force or limit is defined: its ``name`` (``normal force``), the
    word by which an expression reads it (``Fn``), the ``stem`` of its symbol (``N``). ``pulls``: it draws its bodies together
    where it is positive; ``presses``: one side presses on the other; ``tangent``: it acts along surfaces that touch; ``flank``:
    its sign says on which flank teeth bear."""

    name: str
    reading: str
    stem: str
    couple: bool
    pulls: bool
    presses: bool
    tangent: bool
    flank: bool


@dataclass(frozen=True)
class Card:
    """A joint or a force as a person writes it. ``rows`` are the loads by which a joint holds, ``parts`` those of a force;
    ``has_friction`` tells whether a joint can have friction along its first coordinate; ``glyph`` and ``outline`` how it is drawn, by a
    glyph of the set or by strokes at both its points, in sizes of symbols; ``readings`` what an expression reads of it, with the
    unit, None where that depends on the model."""

    type: str
    doc: str
    fields: tuple[Field, ...]
    coordinates: tuple[Coordinate, ...] = ()
    rows: tuple[LoadCard, ...] = ()
    parts: tuple[LoadCard, ...] = ()
    has_friction: bool = False
    readings: Mapping[str, str | None] = field(default_factory=dict)
    glyph: str = ""
    outline: tuple[tuple[tuple[float, float], ...], ...] = ()

    @property
    def presses(self) -> tuple[int, ...]:
        """The rows, counted from 1, by which one side presses on the other."""
        return tuple(i for i, row in enumerate(self.rows, 1) if row.presses)

    @property
    def hinged(self) -> bool:
        """Whether the second body can turn, and nothing else."""
        return all(coordinate.turn for coordinate in self.coordinates) and bool(self.coordinates)

    @property
    def pinned(self) -> bool:
        """Whether it holds a pin of the second body, about which that turns."""
        return self._second in ("point", "points") and any(coordinate.turn for coordinate in self.coordinates)

    @property
    def gap(self) -> int | None:
        """Which coordinate is a gap that a stop keeps from falling below 0, if one is."""
        return next((k for k, coordinate in enumerate(self.coordinates) if coordinate.gap), None)

    @property
    def slides(self) -> bool:
        """Whether it guides a line of the second body, and so acts at no point of its own."""
        return self._second == "line"

    @property
    def _second(self) -> str:
        return next((field.kind for field in self.fields if field.role in ("second", "both")), "")


@dataclass(frozen=True)
class Function:
    """A function that reads the mechanism: what its arguments name (point, line, body or string), whether they may be left out,
    the SI unit of its value; ``reach``: whether it reads a configuration, a motion or an instant."""

    word: str
    takes: tuple[str, ...]
    optional: bool
    unit: str
    doc: str
    reach: str


@dataclass(frozen=True)
class Method:
    """An integrator: its order; ``fixed_step``: it needs a step; ``symplectic``: it needs a conservative tree; ``analytic``: a tree
    whose laws have no branches."""

    name: str
    order: int
    fixed_step: bool
    symplectic: bool
    analytic: bool
    citation: str


@cache
def methods() -> dict[str, Method]:
    """The integrators by their names; the first is the default."""
    return {each["name"]: Method(**each) for each in _declared()["methods"]}


@cache
def functions() -> dict[str, Function]:
    """The functions that read the mechanism, by their words."""
    return {each["word"]: Function(**(each | {"takes": tuple(each["takes"])})) for each in _declared()["functions"]}


def phrases() -> dict[str, list[tuple[str, str]]]:
    """What an expression reads of a joint, motion, force, and of a contact, string or stop (``limit``): words, each with a phrase."""
    return _declared()["phrases"]


@cache
def readings() -> dict[str, dict[str, str | None]]:
    """What an expression reads of a motion, contact, string and stop, with the unit, None where that depends on the model."""
    return _declared()["readings"]


@cache
def joints() -> dict[str, Card]:
    """The joints by their words, in the order of the core."""
    return _section("joints")


@cache
def forces() -> dict[str, Card]:
    """The forces by their words, in the order of the core."""
    return _section("forces")


def _section(name: str) -> dict[str, Card]:
    return {each["card"]["type"]: _card(each["card"], each["readings"]) for each in _declared()[name]}


@cache
def _declared() -> dict[str, Any]:
    return _core.cards()


def _card(data: dict[str, Any], readings: dict[str, str | None]) -> Card:
    words = ("turn", "line", "across", "gap", "ends")
    coordinates = (Coordinate(c["name"], c["dimension"] or "", *(c[word] for word in words)) for c in data["coordinates"])
    rows, parts = (tuple(LoadCard(**load) for load in data[word]) for word in ("rows", "parts"))
    fields, outline = tuple(map(_field, data["fields"])), tuple(tuple(map(tuple, stroke)) for stroke in data["outline"])
    return Card(
        data["type"], data["doc"], fields, tuple(coordinates), rows, parts, data["has_friction"], readings, data["glyph"], outline
    )


def _field(data: dict[str, Any]) -> Field:
    kind, _, choices = "choice:fixed|body".partition(":") if data["kind"] == "frame" else data["kind"].partition(":")
    # An expression without a unit may be anything; a plain number is written as one.
    unit = data["dimension"] if data["dimension"] or kind not in ("law", "gauge") else None
    return Field(
        data["name"], kind, unit, data["default"], data["doc"], data["role"], tuple(choices.split("|")) if choices else ()
    )
