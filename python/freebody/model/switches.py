"""What switches, as types: contacts, strings, stops, and events with what they do."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain, pairwise
from typing import Literal

from pydantic import Field, model_validator

from .values import (
    Angle,
    Length,
    Name,
    Names,
    Number,
    Points,
    Section,
    Text,
    Texts,
    Time,
    TwoPoints,
    number_in,
    one_of,
    refuse,
    several,
)

Sense = Literal["ccw", "clockwise"]


class Limit(Section):
    """What contacts, strings and stops have in common."""

    restitution: Number = Field(0, description="Speed of parting over speed of approach, 0 to 1.")
    stiffness: number_in("N/m") = Field(None, description="Stiffness of a spring that stands for it; rigid when left out.")
    damping: number_in("N*s/m") = Field(None, description="Damping beside that spring.")
    engaged: bool = Field(True, description="Whether it is there from the start.")


class SurfaceShape(Section):
    """A surface: a line through a point, a circle, a polyline or a convex polygon of one body."""

    through: Name = Field(None, description="A point of a line; the free side is on its left.")
    angle: Angle = Field(None, description="Direction of that line from the x axis of its body.")
    centre: Name = Field(None, description="Centre of a circle.")
    radius: Length = Field(None, description="Radius of that circle.")
    hollow: bool = Field(False, description="Whether the free side of the circle is inside.")
    ends: several(Angle, "an arc has two ends: `[30 deg, 150 deg]`", most=2) = Field(
        None, description="Of an arc the directions of its ends from the centre, in the body's frame, counter-clockwise."
    )
    polyline: Points = Field(None, description="Corners of a polyline; the free side is on its left.")
    polygon: Points = Field(None, description="Corners of a convex polygon, in order, either way round.")

    @model_validator(mode="after")
    def _one_shape(self) -> SurfaceShape:
        given = self.model_fields_set - {"hollow", "ends"}
        if given not in ({"through", "angle"}, {"centre", "radius"}, {"polyline"}, {"polygon"}):
            raise refuse(*_NO_SURFACE)
        if self.hollow and self.centre is None:
            raise refuse("`hollow` belongs to a circle", "the free side of a line is on its left: turn it round")
        if self.ends is not None and self.centre is None:
            raise refuse("`ends` belong to a circle", "a `polyline` ends by itself")
        if self.polygon is not None and len(self.polygon) < 3:
            raise refuse(f"a polygon has 3 corners or more, not {len(self.polygon)}", "two corners make a `polyline`")
        return self


_NO_SURFACE = (
    "this is no surface",
    "write a body, `body.point`, `body.line`, `[P, Q]`, `{through: P, angle: a}`, `{centre: P, radius: r}`, "
    "with `ends` for an arc, `{polyline: [P, …]}` or `{polygon: [P, …]}`",
)
Surface = one_of(*_NO_SURFACE, text=Name, pair=TwoPoints, mapping=SurfaceShape)
Surfaces = several(Surface, "a contact is of two surfaces: `[ball, ground.floor]`", most=2)


class Contact(Limit):
    """Two surfaces that can push each other."""

    of: Surfaces = Field(description="The two surfaces.")
    friction: Number = Field(0, description="Coefficient of sliding friction.")
    static_friction: Number = Field(None, description="Coefficient of friction at rest; by default that of sliding.")
    rough: bool = Field(False, description="Whether it never slides while it is closed.")

    @model_validator(mode="after")
    def _rough_or_not(self) -> Contact:
        if self.rough and (alien := self.model_fields_set & {"friction", "static_friction"}):
            raise refuse(f"a rough contact never slides; `{min(alien)}` has no place here", "leave one of the two out")
        return self


class Drum(Section):
    """An end of a string on the rim of a drum on which it is wound."""

    drum: Name = Field(description="Centre of the drum.")
    radius: Length = Field(description="Radius of the drum.")
    sense: Sense = Field(description="Which way the string goes round the drum, followed from where it is attached.")
    attached: Angle = Field(None, description="Direction of the attachment from the centre, in the body's frame.")
    wound: Length = Field(None, description="Or the length that is wound at the start.")

    @model_validator(mode="after")
    def _attached_or_wound(self) -> Drum:
        if len(self.model_fields_set & {"attached", "wound"}) != 1:
            raise refuse("a drum needs either `attached` or `wound`", "give one of them, e.g. `wound: 0.5 m`")
        return self


class Pulley(Section):
    """A pulley that a string passes."""

    pulley: Name = Field(description="Centre of the pulley.")
    radius: Length = Field(description="Radius of the pulley.")
    sense: Sense = Field(description="Which way the string goes round it, followed from its first end.")


StringEnd = one_of(
    "this is no end of a string",
    "write `body.point`, or `{drum: P, radius: r, sense: clockwise, wound: 0.5 m}`",
    text=Name,
    mapping=Drum,
)
StringEnds = several(StringEnd, "a string has two ends: `[P, Q]`", most=2)
Guide = one_of(
    "a string cannot pass over this",
    "write `body.point`, or `{pulley: P, radius: r, sense: clockwise}`",
    text=Name,
    mapping=Pulley,
)


class String(Limit):
    """A string: it can only pull, and has no mass."""

    ends: StringEnds = Field(description="Its two ends.")
    over: list[Guide] = Field([], description="Points and pulleys that it passes without friction, from its first end.")
    length: Length = Field(None, description="Its length; just taut at the start when left out.")
    restitution: Number = Field(0, description="Speed of return over speed of stretching when it goes taut, 0 to 1.")


class Stop(Limit):
    """Ends of the way of a quantity of the configuration."""

    of: Text = Field(description="The coordinate, gauge or expression that is stopped.")
    least: Number = Field(None, description="The least that it can be.")
    most: Number = Field(None, description="The most that it can be.")
    stiffness: Number = Field(None, description="Stiffness of a spring that stands for it; rigid when left out.")
    damping: Number = Field(None, description="Damping beside that spring.")

    @model_validator(mode="after")
    def _has_an_end(self) -> Stop:
        if not self.model_fields_set & {"least", "most"}:
            raise refuse("this stop stops nothing", "add `least:`, `most:` or both")
        return self


class EventActions(Section):
    """What an event does. Of several in one mapping, what goes comes first, then what comes, then numbers, then the end."""

    release: Names = Field(None, description="Joints, motions, forces, contacts, stops or strings to take away.")
    cut: Names = Field(None, description="Strings to take away.")
    remove: Names = Field(None, description="Bodies from which everything that joins, touches or loads them is taken away.")
    unlock: Texts = Field(None, description="Quantities that were locked, to let go again.")
    engage: Names = Field(None, description="Joints, motions, forces, contacts, stops or strings to put in place.")
    weld: Names = Field(None, description="Two bodies or more to be joined as they are.")
    lock: Texts = Field(None, description="Quantities of the configuration to hold where they are.")
    reset: dict[str, Number] = Field(None, description="Quantities of the configuration with the rates they get at once.")
    set: dict[str, Number] = Field(None, description="Parameters with their new values.")
    hand_over: Name = Field(None, description="Another model file, as which the motion goes on.")

    @model_validator(mode="after")
    def _does_something(self) -> EventActions:
        if not self.model_fields_set:
            raise refuse(*_NO_ACTION)
        if self.weld is not None and (isinstance(self.weld, str) or len(self.weld) < 2):
            raise refuse("two bodies or more are welded", "write `{weld: [a, b]}`")
        return self


_NO_ACTION = ("this is no action", "write `record`, `stop`, `{set: {T: 0}}`, `{release: pin}`, … or a list of these")
Word = Literal["record", "stop"]
Action = one_of(*_NO_ACTION, text=Word, mapping=EventActions)
Actions = one_of(*_NO_ACTION, text=Word, pair=list[Action], mapping=EventActions)


class Event(Section):
    """Something to watch for during a motion, or a time."""

    when: Text = Field(None, description="The expression whose zero is the event.")
    at: Time = Field(None, description="Or the time of the event, or `start`: before anything moves.")
    direction: Literal["rising", "falling", "any"] = "any"
    condition: Text = Field(None, alias="if", description="It counts only while this holds.")
    then: Actions = "record"

    @model_validator(mode="after")
    def _when_or_at(self) -> Event:
        given = self.model_fields_set & {"when", "at"}
        if not given:
            raise refuse("`when` is missing", "add `when:` (an expression whose zero is the event) or `at:` (a time, or `start`)")
        if len(given) == 2:
            raise refuse("an event has `when` or `at`, not both", "for a time within a condition write `if: t > 2`")
        if "at" in given and "direction" in self.model_fields_set:
            raise refuse("an event at a time has no `direction`", "leave it out")
        return self

    def actions(self) -> list[str | EventActions]:
        """What happens then, as a list."""
        return list(self.then) if isinstance(self.then, list) else [self.then]

    def all(self, word: str) -> list[list[str]]:
        """What stands after a word (``release``, ``lock``) in each of its actions."""
        return [listed(getattr(each, word)) for each in self.actions() if isinstance(each, EventActions)]

    def welds(self, name: str) -> Iterator[tuple[str, str, str]]:
        """The joints that it makes when the event is called so: name and two bodies."""
        for i, (first, second) in enumerate(chain.from_iterable(map(pairwise, self.all("weld"))), 1):
            yield f"{name} weld" if i == 1 else f"{name} weld {i}", first, second


def listed(names: str | list[str] | None) -> list[str]:
    """A name or a list of names as a list."""
    return [] if names is None else [names] if isinstance(names, str) else list(names)
