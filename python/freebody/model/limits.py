"""Contacts, strings and stops in the core's terms."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from freebody.core import Spec

from .arithmetic import text
from .errors import ModelProblem, Path
from .names import suggestion, unquote
from .outlines import Outlines
from .switches import Contact, Drum, Pulley, Stop, String, SurfaceShape
from .writer import Writer, body_of

_SENSES = {"ccw": 1, "clockwise": -1}


@dataclass
class LimitWriter:
    """Writes the contacts, strings and stops of one scope."""

    write: Writer
    outlines: Outlines
    tracks: Mapping[str, Spec]

    def all(self) -> None:
        """Everything of this scope that can only push or only pull."""
        model, spec = self.write.scope.model, self.write.spec
        spec["contacts"] += [self._contact(name, contact) for name, contact in model.contacts.items()]
        spec["strings"] += [self._string(name, string) for name, string in model.strings.items()]
        spec["stops"] += [made for name, stop in model.stops.items() for made in self._stops(name, stop)]

    def _soft(self, path: Path, limit: Contact | String | Stop) -> Spec:
        """Spring and damper that stand for it, if it has them."""
        # Of a stop they may be couples by rad.
        units = {"stiffness": "N/m", "damping": "N*s/m"} if not isinstance(limit, Stop) else {"stiffness": None, "damping": None}
        given = {word: getattr(limit, word) for word in units if getattr(limit, word) is not None}
        return {word: self.write.number((*path, word), value, units[word]) for word, value in given.items()}

    # -- contacts

    def _contact(self, name: str, contact: Contact) -> Spec:
        path: Path = ("contacts", name)
        number = self.write.number
        friction = number((*path, "friction"), contact.friction, "", "a friction")
        fixed = None
        if contact.static_friction is not None:
            fixed = number((*path, "static_friction"), contact.static_friction, "", "a friction")
            sliding, resting = (self.write.size(value) for value in (contact.friction, contact.static_friction))
            if sliding is not None and resting is not None and resting < sliding:
                what = f"friction at rest is {resting:g}, below that of sliding, {sliding:g}"
                self.write.scope.complain((*path, "static_friction"), what, "leave it out to have them equal")
        return {
            "name": self.write.prefix + name,
            "of": [self._surface((*path, "of", i), surface) for i, surface in enumerate(contact.of)],
            "friction": friction,
            "static_friction": fixed,
            "rough": contact.rough,
            "restitution": self.write.fraction((*path, "restitution"), contact.restitution, "a restitution"),
            **self._soft(path, contact),
            "engaged": contact.engaged,
        }

    def _surface(self, path: Path, surface: str | list[str] | SurfaceShape) -> Spec:
        if isinstance(surface, str):
            return self._named(path, surface)
        if isinstance(surface, list) or surface.through is not None:
            return {"line": self.write.line(path, surface)}
        if surface.centre is not None:
            ends = {"ends": self.write.numbers((*path, "ends"), surface.ends, "rad")} if surface.ends is not None else {}
            return {"circle": self.write.circle(path, surface) | {"hollow": surface.hollow} | ends}
        kind = "polyline" if surface.polyline is not None else "polygon"
        corners = getattr(surface, kind)
        found = [self.write.point((*path, kind, i), corner) for i, corner in enumerate(corners)]
        if len({body_of(point) for point in found}) > 1:
            self.write.scope.complain((*path, kind), f"the corners of a {kind} belong to several bodies", "take those of one")
        return {kind: found}

    def _named(self, path: Path, name: str) -> Spec:
        """A body, a point or a line by its name."""
        meanings, scope = self.write.meanings, self.write.scope
        full = self.write.full(unquote(name).strip())
        point, line = full in meanings.points, full in meanings.lines
        if point and line:
            scope.complain(path, f"`{name}` is a point and a line", "give one of them another name")
        if full in meanings.bodies:
            try:
                return self.outlines.of(full)
            except ModelProblem as complaint:
                scope.complain(path, complaint.what, complaint.hint)
        elif line:
            return {"line": self.write.line(path, name)}
        elif full in self.tracks:
            return {"track": self.tracks[full]}
        elif full in meanings.curves:
            what = f"`{name}` is a curve by its formulas, and a contact is of straight lines and arcs"
            scope.complain(path, what, "write it as a list of lines and arcs, or as a `polyline`")
        elif "." not in name:
            known = meanings.seen_from(scope, meanings.bodies)
            scope.complain(path, f"there is no body `{name}`", suggestion(name, known))
        else:
            return {"point": self.write.point(path, name)}
        return {"point": "ground.O"}

    # -- strings

    def _string(self, name: str, string: String) -> Spec:
        path: Path = ("strings", name)
        length = None if string.length is None else self.write.number((*path, "length"), string.length, "m", "a length")
        return {
            "name": self.write.prefix + name,
            "ends": [self._end((*path, "ends", i), end) for i, end in enumerate(string.ends)],
            "over": [self._guide((*path, "over", i), guide) for i, guide in enumerate(string.over)],
            "length": length,
            "restitution": self.write.fraction((*path, "restitution"), string.restitution, "a restitution"),
            **self._soft(path, string),
            "engaged": string.engaged,
        }

    def _end(self, path: Path, end: str | Drum) -> Spec:
        if isinstance(end, str):
            return {"point": self.write.point(path, end)}
        number = self.write.number
        attached = None if end.attached is None else number((*path, "attached"), end.attached, "rad")
        wound = None if end.wound is None else number((*path, "wound"), end.wound, "m", "a length")
        return {"drum": self._wheel(path, "drum", end) | {"attached": attached, "wound": wound}}

    def _guide(self, path: Path, guide: str | Pulley) -> Spec:
        return (
            {"eyelet": self.write.point(path, guide)}
            if isinstance(guide, str)
            else {"pulley": self._wheel(path, "pulley", guide)}
        )

    def _wheel(self, path: Path, word: str, wheel: Drum | Pulley) -> Spec:
        return {
            "centre": self.write.point((*path, word), getattr(wheel, word)),
            "radius": self.write.number((*path, "radius"), wheel.radius, "m", "a radius"),
            "sense": _SENSES[wheel.sense],
        }

    # -- stops

    def _stops(self, name: str, stop: Stop) -> list[Spec]:
        """One stop of the core for each side."""
        path: Path = ("stops", name)
        of, dimension = self.write.expression((*path, "of"), stop.of), self.write.dimension(stop.of)
        of = of if of.isidentifier() else f"({of})"
        restitution = self.write.fraction((*path, "restitution"), stop.restitution, "a restitution")
        soft = self._soft(path, stop)
        gaps: dict[str, str] = {}
        if stop.least is not None:
            gaps["least"] = f"{of} - {text(self.write.number((*path, 'least'), stop.least, dimension))}"
        if stop.most is not None:
            gaps["most"] = f"{text(self.write.number((*path, 'most'), stop.most, dimension))} - {of}"
        least, most = (None if side is None else self.write.size(side) for side in (stop.least, stop.most))
        if least is not None and most is not None and least >= most:
            what = f"the least ({least:g}) is not below the most ({most:g})"
            self.write.scope.complain((*path, "least"), what, "exchange the two, or hold the quantity with a motion")
        full = self.write.prefix + name
        plain = {"restitution": restitution, **soft, "engaged": stop.engaged}
        return [{"name": full if len(gaps) == 1 else f"{full}.{side}", "gap": gap, **plain} for side, gap in gaps.items()]
