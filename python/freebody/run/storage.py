"""Runs as tables and files: xarray, pandas, netCDF and CSV, with the model inside."""

from __future__ import annotations

import csv
import hashlib
import json
import platform
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from importlib import import_module, metadata
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import Array, CompiledModel, Motion, ReportItem, Settings, State
from freebody.formats import Formats, replacing
from freebody.run.records import KINDS, Column, Reported
from freebody.run.selection import selection

if TYPE_CHECKING:
    import pandas
    import xarray

    from freebody.run.simulation import Run

FORMAT = 2
TITLE = "freebody run"
Saved = tuple[Array, dict[str, Array], str]
"""Times (nt,), values (nt, k) of the columns by kind, and the header of a file."""
_VARIABLES = {
    "coordinate": ("q", ("coordinate",), "coordinates, m or rad"),
    "rate": ("u", ("coordinate",), "rates of the coordinates, m/s or rad/s"),
    "acceleration": ("acceleration", ("coordinate",), "second time derivatives of the coordinates, m/s^2 or rad/s^2"),
    "dependent": ("following", ("dependent",), "coordinates that follow from the others, with rates and accelerations"),
    "reaction": (
        "reaction",
        ("joint", "part"),
        "reaction on the joint's second body: N, N, N*m about the joint's point; NaN where indeterminate",
    ),
    "limit": (
        "limits",
        ("limit",),
        "forces (N) and gaps (m) of contacts, strings and stops, forces of locks and motions; N*m and rad at an angle",
    ),
    "energy": ("energy", ("ledger",), "energy ledger, J"),
    "pose": ("pose", ("body", "place"), "frame origin x, y (m) and angle (rad) of the bodies"),
}
"""Of each kind of columns: its variable in a Dataset, the dimensions beside time, and what it is."""


class OldFormat(Exception):
    """A file of another version."""


@dataclass(frozen=True)
class Header:
    """All that a file holds of a run beside its columns; ``spec`` and ``model`` are JSON, the last but two the core's plain data."""

    format: int
    versions: Mapping[str, str]
    spec: str
    model: str
    report_items: tuple[ReportItem, ...]
    report: Mapping[str, Reported]
    settings: Settings
    start: State
    end: State
    steps: Array
    events: list[Any]
    changes: list[Any]
    outcome: Mapping[str, Any]
    stats: Mapping[str, Any]
    ledger: list[str]
    columns: list[Column]

    @classmethod
    def of(cls, run: Run) -> Header:
        """That of a run."""
        source, motion, parts = run.source, run.motion, ("events", "changes", "outcome", "stats")
        texts = json.dumps(source.spec), json.dumps(source.model)
        start, end = (replace(state, history=None) for state in (run.start, run.end))
        asked = source.report, run.report, run.settings, start, end, motion.steps
        return cls(
            FORMAT, versions(), *texts, *asked, *(motion.record[part] for part in parts), list(run.energy.names), run.columns
        )

    def write(self, columns: Sequence[Array]) -> str:
        """As JSON, with a digest of it and of the ``columns`` that stand beside it."""
        given = json.loads(json.dumps(asdict(self), default=np.ndarray.tolist))
        return json.dumps(given | {"digest": _digest(given, columns)})

    @classmethod
    def read(cls, text: str, columns: Sequence[Array]) -> Header:
        """From JSON. Raises ``OldFormat``, and ``ValueError`` where it, or the ``columns`` beside it, are not what was written."""
        given = json.loads(text)
        if given["format"] != FORMAT:
            raise OldFormat(f"is in format {given['format']} of saved runs; this freebody reads {FORMAT}")
        if given.pop("digest") != _digest(given, columns):
            raise ValueError("the digest is another")
        made = cls(**given)
        start, end = (
            {key: np.array(value) if isinstance(value, list) else value for key, value in each.items()}
            for each in (made.start, made.end)
        )
        return replace(
            made,
            report_items=tuple(ReportItem(**item | {"over": item["over"] and tuple(item["over"])}) for item in made.report_items),
            report={label: Reported(**value) for label, value in made.report.items()},
            settings=Settings(**made.settings),
            start=State(**start),
            end=State(**end),
            steps=np.array(made.steps),
            columns=[Column(**column) for column in made.columns],
        )


def _digest(header: Mapping[str, Any], columns: Sequence[Array]) -> str:
    whole = hashlib.sha256(json.dumps(header).encode())
    for column in columns:
        whole.update(np.where(np.isnan(column), np.nan, column).tobytes())  # any NaN is the same
    return whole.hexdigest()


class Recorded(Motion):
    """What a file holds of a motion: everything at the saved times (nt,), nothing between them."""

    def __init__(self, saved_times: Array, blocks: Mapping[str, Array], header: Header, metadata: Mapping[str, Any]) -> None:
        super().__init__(vars(header), metadata)
        self.saved_times, self.blocks, self.header = saved_times, blocks, header
        self.names = [column.name for column in header.columns]
        self.steps, self.end = header.steps, header.end

    def sample(self, times: Array) -> tuple[Array, Array]:
        """Coordinates and rates (nt, n) at saved times."""
        rows = self._rows(times)
        return self.blocks["coordinate"][rows], self.blocks["rate"][rows]

    def evaluate(self, texts: Sequence[str], times: Array) -> Array:
        """Saved columns (nt, k) at saved times."""
        rows, everything = self._rows(times), np.hstack([self.blocks[kind] for kind in KINDS])
        return np.column_stack([everything[rows, self._place(text)] for text in texts])

    def poses(self, times: Array) -> Array:
        """Poses (nt, nb, 3) at saved times."""
        rows = self._rows(times)
        return self.blocks["pose"][rows].reshape(len(rows), -1, 3)

    def reactions(self, times: Array) -> Array:
        """Reactions of the joints (nt, nj, 3) at saved times; NaN where one is not determinate."""
        rows = self._rows(times)
        return self.blocks["reaction"][rows].reshape(len(rows), -1, 3)

    def state(self, t: float) -> State:
        """The state at a saved time, without its history."""
        q, u = self.sample(np.array([t]))
        return replace(self.end, t=t, q=q[0], u=u[0])

    def ledger(self, times: Array) -> tuple[list[str], Array]:
        """The energy ledger at saved times."""
        return self.header.ledger, self.blocks["energy"][self._rows(times)]

    def _rows(self, times: Array) -> Any:
        rows = np.searchsorted(self.saved_times, times).clip(max=len(self.saved_times) - 1)
        if not np.array_equal(self.saved_times[rows], times):
            raise LookupError("a run from a file is known at its saved times only; run.again() simulates it anew and knows all")
        return rows

    def _place(self, text: str) -> int:
        if text not in self.names:
            raise LookupError(f"{text!r} was not saved; run.again() simulates the run anew and can evaluate anything")
        return self.names.index(text)


def need(module: str) -> Any:
    """An optional library, or one line that says how to get it."""
    try:
        return import_module(module)
    except ImportError:
        raise ImportError(f"this needs {module}, which is not installed: pip install {module}") from None


def to_pandas(run: Run, *names: str) -> pandas.DataFrame:
    """One row a time, one column each of ``run.columns``, or of ``names`` as a ``selection``; the reported quantities in ``attrs``."""
    if names:
        return need("pandas").DataFrame(selection(run, names), index=need("pandas").Index(run.t, name="t [s]"))
    units = {column.name: column.unit for column in run.columns}
    values = np.hstack(list(run.blocks.values()))
    table = need("pandas").DataFrame(values, columns=list(units), index=need("pandas").Index(run.t, name="t"))
    table.attrs.update(title=run.name, units=units, report={label: asdict(value) for label, value in run.report.items()})
    return table


def to_xarray(run: Run) -> xarray.Dataset:
    """A Dataset with one variable a kind of column; ``units`` of coordinates and ledger stand beside their names."""
    names = {kind: [column.name for column in run.columns if column.kind == kind] for kind in KINDS}
    labels: dict[str, Any] = {
        "time": run.t,
        "coordinate": run.coordinates,
        "joint": [joint["name"] for joint in run.metadata["joints"]],
        "part": ["Fx", "Fy", "M"],
        "dependent": names["dependent"],
        "limit": names["limit"],
        "ledger": names["energy"],
        "body": run.bodies,
        "place": ["x", "y", "angle"],
    }
    variables: dict[str, Any] = {}
    for kind, block in run.blocks.items():
        variable, dimensions, meaning = _VARIABLES[kind]
        if kind in ("dependent", "limit") and not labels[kind]:
            continue  # netCDF 3 takes a dimension of length 0 for the one that grows
        shape = [len(run.t), *(len(labels[dimension]) for dimension in dimensions)]
        variables[variable] = (("time", *dimensions), block.reshape(shape), {"long_name": meaning})
    dimensions, values, _ = variables["reaction"]
    variables["determinate"] = (dimensions, ~np.isnan(values), {"long_name": "whether the balances determine the reaction"})
    coordinates = {name: (name, np.array(values)) for name, values in labels.items() if len(values)}
    header = Header.of(run).write([run.t, *run.blocks.values()])
    data: xarray.Dataset = need("xarray").Dataset(variables, coordinates, {"title": run.name, "freebody": header})
    data["time"].attrs["units"] = "s"
    data["energy"].attrs["units"] = "J"
    return data


def save(run: Run, path: Path) -> Path:
    """Write a run as one of ``FORMATS``."""
    write, _ = FORMATS.of(path)
    with replacing(path) as beside:
        write(run, beside)
    return path


def load(path: Path) -> tuple[CompiledModel, Recorded]:
    """What a file holds of a run: what was simulated, and the motion. Raises ``OSError``, and ``ValueError`` for a file that is not as
    ``save`` wrote it."""
    _, read = FORMATS.of(path)
    if path.exists() and not path.is_file():
        raise ValueError(f"{path} is no saved run: it is no regular file")
    try:
        t, blocks, text = read(path)
        header = Header.read(text, [t, *blocks.values()])
    except OldFormat as error:
        raise ValueError(f"{path} {error}; simulate the model again") from None
    except (ValueError, LookupError, TypeError):  # what readers meet in files that were cut or edited
        raise ValueError(f"{path} is no saved run, or not as it was written; save the run again") from None
    source = replace(CompiledModel.of(json.loads(header.spec)), model=json.loads(header.model), report=header.report_items)
    return source, Recorded(t, blocks, header, source.metadata)


def versions() -> dict[str, str]:
    """Versions of what made the file."""
    try:
        own = metadata.version("freebody")
    except metadata.PackageNotFoundError:
        own = "unpackaged"
    return {"freebody": own, "python": platform.python_version(), "numpy": np.__version__, "platform": platform.platform()}


def _write_csv(run: Run, path: Path) -> None:
    with path.open("w", newline="", encoding="utf-8") as file:
        file.write(f"# {TITLE}: time and columns in SI; indeterminate reactions are nan; the next line is the run as JSON\n")
        file.write(f"# {Header.of(run).write([run.t, *run.blocks.values()])}\n")
        writer = csv.writer(file)
        writer.writerow(["t", *(column.name for column in run.columns)])
        # repr gives the shortest text that reads back as the same number.
        writer.writerows([repr(float(x)) for x in row] for row in np.column_stack([run.t, *run.blocks.values()]))


def _read_csv(path: Path) -> Saved:
    with path.open(encoding="utf-8") as file:
        if not file.readline().startswith(f"# {TITLE}"):
            raise ValueError("another beginning")
        text = file.readline()[2:]
        listed, [names] = json.loads(text)["columns"], csv.reader([file.readline()])
        if names != ["t", *(column["name"] for column in listed)]:
            raise ValueError("other names")
        t, *columns = np.loadtxt(file, delimiter=",", ndmin=2).T
    found = {kind: [y for y, of in zip(columns, listed, strict=True) if of["kind"] == kind] for kind in KINDS}
    return t, {kind: np.reshape(values, (-1, len(t))).T for kind, values in found.items()}, text


def _read_netcdf(path: Path) -> Saved:
    with need("xarray").open_dataset(path, engine="scipy") as data:
        t = data["time"].values.astype(float)
        found = {
            kind: data[variable].values if variable in data else np.empty((len(t), 0))
            for kind, (variable, *_) in _VARIABLES.items()
        }
        return t, {kind: values.reshape(len(t), -1) for kind, values in found.items()}, data.attrs["freebody"]


FORMATS = Formats(
    "a run is saved as",
    {
        ".nc": (lambda run, path: to_xarray(run).to_netcdf(path, engine="scipy", format="NETCDF3_64BIT"), _read_netcdf),
        ".csv": (_write_csv, _read_csv),
    },
)
"""What writes and what reads each kind of file."""
