"""What a motion takes, drawn: forces of motors over angle and time, loads of pins as polar diagrams."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from freebody.formats import replacing
from freebody.views.plots import label, with_unit
from freebody.views.style import GROUND, axes, colour, quiet

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from freebody.inverse import InverseDynamics

_SAMPLES = 721
"""Of a curve: every half degree of a turn."""
_ABREAST = 4
"""Polar diagrams in a row."""


@quiet()
def motors(found: InverseDynamics, over: str = "t", ax: Axes | None = None) -> Axes:
    """The forces of all motors over the time, or over another expression; the unit of the first, with the others that have it."""
    from matplotlib.ticker import MaxNLocator

    ax, t = axes(ax), np.linspace(*found.run.edges[[0, -1]], _SAMPLES)
    unit = next(iter(found.motors.values())).unit
    shown = [motor for motor in found.motors.values() if motor.unit == unit]
    x = t if over == "t" else found.run.evaluate(over, t)
    turned = over != "t" and found.run.unit_of(over) == "rad"
    x = np.degrees(x) if turned else x
    for i, (motor, values) in enumerate(zip(shown, found.values([each.force for each in shown], t).T, strict=True)):
        ax.plot(x, values, color=colour(i), label=motor.name)
        if limit := (found.actuators.limits if found.actuators else {}).get(motor.name):
            for side in (-limit, limit):
                ax.axhline(side, color=colour(i), lw=0.8, ls=":")
    ax.axhline(0, color=GROUND, lw=0.6)
    what = "torque" if unit == "N*m" else "force"
    along = with_unit(label(found.run, over), "°" if turned else found.run.unit_of(over))
    if turned:
        ax.xaxis.set_major_locator(MaxNLocator(9, steps=[1, 1.5, 3, 4.5, 9, 10]))
    ax.set(xlabel=along, ylabel=with_unit(what, unit), xlim=tuple(sorted((x[0], x[-1]))) if x[0] != x[-1] else None)
    if len(shown) > 1:
        ax.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0)
    return ax


@quiet()
def pin_load(found: InverseDynamics, joint: str, ax: Axes, axes: str = "ground") -> Axes:
    """The polar load diagram of a joint: the force on its second body as a vector from the middle, over the motion, along the axes of
    the ground or of a body: those of a shaft show where its journal wears."""
    t = np.linspace(*found.run.edges[[0, -1]], _SAMPLES)
    second = next(each["second"] for each in found.source.metadata["joints"] if each["name"] == joint)
    x, y = found.values(found.pin_load(joint, axes), t).T
    seen = "" if axes == "ground" else f", axes of {axes}"
    ax.set_title(f"{joint}, on {second}{seen}  [N]", fontsize=10, pad=10)
    if np.isnan(x).any() or np.isnan(y).any():
        ax.annotate("indeterminate", (0.5, 0.5), xycoords="axes fraction", ha="center", color=GROUND)
        return ax
    place = found.pins.index(joint)
    ax.plot(np.arctan2(y, x), np.hypot(x, y), color=colour(place))
    ax.plot(np.arctan2(y[:1], x[:1]), np.hypot(x[:1], y[:1]), "o", color=colour(place), ms=5)
    ax.tick_params(labelsize=8, pad=1)
    seldom = int(np.argmin(np.histogram(np.arctan2(y, x) % (2 * np.pi), 8, (0, 2 * np.pi))[0]))
    ax.set_rlabel_position(45 * seldom + 22.5)  # the curve does not run through these figures
    return ax


@quiet()
def sheet(found: InverseDynamics, joints: Sequence[str] = (), axes: str = "ground", title: str = "") -> Figure:
    """Forces of the motors over the gauge and over time, and the polar load diagrams of ``joints``, all by default, along the ``axes``
    of a body; a dot is the start. The ``title`` is the name of the model by default."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    shown = list(joints) or found.pins
    rows = -(-len(shown) // _ABREAST)
    figure = Figure(figsize=(9.6, 3.0 * (1 + rows)), layout="constrained")
    FigureCanvasAgg(figure)
    grid = figure.add_gridspec(1 + rows, 2 * _ABREAST)
    if found.run.unit_of(found.gauge) and np.ptp(found.run[found.gauge]) > 0:
        motors(found, found.gauge, figure.add_subplot(grid[0, :_ABREAST]))
        motors(found, "t", figure.add_subplot(grid[0, _ABREAST:]))
    else:
        motors(found, "t", figure.add_subplot(grid[0, :]))
    for i, joint in enumerate(shown):
        row, column = divmod(i, _ABREAST)
        pin_load(found, joint, figure.add_subplot(grid[1 + row, 2 * column : 2 * column + 2], projection="polar"), axes)
    figure.suptitle(title or found.name, x=0.01, ha="left", fontsize=12)
    return figure


def save(found: InverseDynamics, path: Path, axes: str = "ground", title: str = "") -> Path:
    """Write the sheet as a picture."""
    with replacing(path) as beside:
        sheet(found, axes=axes, title=title).savefig(beside, dpi=150, bbox_inches="tight")
    return path
