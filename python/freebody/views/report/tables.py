"""What the report says: how the run ended, and its tables, cell by cell."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np
from markupsafe import Markup, escape

from freebody.model.user_units import shown
from freebody.run.certificate import Certificate, weakest
from freebody.run.storage import versions
from freebody.solve.instant import Instant
from freebody.solve.rich_tables import figure_in
from freebody.views.plots import pretty_unit

if TYPE_CHECKING:
    from freebody.run.simulation import Run

_EVENTS, _FIRST, _LAST = 100, 60, 3
"""Rows of long tables."""
_MANY = 5
"""Rows that are one line where they are alike."""
_SETTINGS = {
    "accepted": "steps",
    "rejected": "steps tried again",
    "closure": "loops closed to within",
    "kinks": "switches of laws",
}
"""What the integrator counts, in words."""


@dataclass(frozen=True)
class Table:
    """A titled table with a remark below; ``shape`` is a class of its card. Many rows one after the other that agree in the columns
    ``alike`` are one line that opens."""

    title: str
    heads: Sequence[str]
    rows: Sequence[Sequence[str]]
    remark: str = ""
    shape: str = ""
    alike: tuple[int, ...] = ()

    @property
    def groups(self) -> Iterator[tuple[Sequence[str] | None, list[Sequence[str]]]]:
        """The rows, those that are one line with this line before them."""
        for _, rows in groupby(self.rows, lambda row: [row[k] for k in self.alike]):
            group = list(rows)
            if self.alike and len(group) >= _MANY:
                yield self._line(group), group
            else:
                yield None, group

    def _line(self, group: Sequence[Sequence[str]]) -> list[str]:
        """What is the same in all rows, how many they are, and from when to when."""
        first = self.alike[0]
        line = [cells[0] if len(set(cells)) == 1 else "" for cells in zip(*group, strict=True)]
        line[first] = f"{line[first]}, {len(group)} times"
        when = next(k for k, head in enumerate(self.heads) if head == "t / s")
        line[when] = f"{group[0][when]} to {group[-1][when]}"
        return line


def outcome(run: Run) -> str:
    """How the run ended, in a word or two."""
    return re.sub(r"(?<=[a-z])[A-Z]", lambda capital: f" {capital[0].lower()}", run.outcome.name)


def ending(run: Run) -> list[str]:
    """How and when the run ended, how many digits hold, and what went through a line, line by line."""
    end = run.outcome.t if run.recorded else run.accuracy.end
    when, stated = f"t = {_figure(end)} s", sentence(run.outcome.sentence)
    lines = [f"{stated}, {when}"] if run.outcome.ok else [when, *stated.split("; ")]
    known = [] if run.recorded else [f"The motion {run.accuracy.sentence}."]
    return [*lines, *known, *(f"{sentence(each)}." for each in run.passages)]


def beside(run: Run) -> list[Table]:
    """What stands beside the moving mechanism: reported quantities and events."""
    reported, time = [], float if run.recorded else run.accuracy.time
    for label, r in (run if run.recorded else run.accuracy).report.items():
        value = r.note if r.value is None else f"{_figure(r.value, 8, r.unit)} {_unit(r.unit)}".strip()
        when = f"{_figure(r.t)} ({r.note})" if r.note and r.value is not None else _figure(r.t)
        reported.append((label, value, when))
    ways = {1: " ↑", -1: " ↓"}
    events = [(e.name, _figure(time(e.t), 9), e.kind + ways.get(e.direction, "")) for e in run.events[:_EVENTS]]
    remark = f"the first {_EVENTS} of {len(run.events)}" if len(run.events) > _EVENTS else ""
    tables = (
        Table("Report", ("quantity", "value", "at t / s"), reported),
        Table("Events", ("event", "t / s", "kind"), events, remark, alike=(0,)),
    )
    return [table for table in tables if table.rows]


def below(run: Run) -> list[Table]:
    """Mode changes, peak reactions, the energy ledger and bodies."""
    ledger, bodies = run.energy, run.metadata["bodies"]
    known, stored = {} if run.recorded else run.accuracy.energy, []
    for name, y in ledger.entries.items():
        start, *later = y[0], y[-1], y.min(), y.max()
        figures = (start, *(map(known[name].like, later) if known else later))
        stored.append((name, *(_figure(each, unit="J") for each in figures)))
    remark = f"Energy error below {_figure(np.abs(ledger.balance).max(), 2, 'J')} {_unit('J')} at all output times."
    masses = [
        (b["name"], _figure(b["mass"], unit="kg"), "particle" if b["particle"] else _figure(b["inertia"], unit="kg*m^2"))
        for b in bodies
    ]
    tables = (
        _mode_changes(run),
        _peaks(run),
        Table("Energy ledger", (_unit("J"), "start", "end", "least", "most"), stored, remark),
        _certificate(run),
        Table("Bodies", ("body", f"mass / {_unit('kg')}", f"inertia / {_unit('kg*m^2')}"), masses),
    )
    return [table for table in tables if table.rows]


def sentence(text: str) -> str:
    """With a capital."""
    return text[:1].upper() + text[1:]


def marked(text: str) -> Markup:
    """A sentence with what stands between backticks as code, and powers of ten raised."""
    return Markup(re.sub("`([^`]*)`", r"<code>\1</code>", str(raised(text))))


def units() -> str:
    """In which units figures are, in words."""
    others = {unit: _unit(unit) for unit in ("m", "rad", "kg", "N", "N*m", "J", "m/s")}
    chosen = [other for unit, other in others.items() if other != pretty_unit(unit)]
    return f"Figures in {', '.join(chosen)}, else in SI units and radians" if chosen else "SI units and radians"


def is_figure(cell: str) -> bool:
    """Whether a cell holds a number, or stands for one."""
    return bool(re.match(r"−?\d|–", cell))


def raised(cell: str) -> Markup:
    """A text with the powers of ten raised."""
    return Markup(re.sub(r"× 10\^(−?\d+)", r"× 10<sup>\1</sup>", str(escape(cell))))


def _figure(value: float | None, digits: int = 6, unit: str = "") -> str:
    """A number as people write it: a true minus sign, no e-notation where it can be helped; of a unit of SI, as that is shown."""
    if value is None or math.isnan(value):
        return "–"
    text = figure_in(unit, value, digits)
    mantissa, _, power = text.partition("e")
    return (f"{mantissa} × 10^{int(power)}" if power else text).replace("-", "−")


def _unit(unit: str) -> str:
    """How a unit of SI is shown."""
    return pretty_unit(shown(unit).unit)


def _mode_changes(run: Run) -> Table:
    """Mode changes; of very much the first and the last."""
    changes = (run if run.recorded else run.accuracy).changes
    many, rows = len(changes) > _FIRST + _LAST, []
    for c in [*changes[:_FIRST], *changes[-_LAST:]] if many else changes:
        impulses = "; ".join(f"{name} {_figure(size, unit='N*s')}" for name, size in c.sizes.items())
        work, lost = (
            _figure(each, unit="J") if there else "" for each, there in ((c.work, c.work is not None), (c.lost, c.before))
        )
        rows.append((_figure(c.t, 9), c.kind, ", ".join(c.of), lost, work, impulses, c.note))
    remark = f"the first {_FIRST} and the last {_LAST} of {len(changes)}" if many else ""
    energy = _unit("J")
    heads = ("t / s", "kind", "what", f"energy lost / {energy}", f"work of motions / {energy}", f"impulse / {_unit('N*s')}", "")
    return Table("Mode changes", heads, rows, remark, "across", alike=(1, 2))


def _peaks(run: Run) -> Table:
    peaks = run.peaks
    couples, known = any(peak.couple is not None for peak in peaks), all(peak.determinate for peak in peaks)
    force, couple = _unit("N"), _unit("N*m")
    heads = ["", "on", f"force / {force}", "at t / s", f"Fx / {force}", f"Fy / {force}"]
    heads += [f"couple / {couple}", "at t / s"] * couples + [""] * (not known)
    rows = []
    for p in peaks:
        told = [(p.size, "N"), (p.t, "s"), (p.Fx, "N"), (p.Fy, "N"), *[(p.couple, "N*m"), (p.t_couple, "s")] * couples]
        figures = (_figure(value, unit=unit) for value, unit in told)
        rows.append([p.joint, p.body, *figures, *["" if p.determinate else "indeterminate"] * (not known)])
    remark = "Forces as they act on the body named, in the fixed axes, when the force is largest."
    return Table("Peak reactions", heads, rows, remark, "across")


def _certificate(run: Run) -> Table:
    """How many digits independent routes agree to that take no other motion; a run from a file has none, nor one that did not move."""
    title, heads = "Agreement certificate", ("route", "digits", "what is compared")
    if run.recorded or len(run.edges) < 2:
        return Table(title, heads, ())
    routes = Certificate(run).own_routes
    rows, least = [(route.name, route.stated, route.what) for route in routes], weakest(routes)
    more = "`freebody certify` also integrates anew, by another method and at half the tolerance."
    return Table(title, heads, rows, f"The weakest link: {least.name}, {least.stated} digits. {more}", "across")


def settings(run: Run) -> Table:
    """How the run was made."""
    s = run.settings
    taken = {key: value for key, value in run.stats.items() if key not in ("method", "rtol") and value is not None}
    rows = [
        ("degrees of freedom", str(Instant(run.source, run.start).freedom)),
        ("from, to", f"{_figure(run.edges[0])} s to {_figure(run.edges[-1])} s"),
        ("method", s.method),
        ("relative tolerance", _figure(s.rtol)),
        ("route", s.route),
        *(
            (_SETTINGS.get(key, key), _figure(value) if isinstance(value, (int, float)) else str(value))
            for key, value in taken.items()
        ),
        *((f"version of {name}", version) for name, version in versions().items() if name != "platform"),
    ]
    return Table("How it was computed", ("", ""), rows)
