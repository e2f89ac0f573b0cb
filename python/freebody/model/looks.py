"""How bodies are drawn, with the names and numbers of the whole model. The core knows nothing of it."""

from __future__ import annotations

from typing import Any

from .appearance import PieceLook, SvgPath
from .arithmetic import Number
from .errors import Path
from .schema import Body
from .svg_path import subpaths
from .writer import Writer


def looks(write: Writer) -> None:
    """Of every body what its `look` says, with the looks of its ``pieces`` and its ``outline``: ``none``, corners as points by name or
    numbers in m, or ``subpaths`` with their ``unit``, ``at`` and ``y``."""
    for name, body in write.scope.model.bodies.items():
        path: Path = ("bodies", name)
        pieces = body.pieces.items() if isinstance(body.pieces, dict) else enumerate(body.pieces or [])
        stated = _look(write, (*path, "look"), body.look) | {
            "pieces": [_look(write, (*path, "pieces", key, "look"), piece.look) for key, piece in pieces]
        }
        write.looks[write.prefix + name] = stated | {"outline": _outline(write, (*path, "outline"), write.prefix + name, body)}


def _look(write: Writer, path: Path, look: PieceLook | None) -> dict[str, Any]:
    stated = look.model_dump(exclude_none=True) if look else {}
    lengths = {
        word: write.number((*path, word), stated[word], "m", "a length") for word in ("thickness", "wheels") if word in stated
    }
    return stated | lengths


def _outline(write: Writer, path: Path, full: str, body: Body) -> Any:
    if isinstance(body.outline, SvgPath):
        with write.scope.noting((*path, "path")):
            unit = write.number((*path, "unit"), body.outline.unit, "m", "a length")
            at = write.numbers((*path, "at"), body.outline.at)
            return {"subpaths": subpaths(body.outline.path), "unit": unit, "at": at, "y": body.outline.y}
    if isinstance(body.outline, list):
        return [_corner(write, (*path, i), full, corner) for i, corner in enumerate(body.outline)]
    return body.outline


def _corner(write: Writer, path: Path, full: str, corner: Any) -> list[Number] | str:
    return write.numbers(path, corner) if isinstance(corner, list) else write.point(path, corner, full)
