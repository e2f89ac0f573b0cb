"""The modes of an equilibrium, each drawn at both ends of its swing, over the place of rest."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from freebody.core import Array, State
from freebody.formats import replacing
from freebody.stability.equilibria import Equilibrium
from freebody.views.render import frame_axes, render
from freebody.views.scene import drawn
from freebody.views.sketch import Sketch, sketch_of_state
from freebody.views.style import quiet

_SWING = 0.3
"""The largest amplitude that is drawn, rad or part of the mechanism."""
_FAINT, _ACROSS, _WIDTH, _HEIGHT = 0.25, 3, 3.4, 3.2


def draw_modes(rest: Equilibrium, path: Path) -> Path:
    """Writes one drawing a mode, with its frequency, damping ratio and the amplitudes of the coordinates; loops are closed in each."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    count = max(1, len(rest.modes))
    across = min(_ACROSS, count)
    down = -(-count // across)
    with quiet():
        figure = Figure(figsize=(_WIDTH * across, _HEIGHT * down), layout="constrained", dpi=110)
        FigureCanvasAgg(figure)
        units = rest.source.free_bodies(rest.state).units(rest.source.metadata["coordinates"])
        for i, mode in enumerate(rest.modes):
            ax = figure.add_subplot(down, across, i + 1)
            ax.set_axis_off()
            shape = np.array(list(mode.shape.values())).real
            swing = _SWING * shape / (np.abs(shape / units).max() or 1.0)
            corners: list[list[float]] = []
            sketches = [drawn(_moved(rest, swing * part)) for part in (0.0, -1.0, 1.0)]
            for sketch in sketches:
                frame_axes(sketch, ax, margin=4.0)
                corners.append([*ax.get_xlim(), *ax.get_ylim()])
            low_x, high_x, low_y, high_y = np.array(corners).T
            ax.set(xlim=(low_x.min(), high_x.max()), ylim=(low_y.min(), high_y.max()))
            for sketch, alpha in zip(sketches, (_FAINT, _FAINT, 1.0), strict=True):
                for artist in render(sketch, ax):
                    artist.set_alpha(alpha)
            parts = ", ".join(f"{name} {x.real:.3g}" for name, x in list(mode.shape.items())[:4])
            said = f"{mode.frequency:.4g} Hz, ζ = {mode.damping:.3g}" if mode.frequency else f"λ = {mode.eigenvalue.real:.4g} 1/s"
            ax.set_title(f"{said}\n{parts}".replace("$", r"\$"), fontsize=8)
        with replacing(path) as beside:
            figure.savefig(beside)
    return path


def _moved(rest: Equilibrium, by: Array) -> Sketch:
    """The mechanism displaced, its loops closed."""
    guess = dict(zip(rest.space.coordinates, (rest.state.q + by).tolist(), strict=True))
    free = {name: guess[name] for name in rest.space.free}
    state: State = rest.source.assemble(rest.state.p, rest.state.t, fixed=free, guess=guess, history=rest.state.history)[0]
    return sketch_of_state(rest.source, state)
