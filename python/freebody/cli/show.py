"""What the commands print: tables for a person, JSON for a script."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.console import Console
from rich.table import Table
from rich.text import Text

from freebody.cli.models import how_far
from freebody.cli.terminal import print_json
from freebody.solve.figures import figure
from freebody.solve.rich_tables import table

if TYPE_CHECKING:
    from freebody.core import Change, CompiledModel
    from freebody.run.certificate import Certificate, Route
    from freebody.run.digits import Accuracy
    from freebody.run.simulation import Run
    from freebody.solve.instant import Instant, Reaction
    from freebody.views.compare import Comparison

Row = Sequence[Any]
_FIRST, _LAST = 12, 3
_SWITCHED = ("t [s]", "kind", "what", "energy lost [J]", "work of motions [J]", "")


def put(*things: Any) -> None:
    """Print tables and plain lines; an empty table is left out, another gets air below."""
    console = Console()
    for thing in things:
        if not isinstance(thing, Table):
            console.print(Text(thing) if isinstance(thing, str) else thing)
        elif thing.row_count:
            console.print(thing, "", crop=False)


# A run


def runs_as_json(done: Sequence[Run], files: Sequence[Sequence[Path]]) -> None:
    """Runs one after the other, each with the files that were made; several as a list."""
    data = [
        {
            "name": each.name,
            "outcome": asdict(each.outcome),
            "digits": each.accuracy.to_json(),
            "notes": [*each.source.notes, *each.passages],
            "events": [asdict(event) | _digits(t=each.accuracy.time(event.t)) for event in each.events],
            "changes": [
                asdict(change) | _digits(t=known.t, lost=known.lost, work=known.work)
                for change, known in zip(each.changes, each.accuracy.changes, strict=True)
            ],
            "report": {
                label: asdict(reported) | _digits(value=reported.value, t=reported.t)
                for label, reported in each.accuracy.report.items()
            },
            "energy": {"balance": float(abs(each.energy.balance).max(initial=0.0)), "relative": closure(each)},
            "peaks": [asdict(peak) | _digits(size=peak.size, couple=peak.couple) for peak in each.peaks],
            "stats": each.stats,
            "files": [str(path) for path in made],
        }
        for each, made in zip(done, files, strict=True)
    ]
    print_json(data if len(data) > 1 else data[0])


def _digits(**figures: float | None) -> dict[str, Any]:
    """How many digits of figures hold; null where nothing is claimed."""
    return {"digits": {name: getattr(figure, "digits", None) for name, figure in figures.items()}}


def run(done: Run) -> None:
    """What happened, what was asked for, whether the energy adds up, the largest reactions."""
    accuracy = done.accuracy
    reported = [(label, each.value, each.unit, each.t, each.note) for label, each in accuracy.report.items()]
    ledger = [(name, float(done.energy.entries[name][0]), end) for name, end in accuracy.energy.items()]
    peaks = [
        (peak.joint, peak.body, peak.size if peak.determinate else math.nan, peak.t, peak.couple, peak.t_couple)
        for peak in done.peaks
    ]
    put(
        _ending(done),
        f"The motion {accuracy.sentence}.\n",
        *(f"{sentence}.\n" for sentence in done.passages),
        *_assembled(done.source),
        table("events", ["event", "t [s]", "kind"], [(e.name, accuracy.time(e.t), e.kind) for e in done.events]),
        table("mode changes", _SWITCHED, switch_rows(accuracy.changes)),
        table("report", ["quantity", "value", "unit", "t [s]", ""], reported),
        table("energy", ["", "start [J]", "end [J]"], ledger),
        f"Energy error below {closure(done):.1e} of the largest entry.\n",
        table("largest reactions", ["", "on", "force [N]", "at t [s]", "couple [N·m]", "at t [s]"], peaks),
    )


def certificate(found: Certificate, asked: int, as_json: bool) -> None:
    """The routes with how many digits agree, and the weakest."""
    weakest = found.weakest
    if as_json:
        stated = {"weakest": weakest.name, "asked": asked, "ok": weakest.digits >= asked, "digits": found.run.accuracy.to_json()}
        print_json({"name": found.run.name, **stated, "routes": list(map(_route, found.routes))})
        return
    rows = [(each.name, each.stated, each.what) for each in found.routes]
    put(
        _ending(found.run),
        f"The motion {found.run.accuracy.sentence}.\n",
        table("agreement", ["route", "digits", "what is compared"], rows, ["digits"]),
        f"The weakest link: {weakest.name}, {weakest.stated} digits.",
    )


def _route(route: Route) -> dict[str, Any]:
    """A route as data; with what is lacking where it does not apply."""
    stated = asdict(route)
    lacking = stated.pop("lacking")
    return stated | ({"lacking": lacking} if math.isnan(route.digits) else {})


def _ending(done: Run) -> Text:
    """How and when the run ended; a bad end by its name, where the mechanism stood, what happened and what to do."""
    outcome, name = done.outcome, (done.name, "bold")
    if outcome.ok:
        return Text.assemble(name, ": ", (f"{outcome.sentence}, t = {figure(done.accuracy.end)} s", "green"), "\n")
    place = ", ".join(f"{name} = {value + 0.0:.6g}" for name, value in list(zip(done.coordinates, done.end.q, strict=True))[:6])
    where = f", at {place}" if place else ""
    stated = "\n  ".join(["", *outcome.sentence.split("; ")])
    return Text.assemble(name, ": ", (f"{outcome.name}, t = {figure(done.accuracy.end)} s", "bold red"), where, stated, "\n")


def _assembled(source: CompiledModel) -> list[Text]:
    """The assembly that was taken and the others, where there are several; coordinates that are not as guessed."""
    return [Text("\n".join(["at the start", *source.notes]) + "\n")] if source.notes else []


def closure(done: Run) -> float:
    """Largest error of the energy balance relative to the largest entry of the ledger."""
    ledger = done.energy
    entries = max(abs(ledger[name]).max(initial=0.0) for name in ledger.names if name != "balance")
    worst = abs(ledger.balance).max(initial=0.0)
    return float(worst / entries) if entries else float(worst)


def switch_rows(changes: Sequence[Change]) -> list[Row]:
    """Rows of a table; of many only the first and the last, with one between that says how many there are."""
    rows: list[Row] = [(c.t, c.kind, ", ".join(c.of), c.lost if c.impulses or c.before else "", c.work, c.note) for c in changes]
    if len(rows) <= _FIRST + _LAST + 1:
        return rows
    return [*rows[:_FIRST], ("…", f"{len(rows) - _FIRST - _LAST} more", f"of {len(rows)}", "", "", ""), *rows[-_LAST:]]


# One instant


def instants(
    solved: Sequence[Instant], opening: Run | None, known: Accuracy | None, joint_axes: bool, balance: bool, as_json: bool
) -> None:
    """The first instant whole; the others, by other routes, by how far they are from it; what events at the start make of it; how far
    the motion that leads to it is ``known``."""
    first, *others = solved
    if as_json:
        after: dict[str, Any] = {}
        if opening:
            changes = {"changes": [asdict(change) for change in opened(opening)]}
            after["after_opening"] = changes | _instant_as_dict(opening.instant(opening.start.t), joint_axes)
        if known:
            after["digits"] = known.to_json()
        data = [_instant_as_dict(instant, joint_axes) | after for instant in solved]
        print_json(data if others else data[0])
        return
    put(*_assembled(first.core))
    if opening:
        put(Text("just before the events at the start\n", "bold"))
    elif first.state.moment:
        put(Text(f"{first.state.moment}\n", "bold"))
    if known:
        put(f"{how_far(known)}\n")
    put(*_tables(first, joint_axes))
    if balance:
        put(first.tables()[-1], f"Largest relative residual: {first.residual:.1e}")
    put(first.explanation, *first.self_stress)
    for other in others:
        put(f"{other.route} agrees with {first.route} to {apart(first, other):.1e}")
    if opening:
        after = opening.instant(first.state.t)
        put(Text("\njust after the events at the start\n", "bold"))
        put(table("mode changes", ["kind", "what"], [(c.kind, ", ".join(c.of)) for c in opened(opening)]))
        put(*_tables(after, joint_axes), after.explanation)


def _tables(instant: Instant, joint_axes: bool) -> list[Table]:
    """Those of an instant but the residuals; in joint axes, reactions along and across the line of each joint's first body, on the
    second body."""
    accelerations, reactions, *limits, _ = instant.tables()
    if joint_axes:
        rows: list[Row] = []
        for each in (each for name, each in instant.reactions.items() if each.carries and name not in instant.absent):
            along, across, couple = _parts(each, True).values()
            rows.append((each.name, each.second, along, across, couple if each.has_couple else None))
        reactions = table("reactions in joint axes", ["joint", "on", "along [N]", "across [N]", "couple [N·m]"], rows)
    return [accelerations, reactions, *limits]


def apart(a: Instant, b: Instant) -> float:
    """Largest difference of accelerations or determinate reactions, relative to the largest of its kind."""
    accelerations = [list(instant.accelerations.values()) for instant in (a, b)]
    reactions = [[part for r in instant.reactions.values() for part in _parts(r, False).values()] for instant in (a, b)]
    found = 0.0
    for one, other in map(np.array, (accelerations, reactions)):
        known = ~np.isnan(one - other)
        if largest := np.abs([one[known], other[known]]).max(initial=0.0):
            found = max(found, float(np.abs(one - other)[known].max() / largest))
    return found


def _instant_as_dict(instant: Instant, joint_axes: bool) -> dict[str, Any]:
    values, accelerations = ({name: pair[i] for name, pair in instant.dependent.items()} for i in (0, 1))

    def present(values: Mapping[str, Any]) -> dict[str, Any]:
        return {name: value for name, value in values.items() if name not in instant.absent}

    return {
        "route": instant.route,
        "assembly": list(instant.core.notes),
        "state": present(dict(zip(instant.accelerations, instant.state.q.tolist(), strict=True)) | values),
        "accelerations": present(instant.accelerations | accelerations),
        "reactions": present({r.name: {"on": r.second, **_parts(r, joint_axes)} for r in instant.reactions.values()}),
        "limits": {name: asdict(limit) for name, limit in instant.limits.items()},
        "motions": instant.motions,
        "couplings": instant.couplings,
        "locks": instant.locks,
        "residual": instant.residual,
        "residuals": instant.residuals,
        "freedom": instant.freedom,
        "explanation": instant.explanation,
        "self_stress": instant.self_stress,
    }


def opened(opening: Run) -> list[Change]:
    """Mode changes at the start."""
    return [change for change in opening.changes if change.t == opening.start.t]


def _parts(reaction: Reaction, joint_axes: bool) -> dict[str, float]:
    """Components on the second body; NaN where indeterminate."""
    x, y, couple = np.where(reaction.determined, reaction.values, np.nan).tolist()
    along, across = reaction.local().tolist() if joint_axes else (x, y)
    return {"Fs": along, "Fn": across, "M": couple} if joint_axes else {"Fx": x, "Fy": y, "M": couple}


# A mechanism, a comparison


def mechanism(start: Instant, as_json: bool) -> None:
    """Model assumptions: bodies, coordinates, joints, forces, freedom; what is ignored and assumed; how it is assembled."""
    metadata = start.core.metadata
    if as_json:
        print_json({**metadata, "assembly": list(start.core.notes)})
        return
    bodies = [(b["name"], float(b["mass"]), float(b["inertia"]), "particle" if b["particle"] else "") for b in metadata["bodies"]]
    coordinates = [(c["name"], c["dimension"], c["doc"], "") for c in metadata["coordinates"]]
    coordinates += [(c["name"], c["dimension"], c["doc"], "follows from the others") for c in start.core.dependent_coordinates]
    joints = [(j["name"], j["type"], _ends(j), _closing(j), _later(j)) for j in metadata["joints"]]
    limits = [(x["name"], x["type"], "" if x["type"] == "stop" else _ends(x), _later(x)) for x in metadata["limits"]]
    forces = [(f["name"], f["type"], _later(f)) for f in metadata["forces"]]
    motions = [(m["name"], m["level"], "" if m["ideal"] else "does work of its own", _later(m)) for m in metadata["motions"]]
    values = {p["name"]: (p["unit"], p["value"]) for p in metadata["parameters"]}
    states = [(z["name"], *values[z["name"]], z["rate"]) for z in start.core.spec["states"]]
    put(
        table("bodies", ["body", "mass [kg]", "inertia about G [kg·m²]", ""], bodies),
        table("coordinates", ["coordinate", "unit", "meaning", ""], coordinates),
        table("states", ["state", "unit", "at the start", "rate"], states),
        table("joints", ["joint", "type", "between", "", ""], joints),
        table("contacts, strings and stops", ["", "type", "between", ""], limits),
        table("forces", ["force", "type", ""], forces),
        table("prescribed motions", ["motion", "level", "", ""], motions),
        start.explanation,
        *(f"• {note}" for note in metadata["notes"]),
        *([""] * bool(start.core.notes)),
        *_assembled(start.core),
    )


def _ends(part: Mapping[str, Any]) -> str:
    return f"{part['first']} – {part['second']}"


def _closing(joint: Mapping[str, Any]) -> str:
    return "" if not joint["cut"] else "closes a loop" if joint["holonomic"] else "constrains rates only"


def _later(part: Mapping[str, Any]) -> str:
    return "" if part["engaged"] else "comes later"


def comparison(found: Comparison, as_json: bool) -> None:
    """How far two runs lie apart, column by column."""
    if as_json:
        print_json({"columns": [asdict(d) for d in found.differences], "only": found.only, "parting": found.parting})
        return
    same = sum(not d.largest for d in found.differences)
    stated = [f"{same} of {len(found.differences)} columns are the same at all {len(found.t)} common times"]
    stated += [found.parting] * bool(found.parting)
    stated += [f"only in one of the two: {', '.join(found.only)}"] * bool(found.only)
    put(*([found, ""] if same < len(found.differences) else []), *stated)
