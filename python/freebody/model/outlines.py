"""The surfaces that bodies have by their shapes."""

from __future__ import annotations

from collections.abc import Sequence

from freebody.core import Spec

from .arithmetic import Number, half, placed
from .errors import ModelProblem, Path
from .schema import Body, Shaped
from .writer import Writer

HIDDEN = "outline"
"""Points that only surfaces know are called ``body.outline[1]`` and so on."""


class Outlines:
    """The outlines of all bodies, with the corners among the points of the spec."""

    def __init__(self, writers: Sequence[Writer]) -> None:
        self.bodies: dict[str, tuple[Writer, Path, Body]] = {
            write.prefix + name: (write, ("bodies", name), body)
            for write in writers
            for name, body in write.scope.model.bodies.items()
        }
        self.known: dict[str, Spec] = {}

    def of(self, body: str) -> Spec:
        """The surface that a body is; its full name. Raises ``ModelProblem`` when its shape has none."""
        if body not in self.known:
            self.known[body] = self._made(body)
        return self.known[body]

    def _made(self, full: str) -> Spec:
        if full == "ground":
            raise ModelProblem("the ground has no outline", "name a line of it, e.g. `[ground.A, ground.B]`")
        write, path, body = self.bodies[full]
        if not body.pieces:
            return self._surface(full, write, path, body, None)
        if len(body.pieces) > 1:
            raise ModelProblem(f"`{full}` is of several pieces", "name the surface that is touched, e.g. `{polygon: [P, Q, R]}`")
        key, piece = next(iter(body.pieces.items() if isinstance(body.pieces, dict) else enumerate(body.pieces)))
        here = (*path, "pieces", key)
        at = write.numbers((*here, "at"), piece.at)
        return self._surface(full, write, here, piece, (at, write.number((*here, "angle"), piece.angle, "rad")))

    def _surface(self, full: str, write: Writer, path: Path, shaped: Shaped, frame: tuple[list[Number], Number] | None) -> Spec:
        def point(i: int, place: list[Number]) -> str:
            name = f"{full}.{HIDDEN}[{i}]"
            write.spec["points"].append({"name": name, "body": full, "at": placed(place, *frame) if frame else place})
            return name

        match shaped.shape:
            case "particle":
                return {"point": point(1, [0.0, 0.0]) if frame else f"{full}.centre"}
            case "disk" | "ring":
                radius = write.number((*path, "radius"), shaped.radius, "m", "a radius")
                return {"circle": {"centre": point(1, [0.0, 0.0]) if frame else f"{full}.centre", "radius": radius}}
            case "rectangle":
                w, h = (write.number((*path, size), getattr(shaped, size), "m") for size in ("width", "height"))
                corners = [[half(w, x), half(h, y)] for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            case "triangle" | "polygon":
                corners = [write.numbers((*path, "corners", i), corner) for i, corner in enumerate(shaped.corners)]
            case "rod":
                ends = f"`{full}.start` and `{full}.end`"
                raise ModelProblem(f"a rod like `{full}` has no outline", f"name the end that touches; {ends} are two contacts")
            case _:
                raise ModelProblem(f"`{full}` has no shape, so no outline", f"name the point or line of `{full}` that touches")
        return {"polygon": [point(i, corner) for i, corner in enumerate(corners, 1)]}
