"""Many motions of one mechanism, as one table."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from freebody.core import Array, ModelError, Settings
from freebody.model.errors import ModelFileError
from freebody.model.start import Assembly, Start

from .sampling import MAX_FIGURES, Times
from .storage import need

if TYPE_CHECKING:
    import xarray

    from freebody.model.builder import Builder

Given = Mapping[str, ArrayLike | str] | ArrayLike
"""By name a value for each member, or one for all, which may be a quantity like ``"90 deg"``; or an array (members, coordinates)."""
SHOWN = 101
"""Times that are kept where none are asked for."""
_OVER_TIME = {
    "q": ("coordinate", "coordinates, m or rad"),
    "u": ("coordinate", "rates of the coordinates, m/s or rad/s"),
    "accelerations": ("coordinate", "second time derivatives of the coordinates, m/s^2 or rad/s^2"),
    "reactions": (
        "reaction",
        "N, N*m: of a joint on its second body, of a contact, stop or string on its first; NaN where indeterminate",
    ),
}
"""Variables, in the order of the core's numbers: along what beside time, and what they are."""


class Members:
    """What distinguishes the members: columns (members,) by name in SI, of coordinates, rates and parameters; and what is the same for
    all, in the words of a start."""

    def __init__(
        self, model: Builder, q0: Given | None, u0: Given | None, p: Mapping[str, Any] | None, changes: Mapping[str, Any]
    ) -> None:
        self.model = model
        self.count: int | None = None
        self._first = ""
        self.same: dict[str, Any] = dict(changes)
        self.q, same_q = self._columns("q0", q0)
        self.u, same_u = self._columns("u0", u0)
        self.p, same_p = self._columns("p", p)
        self.same |= same_q | same_p | ({"rates": dict(changes.get("rates", {})) | same_u} if same_u else {})

    def _columns(self, what: str, given: Any) -> tuple[dict[str, Array], dict[str, Any]]:
        """Those with a value for each member, and those with one for all."""
        if given is None:
            return {}, {}
        if not isinstance(given, Mapping):
            given = self._by_name(what, np.asarray(given, float))
        columns, same = {}, {}
        for name, values in given.items():
            label = f"{what}[{name!r}]"
            if isinstance(values, str) or np.ndim(values) == 0:
                same[name] = values if isinstance(values, str) else float(values)
                continue
            column = np.asarray(values, float)
            if column.ndim != 1:
                raise self.error(f"{label} has the shape {column.shape}", "give one value for each member: the shape (members,)")
            if not np.isfinite(column).all():
                member = int(np.flatnonzero(~np.isfinite(column))[0])
                raise self.error(f"{label} is {column[member]} for member {member}", "every member needs finite numbers")
            self._counted(len(column), label)
            columns[name] = column
        return columns, same

    def _by_name(self, what: str, rows: Array) -> dict[str, Array]:
        names = self.model.compile().coordinate_names
        if what == "p" or rows.ndim != 2 or rows.shape[1] != len(names):
            hint = "give columns by name, like {'phi': …}"
            if what != "p":
                hint += f", or the shape (members, {len(names)}), in the order {', '.join(names)}"
            raise self.error(f"{what} has the shape {rows.shape}", hint)
        return dict(zip(names, rows.T, strict=True))

    def _counted(self, count: int, label: str) -> None:
        if self.count is None:
            self.count, self._first = count, label
        if count != self.count:
            raise self.error(f"{label} has {count} values, {self._first} has {self.count}", "give each member one value of each")

    def error(self, what: str, hint: str) -> ModelFileError:
        return self.model.error((), what, hint)

    def states(self, t: float, threads: int) -> tuple[Array, Array, Array]:
        """Parameters, coordinates and rates at the start, in rows; one row of parameters where they are the same for all."""
        if self.count is None:
            raise self.error(
                "nothing tells the members apart", "give an array of a coordinate in q0, of a rate in u0 or of a parameter in p"
            )
        if self.count == 0:
            raise self.error(f"{self._first} is empty", "give at least one member")
        core, start = self.model.compile(), self.model.lowered().start
        if unknown := [*(self.q.keys() | self.u.keys()) - start.coordinates.keys()]:
            self.model.initial_state(dict.fromkeys(unknown, 0.0))
        if not (core.runs_in_lanes and _is_plain(start)):
            return self._assembled(t, threads)
        state, _ = self.model.start(t=t, **self.same)
        q, u = (np.tile(row, (self.count, 1)) for row in (state.q, state.u))
        for rows, columns in ((q, self.q), (u, self.u)):
            for name, column in columns.items():
                rows[:, core.coordinate_names.index(name)] = column
        return self._parameters(state.p), q, u

    def _parameters(self, p: Array) -> Array:
        """Rows of parameters, from those of a member."""
        if not self.p:
            return p[None, :]
        core = self.model.compile()
        named = {
            each["name"]: value for each, value in zip(core.metadata["parameters"], p, strict=True) if each["name"] in self.same
        }
        return core.bind_rows({name: np.full(self.count, value) for name, value in named.items()} | self.p)

    def _assembled(self, t: float, threads: int) -> tuple[Array, Array, Array]:
        """Each for itself."""
        core = self.model.compile()
        if not self._are_alike():
            asked = [self._asked(i) for i in range(self.count or 0)]
            p = np.array([each["p"] for each in asked])
            return p, *core.starts(asked, p, t, threads)
        first = self._asked(0)
        p = np.broadcast_to(self._parameters(first["p"]), (self.count or 0, len(first["p"])))
        return p, *core.starts([first], p, t, threads, self.q, self.u)

    def _are_alike(self) -> bool:
        """Whether no number of a start follows from parameters that differ."""
        same = [value for name, value in self.same.items() if name != "rates"] + [*self.same.get("rates", {}).values()]
        return not self.p or (_is_plain(self.model.lowered().start) and all(isinstance(value, (int, float)) for value in same))

    def _asked(self, i: int) -> Assembly:
        """The start of a member as it is asked for."""
        of_member = {name: float(column[i]) for name, column in (self.q | self.p).items()}
        rates = dict(self.same.get("rates", {})) | {name: float(column[i]) for name, column in self.u.items()}
        try:
            return self.model.initial_state(self.same | of_member | ({"rates": rates} if rates else {}))
        except ModelFileError as error:
            raise self.error(f"{error.problems[0].what} (member {i})", error.problems[0].hint) from None
        except ModelError as error:
            raise ModelError(error.path, f"{error.what} (member {i})", error.hint) from None


def _is_plain(start: Start) -> bool:
    """Whether it is the same whatever the parameters."""
    stated = [*start.fixed.values(), *start.guess.values(), *start.rates.values()]
    return not (start.points or start.branch) and all(isinstance(number, (int, float)) for number in stated)


def batch(
    members: Members, settings: Settings, t: float, t_eval: Times | None, threads: int | None, reactions: bool
) -> xarray.Dataset:
    """The motions of all members."""
    xarray = need("xarray")
    until = settings.until
    assert until is not None
    model, core = members.model, members.model.compile()
    if handed := model.lowered().hand_over:
        raise model.error(
            ("events", next(iter(handed))), "the motion continues with another model", "simulate each member by itself"
        )
    threads = threads or _cores()
    p, q, u = members.states(t, threads)
    times = _times(settings, t, t_eval)
    if not len(times):
        raise members.error("t_eval is empty", "give at least one time")
    n = q.shape[1]
    figures = len(q) * len(times) * (3 * n + len(core.reaction_names) if reactions else 2 * n)
    if figures > MAX_FIGURES:
        what = f"{len(times)} times of {len(q)} members make {figures:.3g} figures; at most {MAX_FIGURES:.0e} are kept"
        raise members.error(what, "ask for fewer times by t_eval or every")
    if outside := [time for time in times if not t <= time <= until]:
        raise members.error(f"t_eval has the time {outside[0]:g} s", f"the motions go from {t:g} s to {until:g} s")
    chosen = {name: value for name, value in asdict(settings).items() if name not in ("until", "every")}
    found, endings = core.batch(p, q, u, t, until, times, threads, reactions=reactions, **chosen)
    cuts = [n, 2 * n, 3 * n] if reactions else [n]
    variables = {
        name: (("member", "time", along), part, {"long_name": says})
        for (name, (along, says)), part in zip(_OVER_TIME.items(), np.split(found, cuts, axis=2), strict=False)
    }
    labels = {"member": np.arange(len(q)), "time": ("time", times, {"units": "s"}), "coordinate": core.coordinate_names}
    if reactions:
        labels["reaction"] = core.reaction_names
    if members.p:
        labels["parameter"] = [*members.p]
        variables["p"] = (("member", "parameter"), np.column_stack([*members.p.values()]), {"long_name": "parameters, SI"})
    return xarray.Dataset(variables | _ended(endings), labels, {"title": core.name, "method": settings.method})


def _ended(endings: Mapping[str, list[Any]]) -> dict[str, Any]:
    """How the motions ended, as variables."""
    return {
        "outcome": (
            "member",
            np.array(endings["name"]),
            {"long_name": "how the motion ended; NaN after that"},
        ),
        "ok": ("member", np.array(endings["ok"]), {"long_name": "whether it ended as was asked"}),
        "end": ("member", np.array(endings["t"]), {"units": "s", "long_name": "when it ended"}),
        "sentence": ("member", np.array(endings["sentence"]), {"long_name": "how it ended, in a sentence"}),
    }


def _times(settings: Settings, t: float, t_eval: Times | None) -> Array:
    assert settings.until is not None
    if t_eval is not None:
        return np.unique(np.asarray(t_eval, float))
    if settings.every is None:
        return np.linspace(t, settings.until, SHOWN)
    grid = t + settings.every * np.arange(np.floor((settings.until - t) / settings.every * (1 + 1e-12)) + 1)
    return np.unique(np.append(np.minimum(grid, settings.until), settings.until))


def _cores() -> int:
    """The cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
