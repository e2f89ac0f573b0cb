"""Tables: points that stand in the model, or in the columns of a CSV file beside it."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, NamedTuple

from freebody.core import Spec

from . import units
from .errors import Consequence, ModelProblem, Path, Problem, Where
from .names import suggestion
from .schema import Table

if TYPE_CHECKING:
    from .writer import Writer

MAX_BYTES, MAX_POINTS = 16 * 2**20, 100_000
_AGREES = 1e-12  # relative, of the first and the last value of a periodic table: round-off of units


class Point(NamedTuple):
    """A number of a table, and where it stands."""

    value: float
    where: Where


def written(write: Writer, name: str, table: Table) -> Spec:
    """The table as the core takes it; what is wrong is noted."""
    path: Path = ("tables", name)
    x: list[Point] = []
    y: list[Point] = []
    with write.scope.noting((*path, "file")):
        x, y = (
            _columns(write, path, table) if table.file else (_listed(write, (*path, axis), getattr(table, axis)) for axis in "xy")
        )
        write.scope.problems += _faults(write.scope.where(path), x, y, table.periodic)
    points = {axis: [point.value for point in points] for axis, points in (("x", x), ("y", y))}
    return {"name": write.prefix + name, **points, "interpolation": table.interpolation, "periodic": table.periodic}


def _faults(whole: Where, x: list[Point], y: list[Point], periodic: bool) -> Iterator[Problem]:
    if len(x) != len(y) or len(x) < 2:
        yield Problem(whole, f"the table has {len(x)} arguments and {len(y)} values", "it needs two points or more")
        return
    for before, after in pairwise(x):
        if after.value <= before.value:
            yield Problem(after.where, "the arguments of a table must grow", "put its points in order")
            break
    first, last = y[0].value, y[-1].value
    if periodic and abs(last - first) > _AGREES * max(abs(point.value) for point in y):
        what = f"a periodic table ends with the value that it begins with; {last:g} is not {first:g} (SI)"
        yield Problem(y[-1].where, what, "let its last point repeat the first, one period on, or leave out `periodic`")


def _listed(write: Writer, path: Path, values: list[float | int | str]) -> list[Point]:
    found: list[Point] = []
    for i, value in enumerate(values):
        with write.scope.noting((*path, i)):
            found.append(Point(write.scope.parameters.number(value), write.scope.where((*path, i))))
    return found


# -- CSV files

Rows = list[tuple[int, list[str]]]
"""The rows of a file, each with its line."""


def _columns(write: Writer, path: Path, table: Table) -> list[list[Point]]:
    """The points in a file. Raises ``ModelProblem`` where it cannot be read."""
    file = write.scope.folder.beside(table.file)
    rows = _rows(file, table.file)
    head = [title.strip() for title in rows[0][1]] if rows else []
    found = []
    for axis, column in (("x", table.x), ("y", table.y)):
        with write.scope.noting((*path, axis, "column")):
            if column.column not in head:
                raise ModelProblem(f"`{table.file}` has no column `{column.column}`", suggestion(column.column, head))
            with write.scope.noting((*path, axis, "unit")):
                size = units.unit(column.unit).size
                found.append(_column(write, file, rows[1:], head.index(column.column), size))
    if len(found) < 2:
        raise Consequence("a column cannot be read")
    return found


def _rows(file: FilePath, name: str) -> Rows:
    """The rows that are not empty. Raises ``ModelProblem``."""
    try:
        if file.stat().st_size > MAX_BYTES:
            raise ModelProblem(f"`{name}` is larger than {MAX_BYTES // 2**20} MiB", "keep fewer of its points")
        with file.open(encoding="utf-8-sig", newline="") as stream:
            reader = csv.reader(stream)
            rows = [(reader.line_num, row) for row in reader if any(cell.strip() for cell in row)]
    except UnicodeDecodeError as error:
        raise ModelProblem(f"`{name}` is no text in UTF-8 (byte {error.start})", "save it as CSV in UTF-8") from None
    except csv.Error as error:
        raise ModelProblem(f"`{name}` is no CSV file: {error}", "save it as CSV in UTF-8") from None
    except FileNotFoundError:
        raise ModelProblem(f"there is no file `{name}`", "the file of a table is looked for beside the model") from None
    except OSError as error:
        raise ModelProblem(f"`{name}` cannot be read: {error.strerror}") from None
    if len(rows) > MAX_POINTS + 1:
        raise ModelProblem(f"`{name}` has {len(rows) - 1} points; a table has at most {MAX_POINTS}", "keep fewer of its points")
    return rows


def _column(write: Writer, file: FilePath, rows: Rows, place: int, size: Fraction) -> list[Point]:
    found = []
    for line, row in rows:
        text, where = row[place].strip() if place < len(row) else "", Where(str(file), line, 0, "", ",".join(row))
        try:
            value = units.rounded(text, size)
            if not math.isfinite(value):
                raise ValueError(text)
        except (ValueError, ModelProblem):
            what = f"`{text}` is no number" if text else "this row has no number in the column"
            hint = "columns are parted by commas, and numbers have a decimal point; units stand in the model"
            write.scope.problems.append(Problem(where, what, hint))
            raise Consequence(what) from None
        found.append(Point(value, where))
    return found
