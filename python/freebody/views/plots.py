"""Plots of a run. Every function takes ``ax``, returns Axes and leaves showing to the caller."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import wraps
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

import numpy as np

from freebody.results import Array, unit_of
from freebody.views.style import DASHES, GROUND, axes, colour, quiet

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from freebody.run import Run

P = ParamSpec("P")
R = TypeVar("R")


def _styled(plot: Callable[P, R]) -> Callable[P, R]:
    @wraps(plot)
    def inner(*args: P.args, **kwargs: P.kwargs) -> R:
        with quiet():
            return plot(*args, **kwargs)

    return inner


@_styled
def series(run: Run, *names: str, ax: Axes | None = None) -> Axes:
    """Columns or expressions over time; without names, the coordinates.

    Two units share the axes, left and right; more are refused.
    """
    ax = axes(ax)
    shown = list(names) or run.coordinates
    units = list(dict.fromkeys(unit_of(name, run.columns) for name in shown))
    if len(units) > 2:
        raise ValueError(f"{len(units)} units do not fit on one plot: {', '.join(unit or 'none' for unit in units)}")
    sides = [ax, *([_right_axis(ax)] if len(units) == 2 else [])]
    for i, name in enumerate(shown):
        k = units.index(unit_of(name, run.columns))
        sides[k].plot(run.t, run[name], color=colour(i), ls=DASHES[k], label=label(run, name))
    for side, unit in zip(sides, units, strict=True):
        own = [name for name in shown if unit_of(name, run.columns) == unit]
        side.set_ylabel(with_unit(label(run, own[0]) if len(own) == 1 else quantity(unit), unit))
    _mark_events(run, ax)
    ax.set(xlabel="t  [s]", xlim=(run.t[0], run.t[-1]))
    _legend(ax, *sides[1:], needed=len(shown) > 1)
    return ax


@_styled
def phase(run: Run, name: str, rate: str | None = None, ax: Axes | None = None) -> Axes:
    """A quantity's rate (default: that of the coordinate) against the quantity."""
    return _against(run, name, rate or f"rate({name})", ax)


@_styled
def against(run: Run, x: str, y: str, ax: Axes | None = None) -> Axes:
    """One quantity against another."""
    return _against(run, x, y, ax)


def _against(run: Run, x: str, y: str, ax: Axes | None) -> Axes:
    ax = axes(ax, (5.2, 4.4))
    ax.plot(run[x], run[y], color=colour(0))
    _ends(ax, run[x], run[y])
    ax.set(xlabel=with_unit(label(run, x), unit_of(x, run.columns)), ylabel=with_unit(label(run, y), unit_of(y, run.columns)))
    _legend(ax)
    return ax


@_styled
def polar(run: Run, angle: str, radius: str, ax: Axes | None = None) -> Axes:
    """A quantity over an angle, in polar axes."""
    if ax is None:
        figure = axes(None, (5.2, 5.2)).figure
        figure.clear()
        ax = figure.add_subplot(projection="polar")
    ax.plot(run[angle], run[radius], color=colour(0))
    ax.set_title(f"{with_unit(label(run, radius), unit_of(radius, run.columns))} over {label(run, angle)}", pad=18)
    return ax


@_styled
def paths(run: Run, *points: str, ax: Axes | None = None) -> Axes:
    """Paths of points in the plane; without names, those at which nothing is joined."""
    from freebody.views.scene import of_run

    ax = axes(ax, (5.6, 5.0))
    for i, name in enumerate(points or of_run(run, run.t[:1]).traces):
        x, y = run[name].T
        ax.plot(x, y, color=colour(i), label=name)
        ax.plot(x[:1], y[:1], "o", color=colour(i), ms=5)
    ax.set(xlabel="x  [m]", ylabel="y  [m]")
    ax.set_aspect("equal", adjustable="datalim")
    _legend(ax)
    return ax


@_styled
def energy(run: Run, ax: Axes | None = None) -> Axes:
    """The energy ledger: what is stored, what was put in, and (in the legend) how well the books close."""
    ax = axes(ax)
    ledger = run.energy
    curves = {**ledger.entries, "kinetic + potential": ledger.kinetic + ledger.potential}
    for i, (name, values) in enumerate(curves.items()):
        ax.plot(run.t, values, color=colour(i), ls="--" if name.startswith("work of ") else "-", label=name)
    _mark_events(run, ax)
    ax.set(xlabel="t  [s]", ylabel="energy  [J]", xlim=(run.t[0], run.t[-1]))
    ax.set_title(f"balance within {np.abs(ledger.balance).max():.1e} J", fontsize=10, color=GROUND, pad=16)
    _legend(ax)
    return ax


@_styled
def reactions(run: Run, *joints: str, part: str = "size", ax: Axes | None = None) -> Axes:
    """A part of the reactions of joints over time (``Fx``, ``Fy``, ``M``, ``size``); indeterminate ones are named, not drawn."""
    ax = axes(ax)
    silent = []
    for i, name in enumerate(joints or run.reactions):
        if run.reactions[name].determinate:
            ax.plot(run.t, getattr(run.reactions[name], part), color=colour(i), label=name)
        else:
            silent.append(name)
    _mark_events(run, ax)
    ax.set(xlabel="t  [s]", ylabel="couple  [N·m]" if part == "M" else "force  [N]", xlim=(run.t[0], run.t[-1]))
    if silent:
        ax.set_title(f"indeterminate, not drawn: {', '.join(silent)}", fontsize=10, color=GROUND, pad=16)
    _legend(ax)
    return ax


@_styled
def overlay(a: Run, b: Run, names: Sequence[str], ax: Axes | None = None) -> Axes:
    """Columns of two runs over time, the second dashed."""
    ax = axes(ax)
    for i, name in enumerate(names):
        ax.plot(a.t, a[name], color=colour(i), label=f"{label(a, name)}, first")
        ax.plot(b.t, b[name], color=colour(i), ls="--", label="second")
    units = list(dict.fromkeys(unit_of(name, a.columns) for name in names))
    ax.set(xlabel="t  [s]", ylabel=with_unit(label(a, names[0]) if len(names) == 1 else "", ", ".join(units)))
    _legend(ax)
    return ax


def label(run: Run, name: str) -> str:
    """A column's symbol; other expressions as they are written."""
    symbols = {column.name: f"${column.symbol}$" for column in run.columns}
    return symbols.get(name, name.replace("$", r"\$"))


def with_unit(text: str, unit: str) -> str:
    """An axis label: the text, then the unit in brackets as people write it."""
    return f"{text}  [{pretty_unit(unit)}]".strip() if unit else text


def pretty_unit(unit: str) -> str:
    """``N*m/s^2`` → ``N·m/s²``."""
    return re.sub(r"\^?(?<=\^)(\d)", lambda power: "⁰¹²³⁴⁵⁶⁷⁸⁹"[int(power[1])], unit).replace("^", "").replace("*", "·")


def quantity(unit: str) -> str:
    """What is measured in a unit, for the axis of several curves."""
    words = {
        "rad": "angle",
        "m": "length",
        "rad/s": "angular velocity",
        "m/s": "velocity",
        "N": "force",
        "N*m": "couple",
        "J": "energy",
        "W": "power",
    }
    return words.get(unit, "")


def _mark_events(run: Run, ax: Axes) -> None:
    """Thin lines at events, each name above its first one."""
    named = set()
    for event in [event for event in run.events if run.t[0] < event.t < run.t[-1]][:40]:
        ax.axvline(event.t, color=GROUND, lw=0.8, ls=(0, (2, 3)), zorder=1)
        if event.name not in named:
            ax.annotate(event.name, (event.t, 1), xycoords=("data", "axes fraction"), xytext=(0, 3), textcoords="offset points",
                        fontsize=8.5, color=GROUND, ha="center")  # fmt: skip
        named.add(event.name)


def _right_axis(ax: Axes) -> Axes:
    right = ax.twinx()
    right.grid(visible=False)
    right.spines["right"].set_visible(True)
    return right


def _ends(ax: Axes, x: Array, y: Array) -> None:
    ax.plot(x[:1], y[:1], "o", color=colour(0), ms=6, label="start")
    ax.plot(x[-1:], y[-1:], "s", color=colour(0), ms=6, mfc="white", label="end")


def _legend(ax: Axes, *others: Axes, needed: bool = True) -> None:
    """A legend above or beside the curves, never on them."""
    pairs: list[tuple[Any, str]] = [
        pair for side in (ax, *others) for pair in zip(*side.get_legend_handles_labels(), strict=True)
    ]
    if needed and pairs:
        handles, labels = zip(*pairs, strict=True)
        beside = 1.14 if others else 1.01
        ax.legend(handles, labels, loc="upper left", bbox_to_anchor=(beside, 1.0), borderaxespad=0.0)
