"""Draws the pictures of the documents: `.venv/bin/python docs/picture.py` writes docs/four_bar.svg, docs/free_body.svg and docs/homework.svg.

The linkage of examples/four_bar.yaml from its release until it comes to rest on the other side, and the force at each pin; and
the free-body diagrams of its crank, and of crank and coupler together, and of the bar of the homework.
"""

from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import freebody
from freebody import Run
from freebody.views.render import frame_axes, render
from freebody.views.scene import of_run
from freebody.views.style import INK, colour, quiet

HERE = Path(__file__).parent
GHOSTS = (0.2, 0.36, 0.48, 0.6, 0.7)
PINS = {"A": (0, 0), "B": "crank.end", "C": "rocker.end", "D": (1.2, 0)}
TRACED = ("crank.end", "coupler.G", "rocker.end")


def draw_motion(run: Run, ax: Axes) -> None:
    """The start, a few later places in pale, and the ways of three points."""
    whole = of_run(run, traces=())
    frame_axes(whole, ax)
    ax.set_axis_off()
    for t in GHOSTS:
        for artist in render(whole, ax, int(np.argmin(abs(run.t - t)))):
            artist.set(alpha=0.13, zorder=1)
    render(whole, ax)
    for i, point in enumerate(TRACED):
        ax.plot(*run[point].T, color=colour(i), lw=1.4, zorder=1.5)
    for name, where in PINS.items():
        x, y = run[where][0] if isinstance(where, str) else where
        ax.annotate(name, (x, y), (9, 9), textcoords="offset points", color=INK)


def draw_forces(run: Run, ax: Axes) -> None:
    """The size of the force at each pin over time."""
    for i, (name, reaction) in enumerate(run.reactions.items()):
        ax.plot(run.t, reaction.size, color=colour(i), label=name)
    ax.set(xlabel="t  [s]", ylabel="force at the pin  [N]", xlim=(0, run.t[-1]), ylim=(0, None))
    ax.legend(ncols=2, loc="upper right")


def main() -> None:
    linkage = freebody.load(HERE.parent / "examples" / "four_bar.yaml")
    run = linkage.simulate(until="1.074 s")
    with quiet():
        # Symbols stay text and names are fixed: a small file, the same each time.
        matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "freebody"})
        figure = Figure(figsize=(9.6, 4.0), layout="constrained")
        left, right = figure.subplots(1, 2, width_ratios=(1.45, 1))
        draw_motion(run, left)
        draw_forces(run, right)
        figure.savefig(HERE / "four_bar.svg", metadata={"Date": None})
    linkage.diagram(["crank", "crank+coupler"]).save(HERE / "free_body.svg")
    freebody.load(HERE / "homework.yaml").diagram(column=120).save(HERE / "homework.svg")


if __name__ == "__main__":
    main()
