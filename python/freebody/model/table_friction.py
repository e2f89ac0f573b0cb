"""Bodies that slide on a table: with which area they lie on it, and where they, or points of them, come to rest, as the events it
comes to."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from freebody.core import Spec

from . import elements
from .names import spell

if TYPE_CHECKING:
    from .outlines import Outlines
    from .writer import Writer

OF_PLATE = "plate_friction"
WORDS = ("table_friction", OF_PLATE)
HELD = 1e-3
"""Speed of a point, over the mean of all, below which it stays where it is: its friction is drawn to no speed in finite time."""


def resting(name: str) -> str:
    """The event at which the body rests."""
    return f"{name} rests"


def holding(name: str, force: elements.Element, is_driven: bool) -> dict[str, str]:
    """The events at which one of several points of a body stays where it is while others slide, each with its point; none where
    a motion is prescribed, which may carry points on through rest."""
    points = elements.given(force, "points") or [] if force.type != OF_PLATE and not is_driven else []
    return {f"{name} holds {point}": point for point in points if len(points) > 1}


def lies(write: Writer, outlines: Outlines, name: str, force: elements.Element, written: Spec) -> None:
    """The area with which a body lies on the table, into the force as it is ``written``; a ring lies on its rim."""
    path, area = ("forces", name, "area"), elements.given(force, "area")
    if isinstance(area, str):
        body, found = write.place(path, area, "body"), {}
        with write.scope.noting(path):
            found = outlines.of(body)
        if "point" in found:
            write.scope.complain(path, f"the particle `{area}` has no area", "write a `table_friction` at its point")
        written["with"]["area"] = found.get("circle", found.get("polygon", []))
        if elements.given(force, "rim") is None and body in outlines.bodies and outlines.bodies[body][2].shape == "ring":
            written["with"]["rim"] = True
    elif isinstance(area, list):
        written["with"]["area"] = [write.point((*path, i), corner) for i, corner in enumerate(area)]
    else:
        written["with"]["area"] = write.circle(path, area)


def rest(write: Writer, name: str, force: elements.Element, written: Spec) -> None:
    """The events that end a run where what a force, which has been ``written``, rubs on has all but stopped, or one of its points
    has: what friction at rest holds is not decided."""
    fields = written["with"]
    whens = {resting(name): f"{_speed(fields)} - ({fields.get('rest_speed', 1e-10)})"}
    for event, point in zip(holding(name, force, write.meanings.is_driven), fields.get("points", ()), strict=False):
        whens[event] = f"{_speed({'points': [point]})} - {HELD}*{_speed(fields)}"
    plain = {"direction": -1, "condition": None, "opening": False, "guard": True}
    for event, when in whens.items():
        full = write.prefix + event
        write.spec["events"].append({"name": full, "when": when} | plain | {"then": ["stop"]})
        write.items[f"events.{full}"] = (write.scope, ("forces", name))


def _speed(fields: dict[str, Any]) -> str:
    """The mean speed of the points or corners on which a body lies; of a circle the rms speed of its rim."""
    lies_on = fields.get("points", fields.get("area"))
    if isinstance(lies_on, dict):
        centre = lies_on["centre"]
        return f"hypot(speed({spell(centre)}), ({lies_on['radius']})*omega({spell(centre.rpartition('.')[0])}))"
    return f"({' + '.join(f'hypot(vx({p}), vy({p}))' for p in map(spell, lies_on))})/{len(lies_on)}"
