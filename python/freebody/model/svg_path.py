"""Outlines drawn elsewhere: the data of an SVG path as polylines, read by fontTools."""

from __future__ import annotations

import re
from itertools import pairwise

import numpy as np

from freebody.core import Array

from .errors import ModelProblem

_WORDS = re.compile(r"[MmZzLlHhVvCcSsQqTtAaEe\d\s,.+-]+")
_BEND = np.linspace(0.0, 1.0, 17)[1:, None]
_MOST = 5000
"""Corners of one outline: more than a page of pictures can bear."""
_Drawn = list[tuple[str, tuple[tuple[float, float], ...]]]
"""What a pen was told: a word, ``moveTo``, ``lineTo`` …, and its points."""


def subpaths(text: str) -> list[tuple[Array, bool]]:
    """Polylines (k, 2) of a path in its own units, each with whether it is closed. Raises ``ModelProblem``."""
    from fontTools.pens.recordingPen import RecordingPen
    from fontTools.svgLib.path import parse_path

    pen = RecordingPen()
    try:
        if not _WORDS.fullmatch(text):
            raise ValueError
        parse_path(text, pen)
        found = [(_polyline(part), part[-1][0] == "closePath") for part in _parts(pen.value)]
        if not all(np.isfinite(points).all() for points, _ in found):
            raise ValueError
    except (ValueError, IndexError, AssertionError, TypeError) as error:
        what = f"`{text[:40]}` is no SVG path that can be read"
        raise ModelProblem(what, "write its data as in the `d` of a `<path>`: `M 0 0 L 0.4 0 L 0.2 0.3 Z`") from error
    if not any(len(points) > 1 for points, _ in found):
        raise ModelProblem("this path draws nothing", "begin with `M x y`, and go on with lines `L x y` or curves `C …`")
    if (corners := sum(len(points) for points, _ in found)) > _MOST:
        raise ModelProblem(f"this path has {corners} corners, more than {_MOST}", "simplify it in the drawing program")
    return [(points, closed) for points, closed in found if len(points) > 1]


def _parts(drawn: _Drawn) -> list[_Drawn]:
    starts = [i for i, (word, _) in enumerate(drawn) if word == "moveTo"]
    return [drawn[i:j] for i, j in pairwise([*starts, len(drawn)])]


def _polyline(part: _Drawn) -> Array:
    """Lines as they are, Bézier curves by points along them."""
    points = [np.array(part[0][1], float)]
    for given in (given for _, given in part[1:] if given):
        controls = [points[-1][-1], *np.array(given, float)]
        points.append(controls[1] if len(controls) == 2 else _curve(controls))
    line = np.vstack(points)
    closed = len(line) > 2 and part[-1][0] == "closePath" and np.allclose(line[0], line[-1], rtol=0, atol=1e-9)
    return line[:-1] if closed else line


def _curve(controls: list[Array]) -> Array:
    """Points along a Bézier curve of any degree by De Casteljau's algorithm, without its start."""
    while len(controls) > 1:
        controls = [a + _BEND * (b - a) for a, b in pairwise(controls)]
    return controls[0]
