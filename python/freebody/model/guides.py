"""Guides with ends and joints that only push, as the stops and events they come to."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from freebody.core import Spec, cards

from . import elements, scope
from .arithmetic import distance, text
from .errors import Path
from .names import spell

if TYPE_CHECKING:
    from .writer import Writer


_WOUND_UP = 1e-4
"""Radii of a drum, below which the inertia against a turn about the end of the string begins to be lost in round-off."""


def leaving(joint: str) -> list[str]:
    """The events at the two ends of a guide."""
    return [f"{joint} leaves start", f"{joint} leaves end"]


def lifting(name: str, joint: elements.Element) -> list[tuple[str, str]]:
    """The events at which a one-sided joint would begin to pull, each with the push that then vanishes."""
    rows = cards.joints()[joint.type].presses
    # Inside another circle a circle is pushed inwards, against the sense in which the distance of the centres grows.
    sign = "-" if elements.given(joint, "inside") else ""
    return [(f"{name} lifts off {row}" if len(rows) > 1 else f"{name} lifts off", f"{sign}{{}}.F{row}") for row in rows]


def endings(name: str, joint: elements.Element) -> list[tuple[str, int]]:
    """The events that end a motion where a coordinate falls to 0, each with which one."""
    coordinates = cards.joints()[joint.type].coordinates
    return [(f"{name} {coordinate.ends}", k) for k, coordinate in enumerate(coordinates) if coordinate.ends]


def ends_and_side(write: Writer, name: str, joint: elements.Element, written: Spec) -> None:
    """The stops and events that the ends and the one side of a joint come to, which has been ``written``."""
    path: Path = ("joints", name)
    full = written["name"]
    if ends := elements.given(joint, "ends"):
        _ends(write, (*path, "ends"), name, joint, written, ends)
    elif elements.given(joint, "end_restitution") is not None:
        here = (*path, "end_restitution")
        write.scope.complain(here, "`end_restitution` belongs to the stops of `ends: stop`", "leave it out")
    if (gap := cards.joints()[joint.type].gap) is not None:
        written["engaged"] = True  # what is engaged is the stop; its coordinates are there in any case
        given = elements.given(joint, "restitution")
        restitution = write.fraction((*path, "restitution"), 0 if given is None else given, "a restitution")
        _stop(write, f"{full}.contact", _place(write, name, joint, written, gap), restitution, joint, path)
    for event, k in endings(name, joint):
        free, radius = _place(write, name, joint, written, k), written["with"]["drum"]["radius"]
        _event(write, event, f"{free} - {_WOUND_UP}*({text(radius)})", "stop", path)
    if elements.given(joint, "one_sided"):
        for event, push in lifting(name, joint):
            _event(write, event, push.format(spell(full)), {"release": [full]}, (*path, "one_sided"))


def _ends(write: Writer, path: Path, name: str, joint: elements.Element, written: Spec, ends: str) -> None:
    line = written["with"]["along"]
    if "towards" not in line:
        what = "a guide with ends runs from one point to another, and this line has only one"
        write.scope.complain(path, what, "write `along: [P, Q]`")
        return
    first, second = line["point"], line["towards"]
    known = first in write.places and second in write.places
    length = distance(write.places[first], write.places[second]) if known else f"distance({spell(first)}, {spell(second)})"
    at = _place(write, name, joint, written)
    beyond = at if at.isidentifier() else f"({at})"
    gaps = (at, f"{text(length)} - {beyond}")
    if ends == "free":
        for event, gap in zip(leaving(name), gaps, strict=True):
            _event(write, event, gap, {"release": [written["name"]]}, path)
        return
    given = elements.given(joint, "end_restitution")
    restitution = write.fraction((*path[:-1], "end_restitution"), 0 if given is None else given, "a restitution")
    for side, gap in zip(("start", "end"), gaps, strict=True):
        _stop(write, f"{written['name']}.{side}", gap, restitution, joint, path)


def _stop(write: Writer, stop: str, gap: str, restitution: Any, joint: elements.Element, path: Path) -> None:
    write.spec["stops"].append({"name": stop, "gap": gap, "restitution": restitution, "engaged": joint.engaged})
    write.items[f"stops.{stop}"] = (write.scope, path)


def _place(write: Writer, name: str, joint: elements.Element, written: Spec, which: int = 0) -> str:
    """How far along its line the joint is, by its first coordinate, or the measure of another."""
    own, _ = scope.coordinate_names(name, joint)[which]
    coordinate = spell(write.prefix + own)
    given = dict(enumerate(written["coordinates"])).get(which, {})
    zero, sign = given.get("zero", 0.0), "-" if given.get("sense") == -1 else "+"
    if zero == 0.0:
        return coordinate if sign == "+" else f"-{coordinate}"
    return f"{text(zero)} {sign} {coordinate}"


def _event(write: Writer, name: str, when: str, then: str | Spec, path: Path) -> None:
    """What happens as soon as an expression is not above 0."""
    full = write.prefix + name
    plain = {"direction": -1, "condition": None, "opening": False, "guard": True}
    write.spec["events"].append({"name": full, "when": when} | plain | {"then": [then]})
    write.items[f"events.{full}"] = (write.scope, path)
