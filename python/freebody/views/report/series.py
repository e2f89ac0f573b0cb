"""The curves of the report: which there are, and their values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from freebody.core import Array, quote
from freebody.model.user_units import shown
from freebody.run.peaks import couple_noise
from freebody.run.records import plain
from freebody.symbolic.symbols import unicode_name
from freebody.views.plots import gaps, held_by, pretty_unit, refined_at_jumps
from freebody.views.report.floats import floats

if TYPE_CHECKING:
    from freebody.run.simulation import Run

_NUMBERS, _POINTS, _LEAST_POINTS = 80_000, 900, 150
"""Of all curves together, a third of a megabyte, and of each."""
_ROUND_OFF = 1e-9
"""Of the largest of its kind, below which a value is what rounding left."""
_ORDERS = {"coordinate": "Coordinates", "rate": "Rates", "acceleration": "Accelerations"}
"""Kinds of columns by their order, with the titles of their plots."""


class Curve(NamedTuple):
    """What is plotted; ``of``: the name of what exerts it, of a force."""

    name: str
    y: Array
    of: str = ""


def plots(run: Run) -> list[dict[str, Any]]:
    """All plots: coordinates, rates, reactions, energies, and what the model reports, over time."""
    finer = refined_at_jumps(run.at(_thinned(run.t, _points(run))))
    made = _wanted(finer) + _coordinates(finer) + _reactions(finer)
    ledger = finer.energy
    stored = [
        *map(Curve, ledger.entries, ledger.entries.values()),
        Curve("kinetic + potential", ledger.kinetic + ledger.potential),
    ]
    made += [
        _plot("Energy", "J", finer, _resolved(stored)),
        _plot("Energy error", "J", finer, [Curve("balance", ledger.balance)]),
    ]
    return made if run.recorded else made + _asked(finer)


def over_each_other(own: list[dict[str, Any]], others: Mapping[str, list[dict[str, Any]]]) -> list[dict[str, Any]]:
    """Plots with the curves of other runs, by their names, beside those of their own that are called alike."""
    for run, plotted in others.items():
        alike = {(plot["title"], plot["unit"]): plot for plot in plotted if "across" not in plot}
        for plot in own:
            other = alike.get((plot["title"], plot["unit"]), {"curves": []}) if "across" not in plot else {"curves": []}
            places = {curve["name"]: i for i, curve in enumerate(plot["curves"]) if "beside" not in curve}
            plot["curves"] += [
                {"name": f"{curve['name']} ({run})", "y": curve["y"], "t": other["t"], "beside": places[curve["name"]]}
                for curve in other["curves"]
                if curve["name"] in places
            ]
    return own


def _points(run: Run) -> int:
    """How many of each curve are shown, so that all of them fit in a page."""
    curves = 3 * len(run.coordinates) + 3 * len(run.source.dependent_coordinates) + 2 * len(run.metadata["joints"]) + 10
    return int(np.clip(_NUMBERS // curves, _LEAST_POINTS, _POINTS))


def _coordinates(run: Run) -> list[dict[str, Any]]:
    """Coordinates, those that follow from them too, their rates and accelerations; a plot for each unit."""
    following = [c["name"] for c in run.source.dependent_coordinates]
    names, dependent = [*run.coordinates, *following], run.dependent.reshape(len(run.t), 3, -1)
    orders = [np.hstack([own, dependent[:, dots]]) for dots, own in enumerate((run.q, run.u, run.accelerations))]
    lasting = (run.t[-1] - run.t[0]) or 1.0
    largest = np.max([np.abs(values).max(axis=0, initial=0.0) * lasting**dots for dots, values in enumerate(orders)], axis=0)
    made = []
    for dots, (values, (kind, title)) in enumerate(zip(orders, _ORDERS.items(), strict=True)):
        units = [column.unit for column in run.columns if column.kind == kind]
        units += [column.unit for column in run.columns if column.kind == "dependent"][dots * len(following) :][: len(following)]
        resolved = np.where(np.abs(values) > _ROUND_OFF * largest / lasting**dots, values, 0.0)
        curves = [Curve(unicode_name(name, dots), y) for name, y in zip(names, resolved.T, strict=True)]
        for unit in dict.fromkeys(units):
            made.append(_plot(title, unit, run, [curve for curve, own in zip(curves, units, strict=True) if own == unit]))
    return made


def _resolved(curves: Sequence[Curve]) -> list[Curve]:
    """The curves, which are of one kind, with 0 for what is round-off beside the largest."""
    least = _ROUND_OFF * max((float(np.nanmax(np.abs(curve.y), initial=0.0)) for curve in curves), default=0.0)
    return [curve._replace(y=np.where(np.abs(curve.y) <= least, 0.0, curve.y)) for curve in curves]


def _thinned(t: Array, most: int) -> Array:
    """Evenly thinned times, the last one always."""
    return t if len(t) <= most else t[np.unique(np.linspace(0, len(t) - 1, most).astype(int))]


def _plot(title: str, unit: str, run: Run, curves: Sequence[Curve], note: str = "") -> dict[str, Any]:
    """One plot. Where something switched the curves have gaps."""
    breaks, (shown_as, size) = gaps(run), shown(unit)
    return {
        "title": title,
        "unit": pretty_unit(shown_as),
        "t": floats(breaks(run.t)),
        "curves": [{"name": name, "y": floats(breaks(y / size, np.nan))} | ({"of": of} if of else {}) for name, y, of in curves],
        "note": note,
    }


def _reactions(run: Run) -> list[dict[str, Any]]:
    known = [(name, reaction) for name, reaction in run.reactions.items() if reaction.determinate and reaction.carries]
    silent = [name for name, reaction in run.reactions.items() if not reaction.determinate]
    note = f"indeterminate, not drawn: {', '.join(silent)}" if silent else ""
    noise = couple_noise(run)
    couples = [Curve(name, reaction.M, name) for name, reaction in known if (np.abs(reaction.M) > noise).any()]
    sizes = [Curve(name, r.size, name) for name, r in known]
    made = [_plot("Reactions, size of the force", "N", run, _resolved(sizes), note)] if known or silent else []
    held, turned = (
        [Curve(plain(text), y, name) for name, each in held_by(run, unit).items() for text, y in each.items()]
        for unit in ("N", "N*m")
    )
    what = "Contacts, strings, stops, locks and motions"
    made += [_plot(what, "N", run, _resolved(held))] if held else []
    made += [_plot(f"{what}, couple", "N*m", run, _resolved(turned))] if turned else []
    return made + ([_plot("Reactions, couple", "N*m", run, couples)] if couples else [])


def _wanted(run: Run) -> list[dict[str, Any]]:
    """The plots that the model asks for."""
    made = []
    for item in run.source.plots:
        values = run.motion.evaluate([*item.up, item.across], run.t).T
        curves = [Curve(plain(text), y) for text, y in zip(item.up, values[:-1], strict=True)]
        plot = _plot(item.title, run.unit_of(item.up[0]), run, _resolved(curves))
        if item.across != "t":
            below = _plot("", run.unit_of(item.across), run, [Curve(plain(item.across), values[-1])])
            plot["across"] = below["curves"][0] | {"unit": below["unit"], "around": item.around}
        made.append(plot)
    return made


def _asked(run: Run) -> list[dict[str, Any]]:
    """The reported quantities that are not plotted yet, over the whole run; one without any value is left out. An expression goes by
    the name of its line in the report."""
    plotted = {"t", *(column.name for column in run.columns), *(f"{quote(joint)}.F" for joint in run.reactions)}
    labels = {item.value: item.label for item in run.source.report if item.value not in plotted}
    texts = list(labels)
    units = {text: run.unit_of(text) for text in texts}
    values = dict(zip(texts, run.motion.evaluate(texts, run.t).T, strict=True)) if texts else {}
    names = {text: labels[text] if "(" in text else plain(text) for text in texts}
    made = []
    for unit in dict.fromkeys(units.values()):
        curves = [Curve(names[text], y) for text, y in values.items() if units[text] == unit and np.isfinite(y).any()]
        made += [_plot("Reported quantities", unit, run, _resolved(curves))] if curves else []
    return made
