"""Plots of a run. Every function takes ``ax``, returns Axes and leaves showing to the caller."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import Array, quote
from freebody.model.user_units import shown
from freebody.views.labels import mathtext
from freebody.views.style import DASHES, GROUND, IMPACT, axes, colour, quiet

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from freebody.run.simulation import Run

_JUMPS = 500  # at most so many gaps in a curve
_MEASURED = {"rad": "angle", "m": "length", "rad/s": "angular velocity", "m/s": "velocity", "N": "force", "N*m": "couple", "J": "energy",
             "W": "power"}  # fmt: skip
"""What is measured in a unit, for the axis of several curves."""


@quiet()
def series(run: Run, *names: str, ax: Axes | None = None) -> Axes:
    """Columns or expressions over time; without names, the coordinates.

    Two units share the axes, left and right; more are refused.
    """
    ax, run = axes(ax), refined_at_jumps(run)
    breaks = gaps(run)
    drawn = list(names) or run.coordinates
    units = list(dict.fromkeys(run.unit_of(name) for name in drawn))
    if len(units) > 2:
        raise ValueError(f"{len(units)} units do not fit on one plot: {', '.join(unit or 'none' for unit in units)}")
    sides = [ax]
    if len(units) == 2:
        sides.append(ax.twinx())
        sides[1].grid(visible=False)
        sides[1].spines["right"].set_visible(True)
    for i, name in enumerate(drawn):
        k = units.index(run.unit_of(name))
        sides[k].plot(
            breaks(run.t), breaks(run[name] / shown(units[k]).size, np.nan), color=colour(i), ls=DASHES[k], label=label(run, name)
        )
    for side, unit in zip(sides, units, strict=True):
        own = [name for name in drawn if run.unit_of(name) == unit]
        side.set_ylabel(with_unit(label(run, own[0]) if len(own) == 1 else _MEASURED.get(unit, ""), shown(unit).unit))
    _mark_events(run, ax)
    ax.set(xlabel="t  [s]", xlim=(run.t[0], run.t[-1]))
    _legend(ax, *sides[1:], needed=len(drawn) > 1)
    return ax


def phase(run: Run, name: str, rate: str | None = None, ax: Axes | None = None) -> Axes:
    """A quantity's rate (default: that of the coordinate) against the quantity."""
    return against(run, name, rate or f"rate({name})", ax)


@quiet()
def against(run: Run, x: str, y: str, ax: Axes | None = None) -> Axes:
    """One quantity against another."""
    ax = axes(ax, (5.2, 4.4))
    (right, across), (up, along) = (_in_user_units(run, name) for name in (x, y))
    ax.plot(right, up, color=colour(0))
    ax.plot(right[:1], up[:1], "o", color=colour(0), ms=6, label="start")
    ax.plot(right[-1:], up[-1:], "s", color=colour(0), ms=6, mfc="white", label="end")
    ax.set(xlabel=with_unit(label(run, x), across), ylabel=with_unit(label(run, y), along))
    _legend(ax)
    return ax


@quiet()
def polar(run: Run, angle: str, radius: str, ax: Axes | None = None) -> Axes:
    """A quantity over an angle, in polar axes."""
    if ax is None:
        figure = axes(None, (5.2, 5.2)).figure
        figure.clear()
        ax = figure.add_subplot(projection="polar")
    away, unit = _in_user_units(run, radius)
    ax.plot(run[angle], away, color=colour(0))
    ax.set_title(f"{with_unit(label(run, radius), unit)} over {label(run, angle)}", pad=18)
    return ax


@quiet()
def wanted(run: Run, title: str, ax: Axes | None = None) -> Axes:
    """A plot that the model asks for under ``plots``, by its title."""
    items = {item.title: item for item in run.source.plots}
    if title not in items:
        raise KeyError(f"the model asks for no plot {title!r}; there are {', '.join(items) or 'none'}")
    item = items[title]
    if item.across == "t":
        drawn = series(run, *item.up, ax=ax)
    else:
        drawn = (polar if item.around else against)(run, item.across, *item.up, ax=ax)
    drawn.set_title(title)
    return drawn


@quiet()
def paths(run: Run, *points: str, ax: Axes | None = None) -> Axes:
    """Paths of points in the plane; without names, those at which nothing is joined."""
    from freebody.views.scene import of_run

    ax = axes(ax, (5.6, 5.0))
    length = shown("m")
    for i, name in enumerate(points or of_run(run, run.t[:1]).traces):
        x, y = run[name].T / length.size
        ax.plot(x, y, color=colour(i), label=name)
        ax.plot(x[:1], y[:1], "o", color=colour(i), ms=5)
    ax.set(xlabel=with_unit("x", length.unit), ylabel=with_unit("y", length.unit))
    ax.set_aspect("equal", adjustable="datalim")
    _legend(ax)
    return ax


@quiet()
def energy(run: Run, ax: Axes | None = None) -> Axes:
    """The energy ledger: what is stored, what was put in, and (in the title) how well the books close."""
    run = refined_at_jumps(run)
    ledger = run.energy
    curves = {**ledger.entries, "kinetic + potential": ledger.kinetic + ledger.potential}
    drawn = [(name, values, "--" if name.startswith("work of ") else "-") for name, values in curves.items()]
    return _over_time(run, drawn, ("energy", "J"), f"balance within {np.abs(ledger.balance).max():.1e} J", ax)


@quiet()
def reactions(run: Run, *names: str, part: str = "size", ax: Axes | None = None) -> Axes:
    """A part of the reactions of joints over time (``Fx``, ``Fy``, ``M``, ``size``), and the forces of contacts, strings, stops,
    locks and prescribed motions; indeterminate ones are named, not drawn. Without names, all that can carry a load."""
    run = refined_at_jumps(run)
    held = held_by(run, "N*m" if part == "M" else "N")
    asked = names or [*(name for name, reaction in run.reactions.items() if reaction.carries), *held]
    silent = [name for name in asked if name in run.reactions and not run.reactions[name].determinate]
    placed = [limit["name"] for limit in run.metadata["limits"] if limit["type"] != "stop"]
    drawn: list[tuple[str, Array, str]] = []
    for name in asked:
        if name in run.reactions:
            drawn += [] if name in silent else [(name, getattr(run.reactions[name], part), "-")]
        elif part in ("size", "M"):
            drawn += [(text, values, "-") for text, values in held.get(name, {}).items()]
        elif name in placed:
            drawn.append((name, run[f"{quote(name)}.{part}"], "-"))
    title = f"indeterminate, not drawn: {', '.join(silent)}" if silent else ""
    return _over_time(run, drawn, ("couple", "N*m") if part == "M" else ("force", "N"), title, ax)


def _over_time(run: Run, curves: Sequence[tuple[str, Array, str]], what: tuple[str, str], title: str, ax: Axes | None) -> Axes:
    """Curves with their names and dashes over the times of a run, with gaps where something switched; ``what`` they are and its
    unit."""
    ax, breaks, unit = axes(ax), gaps(run), shown(what[1])
    for i, (name, values, dashes) in enumerate(curves):
        ax.plot(breaks(run.t), breaks(values / unit.size, np.nan), color=colour(i), ls=dashes, label=name)
    _mark_events(run, ax)
    ax.set(xlabel="t  [s]", ylabel=with_unit(what[0], unit.unit), xlim=(run.t[0], run.t[-1]))
    if title:
        ax.set_title(title, fontsize=10, color=GROUND, pad=16)
    _legend(ax)
    return ax


def held_by(run: Run, unit: str = "N") -> dict[str, dict[str, Array]]:
    """What each contact, string, stop, lock and prescribed motion carries in a unit, N or N*m: values (nt,) by expression; no friction
    that is 0 throughout."""
    own = {quote(part["name"]): part["name"] for each in ("limits", "locks", "motions") for part in run.metadata[each]}
    found: dict[str, dict[str, Array]] = {}
    columns = (column for column in run.columns if column.kind == "limit")
    for column, values in zip(columns, run.blocks["limit"].T, strict=True):
        owner, _, part = column.name.rpartition(".")
        if part != "gap" and (column.unit or "N") == unit and (part != "T" or values.any()):
            found.setdefault(own[owner], {})[column.name] = values
    return found


def refined_at_jumps(run: Run) -> Run:
    """The run with the times at which something switched (of very many some) and those just before; one from a file knows no
    more than its own."""
    jumps = run.jumps[(run.jumps > run.t[0]) & (run.jumps <= run.t[-1])]
    jumps = jumps[:: len(jumps) // _JUMPS + 1]
    if run.recorded or not len(jumps):
        return run
    return run.at(np.unique(np.concatenate([run.t, jumps, np.nextafter(jumps, -np.inf)])))


def gaps(run: Run) -> Callable[..., Array]:
    """What puts a value more (default: the one there) before each place of values (nt,) at which something switched."""
    # After the last time there is nothing to be kept apart.
    places = np.flatnonzero(np.isin(run.t, run.jumps[run.jumps < run.t[-1]]) & (run.t > run.t[0]))

    def insert(values: Array, fill: float | None = None) -> Array:
        return np.insert(values, places, values[places] if fill is None else fill)

    return insert


@quiet()
def overlay(a: Run, b: Run, names: Sequence[str], ax: Axes | None = None) -> Axes:
    """Columns of two runs over time, the second dashed."""
    ax = axes(ax)
    a, b = refined_at_jumps(a), refined_at_jumps(b)
    for i, name in enumerate(names):
        for run, dashes, text in ((a, "-", f"{label(a, name)}, first"), (b, "--", "second")):
            breaks = gaps(run)
            ax.plot(breaks(run.t), breaks(_in_user_units(run, name)[0], np.nan), color=colour(i), ls=dashes, label=text)
    units = dict.fromkeys(shown(a.unit_of(name)).unit for name in names)
    ax.set(xlabel="t  [s]", ylabel=with_unit(label(a, names[0]) if len(names) == 1 else "", ", ".join(units)))
    _legend(ax)
    return ax


def label(run: Run, name: str) -> str:
    """A column's symbol; other expressions as they are written."""
    symbols = {column.name: f"${mathtext(column.symbol)}$" for column in run.columns}
    return symbols.get(name, name.replace("$", r"\$"))


def _in_user_units(run: Run, name: str) -> tuple[Array, str]:
    """A column or expression as it is shown, and the unit."""
    unit, size = shown(run.unit_of(name))
    return run[name] / size, unit


def with_unit(text: str, unit: str) -> str:
    """An axis label: the text, then the unit in brackets as people write it."""
    return f"{text}  [{pretty_unit(unit)}]".strip() if unit else text


def pretty_unit(unit: str) -> str:
    """``N*m/s^2`` → ``N·m/s²``."""
    return re.sub(r"\^?(?<=\^)(\d)", lambda power: "⁰¹²³⁴⁵⁶⁷⁸⁹"[int(power[1])], unit).replace("^", "").replace("*", "·")


def _mark_events(run: Run, ax: Axes) -> None:
    """Thin lines at events and impacts, each name above its first one; ticks at the foot where something else switched; grey from
    when no digit holds."""
    if not run.recorded and (none_from := run.accuracy.none_from) is not None:
        ax.axvspan(none_from, run.edges[-1], color=GROUND, alpha=0.15, lw=0, zorder=0)
        place = {"xycoords": ("data", "axes fraction"), "xytext": (4, 4), "textcoords": "offset points"}
        ax.annotate("no digit holds", (none_from, 0), **place, fontsize=8.5, color=GROUND)
    named = set()
    impacts = [(", ".join(change.of), change.t) for change in run.impacts]
    for tone, moments in ((GROUND, [(event.name, event.t) for event in run.events]), (IMPACT, impacts)):
        for name, t in [moment for moment in moments if run.t[0] < moment[1] < run.t[-1]][:40]:
            ax.axvline(t, color=tone, lw=0.8, ls=(0, (2, 3)), alpha=1.0 if tone == GROUND else 0.5, zorder=1)
            if name not in named:
                ax.annotate(name, (t, 1), xycoords=("data", "axes fraction"), xytext=(0, 3), textcoords="offset points",
                            fontsize=8.5, color=tone, ha="center")  # fmt: skip
            named.add(name)
    others = [change.t for change in run.changes if not change.impulses and run.t[0] < change.t < run.t[-1]]
    ax.plot(others, np.zeros(len(others)), "|", color=GROUND, ms=7, transform=ax.get_xaxis_transform(), zorder=1)


def _legend(ax: Axes, *others: Axes, needed: bool = True) -> None:
    """A legend beside the curves, never on them."""
    pairs: list[Any] = [pair for side in (ax, *others) for pair in zip(*side.get_legend_handles_labels(), strict=True)]
    if needed and pairs:
        handles, labels = zip(*pairs, strict=True)
        ax.legend(handles, labels, loc="upper left", bbox_to_anchor=(1.14 if others else 1.01, 1.0), borderaxespad=0.0)
