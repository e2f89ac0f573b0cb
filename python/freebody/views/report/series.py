"""The curves of the report: which there are, and their values."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from freebody.core import Array, quote
from freebody.run.records import plain
from freebody.symbolic.symbols import unicode_name
from freebody.views.peaks import couple_noise
from freebody.views.plots import gaps, held_by, pretty_unit, refined_at_jumps
from freebody.views.report.floats import floats

if TYPE_CHECKING:
    from freebody.run.simulation import Run

_CURVES, _POINTS = 8, 900


class Curve(NamedTuple):
    """What is plotted; ``of``: the name of what exerts it, of a force."""

    name: str
    y: Array
    of: str = ""


def plots(run: Run) -> list[dict[str, Any]]:
    """All plots: coordinates, rates, reactions, energies, and what the model reports, over time."""
    shown = refined_at_jumps(run.at(_thinned(run.t, _POINTS)))
    made, following = [], [c["name"] for c in run.source.dependent_coordinates]
    for dots, (kind, title) in enumerate((("coordinate", "Coordinates"), ("rate", "Rates"), ("acceleration", "Accelerations"))):
        names = [*run.coordinates, *following]
        units = [column.unit for column in run.columns if column.kind == kind]
        units += [column.unit for column in run.columns if column.kind == "dependent"][dots * len(following) :][: len(following)]
        values = np.hstack([shown.blocks[kind], shown.blocks["dependent"].reshape(len(shown.t), 3, -1)[:, dots]])
        curves = [Curve(unicode_name(name, dots), y) for name, y in zip(names, values.T, strict=True)]
        for unit in dict.fromkeys(units):
            made.append(_plot(title, unit, shown, [curve for curve, own in zip(curves, units, strict=True) if own == unit]))
    made += _reactions(shown)
    ledger = shown.energy
    stored = [
        *(Curve(*entry) for entry in ledger.entries.items()),
        Curve("kinetic + potential", ledger.kinetic + ledger.potential),
    ]
    made += [_plot("Energy", "J", shown, stored), _plot("Energy error", "J", shown, [Curve("balance", ledger.balance)])]
    return made if run.recorded else made + _asked(shown)


def _thinned(t: Array, most: int) -> Array:
    """Every so-manieth time, the last one always."""
    return t if len(t) <= most else t[np.unique(np.linspace(0, len(t) - 1, most).astype(int))]


def _plot(title: str, unit: str, run: Run, curves: Sequence[Curve], note: str = "") -> dict[str, Any]:
    """One plot; at most eight curves, and a note that says so. Where something switched the curves have gaps."""
    breaks = gaps(run)
    if len(curves) > _CURVES:
        note = f"the first {_CURVES} of {len(curves)} curves. {note}".strip()
    return {
        "title": title,
        "unit": pretty_unit(unit),
        "t": floats(breaks(run.t)),
        "curves": [
            {"name": name, "y": floats(breaks(y, np.nan))} | ({"of": of} if of else {}) for name, y, of in curves[:_CURVES]
        ],
        "note": note,
    }


def _reactions(run: Run) -> list[dict[str, Any]]:
    known = [(name, reaction) for name, reaction in run.reactions.items() if reaction.determinate and reaction.carries]
    silent = [name for name, reaction in run.reactions.items() if not reaction.determinate]
    note = f"indeterminate, not drawn: {', '.join(silent)}" if silent else ""
    noise = couple_noise(run)
    couples = [Curve(name, reaction.M, name) for name, reaction in known if (np.abs(reaction.M) > noise).any()]
    sizes = [Curve(name, r.size, name) for name, r in known]
    made = [_plot("Reactions, size of the force", "N", run, sizes, note)] if known or silent else []
    held, turned = (
        [Curve(plain(text), y, name) for name, each in held_by(run, unit).items() for text, y in each.items()]
        for unit in ("N", "N*m")
    )
    what = "Contacts, strings, stops, locks and motions"
    made += [_plot(what, "N", run, held)] if held else []
    made += [_plot(f"{what}, couple", "N*m", run, turned)] if turned else []
    return made + ([_plot("Reactions, couple", "N*m", run, couples)] if couples else [])


def _asked(run: Run) -> list[dict[str, Any]]:
    """The reported quantities that are not plotted yet, over the whole run; one without any value is left out."""
    plotted = {"t", *(column.name for column in run.columns), *(f"{quote(joint)}.F" for joint in run.reactions)}
    texts = [text for text in dict.fromkeys(item.value for item in run.source.report) if text not in plotted]
    units = {text: run.unit_of(text) for text in texts}
    values = dict(zip(texts, run.motion.evaluate(texts, run.t).T, strict=True)) if texts else {}
    made = []
    for unit in dict.fromkeys(units.values()):
        curves = [Curve(plain(text), y) for text, y in values.items() if units[text] == unit and np.isfinite(y).any()]
        made += [_plot("Reported quantities", unit, run, curves)] if curves else []
    return made
