"""Runs as tables and files: xarray, pandas, netCDF and CSV, with the model inside."""

from __future__ import annotations

import csv
import json
import platform
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict, replace
from importlib import import_module, metadata
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import CompiledModel, Motion, Settings, Spec, State
from freebody.run.records import KINDS, PARTS, Array, Reported, ReportItem

if TYPE_CHECKING:
    import pandas
    import xarray

    from freebody.run.simulation import Run

FORMAT = 1
TITLE = "freebody run"
_EXTRA = "this needs {}, which is not installed: pip install freebody[table]"
_DIMENSIONS = {
    "coordinate": ("time", "coordinate"),
    "rate": ("time", "coordinate"),
    "acceleration": ("time", "coordinate"),
    "reaction": ("time", "joint", "part"),
    "limit": ("time", "limit"),
    "energy": ("time", "ledger"),
    "pose": ("time", "body", "place"),
}
_VARIABLE = {
    "coordinate": "q",
    "rate": "u",
    "acceleration": "acceleration",
    "reaction": "reaction",
    "limit": "limits",
    "energy": "energy",
    "pose": "pose",
}
_MEANING = {
    "coordinate": "coordinates, m or rad",
    "rate": "rates of the coordinates, m/s or rad/s",
    "acceleration": "second time derivatives of the coordinates, m/s^2 or rad/s^2",
    "reaction": "reaction on the joint's second body: N, N, N*m about the joint's point; NaN where indeterminate",
    "limit": "forces (N) and gaps (m) of contacts, strings and stops, forces of locks; N*m and rad at an angle",
    "energy": "energy ledger, J",
    "pose": "frame origin x, y (m) and angle (rad) of the bodies",
}


class Recorded(Motion):
    """What a file holds of a motion: everything at the saved times (nt,), nothing between them."""

    def __init__(
        self, saved_times: Array, names: Sequence[str], blocks: Mapping[str, Array], meta: Mapping[str, Any], about: Any
    ) -> None:
        super().__init__(meta, about)
        self.saved_times, self.names, self.blocks, self.meta = saved_times, names, blocks, meta
        self.steps = np.array(meta["steps"])
        """Times of the accepted steps."""

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

    def instants(self, times: Array) -> tuple[Array, Any]:
        """Reactions (nt, nj, 3) at saved times, and whether they are determinate."""
        rows = self._rows(times)
        values = self.blocks["reaction"][rows].reshape(len(rows), -1, 3)
        return values, ~np.isnan(values)

    def instant(self, t: float, route: str) -> Any:
        """A file holds no instants."""
        raise LookupError("a run from a file holds no whole instants; run.again() simulates it anew and knows all")

    def ledger(self, times: Array) -> tuple[list[str], Array]:
        """The energy ledger at saved times."""
        return list(self.meta["ledger"]), self.blocks["energy"][self._rows(times)]

    @property
    def end(self) -> State:
        """The state at the end."""
        return _state(self.meta["end"])

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
        raise ImportError(_EXTRA.format(module)) from None


def to_pandas(run: Run) -> pandas.DataFrame:
    """One row a time, one column each of ``run.columns``; the reported quantities in ``attrs``."""
    names = [column.name for column in run.columns]
    table = need("pandas").DataFrame(_matrix(run), columns=names, index=need("pandas").Index(run.t, name="t"))
    table.attrs.update(title=run.name, units={c.name: c.unit for c in run.columns}, report=_report(run))
    return table


def to_xarray(run: Run) -> xarray.Dataset:
    """A Dataset with one variable a kind of column; ``units`` of coordinates and ledger stand beside their names."""
    ledger = [column.name for column in run.columns if column.kind == "energy"]
    labels: dict[str, Any] = {
        "time": run.t,
        "coordinate": run.coordinates,
        "joint": [joint["name"] for joint in run.about["joints"]],
        "part": list(PARTS),
        "limit": [column.name for column in run.columns if column.kind == "limit"],
        "ledger": ledger,
        "body": run.bodies,
        "place": ["x", "y", "angle"],
    }
    sizes = {dimension: len(values) for dimension, values in labels.items()}
    variables: dict[str, Any] = {}
    for kind, block in run.blocks.items():
        if kind == "limit" and not labels["limit"]:
            continue  # netCDF 3 takes a dimension of length 0 for the one that grows
        dimensions = _DIMENSIONS[kind]
        shape = [sizes[dimension] for dimension in dimensions]
        variables[_VARIABLE[kind]] = (dimensions, block.reshape(shape), {"long_name": _MEANING[kind]})
    known = ~np.isnan(variables["reaction"][1])
    variables["determinate"] = (_DIMENSIONS["reaction"], known, {"long_name": "whether the balances determine the reaction"})
    coordinates = {name: (name, np.array(values)) for name, values in labels.items() if len(values)}
    data: xarray.Dataset = need("xarray").Dataset(variables, coordinates, {"title": run.name, "freebody": json.dumps(_meta(run))})
    data["time"].attrs["units"] = "s"
    data["energy"].attrs["units"] = "J"
    return data


def save(run: Run, path: Path) -> Path:
    """Write a run as netCDF (``.nc``) or CSV (``.csv``)."""
    if path.suffix == ".nc":
        to_xarray(run).to_netcdf(path, engine="scipy", format="NETCDF3_64BIT")
    elif path.suffix == ".csv":
        _write_csv(run, path)
    else:
        raise ValueError(f"a run is saved as .nc or .csv, not {path.suffix or 'without a suffix'!r}")
    return path


def load(
    path: Path, mechanism: Callable[[Spec], CompiledModel]
) -> tuple[CompiledModel, State, Settings, Recorded, dict[str, Reported]]:
    """What a file holds of a run: what was simulated, from where and how, the motion, what was reported; ``mechanism`` compiles
    its model."""
    readers = {".nc": _read_netcdf, ".csv": _read_csv}
    if path.suffix not in readers:
        raise ValueError(f"{path}: a saved run is a .nc or a .csv file")
    t, names, blocks, meta = readers[path.suffix](path)
    report = tuple(ReportItem(**{**item, "over": tuple(item["over"]) if item["over"] else None}) for item in meta["report_items"])
    source = replace(mechanism(json.loads(meta["spec"])), model=json.loads(meta["model"]), report=report)
    reported = {label: Reported(**value) for label, value in meta["report"].items()}
    recorded = Recorded(t, names, blocks, meta, source.about)
    return source, _state(meta["start"]), Settings(**meta["settings"]), recorded, reported


def _state(data: Mapping[str, Any]) -> State:
    return State(np.array(data["p"]), data["t"], np.array(data["q"]), np.array(data["u"]))


def _plain(state: State) -> dict[str, Any]:
    return {"p": state.p.tolist(), "t": state.t, "q": state.q.tolist(), "u": state.u.tolist()}


def _matrix(run: Run) -> Array:
    return np.hstack(list(run.blocks.values()))


def _report(run: Run) -> dict[str, Any]:
    return {label: asdict(value) for label, value in run.report.items()}


def _meta(run: Run) -> dict[str, Any]:
    """Everything about a run that is no column, ready for JSON."""
    return {
        "format": FORMAT,
        "versions": versions(),
        "spec": json.dumps(run.source.spec),
        "model": json.dumps(run.source.model),
        "report_items": [asdict(item) for item in run.source.report],
        "report": _report(run),
        "settings": asdict(run.settings),
        "start": _plain(run.start),
        "end": _plain(run.end),
        "steps": np.asarray(run.motion.steps).tolist(),
        **{part: run.motion.record[part] for part in ("events", "changes", "outcome", "stats")},
        "ledger": list(run.energy.names),
        "columns": [asdict(column) for column in run.columns],
    }


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
        file.write(f"# {json.dumps(_meta(run))}\n")
        writer = csv.writer(file)
        writer.writerow(["t", *(column.name for column in run.columns)])
        # repr gives the shortest text that reads back as the same number.
        writer.writerows([repr(float(x)) for x in row] for row in np.column_stack([run.t, _matrix(run)]))


def _read_csv(path: Path) -> tuple[Array, list[str], dict[str, Array], dict[str, Any]]:
    with path.open(newline="", encoding="utf-8") as file:
        if not file.readline().startswith(f"# {TITLE}"):
            raise ValueError(f"{path} is no saved run: it does not begin with '# {TITLE}'")
        meta = json.loads(file.readline()[2:])
        rows = csv.reader(file)
        next(rows)
        table = np.array([[float(cell) for cell in row] for row in rows])
    kinds = [column["kind"] for column in meta["columns"]]
    blocks = {kind: table[:, 1:][:, _where(kinds, kind)] for kind in KINDS}
    return table[:, 0], [column["name"] for column in meta["columns"]], blocks, meta


def _where(kinds: Iterable[str], kind: str) -> list[int]:
    return [i for i, each in enumerate(kinds) if each == kind]


def _read_netcdf(path: Path) -> tuple[Array, list[str], dict[str, Array], dict[str, Any]]:
    with need("xarray").open_dataset(path, engine="scipy") as data:
        if "freebody" not in data.attrs:
            raise ValueError(f"{path} is no saved run: it has no attribute 'freebody'")
        meta = json.loads(data.attrs["freebody"])
        t = data["time"].values.astype(float)
        found = {kind: data[_VARIABLE[kind]].values if _VARIABLE[kind] in data else np.empty((len(t), 0)) for kind in KINDS}
        blocks = {kind: values.reshape(len(t), -1) for kind, values in found.items()}
    return t, [column["name"] for column in meta["columns"]], blocks, meta
