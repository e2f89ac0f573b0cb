"""Bodies in the core's terms: pieces, points, lines and curves."""

from __future__ import annotations

from typing import Any

from freebody.core import Spec

from .arithmetic import Number, half
from .errors import Path
from .meanings import EVERY_BODY, SHAPE_POINTS
from .schema import SIZES, Body, CurveShape, Marked, Piece, Shaped, Stretch
from .tracks import circle, track
from .writer import Writer

_CORE_SHAPES = {"particle": "point", "triangle": "polygon", "general": "given"}


def points(write: Writer) -> None:
    """Bodies and their points; lines and curves come when all points of the model are known."""
    for name, body in write.scope.model.bodies.items():
        path: Path = ("bodies", name)
        full = write.prefix + name
        usual: dict[str, list[Number]] = {point: [0.0, 0.0] for point in ("origin", *SHAPE_POINTS.get(body.shape, ()))}
        if body.shape == "rod":
            length = write.number((*path, "length"), body.length, "m", "a length")
            usual |= {"start": [half(length, -1), 0.0], "end": [half(length), 0.0]}
        _points(write, full, body, path, usual)
        pieces = _pieces(write, path, full, body)
        write.spec["bodies"].append({"name": full, "particle": body.shape == "particle", "pieces": pieces})
    if write.scope.model.ground:
        _points(write, "ground", write.scope.model.ground, ("ground",), {"O": [0.0, 0.0], "origin": [0.0, 0.0]})


def lines(write: Writer) -> None:
    """Lines and curves; last the lines that only rename another."""
    model = write.scope.model
    marked: list[tuple[str, Marked, Path]] = [("ground", model.ground, ("ground",))] if model.ground else []
    marked += [(write.prefix + name, body, ("bodies", name)) for name, body in model.bodies.items()]
    for full, body, path in marked:
        owner = write.owner(full)
        for name, line in sorted(body.lines.items(), key=lambda item: isinstance(item[1], str)):
            write.lines[owner + name] = place = write.line((*path, "lines", name), line, full)
            write.spec["lines"].append({"name": owner + name, "line": place})
        for name, curve in body.curves.items():
            here = (*path, "curves", name)
            x, y = _curve(write, here, full, curve)
            write.spec["curves"].append({"name": owner + name, "body": full, "x": x, "y": y})
            if isinstance(curve, list) and curve:
                write.tracks[owner + name] = _track(write, here, full, curve)


# -- points


def _points(write: Writer, full: str, marked: Marked, path: Path, usual: dict[str, list[Number]]) -> None:
    owner = write.owner(full)
    own = {name: _found(write, (*path, "points", name), marked, usual) for name in marked.points}
    write.meanings.alias |= {owner + name: f"{full}.{at}" for name, at in own.items() if isinstance(at, str)}
    placed = {name: at for name, at in (usual | own).items() if not isinstance(at, str)}
    write.places |= {owner + name: at for name, at in placed.items()}
    hidden = ("O", "origin") if full == "ground" else EVERY_BODY
    named = ({"name": owner + name, "body": full, "at": at} for name, at in placed.items() if name not in hidden)
    write.spec["points"] += named


def _found(write: Writer, path: Path, marked: Marked, usual: dict[str, list[Number]]) -> list[Number] | str:
    """The coordinates of a named point, or the word ``G`` where it is the mass centre, whose place only the core knows."""
    body = "ground" if path[0] == "ground" else str(path[1])
    name, passed = str(path[-1]), list[str]()
    while True:
        passed.append(name)
        at = marked.points.get(name)
        if isinstance(at, list):
            return write.numbers((*path[:-1], name), at)
        if at is None and (name in usual or name == "G"):
            return usual.get(name, name)
        if at is None:
            known = ", ".join(f"`{k}`" for k in [*usual, "G", *marked.points])
            write.scope.complain(path, f"`{body}` has no point `{name}`", f"it has {known}")
            return [0.0, 0.0]
        if at in passed:
            what = f"the points {', '.join(passed)} only name one another"
            write.scope.complain(path, what, "give one of them coordinates `[x, y]`")
            return [0.0, 0.0]
        name = at.removeprefix(f"{body}.")


# -- mass


def _pieces(write: Writer, path: Path, full: str, body: Body) -> list[Spec]:
    given = body.pieces or []
    pairs = given.items() if isinstance(given, dict) else enumerate(given)
    pieces = [_placed(write, (*path, "pieces", key), piece) for key, piece in pairs]
    if not given:
        pieces = [_piece(write, path, body, body.centre)] if body.mass is not None else []
    for i, added in enumerate(body.point_masses):
        here = (*path, "point_masses", i)
        mass = write.number((*here, "mass"), added.mass, "kg", "a mass")
        pieces.append({"shape": "point", "mass": mass, "at": _place(write, (*here, "at"), full, added.at)})
    return pieces


def _placed(write: Writer, path: Path, piece: Piece) -> Spec:
    written, at = _piece(write, path, piece, None), write.numbers((*path, "at"), piece.at)
    return written | {"at": at, "angle": write.number((*path, "angle"), piece.angle, "rad")}


def _piece(write: Writer, path: Path, shaped: Shaped, centre: list[Any] | None) -> Spec:
    kind = _CORE_SHAPES.get(shaped.shape, shaped.shape)
    out: Spec = {"shape": kind, "mass": write.number((*path, "mass"), shaped.mass, "kg", "a mass")}
    sizes = [s for s in SIZES if s != "corners" and getattr(shaped, s) is not None]
    if sizes:
        out["sizes"] = {s: write.number((*path, s), getattr(shaped, s), "m", f"a {s}") for s in sizes}
    if shaped.corners:
        out["corners"] = [write.numbers((*path, "corners", i), corner) for i, corner in enumerate(shaped.corners)]
    if shaped.inertia is not None:
        out["inertia"] = write.number((*path, "inertia"), shaped.inertia, "kg*m^2", "an inertia")
    if centre is None:
        return out
    # The mass centre elsewhere; the inertia about it stays.
    here = (*path, "centre")
    at = write.numbers(here, centre)
    if "inertia" in out:
        return {"shape": "given", "mass": out["mass"], "inertia": out["inertia"], "at": at}
    if "corners" in out:
        what = "the mass centre of corners follows from them"
        write.scope.complain(here, what, "give `inertia` too, or leave `centre` out")
    return out | {"at": at}


def _place(write: Writer, path: Path, full: str, at: Any) -> list[Number]:
    if isinstance(at, list):
        return write.numbers(path, at)
    point = write.point(path, at, full)
    if point not in write.places:
        write.scope.complain(path, f"a mass cannot be added at `{at}`", "write its coordinates `[x, y]`")
    return write.places.get(point, [0.0, 0.0])


# -- curves


def _curve(write: Writer, path: Path, full: str, curve: Any) -> tuple[str, str]:
    if isinstance(curve, CurveShape) and curve.arc is None:
        x, y = (write.expression((*path, axis), getattr(curve, axis), "m", local="s") for axis in "xy")
        return x, y
    with write.scope.noting(path):
        if isinstance(curve, CurveShape):
            centre = _place(write, (*path, "arc", "centre"), full, curve.arc.centre)
            return circle(centre, write.number((*path, "arc", "radius"), curve.arc.radius, "m", "a radius"))
        return track(curve, lambda i, name: _place(write, (*path, i), full, name))
    return "s", "0"


def _track(write: Writer, path: Path, full: str, stretches: list[Stretch]) -> Spec:
    """A curve of lines and arcs as a surface."""
    point = lambda i, name: write.point((*path, i), name, full)
    stated = []
    for i, stretch in enumerate(stretches):
        to, centre = (stretch.line[1], None) if stretch.line is not None else (stretch.arc.to, point(i, stretch.arc.centre))
        stated.append({"to": point(i, to), "centre": centre})
    first = stretches[0].line
    return {"start": point(0, first[0]) if first else "ground.O", "stretches": stated}
