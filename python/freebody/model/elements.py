"""Joints and forces of the language, made from the cards of the core: a new joint there is a new word here."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Union

from pydantic import Field, create_model
from pydantic_core import PydanticCustomError

from freebody.core import cards

from .values import Area, Circle, Line, Name, Number, Numbers, Points, Section, Text, number_in, one_of, refuse


class Element(Section):
    """What joints and forces have in common; ``type`` is the word of the card."""

    engaged: bool = Field(True, description="Whether it is in place from the start.")

    @classmethod
    def _unknown(cls, key: str) -> PydanticCustomError:
        word = cls.model_fields["type"].annotation.__args__[0]
        if key in _ONLY_OF:
            return refuse(f"a {word} takes no `{key}`", _ONLY_OF[key])
        return super()._unknown(key)


class Coordinate(Section):
    """How a coordinate is measured."""

    name: Name
    zero: Number = Field(0, description="Reading of the joint's own measure at which it is 0, or right, up, left, down.")
    sense: Literal["ccw", "clockwise", "forward", "backward"] = "ccw"
    absolute: bool = Field(False, description="Whether an angle is measured from the fixed x axis instead of the first body.")


CoordinateName = one_of("this is no coordinate", "write a name, or `{name: theta, zero: down}`", text=Name, mapping=Coordinate)

_KINDS: dict[str, Any] = {
    "point": Name,
    "points": Points,
    "line": Line,
    "circle": Circle,
    "area": Area,
    "curve": Name,
    "body": Name,
    "numbers": Numbers,
    "gauge": Text,
    "flag": bool,
}


def _model(card: cards.Card, more: dict[str, Any]) -> type[Element]:
    fields: dict[str, Any] = {"type": (Literal[card.type], Field(description=card.doc))}
    for field in card.fields:
        number = number_in(field.unit or "") if field.kind in ("number", "law") else None
        type_ = Literal[field.choices] if field.kind == "choice" else number or _KINDS[field.kind]
        described = Field(... if field.required else None, description=f"{field.doc[:1].upper()}{field.doc[1:]}.")
        fields[field.name] = (type_, described)
    name = "".join(word.capitalize() for word in card.type.split("_"))
    return create_model(name, __base__=Element, __doc__=card.doc, **fields, **more)


def _coordinates(card: cards.Card) -> dict[str, Any]:
    if not card.coordinates:
        return {}
    usual = ", ".join(c.name for c in card.coordinates)
    return {
        "coordinate": (CoordinateName, Field(None, description=f"The first coordinate ({usual}).")),
        "coordinates": (list[CoordinateName], Field(None, description=f"All coordinates, in this order: {usual}.")),
    }


def _switches(card: cards.Card) -> dict[str, Any]:
    words: dict[str, Any] = {}
    if card.presses:
        words["one_sided"] = (bool, Field(False, description="Whether it only pushes, and is released where it would pull."))
    if has_ends(card):
        stated = "What happens where the line ends: it is free and the joint released, or there are stops."
        words["ends"] = (Literal["free", "stop"], Field(None, description=stated))
        words["end_restitution"] = (Number, Field(0, description="Restitution of the stops at the ends, 0 to 1."))
    if card.has_friction:
        stated = "Coefficient of sliding friction, by the size of the force that the joint carries."
        words["friction"] = (Number, Field(None, description=stated))
        stated = "Coefficient of friction at rest; that of sliding by default."
        words["static_friction"] = (Number, Field(None, description=stated))
        if card.coordinates[0].unit == "rad":
            words["bearing_radius"] = (number_in("m"), Field(None, description="Radius at which the friction of a hinge acts."))
    return words


def has_ends(card: cards.Card) -> bool:
    """Whether it is a joint along a line, on which the first coordinate is a place."""
    return any(field.name == "along" and field.kind == "line" for field in card.fields)


_ONLY_OF = {
    "one_sided": "along a curve write a `one_sided_cam`, for a point with a follower of radius 0; for two bodies that push each other "
    "a contact, under `contacts`",
    "ends": f"only {', '.join(word for word, card in cards.joints().items() if has_ends(card))} run along a line with ends; "
    "for others write a stop, under `stops`",
}
_ONLY_OF["end_restitution"] = _ONLY_OF["ends"]
_ONLY_OF |= dict.fromkeys(
    ("friction", "static_friction"), "friction is for hinges, slots, curved slots and sliders; for surfaces write a contact"
)
_ONLY_OF["bearing_radius"] = "only a hinge has a bearing"

JOINTS = {word: _model(card, _coordinates(card) | _switches(card)) for word, card in cards.joints().items()}
FORCES = {word: _model(card, {}) for word, card in cards.forces().items()}

Joint = Annotated[Union[tuple(JOINTS.values())], Field(discriminator="type")]  # noqa: UP007
Force = Annotated[Union[tuple(FORCES.values())], Field(discriminator="type")]  # noqa: UP007


def given(element: Element, name: str) -> Any:
    """The value of a field, None where it was left out; the name may be a Python keyword."""
    return getattr(element, name) if name in element.model_fields_set else None


def coordinates(element: Element) -> list[str | Coordinate]:
    """The coordinates that a joint names."""
    one = given(element, "coordinate")
    return [one] if one is not None else list(given(element, "coordinates") or [])
