"""Contacts, strings and stops in the core's terms."""

from __future__ import annotations

from freebody.core import Spec

from .arithmetic import text
from .errors import Path
from .names import suggestion, unquote
from .outlines import Outlines
from .switches import Contact, Drum, Limit, Pulley, Stop, String, SurfaceShape
from .writer import Writer, body_of

_SENSES = {"ccw": 1, "clockwise": -1}


def limits(outlines: Outlines, write: Writer) -> None:
    """Everything of a scope that can only push or only pull."""
    model, spec = write.scope.model, write.spec
    spec["contacts"] += [_contact(write, outlines, name, contact) for name, contact in model.contacts.items()]
    spec["strings"] += [_string(write, name, string) for name, string in model.strings.items()]
    spec["stops"] += [made for name, stop in model.stops.items() for made in _stops(write, name, stop)]


def _common(write: Writer, path: Path, limit: Limit) -> Spec:
    """Restitution, whether it is there, and the spring and damper that stand for it, if it has them."""
    # Of a stop they may be couples by rad.
    units = {"stiffness": "N/m", "damping": "N*s/m"} if not isinstance(limit, Stop) else {"stiffness": None, "damping": None}
    given = {word: getattr(limit, word) for word in units if getattr(limit, word) is not None}
    restitution = write.fraction((*path, "restitution"), limit.restitution, "a restitution")
    soft = {word: write.number((*path, word), value, units[word]) for word, value in given.items()}
    return {"restitution": restitution, **soft, "engaged": limit.engaged}


# -- contacts


def _contact(write: Writer, outlines: Outlines, name: str, contact: Contact) -> Spec:
    path: Path = ("contacts", name)
    number = write.number
    friction = number((*path, "friction"), contact.friction, "", "a friction")
    fixed = None
    if contact.static_friction is not None:
        fixed = number((*path, "static_friction"), contact.static_friction, "", "a friction")
        sliding, resting = (write.size(value) for value in (contact.friction, contact.static_friction))
        if sliding is not None and resting is not None and resting < sliding:
            what = f"friction at rest is {resting:g}, below that of sliding, {sliding:g}"
            write.scope.complain((*path, "static_friction"), what, "leave it out to have them equal")
    return {
        "name": write.prefix + name,
        "of": [_surface(write, outlines, (*path, "of", i), surface) for i, surface in enumerate(contact.of)],
        "friction": friction,
        "static_friction": fixed,
        "rough": contact.rough,
        **_common(write, path, contact),
    }


def _surface(write: Writer, outlines: Outlines, path: Path, surface: str | list[str] | SurfaceShape) -> Spec:
    if isinstance(surface, str):
        return _named(write, outlines, path, surface)
    if isinstance(surface, list) or surface.through is not None:
        return {"line": write.line(path, surface)}
    if surface.centre is not None:
        ends = {"ends": write.numbers((*path, "ends"), surface.ends, "rad")} if surface.ends is not None else {}
        return {"circle": write.circle(path, surface) | {"hollow": surface.hollow} | ends}
    kind = "polyline" if surface.polyline is not None else "polygon"
    corners = getattr(surface, kind)
    found = [write.point((*path, kind, i), corner) for i, corner in enumerate(corners)]
    if len({body_of(point) for point in found}) > 1:
        write.scope.complain((*path, kind), f"the corners of a {kind} belong to several bodies", "take those of one")
    return {kind: found}


def _named(write: Writer, outlines: Outlines, path: Path, name: str) -> Spec:
    """A body, a point or a line by its name."""
    meanings, scope = write.meanings, write.scope
    full = write.full(unquote(name).strip())
    point, line = full in meanings.points, full in meanings.lines
    if point and line:
        scope.complain(path, f"`{name}` is a point and a line", "give one of them another name")
    if full in meanings.bodies:
        with scope.noting(path):
            return outlines.of(full)
    elif line:
        return {"line": write.line(path, name)}
    elif full in write.tracks:
        return {"track": write.tracks[full]}
    elif full in meanings.curves:
        what = f"`{name}` is a curve by its formulas, and a contact is of straight lines and arcs"
        scope.complain(path, what, "write it as a list of lines and arcs, or as a `polyline`")
    elif "." not in name:
        known = meanings.seen_from(scope, meanings.bodies)
        scope.complain(path, f"there is no body `{name}`", suggestion(name, known))
    else:
        return {"point": write.point(path, name)}
    return {"point": "ground.O"}


# -- strings


def _string(write: Writer, name: str, string: String) -> Spec:
    path: Path = ("strings", name)
    length = None if string.length is None else write.number((*path, "length"), string.length, "m", "a length")
    return {
        "name": write.prefix + name,
        "ends": [_end(write, (*path, "ends", i), end) for i, end in enumerate(string.ends)],
        "over": [
            {"eyelet": write.point(here, guide)} if isinstance(guide, str) else {"pulley": _wheel(write, here, "pulley", guide)}
            for here, guide in (((*path, "over", i), guide) for i, guide in enumerate(string.over))
        ],
        "length": length,
        **_common(write, path, string),
    }


def _end(write: Writer, path: Path, end: str | Drum) -> Spec:
    if isinstance(end, str):
        return {"point": write.point(path, end)}
    number = write.number
    attached = None if end.attached is None else number((*path, "attached"), end.attached, "rad")
    wound = None if end.wound is None else number((*path, "wound"), end.wound, "m", "a length")
    return {"drum": _wheel(write, path, "drum", end) | {"attached": attached, "wound": wound}}


def _wheel(write: Writer, path: Path, word: str, wheel: Drum | Pulley) -> Spec:
    return {
        "centre": write.point((*path, word), getattr(wheel, word)),
        "radius": write.number((*path, "radius"), wheel.radius, "m", "a radius"),
        "sense": _SENSES[wheel.sense],
    }


# -- stops


def _stops(write: Writer, name: str, stop: Stop) -> list[Spec]:
    """One stop of the core for each side."""
    path: Path = ("stops", name)
    of, dimension = write.expression((*path, "of"), stop.of), write.dimension(stop.of)
    of = of if of.isidentifier() else f"({of})"
    gaps: dict[str, str] = {}
    if stop.least is not None:
        gaps["least"] = f"{of} - {text(write.number((*path, 'least'), stop.least, dimension))}"
    if stop.most is not None:
        gaps["most"] = f"{text(write.number((*path, 'most'), stop.most, dimension))} - {of}"
    least, most = (None if side is None else write.size(side) for side in (stop.least, stop.most))
    if least is not None and most is not None and least >= most:
        what = f"the least ({least:g}) is not below the most ({most:g})"
        write.scope.complain((*path, "least"), what, "exchange the two, or hold the quantity with a motion")
    full = write.prefix + name
    plain = _common(write, path, stop)
    return [{"name": full if len(gaps) == 1 else f"{full}.{side}", "gap": gap, **plain} for side, gap in gaps.items()]
