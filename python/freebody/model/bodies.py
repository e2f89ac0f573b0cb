"""Bodies in the core's terms: pieces, points, lines and curves."""

from __future__ import annotations

from typing import Any

from freebody.core import Spec

from .arithmetic import Number, half
from .errors import ModelProblem, Path
from .meanings import EVERY_BODY, SHAPE_POINTS
from .schema import Body, CurveShape, Marked, Piece, Shaped, Stretch
from .tracks import circle, track
from .writer import Writer

_CORE_SHAPES = {"particle": "point", "triangle": "polygon", "general": "given"}
_SIZES = ("length", "radius", "width", "height")


class BodyWriter:
    """Writes the bodies and the ground of one scope into the spec of the core."""

    def __init__(self, write: Writer) -> None:
        self.write, self.spec = write, write.spec
        self.places: dict[str, list[Number]] = {"ground.O": [0.0, 0.0]}
        self.tracks: dict[str, Spec] = {}

    def all_points(self) -> None:
        """Bodies and their points; lines and curves come when all points of the model are known."""
        for name, body in self.write.scope.model.bodies.items():
            path: Path = ("bodies", name)
            full = self.write.prefix + name
            usual: dict[str, list[Number]] = {"origin": [0.0, 0.0]} | {n: [0.0, 0.0] for n in SHAPE_POINTS.get(body.shape, ())}
            if body.shape == "rod":
                length = self.write.number((*path, "length"), body.length, "m", "a length")
                usual |= {"start": [half(length, -1), 0.0], "end": [half(length), 0.0]}
            self._points(full, body, path, usual)
            self.spec["bodies"].append(
                {"name": full, "particle": body.shape == "particle", "pieces": self._pieces(path, full, body)}
            )
        if self.write.scope.model.ground:
            self._points("ground", self.write.scope.model.ground, ("ground",), {"O": [0.0, 0.0], "origin": [0.0, 0.0]})

    def all_lines(self) -> None:
        """Lines and curves; last the lines that only rename another."""
        model = self.write.scope.model
        marked: list[tuple[str, Marked, Path]] = [("ground", model.ground, ("ground",))] if model.ground else []
        marked += [(self.write.prefix + name, body, ("bodies", name)) for name, body in model.bodies.items()]
        for full, body, path in marked:
            owner = self._owner(full)
            for name, line in sorted(body.lines.items(), key=lambda item: isinstance(item[1], str)):
                place = self.write.line((*path, "lines", name), line, full)
                self.write.lines[owner + name] = place
                self.spec["lines"].append({"name": owner + name, "line": place})
            for name, curve in body.curves.items():
                here = (*path, "curves", name)
                x, y = self._curve(here, full, curve)
                self.spec["curves"].append({"name": owner + name, "body": full, "x": x, "y": y})
                if isinstance(curve, list) and curve:
                    self.tracks[owner + name] = self._track(here, full, curve)

    def _owner(self, full: str) -> str:
        return f"ground.{self.write.prefix}" if full == "ground" else f"{full}."

    # -- points

    def _points(self, full: str, marked: Marked, path: Path, usual: dict[str, list[Number]]) -> None:
        owner = self._owner(full)
        for name, at in usual.items():
            self.places[owner + name] = at
            if name not in EVERY_BODY and full != "ground":
                self._point(owner + name, full, at)
        for name in marked.points:
            found = self._found((*path, "points", name), marked, usual)
            if isinstance(found, str):
                self.write.meanings.alias[owner + name] = f"{full}.{found}"
            else:
                self.places[owner + name] = found
                self._point(owner + name, full, found)

    def _point(self, name: str, body: str, at: list[Number]) -> None:
        self.spec["points"].append({"name": name, "body": body, "at": at})

    def _found(self, path: Path, marked: Marked, usual: dict[str, list[Number]]) -> list[Number] | str:
        """The coordinates of a named point, or the word ``G`` where it is the mass centre, whose place only the core knows."""
        body = "ground" if path[0] == "ground" else str(path[1])
        name, passed = str(path[-1]), []
        while True:
            passed.append(name)
            at = marked.points.get(name)
            if isinstance(at, list):
                return self.write.numbers((*path[:-1], name), at)
            if at is None and (name in usual or name == "G"):
                return usual.get(name, name)
            if at is None or at in passed:
                known = ", ".join(f"`{k}`" for k in [*usual, "G", *marked.points])
                what = (
                    f"`{body}` has no point `{name}`" if at is None else f"the points {', '.join(passed)} only name one another"
                )
                self.write.scope.complain(
                    path, what, f"it has {known}" if at is None else "give one of them coordinates `[x, y]`"
                )
                return [0.0, 0.0]
            name = at.removeprefix(f"{body}.")

    # -- mass

    def _pieces(self, path: Path, full: str, body: Body) -> list[Spec]:
        given = body.pieces or []
        pairs = given.items() if isinstance(given, dict) else enumerate(given)
        pieces = [self._placed((*path, "pieces", key), piece) for key, piece in pairs]
        if not given:
            pieces = [self._piece(path, body, body.centre)] if body.mass is not None else []
        for i, added in enumerate(body.point_masses):
            here = (*path, "point_masses", i)
            mass = self.write.number((*here, "mass"), added.mass, "kg", "a mass")
            pieces.append({"shape": "point", "mass": mass, "at": self._place((*here, "at"), full, added.at)})
        return pieces

    def _placed(self, path: Path, piece: Piece) -> Spec:
        written = self._piece(path, piece, None)
        at = self.write.numbers((*path, "at"), piece.at)
        return written | {"at": at, "angle": self.write.number((*path, "angle"), piece.angle, "rad")}

    def _piece(self, path: Path, shaped: Shaped, centre: list[Any] | None) -> Spec:
        number = self.write.number
        kind = _CORE_SHAPES.get(shaped.shape, shaped.shape)
        out: Spec = {"shape": kind, "mass": number((*path, "mass"), shaped.mass, "kg", "a mass")}
        sizes = [s for s in _SIZES if getattr(shaped, s) is not None]
        if sizes:
            out["sizes"] = {s: number((*path, s), getattr(shaped, s), "m", f"a {s}") for s in sizes}
        if shaped.corners:
            out["corners"] = [self.write.numbers((*path, "corners", i), corner) for i, corner in enumerate(shaped.corners)]
        if shaped.inertia is not None:
            out["inertia"] = number((*path, "inertia"), shaped.inertia, "kg*m^2", "an inertia")
        return out if centre is None else self._moved((*path, "centre"), centre, out)

    def _moved(self, path: Path, centre: list[Any], piece: Spec) -> Spec:
        """The piece with its mass centre elsewhere; its inertia about the mass centre stays."""
        at = self.write.numbers(path, centre)
        if "inertia" in piece:
            return {"shape": "given", "mass": piece["mass"], "inertia": piece["inertia"], "at": at}
        if "corners" in piece:
            self.write.scope.complain(
                path, "the mass centre of corners follows from them", "give `inertia` too, or leave `centre` out"
            )
        return piece | {"at": at}

    def _place(self, path: Path, full: str, at: Any) -> list[Number]:
        if isinstance(at, list):
            return self.write.numbers(path, at)
        point = self.write.point(path, at, full)
        if point not in self.places:
            self.write.scope.complain(path, f"a mass cannot be added at `{at}`", "write its coordinates `[x, y]`")
        return self.places.get(point, [0.0, 0.0])

    # -- curves

    def _curve(self, path: Path, full: str, curve: Any) -> tuple[str, str]:
        if isinstance(curve, CurveShape) and curve.arc is None:
            return tuple(self.write.expression((*path, axis), getattr(curve, axis), "m", local="s") for axis in "xy")  # type: ignore[return-value]
        try:
            if isinstance(curve, CurveShape):
                centre = self._place((*path, "arc", "centre"), full, curve.arc.centre)
                return circle(centre, self.write.number((*path, "arc", "radius"), curve.arc.radius, "m", "a radius"))
            return track(curve, lambda i, name: self._place((*path, i), full, name))
        except ModelProblem as complaint:
            self.write.scope.complain(path, complaint.what, complaint.hint)
            return "s", "0"

    def _track(self, path: Path, full: str, stretches: list[Stretch]) -> Spec:
        """A curve of lines and arcs as a surface."""
        point = lambda i, name: self.write.point((*path, i), name, full)
        stated = []
        for i, stretch in enumerate(stretches):
            to, centre = (stretch.line[1], None) if stretch.line is not None else (stretch.arc.to, point(i, stretch.arc.centre))
            stated.append({"to": point(i, to), "centre": centre})
        first = stretches[0].line
        return {"start": point(0, first[0]) if first else "ground.O", "stretches": stated}
