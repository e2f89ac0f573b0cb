"""How everything looks: one palette, readable type, quiet axes."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# After Okabe and Ito (2008), told apart by colour-blind readers too; the order keeps neighbours far apart.
PALETTE = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7a5195", "#6b6b6b")
INK = "#23272e"
GROUND = "#5b6470"
PAPER = "#ffffff"
IMPACT = "#b3261e"
DASHES = ("-", "--", "-.", ":")


def colour(i: int) -> str:
    """The colour of the i-th body or curve."""
    return PALETTE[i % len(PALETTE)]


@contextmanager
def quiet() -> Iterator[None]:
    """Matplotlib settings for a plot, in force within a ``with``; as a decorator, in a function."""
    import matplotlib

    settings: Any = {
        "font.size": 10.5,
        "axes.titlesize": 11.5,
        "axes.titlelocation": "left",
        "axes.labelcolor": INK,
        "text.color": INK,
        "axes.edgecolor": "#9aa1ab",
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "axes.axisbelow": True,
        "grid.color": "#e4e7eb",
        "grid.linewidth": 0.8,
        "xtick.color": GROUND,
        "ytick.color": GROUND,
        "lines.linewidth": 1.8,
        "lines.solid_capstyle": "round",
        "mathtext.fontset": "dejavusans",
        "legend.frameon": False,
    }
    with matplotlib.rc_context(settings):
        yield


def axes(ax: Axes | None, size: tuple[float, float] = (7.2, 4.0)) -> Axes:
    """The given axes, or new ones in a figure of their own (inches), made without pyplot's global state."""
    if ax is not None:
        return ax
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=size, layout="constrained", dpi=110)
    FigureCanvasAgg(figure)
    return figure.add_subplot()
