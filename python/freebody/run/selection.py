"""Columns, expressions and points of one's choice in files of their own: a plain table, or the paths of points as outlines."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import Array
from freebody.formats import Formats, replacing
from freebody.model.user_units import shown

if TYPE_CHECKING:
    from freebody.run.simulation import Run

_CLOSED = 1e-6
"""Part of the extent of a path within which its end is its start."""


def selection(run: Run, names: Sequence[str]) -> dict[str, Array]:
    """Columns, expressions, and points as their x and y, by ``name [unit]``, in the units that are chosen."""
    found = {}
    for name in names:
        values = run[name]
        parts = {name: values} if values.ndim == 1 else {f"{axis}({name})": values[:, i] for i, axis in enumerate("xy")}
        for text, each in parts.items():
            unit, size = shown(run.unit_of(text))
            found[f"{text} [{unit}]" if unit else text] = each / size
    return found


def save(run: Run, path: Path, names: Sequence[str]) -> Path:
    """Write what ``names`` say as one of ``FORMATS``. Raises ``ValueError`` for any other, and for an outline of what is no point."""
    write = FORMATS.of(path)
    with replacing(path) as beside:
        write(run, beside, names)
    return path


def _write_table(run: Run, path: Path, names: Sequence[str]) -> None:
    columns = {"t [s]": run.t} | selection(run, names)
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows(zip(*(values.tolist() for values in columns.values()), strict=True))


def _write_outlines(run: Run, path: Path, names: Sequence[str]) -> None:
    """In mm and true to size, as programs for drawing and cutting take them up; a path that comes back is closed."""
    paths = {name: 1e3 * run[name] for name in names}
    if others := [name for name, way in paths.items() if way.ndim != 2]:
        raise ValueError(f"an outline is the path of a point, and {others[0]} is none: write a .csv")
    (left, low), (right, high) = (reach(np.vstack(list(paths.values())), axis=0) for reach in (np.min, np.max))
    extent = float(np.hypot(right - left, high - low)) or 1.0
    air = 0.02 * extent
    width, height = right - left + 2 * air, high - low + 2 * air
    drawn = [f"<title>{escape(run.name)}</title>"]
    for name, way in paths.items():
        closed = len(way) > 2 and bool(np.hypot(*(way[-1] - way[0])) < _CLOSED * extent)
        places = " ".join(f"{x:.6g},{-y:.6g}" for x, y in (way[:-1] if closed else way))
        drawn.append(f'<path d="M{places}{" Z" * closed}"><title>{escape(name)}</title></path>')
    box = f'width="{width:.6g}mm" height="{height:.6g}mm" viewBox="{left - air:.6g} {-high - air:.6g} {width:.6g} {height:.6g}"'
    pen = f'fill="none" stroke="black" stroke-width="{2e-3 * extent:.3g}" stroke-linejoin="round"'
    svg = "\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" {box} {pen}>', *drawn, "</svg>", ""])
    path.write_text(svg, encoding="utf-8")


FORMATS = Formats("columns of your choice are written as", {".csv": _write_table, ".svg": _write_outlines})
